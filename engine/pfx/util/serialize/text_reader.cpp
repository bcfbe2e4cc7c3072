#include "pfx/util/serialize/text_reader.h"

#include <charconv>

#include "pfx/util/serialize/check_sum.h"

namespace pfx::serial {
namespace {

constexpr bool isBlank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
constexpr bool isParenthesis(char c) { return c == '(' || c == ')'; }

}  // namespace

TextReader::TextReader(std::string_view text) : text_(text) { advance(); }

void TextReader::advance() {
  if (!token_.empty()) check_ = addToken(check_, token_);
  taken_line_ = line_;
  while (at_ < text_.size() && isBlank(text_[at_])) line_ += text_[at_++] == '\n';
  const size_t begin = at_;
  if (at_ < text_.size() && isParenthesis(text_[at_])) {
    ++at_;
  } else {
    while (at_ < text_.size() && !isBlank(text_[at_]) && !isParenthesis(text_[at_])) ++at_;
  }
  token_ = text_.substr(begin, at_ - begin);
}

std::string_view TextReader::nextTag() const {
  if (!good() || token_ != "(") return {};
  const size_t end = text_.find_first_of(" \n\r\t()", at_);
  return text_.substr(at_, end == std::string_view::npos ? end : end - at_);
}

void TextReader::open(const char* tag, uint32_t number) {
  if (!good()) return;
  path_.push(tag, number);
  if (token_.empty()) return failAtEnd();
  if (token_ != "(") return failAtToken(SerializeError::Parenthesis, "an opening parenthesis is missing");
  advance();
  if (token_.empty()) return failAtEnd();
  if (token_ != tag) return failAtToken(SerializeError::Tag, "the group has another tag");
  advance();
}

void TextReader::close() {
  if (!good()) return;
  if (token_.empty()) return failAtEnd();
  if (token_ == "(") return failAtToken(SerializeError::Parenthesis, "a closing parenthesis is missing");
  if (token_ != ")") return failAtToken(SerializeError::Form, "something follows the last number");
  advance();
  path_.pop();
}

std::string_view TextReader::word() {
  if (!good()) return {};
  if (token_.empty()) return failAtEnd(), std::string_view{};
  if (isParenthesis(token_[0]))
    return failAtToken(SerializeError::Parenthesis, "a number is missing"), std::string_view{};
  const std::string_view taken = token_;
  advance();
  return taken;
}

template <class T>
void TextReader::parse(T& value) {
  value = T(0);
  const std::string_view text = word();
  if (!good()) return;
  T read{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), read);
  if (result.ec == std::errc::result_out_of_range)
    return fail(SerializeError::Form, "a number is too large or too small");
  if (result.ec != std::errc() || result.ptr != text.data() + text.size())
    return fail(SerializeError::Form, "this is not a number of the right kind");
  value = read;
}

void TextReader::number(float& value) {
  parse(value);
  if (good() && value != value) fail(SerializeError::Data, "a number is not one (NaN)");
}

template void TextReader::parse(int&);
template void TextReader::parse(int16_t&);
template void TextReader::parse(uint8_t&);
template void TextReader::parse(uint16_t&);
template void TextReader::parse(uint32_t&);
template void TextReader::parse(uint64_t&);
template void TextReader::parse(int64_t&);

}  // namespace pfx::serial

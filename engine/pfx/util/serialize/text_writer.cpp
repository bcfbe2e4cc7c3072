#include "pfx/util/serialize/text_writer.h"

#include <charconv>

#include "pfx/util/serialize/check_sum.h"

namespace pfx::serial {
namespace {

constexpr size_t kPieceBytes = 1 << 16;

}  // namespace

void TextWriter::open(const char* tag, uint32_t number) {
  path_.push(tag, number);
  check_ = addToken(check_, "(");
  check_ = addToken(check_, tag);
  if (!pending_.empty() && pending_.back() != '\n') pending_ += ' ';
  (pending_ += '(') += tag;
  if (pending_.size() >= kPieceBytes) flush();
}

void TextWriter::close() {
  path_.pop();
  check_ = addToken(check_, ")");
  pending_ += ')';
}

void TextWriter::word(std::string_view text) {
  check_ = addToken(check_, text);
  (pending_ += ' ') += text;
}

void TextWriter::number(float value) {
  require(value == value, "a number is not one (NaN)");
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value);
  word({text, static_cast<size_t>(end.ptr - text)});
}

void TextWriter::integer(int64_t value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value);
  word({text, static_cast<size_t>(end.ptr - text)});
}

void TextWriter::integer(uint64_t value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value);
  word({text, static_cast<size_t>(end.ptr - text)});
}

void TextWriter::flush() {
  if (file_ != nullptr && good() &&
      std::fwrite(pending_.data(), 1, pending_.size(), file_) != pending_.size())
    path_.fail(SerializeError::Saving, "the file cannot be written", 0);
  pending_.clear();
}

}  // namespace pfx::serial

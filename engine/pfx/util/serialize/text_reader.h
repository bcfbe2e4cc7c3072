// Reads what TextWriter wrote.
//
// The first failure stays: whatever is asked afterwards does nothing and gives zeros, so that a description
// of a record need not look for failures after each field.
#pragma once

#include <concepts>
#include <cstdint>
#include <string_view>

#include "pfx/util/serialize/tag_path.h"

namespace pfx::serial {

class TextReader {
 public:
  static constexpr bool kReads = true;

  // The text must outlive the reader.
  explicit TextReader(std::string_view text);

  void open(const char* tag) { open(tag, kNoNumber); }
  void open(const char* tag, uint32_t number);
  void close();
  std::string_view nextTag() const;  // of the group that comes next; empty when none does

  void number(float& value);
  template <std::integral T>
  void number(T& value) {
    parse(value);
  }
  std::string_view word();

  void require(bool condition, const char* cause) {
    if (!condition) fail(SerializeError::Data, cause);
  }
  // About what was read last.
  void fail(SerializeError error, const char* cause) { path_.fail(error, cause, taken_line_); }

  void startCheckSum() { check_ = 0; }
  uint64_t checkSum() const { return check_; }  // of all that was read since
  bool good() const { return path_.good(); }
  const SerializeFailure& failure() const { return path_.failure(); }

 private:
  void advance();  // to the next token
  void failAtToken(SerializeError error, const char* cause) { path_.fail(error, cause, line_); }
  void failAtEnd() { failAtToken(SerializeError::Loading, "the file ends too early"); }
  template <class T>
  void parse(T& value);

  std::string_view text_;
  std::string_view token_;  // not taken yet; empty at the end
  size_t at_ = 0;           // behind it
  uint32_t line_ = 1;       // of the token
  uint32_t taken_line_ = 1;
  TagPath path_;
  uint64_t check_ = 0;
};

}  // namespace pfx::serial

// Writes nested groups "(tag number number (tag ...))" as text.
//
// Numbers are decimal and read back to the same bits, wherever they were written: byte order, word size and
// locale of the machine have no part in it.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <type_traits>

#include "pfx/util/serialize/tag_path.h"

namespace pfx::serial {

class TextWriter {
 public:
  static constexpr bool kReads = false;

  // Without a file it only checks what it is given.
  explicit TextWriter(std::FILE* file) : file_(file) {}

  void open(const char* tag) { open(tag, kNoNumber); }
  // A record of an array has a number, by which a failure names it.
  void open(const char* tag, uint32_t number);
  void close();
  void newLine() { pending_ += '\n'; }

  void number(float value);  // NaN is SerializeError::Data
  template <class T>
  requires std::is_integral_v<T>
  void number(T value) {
    if constexpr (std::is_signed_v<T>)
      integer(static_cast<int64_t>(value));
    else
      integer(static_cast<uint64_t>(value));
  }
  void word(std::string_view text);  // without blanks and parentheses

  void require(bool condition, const char* cause) {
    if (!condition) path_.fail(SerializeError::Data, cause, 0);
  }

  void startCheckSum() { check_ = 0; }
  uint64_t checkSum() const { return check_; }  // of all that was written since
  void flush();
  bool good() const { return path_.good(); }
  const SerializeFailure& failure() const { return path_.failure(); }

 private:
  void integer(int64_t value);
  void integer(uint64_t value);

  std::FILE* file_;
  std::string pending_;
  TagPath path_;
  uint64_t check_ = 0;
};

}  // namespace pfx::serial

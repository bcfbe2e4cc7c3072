// Bytes of a snapshot: little-endian, fixed width, the same on every platform.
//
// One description of the data (snapshot.cpp, util/serialize/records.h) runs with three archives: one that counts, one
// that writes, one that reads.
#pragma once

#include <bit>
#include <cstddef>
#include <span>
#include <string>

#include "pfx/util/serialize/fields.h"

namespace pfx::snapshot_format {

// Numbers as bytes; fields have no names here.
template <class Archive>
class BinaryNumbers {
 public:
  template <class T>
  void number(T& value) {
    if constexpr (std::unsigned_integral<T>)
      unsignedNumber(value);
    else if constexpr (sizeof(T) == 2)
      numberAs<uint16_t>(value);
    else
      numberAs<uint32_t>(value);
  }
  void open(const char*) {}
  void close() {}
  bool good() const { return true; }

 private:
  Archive& archive() { return static_cast<Archive&>(*this); }

  template <class U, class T>
  void numberAs(T& value) {
    U u = 0;
    if constexpr (!Archive::kReads) u = std::bit_cast<U>(value);
    unsignedNumber(u);
    if constexpr (Archive::kReads) value = std::bit_cast<T>(u);
  }
  template <class T>
  void unsignedNumber(T& value) {
    std::array<std::byte, sizeof(T)> bytes{};
    if constexpr (!Archive::kReads)
      for (size_t i = 0; i < sizeof(T); ++i) bytes[i] = static_cast<std::byte>(value >> (8 * i));
    archive().bytes(bytes.data(), bytes.size());
    if constexpr (Archive::kReads) {
      uint64_t sum = 0;
      for (size_t i = 0; i < sizeof(T); ++i) sum |= uint64_t(bytes[i]) << (8 * i);
      value = static_cast<T>(sum);
    }
  }
};

class Counter : public BinaryNumbers<Counter> {
 public:
  static constexpr bool kReads = false;
  void bytes(std::byte*, size_t count) { size_ += count; }
  void require(bool, const char*) const {}
  size_t size() const { return size_; }

 private:
  size_t size_ = 0;
};

class Writer : public BinaryNumbers<Writer> {
 public:
  static constexpr bool kReads = false;
  explicit Writer(std::span<std::byte> out) : out_(out) {}
  void bytes(const std::byte* data, size_t count) {
    std::copy(data, data + count, out_.data() + at_);
    at_ += count;
  }
  size_t size() const { return at_; }
  void require(bool, const char*) const {}  // what cannot be written is refused before (requireKept)

 private:
  std::span<std::byte> out_;  // large enough
  size_t at_ = 0;
};

class Reader : public BinaryNumbers<Reader> {
 public:
  static constexpr bool kReads = true;
  // `begin`: place of the bytes in the whole, for messages.
  Reader(std::span<const std::byte> in, size_t begin, std::string section)
      : in_(in), begin_(begin), section_(std::move(section)) {}
  void bytes(std::byte* data, size_t count) {
    if (count > in_.size() - at_) fail("ends too early");
    std::copy_n(in_.data() + at_, count, data);
    at_ += count;
  }
  bool atEnd() const { return at_ == in_.size(); }
  void require(bool condition, const char* what) const {
    if (!condition) fail(what);
  }
  [[noreturn]] void fail(const std::string& what) const;  // throws SnapshotError

 private:
  std::span<const std::byte> in_;
  size_t begin_, at_ = 0;
  std::string section_;
};

}  // namespace pfx::snapshot_format

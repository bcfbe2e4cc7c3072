// Bytes of a snapshot: little-endian, fixed width, the same on every platform.
//
// One description of the data (snapshot.cpp) runs with three archives: one that counts, one that writes, one that reads.
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "pfx/base_level/math/transform.h"
#include "pfx/base_level/shape/aabb.h"

namespace pfx::snapshot_format {

class Counter {
 public:
  static constexpr bool kReads = false;
  void bytes(std::byte*, size_t count) { size_ += count; }
  size_t size() const { return size_; }

 private:
  size_t size_ = 0;
};

class Writer {
 public:
  static constexpr bool kReads = false;
  explicit Writer(std::span<std::byte> out) : out_(out) {}
  void bytes(const std::byte* data, size_t count) {
    std::copy(data, data + count, out_.data() + at_);
    at_ += count;
  }
  size_t size() const { return at_; }

 private:
  std::span<std::byte> out_;  // large enough
  size_t at_ = 0;
};

class Reader {
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

template <class A, std::unsigned_integral T>
void io(A& a, T& value) {
  std::array<std::byte, sizeof(T)> bytes{};
  if constexpr (!A::kReads)
    for (size_t i = 0; i < sizeof(T); ++i) bytes[i] = static_cast<std::byte>(value >> (8 * i));
  a.bytes(bytes.data(), bytes.size());
  if constexpr (A::kReads) {
    uint64_t sum = 0;
    for (size_t i = 0; i < sizeof(T); ++i) sum |= uint64_t(bytes[i]) << (8 * i);
    value = static_cast<T>(sum);
  }
}

// As an unsigned number of the same width.
template <class A, class U, class T>
void ioAs(A& a, T& value) {
  U u = 0;
  if constexpr (!A::kReads) u = std::bit_cast<U>(value);
  io(a, u);
  if constexpr (A::kReads) value = std::bit_cast<T>(u);
}

template <class A>
void io(A& a, float& value) {
  ioAs<A, uint32_t>(a, value);
}
template <class A>
void io(A& a, int& value) {
  ioAs<A, uint32_t>(a, value);
}
template <class A>
void io(A& a, int16_t& value) {
  ioAs<A, uint16_t>(a, value);
}
template <class A>
void io(A& a, bool& value) {
  uint8_t u = value;
  io(a, u);
  if constexpr (A::kReads) {
    a.require(u <= 1, "a flag is neither 0 nor 1");
    value = u != 0;
  }
}

// Enumerations: values 0 .. last.
template <class A, class E>
void ioEnum(A& a, E& value, E last) {
  auto u = static_cast<uint8_t>(value);
  io(a, u);
  if constexpr (A::kReads) {
    a.require(u <= static_cast<uint8_t>(last), "a kind is unknown");
    value = static_cast<E>(u);
  }
}

template <class A, int... Sizes>
void io(A& a, Eigen::Matrix<float, Sizes...>& m) {
  for (int i = 0; i < m.size(); ++i) io(a, m.data()[i]);
}
template <class A>
void io(A& a, Quat& q) {
  io(a, q.coeffs());
}
template <class A>
void io(A& a, Transform& t) {
  io(a, t.position), io(a, t.orientation);
}
template <class A>
void io(A& a, Aabb& b) {
  io(a, b.min), io(a, b.max);
}
template <class A, class T, size_t N>
void io(A& a, std::array<T, N>& values) {
  for (T& v : values) io(a, v);
}
template <class A, class T, size_t N>
void io(A& a, T (&values)[N]) {
  for (T& v : values) io(a, v);
}

// A list: its length, then its entries by fn(archive, entry). Grows as it is read, so that a wrong length costs no
// more memory than the data that are there.
template <class A, class List, class Fn>
void ioList(A& a, List& list, Fn&& fn) {
  auto count = static_cast<uint32_t>(list.size());
  io(a, count);
  if constexpr (A::kReads) {
    list.clear();
    for (uint32_t i = 0; i < count; ++i) list.resize(i + 1u), fn(a, list.back());
  } else {
    for (auto& entry : list) fn(a, entry);
  }
}
template <class A, class T, class Memory>
void io(A& a, std::vector<T, Memory>& list) {
  ioList(a, list, [](A& archive, T& entry) { io(archive, entry); });
}
template <class A>
void io(A& a, std::string& text) {
  ioList(a, text, [](A& archive, char& c) { ioAs<A, uint8_t>(archive, c); });
}

}  // namespace pfx::snapshot_format

// One description of a record for every archive: text and bytes, reading, writing and counting.
//
// A record has one function template io(archive, record) that names its fields in order:
//   template <class A> void io(A& a, Hinge& h) { field(a, "axis", h.axis), field(a, "angle", h.angle); }
// An archive has number(x) for each kind of number, open(tag) and close() around a field (which archives of
// bytes skip), require(condition, cause), good(), and kReads. Archives that write change nothing.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "pfx/base_level/math/transform.h"
#include "pfx/base_level/shape/aabb.h"

namespace pfx::serial {

template <class T>
concept Number =
    std::same_as<T, float> || std::same_as<T, int> || std::same_as<T, int16_t> || std::same_as<T, uint8_t> ||
    std::same_as<T, uint16_t> || std::same_as<T, uint32_t> || std::same_as<T, uint64_t>;

template <class A, Number T>
void io(A& a, T& value) {
  a.number(value);
}
template <class A>
void io(A& a, bool& value) {
  uint8_t u = value;
  a.number(u);
  if constexpr (A::kReads) {
    a.require(u <= 1, "a flag is neither 0 nor 1");
    value = u != 0;
  }
}

// Enumerations: values 0 .. last.
template <class A, class E>
void ioEnum(A& a, E& value, E last) {
  auto u = static_cast<uint8_t>(value);
  a.number(u);
  if constexpr (A::kReads) {
    const bool known = u <= static_cast<uint8_t>(last);
    a.require(known, "a kind is unknown");
    if (known) value = static_cast<E>(u);
  }
}

template <class A, int... Sizes>
void io(A& a, Eigen::Matrix<float, Sizes...>& m) {
  for (int i = 0; i < m.size(); ++i) a.number(m.data()[i]);
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

// A list: its length, then its entries by fn(archive, entry). Grows as it is read, so that a wrong length
// costs no more memory than the data that are there.
template <class A, class List, class Fn>
void ioList(A& a, List& list, Fn&& fn) {
  auto count = static_cast<uint32_t>(list.size());
  a.number(count);
  if constexpr (A::kReads) {
    list.clear();
    for (uint32_t i = 0; i < count && a.good(); ++i) list.resize(i + size_t(1)), fn(a, list.back());
  } else {
    for (auto& entry : list) fn(a, entry);
  }
}
template <class A, class T, class Allocator>
void io(A& a, std::vector<T, Allocator>& list) {
  ioList(a, list, [](A& archive, T& entry) { io(archive, entry); });
}
template <class A, class Traits, class Allocator>
void io(A& a, std::basic_string<char, Traits, Allocator>& text) {
  ioList(a, text, [](A& archive, char& c) {
    auto u = static_cast<uint8_t>(c);
    archive.number(u);
    if constexpr (A::kReads) c = static_cast<char>(u);
  });
}

// A field of a record under its name.
template <class A, class T>
void field(A& a, const char* tag, T& value) {
  a.open(tag);
  io(a, value);
  a.close();
}
template <class A, class E>
void enumField(A& a, const char* tag, E& value, E last) {
  a.open(tag);
  ioEnum(a, value, last);
  a.close();
}

}  // namespace pfx::serial

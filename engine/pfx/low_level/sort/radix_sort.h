// Stable parallel sort of small records by an unsigned key.
//
// Least-significant-digit radix sort with 8-bit digits; digits that all keys share cost nothing, and data
// that are sorted already are left alone after one look. With a task manager each pass counts and scatters
// chunks in parallel. A stable sort has one result, so it is the same for any number of workers. Source: D.
// Knuth, The Art of Computer Programming vol. 3, section 5.2.5.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

#include "pfx/base_level/error.h"
#include "pfx/low_level/task/task_manager.h"

namespace pfx {

// A record of Bytes bytes with a key in front. Any trivially copyable type with a key() serves as well.
template <class Key, int Bytes>
struct alignas(Bytes >= 16 ? 16 : Bytes) SortRecord {
  Key key_value = 0;
  std::array<uint32_t, (Bytes - sizeof(Key)) / 4> data = {};

  Key key() const { return key_value; }
};
using SortRecord16 = SortRecord<uint32_t, 16>;
using SortRecord32 = SortRecord<uint32_t, 32>;

// Keys of finite floats compare as the floats do; -0 equals +0. NaN sorts behind everything or in front of
// it.
inline uint32_t floatKey(float value) {
  const uint32_t bits = std::bit_cast<uint32_t>(value + 0.0f);  // -0 + 0 = +0
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

namespace radix {

inline constexpr uint32_t kDigits = 256;
inline constexpr uint32_t kMaxChunks = 32;
inline constexpr uint32_t kMinChunk = 8192;      // records; below, sharing a pass costs more than it saves
inline constexpr uint32_t kInsertionLimit = 40;  // records; below, insertion is faster than counting

using Histogram = std::array<uint32_t, kDigits>;

template <class Record>
using KeyOf = decltype(std::declval<const Record&>().key());

template <class Key>
constexpr uint32_t digit(Key key, uint32_t pass) {
  return static_cast<uint32_t>(key >> (8 * pass)) & (kDigits - 1);
}

template <class Record>
void insertionSort(std::span<Record> data) {
  for (std::size_t i = 1; i < data.size(); ++i) {
    const Record moving = data[i];
    std::size_t at = i;
    for (; at > 0 && moving.key() < data[at - 1].key(); --at) data[at] = data[at - 1];
    data[at] = moving;
  }
}

// Which bits differ between keys, and whether the keys ascend.
template <class Key>
struct Survey {
  Key differing = 0;
  bool sorted = true;
};

template <class Record>
Survey<KeyOf<Record>> survey(std::span<const Record> data) {
  using Key = KeyOf<Record>;
  Survey<Key> s;
  const Key first = data[0].key();
  Key previous = first;
  for (const Record& r : data) {
    const Key key = r.key();
    s.differing |= key ^ first;
    s.sorted &= previous <= key;
    previous = key;
  }
  return s;
}

// One pass: moves `from` to `to` in the order of one digit.
template <class Record>
void scatterByDigit(std::span<const Record> from, std::span<Record> to, uint32_t pass, TaskManager* tasks) {
  const uint32_t n = static_cast<uint32_t>(from.size());
  const uint32_t wanted = numWorkers(tasks) == 1 ? 1 : std::min(n / kMinChunk + 1, kMaxChunks);
  const uint32_t chunk = (n + wanted - 1) / wanted, num_chunks = (n + chunk - 1) / chunk;

  std::array<Histogram, kMaxChunks> places;  // counts, then the place of the next record
  parallelFor(tasks, num_chunks, 1, [&](TaskRange range) {
    for (uint32_t c = range.begin; c < range.end; ++c) {
      places[c].fill(0);
      for (const Record& r : from.subspan(c * chunk, std::min(chunk, n - c * chunk))) {
        ++places[c][digit(r.key(), pass)];
      }
    }
  });
  uint32_t sum = 0;
  for (uint32_t d = 0; d < kDigits; ++d) {
    for (uint32_t c = 0; c < num_chunks; ++c) sum += std::exchange(places[c][d], sum);
  }
  parallelFor(tasks, num_chunks, 1, [&](TaskRange range) {
    for (uint32_t c = range.begin; c < range.end; ++c) {
      for (const Record& r : from.subspan(c * chunk, std::min(chunk, n - c * chunk))) {
        to[places[c][digit(r.key(), pass)]++] = r;
      }
    }
  });
}

}  // namespace radix

// Sorts `data` by key(), ascending; records of equal key keep their order. `work` is scratch of at least the
// size of `data`, aligned to 16 bytes, and holds nothing afterwards. Up to 2^32 - 1 records.
// Error::OutOfBuffer, Error::InvalidAlignment, Error::OutOfRange: see above; data are untouched then.
template <class Record>
Error sort(std::span<Record> data, std::span<Record> work, TaskManager* tasks = nullptr) {
  static_assert(std::is_trivially_copyable_v<Record>);
  static_assert(std::is_unsigned_v<radix::KeyOf<Record>>);
  if (data.size() > 0xffffffffu) return Error::OutOfRange;
  if (work.size() < data.size()) return Error::OutOfBuffer;
  if (reinterpret_cast<uintptr_t>(work.data()) % 16 != 0) return Error::InvalidAlignment;
  if (data.size() <= radix::kInsertionLimit) {
    radix::insertionSort(data);
    return Error::Ok;
  }
  const auto survey = radix::survey(std::span<const Record>(data));
  if (survey.sorted) return Error::Ok;

  std::span<Record> from = data, to = work.first(data.size());
  for (uint32_t pass = 0; pass < sizeof(survey.differing); ++pass) {
    if (radix::digit(survey.differing, pass) == 0) continue;
    radix::scatterByDigit(std::span<const Record>(from), to, pass, tasks);
    std::swap(from, to);
  }
  if (from.data() != data.data()) std::copy(from.begin(), from.end(), data.begin());
  return Error::Ok;
}

}  // namespace pfx

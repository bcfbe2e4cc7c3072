// The record sort against std::stable_sort, for every length that could go wrong.
#include "pfx/low_level/sort/radix_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>
#include <vector>

#include "pfx/base_level/collision/pair.h"

namespace pfx {
namespace {

template <class Record>
class RadixSort : public ::testing::Test {};
using Records =
    ::testing::Types<SortRecord16, SortRecord32, SortRecord<uint64_t, 16>, SortRecord<uint64_t, 32>>;
TYPED_TEST_SUITE(RadixSort, Records);

template <class Record>
void expectSortedLikeTheStandardSort(uint32_t n, const std::function<uint64_t(uint32_t)>& key_of,
                                     TaskManager* tasks) {
  using Key = decltype(Record().key());
  constexpr uint32_t kGuard = 8;  // records behind the buffers that nobody may write
  std::vector<Record> data(n + kGuard), work(n + kGuard);
  for (uint32_t i = 0; i < data.size(); ++i) {
    data[i].key_value = static_cast<Key>(i < n ? key_of(i) : 12345);
    data[i].data[0] = i;
  }
  std::vector<Record> expected = data;
  std::stable_sort(expected.begin(), expected.begin() + n,
                   [](const Record& a, const Record& b) { return a.key() < b.key(); });
  for (Record& r : work) r.data[0] = 77;
  ASSERT_EQ(sort(std::span(data).first(n), std::span(work).first(n), tasks), Error::Ok);
  for (Record& r : std::span(work).first(n)) r.data[0] = 0;  // results live in `data` only
  ASSERT_EQ(std::memcmp(data.data(), expected.data(), data.size() * sizeof(Record)), 0) << n;
  for (uint32_t i = n; i < work.size(); ++i) ASSERT_EQ(work[i].data[0], 77u);
}

TYPED_TEST(RadixSort, equalsAStableSortForAnyLengthAndNumberOfWorkers) {
  std::mt19937_64 random(1);
  TaskManager two(2, Sharing::Always), four(4, Sharing::Always);
  for (TaskManager* tasks : {static_cast<TaskManager*>(nullptr), &two, &four}) {
    for (uint32_t n :
         {0u, 1u, 2u, 3u, 39u, 40u, 41u, 64u, 255u, 256u, 257u, 1024u, 8191u, 8192u, 20011u, 65536u}) {
      expectSortedLikeTheStandardSort<TypeParam>(
          n, [&](uint32_t) { return random(); }, tasks);
      expectSortedLikeTheStandardSort<TypeParam>(
          n, [&](uint32_t) { return random() % 10; }, tasks);
    }
  }
}

TYPED_TEST(RadixSort, handlesSortedReversedEqualAndExtremeKeys) {
  for (uint32_t n : {10u, 1000u, 20000u}) {
    const auto check = [&](auto key_of) { expectSortedLikeTheStandardSort<TypeParam>(n, key_of, nullptr); };
    check([](uint32_t i) { return uint64_t{i}; });
    check([=](uint32_t i) { return uint64_t{n - i}; });
    check([](uint32_t) { return uint64_t{42}; });
    check([](uint32_t i) { return i % 2 ? ~uint64_t{0} : 0; });
    check([](uint32_t i) { return uint64_t{1} << (i * 7 % 64); });
  }
}

TEST(RadixSortErrors, areReportedAndLeaveTheDataAlone) {
  std::vector<SortRecord16> data(100), work(101);
  for (uint32_t i = 0; i < 100; ++i) data[i].key_value = 100 - i;
  EXPECT_EQ(sort(std::span(data), std::span(work).first(99)), Error::OutOfBuffer);
  auto* shifted = reinterpret_cast<Pair*>(reinterpret_cast<char*>(work.data()) + 4);
  std::vector<Pair> pairs(100);
  EXPECT_EQ(sort(std::span(pairs), std::span(shifted, 100)), Error::InvalidAlignment);
  EXPECT_EQ(data[0].key(), 100u);
}

TEST(RadixSortPairs, sortsByBothBodies) {
  std::mt19937 random(3);
  std::vector<Pair> pairs(5000), work(5000);
  for (Pair& p : pairs) {
    p.body_a = random() % 70000;
    p.body_b = p.body_a + 1 + random() % 70000;
  }
  ASSERT_EQ(sort(std::span(pairs), std::span(work)), Error::Ok);
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::pair(a.body_a, a.body_b) < std::pair(b.body_a, b.body_b);
  }));
}

TEST(FloatKey, ordersAsTheFloatsDo) {
  const std::vector<float> ascending = {-INFINITY, -1e30f, -2.0f, -1.0f, -1e-40f,
                                        0.0f,      1e-40f, 0.5f,  1e30f, INFINITY};
  for (std::size_t i = 1; i < ascending.size(); ++i)
    EXPECT_LT(floatKey(ascending[i - 1]), floatKey(ascending[i]));
  EXPECT_EQ(floatKey(-0.0f), floatKey(0.0f));
}

}  // namespace
}  // namespace pfx

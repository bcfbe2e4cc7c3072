// The worker pool: every index once, any number of workers, jobs back to back.
#include "pfx/low_level/task/task_manager.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

namespace pfx {
namespace {

class TaskManagerWith : public ::testing::TestWithParam<int> {};

TEST_P(TaskManagerWith, coversEveryIndexOnce) {
  TaskManager tasks(GetParam(), Sharing::Always);
  for (uint32_t count : {0u, 1u, 7u, 64u, 1000u, 4099u}) {
    for (uint32_t grain : {0u, 1u, 3u, 64u, 5000u}) {
      std::vector<int> hits(count, 0);
      tasks.parallelFor(count, grain, [&](TaskRange r) {
        for (uint32_t i = r.begin; i < r.end; ++i) ++hits[i];
      });
      EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), count) << count << " by " << grain;
    }
  }
}

TEST_P(TaskManagerWith, cutsTheSameBlocksForAnyNumberOfWorkers) {
  TaskManager tasks(GetParam());
  std::vector<uint32_t> end_of_block(16, 0);
  tasks.parallelFor(150, 10, [&](TaskRange r) {
    ASSERT_EQ(r.begin % 10, 0u);
    ASSERT_LT(r.worker, static_cast<uint32_t>(tasks.numWorkers()));
    end_of_block[r.begin / 10] = r.end;
  });
  for (uint32_t b = 0; b < 15; ++b) EXPECT_EQ(end_of_block[b], 10 * b + 10);
}

TEST_P(TaskManagerWith, resultsOfOneJobAreSeenByTheNext) {
  TaskManager tasks(GetParam(), Sharing::Always);
  std::vector<double> x(2000, 0.0);
  for (int round = 0; round < 300; ++round) {
    tasks.parallelFor(2000, 50, [&](TaskRange r) {
      for (uint32_t i = r.begin; i < r.end; ++i) x[i] += std::sqrt(static_cast<double>(x.size() - i));
    });
    tasks.parallelFor(1000, 50, [&](TaskRange r) {
      for (uint32_t i = r.begin; i < r.end; ++i) std::swap(x[i], x[1999 - i]);
    });
  }
  // Every element took both places equally often, 150 times each.
  for (uint32_t i = 0; i < 2000; ++i) {
    const double expected = 150.0 * (std::sqrt(2000.0 - i) + std::sqrt(i + 1.0));
    EXPECT_NEAR(x[i], expected, 1e-9 * expected);  // 300 additions, each rounded to 1e-16
  }
}

TEST_P(TaskManagerWith, sharesLongRanges) {
  TaskManager tasks(GetParam());
  std::vector<std::atomic<int>> blocks(static_cast<std::size_t>(tasks.numWorkers()));
  const auto work = [&](TaskRange r) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(2);
    while (std::chrono::steady_clock::now() < until) {
    }
    ++blocks[r.worker];
  };
  for (int round = 0; round < 5; ++round) tasks.parallelFor(40, 1, work);
  int total = 0, helpers = 0;
  for (std::size_t w = 0; w < blocks.size(); ++w) total += blocks[w], helpers += w > 0 && blocks[w] > 0;
  EXPECT_EQ(total, 200);
  EXPECT_GE(helpers, std::min(tasks.numWorkers() - 1, 1));
}

TEST_P(TaskManagerWith, startsAndStopsManyTimes) {
  for (int i = 0; i < 100; ++i) {
    TaskManager tasks(GetParam());
    std::atomic<uint32_t> sum{0};
    if (i % 2 == 0) tasks.parallelFor(100, 1, [&](TaskRange r) { sum += r.end; });
    EXPECT_EQ(sum, i % 2 == 0 ? 5050u : 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Workers, TaskManagerWith, ::testing::Values(1, 2, 3, 4, 8));

TEST(TaskManager, keepsTinyRangesOnTheCaller) {
  TaskManager tasks(4);
  std::vector<int> data(64, 0);
  std::atomic<int> by_others{0};
  const auto tiny = [&](TaskRange r) {
    for (uint32_t i = r.begin; i < r.end; ++i) ++data[i];
    if (r.worker != 0) ++by_others;
  };
  // The cost of a block is below a microsecond. An interruption may fool the estimate for a few calls, no
  // more.
  for (int i = 0; i < 1000; ++i) tasks.parallelFor(64, 16, tiny);
  EXPECT_EQ(std::accumulate(data.begin(), data.end(), 0), 64000);
  EXPECT_LT(by_others, 400);
}

TEST(TaskManager, clampsTheNumberOfWorkers) {
  EXPECT_EQ(TaskManager(0).numWorkers(), 1);
  EXPECT_EQ(TaskManager(-5).numWorkers(), 1);
  EXPECT_EQ(TaskManager(1000).numWorkers(), 64);
}

TEST(TaskManager, isOptional) {
  std::vector<uint32_t> begins;
  parallelFor(nullptr, 25, 10, [&](TaskRange r) { begins.push_back(r.begin); });
  EXPECT_EQ(begins, (std::vector<uint32_t>{0, 10, 20}));
  EXPECT_EQ(numWorkers(nullptr), 1);
}

}  // namespace
}  // namespace pfx

// The worker pool: blocks are claimed by counting one word down, idle workers spin shortly and then park.
//
// A job is published by storing its number of blocks in `unclaimed`. Whoever lowers that word from k to k - 1
// owns block num_blocks - k, and reads the description of the job only after that: a job cannot end, nor the
// next one be described, while a claimed block is unfinished. A worker that slept through several jobs
// therefore needs no generation counter; at worst it claims a block of the current job.
//
// Waking a parked worker costs the caller a few microseconds, more than many ranges take. The pool remembers
// how long an index takes at each call site and keeps short ranges on the caller.
#include "pfx/low_level/task/task_manager.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <chrono>
#include <thread>
#include <vector>

#if defined(__x86_64__) || defined(__i386__)
#include <emmintrin.h>
#endif

namespace pfx {

namespace {

constexpr int kMaxWorkers = 64;
constexpr int kSpins = 400;                 // pauses before parking; some 20 microseconds
constexpr float kWorthSharing = 20000.0f;   // ns of work below which a range stays on the caller
constexpr float kUnknownCost = -1.0f;       // ns per index
constexpr std::size_t kNumCallSites = 256;  // slots of the cost table, a power of two

inline void pauseBriefly() {
#if defined(__x86_64__) || defined(__i386__)
  _mm_pause();
#else
  std::this_thread::yield();
#endif
}

// Spins shortly, then sleeps, until `word` differs from `old`.
uint32_t waitForChange(std::atomic<uint32_t>& word, uint32_t old) {
  for (int i = 0; i < kSpins; ++i) {
    const uint32_t value = word.load(std::memory_order_acquire);
    if (value != old) return value;
    pauseBriefly();
  }
  word.wait(old, std::memory_order_seq_cst);
  return word.load(std::memory_order_acquire);
}

using Clock = std::chrono::steady_clock;

float nanosecondsSince(Clock::time_point start) {
  return std::chrono::duration<float, std::nano>(Clock::now() - start).count();
}

}  // namespace

struct TaskManager::Pool {
  struct Job {
    void* fn = nullptr;
    Call call = nullptr;
    uint32_t count = 0, grain = 1, num_blocks = 0;

    void runBlock(uint32_t block, uint32_t worker) const {
      const uint32_t begin = block * grain;
      call(fn, {begin, count - begin < grain ? count : begin + grain, worker});
    }
  };

  // Remembered cost of one index, by the address of the code that is called.
  struct CallSite {
    Call call = nullptr;
    float ns_per_index = kUnknownCost;
  };

  // The words that threads fight over have a cache line each.
  alignas(64) std::atomic<uint32_t> unclaimed{0};   // blocks of the current job that nobody has claimed
  alignas(64) std::atomic<uint32_t> unfinished{0};  // published blocks that have not returned
  alignas(64) std::atomic<uint32_t> epoch{0};       // counts published jobs; workers wait on it
  std::atomic<bool> stopping{false};
  Job job;
  std::array<CallSite, kNumCallSites> costs;
  std::vector<std::thread> threads;

  float worth_sharing;  // ns

  Pool(int num_workers, Sharing sharing) : worth_sharing(sharing == Sharing::Always ? 0.0f : kWorthSharing) {
    threads.reserve(num_workers - 1);
    for (int i = 1; i < num_workers; ++i) threads.emplace_back([this, i] { workerLoop(i); });
  }

  ~Pool() {
    stopping.store(true);
    epoch.fetch_add(1);
    epoch.notify_all();
    for (std::thread& t : threads) t.join();
  }

  CallSite& site(Call call) {
    const auto address = reinterpret_cast<uintptr_t>(call);
    CallSite& s = costs[(address ^ address >> 8) >> 4 & (kNumCallSites - 1)];
    if (s.call != call) s = {call, kUnknownCost};
    return s;
  }

  bool claim(uint32_t* left) {
    uint32_t k = unclaimed.load(std::memory_order_relaxed);
    while (k != 0) {
      if (unclaimed.compare_exchange_weak(k, k - 1, std::memory_order_acquire, std::memory_order_relaxed)) {
        *left = k;
        return true;
      }
    }
    return false;
  }

  // Works on the current job until no block is left to claim; returns how many blocks this thread did.
  uint32_t work(uint32_t worker) {
    uint32_t done = 0;
    for (uint32_t left = 0; claim(&left); ++done) {
      job.runBlock(job.num_blocks - left, worker);
      if (unfinished.fetch_sub(1, std::memory_order_acq_rel) == 1 && worker != 0) unfinished.notify_one();
    }
    return done;
  }

  void workerLoop(uint32_t worker) {
    uint32_t seen = 0;
    while (!stopping.load(std::memory_order_acquire)) {
      work(worker);
      seen = waitForChange(epoch, seen);
    }
  }

  // Makes blocks [first, num_blocks) of the job available and wakes as many workers as can help.
  void publish(uint32_t first) {
    const uint32_t left = job.num_blocks - first;
    unfinished.store(left, std::memory_order_relaxed);
    unclaimed.store(left, std::memory_order_release);
    epoch.fetch_add(1);
    const uint32_t helpers = std::min(static_cast<uint32_t>(threads.size()), left - 1);
    for (uint32_t i = 0; i < helpers; ++i) epoch.notify_one();
  }

  void finish() {
    for (uint32_t left = unfinished.load(std::memory_order_acquire); left != 0;)
      left = waitForChange(unfinished, left);
  }
};

TaskManager::TaskManager(int num_workers, Sharing sharing) {
  if (num_workers > 1) pool_ = std::make_unique<Pool>(std::min(num_workers, kMaxWorkers), sharing);
}

TaskManager::~TaskManager() = default;

int TaskManager::numWorkers() const { return pool_ ? static_cast<int>(pool_->threads.size()) + 1 : 1; }

void TaskManager::run(uint32_t count, uint32_t grain, void* fn, Call call) {
  if (count == 0) return;
  grain = std::max(grain, 1u);
  const Pool::Job job{fn, call, count, grain, count / grain + (count % grain != 0)};
  if (!pool_ || job.num_blocks == 1) {
    for (uint32_t block = 0; block < job.num_blocks; ++block) job.runBlock(block, 0);
    return;
  }
  Pool& pool = *pool_;

  // A call site that was never seen shows its cost on the first block.
  Pool::CallSite& site = pool.site(call);
  const Clock::time_point start = Clock::now();
  uint32_t next = 0;
  if (site.ns_per_index == kUnknownCost) {
    job.runBlock(next++, 0);
    site.ns_per_index = nanosecondsSince(start) / static_cast<float>(grain);
  }

  uint32_t done = next;
  if (site.ns_per_index * static_cast<float>(count - next * grain) < pool.worth_sharing) {
    for (uint32_t block = next; block < job.num_blocks; ++block) job.runBlock(block, 0);
    done = job.num_blocks;
  } else {
    pool.job = job;
    pool.publish(next);
    done += pool.work(0);
  }
  // A moving mean: one interruption by the operating system must not decide for long.
  if (done > 0) {
    const float measured = nanosecondsSince(start) / (static_cast<float>(done) * static_cast<float>(grain));
    site.ns_per_index += 0.25f * (measured - site.ns_per_index);
  }
  if (done != job.num_blocks) pool.finish();
}

}  // namespace pfx

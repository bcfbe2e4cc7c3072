// A pool of persistent workers that share out ranges of indices.
//
// Properties:
//   1. The caller works too: TaskManager(n) runs on n threads, n - 1 of them its own. n = 1 makes no thread.
//   2. Idle workers are parked after a short spin. A range that is not worth sharing runs on the caller
//   alone: one
//      block, or less work than waking somebody costs, by the time that the same call site took before.
//   3. Which worker takes which block is not fixed. Results stay the same for any number of workers as long
//   as blocks
//      write to disjoint places; everything in low_level keeps to that.
//   4. No allocation after construction.
#pragma once

#include <cstdint>
#include <memory>
#include <type_traits>

namespace pfx {

struct TaskRange {
  uint32_t begin, end;  // indices
  uint32_t worker;      // 0 .. numWorkers() - 1; 0 is the caller
};

// Always is for tests: it sends the smallest job through the workers.
enum class Sharing : uint8_t { WhenWorthwhile, Always };

class TaskManager {
 public:
  explicit TaskManager(int num_workers = 1, Sharing sharing = Sharing::WhenWorthwhile);  // clamped to 1 .. 64
  ~TaskManager();
  TaskManager(const TaskManager&) = delete;
  TaskManager& operator=(const TaskManager&) = delete;

  int numWorkers() const;

  // Calls fn(TaskRange) on blocks of `grain` indices that together cover [0, count), and returns when all are
  // done. Blocks start at multiples of grain, for any number of workers. Exceptions must not leave fn. Not
  // reentrant.
  template <class Fn>
  void parallelFor(uint32_t count, uint32_t grain, Fn&& fn) {
    using Body = std::remove_reference_t<Fn>;
    run(count, grain, const_cast<void*>(static_cast<const void*>(&fn)),
        [](void* f, TaskRange range) { (*static_cast<Body*>(f))(range); });
  }

 private:
  using Call = void (*)(void*, TaskRange);
  void run(uint32_t count, uint32_t grain, void* fn, Call call);

  struct Pool;
  std::unique_ptr<Pool> pool_;  // null for the caller alone
};

// The same blocks, one after the other when there is no task manager.
template <class Fn>
void parallelFor(TaskManager* tasks, uint32_t count, uint32_t grain, Fn&& fn) {
  if (tasks != nullptr) return tasks->parallelFor(count, grain, fn);
  for (uint32_t begin = 0; begin < count;) {
    const uint32_t end = count - begin < grain ? count : begin + grain;
    fn(TaskRange{begin, end, 0});
    begin = end;
  }
}

// Number of workers; 1 when there is no task manager.
inline int numWorkers(const TaskManager* tasks) { return tasks != nullptr ? tasks->numWorkers() : 1; }

}  // namespace pfx

// Times of the stages, as samples print them.
#pragma once

#include <chrono>

#include "base.h"

namespace sce {
namespace PhysicsEffects {

// Begin and end of each section are marks, counted from 0: the i-th section lasts from mark 2 i to mark 2 i + 1.
class PfxPerfCounter {
 public:
  enum { kMaxMarks = 64 };

  // Begins and ends a section; the name must outlive the counter.
  void countBegin(const char* name) { mark(name); }
  void countEnd() { mark(""); }
  void resetCount() { num_marks_ = 0; }
  int getNumMarks() const { return num_marks_; }
  // Milliseconds from a mark to the next one; 0 where there is none.
  PfxFloat getCountTime(int mark) const {
    if (mark < 0 || mark + 1 >= num_marks_) return 0.0f;
    return ::std::chrono::duration<PfxFloat, ::std::milli>(marks_[mark + 1].time - marks_[mark].time).count();
  }
  void printCount() const {
    for (int i = 0; i + 1 < num_marks_; i += 2) SCE_PFX_PRINTF("%s %.3f ms\n", marks_[i].name, static_cast<double>(getCountTime(i)));
  }

 private:
  struct Mark {
    const char* name;
    ::std::chrono::steady_clock::time_point time;
  };
  // Marks beyond the last one are left out.
  void mark(const char* name) {
    if (num_marks_ < kMaxMarks) marks_[num_marks_++] = {name, ::std::chrono::steady_clock::now()};
  }

  Mark marks_[kMaxMarks];
  int num_marks_ = 0;
};

}  // namespace PhysicsEffects
}  // namespace sce

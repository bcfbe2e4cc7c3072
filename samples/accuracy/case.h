// Accuracy cases as data: a scene, where its bodies ought to be at any time, and how the error is measured.
//
// The scene is an ordinary pfx::World; another engine can be given the same bodies. The answer is a closed form, or
// an integral of the exact equations in minimal coordinates with steps so small that its own error is far below any
// float. No case knows which engine or which setting it judges.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "samples/shared/body_motion.h"

namespace samples::accuracy {

inline constexpr float kGravity = 9.81f;  // m/s^2, of all cases

// Where a body ought to be.
struct Truth {
  uint32_t body;  // index in the world
  pfx::TransformDouble pose;
};

// One case under way.
class Run {
 public:
  virtual ~Run() = default;
  virtual void build(pfx::World& world) = 0;  // into an empty world
  virtual void advance(double dt) = 0;        // the answer, by dt seconds
  // Signed, now; nothing when the case does not look at this time.
  virtual double error(std::span<const BodyMotion> bodies) const = 0;
  virtual std::vector<Truth> truth() const { return {}; }
};

struct Case {
  std::string_view id;      // of the accuracy suite: "ACC-05"
  std::string_view name;    // "pendulum"
  std::string_view shows;   // one line
  std::string_view metric;  // "angle"
  std::string_view unit;    // "rad"; empty: relative
  double target;            // to be reached at 60 Hz with 4 sub-steps
  double floor;             // what the rounding of a float state leaves; smaller errors are not told apart
  double seconds;           // length of a run
  bool smooth;              // the motion is smooth, so that the error must fall when the sub-step does
  std::unique_ptr<Run> (*make)();
  bool front_page = false;
  bool free = false;  // nothing touches the body, so that an engine may see no sub-steps: shorter steps take their place
  pfx::Vec3 gravity = pfx::Vec3(0.0f, -kGravity, 0.0f);
};

pfx::WorldDef worldDef(const Case& accuracy_case);

std::span<const Case> cases();

// Null when there is none of this name.
const Case* findCase(std::string_view name);

// Families of cases, in the order of the table.
std::vector<Case> freeMotionCases();
std::vector<Case> jointCases();
std::vector<Case> frictionCases();
std::vector<Case> restCases();

}  // namespace samples::accuracy

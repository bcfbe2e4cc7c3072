// Joints of a world: who solves which component, and the step of components that nothing touches.
#include <algorithm>
#include <limits>

#include "pfx/base_level/joint/gear_angles.h"
#include "pfx/high_level/pipeline/stages.h"
#include "pfx/high_level/world/world_impl.h"

namespace pfx {
namespace {

constexpr float kMostSoftLoad = 128.0f;
constexpr size_t kMostDirectJoints = 500;
constexpr uint8_t kStaysSoft = 30;  // steps since a contact

bool isAwake(const RigidState& s) { return isDynamic(s.motion_type) && !s.asleep; }

// Joints whose bodies the solver can move; the rest holds nothing.
void listConstraints(World::Impl& w) {
  w.joint_constraints.clear();
  for (uint32_t i = 0; i < w.joint_store.joints.size(); ++i) {
    const JointLink& link = w.joint_store.links[i];
    if (!link.exists) continue;
    const RigidState &a = w.store.states[link.body_a], &b = w.store.states[link.body_b];
    if (!solvesConstraint(a.motion_type, b.motion_type)) continue;
    w.joint_constraints.push_back(
        {.joint = &w.joint_store.joints[i],
         .body_a = link.body_a,
         .body_b = link.body_b,
         .writable_a = isDynamic(a.motion_type) && b.motion_type != MotionType::OneWay,
         .writable_b = isDynamic(b.motion_type) && a.motion_type != MotionType::OneWay});
  }
}

// What the lightest body of a component may have to bear, in units of its own mass.
float loadOf(const World::Impl& w, const JointComponent& c) {
  float sum = 0.0f, least = std::numeric_limits<float>::infinity();
  for (uint32_t i : c.bodies) {
    if (!isDynamic(w.store.states[i].motion_type)) continue;
    sum += w.store.bodies[i].mass;
    least = std::min(least, w.store.bodies[i].mass);
  }
  return sum / least;
}

// Soft rows are several times cheaper than a direct solve, and stretch under heavy loads.
bool maySoften(const World::Impl& w, const JointComponent& c) {
  return w.def.joint_solver == JointSolver::Auto && loadOf(w, c) < kMostSoftLoad;
}

// Steps since a contact touched one of the bodies, as far as it matters.
uint8_t stepsSinceTouch(World::Impl& w, const JointComponent& c, bool touched) {
  uint8_t least = kStaysSoft;
  for (uint32_t i : c.bodies)
    if (isDynamic(w.store.states[i].motion_type)) least = std::min(least, w.since_touch[i]);
  if (least < kStaysSoft) ++least;
  if (touched) least = 0;
  for (uint32_t i : c.bodies) w.since_touch[i] = least;
  return least;
}

void assignSolver(World::Impl& w, JointComponent& c) {
  const auto is = [&](auto&& condition) { return std::any_of(c.bodies.begin(), c.bodies.end(), condition); };
  if (!is([&](uint32_t i) { return isAwake(w.store.states[i]); })) return;
  const bool touched = is([&](uint32_t i) {
    return isDynamic(w.store.states[i].motion_type) && w.solver_index[i] != kNoSolverBody;
  });
  for (uint32_t i : c.bodies) w.jointed[i] = 1;
  // Contacts and a direct solve only see each other through the bodies that they share. A blow on a light limb takes many
  // turns to stop what hangs on it, the impulses that pile up meanwhile take as many to go away again, and throw the whole
  // component. Soft rows in the same sweep as the contacts do not.
  const bool with_contacts = stepsSinceTouch(w, c, touched) < kStaysSoft;
  c.is_soft = !c.is_direct || ((with_contacts || stage::isJointCrowd(w)) && maySoften(w, c));
  if (!c.is_soft && !touched) {
    w.free_components.push_back(&c);
    return;
  }
  w.joint_step.add(c);
  for (uint32_t i : c.bodies) w.needSolverBody(i);
}

// The direct solver counts the turns of its gears itself, sub-step by sub-step.
void countTurns(World::Impl& w, const JointComponent& c) {
  for (const JointConstraint& k : c.joints) {
    Joint& j = *k.joint;
    if (j.kind != JointKind::Gear) continue;
    const RigidState &a = w.store.states[k.body_a], &b = w.store.states[k.body_b];
    const TransformDouble pose_a = toDouble(a.pose()), pose_b = toDouble(b.pose());
    const GearAngles rate = gearRates(j, pose_a, a.angular_velocity.cast<double>(), pose_b, b.angular_velocity.cast<double>());
    const double dt = w.dt;
    const GearAngles now = gearAnglesNear(j, pose_a, pose_b, {j.gear_angle_a + dt * rate.a, j.gear_angle_b + dt * rate.b});
    j.gear_angle_a = static_cast<float>(now.a), j.gear_angle_b = static_cast<float>(now.b);
  }
}

}  // namespace

namespace stage {

void countGears(World::Impl& w) {
  for (const JointComponent* c : w.joint_step.components())
    if (c->is_soft && c->has_gears) countTurns(w, *c);
}

bool isJointCrowd(const World::Impl& w) { return w.joint_constraints.size() > kMostDirectJoints; }

void gatherJoints(World::Impl& w) {
  listConstraints(w);
  w.joint_components.update(w.joint_constraints, static_cast<uint32_t>(w.store.states.size()),
                            w.def.joint_solver);
  w.jointed.assign(w.store.states.size(), 0);
  w.since_touch.resize(w.store.states.size(), kLongSinceTouch);
  // A body may belong to two components that are touched at different ends only when it is not movable.
  for (JointComponent& c : w.joint_components.components()) assignSolver(w, c);
  std::erase_if(w.free_bodies, [&](uint32_t i) { return w.jointed[i] != 0; });
}

void solveJointComponents(World::Impl& w) {
  const DirectStepParams params{.h = static_cast<double>(w.dt) / w.def.substeps,
                                .substeps = w.def.substeps,
                                .warm_start = w.def.pipeline != Pipeline::Simple};
  w.tasks.parallelFor(static_cast<uint32_t>(w.free_components.size()), 1, [&](TaskRange r) {
    for (uint32_t i = r.begin; i < r.end; ++i) {
      JointComponent& c = *w.free_components[i];
      beginComponent(w, c, params);
      c.direct.advance(w.store.states);
      c.direct.end();
    }
  });
}

void breakJoints(World::Impl& w) {
  w.broken_joints.clear();
  for (uint32_t i = 0; i < w.joint_store.joints.size(); ++i) {
    const Joint& j = w.joint_store.joints[i];
    if (j.force.norm() <= w.joint_store.break_force[i] && j.torque.norm() <= w.joint_store.break_torque[i])
      continue;
    w.broken_joints.push_back({i, w.joint_store.generations[i]});
  }
  for (JointId id : w.broken_joints) w.joint_store.remove(id.index);
}

}  // namespace stage
}  // namespace pfx

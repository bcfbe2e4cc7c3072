#include "pfx/low_level/solver/joint_components.h"

#include <algorithm>

namespace pfx {
namespace {

// A component is solved directly when each joint costs no more than this many block products a factor (a
// chain: one, a ragdoll: three), and when it has no more than this many loops a joint. The first keeps a hub
// with very many joints out, the second saves the attempt on nets and grids.
constexpr uint64_t kMaxProductsPerJoint = 24;
constexpr uint64_t kFreeProducts = 4096;
constexpr size_t kFreeLoops = 32;
constexpr size_t kJointsPerLoop = 16;

constexpr uint32_t kNobody = 0xffffffffu;

Link linkOf(const JointConstraint& c) {
  return {c.writable_a ? c.body_a : kNobody, c.writable_b ? c.body_b : kNobody};
}

// What the choice of rows depends on, five bits an axis.
uint32_t rowsOf(const Joint& j) {
  uint32_t bits = 0;
  for (const AxisConstraint& c : j.axis) {
    const uint32_t drives = (c.damping > 0.0f) | (c.motor_max_force > 0.0f) | (c.spring_frequency > 0.0f);
    bits = bits << 5 | static_cast<uint32_t>(c.lock) << 3 | drives << 2 | (c.lower == c.upper ? 2u : 0u) |
           (isConstrained(c) ? 1u : 0u);
  }
  return bits;
}

}  // namespace

bool JointComponents::update(std::span<const JointConstraint> joints, uint32_t num_bodies,
                             JointSolver solver) {
  const bool same =
      solver_ == solver && joints_.size() == joints.size() && std::equal(joints.begin(), joints.end(), joints_.begin());
  bool same_rows = same;
  rows_.resize(joints.size());
  for (size_t i = 0; i < joints.size(); ++i) {
    const uint32_t rows = rowsOf(*joints[i].joint);
    same_rows &= rows == rows_[i];
    rows_[i] = rows;
  }
  if (same_rows) return false;
  solver_ = solver;
  joints_.assign(joints.begin(), joints.end());
  components_.clear();
  Vector<uint32_t> movable;
  Vector<Link> links;
  for (const JointConstraint& c : joints_) {
    links.push_back(linkOf(c));
    if (c.writable_a) movable.push_back(c.body_a);
    if (c.writable_b) movable.push_back(c.body_b);
  }
  std::sort(movable.begin(), movable.end());
  movable.erase(std::unique(movable.begin(), movable.end()), movable.end());
  islands_.build(num_bodies, movable, links);
  component_of_.resize(joints_.size());
  for (uint32_t k = 0; k < islands_.size(); ++k) {
    for (uint32_t joint : islands_.links(k)) component_of_[joint] = k;
    addComponent(islands_.links(k), solver);
  }
  return true;
}

void JointComponents::addComponent(std::span<const uint32_t> joints, JointSolver solver) {
  JointComponent& c = components_.emplace_back();
  size_t inner = 0;
  Vector<uint32_t> movable;
  for (uint32_t i : joints) {
    const JointConstraint& j = joints_[i];
    c.joints.push_back(j);
    c.has_gears = c.has_gears || j.joint->kind == JointKind::Gear;
    c.bodies.insert(c.bodies.end(), {j.body_a, j.body_b});
    inner += j.writable_a && j.writable_b;
    if (j.writable_a) movable.push_back(j.body_a);
    if (j.writable_b) movable.push_back(j.body_b);
  }
  for (auto* list : {&c.bodies, &movable}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  const size_t loops = inner + 1 - std::min(inner + 1, movable.size());
  const uint64_t most = kFreeProducts + kMaxProductsPerJoint * c.joints.size();
  const bool tried = solver == JointSolver::Direct ||
                     (solver == JointSolver::Auto && loops <= kFreeLoops + c.joints.size() / kJointsPerLoop);
  c.is_direct = tried && c.direct.build(c.joints, solver == JointSolver::Direct ? 256 * most : most);
  c.motions.resize(c.bodies.size());
  c.solver_index.resize(c.bodies.size());
}

}  // namespace pfx

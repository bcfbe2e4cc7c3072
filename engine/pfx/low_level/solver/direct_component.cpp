#include "pfx/low_level/solver/direct_component.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pfx/low_level/solver/direct_factor.h"

namespace pfx {
namespace {

constexpr int kMaxIterations = 12;  // solves a sub-step; two are the rule, changes of limits take the rest

// Iterations end where rounding no longer lets the residual fall by this factor.
constexpr double kStagnation = 0.9;

// What the diagonal is enlarged by: enough to make the factor exist, too little to be seen. Rows of loops may depend on
// each other; there it also decides how loads are shared. Where loops have as many rows as their bodies can move, such as
// those of hinges, some do depend: frames rounded to floats do not fit each other, and the forces of that misfit must stay
// small beside those of the motion. Less than 1e-4 gave Bennett's loop 2 % of energy, and let a parallelogram fold.
constexpr double kOpenRegularization = 1e-9;
constexpr double kClosedRegularization = 1e-6;
constexpr double kRedundantRegularization = 1e-4;

// Near a pose in which a loop loses a row (all bars of a parallelogram in one line) a solve may make things worse, this
// many times. It is taken back, and the diagonal enlarged further: the step is shorter there, and the pose is passed.
// Source: J. Nocedal, S. Wright, Numerical Optimization, 2006, section 10.3 (Levenberg and Marquardt's method).
constexpr double kDiverging = 10.0;
constexpr double kSingularRegularization = 1e-3;

// From the first ratio of h^2 |K| to the inertia on (see stiffnessRatio), a component takes damped sub-steps
// with the geometric stiffness of those bodies for which it is more than a tenth of the inertia, until it
// falls below the second. Below, leapfrog resolves every vibration and conserves energy.
constexpr double kUnresolved = 1.0;
constexpr double kResolvedAgain = 0.05;
constexpr double kStiffnessShare = 0.1;

double dot6(const double (&a)[6], const double (&b)[6]) {
  return (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) + (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

void addOwnBlock(const DirectJoint& j, double regularization, int n, double* out, DirectRow* rows) {
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) out[i * n + k] = 0.0;
    if (i >= j.num_rows || !j.row[i].held) {
      out[i * n + i] = 1.0;
      continue;
    }
    for (int k = 0; k < j.num_rows; ++k) {
      if (!j.row[k].held) continue;
      for (int side = 0; side < 2; ++side)
        if (j.moves[side]) out[i * n + k] += dot6(j.jacobian[side][i], j.response[side][k]);
    }
    DirectRow& r = rows[i];
    r.diagonal = out[i * n + i];
    const double compliance = r.state == RowState::Drive ? r.drive_compliance : r.softness * r.diagonal;
    out[i * n + i] += regularization * r.diagonal + compliance;
    if (!(out[i * n + i] > 0.0)) out[i * n + i] = 1.0;
  }
}

// Whether what is left without the branches that hang on loops has at least as many equations as ways to move.
bool haveRedundantLoops(std::span<const DirectJoint> joints, size_t num_bodies) {
  std::vector<uint32_t> degree(num_bodies, 0);
  std::vector<uint8_t> in_loop(joints.size(), 1);
  const auto count = [&](const DirectJoint& j, uint32_t by) {
    for (int side = 0; side < 2; ++side)
      if (j.moves[side]) degree[j.body[side]] += by;
  };
  const auto ends = [&](const DirectJoint& j) {
    return (j.moves[0] && degree[j.body[0]] == 1) || (j.moves[1] && degree[j.body[1]] == 1);
  };
  for (const DirectJoint& j : joints) count(j, 1u);
  for (bool changed = true; changed;) {
    changed = false;
    for (size_t i = 0; i < joints.size(); ++i) {
      if (!in_loop[i] || !ends(joints[i])) continue;
      in_loop[i] = 0, changed = true;
      count(joints[i], ~0u);
    }
  }
  size_t rows = 0;
  for (size_t i = 0; i < joints.size(); ++i)
    for (int k = 0; k < joints[i].num_rows; ++k) rows += in_loop[i] && joints[i].row[k].state == RowState::Fixed;
  const auto moving = static_cast<size_t>(std::ranges::count_if(degree, [](uint32_t d) { return d > 0; }));
  return rows > 0 && rows >= 6 * moving;
}

}  // namespace

bool DirectComponent::build(std::span<const JointConstraint> joints, uint64_t max_products) {
  body_index_.clear();
  for (const JointConstraint& c : joints) body_index_.insert(body_index_.end(), {c.body_a, c.body_b});
  std::sort(body_index_.begin(), body_index_.end());
  body_index_.erase(std::unique(body_index_.begin(), body_index_.end()), body_index_.end());
  const auto local = [&](uint32_t body) {
    return static_cast<uint32_t>(std::lower_bound(body_index_.begin(), body_index_.end(), body) -
                                 body_index_.begin());
  };
  joints_.clear();
  Vector<JointEnds> ends;
  Vector<uint8_t> moved(body_index_.size(), 0);
  int most_rows = 0;
  for (const JointConstraint& c : joints) {
    DirectJoint j = {};
    j.joint = c.joint;
    j.body[0] = local(c.body_a), j.body[1] = local(c.body_b);
    j.moves[0] = c.writable_a, j.moves[1] = c.writable_b;
    for (int side = 0; side < 2; ++side) moved[j.body[side]] |= j.moves[side];
    chooseRows(j);
    most_rows = std::max(most_rows, j.num_rows);
    joints_.push_back(j);
    ends.push_back({{j.body[0], j.body[1]}, {j.moves[0], j.moves[1]}});
  }
  if (!buildDirectStructure(ends, static_cast<uint32_t>(body_index_.size()), max_products, structure_))
    return false;

  const size_t n = joints_.size();
  closed_ = n > static_cast<size_t>(std::count(moved.begin(), moved.end(), 1));
  redundant_ = closed_ && haveRedundantLoops(joints_, body_index_.size());
  block_ = most_rows <= 3 ? 3 : most_rows <= 5 ? 5 : 6;
  const size_t size = static_cast<size_t>(block_) * block_;
  position_.resize(n);
  size_t longest = 0;
  for (uint32_t p = 0; p < n; ++p) {
    position_[structure_.order[p]] = p;
    longest = std::max<size_t>(longest, structure_.column_begin[p + 1] - structure_.column_begin[p]);
  }
  diagonal_.assign(n * size, 0.0);
  off_diagonal_.assign(structure_.entries.size() * size, 0.0);
  scratch_.assign(std::max<size_t>(longest, 1) * size, 0.0);
  x_.assign(2 * n * block_, 0.0);  // the second half: the last solution
  return true;
}

void DirectComponent::begin(std::span<const RigidState> states, std::span<const RigidBody> bodies,
                            std::span<const BodyMotion> motions, const DirectStepParams& params) {
  params_ = params;
  linearized_ = started_ = false;
  bodies_.resize(body_index_.size());
  start_.resize(body_index_.size());
  for (size_t i = 0; i < body_index_.size(); ++i) {
    bodies_[i] = makeDirectBody(states[body_index_[i]], bodies[body_index_[i]], motions[i]);
    start_[i] = bodies_[i].pose;
  }
  for (DirectJoint& j : joints_) beginRows(j, bodies_, params.substeps, params.warm_start);
}

void DirectComponent::linearize(const DirectSubstep& s) {
  for (DirectBody& b : bodies_) {
    b.stiffness.setZero();
    updateInverseInertia(b, s.h, false);
  }
  for (DirectJoint& j : joints_) linearizeRows(j, bodies_, s);
  for (const DirectJoint& j : joints_) addStiffness(j, bodies_);
  double ratio = 0.0;
  for (const DirectBody& b : bodies_) ratio = std::max(ratio, stiffnessRatio(b, s.h));
  stiff_ = ratio > (stiff_ ? kResolvedAgain : kUnresolved);
  if (!stiff_) return;
  for (DirectBody& b : bodies_) updateInverseInertia(b, s.h, stiffnessRatio(b, s.h) > kStiffnessShare);
  for (DirectJoint& j : joints_) updateResponses(j, bodies_);
}

double DirectComponent::regularization() const {
  if (redundant_) return kRedundantRegularization;
  return closed_ ? kClosedRegularization : kOpenRegularization;
}

void DirectComponent::factor(double regularization) {
  const int n = block_;
  const size_t size = static_cast<size_t>(n) * n;
  for (size_t i = 0; i < joints_.size(); ++i)
    addOwnBlock(joints_[i], regularization, n, &diagonal_[position_[i] * size], joints_[i].row);
  std::fill(off_diagonal_.begin(), off_diagonal_.end(), 0.0);
  for (const DirectStructure::Coupling& c : structure_.couplings) {
    const DirectJoint &a = joints_[c.joint_row], &b = joints_[c.joint_column];
    double* out = &off_diagonal_[c.block * size];
    for (int i = 0; i < a.num_rows; ++i) {
      if (!a.row[i].held) continue;
      for (int k = 0; k < b.num_rows; ++k)
        if (b.row[k].held) out[i * n + k] += dot6(a.jacobian[c.side_row][i], b.response[c.side_column][k]);
    }
  }
  const DirectBlocks blocks{diagonal_, off_diagonal_};
  if (n == 3) return factorDirect<3>(structure_, blocks, scratch_);
  if (n == 5) return factorDirect<5>(structure_, blocks, scratch_);
  factorDirect<6>(structure_, blocks, scratch_);
}

void DirectComponent::solve() {
  const DirectBlocks blocks{diagonal_, off_diagonal_};
  if (block_ == 3) return solveDirect<3>(structure_, blocks, x_);
  if (block_ == 5) return solveDirect<5>(structure_, blocks, x_);
  solveDirect<6>(structure_, blocks, x_);
}

// Right-hand side; returns the worst residual over its tolerance. What the regularisation lets through is
// asked for only up to the regularised system's own solution, so that impulses do not grow from sub-step to
// sub-step.
double DirectComponent::fillResiduals(const DirectSubstep& s, bool velocity_only) {
  const double give = regularization();
  double worst = 0.0;
  std::copy_n(x_.begin(), x_.size() / 2, x_.begin() + static_cast<std::ptrdiff_t>(x_.size() / 2));
  std::fill_n(x_.begin(), x_.size() / 2, 0.0);
  for (size_t i = 0; i < joints_.size(); ++i) {
    const DirectJoint& j = joints_[i];
    for (int k = 0; k < j.num_rows; ++k) {
      const DirectRow& r = j.row[k];
      if (!r.held) continue;
      const RowResidual residual = rowResidual(j, k, bodies_, s, velocity_only);
      const double speed = residual.speed - give * r.diagonal * r.impulse;
      x_[position_[i] * block_ + k] = speed;
      worst = std::max(worst, std::abs(speed) / residual.tolerance);
    }
  }
  return worst;
}

void DirectComponent::applySolution() {
  for (size_t i = 0; i < joints_.size(); ++i) {
    DirectJoint& j = joints_[i];
    for (int k = 0; k < j.num_rows; ++k) {
      if (!j.row[k].held) continue;
      const double change = x_[position_[i] * block_ + k];
      j.row[k].impulse += change;
      applyRow(j, k, change, bodies_);
    }
  }
}

// Of the last solution, after the residuals of what it led to were filled in.
void DirectComponent::takeBackSolution() {
  const size_t last = x_.size() / 2;
  for (size_t i = 0; i < joints_.size(); ++i) {
    DirectJoint& j = joints_[i];
    for (int k = 0; k < j.num_rows; ++k) {
      if (!j.row[k].held) continue;
      const double change = x_[last + position_[i] * block_ + k];
      j.row[k].impulse -= change;
      applyRow(j, k, -change, bodies_);
    }
  }
}

void DirectComponent::predictAll(double h) {
  for (DirectBody& b : bodies_) predict(b, h);
  for (DirectJoint& j : joints_) measureNext(j, bodies_, h);
}

bool DirectComponent::update(bool velocity_only, bool first) {
  bool changed = false;
  for (DirectJoint& j : joints_) changed |= updateRows(j, bodies_, velocity_only, first);
  return changed;
}

// Newton's method on the positions at the end of the sub-step, with one factor as long as the rows stay the
// same.
void DirectComponent::holdPositions(const DirectSubstep& s) {
  double last = std::numeric_limits<double>::infinity(), before = last, strength = regularization();
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    predictAll(s.h);
    const bool changed = update(false, iteration == 0);
    if (changed || !linearized_) {
      factor(strength);
      linearized_ = true;
    }
    const double worst = fillResiduals(s, false);
    if (!changed && worst > kDiverging * before) {
      takeBackSolution();
      strength = kSingularRegularization;
      factor(strength);
      predictAll(s.h);
      fillResiduals(s, false);
      solve();
      applySolution();
      continue;
    }
    if (!changed && (worst < 1.0 || worst > kStagnation * last)) return;
    last = changed ? std::numeric_limits<double>::infinity() : worst;
    before = worst;
    solve();
    applySolution();
  }
  predictAll(s.h);
}

void DirectComponent::holdVelocities(const DirectSubstep& s) {
  double last = std::numeric_limits<double>::infinity(), before = last, strength = regularization();
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const bool changed = update(true, iteration == 0);
    if (changed || !linearized_) {
      factor(strength);
      linearized_ = true;
    }
    const double worst = fillResiduals(s, true);
    if (!changed && worst > kDiverging * before) {
      takeBackSolution();
      strength = kSingularRegularization;
      factor(strength);
      fillResiduals(s, true);
      solve();
      applySolution();
      continue;
    }
    if (!changed && (worst < 1.0 || worst > kStagnation * last)) return;
    last = changed ? std::numeric_limits<double>::infinity() : worst;
    before = worst;
    solve();
    applySolution();
  }
}

// Starts from the forces of the last sub-step.
void DirectComponent::startFrom(double part) {
  for (DirectJoint& j : joints_) {
    for (int k = 0; k < j.num_rows; ++k) {
      DirectRow& r = j.row[k];
      const bool acts = r.state != RowState::Off;
      r.impulse = acts ? static_cast<double>(j.joint->axis[r.axis].force) * part * params_.h : 0.0;
      if (acts) applyRow(j, k, r.impulse, bodies_);
    }
  }
}

void DirectComponent::rememberForces(double part) {
  for (DirectJoint& j : joints_)
    for (int k = 0; k < j.num_rows; ++k)
      j.joint->axis[j.row[k].axis].force = static_cast<float>(j.row[k].impulse / (part * params_.h));
}

void DirectComponent::sumImpulses() {
  for (DirectJoint& j : joints_) pfx::sumImpulses(j, bodies_);
}

void DirectComponent::advance(std::span<RigidState> states) {
  const double h = params_.h;
  for (int i = 0; i < params_.substeps; ++i) {
    DirectSubstep s{h, i == 0 ? 0.5 : 1.0, true, false};
    linearize(s);
    s.linear = stiff_;
    linearized_ = false;
    for (DirectBody& b : bodies_) kick(b, h, s.part);
    startFrom(s.part);
    holdPositions(s);
    rememberForces(s.part);
    sumImpulses();
    for (DirectBody& b : bodies_) b.pose = b.next, b.w = b.next_w;
  }
  const DirectSubstep last{h, 0.5, true, false};
  linearize(last);
  linearized_ = false;
  for (DirectBody& b : bodies_) kick(b, h, last.part);
  startFrom(last.part);
  holdVelocities(last);
  sumImpulses();
  for (size_t i = 0; i < bodies_.size(); ++i) {
    const DirectBody& b = bodies_[i];
    if (!b.dynamic) continue;
    RigidState& s = states[body_index_[i]];
    s.position = b.pose.position.cast<float>();
    s.orientation = b.pose.orientation.cast<float>().normalized();
    s.linear_velocity = b.v.cast<float>();
    s.angular_velocity = b.w.cast<float>();
  }
}

void DirectComponent::load(std::span<const SolverBody> bodies, std::span<const uint32_t> solver_index) {
  for (size_t i = 0; i < bodies_.size(); ++i) {
    const SolverBody& s = bodies[solver_index[i]];
    DirectBody& b = bodies_[i];
    b.pose.position = start_[i].position + Vec3d(s.dp[0], s.dp[1], s.dp[2]);
    b.pose.orientation = (Quatd(s.dq[3], s.dq[0], s.dq[1], s.dq[2]) * start_[i].orientation).normalized();
    b.v = Vec3d(s.v[0], s.v[1], s.v[2]);
    b.w = Vec3d(s.w[0], s.w[1], s.w[2]);
  }
}

// Also notes what the joints have changed since the bodies were loaded.
void DirectComponent::store(std::span<SolverBody> bodies, std::span<const uint32_t> solver_index) {
  for (size_t i = 0; i < bodies_.size(); ++i) {
    DirectBody& b = bodies_[i];
    if (!b.dynamic) continue;
    SolverBody& s = bodies[solver_index[i]];
    b.joint_velocity += b.v - Vec3d(s.v[0], s.v[1], s.v[2]);
    const Quatd& q = b.pose.orientation;
    b.joint_momentum += q * (b.body_inertia * (q.conjugate() * (b.w - Vec3d(s.w[0], s.w[1], s.w[2]))));
    for (int k = 0; k < 3; ++k) s.v[k] = static_cast<float>(b.v[k]), s.w[k] = static_cast<float>(b.w[k]);
  }
}

// The bodies start a sub-step with the impulses of the last one (see substep.h), joints included. Those of
// joints have to follow the levers: a force that lags behind a swinging body would feed it energy.
void DirectComponent::startSubstep(std::span<SolverBody> bodies, std::span<const uint32_t> solver_index) {
  load(bodies, solver_index);
  if (!started_) {
    linearize({params_.h, 1.0, false, false});
    linearized_ = false;
    started_ = true;
  }
  for (size_t i = 0; i < bodies_.size(); ++i) {
    DirectBody& b = bodies_[i];
    if (!b.dynamic) continue;
    const Quatd& q = b.pose.orientation;
    b.v -= b.joint_velocity;
    b.w -= q * (b.body_inverse * (q.conjugate() * b.joint_momentum));
    SolverBody& s = bodies[solver_index[i]];
    for (int k = 0; k < 3; ++k) s.v[k] = static_cast<float>(b.v[k]), s.w[k] = static_cast<float>(b.w[k]);
    b.joint_velocity = b.joint_momentum = Vec3d::Zero();
  }
  startFrom(1.0);
  store(bodies, solver_index);
}

void DirectComponent::solvePositions(std::span<SolverBody> bodies, std::span<const uint32_t> solver_index) {
  const DirectSubstep s{params_.h, 1.0, false, stiff_};
  load(bodies, solver_index);
  holdPositions(s);
  store(bodies, solver_index);
}

void DirectComponent::solveVelocities(std::span<SolverBody> bodies, std::span<const uint32_t> solver_index) {
  const DirectSubstep s{params_.h, 1.0, false, false};
  load(bodies, solver_index);
  linearize(s);
  linearized_ = false;
  holdVelocities(s);
  rememberForces(1.0);
  sumImpulses();
  store(bodies, solver_index);
}

void DirectComponent::end() {
  for (DirectJoint& j : joints_) reportForces(j, params_.h * params_.substeps);
}

}  // namespace pfx

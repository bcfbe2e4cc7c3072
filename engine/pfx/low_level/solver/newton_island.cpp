// The step of an island: what is solved, in which order.
#include "pfx/low_level/solver/newton_island.h"

#include <algorithm>
#include <cmath>

namespace pfx {
namespace {

constexpr double kPressed = 2.0;  // of the weight of the island: what carries more is pressed by something else
constexpr double kStiffening = 8.0;
constexpr int kMostStiffenings = 7;

// Geometric stiffness counts where h^2 |K| is more than this share of the inertia, see stiffnessRatio.
constexpr double kStiffnessShare = 0.1;

// No body leaves an island at more than this many times the largest speed before, and this speed (m/s) besides.
constexpr double kMostGain = 4.0, kMostSpeed = 3.0;

// Displacement of the end of `arm` by the turn since the start of the step; on a round body only what a
// rolling contact point follows, see contactShift in contact_kernels_lanes.h.
Vec3d shiftOf(const Quatd& turn, const Vec3d& arm, bool round) {
  const Vec3d t = 2.0 * turn.vec().cross(arm);
  if (round) return t;
  return turn.w() * t + turn.vec().cross(t);
}

double inverseMassAlong(const DirectBody& b, const double (&turn)[3]) {
  const Vec3d t(turn[0], turn[1], turn[2]);
  return b.inv_mass + t.dot(b.inverse * t);
}

void setTurns(NewtonPoint& p, const NewtonContact& c, const Vec3d (&friction_arm)[2]) {
  for (int side = 0; side < 2; ++side)
    for (int k = 0; k < 3; ++k) {
      const Vec3d t = (k == 0 ? p.arm[side] : friction_arm[side]).cross(c.axis[k]);
      for (int i = 0; i < 3; ++i) p.turn[side][k][i] = t[i];
    }
}

}  // namespace

uint32_t NewtonIsland::localOf(uint32_t body) const {
  return static_cast<uint32_t>(std::lower_bound(body_index_.begin(), body_index_.end(), body) - body_index_.begin());
}

void NewtonIsland::addJoint(const JointConstraint& constraint) {
  joints_.push_back(makeNewtonJoint(constraint, {localOf(constraint.body_a), localOf(constraint.body_b)}));
  pfx::begin(joints_.back(), bodies_, params_.h, params_.substeps);
}

void NewtonIsland::addContact(const ContactConstraint& constraint) {
  const ContactManifold& m = *constraint.manifold;
  NewtonContact& c = contacts_.emplace_back();
  c.manifold = constraint.manifold;
  c.body[0] = localOf(constraint.solver_a), c.body[1] = localOf(constraint.solver_b);
  c.moves[0] = constraint.writable_a, c.moves[1] = constraint.writable_b;
  c.round[0] = constraint.round_a, c.round[1] = constraint.round_b;
  c.num_points = m.num_points;
  c.friction = constraint.friction, c.restitution = constraint.restitution;
  c.axis[0] = m.normal.cast<double>().normalized();
  c.axis[1] = tangents(m.normal).t1.cast<double>();
  c.axis[1] = (c.axis[1] - c.axis[1].dot(c.axis[0]) * c.axis[0]).normalized();
  c.axis[2] = c.axis[0].cross(c.axis[1]);
  const DirectBody* body[2] = {&bodies_[c.body[0]], &bodies_[c.body[1]]};
  Vec3d center[2] = {Vec3d::Zero(), Vec3d::Zero()};
  double carried = 0.0;
  for (int i = 0; i < m.num_points; ++i) carried += static_cast<double>(m.points[i].normal_impulse) / m.num_points;
  for (int i = 0; i < m.num_points; ++i) {
    NewtonPoint& p = c.points[i];
    p.arm[0] = body[0]->pose.orientation * m.points[i].local_a.cast<double>();
    p.arm[1] = body[1]->pose.orientation * m.points[i].local_b.cast<double>();
    for (int side = 0; side < 2; ++side) center[side] += p.arm[side] / m.num_points;
  }
  const auto spread = static_cast<double>(frictionSpread(constraint));
  for (int i = 0; i < m.num_points; ++i) {
    NewtonPoint& p = c.points[i];
    const Vec3d friction_arm[2] = {center[0] + spread * (p.arm[0] - center[0]), center[1] + spread * (p.arm[1] - center[1])};
    setTurns(p, c, friction_arm);
    p.separation = m.points[i].distance;
    double inverse_mass[2] = {0.0, 0.0};
    for (int side = 0; side < 2; ++side) {
      if (!c.moves[side]) continue;
      inverse_mass[0] += inverseMassAlong(*body[side], p.turn[side][0]);
      inverse_mass[1] += 0.5 * (inverseMassAlong(*body[side], p.turn[side][1]) +
                                inverseMassAlong(*body[side], p.turn[side][2]));
    }
    p.impulse[0] = m.points[i].normal_impulse;
    setStiffness(p, inverse_mass, {weight_ * params_.h / m.num_points, carried});
    const Vec3d friction = m.points[i].friction_impulse.cast<double>();
    p.impulse[1] = friction.dot(c.axis[1]), p.impulse[2] = friction.dot(c.axis[2]);
    rowSpeeds(c, p, velocityOf(c.body[0]), velocityOf(c.body[1]), p.speed);
    // where the surfaces meet: with acceleration a and separation s, v'^2 = v^2 - 2 a s
    const double along = c.axis[0].dot(body[1]->acceleration - body[0]->acceleration);
    p.approach = p.speed[0] < 0.0
                     ? -std::sqrt(std::max(p.speed[0] * p.speed[0] - 2.0 * along * p.separation, 0.0))
                     : p.speed[0];
    p.most_normal = 0.0;
    std::fill(p.curvature, p.curvature + 4, -1.0);
  }
}

// No contact is pressed in by more than a share of the size of its bodies, even by the weight of the whole island. What
// it carries at the moment must not decide, the load would swing with its own stiffness; unless it is far above that weight,
// as under a motor, and then in large steps.
void NewtonIsland::setStiffness(NewtonPoint& p, const double (&inverse_mass)[2], const Load& load) const {
  for (int k = 0; k < 2; ++k) p.stiffness[k] = 1.0 / (params_.give * inverse_mass[k]);
  const double size = std::min(p.arm[0].norm(), p.arm[1].norm());
  const double deepest = params_.max_overlap * size * params_.push_rate / params_.h;  // m/s, its push
  p.stiffness[0] = std::max(p.stiffness[0], load.weight / deepest);
  if (load.carried < kPressed * load.weight) return;
  for (int i = 0; i < kMostStiffenings && load.carried > p.stiffness[0] * deepest; ++i) p.stiffness[0] *= kStiffening;
}

void NewtonIsland::makeStructure() {
  links_.clear();
  for (const NewtonContact& c : contacts_)
    if (c.moves[0] && c.moves[1]) links_.push_back({block_of_[c.body[0]], block_of_[c.body[1]]});
  for (const NewtonJoint& n : joints_)
    if (n.joint.moves[0] && n.joint.moves[1])
      links_.push_back({block_of_[n.joint.body[0]], block_of_[n.joint.body[1]]});
  const auto n = static_cast<uint32_t>(moving_.size());
  if (elimination_.update(links_, n)) {
    const DirectStructure& s = elimination_.structure();
    size_t longest = 1;
    for (uint32_t p = 0; p < n; ++p)
      longest = std::max<size_t>(longest, s.column_begin[p + 1] - s.column_begin[p]);
    diagonal_.resize(size_t(n) * 36);
    off_diagonal_.resize(s.entries.size() * 36);
    scratch_.resize(longest * 36);
    x_.resize(size_t(n) * 6);
  }
  const auto couple = [&](auto& constraint, const uint32_t (&body)[2], const bool (&moves)[2]) {
    if (!moves[0] || !moves[1]) return;
    const uint32_t a = elimination_.position(block_of_[body[0]]), b = elimination_.position(block_of_[body[1]]);
    constraint.a_is_row = a > b;
    constraint.block = findBlock(elimination_.structure(), std::max(a, b), std::min(a, b));
  };
  for (NewtonContact& c : contacts_) couple(c, c.body, c.moves);
  for (NewtonJoint& j : joints_) couple(j, j.joint.body, j.joint.moves);
}

void NewtonIsland::begin(std::span<const RigidState> states, std::span<const RigidBody> rigid_bodies,
                         const NewtonIslandDef& island, const NewtonParams& params) {
  const std::span<const uint32_t> bodies = island.bodies;
  params_ = params;
  body_index_ = bodies;
  iterations_ = 0;
  factored_ = false;
  bodies_.resize(bodies.size());
  start_.resize(bodies.size());
  block_of_.resize(bodies.size());
  inertia_.resize(bodies.size());
  moving_.clear();
  for (auto* v : {&velocity_, &free_velocity_, &direction_, &gradient_}) v->assign(bodies.size() * 6, 0.0);
  for (uint32_t i = 0; i < bodies.size(); ++i) {
    DirectBody& b = bodies_[i] = makeDirectBody(states[bodies[i]], rigid_bodies[bodies[i]], island.motions[i]);
    updateInverseInertia(b, params.h, false);
    start_[i] = b.pose;
    for (int k = 0; k < 3; ++k) velocityOf(i)[k] = b.v[k], velocityOf(i)[3 + k] = b.w[k];
    if (!b.dynamic) continue;
    block_of_[i] = static_cast<uint32_t>(moving_.size());
    moving_.push_back(i);
  }
  joints_.clear();
  for (const JointConstraint& c : island.joints) addJoint(c);
  weight_ = 0.0;
  for (uint32_t i : moving_) weight_ += bodies_[i].acceleration.norm() / bodies_[i].inv_mass;
  for (const NewtonJoint& n : joints_) weight_ += strengthOf(n);
  contacts_.clear();
  for (const ContactConstraint& c : island.contacts) addContact(c);
  makeStructure();
}

// Light bodies between heavily loaded joints turn with more inertia where a sub-step cannot follow their vibration.
void NewtonIsland::updateMass() {
  for (uint32_t i : moving_) {
    DirectBody& b = bodies_[i];
    const bool stiffen = !joints_.empty() && stiffnessRatio(b, params_.h) > kStiffnessShare;
    updateInverseInertia(b, params_.h, stiffen);
    const Mat3d r = b.pose.orientation.toRotationMatrix();
    inertia_[i] = stiffen       ? Mat3d(b.inverse.inverse())
                  : b.spherical ? b.body_inertia
                                : Mat3d(r * b.body_inertia * r.transpose());
  }
}

void NewtonIsland::linearizeJoints(bool push) {
  if (joints_.empty()) return;
  factored_ = false;
  for (uint32_t i : moving_) {
    updateInverseInertia(bodies_[i], params_.h, false);
    bodies_[i].stiffness.setZero();
  }
  for (NewtonJoint& n : joints_) linearize(n, bodies_, params_.h, push);
  for (const NewtonJoint& n : joints_) addStiffness(n.joint, bodies_);
}

// Forces, and as a first guess the impulses of the last sub-step.
void NewtonIsland::startSubstep() {
  linearizeJoints(true);
  updateMass();
  for (uint32_t i : moving_) {
    DirectBody& b = bodies_[i];
    kick(b, params_.h, 1.0);
    double* v = &free_velocity_[size_t(i) * 6];
    for (int k = 0; k < 3; ++k) v[k] = b.v[k], v[3 + k] = b.w[k];
  }
  std::fill(gradient_.begin(), gradient_.end(), 0.0);
  for (const NewtonContact& c : contacts_)
    for (int i = 0; i < c.num_points; ++i)
      addImpulse(c, c.points[i], 1.0, &gradient_[size_t(c.body[0]) * 6], &gradient_[size_t(c.body[1]) * 6]);
  for (const NewtonJoint& n : joints_)
    addImpulses(n, 1.0, &gradient_[size_t(n.joint.body[0]) * 6], &gradient_[size_t(n.joint.body[1]) * 6]);
  tolerance_ = 0.0;
  for (uint32_t i : moving_) {
    const DirectBody& b = bodies_[i];
    const double* p = &gradient_[size_t(i) * 6];
    const Vec3d dv = b.inv_mass * Vec3d(p[0], p[1], p[2]), dw = b.inverse * Vec3d(p[3], p[4], p[5]);
    const double* free = &free_velocity_[size_t(i) * 6];
    for (int k = 0; k < 3; ++k)
      velocityOf(i)[k] = free[k] + dv[k], velocityOf(i)[3 + k] = free[3 + k] + dw[k];
    tolerance_ = std::max({tolerance_, dv.norm(), params_.h * b.acceleration.norm()});
  }
  tolerance_ = 1e-5 * tolerance_ + 1e-12;
}

void NewtonIsland::setBias(bool push) {
  for (NewtonContact& c : contacts_) {
    const DirectBody &a = bodies_[c.body[0]], &b = bodies_[c.body[1]];
    const Quatd turn_a = a.pose.orientation * start_[c.body[0]].orientation.conjugate();
    const Quatd turn_b = b.pose.orientation * start_[c.body[1]].orientation.conjugate();
    const Vec3d shift =
        (b.pose.position - start_[c.body[1]].position) - (a.pose.position - start_[c.body[0]].position);
    for (int i = 0; i < c.num_points; ++i) {
      NewtonPoint& p = c.points[i];
      const double s = p.separation + c.axis[0].dot(shift + (shiftOf(turn_b, p.arm[1], c.round[1]) -
                                                             shiftOf(turn_a, p.arm[0], c.round[0])));
      const double rate = s > 0.0 ? 1.0 / params_.h : push ? params_.push_rate / params_.h : 0.0;
      p.bias = std::max(rate * s, -params_.max_push_speed);
      p.base[0] = push ? 0.0 : p.impulse[0];
      p.base[1] = p.impulse[1], p.base[2] = p.impulse[2];
    }
  }
}

void NewtonIsland::move() {
  for (uint32_t i = 0; i < bodies_.size(); ++i) {
    DirectBody& b = bodies_[i];
    const double* v = velocityOf(i);
    b.v = Vec3d(v[0], v[1], v[2]), b.w = Vec3d(v[3], v[4], v[5]);
    predict(b, params_.h);
  }
  for (NewtonJoint& n : joints_) measureNext(n.joint, bodies_, params_.h);
  for (uint32_t i = 0; i < bodies_.size(); ++i) {
    DirectBody& b = bodies_[i];
    const Quatd before = b.pose.orientation;
    b.pose = b.next;
    if (!b.dynamic) continue;
    double* free = &free_velocity_[size_t(i) * 6];
    const auto turned = [&](const Vec3d& w) {  // keeps the angular momentum
      if (b.spherical) return w;
      const Vec3d l = before * (b.body_inertia * (before.conjugate() * w));
      return Vec3d(b.pose.orientation * (b.body_inverse * (b.pose.orientation.conjugate() * l)));
    };
    const Vec3d w = turned(Vec3d(free[3], free[4], free[5]));
    for (int k = 0; k < 3; ++k) free[3 + k] = w[k], velocityOf(i)[3 + k] = b.next_w[k];
  }
}

// Speeds after impacts: what hit something leaves it with restitution times the speed of its approach, and
// what touches stays apart. Solved twice from the impulses found, so that no compliance is left in the
// answer.
void NewtonIsland::bounce() {
  bool any = false;
  for (NewtonContact& c : contacts_) {
    for (int i = 0; i < c.num_points; ++i) {
      NewtonPoint& p = c.points[i];
      const bool bounces =
          c.restitution > 0.0 && p.approach < -params_.restitution_threshold && p.most_normal > 0.0;
      any = any || bounces;
      if (bounces) p.bias = c.restitution * p.approach;
    }
  }
  if (!any) return;
  for (int pass = 0; pass < 2; ++pass) {
    for (NewtonContact& c : contacts_)
      for (int i = 0; i < c.num_points; ++i)
        std::copy(c.points[i].impulse, c.points[i].impulse + 3, c.points[i].base);
    solve();
  }
}

// m/s, of a body or of its turning at its radius of gyration.
double NewtonIsland::fastest() const {
  double most = 0.0;
  for (uint32_t i = 0; i < bodies_.size(); ++i) {
    const DirectBody& b = bodies_[i];
    const double* v = &velocity_[size_t(i) * 6];
    const double radius = std::sqrt(b.body_inertia.trace() / 3.0 * b.inv_mass);
    for (const double speed : {Vec3d(v[0], v[1], v[2]).norm(), radius * Vec3d(v[3], v[4], v[5]).norm()})
      if (!(speed <= most)) most = speed;
  }
  return most;
}

bool NewtonIsland::advance(std::span<RigidState> states) {
  double fall = 0.0;
  for (const DirectBody& b : bodies_) fall = std::max(fall, params_.h * params_.substeps * b.acceleration.norm());
  const double limit = kMostGain * (fastest() + fall) + kMostSpeed;
  for (int i = 0; i < params_.substeps; ++i) {
    startSubstep();
    setBias(true);
    solve();
    move();
    for (NewtonJoint& n : joints_) rememberForces(n, params_.h);
    linearizeJoints(false);
    updateMass();
    setBias(false);
    solve();
    for (NewtonJoint& n : joints_) rememberForces(n, params_.h), sumImpulses(n.joint, bodies_);
    for (NewtonContact& c : contacts_)
      for (int k = 0; k < c.num_points; ++k)
        c.points[k].most_normal = std::max(c.points[k].most_normal, c.points[k].impulse[0]);
    for (uint32_t b : moving_) {
      const double* v = velocityOf(b);
      bodies_[b].v = Vec3d(v[0], v[1], v[2]), bodies_[b].w = Vec3d(v[3], v[4], v[5]);
    }
  }
  bounce();
  if (!(fastest() <= limit)) {
    for (NewtonJoint& n : joints_) forget(n);
    return false;
  }
  store(states);
  return true;
}

void NewtonIsland::store(std::span<RigidState> states) {
  for (uint32_t i : moving_) {
    RigidState& s = states[body_index_[i]];
    const double* v = velocityOf(i);
    s.position = bodies_[i].pose.position.cast<float>();
    s.orientation = bodies_[i].pose.orientation.cast<float>().normalized();
    s.linear_velocity = Vec3d(v[0], v[1], v[2]).cast<float>();
    s.angular_velocity = Vec3d(v[3], v[4], v[5]).cast<float>();
  }
  for (const NewtonJoint& n : joints_) reportForces(n.joint, params_.h * params_.substeps);
  for (const NewtonContact& c : contacts_) {
    for (int i = 0; i < c.num_points; ++i) {
      const NewtonPoint& p = c.points[i];
      c.manifold->points[i].normal_impulse = static_cast<float>(p.impulse[0]);
      c.manifold->points[i].friction_impulse =
          (p.impulse[1] * c.axis[1] + p.impulse[2] * c.axis[2]).cast<float>();
    }
  }
}

}  // namespace pfx

// The solver's part of a step: solver bodies out of states, the sub-steps, and back.
#include <algorithm>

#include "pfx/base_level/math/trig.h"
#include "pfx/high_level/pipeline/restitution_threshold.h"
#include "pfx/high_level/pipeline/stages.h"
#include "pfx/high_level/world/world_impl.h"

namespace pfx {

void World::Impl::needSolverBody(uint32_t body) {
  if (solver_index[body] != kNoSolverBody) return;
  solver_index[body] = 0;  // the set-up numbers them
  solved.push_back(body);
}

namespace stage {
namespace {

constexpr uint32_t kBodyGrain = 128;

SoftStepParams solveParams(const World::Impl& w) {
  SoftStepParams p;
  p.substeps = w.def.substeps;
  p.h = w.dt / static_cast<float>(w.def.substeps);
  p.warm_start = w.def.pipeline != Pipeline::Simple;
  p.simd = w.def.simd;
  p.restitution_threshold = restitutionThreshold(w);
  return p;
}

SolverBody makeSolverBody(const RigidState& s, const RigidBody& body, const Inertia& inertia) {
  SolverBody b;
  for (int i = 0; i < 3; ++i) b.v[i] = s.linear_velocity[i], b.w[i] = s.angular_velocity[i];
  b.dq[0] = s.orientation.x(), b.dq[1] = s.orientation.y(), b.dq[2] = s.orientation.z(),
  b.dq[3] = s.orientation.w();
  if (isDynamic(s.motion_type)) {
    b.inv_mass = 1.0f / body.mass;
    setInverseInertia(b, worldInverseInertia(s.orientation, inertia));
  }
  return b;
}

// Motion of a body under constant acceleration and velocity-proportional damping over t seconds:
// v' = a - c v has v(t) = v e^-ct + a (1 - e^-ct) / c and x(t) its integral.
void flyFor(RigidState& s, const Vec3& a, float c, float t) {
  if (c == 0.0f) {
    s.position += t * s.linear_velocity + 0.5f * t * t * a;
    s.linear_velocity += t * a;
    return;
  }
  const float decay = exp(-c * t);
  const Vec3 final_speed = a / c;
  s.position += t * final_speed + (1.0f - decay) / c * (s.linear_velocity - final_speed);
  s.linear_velocity = final_speed + decay * (s.linear_velocity - final_speed);
}

}  // namespace

float restitutionThreshold(const World::Impl& w) {
  constexpr float kMostSpeed = 0.5f, kFall = 4.0f;
  return std::min(kMostSpeed, kFall * w.dt * w.def.gravity.norm());
}

BodyMotion makeMotion(const World::Impl& w, uint32_t i, float h) {
  const RigidBody& body = w.store.bodies[i];
  const RigidState& s = w.store.states[i];
  return {.start_orientation = s.orientation,
          .inertia = isDynamic(s.motion_type) ? &w.store.inertias[i] : nullptr,
          .acceleration = body.gravity_scale * w.def.gravity,
          .torque = Vec3::Zero(),
          .linear_decay = body.linear_damping > 0.0f ? exp(-body.linear_damping * h) : 1.0f,
          .angular_decay = body.angular_damping > 0.0f ? exp(-body.angular_damping * h) : 1.0f,
          .keeps_pace = false,
          .free_velocity = Vec3::Zero(),
          .free_momentum = Vec3::Zero(),
          .impulse_velocity = Vec3::Zero(),
          .impulse_momentum = Vec3::Zero(),
          .start_velocity = Vec3::Zero(),
          .lag = Vec3::Zero()};
}

void flyFree(World::Impl& w) {
  w.tasks.parallelFor(static_cast<uint32_t>(w.free_bodies.size()), kBodyGrain, [&](TaskRange r) {
    for (uint32_t k = r.begin; k < r.end; ++k) {
      const uint32_t i = w.free_bodies[k];
      RigidState& s = w.store.states[i];
      const RigidBody& body = w.store.bodies[i];
      flyFor(s, body.gravity_scale * w.def.gravity, body.linear_damping, w.dt);
      if (body.angular_damping > 0.0f) s.angular_velocity *= exp(-body.angular_damping * w.dt);
      const Rotation turned = advanceRotation({s.orientation, s.angular_velocity}, w.store.inertias[i], w.dt);
      s.orientation = turned.orientation;
      s.angular_velocity = turned.angular_velocity;
    }
  });
}

void beginComponent(World::Impl& w, JointComponent& c, const DirectStepParams& params) {
  for (size_t i = 0; i < c.bodies.size(); ++i)
    c.motions[i] = makeMotion(w, c.bodies[i], static_cast<float>(params.h));
  c.direct.begin(w.store.states, w.store.bodies, c.motions, params);
}

namespace {

// m/s, world, in the plane of a contact.
Vec3 beltVelocity(const RigidState& s, const Surface& belt, const Vec3& normal) {
  const Vec3 v = s.orientation * belt.velocity;
  return v - v.dot(normal) * normal;
}

// From bodies to solver bodies. A contact on a moving mesh or a belt is held by a solver body of its own behind those of the
// bodies, which goes with the surface.
void numberConstraints(World::Impl& w) {
  for (uint32_t k = 0; k < w.solved.size(); ++k) w.solver_index[w.solved[k]] = k;
  w.surfaces.clear();
  const auto numbered = [&](uint32_t body, const ContactManifold& m) {
    const MeshMotion* motion = w.motionOf(body);
    const Surface* belt = w.beltOf(body);
    if (motion == nullptr && belt == nullptr) return w.solver_index[body];
    w.surfaces.push_back({body, motion ? w.surfaceVelocity(body, m, *motion) : w.store.states[body].linear_velocity});
    if (belt) w.surfaces.back().velocity += beltVelocity(w.store.states[body], *belt, m.normal);
    return static_cast<uint32_t>(w.solved.size() + w.surfaces.size() - 1);
  };
  for (ContactConstraint& c : w.constraints) {
    c.solver_a = numbered(c.solver_a, *c.manifold);
    c.solver_b = numbered(c.solver_b, *c.manifold);
  }
}

void makeSurfaces(World::Impl& w, float h) {
  for (uint32_t k = 0; k < w.surfaces.size(); ++k) {
    const uint32_t body = w.surfaces[k].body;
    RigidState state = w.store.states[body];
    state.linear_velocity = w.surfaces[k].velocity;
    w.solver_bodies[w.solved.size() + k] = makeSolverBody(state, w.store.bodies[body], w.store.inertias[body]);
    w.motions[w.solved.size() + k] = makeMotion(w, body, h);
  }
}

}  // namespace

void setUpSolver(World::Impl& w) {
  numberConstraints(w);
  const SoftStepParams params = solveParams(w);
  const uint32_t n = static_cast<uint32_t>(w.solved.size() + w.surfaces.size());
  w.solver_bodies.resize(n + 1);
  w.solver_bodies[n] = SolverBody{};  // for idle lanes
  w.motions.resize(n);
  w.solver_dynamic.assign(n + 1, 0);
  makeSurfaces(w, params.h);
  w.tasks.parallelFor(static_cast<uint32_t>(w.solved.size()), kBodyGrain, [&](TaskRange r) {
    for (uint32_t k = r.begin; k < r.end; ++k) {
      const uint32_t i = w.solved[k];
      w.solver_bodies[k] = makeSolverBody(w.store.states[i], w.store.bodies[i], w.store.inertias[i]);
      w.motions[k] = makeMotion(w, i, params.h);
      w.motions[k].keeps_pace = isDynamic(w.store.states[i].motion_type) && (w.joint_step.empty() || !w.jointed[i]);
      w.solver_dynamic[k] = isDynamic(w.store.states[i].motion_type);
    }
  });
  for (JointComponent* c : w.joint_step.components()) {
    for (size_t i = 0; i < c->bodies.size(); ++i) c->solver_index[i] = w.solver_index[c->bodies[i]];
    if (!c->is_soft) beginComponent(w, *c, {params.h, params.substeps, params.warm_start});
  }
  if (!w.joint_step.empty())
    w.joint_step.prepare(w.store.states, w.solver_dynamic, w.solver_bodies,
                         {params.h, params.substeps, params.warm_start, params.simd}, w.tasks);
  w.soft_step.prepare(w.constraints, w.solver_dynamic, w.solver_bodies, params, w.tasks);
  for (SolverBody& b : w.solver_bodies) {
    const SolverBody at_rest;
    std::copy(std::begin(at_rest.dq), std::end(at_rest.dq), b.dq);
  }
}

void solve(World::Impl& w) {
  w.soft_step.solve(w.solver_bodies, w.motions, solveParams(w), w.joint_step, w.tasks);
  if (!w.joint_step.empty()) w.joint_step.end(w.store.states, w.tasks);
}

void writeBack(World::Impl& w) {
  w.tasks.parallelFor(static_cast<uint32_t>(w.solved.size()), kBodyGrain, [&](TaskRange r) {
    for (uint32_t k = r.begin; k < r.end; ++k) {
      RigidState& s = w.store.states[w.solved[k]];
      if (!isDynamic(s.motion_type)) continue;
      const SolverBody& b = w.solver_bodies[k];
      s.position += Vec3(b.dp[0], b.dp[1], b.dp[2]);
      s.orientation = (Quat(b.dq[3], b.dq[0], b.dq[1], b.dq[2]) * s.orientation).normalized();
      s.linear_velocity = Vec3(b.v[0], b.v[1], b.v[2]);
      s.angular_velocity = Vec3(b.w[0], b.w[1], b.w[2]);
    }
  });
}

void storeImpulses(World::Impl& w) { w.soft_step.store(w.tasks); }

}  // namespace stage
}  // namespace pfx

#include "pfx/high_level/particles/particle_bodies.h"

namespace pfx {

ParticleBody::ParticleBody(const ParticleSurroundings& around, uint32_t index)
    : body(index), friction(around.bodies[index].friction) {
  const RigidState& s = around.states[index];
  end_ = s.pose();
  start_ = now = before = around.start_poses[index];
  // The shorter way round.
  if (start_.orientation.dot(end_.orientation) < 0.0f) end_.orientation.coeffs() = -end_.orientation.coeffs();
  yields_only = s.motion_type == MotionType::OneWay;
  if (!isDynamic(s.motion_type)) return;
  mass_ = around.bodies[index].mass;
  is_asleep_ = s.asleep;
  if (s.asleep) return;
  inverse_mass = 1.0f / mass_;
  inverse_inertia = worldInverseInertia(s.orientation, around.inertias[index]);
}

void ParticleBody::advance(int k, int count, float h) {
  before = now;
  if (k + 1 < count) {
    const float t = static_cast<float>(k + 1) / static_cast<float>(count);
    now.position = start_.position + t * (end_.position - start_.position);
    now.orientation.coeffs() = (1.0f - t) * start_.orientation.coeffs() + t * end_.orientation.coeffs();
    now.orientation.normalize();
  } else {
    now = end_;
  }
  if (!is_pushed_) return;
  shift_ += h * velocity_;
  turn_ += h * spin_;
  now.position += shift_;
  now.orientation = (expMap(turn_) * now.orientation).normalized();
}

void ParticleBody::push(const Vec3& impulse, const Vec3& point, float h) {
  if (is_asleep_) {
    velocity_ += impulse / (mass_ * h);
    return;
  }
  const Vec3 shift = inverse_mass * impulse, turn = inverse_inertia * (point - now.position).cross(impulse);
  is_pushed_ = true;
  shift_ += shift, velocity_ += shift / h;
  turn_ += turn, spin_ += turn / h;
  now.position += shift;
  now.orientation = (expMap(turn) * now.orientation).normalized();
}

float ParticleBody::inverseMass(const Vec3& point) const {
  if (inverse_mass == 0.0f) return 0.0f;
  // The trace bounds the largest eigenvalue of the rotational part.
  const Mat3 arm = skew(point - now.position);
  return inverse_mass - (arm * inverse_inertia * arm).trace();
}

void ParticleBody::finish(RigidState& state) const {
  if (!is_pushed_) return;
  state.position += shift_;
  state.orientation = (expMap(turn_) * state.orientation).normalized();
  state.linear_velocity += velocity_;
  state.angular_velocity += spin_;
  state.sleep_count = 0;
}

}  // namespace pfx

// Sums over a world, in double precision so that they do not hide the error of the float state.
#include "viewer/run/figures.h"

#include <algorithm>

namespace viewer {
namespace {

using Vec3d = Eigen::Vector3d;

void addBody(Figures& f, const pfx::RigidState& state, const pfx::RigidBody& body, const Vec3d& gravity) {
  const double mass = double(body.mass);
  const Vec3d x = state.position.cast<double>(), v = state.linear_velocity.cast<double>();
  const Vec3d w = state.angular_velocity.cast<double>();
  const Eigen::Matrix3d r = state.orientation.cast<double>().toRotationMatrix();
  const Vec3d spin = r * (body.inertia.cast<double>() * (r.transpose() * w));
  f.kinetic_energy += 0.5 * mass * v.squaredNorm() + 0.5 * w.dot(spin);
  f.potential_energy -= mass * double(body.gravity_scale) * gravity.dot(x);
  f.linear_momentum += mass * v;
  f.angular_momentum += spin + mass * x.cross(v);
  f.max_speed = std::max(f.max_speed, v.norm());
}

double deepestContact(const pfx::World& world) {
  double deepest = 0.0;
  for (const pfx::Pair& pair : world.contactPairs())
    for (const pfx::ContactManifold& manifold : world.manifolds(pair))
      for (int k = 0; k < manifold.num_points; ++k)
        deepest = std::max(deepest, -double(manifold.points[size_t(k)].distance));
  return deepest;
}

double widestJoint(const pfx::World& world) {
  double widest = 0.0;
  const auto links = world.jointLinks();
  for (uint32_t i = 0; i < links.size(); ++i)
    if (links[i].exists) widest = std::max(widest, world.jointError(i).distance);
  return widest;
}

}  // namespace

Figures computeFigures(const pfx::World& world) {
  Figures f;
  const Vec3d gravity = world.def().gravity.cast<double>();
  const auto states = world.states();
  const auto bodies = world.bodies();
  for (size_t i = 0; i < states.size(); ++i)
    if (pfx::isDynamic(states[i].motion_type)) addBody(f, states[i], bodies[i], gravity);
  f.max_penetration = deepestContact(world);
  f.max_joint_error = widestJoint(world);
  f.counts = world.counts();
  return f;
}

}  // namespace viewer

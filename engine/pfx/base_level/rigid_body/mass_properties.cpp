// Mass properties are summed in double precision, because compounds add many small terms to a few large ones.
#include "pfx/base_level/rigid_body/mass_properties.h"

#include <cmath>
#include <numbers>

#include "pfx/base_level/shape/convex_mesh.h"

namespace pfx {
namespace {

using Vec3d = Eigen::Vector3d;
using Mat3d = Eigen::Matrix3d;

struct Sum {
  double mass = 0.0;
  Vec3d moment = Vec3d::Zero();   // mass * centre
  Mat3d inertia = Mat3d::Zero();  // about the origin of the frame
};

Mat3d pointInertia(const Vec3d& p) { return p.squaredNorm() * Mat3d::Identity() - p * p.transpose(); }

struct DensityOne {  // volume, centre and inertia for a density of 1 kg/m^3
  double volume = 0.0;
  Vec3d center = Vec3d::Zero();
  Mat3d inertia = Mat3d::Zero();  // about the centre
};

DensityOne solid(const Sphere& s) {
  const double r = s.radius, v = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  return {v, Vec3d::Zero(), 0.4 * v * r * r * Mat3d::Identity()};
}

DensityOne solid(const Box& b) {
  const Vec3d h = b.half_extent.cast<double>();
  const double v = 8.0 * h.prod();
  const Vec3d q = h.cwiseProduct(h);
  return {v, Vec3d::Zero(), Vec3d(v / 3.0 * (q.sum() * Vec3d::Ones() - q)).asDiagonal()};
}

DensityOne solid(const Cylinder& c) {
  const double r = c.radius, h = c.half_length, v = 2.0 * std::numbers::pi * r * r * h;
  const double side = v * (r * r / 4.0 + h * h / 3.0);
  return {v, Vec3d::Zero(), Vec3d(v * r * r / 2.0, side, side).asDiagonal()};
}

DensityOne solid(const Capsule& c) {
  const double r = c.radius, h = c.half_length;
  const DensityOne tube = solid(Cylinder{c.half_length, c.radius});
  // Two half balls: the centre of mass of each lies 3/8 r above its flat face.
  const double ball = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  const double side = ball * (0.4 * r * r + h * h + 0.75 * h * r);
  const Vec3d caps(0.4 * ball * r * r, side, side);
  return {tube.volume + ball, Vec3d::Zero(), tube.inertia + Mat3d(caps.asDiagonal())};
}

DensityOne solid(const ConvexMesh* mesh) {
  if (mesh == nullptr) return {};
  return {mesh->volume, mesh->centroid.cast<double>(), mesh->unit_inertia.cast<double>()};
}

DensityOne solid(const LargeMesh*) { return {}; }

void add(Sum& sum, const DensityOne& s, const Transform& offset, double density) {
  const Mat3d r = offset.orientation.cast<double>().normalized().toRotationMatrix();
  const Vec3d center = offset.position.cast<double>() + r * s.center;
  const double mass = density * s.volume;
  sum.mass += mass;
  sum.moment += mass * center;
  sum.inertia += density * (r * s.inertia * r.transpose()) + mass * pointInertia(center);
}

MassProperties finish(const Sum& sum) {
  if (!(sum.mass > 0.0)) return {};
  const Vec3d center = sum.moment / sum.mass;
  const Mat3d inertia = sum.inertia - sum.mass * pointInertia(center);
  return {float(sum.mass), center.cast<float>(), (0.5 * (inertia + inertia.transpose())).cast<float>()};
}

}  // namespace

MassProperties massProperties(std::span<const Shape> shapes, float density) {
  Sum sum;
  for (const Shape& shape : shapes) {
    const DensityOne s = std::visit([](const auto& g) { return solid(g); }, shape.geometry);
    add(sum, s, shape.offset, density);
  }
  return finish(sum);
}

MassProperties massProperties(const Shape& shape, float density) {
  return massProperties(std::span(&shape, 1), density);
}

MassProperties massProperties(const Geometry& geometry, float density) {
  return massProperties(Shape{geometry, Transform{}}, density);
}

std::optional<MassProperties> scaledToMass(const MassProperties& properties, float mass) {
  if (!(properties.mass > 0.0f) || !(mass > 0.0f) || !std::isfinite(mass)) return std::nullopt;
  return MassProperties{mass, properties.center, properties.inertia * (mass / properties.mass)};
}

}  // namespace pfx

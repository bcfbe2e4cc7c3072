#include "pfx/high_level/world/body_store.h"

#include <cmath>
#include <stdexcept>

#include "pfx/base_level/rigid_body/mass_properties.h"
#include "pfx/low_level/broadphase/shape_tree.h"

namespace pfx {
namespace {

[[noreturn]] void reject(const BodyDef& def, const std::string& what) {
  throw std::invalid_argument("body \"" + def.name + "\": " + what);
}

void requireFinite(const BodyDef& def, const Vec3& v, const char* field) {
  if (!v.allFinite()) reject(def, std::string(field) + " is not finite");
}

void requireNotNegative(const BodyDef& def, float x, const char* field) {
  if (!(x >= 0.0f) || !std::isfinite(x))
    reject(def, std::string(field) + " = " + std::to_string(x) + ", must be >= 0");
}

void check(std::string_view name, const Surface& s) {
  const auto fails = [&](const char* what) { throw std::invalid_argument("body \"" + std::string(name) + "\": " + what); };
  if (!s.velocity.allFinite()) fails("surface velocity is not finite");
  if (!(s.torsional_resistance >= 0.0f) || !std::isfinite(s.torsional_resistance)) fails("torsional resistance must be >= 0");
}

void check(const BodyDef& def) {
  requireFinite(def, def.pose.position, "position");
  requireFinite(def, def.linear_velocity, "linear velocity");
  requireFinite(def, def.angular_velocity, "angular velocity");
  const float norm = def.pose.orientation.norm();
  if (!(std::abs(norm - 1.0f) < 1e-3f))
    reject(def, "orientation has length " + std::to_string(norm) + ", must be 1");
  if (def.shapes.empty()) reject(def, "has no shape");
  if (isDynamic(def.motion_type) && (!(def.mass > 0.0f) || !std::isfinite(def.mass)))
    reject(def, "mass = " + std::to_string(def.mass) + " kg, must be > 0");
  requireNotNegative(def, def.friction, "friction");
  requireNotNegative(def, def.restitution, "restitution");
  requireNotNegative(def, def.linear_damping, "linear damping");
  requireNotNegative(def, def.angular_damping, "angular damping");
  requireNotNegative(def, def.rolling_resistance, "rolling resistance");
  check(def.name, def.surface);
}

RigidState makeState(const BodyDef& def, uint32_t index) {
  RigidState s;
  s.position = def.pose.position;
  s.orientation = def.pose.orientation.normalized();
  s.linear_velocity = def.linear_velocity;
  s.angular_velocity = def.angular_velocity;
  s.body_id = index;
  s.filter_self = def.filter_self;
  s.filter_target = def.filter_target;
  s.motion_type = def.motion_type;
  return s;
}

RigidBody makeBody(const BodyDef& def) {
  RigidBody b;
  b.mass = def.mass;
  b.inertia = def.inertia;
  if (def.inertia.isZero() && isDynamic(def.motion_type)) {
    const auto scaled = scaledToMass(massProperties(std::span<const Shape>(def.shapes), 1000.0f), def.mass);
    if (!scaled) reject(def, "its shapes have no volume, so the inertia must be given");
    b.inertia = scaled->inertia;
  }
  b.restitution = def.restitution;
  b.friction = def.friction;
  b.linear_damping = def.linear_damping;
  b.angular_damping = def.angular_damping;
  b.rolling_resistance = def.rolling_resistance;
  b.gravity_scale = def.gravity_scale;
  return b;
}

}  // namespace

BodyId BodyStore::add(const BodyDef& def) {
  check(def);
  const bool reuse = !free_slots.empty();
  const uint32_t index = reuse ? free_slots.back() : static_cast<uint32_t>(states.size());
  Collidable collidable;
  if (!reuse) shapes.emplace_back();
  shapes[index].assign(def.shapes.begin(), def.shapes.end());
  collidable.external = shapes[index];
  if (const Error e = collidable.finish(); e != Error::Ok) reject(def, std::string("shape: ") + toString(e));
  attachShapes(index, collidable);
  const RigidBody body = makeBody(def);
  if (isDynamic(def.motion_type) && !(body.inertia.determinant() > 0.0f))
    reject(def, "inertia is not positive definite");

  if (reuse) {
    free_slots.pop_back();
  } else {
    states.emplace_back(), bodies.emplace_back(), collidables.emplace_back(), names.emplace_back();
    inertias.emplace_back(), size.emplace_back(), radius.emplace_back(), generations.push_back(0);
  }
  states[index] = makeState(def, index);
  bodies[index] = body;
  collidables[index] = collidable;
  inertias[index] = isDynamic(def.motion_type) ? makeInertia(body.inertia) : Inertia{};
  size[index] = collidable.half_extent.minCoeff();
  radius[index] = (collidable.center.cwiseAbs() + collidable.half_extent).norm();
  names[index] = def.name;
  setSurface(index, def.surface);
  ++generations[index];
  return {index, generations[index]};
}

void BodyStore::setShapes(uint32_t index, std::span<const Shape> new_shapes) {
  const auto reject = [&](const std::string& what) {
    throw std::invalid_argument("body \"" + std::string(names[index]) + "\": " + what);
  };
  if (new_shapes.empty()) reject("has no shape");
  Collidable collidable;
  collidable.inline_shape = new_shapes.front();
  if (new_shapes.size() > 1) collidable.external = new_shapes;
  if (const Error e = collidable.finish(); e != Error::Ok) reject(std::string("shape: ") + toString(e));
  shapes[index].assign(new_shapes.begin(), new_shapes.end());
  attachShapes(index, collidable);
  collidables[index] = collidable;
  size[index] = collidable.half_extent.minCoeff();
  radius[index] = (collidable.center.cwiseAbs() + collidable.half_extent).norm();
}

void BodyStore::setSurface(uint32_t index, const Surface& surface) {
  check(names[index], surface);
  if (index >= surfaces.size() && surface == Surface{}) return;
  if (index >= surfaces.size()) surfaces.resize(index + size_t(1));
  surfaces[index] = surface;
  while (!surfaces.empty() && surfaces.back() == Surface{}) surfaces.pop_back();
}

void BodyStore::attachShapes(uint32_t index, Collidable& collidable) {
  if (shape_trees.size() <= index) shape_trees.resize(index + 1);
  const Vector<Shape>& all = shapes[index];
  const bool many = all.size() > kShapesWithoutTree;
  shape_trees[index] = many ? makeShapeTree(all) : DynamicTree();
  collidable.inline_shape = all.front();
  collidable.external = all.size() > 1 ? std::span<const Shape>(all) : std::span<const Shape>();
  collidable.shape_tree = many ? &shape_trees[index] : nullptr;
}

void BodyStore::remove(uint32_t index) {
  states[index] = RigidState{};
  states[index].motion_type = MotionType::Fixed;
  states[index].filter_self = states[index].filter_target = 0;
  states[index].body_id = index;
  collidables[index] = Collidable{};
  names[index].clear();
  setSurface(index, {});
  ++generations[index];
  free_slots.push_back(index);
}

}  // namespace pfx

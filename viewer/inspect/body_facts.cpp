#include "viewer/inspect/body_facts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/base_level/shape/large_mesh.h"

namespace viewer {
namespace {

using pfx::Vec3;
using pfx::World;

const char* motionName(pfx::MotionType type) {
  static constexpr std::array<const char*, pfx::kNumMotionTypes> kNames = {"fixed", "active", "keyframe", "one way",
                                                                           "trigger"};
  const auto i = size_t(type);
  return i < kNames.size() ? kNames[i] : "unknown";
}

std::string meters(const char* text, float value) {
  char out[64];
  std::snprintf(out, sizeof out, "%s %.4g m", text, double(value));
  return out;
}

std::string shapeText(const pfx::Geometry& geometry) {
  struct Describe {
    std::string operator()(const pfx::Sphere& s) const { return meters("sphere, radius", s.radius); }
    std::string operator()(const pfx::Box& b) const {
      char out[96];
      std::snprintf(out, sizeof out, "box, half extent (%.4g, %.4g, %.4g) m", double(b.half_extent.x()),
                    double(b.half_extent.y()), double(b.half_extent.z()));
      return out;
    }
    std::string operator()(const pfx::Capsule& c) const {
      return meters("capsule, half length", c.half_length) + meters(", radius", c.radius);
    }
    std::string operator()(const pfx::Cylinder& c) const {
      return meters("cylinder, half length", c.half_length) + meters(", radius", c.radius);
    }
    std::string operator()(const pfx::ConvexMesh* m) const {
      return "convex mesh, " + std::to_string(m ? m->vertices.size() : 0) + " vertices";
    }
    std::string operator()(const pfx::LargeMesh* m) const {
      return "large mesh, " + std::to_string(m ? m->numFacets() : 0) + " triangles";
    }
  };
  return std::visit(Describe(), geometry);
}

// The large mesh of a body, when it has one; the triangle of a contact point is in it.
const pfx::LargeMesh* meshOf(const World& world, uint32_t body) {
  for (const pfx::Shape& shape : world.collidables()[body].shapes())
    if (const auto* mesh = std::get_if<const pfx::LargeMesh*>(&shape.geometry)) return *mesh;
  return nullptr;
}

FactSheet pointFacts(const World& world, const pfx::Pair& pair, const pfx::ContactManifold& m,
                     const pfx::ContactPoint& p) {
  FactSheet f;
  f.add("position", vectorJson(world.states()[pair.body_a].pose().apply(p.local_a)), "m, on the first body");
  f.add("position_b", vectorJson(world.states()[pair.body_b].pose().apply(p.local_b)), "m, on the second body");
  f.add("normal", vectorJson(m.normal), ", from the first to the second");
  f.add("distance", p.distance, "m, negative: overlap");
  f.add("impulse", p.normal_impulse, "N s");
  f.add("friction_impulse", vectorJson(p.friction_impulse), "N s, on the second body");
  f.add("feature", p.feature, ", names the pair of features");
  for (uint32_t body : {pair.body_a, pair.body_b})
    if (const pfx::LargeMesh* mesh = meshOf(world, body); mesh && p.triangle < mesh->numFacets()) {
      f.add("mesh", bodyRef(world, body));
      f.add("island", pfx::islandOf(*mesh, p.triangle));
      f.add("triangle", p.triangle);
      f.add("barycentric", {p.barycentric.x(), p.barycentric.y()}, ", (s, t)");
      break;
    }
  return f;
}

}  // namespace

Json bodyRef(const World& world, uint32_t body) { return {{"index", body}, {"name", world.name(body)}}; }
Json jointRef(const World& world, uint32_t joint) { return {{"index", joint}, {"name", world.jointName(joint)}}; }

std::string bodyTitle(const World& world, uint32_t body) {
  const std::string_view name = world.name(body);
  return name.empty() ? "body " + std::to_string(body) : std::string(name);
}

std::optional<uint32_t> islandOfBody(const World& world, uint32_t body) {
  for (uint32_t i = 0; i < world.numIslands(); ++i)
    if (std::ranges::binary_search(world.island(i).bodies, body)) return i;
  return std::nullopt;
}

std::optional<uint32_t> findPair(const World& world, uint32_t body_a, uint32_t body_b) {
  const uint64_t key = pfx::Pair{std::min(body_a, body_b), std::max(body_a, body_b)}.key();
  const auto pairs = world.contactPairs();
  const auto found = std::ranges::lower_bound(pairs, key, {}, &pfx::Pair::key);
  if (found == pairs.end() || found->key() != key) return std::nullopt;
  return uint32_t(found - pairs.begin());
}

FactSheet bodyFacts(const World& world, uint32_t body) {
  const pfx::RigidState& s = world.states()[body];
  const pfx::RigidBody& b = world.bodies()[body];
  FactSheet f;
  f.add("name", world.name(body));
  f.add("index", body);
  f.add("motion", motionName(s.motion_type));
  f.add("asleep", s.asleep);
  if (const auto island = islandOfBody(world, body)) f.add("island", *island);
  for (const pfx::Shape& shape : world.collidables()[body].shapes()) f.add("shape", shapeText(shape.geometry));
  f.add("position", vectorJson(s.position), "m");
  const pfx::Quat& q = s.orientation;
  f.add("orientation", {q.x(), q.y(), q.z(), q.w()}, ", (x, y, z, w)");
  f.add("linear_velocity", vectorJson(s.linear_velocity), "m/s");
  f.add("angular_velocity", vectorJson(s.angular_velocity), "rad/s");
  f.add("mass", b.mass, "kg");
  f.add("inertia", vectorJson(b.inertia.diagonal()), "kg m2, diagonal in body axes");
  f.add("friction", b.friction);
  f.add("restitution", b.restitution);
  f.add("rolling_resistance", b.rolling_resistance, "m");
  const pfx::Surface surface = world.surface(body);
  f.add("torsional_resistance", surface.torsional_resistance, "m");
  f.add("surface_velocity", vectorJson(surface.velocity), "m/s, body axes");
  f.add("linear_damping", b.linear_damping, "1/s");
  f.add("angular_damping", b.angular_damping, "1/s");
  f.add("gravity_scale", b.gravity_scale);
  f.add("still_for", s.sleep_count, "steps");
  f.add("can_sleep", s.can_sleep);
  char text[40];
  std::snprintf(text, sizeof text, "%08x of %08x", s.filter_self, s.filter_target);
  f.add("filter", text);
  return f;
}

FactSheet contactFacts(const World& world, const pfx::Pair& pair) {
  const pfx::RigidBody &a = world.bodies()[pair.body_a], &b = world.bodies()[pair.body_b];
  FactSheet f;
  f.add("body_a", bodyRef(world, pair.body_a));
  f.add("body_b", bodyRef(world, pair.body_b));
  f.add("friction", std::sqrt(a.friction * b.friction));
  f.add("restitution", 0.5f * (a.restitution + b.restitution));
  float deepest = 0.0f, impulse = 0.0f;
  FactList points{"points", {}};
  for (const pfx::ContactManifold& m : world.manifolds(pair))
    for (int k = 0; k < m.num_points; ++k) {
      const pfx::ContactPoint& p = m.points[size_t(k)];
      deepest = std::max(deepest, -p.distance);
      impulse += p.normal_impulse;
      points.items.push_back(pointFacts(world, pair, m, p));
    }
  f.add("overlap", deepest, "m, deepest point");
  f.add("total_impulse", impulse, "N s, of all normals");
  f.lists.push_back(std::move(points));
  return f;
}

namespace {

const char* kindName(pfx::JointKind kind) {
  static constexpr std::array kNames = {"ball",  "swing twist", "hinge",    "slider",
                                        "fixed", "universal",   "distance", "gear"};
  const auto i = size_t(kind);
  return i < kNames.size() ? kNames[i] : "unknown";
}

FactSheet axisFacts(const pfx::Joint& joint, int axis, double value) {
  static constexpr std::array kNames = {"slide x", "slide y", "slide z", "twist", "swing y", "swing z"};
  static constexpr std::array kLocks = {"free", "limit", "fixed"};
  const pfx::AxisConstraint& c = joint.axis[axis];
  const bool turns = axis >= 3;
  FactSheet f;
  f.add("axis", axis == 4 && joint.cone ? "cone" : kNames[size_t(axis)]);
  f.add("lock", kLocks[std::min(size_t(c.lock), kLocks.size() - 1)]);
  f.add("value", value, turns ? "rad" : "m");
  if (c.lock == pfx::JointLock::Limit) f.add("range", {c.lower, c.upper}, turns ? "rad" : "m");
  if (c.lock == pfx::JointLock::Fixed) f.add("fixed_at", c.lower, turns ? "rad" : "m");
  f.add("error", pfx::axisError(c, value), turns ? "rad" : "m");
  f.add("force", c.force, turns ? "N m" : "N");
  if (c.motor_max_force > 0.0f) {
    f.add("motor_speed", c.motor_speed, turns ? "rad/s" : "m/s");
    f.add("motor_max_force", c.motor_max_force, turns ? "N m" : "N");
  }
  if (c.spring_frequency > 0.0f) {
    f.add("spring_frequency", c.spring_frequency, "Hz");
    f.add("spring_damping", c.spring_damping, ", damping ratio");
    f.add("spring_target", c.spring_target, turns ? "rad" : "m");
  }
  if (c.damping > 0.0f) f.add("damping", c.damping);
  if (std::isfinite(c.max_force)) f.add("max_force", c.max_force, turns ? "N m" : "N");
  if (c.bias != 1.0f) f.add("bias", c.bias);
  if (c.weight != 1.0f) f.add("weight", c.weight);
  return f;
}

}  // namespace

FactSheet jointFacts(const World& world, uint32_t index) {
  const pfx::Joint& joint = world.joints()[index];
  const pfx::JointLink& link = world.jointLinks()[index];
  const pfx::RigidState &a = world.states()[link.body_a], &b = world.states()[link.body_b];
  const pfx::JointError error = world.jointError(index);
  const pfx::JointStrength strength = world.jointStrength(index);
  FactSheet f;
  f.add("name", world.jointName(index));
  f.add("index", index);
  f.add("kind", kindName(joint.kind));
  f.add("body_a", bodyRef(world, link.body_a));
  f.add("body_b", bodyRef(world, link.body_b));
  f.add("bodies_collide", link.bodies_collide);
  f.add("anchor_a", vectorJson(a.pose().apply(joint.anchor_a)), "m, world");
  f.add("anchor_b", vectorJson(b.pose().apply(joint.anchor_b)), "m, world");
  f.add("error", error.distance, "m");
  f.add("error_angle", error.angle, "rad");
  f.add("force", vectorJson(joint.force), "N, on the second body");
  f.add("torque", vectorJson(joint.torque), "N m, on the second body");
  if (std::isfinite(strength.force)) f.add("break_force", strength.force, "N");
  if (std::isfinite(strength.torque)) f.add("break_torque", strength.torque, "N m");
  if (joint.kind == pfx::JointKind::Gear) f.add("gear_ratio", joint.gear_ratio);
  const pfx::JointCoordinates at = pfx::measureJoint(joint, pfx::toDouble(a.pose()), pfx::toDouble(b.pose()));
  FactList axes{"axes", {}};
  for (int i = 0; i < pfx::kNumJointAxes; ++i) {
    const bool used = !(joint.cone && i == 5);
    if (used) axes.items.push_back(axisFacts(joint, i, at.value[i]));
  }
  f.lists.push_back(std::move(axes));
  return f;
}

}  // namespace viewer

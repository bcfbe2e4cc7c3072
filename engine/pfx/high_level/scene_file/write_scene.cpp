// Writing a world as a scene file.
#include <charconv>
#include <fstream>
#include <map>
#include <sstream>

#include "pfx/high_level/particles/particle_system.h"
#include "pfx/high_level/scene_file/mesh_source.h"
#include "pfx/high_level/scene_file/names.h"
#include "pfx/high_level/scene_file/particles_file.h"
#include "pfx/high_level/scene_file/scene_file.h"

namespace pfx {
namespace {

using scene_names::nameOf;

// The shortest text that reads back as the same float.
std::string toText(float x) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, x).ptr};
}
std::string toText(const Vec3& v) { return toText(v.x()) + " " + toText(v.y()) + " " + toText(v.z()); }
std::string toText(const Quat& q) {
  return toText(q.x()) + " " + toText(q.y()) + " " + toText(q.z()) + " " + toText(q.w());
}
std::string toText(const Mat3& m) {
  std::string out;
  for (int i = 0; i < 3; ++i) out += (i == 0 ? "" : "  ") + toText(Vec3(m.row(i)));
  return out;
}

class SceneWriter {
 public:
  explicit SceneWriter(const World& world) : world_(world) {}

  std::string write() {
    pugi::xml_node scene = document_.append_child("scene");
    set(scene, "version", 1);
    writeWorld(scene);
    for (uint32_t i = 0; i < world_.states().size(); ++i)
      if (exists(i)) writeMeshes(scene, i);
    for (uint32_t i = 0; i < world_.states().size(); ++i)
      if (exists(i)) writeBody(scene, i);
    for (uint32_t i = 0; i < world_.joints().size(); ++i)
      if (world_.jointLinks()[i].exists) writeJoint(scene, i);
    for (const Pair& p : world_.pairsKeptApart()) writeApart(scene, p);
    for (uint32_t i = 0; i < world_.numParticleSystems(); ++i)
      if (const ParticleSystem* system = world_.particles(i)) writeParticles(scene, system->def());
    std::ostringstream out;
    document_.save(out, "  ");
    return out.str();
  }

 private:
  bool exists(uint32_t i) const { return world_.isValid(world_.bodyId(i)) && world_.bodyId(i).generation % 2 == 1; }

  template <class T>
  static void set(pugi::xml_node& node, const char* name, const T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      node.append_attribute(name) = value ? "true" : "false";
    } else if constexpr (std::is_convertible_v<T, std::string_view>) {
      node.append_attribute(name) = std::string(value).c_str();
    } else if constexpr (std::is_integral_v<T>) {
      node.append_attribute(name) = value;
    } else {
      node.append_attribute(name) = toText(value).c_str();
    }
  }

  // Writes what differs from the value that reading starts with.
  template <class T>
  static void setUnless(pugi::xml_node& node, const char* name, const T& value, const T& usual) {
    if constexpr (std::is_same_v<T, Quat>) {
      if (value.coeffs() != usual.coeffs()) set(node, name, value);
    } else {
      if (value != usual) set(node, name, value);
    }
  }

  void writeWorld(pugi::xml_node& scene) {
    const WorldDef& w = world_.def();
    pugi::xml_node node = scene.append_child("world");
    set(node, "gravity", w.gravity);
    set(node, "pipeline", nameOf(scene_names::kPipelines, w.pipeline));
    set(node, "substeps", w.substeps);
    set(node, "joint-solver", nameOf(scene_names::kJointSolvers, w.joint_solver));
    if (w.contact_solver != WorldDef{}.contact_solver)
      set(node, "contact-solver", nameOf(scene_names::kContactSolvers, w.contact_solver));
    if (w.friction_mixing != WorldDef{}.friction_mixing)
      set(node, "friction-mixing", nameOf(scene_names::kMixings, w.friction_mixing));
    if (w.restitution_mixing != WorldDef{}.restitution_mixing)
      set(node, "restitution-mixing", nameOf(scene_names::kMixings, w.restitution_mixing));
    set(node, "sleeping", w.sleeping);
    set(node, "sleep-velocity", w.sleep_velocity);
    set(node, "sleep-steps", w.sleep_steps);
    setUnless(node, "report-events", w.report_events, WorldDef{}.report_events);
    setUnless(node, "hit-speed", w.hit_speed, WorldDef{}.hit_speed);
    set(node, "center", w.center);
    set(node, "extent", w.extent);
  }

  void writeMeshes(pugi::xml_node& scene, uint32_t body) {
    for (const Shape& s : world_.collidables()[body].shapes()) {
      if (const auto* convex = std::get_if<const ConvexMesh*>(&s.geometry); convex && addId(*convex))
        writeConvexMesh(scene, **convex);
      if (const auto* large = std::get_if<const LargeMesh*>(&s.geometry); large && addId(*large))
        writeLargeMesh(scene, **large);
    }
  }

  bool addId(const void* mesh) { return ids_.emplace(mesh, "mesh " + std::to_string(ids_.size() + 1)).second; }

  template <class Range>
  static void writeLines(pugi::xml_node& mesh, const char* tag, const Range& rows, int a_line) {
    std::string text = "\n";
    int column = 0;
    for (const auto& row : rows) {
      if constexpr (std::is_integral_v<std::decay_t<decltype(row)>>) {
        text += std::to_string(row);
      } else {
        text += toText(row);
      }
      text += ++column % a_line == 0 ? "\n" : " ";
    }
    mesh.append_child(tag).text() = text.c_str();
  }

  void writeConvexMesh(pugi::xml_node& scene, const ConvexMesh& mesh) {
    pugi::xml_node node = scene.append_child("convex-mesh");
    set(node, "id", ids_[&mesh]);
    writeLines(node, "vertices", mesh.vertices, 1);
  }

  void writeLargeMesh(pugi::xml_node& scene, const LargeMesh& mesh) {
    const LargeMeshSource source = sourceOf(mesh);
    pugi::xml_node node = scene.append_child("large-mesh");
    set(node, "id", ids_[&mesh]);
    set(node, "type", nameOf(scene_names::kLargeMeshTypes, mesh.type));
    setUnless(node, "high-quality", source.high_quality, false);
    writeLines(node, "vertices", source.vertices, 1);
    writeLines(node, "triangles", source.indices, 3);
    writeLines(node, "thickness", source.thickness, 8);
    if (!source.user_data.empty()) writeLines(node, "user-data", source.user_data, 8);
  }

  void writeBody(pugi::xml_node& scene, uint32_t i) {
    const RigidState& s = world_.states()[i];
    const RigidBody& b = world_.bodies()[i];
    const BodyDef usual;
    pugi::xml_node node = scene.append_child("body");
    set(node, "id", i);
    if (!world_.name(i).empty()) set(node, "name", world_.name(i));
    set(node, "motion", nameOf(scene_names::kMotionTypes, s.motion_type));
    set(node, "position", s.position);
    setUnless(node, "orientation", s.orientation, usual.pose.orientation);
    setUnless(node, "linear-velocity", s.linear_velocity, usual.linear_velocity);
    setUnless(node, "angular-velocity", s.angular_velocity, usual.angular_velocity);
    set(node, "mass", b.mass);
    setUnless(node, "inertia", b.inertia, usual.inertia);
    set(node, "friction", b.friction);
    set(node, "restitution", b.restitution);
    setUnless(node, "rolling-resistance", b.rolling_resistance, usual.rolling_resistance);
    const Surface surface = world_.surface(i);
    setUnless(node, "torsional-resistance", surface.torsional_resistance, usual.surface.torsional_resistance);
    setUnless(node, "surface-velocity", surface.velocity, usual.surface.velocity);
    setUnless(node, "linear-damping", b.linear_damping, usual.linear_damping);
    setUnless(node, "angular-damping", b.angular_damping, usual.angular_damping);
    setUnless(node, "gravity-scale", b.gravity_scale, usual.gravity_scale);
    setUnless(node, "filter-self", s.filter_self, usual.filter_self);
    setUnless(node, "filter-target", s.filter_target, usual.filter_target);
    setUnless(node, "can-sleep", s.can_sleep, true);
    for (const Shape& shape : world_.collidables()[i].shapes()) writeShape(node, shape);
  }

  void writeShape(pugi::xml_node& body, const Shape& shape) {
    static constexpr const char* kTags[kNumShapeTypes] = {"sphere",   "box",         "capsule",
                                                          "cylinder", "convex-mesh", "large-mesh"};
    pugi::xml_node node = body.append_child(kTags[shape.geometry.index()]);
    std::visit([&](const auto& g) { writeGeometry(node, g); }, shape.geometry);
    setUnless(node, "position", shape.offset.position, Transform{}.position);
    setUnless(node, "orientation", shape.offset.orientation, Transform{}.orientation);
  }

  static void writeGeometry(pugi::xml_node& node, const Sphere& s) { set(node, "radius", s.radius); }
  static void writeGeometry(pugi::xml_node& node, const Box& b) { set(node, "half-extent", b.half_extent); }
  static void writeGeometry(pugi::xml_node& node, const Capsule& c) { writeRound(node, c.half_length, c.radius); }
  static void writeGeometry(pugi::xml_node& node, const Cylinder& c) { writeRound(node, c.half_length, c.radius); }
  void writeGeometry(pugi::xml_node& node, const ConvexMesh* mesh) { set(node, "mesh", ids_[mesh]); }
  void writeGeometry(pugi::xml_node& node, const LargeMesh* mesh) { set(node, "mesh", ids_[mesh]); }
  static void writeRound(pugi::xml_node& node, float half_length, float radius) {
    set(node, "half-length", half_length);
    set(node, "radius", radius);
  }

  void writeJoint(pugi::xml_node& scene, uint32_t i) {
    const Joint& j = world_.joints()[i];
    const JointLink& link = world_.jointLinks()[i];
    const Joint usual;
    pugi::xml_node node = scene.append_child("joint");
    if (!world_.jointName(i).empty()) set(node, "name", world_.jointName(i));
    set(node, "kind", nameOf(scene_names::kJointKinds, j.kind));
    set(node, "body-a", link.body_a);
    set(node, "body-b", link.body_b);
    setUnless(node, "bodies-collide", link.bodies_collide, false);
    const JointStrength strength = world_.jointStrength(i);
    setUnless(node, "break-force", strength.force, JointDef{}.break_force);
    setUnless(node, "break-torque", strength.torque, JointDef{}.break_torque);
    setUnless(node, "cone", j.cone, false);
    set(node, "anchor-a", j.anchor_a);
    set(node, "anchor-b", j.anchor_b);
    set(node, "frame-a", j.frame_a);
    set(node, "frame-b", j.frame_b);
    setUnless(node, "gear-ratio", j.gear_ratio, usual.gear_ratio);
    setUnless(node, "gear-angle-a", j.gear_angle_a, 0.0f);
    setUnless(node, "gear-angle-b", j.gear_angle_b, 0.0f);
    setUnless(node, "gear-zero-a", j.gear_zero_a, usual.gear_zero_a);
    setUnless(node, "gear-zero-b", j.gear_zero_b, usual.gear_zero_b);
    for (int axis = 0; axis < kNumJointAxes; ++axis) writeAxis(node, axis, j.axis[axis]);
  }

  static void writeApart(pugi::xml_node& scene, const Pair& pair) {
    pugi::xml_node node = scene.append_child("apart");
    set(node, "body-a", pair.body_a);
    set(node, "body-b", pair.body_b);
  }

  static void writeAxis(pugi::xml_node& joint, int axis, const AxisConstraint& c) {
    const AxisConstraint usual;
    pugi::xml_node node = joint.append_child("axis");
    set(node, "name", nameOf(scene_names::kAxes, axis));
    set(node, "lock", nameOf(scene_names::kLocks, c.lock));
    setUnless(node, "lower", c.lower, usual.lower);
    setUnless(node, "upper", c.upper, usual.upper);
    setUnless(node, "bias", c.bias, usual.bias);
    setUnless(node, "damping", c.damping, usual.damping);
    setUnless(node, "weight", c.weight, usual.weight);
    setUnless(node, "max-force", c.max_force, usual.max_force);
    setUnless(node, "motor-speed", c.motor_speed, usual.motor_speed);
    setUnless(node, "motor-max-force", c.motor_max_force, usual.motor_max_force);
    setUnless(node, "spring-frequency", c.spring_frequency, usual.spring_frequency);
    setUnless(node, "spring-damping", c.spring_damping, usual.spring_damping);
    setUnless(node, "spring-target", c.spring_target, usual.spring_target);
    setUnless(node, "force", c.force, usual.force);
  }

  const World& world_;
  pugi::xml_document document_;
  std::map<const void*, std::string> ids_;
};

}  // namespace

std::string writeScene(const World& world) { return SceneWriter(world).write(); }

void saveScene(const std::filesystem::path& path, const World& world) {
  const std::string text = writeScene(world);
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw SceneError(path.string() + ": cannot be written");
}

}  // namespace pfx

#include "pfx/high_level/scene_file/urdf_reader.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <cmath>

#include "pfx/base_level/shape/convex_hull.h"
#include "pfx/high_level/scene_file/obj_reader.h"
#include "pfx/high_level/scene_file/xml_element.h"

namespace pfx {
namespace {

Vec3 toVec(const urdf::Vector3& v) { return Vec3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)); }

Transform toTransform(const urdf::Pose& p) {
  const urdf::Rotation& r = p.rotation;
  return {toVec(p.position), Quat(static_cast<float>(r.w), static_cast<float>(r.x), static_cast<float>(r.y),
                                  static_cast<float>(r.z))
                                 .normalized()};
}

const float kHalfRoot = std::sqrt(0.5f);
// z up to y up: by -90 degrees about x.
const Quat kUp(kHalfRoot, -kHalfRoot, 0.0f, 0.0f);
// Cylinders lie along z there and along x here: by -90 degrees about y.
const Quat kCylinderAxis(kHalfRoot, 0.0f, -kHalfRoot, 0.0f);

// Keeps what the parser has to say, for the message of an error.
class Listener : public console_bridge::OutputHandler {
 public:
  Listener() : before_(console_bridge::getOutputHandler()) { console_bridge::useOutputHandler(this); }
  ~Listener() override { console_bridge::useOutputHandler(before_); }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && cause_.empty()) cause_ = text;
  }
  const std::string& cause() const { return cause_; }

 private:
  console_bridge::OutputHandler* before_;
  std::string cause_;
};

class UrdfReader {
 public:
  UrdfReader(const SceneText& text, const UrdfOptions& options) : text_(text), options_(options) {}

  SceneDef read() {
    requireXml();
    const Listener listener;
    const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(std::string(text_.xml));
    if (!model || !model->getRoot())
      throw SceneError(text_.name + ": " + (listener.cause().empty() ? "not a URDF model" : listener.cause()));
    addLink(*model->getRoot(), {options_.position, kUp});
    return std::move(out_);
  }

 private:
  // Mistakes in the XML are named with their line; the parser of URDF does not know it.
  void requireXml() const {
    pugi::xml_document document;
    const auto parsed = document.load_buffer(text_.xml.data(), text_.xml.size());
    if (!parsed)
      XmlSource{text_.xml, text_.name}.fail(static_cast<size_t>(std::max<std::ptrdiff_t>(parsed.offset, 0)), "",
                                            parsed.description());
  }

  [[noreturn]] void fail(const std::string& place, const std::string& cause) const {
    throw SceneError(text_.name + ": " + place + ": " + cause);
  }

  // The link, and all that hang on it.
  void addLink(const urdf::Link& link, const Transform& pose) {
    const auto parent = static_cast<uint32_t>(out_.bodies.size());
    addBody(link, pose);
    for (const urdf::JointSharedPtr& joint : link.child_joints) {
      const urdf::Link& child = *childOf(link, *joint);
      if (isOnlyAFrame(child)) continue;
      const Transform at = pose * toTransform(joint->parent_to_joint_origin_transform);
      const auto index = static_cast<uint32_t>(out_.bodies.size());
      addLink(child, at);
      addJoint(*joint, at, parent, index);
    }
  }

  const urdf::Link* childOf(const urdf::Link& link, const urdf::Joint& joint) const {
    for (const urdf::LinkSharedPtr& child : link.child_links)
      if (child->name == joint.child_link_name) return child.get();
    fail("joint \"" + joint.name + "\"", "its child link is not there");
  }

  // Links without mass and shape at the end of an arm only name a place.
  static bool isOnlyAFrame(const urdf::Link& link) {
    return !link.inertial && link.collision_array.empty() && link.visual_array.empty() && link.child_joints.empty();
  }

  void addBody(const urdf::Link& link, const Transform& pose) {
    SceneBody& body = out_.bodies.emplace_back();
    body.place = text_.name + ": link \"" + link.name + "\"";
    BodyDef& def = body.def;
    def.name = link.name;
    const bool is_root = out_.bodies.size() == 1;
    if (is_root && options_.fixed_root) def.motion_type = MotionType::Fixed;
    Vec3 center = Vec3::Zero();
    if (link.inertial) {
      const urdf::Inertial& in = *link.inertial;
      const Transform axes = toTransform(in.origin);
      center = axes.position;
      def.mass = static_cast<float>(in.mass);
      Mat3 m;
      m << static_cast<float>(in.ixx), static_cast<float>(in.ixy), static_cast<float>(in.ixz),  //
          static_cast<float>(in.ixy), static_cast<float>(in.iyy), static_cast<float>(in.iyz),   //
          static_cast<float>(in.ixz), static_cast<float>(in.iyz), static_cast<float>(in.izz);
      const Mat3 r = axes.orientation.toRotationMatrix();
      def.inertia = r * m * r.transpose();
    } else if (def.motion_type != MotionType::Fixed) {
      fail("link \"" + link.name + "\"", "has no <inertial>, so its mass is not known");
    }
    def.pose = {pose.apply(center), pose.orientation.normalized()};
    addShapes(link, center, def);
  }

  void addShapes(const urdf::Link& link, const Vec3& center, BodyDef& def) {
    const auto add = [&](const urdf::Pose& origin, const urdf::GeometrySharedPtr& geometry) {
      if (geometry) def.shapes.push_back(makeShape(link, *geometry, toTransform(origin), center));
    };
    for (const auto& c : link.collision_array) add(c->origin, c->geometry);
    if (def.shapes.empty())
      for (const auto& v : link.visual_array) add(v->origin, v->geometry);
    if (!def.shapes.empty()) return;
    // A body must have a shape; this one meets nothing.
    def.shapes.push_back({Sphere{0.01f}, {}});
    def.filter_self = def.filter_target = 0;
  }

  Shape makeShape(const urdf::Link& link, const urdf::Geometry& geometry, Transform offset, const Vec3& center) {
    offset.position -= center;
    if (geometry.type == urdf::Geometry::SPHERE)
      return {Sphere{static_cast<float>(static_cast<const urdf::Sphere&>(geometry).radius)}, offset};
    if (geometry.type == urdf::Geometry::BOX)
      return {Box{0.5f * toVec(static_cast<const urdf::Box&>(geometry).dim)}, offset};
    if (geometry.type == urdf::Geometry::CYLINDER) {
      const auto& c = static_cast<const urdf::Cylinder&>(geometry);
      offset.orientation = offset.orientation * kCylinderAxis;
      return {Cylinder{static_cast<float>(0.5 * c.length), static_cast<float>(c.radius)}, offset};
    }
    return {hullOf(link, static_cast<const urdf::Mesh&>(geometry)), offset};
  }

  const ConvexMesh* hullOf(const urdf::Link& link, const urdf::Mesh& mesh) {
    std::string file = mesh.filename;
    for (const char* prefix : {"file://", "package://"})
      if (file.starts_with(prefix)) file.erase(0, std::string_view(prefix).size());
    const std::filesystem::path path = text_.folder / file;
    if (path.extension() != ".obj")
      fail("link \"" + link.name + "\"", "the mesh \"" + mesh.filename + "\" is no OBJ file");
    TriangleList list = readObj(readTextFile(path), path.string());
    for (Vec3& v : list.vertices) v = v.cwiseProduct(toVec(mesh.scale));
    ConvexMesh& hull = out_.convex_meshes.emplace_back();
    if (const Error e = buildConvexMesh(list.vertices, hull); e != Error::Ok)
      fail("link \"" + link.name + "\"", "the mesh \"" + mesh.filename + "\": " + toString(e));
    return &hull;
  }

  void addJoint(const urdf::Joint& joint, const Transform& at, uint32_t parent, uint32_t child) {
    if (joint.type == urdf::Joint::FLOATING) return;
    SceneJoint made;
    made.place = text_.name + ": joint \"" + joint.name + "\"";
    made.def.name = joint.name;
    made.body_a = parent;
    made.body_b = child;
    const Vec3 axis = at.orientation * toVec(joint.axis).normalized();
    if (joint.type != urdf::Joint::FIXED && !axis.allFinite()) fail("joint \"" + joint.name + "\"", "its axis has no direction");
    switch (joint.type) {
      case urdf::Joint::REVOLUTE:
      case urdf::Joint::CONTINUOUS:
        made.def.params = HingeJointParams{.anchor_point = at.position, .axis = axis};
        made.axes.push_back({3, movable(joint)});
        break;
      case urdf::Joint::PRISMATIC:
        made.def.params = SliderJointParams{.anchor_point = at.position, .direction = axis};
        made.axes.push_back({0, movable(joint)});
        break;
      case urdf::Joint::PLANAR:
        made.def.params = HingeJointParams{.anchor_point = at.position, .axis = axis};
        for (int free : {1, 2, 3}) made.axes.push_back({free, AxisConstraint{}});
        break;
      case urdf::Joint::FIXED: made.def.params = FixedJointParams{.anchor_point = at.position}; break;
      default: fail("joint \"" + joint.name + "\"", "its type is unknown");
    }
    out_.joints.push_back(std::move(made));
  }

  static AxisConstraint movable(const urdf::Joint& joint) {
    AxisConstraint c;
    if (joint.limits && joint.type != urdf::Joint::CONTINUOUS) {
      c.lock = JointLock::Limit;
      c.lower = static_cast<float>(joint.limits->lower);
      c.upper = static_cast<float>(joint.limits->upper);
    }
    if (joint.dynamics) c.motor_max_force = static_cast<float>(joint.dynamics->friction);
    return c;
  }

  const SceneText& text_;
  const UrdfOptions& options_;
  SceneDef out_;
};

}  // namespace

bool canReadUrdf() { return true; }

SceneDef readUrdf(const SceneText& text, const UrdfOptions& options) { return UrdfReader(text, options).read(); }

SceneDef readUrdf(const std::filesystem::path& path, const UrdfOptions& options) {
  const std::string text = readTextFile(path);
  return readUrdf(SceneText{.xml = text, .name = path.string(), .folder = path.parent_path()}, options);
}

}  // namespace pfx

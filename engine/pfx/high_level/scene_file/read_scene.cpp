// Reading a scene file: world, materials, meshes, bodies, joints.
#include <algorithm>
#include <map>

#include "pfx/high_level/scene_file/names.h"
#include "pfx/high_level/scene_file/obj_reader.h"
#include "pfx/high_level/scene_file/particles_file.h"
#include "pfx/high_level/scene_file/read_joint.h"
#include "pfx/high_level/scene_file/read_mesh.h"
#include "pfx/high_level/scene_file/scene_file.h"

namespace pfx {
namespace {

constexpr int kVersion = 1;

class SceneReader {
 public:
  SceneReader(const XmlSource& source, const std::filesystem::path& folder) : source_(source), folder_(folder) {}

  SceneDef read(pugi::xml_node root) {
    XmlElement scene(source_, root);
    if (scene.tag() != "scene") scene.fail("the file must begin with <scene>");
    int version = kVersion;
    scene.read("version", version);
    if (version != kVersion)
      scene.fail("version " + std::to_string(version) + ", this program reads " + std::to_string(kVersion));
    scene.finish();
    std::vector<std::string_view> known{"world", "material", "convex-mesh", "large-mesh", "body", "apart", "particles"};
    known.insert(known.end(), jointTags().begin(), jointTags().end());
    for (XmlElement& e : scene.children(known)) readChild(e);
    return std::move(out_);
  }

 private:
  void readChild(XmlElement& e) {
    if (e.tag() == "world") readWorld(e);
    if (e.tag() == "material") readMaterial(e);
    if (e.tag() == "convex-mesh") {
      const std::string id = newId(e);
      meshes_[id] = &out_.convex_meshes.emplace_back(readConvexMesh(e, folder_));
    }
    if (e.tag() == "large-mesh") {
      const std::string id = newId(e);
      const LargeMesh* mesh = &out_.large_meshes.emplace_back(readLargeMesh(e, folder_));
      meshes_[id] = mesh;
    }
    if (e.tag() == "body") readBody(e);
    if (e.tag() == "apart") readApart(e);
    if (e.tag() == "particles") {
      const std::string place = e.place();
      const auto body_of = [this](XmlElement& element, std::string_view name) { return bodyIndex(element, name); };
      out_.particles.push_back({readParticles(e, body_of), place});
    }
    if (std::ranges::find(jointTags(), e.tag()) != jointTags().end()) {
      const uint32_t a = bodyIndex(e, "body-a"), b = bodyIndex(e, "body-b");
      SceneJoint& joint = out_.joints.emplace_back(readJoint(e));
      joint.body_a = a;
      joint.body_b = b;
    }
  }

  std::string newId(XmlElement& e) {
    std::string id = e.requiredText("id");
    if (id.empty()) e.fail("the id is empty");
    if (meshes_.contains(id)) e.fail("the id \"" + id + "\" is used already");
    return id;
  }

  void readWorld(XmlElement& e) {
    WorldDef& w = out_.world;
    e.read("gravity", w.gravity);
    e.readName("pipeline", w.pipeline, scene_names::kPipelines);
    e.read("substeps", w.substeps);
    e.readName("joint-solver", w.joint_solver, scene_names::kJointSolvers);
    e.readName("contact-solver", w.contact_solver, scene_names::kContactSolvers);
    e.readName("friction-mixing", w.friction_mixing, scene_names::kMixings);
    e.readName("restitution-mixing", w.restitution_mixing, scene_names::kMixings);
    e.read("sleeping", w.sleeping);
    e.read("sleep-velocity", w.sleep_velocity);
    e.read("sleep-steps", w.sleep_steps);
    e.read("report-events", w.report_events);
    e.read("hit-speed", w.hit_speed);
    e.read("center", w.center);
    e.read("extent", w.extent);
    e.finish();
    constexpr int kMostSubsteps = 10000;
    if (w.substeps < 1 || w.substeps > kMostSubsteps) e.fail("substeps must be 1 .. " + std::to_string(kMostSubsteps));
    if (!w.gravity.allFinite()) e.fail("gravity is not finite");
    if (!w.center.allFinite() || !(w.extent.array() > 0.0f).all()) e.fail("the world box must have a size");
  }

  // What a body says about its surface and its damping; a material gives the values before that.
  static void readSurface(XmlElement& e, BodyDef& def) {
    e.read("friction", def.friction);
    e.read("restitution", def.restitution);
    e.read("rolling-resistance", def.rolling_resistance);
    e.read("torsional-resistance", def.surface.torsional_resistance);
    e.read("surface-velocity", def.surface.velocity);
    e.read("linear-damping", def.linear_damping);
    e.read("angular-damping", def.angular_damping);
  }

  void readMaterial(XmlElement& e) {
    const std::string id = e.requiredText("id");
    if (!materials_.emplace(id, BodyDef{}).second) e.fail("the material \"" + id + "\" is there already");
    readSurface(e, materials_[id]);
    e.finish();
  }

  void readBody(XmlElement& e) {
    SceneBody body;
    body.place = e.place();
    BodyDef& def = body.def;
    if (e.has("material")) {
      const std::string id = e.requiredText("material");
      if (!materials_.contains(id)) e.fail("there is no material \"" + id + "\" before this line");
      def = materials_[id];
    }
    def.name = e.text("name", "");
    if (e.has("id")) {
      const std::string id = e.requiredText("id");
      if (!bodies_.emplace(id, static_cast<uint32_t>(out_.bodies.size())).second)
        e.fail("the id \"" + id + "\" is used already");
    }
    e.readName("motion", def.motion_type, scene_names::kMotionTypes);
    e.read("position", def.pose.position);
    e.read("orientation", def.pose.orientation);
    e.read("linear-velocity", def.linear_velocity);
    e.read("angular-velocity", def.angular_velocity);
    e.read("mass", def.mass);
    e.read("inertia", def.inertia);
    readSurface(e, def);
    e.read("gravity-scale", def.gravity_scale);
    e.read("filter-self", def.filter_self);
    e.read("filter-target", def.filter_target);
    e.read("can-sleep", body.can_sleep);
    e.finish();
    for (XmlElement& child : e.children({"sphere", "box", "capsule", "cylinder", "convex-mesh", "large-mesh"}))
      def.shapes.push_back(readShape(child));
    if (def.shapes.empty()) e.fail("the body has no shape");
    out_.bodies.push_back(std::move(body));
  }

  void readApart(XmlElement& e) {
    const uint32_t a = bodyIndex(e, "body-a"), b = bodyIndex(e, "body-b");
    e.finish();
    out_.apart.push_back({a, b, e.place()});
  }

  Shape readShape(XmlElement& e) {
    Shape shape;
    if (e.tag() == "sphere") {
      Sphere s;
      e.read("radius", s.radius);
      shape.geometry = s;
    } else if (e.tag() == "box") {
      Box b;
      e.read("half-extent", b.half_extent);
      shape.geometry = b;
    } else if (e.tag() == "capsule") {
      shape.geometry = readRound<Capsule>(e);
    } else if (e.tag() == "cylinder") {
      shape.geometry = readRound<Cylinder>(e);
    } else if (e.tag() == "convex-mesh") {
      shape.geometry = meshOf<const ConvexMesh*>(e);
    } else {
      shape.geometry = meshOf<const LargeMesh*>(e);
    }
    e.read("position", shape.offset.position);
    e.read("orientation", shape.offset.orientation);
    e.finish();
    return shape;
  }

  template <class T>
  static T readRound(XmlElement& e) {
    T t;
    e.read("half-length", t.half_length);
    e.read("radius", t.radius);
    return t;
  }

  template <class T>
  T meshOf(XmlElement& e) {
    const std::string id = e.requiredText("mesh");
    const auto found = meshes_.find(id);
    if (found == meshes_.end()) e.fail("there is no mesh \"" + id + "\" before this line");
    const T* mesh = std::get_if<T>(&found->second);
    if (mesh == nullptr) e.fail("the mesh \"" + id + "\" is of the other kind");
    return *mesh;
  }

  uint32_t bodyIndex(XmlElement& e, std::string_view attribute) {
    const std::string id = e.requiredText(attribute);
    const auto found = bodies_.find(id);
    if (found == bodies_.end()) e.fail("there is no body with the id \"" + id + "\" before this line");
    return found->second;
  }

  const XmlSource& source_;
  std::filesystem::path folder_;
  SceneDef out_;
  std::map<std::string, std::variant<const ConvexMesh*, const LargeMesh*>> meshes_;
  std::map<std::string, uint32_t> bodies_;
  std::map<std::string, BodyDef> materials_;
};

}  // namespace

SceneDef readScene(const SceneText& text) {
  const XmlSource source{text.xml, text.name};
  pugi::xml_document document;
  const pugi::xml_parse_result parsed =
      document.load_buffer(text.xml.data(), text.xml.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!parsed) source.fail(static_cast<size_t>(std::max<std::ptrdiff_t>(parsed.offset, 0)), "", parsed.description());
  if (document.document_element().next_sibling())
    source.fail(static_cast<size_t>(document.document_element().next_sibling().offset_debug()), "",
                "something follows the scene");
  return SceneReader(source, text.folder).read(document.document_element());
}

SceneDef readScene(const std::filesystem::path& path) {
  const std::string xml = readTextFile(path);
  return readScene({.xml = xml, .name = path.string(), .folder = path.parent_path()});
}

}  // namespace pfx

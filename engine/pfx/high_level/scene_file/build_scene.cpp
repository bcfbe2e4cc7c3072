// From a scene to a world.
#include <map>

#include "pfx/high_level/scene_file/scene_file.h"

namespace pfx {
namespace {

// The geometry with its mesh replaced by the world's copy.
class MeshCopies {
 public:
  MeshCopies(const SceneDef& scene, World& world) {
    for (const ConvexMesh& m : scene.convex_meshes) convex_[&m] = world.keep(m);
    for (const LargeMesh& m : scene.large_meshes) large_[&m] = world.keep(m);
  }

  Geometry operator()(const Geometry& geometry) const {
    if (const auto* mesh = std::get_if<const ConvexMesh*>(&geometry)) return convex_.at(*mesh);
    if (const auto* mesh = std::get_if<const LargeMesh*>(&geometry)) return large_.at(*mesh);
    return geometry;
  }

 private:
  std::map<const ConvexMesh*, const ConvexMesh*> convex_;
  std::map<const LargeMesh*, const LargeMesh*> large_;
};

// The world would make the orientation a unit once more, which may change its last bit.
BodyId addBody(const SceneBody& body, const MeshCopies& meshes, World& world) {
  BodyDef def = body.def;
  for (Shape& s : def.shapes) s.geometry = meshes(s.geometry);
  const BodyId id = world.addBody(def);
  RigidState& state = world.state(id);
  state.orientation = def.pose.orientation;
  state.can_sleep = body.can_sleep;
  return id;
}

void addJoint(const SceneJoint& joint, std::span<const BodyId> bodies, World& world) {
  JointDef def = joint.def;
  def.body_a = bodies[joint.body_a];
  def.body_b = bodies[joint.body_b];
  Joint made = makeJoint(world.states()[def.body_a.index], world.states()[def.body_b.index], def.params);
  for (const auto& [axis, constraint] : joint.axes) made.axis[axis] = constraint;
  def.params = made;
  world.addJoint(def);
}

}  // namespace

void buildScene(const SceneDef& scene, World& world) {
  const MeshCopies meshes(scene, world);
  std::vector<BodyId> bodies;
  std::string place;
  try {
    for (const SceneBody& body : scene.bodies) {
      place = body.place;
      bodies.push_back(addBody(body, meshes, world));
    }
    for (const SceneJoint& joint : scene.joints) {
      place = joint.place;
      addJoint(joint, bodies, world);
    }
    for (const SceneApart& apart : scene.apart) {
      place = apart.place;
      world.keepApart(bodies[apart.body_a], bodies[apart.body_b]);
    }
    for (const SceneParticles& particles : scene.particles) {
      place = particles.place;
      ParticleDef def = particles.def;
      for (ParticleAnchor& anchor : def.anchors) anchor.body = bodies[anchor.body].index;
      world.addParticles(def);
    }
  } catch (const std::invalid_argument& e) {
    throw SceneError(place + ": " + e.what());
  }
}

namespace {

void replace(World& world, const SceneDef& scene) {
  WorldDef def = scene.world;
  def.workers = world.def().workers;
  def.simd = world.def().simd;
  World loaded(def);
  buildScene(scene, loaded);
  world = std::move(loaded);
}

}  // namespace

void loadScene(const std::filesystem::path& path, World& world) { replace(world, readScene(path)); }
void loadScene(const SceneText& text, World& world) { replace(world, readScene(text)); }

}  // namespace pfx

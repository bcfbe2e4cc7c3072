// ODE with default settings (20 iterations, ERP 0.2), sweep and prune, disabling off: with its iterative solver, and
// with its direct one.
#include <ode/ode.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "pfx/base_level/shape/large_mesh.h"
#include "samples/benchmarks/engines/engine.h"

namespace samples::benchmarks {
namespace {

constexpr int kMaxContacts = 8;  // of a pair of geometries

// ODE's library state lasts as long as one engine does.
struct OdeLibrary {
  OdeLibrary() { dInitODE2(0), dRandSetSeed(0); }
  ~OdeLibrary() { dCloseODE(); }
  OdeLibrary(const OdeLibrary&) = delete;
  OdeLibrary& operator=(const OdeLibrary&) = delete;
};

// ODE's quaternions have w first; capsules and cylinders lie along its Z, ours along X.
void setOffset(dGeomID geom, const pfx::Transform& offset, bool along_z) {
  const float half = std::sqrt(0.5f);
  const pfx::Quat turn = along_z ? pfx::Quat(half, 0.0f, half, 0.0f) : pfx::Quat(1.0f, 0.0f, 0.0f, 0.0f);
  const pfx::Quat q = offset.orientation * turn;
  const dQuaternion rotation = {q.w(), q.x(), q.y(), q.z()};
  dGeomSetOffsetPosition(geom, offset.position.x(), offset.position.y(), offset.position.z());
  dGeomSetOffsetQuaternion(geom, rotation);
}

// A triangle mesh as ODE wants it: vertices of four numbers, and its own record of both arrays.
struct OdeMesh {
  explicit OdeMesh(const pfx::LargeMesh& mesh) : data(dGeomTriMeshDataCreate()) {
    for (uint32_t facet = 0; facet < mesh.numFacets(); ++facet) {
      for (const pfx::Vec3& v : pfx::facetVertices(mesh, facet)) {
        indices.push_back(static_cast<dTriIndex>(indices.size()));
        vertices.insert(vertices.end(), {v.x(), v.y(), v.z(), 0.0f});
      }
    }
    const int count = static_cast<int>(indices.size());
    dGeomTriMeshDataBuildSingle(data, vertices.data(), 4 * sizeof(float), count, indices.data(), count,
                                3 * sizeof(dTriIndex));
  }
  ~OdeMesh() { dGeomTriMeshDataDestroy(data); }
  OdeMesh(const OdeMesh&) = delete;
  OdeMesh& operator=(const OdeMesh&) = delete;

  dTriMeshDataID data;
  std::vector<float> vertices;
  std::vector<dTriIndex> indices;
};

// ODE's counterpart of a geometry; null for convex meshes, which ODE wants as planes and polygons.
struct MakeGeom {
  dSpaceID space;
  std::vector<std::unique_ptr<OdeMesh>>& meshes;

  dGeomID operator()(const pfx::Sphere& s) const { return dCreateSphere(space, s.radius); }
  dGeomID operator()(const pfx::Box& s) const {
    return dCreateBox(space, 2 * s.half_extent.x(), 2 * s.half_extent.y(), 2 * s.half_extent.z());
  }
  dGeomID operator()(const pfx::Capsule& s) const {
    return dCreateCapsule(space, s.radius, 2 * s.half_length);
  }
  dGeomID operator()(const pfx::Cylinder& s) const {
    return dCreateCylinder(space, s.radius, 2 * s.half_length);
  }
  dGeomID operator()(const pfx::ConvexMesh*) const { return nullptr; }
  dGeomID operator()(const pfx::LargeMesh* mesh) const {
    meshes.push_back(std::make_unique<OdeMesh>(*mesh));
    return dCreateTriMesh(space, meshes.back()->data, nullptr, nullptr, nullptr);
  }
};

class OdeEngine final : public Engine {
 public:
  OdeEngine(const pfx::World& source, bool direct)
      : direct_(direct),
        world_(dWorldCreate()),
        space_(dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XZY)),
        contacts_(dJointGroupCreate(0)),
        surfaces_(source.bodies().begin(), source.bodies().end()),
        states_(source.states().begin(), source.states().end()) {
    const pfx::Vec3& g = source.def().gravity;
    dWorldSetGravity(world_, g.x(), g.y(), g.z());
    dWorldSetAutoDisableFlag(world_, 0);
  }

  ~OdeEngine() override {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }

  bool add(const pfx::RigidState& state, const pfx::RigidBody& body, std::span<const pfx::Shape> shapes) {
    const bool fixed = state.motion_type == pfx::MotionType::Fixed;
    if (!fixed && state.motion_type != pfx::MotionType::Active) return false;

    const dBodyID id = dBodyCreate(world_);
    const pfx::Quat& q = state.orientation;
    const dQuaternion rotation = {q.w(), q.x(), q.y(), q.z()};
    dBodySetPosition(id, state.position.x(), state.position.y(), state.position.z());
    dBodySetQuaternion(id, rotation);
    dBodySetLinearVel(id, state.linear_velocity.x(), state.linear_velocity.y(), state.linear_velocity.z());
    dBodySetAngularVel(id, state.angular_velocity.x(), state.angular_velocity.y(),
                       state.angular_velocity.z());
    dBodySetDamping(id, body.linear_damping, body.angular_damping);
    dBodySetData(id, surfaces_.data() + bodies_.size());
    if (fixed) {
      dBodySetKinematic(id);
    } else {
      const pfx::Mat3& i = body.inertia;
      dMass mass;
      dMassSetParameters(&mass, body.mass, 0, 0, 0, i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2));
      dBodySetMass(id, &mass);
    }
    bodies_.push_back(id);

    for (const pfx::Shape& shape : shapes) {
      const dGeomID geom = std::visit(MakeGeom{space_, meshes_}, shape.geometry);
      if (geom == nullptr) return false;
      dGeomSetBody(geom, id);
      setOffset(geom, shape.offset,
                shape.type() == pfx::ShapeType::Capsule || shape.type() == pfx::ShapeType::Cylinder);
    }
    return true;
  }

  bool add(const pfx::Joint& joint, const pfx::JointLink& link) {
    const dBodyID a = bodies_[link.body_a], b = bodies_[link.body_b];
    const pfx::RigidState& state = states_[link.body_a];
    const pfx::Vec3 anchor = state.pose().apply(joint.anchor_a);
    const pfx::Vec3 axis = state.orientation * (joint.frame_a * pfx::Vec3::UnitX());
    if (joint.kind == pfx::JointKind::Ball) {
      const dJointID id = dJointCreateBall(world_, nullptr);
      dJointAttach(id, a, b);
      dJointSetBallAnchor(id, anchor.x(), anchor.y(), anchor.z());
    } else if (joint.kind == pfx::JointKind::Fixed) {
      const dJointID id = dJointCreateFixed(world_, nullptr);
      dJointAttach(id, a, b);
      dJointSetFixed(id);
    } else if (joint.kind == pfx::JointKind::Hinge && joint.axis[3].lock == pfx::JointLock::Free) {
      const dJointID id = dJointCreateHinge(world_, nullptr);
      dJointAttach(id, a, b);
      dJointSetHingeAnchor(id, anchor.x(), anchor.y(), anchor.z());
      dJointSetHingeAxis(id, axis.x(), axis.y(), axis.z());
    } else {
      return false;
    }
    return true;
  }

  void step(float dt) override {
    dSpaceCollide(space_, this,
                  [](void* self, dGeomID a, dGeomID b) { static_cast<OdeEngine*>(self)->collide(a, b); });
    if (direct_)
      dWorldStep(world_, dt);
    else
      dWorldQuickStep(world_, dt);
    dJointGroupEmpty(contacts_);
  }

  BodyMotion motion(uint32_t index) const override {
    const dReal *p = dBodyGetPosition(bodies_[index]), *q = dBodyGetQuaternion(bodies_[index]);
    const auto vec = [](const dReal* v) { return pfx::Vec3d(double(v[0]), double(v[1]), double(v[2])); };
    return {.pose = {.position = vec(p),
                     .orientation = pfx::Quatd(double(q[0]), double(q[1]), double(q[2]), double(q[3]))},
            .linear_velocity = vec(dBodyGetLinearVel(bodies_[index])),
            .angular_velocity = vec(dBodyGetAngularVel(bodies_[index]))};
  }

 private:
  void collide(dGeomID geom_a, dGeomID geom_b) {
    const dBodyID a = dGeomGetBody(geom_a), b = dGeomGetBody(geom_b);
    if (a == b || (dBodyIsKinematic(a) && dBodyIsKinematic(b)) || dAreConnectedExcluding(a, b, dJointTypeContact))
      return;
    const pfx::RigidState &state_a = stateOf(a), &state_b = stateOf(b);
    if (!pfx::filtersMatch(state_a.filter_self, state_a.filter_target, state_b.filter_self, state_b.filter_target))
      return;
    std::array<dContact, kMaxContacts> found;
    const int count = dCollide(geom_a, geom_b, kMaxContacts, &found[0].geom, sizeof(dContact));
    const auto& surface_a = *static_cast<const pfx::RigidBody*>(dBodyGetData(a));
    const auto& surface_b = *static_cast<const pfx::RigidBody*>(dBodyGetData(b));
    for (int i = 0; i < count; ++i) {
      dContact& contact = found[static_cast<size_t>(i)];
      contact.surface = {};
      contact.surface.mode = dContactApprox1 | dContactBounce;
      contact.surface.mu = std::sqrt(surface_a.friction * surface_b.friction);
      contact.surface.bounce = 0.5f * (surface_a.restitution + surface_b.restitution);
      dJointAttach(dJointCreateContact(world_, contacts_, &contact), a, b);
    }
  }

  const pfx::RigidState& stateOf(dBodyID body) const {
    return states_[static_cast<size_t>(static_cast<const pfx::RigidBody*>(dBodyGetData(body)) - surfaces_.data())];
  }

  OdeLibrary library_;
  bool direct_;
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID contacts_;
  std::vector<std::unique_ptr<OdeMesh>> meshes_;
  std::vector<pfx::RigidBody> surfaces_;
  std::vector<pfx::RigidState> states_;  // at the start
  std::vector<dBodyID> bodies_;
};

std::unique_ptr<Engine> make(const pfx::World& world, bool direct) {
  auto engine = std::make_unique<OdeEngine>(world, direct);
  for (uint32_t i = 0; i < world.states().size(); ++i)
    if (!engine->add(world.states()[i], world.bodies()[i], world.collidables()[i].shapes())) return nullptr;
  for (uint32_t i = 0; i < world.joints().size(); ++i)
    if (world.jointLinks()[i].exists && !engine->add(world.joints()[i], world.jointLinks()[i])) return nullptr;
  return engine;
}

}  // namespace

EngineKind odeEngine() {
  return {sizeof(dReal) == 4 ? "ODE, float" : "ODE, double", [](const pfx::World& w) { return make(w, false); }};
}

EngineKind odeDirectEngine() {
  return {sizeof(dReal) == 4 ? "ODE direct, float" : "ODE direct, double",
          [](const pfx::World& w) { return make(w, true); }};
}

}  // namespace samples::benchmarks

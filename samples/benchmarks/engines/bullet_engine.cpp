// Bullet with its default solver settings (sequential impulses, 10 iterations, split impulse), sleeping off.
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <memory>
#include <vector>

#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/base_level/shape/large_mesh.h"
#include "samples/benchmarks/engines/engine.h"

namespace samples::benchmarks {
namespace {

btVector3 toBullet(const pfx::Vec3& v) { return {v.x(), v.y(), v.z()}; }
btTransform toBullet(const pfx::Transform& t) {
  const pfx::Quat& q = t.orientation;
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), toBullet(t.position));
}
pfx::Vec3d fromBullet(const btVector3& v) { return {double(v.x()), double(v.y()), double(v.z())}; }

// The frame of a joint in one of its bodies, with another axis order: Bullet's hinge turns about its z, ours about x.
btTransform jointFrame(const pfx::Vec3& anchor, const pfx::Quat& frame, bool x_to_z) {
  const float half = std::sqrt(0.5f);
  const pfx::Quat turn = x_to_z ? pfx::Quat(half, 0.0f, half, 0.0f) : pfx::Quat(1.0f, 0.0f, 0.0f, 0.0f);
  return toBullet(pfx::Transform{anchor, frame * turn});
}

// Bullet's counterpart of a geometry. Triangle meshes are kept in `meshes`, since Bullet's shape only refers
// to them.
struct MakeShape {
  using Result = std::unique_ptr<btCollisionShape>;
  std::vector<std::unique_ptr<btTriangleMesh>>& meshes;

  Result operator()(const pfx::Sphere& s) const { return std::make_unique<btSphereShape>(s.radius); }
  Result operator()(const pfx::Box& s) const { return std::make_unique<btBoxShape>(toBullet(s.half_extent)); }
  Result operator()(const pfx::Capsule& s) const {
    return std::make_unique<btCapsuleShapeX>(s.radius, 2.0f * s.half_length);
  }
  Result operator()(const pfx::Cylinder& s) const {
    return std::make_unique<btCylinderShapeX>(btVector3(s.half_length, s.radius, s.radius));
  }
  Result operator()(const pfx::ConvexMesh* mesh) const {
    auto hull = std::make_unique<btConvexHullShape>();
    for (const pfx::Vec3& v : mesh->vertices) hull->addPoint(toBullet(v), false);
    hull->recalcLocalAabb();
    return hull;
  }
  Result operator()(const pfx::LargeMesh* mesh) const {
    meshes.push_back(std::make_unique<btTriangleMesh>());
    for (uint32_t facet = 0; facet < mesh->numFacets(); ++facet) {
      const auto v = pfx::facetVertices(*mesh, facet);
      meshes.back()->addTriangle(toBullet(v[0]), toBullet(v[1]), toBullet(v[2]));
    }
    return std::make_unique<btBvhTriangleMeshShape>(meshes.back().get(), true);
  }
};

class BulletEngine final : public Engine {
 public:
  explicit BulletEngine(const pfx::Vec3& gravity) { world_.setGravity(toBullet(gravity)); }

  ~BulletEngine() override {
    for (const auto& joint : joints_) world_.removeConstraint(joint.get());
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }

  bool add(const pfx::RigidState& state, const pfx::RigidBody& body, std::span<const pfx::Shape> shapes) {
    const bool fixed = state.motion_type == pfx::MotionType::Fixed;
    if (!fixed && state.motion_type != pfx::MotionType::Active) return false;
    btCollisionShape* shape = addShapes(shapes);

    btRigidBody::btRigidBodyConstructionInfo info(fixed ? 0.0f : body.mass, nullptr, shape,
                                                  toBullet(body.inertia.diagonal()));
    info.m_startWorldTransform = toBullet(state.pose());
    // Bullet multiplies the two values of a pair, pfx takes the geometric mean (friction) or the mean
    // (restitution).
    info.m_friction = std::sqrt(body.friction);
    info.m_restitution = std::sqrt(body.restitution);
    info.m_linearDamping = body.linear_damping;
    info.m_angularDamping = body.angular_damping;
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    btRigidBody& added = *bodies_.back();
    added.setLinearVelocity(toBullet(state.linear_velocity));
    added.setAngularVelocity(toBullet(state.angular_velocity));
    added.setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(&added, static_cast<int>(state.filter_self), static_cast<int>(state.filter_target));
    return true;
  }

  bool add(const pfx::Joint& joint, const pfx::JointLink& link) {
    btRigidBody &a = *bodies_[link.body_a], &b = *bodies_[link.body_b];
    const auto frame_a = [&](bool z) { return jointFrame(joint.anchor_a, joint.frame_a, z); };
    const auto frame_b = [&](bool z) { return jointFrame(joint.anchor_b, joint.frame_b, z); };
    if (joint.kind == pfx::JointKind::Ball) {
      joints_.push_back(std::make_unique<btPoint2PointConstraint>(a, b, toBullet(joint.anchor_a),
                                                                  toBullet(joint.anchor_b)));
    } else if (joint.kind == pfx::JointKind::Fixed) {
      joints_.push_back(std::make_unique<btFixedConstraint>(a, b, frame_a(false), frame_b(false)));
    } else if (joint.kind == pfx::JointKind::Hinge && joint.axis[3].lock == pfx::JointLock::Free) {
      joints_.push_back(std::make_unique<btHingeConstraint>(a, b, frame_a(true), frame_b(true)));
    } else {
      return false;
    }
    world_.addConstraint(joints_.back().get(), !link.bodies_collide);
    return true;
  }

  void step(float dt) override { world_.stepSimulation(dt, 0); }

  BodyMotion motion(uint32_t index) const override {
    const btRigidBody& body = *bodies_[index];
    const btQuaternion q = body.getWorldTransform().getRotation();
    return {.pose = {.position = fromBullet(body.getWorldTransform().getOrigin()),
                     .orientation = pfx::Quatd(double(q.w()), double(q.x()), double(q.y()), double(q.z()))},
            .linear_velocity = fromBullet(body.getLinearVelocity()),
            .angular_velocity = fromBullet(body.getAngularVelocity())};
  }

 private:
  btCollisionShape* keep(std::unique_ptr<btCollisionShape> shape) {
    shapes_.push_back(std::move(shape));
    return shapes_.back().get();
  }

  btCollisionShape* addShapes(std::span<const pfx::Shape> shapes) {
    if (shapes.size() == 1 && shapes[0].offset.position.isZero() &&
        shapes[0].offset.orientation.isApprox(pfx::Quat::Identity())) {
      return keep(std::visit(MakeShape{meshes_}, shapes[0].geometry));
    }
    auto compound = std::make_unique<btCompoundShape>();
    for (const pfx::Shape& part : shapes) {
      btCollisionShape* child = keep(std::visit(MakeShape{meshes_}, part.geometry));
      compound->addChildShape(toBullet(part.offset), child);
    }
    return keep(std::move(compound));
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btTriangleMesh>> meshes_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<std::unique_ptr<btTypedConstraint>> joints_;
};

std::unique_ptr<Engine> make(const pfx::World& world) {
  auto engine = std::make_unique<BulletEngine>(world.def().gravity);
  for (uint32_t i = 0; i < world.states().size(); ++i)
    if (!engine->add(world.states()[i], world.bodies()[i], world.collidables()[i].shapes())) return nullptr;
  for (uint32_t i = 0; i < world.joints().size(); ++i)
    if (world.jointLinks()[i].exists && !engine->add(world.joints()[i], world.jointLinks()[i])) return nullptr;
  return engine;
}

}  // namespace

EngineKind bulletEngine() { return {sizeof(btScalar) == 4 ? "Bullet, float" : "Bullet, double", make}; }

}  // namespace samples::benchmarks

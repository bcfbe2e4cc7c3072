// Bullet: dynamic bounding volume trees, GJK and EPA with manifolds kept from step to step.
#include <btBulletCollisionCommon.h>

#include <chrono>
#include <map>

#include "pfx/base_level/shape/convex_mesh.h"
#include "tests/benchmark/low_level/narrow_phase_peers.h"

namespace pfx_test {
namespace {

using pfx::Vec3;

btVector3 toBullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
btTransform toBullet(const pfx::Transform& t) {
  const pfx::Quat& q = t.orientation;
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), toBullet(t.position));
}

class BulletNarrowPhase final : public NarrowPhasePeer {
 public:
  explicit BulletNarrowPhase(const pfx::World& world) {
    for (uint32_t i = 0; i < world.states().size(); ++i) {
      auto object = std::make_unique<btCollisionObject>();
      object->setCollisionShape(shapeOf(world.collidables()[i].shapes()[0]));
      const bool fixed = world.states()[i].motion_type == pfx::MotionType::Fixed;
      object->setCollisionFlags(fixed ? btCollisionObject::CF_STATIC_OBJECT : 0);
      object->setActivationState(DISABLE_DEACTIVATION);
      const int kind = fixed ? btBroadphaseProxy::StaticFilter : btBroadphaseProxy::DefaultFilter;
      const int other = fixed ? ~btBroadphaseProxy::StaticFilter : btBroadphaseProxy::AllFilter;
      object->setWorldTransform(toBullet(world.states()[i].pose()));
      world_.addCollisionObject(object.get(), kind, other);
      objects_.push_back(std::move(object));
    }
  }
  ~BulletNarrowPhase() override {
    for (const auto& object : objects_) world_.removeCollisionObject(object.get());
  }

  const char* name() const override { return "bullet"; }

  PeerCost findContacts(const pfx::World& world) override {
    for (size_t i = 0; i < objects_.size(); ++i) objects_[i]->setWorldTransform(toBullet(world.states()[i].pose()));
    world_.updateAabbs();
    world_.computeOverlappingPairs();
    const auto start = std::chrono::steady_clock::now();
    dispatcher_.dispatchAllCollisionPairs(world_.getPairCache(), world_.getDispatchInfo(), &dispatcher_);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    return {time.count(), static_cast<double>(world_.getPairCache()->getNumOverlappingPairs())};
  }

 private:
  btCollisionShape* shapeOf(const pfx::Shape& shape) {
    if (const auto* box = std::get_if<pfx::Box>(&shape.geometry)) {
      shapes_.push_back(std::make_unique<btBoxShape>(toBullet(box->half_extent)));
      return shapes_.back().get();
    }
    const auto* mesh = std::get<const pfx::ConvexMesh*>(shape.geometry);
    btCollisionShape*& kept = hulls_[mesh];
    if (kept == nullptr) {
      auto hull = std::make_unique<btConvexHullShape>();
      for (const Vec3& v : mesh->vertices) hull->addPoint(toBullet(v), false);
      hull->recalcLocalAabb();
      kept = hull.get();
      shapes_.push_back(std::move(hull));
    }
    return kept;
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::map<const pfx::ConvexMesh*, btCollisionShape*> hulls_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
};

}  // namespace

std::unique_ptr<NarrowPhasePeer> makeBulletPeer(const pfx::World& world) {
  return std::make_unique<BulletNarrowPhase>(world);
}

}  // namespace pfx_test

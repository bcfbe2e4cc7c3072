// ODE: a hash space, and the separating axes of convex shapes tested anew in each step.
#include <ode/ode.h>

#include <chrono>
#include <map>

#include "pfx/base_level/shape/convex_mesh.h"
#include "tests/benchmark/low_level/narrow_phase_peers.h"

namespace pfx_test {
namespace {

using pfx::Vec3;

constexpr int kMaxContacts = 8;

// Numbers as ODE wants a convex shape. It keeps pointers to them.
struct OdeConvex {
  explicit OdeConvex(const pfx::ConvexMesh& mesh) {
    for (const Vec3& v : mesh.vertices) points.insert(points.end(), {v.x(), v.y(), v.z()});
    for (const pfx::Plane& p : mesh.planes)
      planes.insert(planes.end(), {p.normal.x(), p.normal.y(), p.normal.z(), p.offset});
    for (const pfx::PolytopeFace& f : mesh.faces) {
      polygons.push_back(f.count);
      for (uint32_t i = 0; i < f.count; ++i) polygons.push_back(mesh.face_vertices[f.first + i]);
    }
  }
  std::vector<dReal> points, planes;
  std::vector<unsigned> polygons;
};

class OdeNarrowPhase final : public NarrowPhasePeer {
 public:
  explicit OdeNarrowPhase(const pfx::World& world) : space_(dHashSpaceCreate(nullptr)) {
    for (uint32_t i = 0; i < world.states().size(); ++i) {
      const dGeomID geom = makeGeom(world.collidables()[i].shapes()[0]);
      const bool fixed = world.states()[i].motion_type == pfx::MotionType::Fixed;
      dGeomSetCategoryBits(geom, fixed ? 1u : 2u);
      dGeomSetCollideBits(geom, fixed ? 2u : 3u);
      geoms_.push_back(geom);
    }
  }
  ~OdeNarrowPhase() override { dSpaceDestroy(space_); }

  const char* name() const override { return "ode"; }

  PeerCost findContacts(const pfx::World& world) override {
    for (size_t i = 0; i < geoms_.size(); ++i) {
      const pfx::Transform pose = world.states()[i].pose();
      const pfx::Quat& q = pose.orientation;
      const dQuaternion rotation = {q.w(), q.x(), q.y(), q.z()};
      dGeomSetPosition(geoms_[i], pose.position.x(), pose.position.y(), pose.position.z());
      dGeomSetQuaternion(geoms_[i], rotation);
    }
    pairs_.clear();
    dSpaceCollide(space_, this, [](void* self, dGeomID a, dGeomID b) {
      static_cast<OdeNarrowPhase*>(self)->pairs_.push_back({a, b});
    });
    dContactGeom contacts[kMaxContacts];
    const auto start = std::chrono::steady_clock::now();
    for (const auto& [a, b] : pairs_) dCollide(a, b, kMaxContacts, contacts, sizeof(dContactGeom));
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    return {time.count(), static_cast<double>(pairs_.size())};
  }

 private:
  // ODE's library state lasts as long as the peer does.
  struct Library {
    Library() { dInitODE2(0); }
    ~Library() { dCloseODE(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
  };

  dGeomID makeGeom(const pfx::Shape& shape) {
    if (const auto* box = std::get_if<pfx::Box>(&shape.geometry)) {
      const Vec3 size = 2.0f * box->half_extent;
      return dCreateBox(space_, size.x(), size.y(), size.z());
    }
    const auto* mesh = std::get<const pfx::ConvexMesh*>(shape.geometry);
    auto& kept = convex_[mesh];
    if (!kept) kept = std::make_unique<OdeConvex>(*mesh);
    return dCreateConvex(space_, kept->planes.data(), static_cast<unsigned>(mesh->planes.size()), kept->points.data(),
                         static_cast<unsigned>(mesh->vertices.size()), kept->polygons.data());
  }

  Library library_;
  std::map<const pfx::ConvexMesh*, std::unique_ptr<OdeConvex>> convex_;
  dSpaceID space_;
  std::vector<dGeomID> geoms_;
  std::vector<std::pair<dGeomID, dGeomID>> pairs_;
};

}  // namespace

std::unique_ptr<NarrowPhasePeer> makeOdePeer(const pfx::World& world) {
  return std::make_unique<OdeNarrowPhase>(world);
}

}  // namespace pfx_test

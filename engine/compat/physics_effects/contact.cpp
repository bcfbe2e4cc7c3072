#include "compat/physics_effects/contact.h"

#include <algorithm>
#include <atomic>
#include <cfloat>
#include <vector>

#include "compat/physics_effects/native.h"
#include "pfx/base_level/collision/mesh_contact.h"
#include "pfx/base_level/collision/mesh_seam.h"
#include "pfx/base_level/collision/pair_table.h"
#include "pfx/base_level/shape/collidable.h"

namespace sce::PhysicsEffects {
namespace {

PfxFloat quadArea(const PfxVector3& a, const PfxVector3& b, const PfxVector3& c, const PfxVector3& d) {
  const PfxFloat s = lengthSqr(cross(a - b, c - d)), t = lengthSqr(cross(a - c, b - d)), u = lengthSqr(cross(a - d, b - c));
  return SCE_PFX_MAX(SCE_PFX_MAX(s, t), u);
}

// Which of five points to leave out: never the deepest, and of the others the one without which most area remains.
int pointToLeaveOut(const PfxContactPoint* const (&points)[5]) {
  int deepest = 0;
  PfxVector3 p[5];
  for (int i = 0; i < 5; ++i) {
    p[i] = pfxReadVector3(points[i]->m_localPointA);
    if (points[i]->m_distance < points[deepest]->m_distance) deepest = i;
  }
  int out = -1;
  PfxFloat best = -1.0f;
  for (int i = 4; i >= 0; --i) {  // a newcomer loses a tie
    if (i == deepest) continue;
    PfxVector3 rest[4];
    for (int k = 0, n = 0; k < 5; ++k)
      if (k != i) rest[n++] = p[k];
    const PfxFloat area = quadArea(rest[0], rest[1], rest[2], rest[3]);
    if (area > best) best = area, out = i;
  }
  return out;
}

constexpr PfxFloat kSamePoint = 0.02f;  // m, how far a point may wander from step to step

constexpr PfxFloat kSameTwice = 1e-4f;   // m, closer points are one

// One pair of bodies while its contacts are looked for.
struct Detection {
  const PfxRigidState &a, &b;
  PfxContactManifold& manifold;
  const PfxContactManifold old;
};

// A point takes over the impulses of the point that it continues: the one of the same features, or, as features change
// when another face of a pair becomes the reference, the nearest one of the same shapes.
void inherit(PfxContactPoint& point, const PfxContactManifold& old) {
  const PfxContactPoint* from = nullptr;
  PfxFloat nearest = kSamePoint * kSamePoint;
  for (int i = 0; i < old.getNumContacts(); ++i) {
    const PfxContactPoint& o = old.getContactPoint(i);
    if (o.m_shapeIdA != point.m_shapeIdA || o.m_shapeIdB != point.m_shapeIdB) continue;
    const PfxFloat away = lengthSqr(pfxReadVector3(o.m_localPointA) - pfxReadVector3(point.m_localPointA));
    if (o.m_feature != point.m_feature && away >= nearest) continue;
    from = &o;
    if (o.m_feature == point.m_feature) break;
    nearest = away;
  }
  if (from == nullptr) return;
  point.m_duration = static_cast<PfxUInt8>(SCE_PFX_MIN(from->m_duration + 1, 255));
  for (int r = 0; r < 3; ++r) point.m_constraintRow[r] = from->m_constraintRow[r];
}

PfxSubData subData(const pfx::ContactPoint& p, const PfxShape& a, const PfxShape& b) {
  const PfxLargeTriMesh* mesh = a.getLargeTriMesh() != nullptr ? a.getLargeTriMesh() : b.getLargeTriMesh();
  PfxSubData sub;
  if (mesh == nullptr) return sub;
  const uint32_t island = pfx::islandOf(*mesh->m_native, p.triangle);
  sub.m_type = PfxSubData::MESH_INFO;
  sub.setIslandId(static_cast<PfxUInt16>(island));
  sub.setFacetId(static_cast<PfxUInt16>(p.triangle - mesh->m_native->islands[island].first_facet));
  sub.setUserData(pfx::userData(*mesh->m_native, p.triangle));
  sub.setFacetLocalS(p.barycentric.x());
  sub.setFacetLocalT(p.barycentric.y());
  return sub;
}

struct ShapePair {
  const PfxShape &a, &b;
  PfxUInt8 index_a, index_b;
};

void addPoints(Detection& d, const ShapePair& shapes, const pfx::ContactManifold& found) {
  for (int i = 0; i < found.num_points; ++i) {
    const pfx::ContactPoint& p = found.points[i];
    PfxContactPoint point;
    point.m_shapeIdA = shapes.index_a, point.m_shapeIdB = shapes.index_b;
    point.m_feature = p.feature;
    pfxStoreVector3(compat(p.local_a), point.m_localPointA);
    pfxStoreVector3(compat(p.local_b), point.m_localPointB);
    inherit(point, d.old);
    point.m_subData = subData(p, shapes.a, shapes.b);
    point.m_distance = p.distance;
    pfxStoreVector3(compat(-found.normal), point.m_constraintRow[0].m_normal);
    d.manifold.addContactPoint(point);
  }
}

// What one worker needs again and again.
struct Scratch {
  pfx::MeshContactScratch mesh;
  pfx::Vector<pfx::ContactManifold> found;
};
Scratch& scratchOfThread() {
  thread_local Scratch scratch;
  return scratch;
}

void collide(Detection& d, const ShapePair& shapes, Scratch& scratch) {
  const pfx::Shape a = native(shapes.a), b = native(shapes.b);
  const pfx::Transform &pose_a = poseOf(d.a), &pose_b = poseOf(d.b);
  const pfx::CollideInput input{a, pose_a, b, pose_b, SCE_PFX_CONTACT_MARGIN_, nullptr};
  if (a.type() == pfx::ShapeType::LargeMesh || b.type() == pfx::ShapeType::LargeMesh) {
    scratch.found.clear();
    pfx::collideMesh(input, scratch.mesh, scratch.found);
    for (const pfx::ContactManifold& m : scratch.found) addPoints(d, shapes, m);
  } else {
    pfx::ContactManifold m;
    if (pfx::collideShapes(input, m) > 0) addPoints(d, shapes, m);
  }
}

void detectPair(Detection& d, const PfxCollidable& a, const PfxCollidable& b, Scratch& scratch) {
  d.manifold.removeContactPoints();
  const bool compound = a.getNumShapes() * b.getNumShapes() > 1;
  for (PfxUInt32 i = 0; i < a.getNumShapes(); ++i) {
    for (PfxUInt32 j = 0; j < b.getNumShapes(); ++j) {
      const PfxShape &sa = a.getShape(i), &sb = b.getShape(j);
      if (!isValid(sa) || !isValid(sb)) continue;
      if (!pfx::filtersMatch(sa.getContactFilterSelf(), sa.getContactFilterTarget(), sb.getContactFilterSelf(),
                             sb.getContactFilterTarget()))
        continue;
      if (compound) {
        const pfx::Shape na = native(sa), nb = native(sb);
        const pfx::Aabb box = pfx::shapeAabb(na.geometry, poseOf(d.a) * na.offset).grown(SCE_PFX_CONTACT_MARGIN_);
        if (!box.overlaps(pfx::shapeAabb(nb.geometry, poseOf(d.b) * nb.offset))) continue;
      }
      collide(d, {sa, sb, static_cast<PfxUInt8>(i), static_cast<PfxUInt8>(j)}, scratch);
    }
  }
}

constexpr PfxUInt32 kNoBody = 0xffffffffu;

// The body of a pair that has a large mesh; kNoBody when none has.
PfxUInt32 meshBodyOf(const PfxDetectCollisionParam& p, const PfxConstraintPair& pair) {
  for (const PfxUInt16 body : {pfxGetRigidBodyIdA(pair), pfxGetRigidBodyIdB(pair)}) {
    const PfxCollidable& c = p.offsetCollidables[body];
    for (PfxUInt32 i = 0; i < c.getNumShapes(); ++i)
      if (c.getShape(i).getLargeTriMesh() != nullptr && isValid(c.getShape(i))) return body;
  }
  return kNoBody;
}
PfxUInt32 partnerOf(const PfxConstraintPair& pair, PfxUInt32 body) {
  return pfxGetRigidBodyIdA(pair) == body ? pfxGetRigidBodyIdB(pair) : pfxGetRigidBodyIdA(pair);
}

// Adds what the meshes of a body say of a normal at a point; both in the world.
void judge(const PfxDetectCollisionParam& p, PfxUInt32 mesh_body, const pfx::SurfacePoint& at, pfx::SeamVerdict& verdict) {
  const PfxCollidable& c = p.offsetCollidables[mesh_body];
  for (PfxUInt32 i = 0; i < c.getNumShapes(); ++i) {
    const PfxShape& shape = c.getShape(i);
    if (shape.getLargeTriMesh() == nullptr || !isValid(shape)) continue;
    const pfx::Transform to_world = poseOf(p.offsetRigidStates[mesh_body]) * native(shape).offset;
    pfx::judge(*shape.getLargeTriMesh()->m_native, {to_world.applyInverse(at.point), to_world.orientation.conjugate() * at.normal, at.slack},
               verdict);
  }
}

// Whether several meshes, or a body with several shapes one of which may be a mesh, take part, so that there can be seams.
class SeveralMeshes {
 public:
  void add(PfxUInt32 mesh_body, PfxUInt32 num_shapes) {
    PfxUInt32 none = kNoBody;
    if (num_shapes > 1 || (!first_.compare_exchange_strong(none, mesh_body) && none != mesh_body)) several_ = true;
  }
  bool any() const { return several_; }

 private:
  std::atomic<PfxUInt32> first_ = kNoBody;
  std::atomic<bool> several_ = false;
};

// Takes out the points of a pair whose normal its mesh has at an edge that another mesh continues (see mesh_seam.h).
void dropGhosts(const PfxDetectCollisionParam& p, const PfxConstraintPair& pair) {
  PfxContactManifold& manifold = p.offsetContactManifolds[pfxGetContactId(pair)];
  const PfxUInt32 mesh_body = meshBodyOf(p, pair);
  if (mesh_body == kNoBody) return;
  const PfxUInt32 body = partnerOf(pair, mesh_body);
  const bool mesh_is_a = pfxGetRigidBodyIdA(pair) == mesh_body;
  for (int k = manifold.getNumContacts() - 1; k >= 0; --k) {
    const PfxContactPoint& cp = manifold.getContactPoint(k);
    const pfx::Vec3 local = pfx::Vec3::Map(mesh_is_a ? cp.m_localPointA : cp.m_localPointB);
    const pfx::Vec3 normal = native(cp.getNormal()) * (mesh_is_a ? -1.0f : 1.0f);
    const pfx::SurfacePoint point{poseOf(p.offsetRigidStates[mesh_body]).apply(local), normal};
    pfx::SeamVerdict verdict;
    judge(p, mesh_body, point, verdict);
    for (PfxUInt32 i = 0; !verdict.is_facet_normal && i < p.numContactPairs; ++i) {
      const PfxUInt32 other = meshBodyOf(p, p.contactPairs[i]);
      if (other != kNoBody && other != mesh_body && partnerOf(p.contactPairs[i], other) == body) judge(p, other, point, verdict);
    }
    if (verdict.isGhost()) manifold.removeContactPoint(k);
  }
}

template <class Param>
PfxInt32 check(const Param& p) {
  if (p.numContactPairs == 0) return SCE_PFX_OK;
  if (p.offsetContactManifolds == nullptr || p.offsetRigidStates == nullptr) return SCE_PFX_ERR_INVALID_VALUE;
  return checkPairs(p.contactPairs, p.numContactPairs, p.numRigidBodies);
}

constexpr uint32_t kPairGrain = 64;

constexpr size_t kMeshContactRoom = 128;  // normals that a body may meet on a mesh before memory is taken in a step

}  // namespace

PfxInt32 checkPairs(const PfxConstraintPair* pairs, PfxUInt32 count, PfxUInt32 num_bodies) {
  if (count == 0) return SCE_PFX_OK;
  if (pairs == nullptr) return SCE_PFX_ERR_INVALID_VALUE;
  if (!aligned16(pairs)) return SCE_PFX_ERR_INVALID_ALIGN;
  PfxUInt16 highest = 0;
  for (PfxUInt32 i = 0; i < count; ++i)
    highest = std::max({highest, pfxGetRigidBodyIdA(pairs[i]), pfxGetRigidBodyIdB(pairs[i])});
  return num_bodies > 0 && highest >= num_bodies ? SCE_PFX_ERR_OUT_OF_RANGE : SCE_PFX_OK;
}

void reserveMeshContacts() {
  constexpr size_t kMostFacets = 32768;  // of a mesh
  Scratch& scratch = scratchOfThread();
  scratch.mesh.facets.reserve(kMostFacets);
  scratch.mesh.clusters.reserve(kMeshContactRoom);
  scratch.mesh.vertices.reserve(kMeshContactRoom);
  scratch.mesh.planes.reserve(kMeshContactRoom);
  scratch.found.reserve(kMeshContactRoom);
}

void PfxContactPoint::reset() {
  m_duration = m_shapeIdA = m_shapeIdB = 0;
  m_feature = 0;
  m_subData = PfxSubData();
  m_distance = FLT_MAX;
  for (int k = 0; k < 3; ++k) m_localPointA[k] = m_localPointB[k] = m_armA[k] = m_armB[k] = 0.0f;
  for (PfxConstraintRow& row : m_constraintRow) row = {};
  m_pushRhs = m_push[0] = m_push[1] = m_push[2] = 0.0f;
}

void PfxContactManifold::reset(PfxUInt16 rigidBodyIdA, PfxUInt16 rigidBodyIdB) {
  body_a_ = rigidBodyIdA, body_b_ = rigidBodyIdB;
  duration_ = 0;
  num_points_ = 0;
  friction_ = 0.0f;
}

void PfxContactManifold::addContactPoint(PfxFloat distance, const PfxVector3& normal, const PfxPoint3& pointA,
                                         const PfxPoint3& pointB, const PfxSubData& subData) {
  PfxContactPoint p;
  p.m_distance = distance;
  p.m_subData = subData;
  pfxStorePoint3(pointA, p.m_localPointA);
  pfxStorePoint3(pointB, p.m_localPointB);
  pfxStoreVector3(normal, p.m_constraintRow[0].m_normal);
  addContactPoint(p);
}

void PfxContactManifold::addContactPoint(const PfxContactPoint& point) {
  for (int i = 0; i < num_points_; ++i) {  // the same point again: the deeper one stays
    if (lengthSqr(pfxReadVector3(points_[i].m_localPointA) - pfxReadVector3(point.m_localPointA)) > kSameTwice * kSameTwice) continue;
    if (dot(points_[i].getNormal(), point.getNormal()) < 0.9f) continue;
    if (point.m_distance < points_[i].m_distance) points_[i] = point;
    return;
  }
  if (num_points_ < SCE_PFX_NUMCONTACTS_PER_BODIES) {
    points_[num_points_++] = point;
    return;
  }
  const int out = pointToLeaveOut({&points_[0], &points_[1], &points_[2], &points_[3], &point});
  if (out < 4) points_[out] = point;
}

void PfxContactManifold::refresh(const PfxVector3& positionA, const PfxQuat& orientationA, const PfxVector3& positionB,
                                 const PfxQuat& orientationB) {
  for (int i = num_points_ - 1; i >= 0; --i) {
    PfxContactPoint& p = points_[i];
    const PfxVector3 gap = positionA + rotate(orientationA, pfxReadVector3(p.m_localPointA)) - positionB -
                           rotate(orientationB, pfxReadVector3(p.m_localPointB));
    p.m_distance = dot(p.getNormal(), gap);
    const PfxVector3 slip = gap - p.m_distance * p.getNormal();
    if (p.m_distance > SCE_PFX_CONTACT_MARGIN_ || lengthSqr(slip) > SCE_PFX_CONTACT_MARGIN_ * SCE_PFX_CONTACT_MARGIN_)
      removeContactPoint(i);
  }
}

PfxInt32 pfxDetectCollision(PfxDetectCollisionParam& param, PfxTaskManager* taskManager) {
  if (const PfxInt32 error = check(param); error != SCE_PFX_OK) return error;
  if (param.numContactPairs > 0 && param.offsetCollidables == nullptr) return SCE_PFX_ERR_INVALID_VALUE;
  SeveralMeshes meshes;
  pfx::parallelFor(poolOf(taskManager), param.numContactPairs, kPairGrain, [&](pfx::TaskRange range) {
    Scratch& scratch = scratchOfThread();
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const PfxConstraintPair& pair = param.contactPairs[i];
      const PfxUInt16 a = pfxGetRigidBodyIdA(pair), b = pfxGetRigidBodyIdB(pair);
      const PfxRigidState &state_a = param.offsetRigidStates[a], &state_b = param.offsetRigidStates[b];
      if (!pfxGetActive(pair) || !meetBy(kDetected, state_a, state_b)) continue;
      PfxContactManifold& manifold = param.offsetContactManifolds[pfxGetContactId(pair)];
      Detection d{state_a, state_b, manifold, manifold};
      detectPair(d, param.offsetCollidables[a], param.offsetCollidables[b], scratch);
      if (manifold.getNumContacts() == 0) continue;
      if (const PfxUInt32 mesh = meshBodyOf(param, pair); mesh != kNoBody) meshes.add(mesh, param.offsetCollidables[mesh].getNumShapes());
    }
  });
  if (!meshes.any()) return SCE_PFX_OK;
  pfx::parallelFor(poolOf(taskManager), param.numContactPairs, kPairGrain, [&](pfx::TaskRange range) {
    for (uint32_t i = range.begin; i < range.end; ++i)
      if (pfxGetActive(param.contactPairs[i])) dropGhosts(param, param.contactPairs[i]);
  });
  return SCE_PFX_OK;
}

PfxInt32 pfxRefreshContacts(PfxRefreshContactsParam& param, PfxTaskManager* taskManager) {
  if (const PfxInt32 error = check(param); error != SCE_PFX_OK) return error;
  pfx::parallelFor(poolOf(taskManager), param.numContactPairs, kPairGrain, [&](pfx::TaskRange range) {
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const PfxConstraintPair& pair = param.contactPairs[i];
      const PfxRigidState& a = param.offsetRigidStates[pfxGetRigidBodyIdA(pair)];
      const PfxRigidState& b = param.offsetRigidStates[pfxGetRigidBodyIdB(pair)];
      if (!pfxGetActive(pair)) continue;
      PfxContactManifold& manifold = param.offsetContactManifolds[pfxGetContactId(pair)];
      manifold.refresh(a.getPosition(), a.getOrientation(), b.getPosition(), b.getOrientation());
      manifold.countStep();
    }
  });
  return SCE_PFX_OK;
}

}  // namespace sce::PhysicsEffects

// Debug rendering: what the stages work on, drawn through five callbacks of the application.
#pragma once

#include "contact.h"
#include "island.h"
#include "joint.h"

// What to draw of a large mesh.
#define SCE_PFX_DRENDER_MESH_FLG_ISLAND 0x01      // a box round each island
#define SCE_PFX_DRENDER_MESH_FLG_EDGE 0x02        // 3 lines a triangle
#define SCE_PFX_DRENDER_MESH_FLG_FACET_AABB 0x04  // a box round each triangle
#define SCE_PFX_DRENDER_MESH_FLG_NORMAL 0x08      // 1 line a triangle
#define SCE_PFX_DRENDER_MESH_FLG_THICKNESS 0x10   // with EDGE: 6 more lines, the lower face and the sides
#define SCE_PFX_DRENDER_MESH_FLG_ALL 0x1f

namespace sce {
namespace PhysicsEffects {

// World coordinates, m and rad; colours are red, green, blue, 0 .. 1.
typedef void (*PfxDebugRenderPointFunc)(const PfxVector3& position, const PfxVector3& color);
typedef void (*PfxDebugRenderLineFunc)(const PfxVector3& position1, const PfxVector3& position2, const PfxVector3& color);
// An arc about `axis` through `pos`, from startRad to endRad counted from `dir`.
typedef void (*PfxDebugRenderArcFunc)(const PfxVector3& pos, const PfxVector3& axis, const PfxVector3& dir, PfxFloat radius,
                                      PfxFloat startRad, PfxFloat endRad, const PfxVector3& color);
typedef void (*PfxDebugRenderAabbFunc)(const PfxVector3& center, const PfxVector3& halfExtent, const PfxVector3& color);
typedef void (*PfxDebugRenderBoxFunc)(const PfxTransform3& transform, const PfxVector3& halfExtent, const PfxVector3& color);

// The arguments of a render method, told apart by their types. A number belongs to the array in front of it; one that
// belongs to none, or to one that has its number, is the flags.
struct PfxDebugRenderArguments {
  // What was found among the arguments; NULL and 0: not given.
  const PfxRigidState* states = nullptr;
  const PfxCollidable* collidables = nullptr;
  const PfxIsland* island = nullptr;
  const PfxContactManifold* contacts = nullptr;
  const PfxConstraintPair* pairs = nullptr;
  const PfxJoint* joints = nullptr;
  const PfxVector4* planes = nullptr;
  PfxUInt32 flag = 0;
  PfxUInt32 numRigidBodies = 0, numItems = 0, numPlanes = 0;

  // Sorts the arguments.
  template <class... Args>
  explicit PfxDebugRenderArguments(const Args&... args) {
    const int inOrder[] = {(take(args), 0)...};
    static_cast<void>(inOrder);
    if (numItems == 0) numItems = numRigidBodies;
  }

 private:
  void take(const PfxRigidState* p) { states = p, number_ = &numRigidBodies; }
  void take(const PfxCollidable* p) { collidables = p, number_ = &numRigidBodies; }
  void take(const PfxIsland* p) { island = p, number_ = nullptr; }
  void take(const PfxContactManifold* p) { contacts = p, number_ = &numItems; }
  void take(const PfxConstraintPair* p) { pairs = p, number_ = &numItems; }
  void take(const PfxJoint* p) { joints = p, number_ = &numItems; }
  void take(const PfxVector4* p) { planes = p, number_ = &numPlanes; }
  void take(PfxUInt32 n) {
    *(number_ == nullptr || *number_ != 0 ? &flag : number_) = n;
  }
  PfxUInt32* number_ = nullptr;
};

// Each method calls back once for each thing that it draws; a callback that is not set is left out. Arguments of the
// render methods may come in any order, numbers behind their arrays; the usual order is given.
class PfxDebugRender {
 public:
  // Without callbacks: nothing is drawn.
  PfxDebugRender();
  ~PfxDebugRender();
  PfxDebugRender(const PfxDebugRender&) = delete;
  PfxDebugRender& operator=(const PfxDebugRender&) = delete;

  // The callbacks; NULL: what they draw is left out.
  void setDebugRenderPointFunc(PfxDebugRenderPointFunc func) { point_ = func; }
  void setDebugRenderLineFunc(PfxDebugRenderLineFunc func) { line_ = func; }
  void setDebugRenderArcFunc(PfxDebugRenderArcFunc func) { arc_ = func; }
  void setDebugRenderAabbFunc(PfxDebugRenderAabbFunc func) { aabb_ = func; }
  void setDebugRenderBoxFunc(PfxDebugRenderBoxFunc func) { box_ = func; }

  // Length of axes and normals, m.
  PfxFloat getScale() const { return scale_; }
  void setScale(PfxFloat scale) { scale_ = scale; }

  // Makes bodies 0 .. numRigidBodies - 1 visible. Bodies that were never named are visible.
  void resetVisible(PfxUInt32 numRigidBodies);
  // Of one body.
  void setVisible(PfxUInt32 rigidBodyId, PfxBool visible);
  PfxBool getVisible(PfxUInt32 rigidBodyId) const;

  // 1 AABB.
  void renderWorld(const PfxVector3& worldCenter, const PfxVector3& worldExtent);
  // (states, collidables, numRigidBodies): 1 AABB a visible body.
  template <class... Args>
  void renderAabb(const Args&... args) {
    drawAabb(PfxDebugRenderArguments(args...));
  }
  // (states, numRigidBodies): 3 lines a visible body, x red, y green, z blue.
  template <class... Args>
  void renderLocalAxis(const Args&... args) {
    drawLocalAxis(PfxDebugRenderArguments(args...));
  }
  // (island, states, collidables): 1 AABB an island, round its visible bodies.
  template <class... Args>
  void renderIsland(const Args&... args) {
    drawIsland(PfxDebugRenderArguments(args...));
  }
  // (contacts, numContacts, states), or (pairs, numPairs, contacts, states): for each contact point and visible body of
  // the two 1 point and 1 line along its outward normal.
  template <class... Args>
  void renderContact(const Args&... args) {
    drawContact(PfxDebugRenderArguments(args...));
  }
  // (joints, numJoints, states), or with pairs: 2 points and 6 lines a joint, and the ranges of its axes: 3 lines for a
  // slider, 1 arc for a hinge, 2 for a universal joint, 3 for a swing twist joint.
  template <class... Args>
  void renderJoint(const Args&... args) {
    drawJoint(PfxDebugRenderArguments(args...));
  }
  // (states, collidables, numRigidBodies, flag): the large meshes of all visible bodies.
  template <class... Args>
  void renderLargeMesh(const Args&... args) {
    drawLargeMesh(PfxDebugRenderArguments(args...));
  }
  // (states, collidables, numRigidBodies, flag, planes, numPlanes): of those, the islands whose bounding spheres touch the
  // inside of all planes (normal, offset), where normal . x + offset >= 0. A single plane is a sphere (centre, radius).
  template <class... Args>
  void renderLargeMeshInFrustum(const Args&... args) {
    drawLargeMeshInFrustum(PfxDebugRenderArguments(args...));
  }
  // (states, collidables, numRigidBodies): of those, the triangles that were marked, each with its own flags.
  template <class... Args>
  void renderLargeMeshByFlag(const Args&... args) {
    drawLargeMeshByFlag(PfxDebugRenderArguments(args...));
  }
  // Marks a triangle of a body's mesh; 0 takes the mark away. SCE_PFX_ERR_OUT_OF_RANGE for an island >= 512 or a triangle
  // >= 64, SCE_PFX_ERR_INVALID_FLAG for unknown flags.
  PfxInt32 setLargeMeshFlag(PfxUInt32 rigidBodyId, PfxUInt32 islandId, PfxUInt32 facetId, PfxUInt32 flag);

 private:
  void drawAabb(const PfxDebugRenderArguments& a);
  void drawLocalAxis(const PfxDebugRenderArguments& a);
  void drawIsland(const PfxDebugRenderArguments& a);
  void drawContact(const PfxDebugRenderArguments& a);
  void drawJoint(const PfxDebugRenderArguments& a);
  void drawLargeMesh(const PfxDebugRenderArguments& a);
  void drawLargeMeshInFrustum(const PfxDebugRenderArguments& a);
  void drawLargeMeshByFlag(const PfxDebugRenderArguments& a);
  void drawPoint(const PfxVector3& point, const PfxVector3& outward);

  struct Native;
  Native* native_;
  PfxDebugRenderPointFunc point_ = nullptr;
  PfxDebugRenderLineFunc line_ = nullptr;
  PfxDebugRenderArcFunc arc_ = nullptr;
  PfxDebugRenderAabbFunc aabb_ = nullptr;
  PfxDebugRenderBoxFunc box_ = nullptr;
  PfxFloat scale_ = 1.0f;
};

}  // namespace PhysicsEffects
}  // namespace sce

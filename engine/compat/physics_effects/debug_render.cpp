#include "compat/physics_effects/debug_render.h"

#include <map>
#include <vector>

#include "compat/physics_effects/native.h"
#include "pfx/util/debug_render/debug_render.h"
#include "pfx/util/debug_render/palette.h"

namespace sce::PhysicsEffects {
namespace {

PfxVector3 colorOf(pfx::Color c) {
  const auto channel = [c](int shift) { return static_cast<PfxFloat>(c >> shift & 0xffu) / 255.0f; };
  return PfxVector3(channel(16), channel(8), channel(0));
}

struct MeshOfBody {
  pfx::RigidState state;
  pfx::Collidable collidable;
};

// Calls fn(body, MeshOfBody) for each large mesh of each visible body, as the engine's own renderer takes it.
template <class Fn>
void forEachMesh(const PfxDebugRender& render, const PfxDebugRenderArguments& a, Fn&& fn) {
  if (a.states == nullptr || a.collidables == nullptr) return;
  for (PfxUInt32 body = 0; body < a.numRigidBodies; ++body) {
    if (!render.getVisible(body)) continue;
    const PfxCollidable& collidable = a.collidables[body];
    for (PfxUInt32 i = 0; i < collidable.getNumShapes(); ++i) {
      const PfxShape& shape = collidable.getShape(i);
      if (shape.getType() != kPfxShapeLargeTriMesh || !isValid(shape)) continue;
      MeshOfBody m;
      m.state = native(a.states[body]);
      m.collidable.inline_shape = native(shape);
      fn(body, m);
    }
  }
}

pfx::MeshDraw meshDraw(PfxUInt32 flag) { return static_cast<pfx::MeshDraw>(flag & SCE_PFX_DRENDER_MESH_FLG_ALL); }

}  // namespace

// The engine's renderer, which calls back to the functions of the application, and one a body for its marked triangles.
struct PfxDebugRender::Native {
  pfx::DebugRender render;
  std::map<PfxUInt32, pfx::DebugRender> marked;
  std::vector<bool> hidden;  // by body

  pfx::DebugRender& with(const pfx::DebugRenderCallbacks& callbacks, PfxFloat scale, pfx::DebugRender& r) {
    r.callbacks = callbacks, r.scale = scale;
    return r;
  }
  static pfx::DebugRenderCallbacks callbacksOf(PfxDebugRender& r);
};

pfx::DebugRenderCallbacks PfxDebugRender::Native::callbacksOf(PfxDebugRender& r) {
  pfx::DebugRenderCallbacks c;
  c.context = &r;
  if (r.point_ != nullptr)
    c.point = [](void* context, const pfx::Vec3& p, pfx::Color color) {
      static_cast<PfxDebugRender*>(context)->point_(compat(p), colorOf(color));
    };
  if (r.line_ != nullptr)
    c.line = [](void* context, const pfx::Vec3& from, const pfx::Vec3& to, pfx::Color color) {
      static_cast<PfxDebugRender*>(context)->line_(compat(from), compat(to), colorOf(color));
    };
  if (r.arc_ != nullptr)
    c.arc = [](void* context, const pfx::Vec3& center, const pfx::Vec3& axis, const pfx::Vec3& direction, float radius,
               float start, float end, pfx::Color color) {
      static_cast<PfxDebugRender*>(context)->arc_(compat(center), compat(axis), compat(direction), radius, start, end,
                                                  colorOf(color));
    };
  if (r.box_ != nullptr)
    c.box = [](void* context, const pfx::Transform& pose, const pfx::Vec3& half, pfx::Color color) {
      static_cast<PfxDebugRender*>(context)->box_(PfxTransform3(compat(pose.orientation), compat(pose.position)),
                                                  compat(half), colorOf(color));
    };
  return c;
}

PfxDebugRender::PfxDebugRender() : native_(new Native) {}
PfxDebugRender::~PfxDebugRender() { delete native_; }

void PfxDebugRender::resetVisible(PfxUInt32 numRigidBodies) { native_->hidden.assign(numRigidBodies, false); }
void PfxDebugRender::setVisible(PfxUInt32 id, PfxBool visible) {
  if (id >= native_->hidden.size()) native_->hidden.resize(id + size_t{1}, false);
  native_->hidden[id] = !visible;
}
PfxBool PfxDebugRender::getVisible(PfxUInt32 id) const { return id >= native_->hidden.size() || !native_->hidden[id]; }

void PfxDebugRender::renderWorld(const PfxVector3& worldCenter, const PfxVector3& worldExtent) {
  if (aabb_ != nullptr) aabb_(worldCenter, worldExtent, colorOf(pfx::kWorldColor));
}

void PfxDebugRender::drawAabb(const PfxDebugRenderArguments& a) {
  if (aabb_ == nullptr || a.states == nullptr || a.collidables == nullptr) return;
  for (PfxUInt32 i = 0; i < a.numRigidBodies; ++i) {
    if (!getVisible(i)) continue;
    const pfx::Aabb box = bodyAabb(a.states[i], a.collidables[i]);
    aabb_(compat(box.center()), compat(box.halfExtent()), colorOf(pfx::bodyLook(native(a.states[i]), i).color));
  }
}

void PfxDebugRender::drawLocalAxis(const PfxDebugRenderArguments& a) {
  if (line_ == nullptr || a.states == nullptr) return;
  for (PfxUInt32 i = 0; i < a.numRigidBodies; ++i) {
    if (!getVisible(i)) continue;
    const PfxVector3 origin = a.states[i].getPosition();
    const PfxMatrix3 axes(a.states[i].getOrientation());
    for (int k = 0; k < 3; ++k) line_(origin, origin + scale_ * axes[k], colorOf(pfx::kAxisColors[k]));
  }
}

void PfxDebugRender::drawIsland(const PfxDebugRenderArguments& a) {
  if (aabb_ == nullptr || a.states == nullptr || a.collidables == nullptr) return;
  for (PfxUInt32 i = 0; i < pfxGetNumIslands(a.island); ++i) {
    pfx::Aabb box;
    bool seen = false;
    for (PfxIslandUnit* unit = pfxGetFirstUnitInIsland(a.island, i); unit != nullptr; unit = pfxGetNextUnitInIsland(unit)) {
      const PfxUInt32 body = pfxGetUnitId(unit);
      if (!getVisible(body)) continue;
      box.extend(bodyAabb(a.states[body], a.collidables[body]));
      seen = true;
    }
    if (seen) aabb_(compat(box.center()), compat(box.halfExtent()), colorOf(pfx::indexColor(i)));
  }
}

void PfxDebugRender::drawPoint(const PfxVector3& point, const PfxVector3& outward) {
  if (point_ != nullptr) point_(point, colorOf(pfx::kContactPointColor));
  if (line_ != nullptr) line_(point, point + scale_ * outward, colorOf(pfx::kContactNormalColor));
}

void PfxDebugRender::drawContact(const PfxDebugRenderArguments& a) {
  if (a.contacts == nullptr || a.states == nullptr) return;
  for (PfxUInt32 i = 0; i < a.numItems; ++i) {
    const PfxContactManifold& manifold = a.contacts[a.pairs != nullptr ? pfxGetContactId(a.pairs[i]) : i];
    const PfxUInt16 id_a = manifold.getRigidBodyIdA(), id_b = manifold.getRigidBodyIdB();
    const PfxRigidState &state_a = a.states[id_a], &state_b = a.states[id_b];
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const PfxContactPoint& p = manifold.getContactPoint(k);
      const auto place = [](const PfxRigidState& s, const PfxFloat* local) {
        return s.getPosition() + rotate(s.getOrientation(), pfxReadVector3(local));
      };
      if (getVisible(id_a)) drawPoint(place(state_a, p.m_localPointA), -p.getNormal());
      if (getVisible(id_b)) drawPoint(place(state_b, p.m_localPointB), p.getNormal());
    }
  }
}

void PfxDebugRender::drawJoint(const PfxDebugRenderArguments& a) {
  if (a.joints == nullptr || a.states == nullptr) return;
  pfx::DebugRender& render = native_->with(Native::callbacksOf(*this), scale_, native_->render);
  for (PfxUInt32 i = 0; i < a.numItems; ++i) {
    const PfxJoint& joint = a.joints[a.pairs != nullptr ? pfxGetConstraintId(a.pairs[i]) : i];
    const PfxRigidState &state_a = a.states[joint.m_rigidBodyIdA], &state_b = a.states[joint.m_rigidBodyIdB];
    const pfx::Joint j = nativeJoint(joint);
    render.renderJoint(j, poseOf(state_a), poseOf(state_b));
    if (joint.m_type != kPfxJointSlider || j.axis[0].lock != pfx::JointLock::Limit || line_ == nullptr) continue;
    // The ends of a slider's way, across it.
    const pfx::Transform frame = poseOf(state_a) * pfx::Transform{j.anchor_a, j.frame_a};
    for (const float end : {j.axis[0].lower, j.axis[0].upper}) {
      const float half = 0.25f * scale_;
      line_(compat(frame.apply({end, -half, 0.0f})), compat(frame.apply({end, half, 0.0f})), colorOf(pfx::kWorldColor));
    }
  }
}

void PfxDebugRender::drawLargeMesh(const PfxDebugRenderArguments& a) {
  pfx::DebugRender& render = native_->with(Native::callbacksOf(*this), scale_, native_->render);
  forEachMesh(*this, a, [&](PfxUInt32, const MeshOfBody& m) {
    render.renderLargeMesh({&m.state, 1}, {&m.collidable, 1}, meshDraw(a.flag));
  });
}

void PfxDebugRender::drawLargeMeshInFrustum(const PfxDebugRenderArguments& a) {
  if (a.planes == nullptr && a.numPlanes > 0) return;
  pfx::DebugRender& render = native_->with(Native::callbacksOf(*this), scale_, native_->render);
  std::vector<pfx::FrustumPlane> planes;
  for (PfxUInt32 i = 0; i < a.numPlanes; ++i) planes.push_back({native(a.planes[i].getXYZ()), a.planes[i][3]});
  forEachMesh(*this, a, [&](PfxUInt32, const MeshOfBody& m) {
    if (planes.size() == 1) {
      render.renderLargeMeshInSphere({&m.state, 1}, {&m.collidable, 1}, meshDraw(a.flag), planes[0].normal, planes[0].offset);
    } else {
      render.renderLargeMeshInFrustum({&m.state, 1}, {&m.collidable, 1}, meshDraw(a.flag), planes);
    }
  });
}

void PfxDebugRender::drawLargeMeshByFlag(const PfxDebugRenderArguments& a) {
  forEachMesh(*this, a, [&](PfxUInt32 body, const MeshOfBody& m) {
    const auto marked = native_->marked.find(body);
    if (marked == native_->marked.end()) return;
    native_->with(Native::callbacksOf(*this), scale_, marked->second).renderLargeMeshByFlag({&m.state, 1}, {&m.collidable, 1});
  });
}

PfxInt32 PfxDebugRender::setLargeMeshFlag(PfxUInt32 rigidBodyId, PfxUInt32 islandId, PfxUInt32 facetId, PfxUInt32 flag) {
  if (islandId >= SCE_PFX_MAX_LARGETRIMESH_ISLANDS || facetId >= SCE_PFX_MAX_ISLAND_FACETS) return SCE_PFX_ERR_OUT_OF_RANGE;
  if ((flag & ~PfxUInt32(SCE_PFX_DRENDER_MESH_FLG_ALL)) != 0) return SCE_PFX_ERR_INVALID_FLAG;
  native_->marked[rigidBodyId].setLargeMeshFlag({0, islandId, facetId}, meshDraw(flag));
  return SCE_PFX_OK;
}

}  // namespace sce::PhysicsEffects

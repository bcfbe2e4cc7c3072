// Rays against bodies.
#pragma once

#include "contact.h"

// Which sides of the triangles of a mesh a ray hits.
#define SCE_PFX_RAY_FACET_MODE_FRONT_ONLY 0
#define SCE_PFX_RAY_FACET_MODE_BACK_ONLY 1
#define SCE_PFX_RAY_FACET_MODE_FRONT_AND_BACK 2

namespace sce {
namespace PhysicsEffects {

// From m_startPosition to m_startPosition + m_direction; nothing beyond is hit.
struct PfxRayInput {
  // Filters as those of a body; the ray, and the sides of triangles that it hits (SCE_PFX_RAY_FACET_MODE_...).
  PfxUInt32 m_contactFilterSelf;
  PfxUInt32 m_contactFilterTarget;
  PfxVector3 m_startPosition;  // m
  PfxVector3 m_direction;      // m
  PfxUInt8 m_facetMode;

  // Filters all ones, fronts only, and no length yet.
  PfxRayInput() { reset(); }
  void reset() {
    m_contactFilterSelf = m_contactFilterTarget = 0xffffffffu;
    m_startPosition = m_direction = PfxVector3(0.0f);
    m_facetMode = SCE_PFX_RAY_FACET_MODE_FRONT_ONLY;
  }
};

// The nearest hit.
struct PfxRayOutput {
  // Whether anything was hit; then where (m, world), the unit normal there, the body, its shape and the triangle of a mesh.
  PfxBool m_contactFlag = false;
  PfxFloat m_variable = 1.0f;  // of the direction, 0 .. 1
  PfxVector3 m_contactPoint = PfxVector3(0.0f);
  PfxVector3 m_contactNormal = PfxVector3(0.0f);
  union {
    PfxUInt16 m_rigidBodyId = 0;
    PfxUInt16 m_objectId;
  };
  // The shape of the body, and the triangle when it is a large mesh.
  PfxUInt8 m_shapeId = 0;
  PfxSubData m_subData;
};

// The bodies, their proxies, and the world of the proxies.
struct PfxRayCastParam {
  // Arrays of the application; those of the proxies as pfxUpdateBroadphaseProxies() has left them, NULL: not there.
  PfxRigidState* offsetRigidStates = nullptr;
  PfxCollidable* offsetCollidables = nullptr;
  PfxBroadphaseProxy* proxiesX = nullptr;
  PfxBroadphaseProxy* proxiesY = nullptr;
  PfxBroadphaseProxy* proxiesZ = nullptr;
  PfxBroadphaseProxy* proxiesXb = nullptr;
  PfxBroadphaseProxy* proxiesYb = nullptr;
  PfxBroadphaseProxy* proxiesZb = nullptr;
  PfxUInt32 numProxies = 0;
  PfxVector3 rangeCenter = PfxVector3(0.0f);    // the world that the proxies were made for
  PfxVector3 rangeExtent = PfxVector3(500.0f);
};

// The nearest hit among the bodies that have proxies. A call with bad parameters, or a ray without length, hits nothing.
// Rays may be cast from several threads while nothing changes what the parameters point at.
void pfxCastSingleRay(const PfxRayInput& ray, PfxRayOutput& out, const PfxRayCastParam& param);
void pfxCastRays(const PfxRayInput* rayInputs, PfxRayOutput* rayOutputs, int numRays, const PfxRayCastParam& param,
                 PfxTaskManager* taskManager = nullptr);

}  // namespace PhysicsEffects
}  // namespace sce

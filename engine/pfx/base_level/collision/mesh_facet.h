// Contacts of a convex body with one facet of a mesh.
#pragma once

#include "pfx/base_level/collision/mesh_body.h"
#include "pfx/base_level/collision/mesh_contact.h"
#include "pfx/base_level/memory/containers.h"

namespace pfx {

struct FacetContext {
  const LargeMesh& mesh;
  const MeshBody& body;
  float margin;  // m
  Vector<MeshCluster>& clusters;
};

// Adds what the facet contributes to the clusters.
void collideFacet(const FacetContext& context, uint32_t facet);

}  // namespace pfx

// Contacts with one normal become one manifold.
#pragma once

#include "pfx/base_level/collision/mesh_facet.h"

namespace pfx {

// Adds a contact to the cluster of its normal, unless it lies beyond the margin. Contacts that are not primary count
// only where they touch or where a primary one has the same normal.
void addContact(const FacetContext& context, const Vec3& normal, bool primary, const MeshContact& contact);

// The contacts of a cluster by the four-point rule. Returns how many were written; none for a cluster that does not
// count.
int reduceCluster(const MeshCluster& cluster, float size, MeshContact (&out)[kMaxContactPoints]);

}  // namespace pfx

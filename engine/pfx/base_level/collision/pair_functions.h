// The entries of the pair table. Each fills the manifold in the frame of its first shape; see pair_table.h.
#pragma once

#include "pfx/base_level/collision/pair_table.h"

namespace pfx {

void collideSphereSphere(const LocalPair& pair, LocalResult& result);
void collideSphereBox(const LocalPair& pair, LocalResult& result);
void collideSphereCapsule(const LocalPair& pair, LocalResult& result);
void collideBoxBox(const LocalPair& pair, LocalResult& result);
void collideBoxCapsule(const LocalPair& pair, LocalResult& result);
void collideCapsuleCapsule(const LocalPair& pair, LocalResult& result);
void collideSphereCylinder(const LocalPair& pair, LocalResult& result);
void collideCylinderBox(const LocalPair& pair, LocalResult& result);
void collideCylinderCapsule(const LocalPair& pair, LocalResult& result);
void collideCylinderCylinder(const LocalPair& pair, LocalResult& result);
void collideCylinderConvex(const LocalPair& pair, LocalResult& result);
void collideConvexSphere(const LocalPair& pair, LocalResult& result);
void collideConvexBox(const LocalPair& pair, LocalResult& result);
void collideConvexCapsule(const LocalPair& pair, LocalResult& result);
void collideConvexConvex(const LocalPair& pair, LocalResult& result);

}  // namespace pfx

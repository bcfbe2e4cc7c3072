// Everything of a large mesh that follows from where its vertices are.
#pragma once

#include "pfx/base_level/shape/large_mesh.h"

namespace pfx {

// Beyond 1e15 m areas and volumes would leave the range of floats.
inline bool validPosition(const Vec3& p) { return p.allFinite() && p.cwiseAbs().maxCoeff() <= 1e15f; }

}  // namespace pfx

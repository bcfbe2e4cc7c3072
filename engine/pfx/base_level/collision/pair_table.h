// Narrow phase of one pair of convex shapes: the table of pair functions, and what a pair remembers between
// frames.
//
// A large mesh is not convex; its pairs are handled by the mesh functions, and collideShapes() reports no
// contact for them.
#pragma once

#include "pfx/base_level/collision/contact_manifold.h"
#include "pfx/base_level/collision/local_manifold.h"
#include "pfx/base_level/shape/shape.h"

namespace pfx {

// What one pair of shapes remembers. Start with a default one and pass the same one in every frame. It never
// changes which contacts are right: it lets a pair that provably cannot touch skip its test, and keeps the
// choice of features steady while several are equally good.
struct PairCache {
  static constexpr float kUnknown = -1e30f;

  Transform b_in_a;             // pose of body B in the frame of body A when the axis was found
  Vec3 axis = Vec3::Zero();     // unit, from A to B, frame of body A; zero at first
  float separation = kUnknown;  // m, proven gap along the axis at that time
  float radius_b = 0.0f;        // m, of a ball around the origin of body B that holds shape B
  uint32_t hint = 0;            // features of the last manifold; zero: none
};

struct CollideInput {
  const Shape& shape_a;
  const Transform& body_a;  // body to world
  const Shape& shape_b;
  const Transform& body_b;
  float margin = 0.0f;         // m, >= 0; contacts are made for gaps up to this
  PairCache* cache = nullptr;  // optional
};

// Writes the manifold of one pair: the normal in world axes from A to B, up to four points with a distance of
// at most `margin`, each on the surfaces in the frames of the bodies. Impulses are zero. Returns the number
// of points; none for poses that are not finite and for missing meshes. Computed in the frame of A, so the distance from the world's origin does no harm beyond the
// rounding of the poses.
int collideShapes(const CollideInput& input, ContactManifold& manifold);

// True when `cache` proves that the shapes are still farther apart than `margin`. Rotation by an angle with
// chord c moves a point of B by at most c * radius_b.
bool provablyApart(const PairCache& cache, const Transform& body_b_in_a, float margin);

// The pair functions: what every entry of the table takes. In this record A is the first shape of the entry.
struct LocalPair {
  const Geometry& a;
  const Geometry& b;
  const RelativePose& b_in_a;  // shape frames
  float margin;
  uint32_t hint;  // in: features of the last manifold or zero; a pair function may ignore it
  Vec3 axis;      // in: a guess of the axis from A to B, frame of A, or zero
};

struct LocalResult {
  LocalManifold manifold;                  // frame of A
  float separation = PairCache::kUnknown;  // m, when there is no point: a proven gap along manifold.normal
  uint32_t hint = 0;
};

using PairFunction = void (*)(const LocalPair&, LocalResult&);

// The table: null where there is no function. Of the two orders of an unequal pair one has a function.
PairFunction pairFunction(ShapeType a, ShapeType b);

}  // namespace pfx

// Contact patches: the overlap of two supporting features, seen along the contact normal.
#pragma once

#include "pfx/base_level/collision/local_manifold.h"
#include "pfx/base_level/shape/polytope.h"

namespace pfx {

// A face in the frame of A; vertices counter-clockwise about `normal`.
struct ContactPolygon {
  Vec3 normal;      // unit, outwards
  uint32_t id = 0;  // of the face in its shape
  int count = 0;
  Vec3 vertices[kMaxFaceVertices];
};

// The face whose normal is closest to `direction` among those that have `vertex` as a corner: the face that a
// shape turns to its partner when that corner is the one that reaches farthest.
uint32_t supportingFaceAt(const Polytope& polytope, const Vec3& direction, uint32_t vertex);

void loadFace(const Polytope& polytope, uint32_t face, ContactPolygon& polygon);
void loadFace(const Polytope& polytope, uint32_t face, const RelativePose& pose, ContactPolygon& polygon);

// Clips the incident face by the side planes of the reference face, extruded along manifold.normal, and keeps
// the four best points that lie at most `margin` away along the normal. The normal points from A to B and
// must not be parallel to the reference face. Source: Sutherland and Hodgman, Reentrant polygon clipping,
// CACM 17(1), 1974.
struct ClipInput {
  const ContactPolygon& reference;
  const ContactPolygon& incident;
  bool reference_is_a;
  float margin;  // m
};
void clipFaces(const ClipInput& input, LocalManifold& manifold);

// Closest points of two segments (C. Ericson, Real-Time Collision Detection, 2005, section 5.1.9), as
// fractions of their lengths.
struct SegmentPair {
  float s = 0.0f, t = 0.0f;
};
SegmentPair closestOnSegments(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1);

}  // namespace pfx

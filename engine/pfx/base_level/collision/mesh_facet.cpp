// First the normal, then the points. See mesh_contact.h for the idea.
#include "pfx/base_level/collision/mesh_facet.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pfx/base_level/collision/contact_clipping.h"
#include "pfx/base_level/collision/gjk.h"
#include "pfx/base_level/collision/mesh_clusters.h"
#include "pfx/base_level/collision/mesh_normals.h"

namespace pfx {
namespace {

// Normals closer than this to the facet's own (0.5 degrees) are taken to be the facet's own.
constexpr float kSnap = 0.99996f;

enum class Source : uint8_t { Facet, BodyFace, EdgePair, Closest };

// A direction that parts facet and body, mesh to body, with the gap along it (m; negative: overlap).
struct Axis {
  float gap = -1e30f;
  Vec3 normal = Vec3::Zero();
  Source source = Source::Facet;
  uint32_t body_feature = 0;  // face or edge of a polytope
  int edge = 0;               // of the facet
};

// What is known of one facet while its contacts are found.
struct Facet {
  uint32_t index;
  MeshTriangle t;
  float highest(const Vec3& m) const {
    return std::max({m.dot(t.vertex[0]), m.dot(t.vertex[1]), m.dot(t.vertex[2])});
  }
  uint32_t feature(uint32_t local) const { return (index * 16 + local) & 0x7fffffffu; }
};

// The best axis that the surface has, and the best of all.
struct Search {
  Axis own, allowed, any;
  bool apart = false;  // some axis proves a gap above the margin
};

void offer(const FacetContext& c, const Facet& f, const Axis& axis, bool known_allowed, Search& s) {
  if (axis.gap > c.margin) s.apart = true;
  if (axis.normal.dot(f.t.normal) < -kLeanTolerance) return;  // towards the back: no way out
  if (axis.gap > s.any.gap) s.any = axis;
  if (axis.gap <= s.allowed.gap) return;
  if (known_allowed || (offersNormals(f.t) && hasNormal(c.mesh, f.index, f.t, axis.normal))) s.allowed = axis;
}

void offerBodyFaces(const FacetContext& c, const Facet& f, Search& s) {
  const auto& planes = c.body.polytope.planes;
  for (uint32_t i = 0; i < planes.size() && !s.apart; ++i) {
    const Vec3 m = -planes[i].normal;
    offer(c, f, {-planes[i].offset - f.highest(m), m, Source::BodyFace, i}, false, s);
  }
}

// Edges that cross on the surface of the Minkowski difference: their arcs of normals cross on the Gauss map.
// Source: D. Gregorius, The Separating Axis Test between Convex Polyhedra, GDC 2013.
void offerEdgePairs(const FacetContext& c, const Facet& f, Search& s) {
  const Polytope& p = c.body.polytope;
  for (int k = 0; k < 3; ++k) {
    if (!offersNormals(f.t.kind[k])) continue;
    const Vec3 a = f.t.normal, b = edgeFarNormal(f.t, k), b_x_a = b.cross(a);
    const Vec3 edge = f.t.vertex[(k + 1) % 3] - f.t.vertex[k];
    for (uint32_t i = 0; i < p.edges.size() && !s.apart; ++i) {
      const PolytopeEdge& e = p.edges[i];
      const Vec3 l = -p.planes[e.left].normal, r = -p.planes[e.right].normal, r_x_l = r.cross(l);
      const float lba = l.dot(b_x_a), rba = r.dot(b_x_a), arl = a.dot(r_x_l), brl = b.dot(r_x_l);
      if (!(lba * rba < 0.0f && arl * brl < 0.0f && lba * brl > 0.0f)) continue;
      const Vec3 other = p.vertices[e.v1] - p.vertices[e.v0];
      Vec3 m = edge.cross(other);
      const float length = m.norm();
      if (length < 1e-3f * edge.norm() * other.norm()) continue;
      m *= (m.dot(a + b) < 0.0f ? -1.0f : 1.0f) / length;
      offer(c, f, {m.dot(p.vertices[e.v0] - f.t.vertex[k]), m, Source::EdgePair, i, k}, true, s);
    }
  }
}

struct ClosestPoints {
  Vec3 on_facet, on_core;
};

Vec3 closestOnFacet(const std::array<Vec3, 3>& v, const Vec3& normal, const Vec3& p) {
  bool inside = true;
  Vec3 best = v[0];
  float least = 1e30f;
  for (int k = 0; k < 3; ++k) {
    const Vec3 e = v[(k + 1) % 3] - v[k];
    if (e.cross(normal).dot(p - v[k]) <= 0.0f) continue;
    inside = false;
    const Vec3 q = v[k] + std::clamp((p - v[k]).dot(e) / e.squaredNorm(), 0.0f, 1.0f) * e;
    const float d = (p - q).squaredNorm();
    if (d < least) least = d, best = q;
  }
  return inside ? Vec3(p - normal.dot(p - v[0]) * normal) : best;
}

ClosestPoints closestToSegment(const Facet& f, const Vec3& p0, const Vec3& p1) {
  ClosestPoints best{closestOnFacet(f.t.vertex, f.t.normal, p0), p0};
  float least = (p0 - best.on_facet).squaredNorm();
  const auto consider = [&](const Vec3& on_facet, const Vec3& on_core) {
    const float d = (on_core - on_facet).squaredNorm();
    if (d < least) least = d, best = {on_facet, on_core};
  };
  consider(closestOnFacet(f.t.vertex, f.t.normal, p1), p1);
  for (int k = 0; k < 3; ++k) {
    const Vec3 &a = f.t.vertex[k], &b = f.t.vertex[(k + 1) % 3];
    const SegmentPair sp = closestOnSegments(a, b, p0, p1);
    consider(a + sp.s * (b - a), p0 + sp.t * (p1 - p0));
  }
  return best;
}

void offerClosest(const FacetContext& c, const Facet& f, const Vec3& from, const Vec3& to, Search& s) {
  const Vec3 d = to - from;
  const float distance = d.norm();
  if (distance < 1e-5f * c.body.size || !(distance > 0.0f)) return;
  const Vec3 m = d / distance;
  offer(c, f, {c.body.lowest(m) - f.highest(m), m, Source::Closest}, false, s);
}

// A cylinder that overlaps a little is tried again slightly smaller: side and caps keep their normals.
void offerCylinder(const FacetContext& c, const Facet& f, Search& s) {
  const MeshBody& b = c.body;
  for (const float sign : {-1.0f, 1.0f}) {
    const Vec3 m = sign * b.axis;
    offer(c, f, {b.lowest(m) - f.highest(m), m, Source::Closest}, false, s);
  }
  if (s.apart || !offersNormals(f.t)) return;
  Polytope triangle;
  triangle.vertices = f.t.vertex;
  triangle.center = (f.t.vertex[0] + f.t.vertex[1] + f.t.vertex[2]) / 3.0f;
  const ConvexCore facet_core = polytopeCore(triangle);
  ConvexCore core = b.core;
  for (const float shrink : {0.0f, 0.05f}) {
    const float d = shrink * std::min(b.half_length, b.cylinder_radius);
    core.size.x() = b.half_length - d;
    core.size.y() = b.cylinder_radius - d;
    const GjkResult r = gjkDistance({facet_core, core, b.pose, Vec3::Zero(), c.margin + d});
    if (r.state == GjkResult::State::Touching) continue;
    if (r.distance < 1e-5f * b.size) continue;
    offer(c, f, {b.lowest(r.normal) - f.highest(r.normal), r.normal, Source::Closest}, false, s);
    return;
  }
}

Search findAxes(const FacetContext& c, const Facet& f) {
  const MeshBody& b = c.body;
  Search s;
  s.own = {b.lowest(f.t.normal) - f.t.normal.dot(f.t.vertex[0]), f.t.normal, Source::Facet};
  offer(c, f, s.own, true, s);
  if (s.apart) return s;
  switch (b.kind) {
    case MeshBody::Kind::Point: offerClosest(c, f, closestOnFacet(f.t.vertex, f.t.normal, b.center), b.center, s); break;
    case MeshBody::Kind::Segment: {
      const ClosestPoints p = closestToSegment(f, b.end(0), b.end(1));
      offerClosest(c, f, p.on_facet, p.on_core, s);
      break;
    }
    case MeshBody::Kind::Cylinder: offerCylinder(c, f, s); break;
    case MeshBody::Kind::Polytope:
      offerBodyFaces(c, f, s);
      offerEdgePairs(c, f, s);
      break;
  }
  return s;
}

struct SidePlane {
  Plane plane;
  uint32_t feature;  // names what is cut there; the next number is taken too
};

// Keeps the part of a polygon, segment or point on the inner side. Source: I. Sutherland, G. Hodgman, Reentrant polygon
// clipping, CACM 17(1), 1974.
void clipPolygon(FeaturePolygon& polygon, const SidePlane& side, float tolerance) {
  FeaturePolygon& p = polygon;
  FeaturePolygon out;
  const auto gap = [&](int i) { return side.plane.normal.dot(p.vertices[i].p) - side.plane.offset; };
  // A segment is walked once, not there and back.
  const int steps = p.count == 2 ? 1 : p.count;
  if (p.count == 1) {
    if (gap(0) > tolerance) p.count = 0;
    return;
  }
  for (int i = 0; i < steps; ++i) {
    const int next = (i + 1) % p.count;
    const float g0 = gap(i), g1 = gap(next);
    const bool in0 = g0 <= tolerance, in1 = g1 <= tolerance;
    if (in0) out.add(p.vertices[i].p, p.vertices[i].feature);
    if (in0 != in1) {
      const float u = std::clamp(g0 / (g0 - g1), 0.0f, 1.0f);
      out.add(p.vertices[i].p + u * (p.vertices[next].p - p.vertices[i].p), side.feature + (in1 ? 1 : 0));
    }
    if (steps == 1 && in1) out.add(p.vertices[next].p, p.vertices[next].feature);
  }
  p.count = out.count;
  std::copy_n(out.vertices, out.count, p.vertices);
}

struct Patch {
  Vec3 normal;
  bool primary;
};

// The body's feature over the facet, as seen along the facet's normal. False when it lies beside the facet.
bool addFacetPatch(const FacetContext& c, const Facet& f, const Patch& patch) {
  const Vec3& n = f.t.normal;
  const float offset = n.dot(f.t.vertex[0]);
  FeaturePolygon polygon;
  c.body.supportingFeature(-n, polygon);
  // Behind the front the sides of a facet lean, see edgeBisector().
  const bool behind = polygon.count == 1 && n.dot(polygon.vertices[0].p) < offset;
  for (int k = 0; k < 3 && polygon.count > 0; ++k) {
    const Vec3 side = behind ? edgeBisector(f.t, k) : edgeOutward(f.t, k);
    clipPolygon(polygon, {{side, side.dot(f.t.vertex[k])}, f.feature(2 * uint32_t(k))}, 1e-5f * c.body.size);
  }
  for (int i = 0; i < polygon.count; ++i) {
    const auto& v = polygon.vertices[i];
    const float height = n.dot(v.p) - offset;
    addContact(c, patch.normal, patch.primary,
               {v.p - height * n, v.p - c.body.radius * n, height - c.body.radius, f.index, v.feature});
  }
  return polygon.count > 0;
}

// The facet over one face of the body, as seen along that face's normal.
void addBodyFacePatch(const FacetContext& c, const Facet& f, const Axis& axis) {
  const Polytope& p = c.body.polytope;
  const Plane& face = p.planes[axis.body_feature];
  FeaturePolygon polygon;
  for (uint32_t k = 0; k < 3; ++k) polygon.add(f.t.vertex[k], f.feature(8 + k));
  const auto corners = p.face(axis.body_feature);
  for (uint32_t i = 0; i < corners.size() && polygon.count > 0; ++i) {
    const Vec3 &a = p.vertices[corners[i]], &b = p.vertices[corners[(i + 1) % corners.size()]];
    const Vec3 side = (b - a).cross(face.normal).normalized();
    clipPolygon(polygon, {{side, side.dot(a)}, f.feature(11) ^ (i + 1) << 22}, 1e-5f * c.body.size);
  }
  for (int i = 0; i < polygon.count; ++i) {
    const auto& v = polygon.vertices[i];
    const float distance = face.normal.dot(v.p) - face.offset;
    addContact(c, axis.normal, true, {v.p, v.p - distance * face.normal, distance, f.index, v.feature});
  }
}

void addEdgePair(const FacetContext& c, const Facet& f, const Axis& axis) {
  const Polytope& p = c.body.polytope;
  const PolytopeEdge& e = p.edges[axis.body_feature];
  const Vec3 &a0 = f.t.vertex[axis.edge], &a1 = f.t.vertex[(axis.edge + 1) % 3];
  const Vec3 &b0 = p.vertices[e.v0], &b1 = p.vertices[e.v1];
  const SegmentPair sp = closestOnSegments(a0, a1, b0, b1);
  const Vec3 on_mesh = a0 + sp.s * (a1 - a0);
  addContact(c, axis.normal, true,
             {on_mesh, on_mesh + axis.gap * axis.normal, axis.gap, f.index,
              f.feature(12 + uint32_t(axis.edge)) ^ (axis.body_feature + 1) << 22});
}

// A round body on an edge or a vertex of the facet: one point, or the two ends of a line of contact.
void addRoundContact(const FacetContext& c, const Facet& f, const Axis& axis) {
  const Vec3& m = axis.normal;
  const float top = f.highest(m), level = top - 1e-3f * c.body.size;
  FeaturePolygon mesh_feature, body_feature;
  for (uint32_t k = 0; k < 3; ++k) {
    if (m.dot(f.t.vertex[k]) >= level) mesh_feature.add(f.t.vertex[k], f.feature(8 + k));
  }
  c.body.supportingFeature(-m, body_feature);
  const auto add = [&](const Vec3& p, float distance, uint32_t feature) {
    addContact(c, m, true, {p, p + distance * m, distance, f.index, feature});
  };
  if (mesh_feature.count == 2 && body_feature.count == 2) {
    const Vec3 &a0 = mesh_feature.vertices[0].p, &a1 = mesh_feature.vertices[1].p;
    const Vec3 &b0 = body_feature.vertices[0].p, &b1 = body_feature.vertices[1].p;
    const Vec3 u = a1 - a0, w = b1 - b0;
    if (u.cross(w).norm() < 0.05f * u.norm() * w.norm()) {
      // Nearly parallel: where they run side by side.
      for (int i = 0; i < 2; ++i) {
        const float t = std::clamp((body_feature.vertices[i].p - a0).dot(u) / u.squaredNorm(), 0.0f, 1.0f);
        const Vec3 on_mesh = a0 + t * u;
        const float q = std::clamp((on_mesh - b0).dot(w) / w.squaredNorm(), 0.0f, 1.0f);
        add(on_mesh, m.dot(b0 + q * w - on_mesh) - c.body.radius, f.feature(13 + uint32_t(i)));
      }
      return;
    }
    const SegmentPair sp = closestOnSegments(a0, a1, b0, b1);
    add(a0 + sp.s * u, axis.gap, f.feature(15));
    return;
  }
  if (mesh_feature.count == 2 && body_feature.count > 2) {
    // An edge across the flat end of a cylinder.
    for (int i = 0; i < body_feature.count; ++i) {
      const Vec3 &a = body_feature.vertices[i].p, &b = body_feature.vertices[(i + 1) % body_feature.count].p;
      const Vec3 side = (b - a).cross(m).normalized() * -1.0f;
      clipPolygon(mesh_feature, {{side, side.dot(a)}, f.feature(11) ^ (uint32_t(i) + 1) << 22}, 1e-5f * c.body.size);
    }
  }
  if (mesh_feature.count == 2 && body_feature.count == 1) {
    const Vec3 u = mesh_feature.vertices[1].p - mesh_feature.vertices[0].p;
    const float t = std::clamp((c.body.center - mesh_feature.vertices[0].p).dot(u) / u.squaredNorm(), 0.0f, 1.0f);
    add(mesh_feature.vertices[0].p + t * u, axis.gap, f.feature(15));
    return;
  }
  for (int i = 0; i < mesh_feature.count; ++i) {
    const auto& v = mesh_feature.vertices[i];
    add(v.p, axis.gap + top - m.dot(v.p), v.feature);
  }
}

// Whether body and facet share a point. Round bodies know it from their closest points.
bool meets(const FacetContext& c, const Facet& f) {
  const MeshBody& b = c.body;
  if (b.kind != MeshBody::Kind::Cylinder && b.kind != MeshBody::Kind::Polytope) return true;
  Polytope triangle;
  triangle.vertices = f.t.vertex;
  triangle.center = (f.t.vertex[0] + f.t.vertex[1] + f.t.vertex[2]) / 3.0f;
  const ConvexCore facet_core = polytopeCore(triangle);
  const bool is_cylinder = b.kind == MeshBody::Kind::Cylinder;
  const ConvexCore core = is_cylinder ? b.core : polytopeCore(b.polytope);
  return gjkDistance({facet_core, core, is_cylinder ? b.pose : RelativePose()}).state == GjkResult::State::Touching;
}

// What the facet contributes along the best normal of the surface that is not its own.
void addLeaningContact(const FacetContext& c, const Facet& f, const Axis& axis) {
  switch (axis.source) {
    case Source::BodyFace: return addBodyFacePatch(c, f, axis);
    case Source::EdgePair: return addEdgePair(c, f, axis);
    case Source::Closest: return addRoundContact(c, f, axis);
    case Source::Facet: return;
  }
}

}  // namespace

void collideFacet(const FacetContext& c, uint32_t index) {
  const Facet f{index, meshTriangle(c.mesh, index)};
  Aabb box;
  for (const Vec3& v : f.t.vertex) box.extend(v);
  if (!box.grown(c.margin + f.t.thickness).overlaps(c.body.bounds)) return;
  if (f.t.normal.dot(c.body.center - f.t.vertex[0]) < -f.t.thickness) return;

  const Search s = findAxes(c, f);
  if (s.apart) return;
  // Deeper than the facet is thick along every normal that was looked at - or on the far side of a ridge.
  if (std::max(s.own.gap, s.allowed.gap) < -f.t.thickness && !meets(c, f)) return;
  // Near ties go to the facet, so that a resting body does not waver between two normals.
  const float slop = 1e-3f * c.body.size;
  const bool snaps = s.allowed.normal.dot(f.t.normal) > kSnap;
  if (!snaps && s.allowed.gap > s.own.gap + slop) return addLeaningContact(c, f, s.allowed);
  // Where another direction would be better but is not one of the surface's, a neighbour has the contact, and the facet
  // only helps while the body is hardly below it.
  const bool primary = s.own.gap >= s.any.gap - slop;
  if (!primary && s.own.gap < -f.t.thickness) return;
  // Right above an edge that hardly bends, the body is beside both facets, and only the edge is left. What an open edge
  // offers is left out: the surface may go on in another mesh.
  const bool is_beside = !addFacetPatch(c, f, {f.t.normal, primary});
  if (is_beside && std::ranges::count(f.t.kind, EdgeKind::Open) == 0) addLeaningContact(c, f, s.allowed);
}

}  // namespace pfx

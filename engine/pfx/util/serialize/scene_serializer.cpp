#include "pfx/util/serialize/scene_serializer.h"

#include <array>
#include <cmath>

#include "pfx/util/serialize/records.h"
#include "pfx/util/serialize/shape_records.h"

namespace pfx {
namespace {

using namespace serial;

constexpr DocumentFormat kFormat{"pfx-scene", 1};

// In the order of SceneCounts. Records come after those that they point at.
enum Part {
  kConvex,
  kLarge,
  kShapes,
  kStates,
  kBodies,
  kCollidables,
  kJoints,
  kJointPairs,
  kContactPairs,
  kManifolds,
  kParts
};

// The meshes of the document. While it is only checked they have a number and no place.
struct Meshes {
  RecordArray::Arrays all;

  uint32_t numberOf(const ConvexMesh* mesh) const { return numberIn(all[kConvex], mesh); }
  uint32_t numberOf(const LargeMesh* mesh) const { return numberIn(all[kLarge], mesh); }
  bool find(uint32_t number, const ConvexMesh*& mesh) const { return findIn(all[kConvex], number, mesh); }
  bool find(uint32_t number, const LargeMesh*& mesh) const { return findIn(all[kLarge], number, mesh); }

 private:
  template <class Mesh>
  static uint32_t numberIn(const RecordArray& meshes, const Mesh* mesh) {
    const auto* first = static_cast<const Mesh*>(meshes.data);
    for (uint32_t i = 0; i < meshes.count; ++i)
      if (first + i == mesh) return i;
    return kNoMesh;
  }
  template <class Mesh>
  static bool findIn(const RecordArray& meshes, uint32_t number, const Mesh*& mesh) {
    if (number >= meshes.count) return false;
    if (meshes.data != nullptr) mesh = static_cast<const Mesh*>(meshes.data) + number;
    return true;
  }
};

bool isSize(float x) { return x >= 0.0f && std::isfinite(x); }
bool isUnit(const Quat& q) { return std::abs(q.norm() - 1.0f) < 1e-3f; }

template <class A>
struct GeometryCheck {
  A& a;
  void operator()(const Sphere& s) const { a.require(isSize(s.radius), "a size is negative or not finite"); }
  void operator()(const Box& b) const {
    a.require((b.half_extent.array() >= 0.0f).all() && b.half_extent.allFinite(),
              "a size is negative or not finite");
  }
  void operator()(const Capsule& c) const {
    a.require(isSize(c.half_length) && isSize(c.radius), "a size is negative or not finite");
  }
  void operator()(const Cylinder& c) const {
    a.require(isSize(c.half_length) && isSize(c.radius), "a size is negative or not finite");
  }
  void operator()(const void*) const {}
};

template <class A>
void checkedShape(A& a, Shape& s, Meshes& meshes) {
  ioShape(a, s, meshes);
  std::visit(GeometryCheck<A>{a}, s.geometry);
  a.require(s.offset.position.allFinite() && isUnit(s.offset.orientation),
            "an offset is not finite or not a rotation");
}

// Each record: its fields, and what makes it sound. Joined to both archives below.
struct ConvexRecord {
  template <class A>
  static void run(A& a, RecordArray::Arrays, ConvexMesh& m) {
    io(a, m);
  }
};
struct LargeRecord {
  template <class A>
  static void run(A& a, RecordArray::Arrays, LargeMesh& m) {
    io(a, m);
  }
};
struct ShapeRecord {
  template <class A>
  static void run(A& a, RecordArray::Arrays all, Shape& s) {
    Meshes meshes{all};
    checkedShape(a, s, meshes);
  }
};
struct StateRecord {
  template <class A>
  static void run(A& a, RecordArray::Arrays, RigidState& s) {
    io(a, s);
    a.require(s.position.allFinite() && s.linear_velocity.allFinite() && s.angular_velocity.allFinite(),
              "a state is not finite");
    a.require(isUnit(s.orientation), "an orientation is not of length 1");
  }
};
struct BodyRecord {
  template <class A>
  static void run(A& a, RecordArray::Arrays, RigidBody& b) {
    io(a, b);
    a.require(isSize(b.mass), "a mass is negative or not finite");
    a.require(b.inertia.allFinite() && isSize(b.friction) && isSize(b.restitution),
              "a property is not finite");
  }
};
struct CollidableRecord {
  template <class A>
  static void run(A& a, RecordArray::Arrays all, Collidable& c) {
    Meshes meshes{all};
    auto* shapes = static_cast<Shape*>(all[kShapes].data);
    const uint32_t num_shapes = all[kShapes].count;
    uint32_t first = 0, count = 0;
    if constexpr (!A::kReads) {
      count = static_cast<uint32_t>(c.external.size());
      while (count > 0 && first < num_shapes && shapes + first != c.external.data()) ++first;
    }
    field(a, "first-shape", first);
    field(a, "shapes", count);
    const bool there = uint64_t(first) + count <= num_shapes;
    a.require(there, "a collidable has shapes that are not there");
    if (count == 0) {
      a.open("shape");
      checkedShape(a, c.inline_shape, meshes);
      a.close();
    } else if (A::kReads && there && shapes != nullptr) {
      c.external = {shapes + first, count};
    }
    field(a, "center", c.center);
    field(a, "half-extent", c.half_extent);
    a.require(c.center.allFinite() && c.half_extent.allFinite(), "bounds are not finite");
  }
};
struct JointRecord {
  template <class A>
  static void run(A& a, RecordArray::Arrays, Joint& j) {
    io(a, j);
    a.require(j.anchor_a.allFinite() && j.anchor_b.allFinite() && isUnit(j.frame_a) && isUnit(j.frame_b),
              "a frame of a joint is not finite or not a rotation");
  }
};
template <Part kOwners>
struct PairRecord {
  template <class A>
  static void run(A& a, RecordArray::Arrays all, Pair& p) {
    field(a, "body-a", p.body_a), field(a, "body-b", p.body_b);
    field(a, kOwners == kJoints ? "joint" : "manifold", p.contact_id);
    field(a, "flags", p.flags);
    a.require(std::max(p.body_a, p.body_b) < all[kStates].count, "a pair names a body that is not there");
    const bool none = kOwners == kManifolds && p.contact_id == kNoContact;
    a.require(none || p.contact_id < all[kOwners].count,
              "a pair names a joint or a manifold that is not there");
  }
};
struct ManifoldRecord {
  template <class A>
  static void run(A& a, RecordArray::Arrays, ContactManifold& m) {
    io(a, m);
  }
};

template <class T, class Record>
RecordArray arrayOf(const char* tag, const char* record_tag) {
  return recordArray<T, Record::template run<TextWriter>, Record::template run<TextReader>>(tag, record_tag);
}

std::array<RecordArray, kParts> allParts() {
  return {arrayOf<ConvexMesh, ConvexRecord>("convex-meshes", "convex-mesh"),
          arrayOf<LargeMesh, LargeRecord>("large-meshes", "large-mesh"),
          arrayOf<Shape, ShapeRecord>("shapes", "shape"),
          arrayOf<RigidState, StateRecord>("states", "state"),
          arrayOf<RigidBody, BodyRecord>("bodies", "body"),
          arrayOf<Collidable, CollidableRecord>("collidables", "collidable"),
          arrayOf<Joint, JointRecord>("joints", "joint"),
          arrayOf<Pair, PairRecord<kJoints>>("joint-pairs", "joint-pair"),
          arrayOf<Pair, PairRecord<kManifolds>>("contact-pairs", "contact-pair"),
          arrayOf<ContactManifold, ManifoldRecord>("manifolds", "manifold")};
}

SceneCounts countsOf(std::span<const RecordArray> parts) {
  return {parts[kConvex].count,   parts[kLarge].count,      parts[kShapes].count,
          parts[kStates].count,   parts[kBodies].count,     parts[kCollidables].count,
          parts[kJoints].count,   parts[kJointPairs].count, parts[kContactPairs].count,
          parts[kManifolds].count};
}

void place(const SceneArrays& arrays, std::span<RecordArray> parts, uint32_t RecordArray::*size) {
  const auto put = [&](Part part, auto span) {
    parts[part].data = span.data();
    parts[part].*size = static_cast<uint32_t>(span.size());
  };
  put(kConvex, arrays.convex_meshes), put(kLarge, arrays.large_meshes), put(kShapes, arrays.shapes);
  put(kStates, arrays.states), put(kBodies, arrays.bodies), put(kCollidables, arrays.collidables);
  put(kJoints, arrays.joints), put(kJointPairs, arrays.joint_pairs);
  put(kContactPairs, arrays.contact_pairs), put(kManifolds, arrays.manifolds);
}

// Callbacks of the document that go through to those of the scene.
DocumentCallbacks bridge(const SerializeCallbacks& calls, SceneArrays& arrays, uint32_t RecordArray::*size) {
  DocumentCallbacks out{.init = {}, .term = {}, .resize = {}, .update = calls.update, .error = calls.error};
  if (calls.init) {
    out.init = [&calls, &arrays, size](std::span<RecordArray> parts) {
      calls.init(arrays);
      place(arrays, parts, size);
    };
  }
  if (calls.resize) {
    out.resize = [&calls, &arrays, size](std::span<RecordArray> parts) {
      if (!calls.resize(countsOf(parts), arrays)) return false;
      place(arrays, parts, size);
      return true;
    };
  }
  if (calls.term) out.term = [&calls](std::span<const RecordArray> parts) { calls.term(countsOf(parts)); };
  return out;
}

}  // namespace

SerializeError serializeWrite(std::FILE* file, const SerializeCallbacks& callbacks) {
  SceneArrays arrays;
  auto parts = allParts();
  return writeDocument(file, kFormat, parts, bridge(callbacks, arrays, &RecordArray::count));
}

SerializeError serializeRead(std::FILE* file, const SerializeCallbacks& callbacks) {
  SceneArrays arrays;
  auto parts = allParts();
  return readDocument(file, kFormat, parts, bridge(callbacks, arrays, &RecordArray::capacity));
}

}  // namespace pfx

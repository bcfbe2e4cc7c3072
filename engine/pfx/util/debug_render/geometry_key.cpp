// Keys of geometries.
#include "pfx/util/debug_render/geometry_key.h"

#include <initializer_list>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace pfx {

namespace {

// Sizes in a fixed order, with the type of shape as seed.
uint64_t hashSizes(ShapeType type, std::initializer_list<float> sizes) {
  return XXH3_64bits_withSeed(sizes.begin(), sizes.size() * sizeof(float), static_cast<uint64_t>(type) + 1);
}

uint64_t hashAddress(ShapeType type, const void* address) {
  return XXH3_64bits_withSeed(&address, sizeof address, static_cast<uint64_t>(type) + 1);
}

struct Key {
  uint64_t operator()(const Sphere& s) const { return hashSizes(ShapeType::Sphere, {s.radius}); }
  uint64_t operator()(const Box& b) const {
    return hashSizes(ShapeType::Box, {b.half_extent.x(), b.half_extent.y(), b.half_extent.z()});
  }
  uint64_t operator()(const Capsule& c) const {
    return hashSizes(ShapeType::Capsule, {c.half_length, c.radius});
  }
  uint64_t operator()(const Cylinder& c) const {
    return hashSizes(ShapeType::Cylinder, {c.half_length, c.radius});
  }
  uint64_t operator()(const ConvexMesh*) const { return 0; }
  uint64_t operator()(const LargeMesh*) const { return 0; }
};

struct Identity : Key {
  using Key::operator();
  uint64_t operator()(const ConvexMesh* mesh) const { return hashAddress(ShapeType::ConvexMesh, mesh); }
  uint64_t operator()(const LargeMesh* mesh) const { return hashAddress(ShapeType::LargeMesh, mesh); }
};

struct Same {
  bool operator()(const Sphere& a, const Sphere& b) const { return a.radius == b.radius; }
  bool operator()(const Box& a, const Box& b) const { return a.half_extent == b.half_extent; }
  bool operator()(const Capsule& a, const Capsule& b) const {
    return a.half_length == b.half_length && a.radius == b.radius;
  }
  bool operator()(const Cylinder& a, const Cylinder& b) const {
    return a.half_length == b.half_length && a.radius == b.radius;
  }
  template <class Mesh>
  bool operator()(const Mesh* a, const Mesh* b) const {
    return a == b;
  }
  template <class A, class B>
  bool operator()(const A&, const B&) const {
    return false;
  }
};

}  // namespace

uint64_t geometryKey(const Geometry& geometry) { return std::visit(Key(), geometry); }

uint64_t geometryIdentity(const Geometry& geometry) { return std::visit(Identity(), geometry); }

bool sameGeometry(const Geometry& a, const Geometry& b) { return std::visit(Same(), a, b); }

}  // namespace pfx

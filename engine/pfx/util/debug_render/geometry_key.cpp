// Keys of geometries.
#include "pfx/util/debug_render/geometry_key.h"

#include <array>
#include <initializer_list>

#include "pfx/base_level/shape/convex_mesh.h"
#include "pfx/base_level/shape/large_mesh.h"

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

// Hash of arrays one after the other, each with its length.
class ContentHash {
 public:
  explicit ContentHash(ShapeType type) : value_(static_cast<uint64_t>(type) + 1) {}

  template <class Array>
  ContentHash& add(const Array& array) {
    value_ = XXH3_64bits_withSeed(array.data(), array.size() * sizeof(array[0]), value_ + array.size());
    return *this;
  }
  uint64_t value() const { return value_; }

 private:
  uint64_t value_;
};

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
  uint64_t operator()(const ConvexMesh* mesh) const {
    ContentHash hash(ShapeType::ConvexMesh);
    if (mesh == nullptr) return hash.value();
    return hash.add(mesh->vertices).add(mesh->faces).add(mesh->face_vertices).value();
  }
  // Where the vertices are and how they are joined. A quantized mesh differs from the expanded one by its
  // rounding.
  uint64_t operator()(const LargeMesh* mesh) const {
    ContentHash hash(ShapeType::LargeMesh);
    if (mesh == nullptr) return hash.value();
    hash.add(mesh->vertices).add(mesh->triangles);
    hash.add(std::array{mesh->surface_bounds.min, mesh->grid_scale}).add(mesh->vertex_blocks);
    return hash.add(mesh->quantized_vertices).add(mesh->quantized_facets).value();
  }
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

// Everything that is in a picture, without GL: solids as instances of meshes, lines, arrows, points, labels,
// camera, sun.
//
// A list is recorded again for every frame between begin() and end(). Content that did not change is
// recognised while it is recorded and keeps its revision, so that a renderer uploads only what is new. Lists
// can be compared and hashed, which is how the drawing is tested without a graphics library.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "pfx/util/debug_render/debug_render.h"
#include "viewer/draw_list/camera.h"
#include "viewer/draw_list/mesh_data.h"

namespace viewer {

using pfx::Color;  // 0xAARRGGBB, sRGB

// What a pixel shows: kind in the high 4 bits, index in the low 28. Zero: nothing that can be picked.
enum class PickKind : uint32_t { Nothing, Body, Contact, Joint, Triangle, Island, Item };
constexpr uint32_t pickId(PickKind kind, uint32_t index) {
  return uint32_t(kind) << 28 | (index & 0x0fffffffu);
}
constexpr PickKind pickKind(uint32_t id) { return PickKind(id >> 28); }
constexpr uint32_t pickIndex(uint32_t id) { return id & 0x0fffffffu; }

// The meshes that every list knows. Others have the content hash of their geometry as key.
inline constexpr uint64_t kUnitBox = 1;       // scale: half extents
inline constexpr uint64_t kUnitCylinder = 2;  // scale: half length, radius, radius
inline constexpr uint64_t kRound =
    3;  // sphere or capsule along X; scale: half length of the core, radius, radius

// One solid. Its layout is that of the vertex buffer.
struct Instance {
  pfx::Vec3 position = pfx::Vec3::Zero();         // m
  pfx::Quat orientation = pfx::Quat::Identity();  // unit
  pfx::Vec3 scale = pfx::Vec3::Ones();            // m for the unit meshes, a factor for others
  Color color = 0xffffffffu;
  uint32_t finish = 0;  // pfx::Finish
  uint32_t pick = 0;
};
static_assert(sizeof(Instance) == 52);

// How an instance is drawn. Shiny ones mirror the sky. Floors are large fixed slabs: they get a metre grid,
// fade away in the distance and throw no shadow, which would make the shadow map too coarse for everything on
// them.
enum class Layer : uint32_t { Plain = 1, Shiny = 2, Floor = 4, Translucent = 8 };
inline constexpr float kFloorHalfExtent = 8.0f;  // m, the smaller horizontal one

inline Layer layerOf(const Instance& i) {
  const auto finish = pfx::Finish(i.finish);
  if (finish == pfx::Finish::Translucent || i.color >> 24 != 255) return Layer::Translucent;
  if (finish == pfx::Finish::Glossy || finish == pfx::Finish::Metallic) return Layer::Shiny;
  const bool large = i.scale.x() >= kFloorHalfExtent && i.scale.z() >= kFloorHalfExtent;
  return finish == pfx::Finish::Matte && large ? Layer::Floor : Layer::Plain;
}

constexpr bool throwsShadow(Layer layer) { return layer == Layer::Plain || layer == Layer::Shiny; }

struct Line {
  pfx::Vec3 from, to;  // m
  Color color;
  float width = 1.5f;  // px
  uint32_t pick = 0;
};

struct Arrow {
  pfx::Vec3 from, to;  // m, the tip is at `to`
  Color color;
  float width = 2.0f;  // px, of the shaft
  uint32_t pick = 0;
};

struct Point {
  pfx::Vec3 position;  // m
  Color color;
  float size = 6.0f;  // px, diameter
  uint32_t pick = 0;
};

// Text at a place in the world (dimmed where that place is hidden), or on the screen: then `position` is (x,
// y, 0) in pixels from the top left corner, or from the right or bottom edge when negative.
struct Label {
  pfx::Vec3 position;
  std::string text;
  Color color = 0xff20242bu;
  bool on_screen = false;
  uint32_t pick = 0;

  bool operator==(const Label&) const = default;
};

struct Sun {
  pfx::Vec3 direction = pfx::Vec3(0.52f, -0.74f, -0.36f);  // of the light, need not be unit
  bool shadows = true;
  bool operator==(const Sun&) const = default;
};

// A line of the legend: a swatch and what it means.
struct LegendEntry {
  Color color;
  std::string text;
  bool operator==(const LegendEntry&) const = default;
};

// What is drawn together: instances of one mesh in one layer.
struct BatchKey {
  uint64_t mesh;
  Layer layer;
  auto operator<=>(const BatchKey&) const = default;
};

// The instances of a key. Blocks of kBlock instances remember when they changed.
struct Batch {
  static constexpr size_t kBlock = 64;
  std::vector<Instance> instances;
  // (ceil(instances / kBlock)) revision of the list at the last change. Revisions are unique in the process:
  // a block of this key with the same revision has the same content, in whichever list.
  std::vector<uint64_t> block_revisions;
  std::vector<pfx::Aabb> block_bounds;  // m, of the blocks' instances, when the frame has ended
  size_t recorded = 0;                  // instances of the frame that is being recorded

  std::span<const Instance> block(size_t b) const {
    return std::span(instances).subspan(b * kBlock, std::min(kBlock, instances.size() - b * kBlock));
  }
};

class DrawList {
 public:
  // Starts a frame: forgets lines, labels and the like; instances stay for comparison and meshes for good.
  void begin();
  // Ends it: drops instances that were not recorded again.
  void end();

  bool hasMesh(uint64_t key) const { return meshes_.contains(key); }
  // Makes a mesh known under a key of its content. Known keys are left as they are.
  void defineMesh(uint64_t key, MeshData mesh);
  // Makes a mesh known, with the triangles that make() returns, until a frame ends in which it has no instance.
  template <class Make>
  void defineTransientMesh(uint64_t key, const Make& make) {
    if (meshes_.contains(key)) return;
    meshes_.emplace(key, make());
    transient_.push_back(key);
  }

  void add(uint64_t mesh, const Instance& instance) {
    append(mesh, 1, [&](size_t) { return instance; });
  }
  // Adds `count` instances, make(i) each. Those that equal the ones of the last frame, in the same order,
  // cost a comparison.
  template <class Make>
  void append(uint64_t mesh, size_t count, const Make& make);

  void add(const Line& line) { lines_.push_back(line); }
  void add(const Arrow& arrow) { arrows_.push_back(arrow); }
  void add(const Point& point) { points_.push_back(point); }
  void add(Label label) { labels_.push_back(std::move(label)); }
  void add(LegendEntry entry) { legend_.push_back(std::move(entry)); }

  // Bits of two lists with equal content are equal, whatever they showed before.
  bool operator==(const DrawList& other) const;
  uint64_t hash() const;

  const std::map<uint64_t, MeshData>& meshes() const { return meshes_; }
  const std::map<BatchKey, Batch>& batches() const { return batches_; }
  std::span<const Line> lines() const { return lines_; }
  std::span<const Arrow> arrows() const { return arrows_; }
  std::span<const Point> points() const { return points_; }
  std::span<const Label> labels() const { return labels_; }
  std::span<const LegendEntry> legend() const { return legend_; }
  size_t numInstances() const;
  // m, of an instance in the world.
  pfx::Aabb boundsOf(uint64_t mesh, const Instance& instance) const;

  Camera camera;
  Sun sun;
  bool scale_bar = false;  // a length in the lower left corner that is true at the camera's target

 private:
  std::map<uint64_t, MeshData>
      meshes_;  // of keys above kRound; ordered, so that pictures do not depend on history
  std::vector<uint64_t> transient_;  // keys of the meshes that do not stay
  std::map<BatchKey, Batch> batches_;
  std::vector<Line> lines_;
  std::vector<Arrow> arrows_;
  std::vector<Point> points_;
  std::vector<Label> labels_;
  std::vector<LegendEntry> legend_;
  uint64_t revision_ = nextRevision();
  static uint64_t nextRevision();
  void put(Batch& batch, const Instance& next);
  void dropUnrecorded(Batch& batch) const;
  void measureBlocks(uint64_t mesh, Batch& batch) const;
};

inline void DrawList::put(Batch& batch, const Instance& next) {
  const size_t i = batch.recorded++;
  if (i == batch.instances.size()) {
    batch.instances.emplace_back();
    batch.block_revisions.resize(i / Batch::kBlock + 1, 0);
  } else if (std::memcmp(static_cast<const void*>(&batch.instances[i]), &next, sizeof next) == 0) {
    return;
  }
  batch.instances[i] = next;
  batch.block_revisions[i / Batch::kBlock] = revision_;
}

template <class Make>
void DrawList::append(uint64_t mesh, size_t count, const Make& make) {
  Batch* batch = nullptr;
  Layer of_batch = Layer::Plain;
  for (size_t i = 0; i < count; ++i) {
    const Instance next = make(i);
    const Layer layer = layerOf(next);
    if (!batch || layer != of_batch) batch = &batches_[{mesh, layer}], of_batch = layer;
    put(*batch, next);
  }
}

}  // namespace viewer

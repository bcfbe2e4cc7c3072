#include "viewer/draw_list/draw_list.h"

#include <algorithm>
#include <array>
#include <atomic>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace viewer {

namespace {

// Feeds the hash with records that have no padding.
class Hasher {
 public:
  template <class T>
  void add(std::span<const T> items) {
    add(uint64_t(items.size()));
    bytes(items.data(), items.size_bytes());
  }
  void add(uint64_t value) { bytes(&value, sizeof value); }
  void add(const std::string& text) { add(std::span<const char>(text)); }
  uint64_t value() const { return value_; }

 private:
  void bytes(const void* data, size_t size) { value_ = XXH3_64bits_withSeed(data, size, value_); }
  uint64_t value_ = 0;
};

template <class T>
bool sameBits(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(static_cast<const void*>(a.data()), b.data(), a.size_bytes()) == 0);
}

}  // namespace

uint64_t DrawList::nextRevision() {
  static std::atomic<uint64_t> last = 0;
  return ++last;
}

void DrawList::begin() {
  revision_ = nextRevision();
  for (auto& [key, batch] : batches_) batch.recorded = 0;
  lines_.clear();
  arrows_.clear();
  points_.clear();
  labels_.clear();
  legend_.clear();
}

void DrawList::end() {
  std::erase_if(transient_, [&](uint64_t mesh) {
    const auto isShown = [&](const auto& entry) { return entry.first.mesh == mesh && entry.second.recorded > 0; };
    if (std::any_of(batches_.begin(), batches_.end(), isShown)) return false;
    std::erase_if(batches_, [&](const auto& entry) { return entry.first.mesh == mesh; });
    meshes_.erase(mesh);
    return true;
  });
  for (auto& [key, batch] : batches_) {
    dropUnrecorded(batch);
    measureBlocks(key.mesh, batch);
  }
}

void DrawList::dropUnrecorded(Batch& batch) const {
  if (batch.recorded == batch.instances.size()) return;
  batch.instances.resize(batch.recorded);
  batch.block_revisions.resize((batch.recorded + Batch::kBlock - 1) / Batch::kBlock);
  if (!batch.block_revisions.empty()) batch.block_revisions.back() = revision_;
}

void DrawList::measureBlocks(uint64_t mesh, Batch& batch) const {
  batch.block_bounds.resize(batch.block_revisions.size());
  for (size_t b = 0; b < batch.block_bounds.size(); ++b) {
    if (batch.block_revisions[b] != revision_) continue;
    batch.block_bounds[b] = {};
    for (const Instance& i : batch.block(b)) batch.block_bounds[b].extend(boundsOf(mesh, i));
  }
}

pfx::Aabb DrawList::boundsOf(uint64_t mesh, const Instance& i) const {
  const auto box = [&](const pfx::Vec3& center, const pfx::Vec3& half_extent) {
    return pfx::transformedAabb({i.position, i.orientation}, center, half_extent);
  };
  if (mesh == kRound) return box(pfx::Vec3::Zero(), {i.scale.x() + i.scale.y(), i.scale.y(), i.scale.y()});
  const auto found = meshes_.find(mesh);
  if (found == meshes_.end()) return box(pfx::Vec3::Zero(), i.scale);
  const pfx::Aabb& own = found->second.bounds;
  return box(own.center().cwiseProduct(i.scale), own.halfExtent().cwiseProduct(i.scale));
}

void DrawList::defineMesh(uint64_t key, MeshData mesh) { meshes_.try_emplace(key, std::move(mesh)); }

bool DrawList::operator==(const DrawList& other) const {
  // Batches that became empty do not count: they only remember that something was there.
  const auto instances = [](const DrawList& list) {
    std::vector<std::pair<BatchKey, std::span<const Instance>>> all;
    for (const auto& [key, batch] : list.batches_)
      if (!batch.instances.empty()) all.push_back({key, batch.instances});
    return all;
  };
  const auto a = instances(*this), b = instances(other);
  if (a.size() != b.size()) return false;
  for (size_t i = 0; i < a.size(); ++i)
    if (a[i].first != b[i].first || !sameBits(a[i].second, b[i].second)) return false;
  return sameBits(lines(), other.lines()) && sameBits(arrows(), other.arrows()) &&
         sameBits(points(), other.points()) && labels_ == other.labels_ && legend_ == other.legend_ &&
         camera == other.camera && sun == other.sun && scale_bar == other.scale_bar;
}

uint64_t DrawList::hash() const {
  Hasher h;
  for (const auto& [key, batch] : batches_) {
    if (batch.instances.empty()) continue;
    h.add(key.mesh);
    h.add(uint64_t(key.layer));
    h.add(std::span<const Instance>(batch.instances));
  }
  h.add(lines());
  h.add(arrows());
  h.add(points());
  for (const Label& l : labels_) {
    const std::array<float, 3> p = {l.position.x(), l.position.y(), l.position.z()};
    h.add(std::span<const float>(p));
    h.add(l.text);
    h.add(uint64_t(l.color) << 32 | uint64_t(l.on_screen));
    h.add(uint64_t(l.pick));
  }
  for (const LegendEntry& l : legend_) {
    h.add(l.text);
    h.add(uint64_t(l.color));
  }
  const Camera& c = camera;
  const std::array<float, 18> view = {c.eye.x(),         c.eye.y(),
                                      c.eye.z(),         c.target.x(),
                                      c.target.y(),      c.target.z(),
                                      c.up.x(),          c.up.y(),
                                      c.up.z(),          c.fov_y_deg,
                                      c.near_m,          c.far_m,
                                      c.ortho_height_m,  float(c.orthographic),
                                      sun.direction.x(), sun.direction.y(),
                                      sun.direction.z(), float(sun.shadows)};
  h.add(std::span<const float>(view));
  h.add(uint64_t(scale_bar));
  return h.value();
}

size_t DrawList::numInstances() const {
  size_t n = 0;
  for (const auto& [key, batch] : batches_) n += batch.instances.size();
  return n;
}

}  // namespace viewer

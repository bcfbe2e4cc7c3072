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
  std::erase_if(transient_, [&](uint64_t key) {
    const auto batch = batches_.find(key);
    if (batch != batches_.end() && batch->second.recorded > 0) return false;
    if (batch != batches_.end()) batches_.erase(batch);
    meshes_.erase(key);
    return true;
  });
  for (auto& [key, batch] : batches_) {
    if (batch.recorded < batch.instances.size()) {
      batch.instances.resize(batch.recorded);
      batch.block_revisions.resize((batch.recorded + Batch::kBlock - 1) / Batch::kBlock);
      batch.revision = revision_;
    }
    if (batch.revision == revision_) {
      batch.layers = 0;
      for (const Instance& i : batch.instances) batch.layers |= uint32_t(layerOf(i));
    }
  }
}

void DrawList::defineMesh(uint64_t key, MeshData mesh) { meshes_.try_emplace(key, std::move(mesh)); }

bool DrawList::operator==(const DrawList& other) const {
  // Batches that became empty do not count: they only remember that something was there.
  const auto instances = [](const DrawList& list) {
    std::vector<std::pair<uint64_t, std::span<const Instance>>> all;
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
    h.add(key);
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

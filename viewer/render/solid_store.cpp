#include "viewer/render/solid_store.h"

#include <algorithm>

namespace viewer {

namespace {

struct Attribute {
  GLint size;
  GLenum type;
  size_t offset;
};

void bindFloats(const Gl& gl, GLuint index, const Attribute& a, GLsizei stride, GLuint divisor) {
  gl.EnableVertexAttribArray(index);
  gl.VertexAttribPointer(index, a.size, a.type, a.type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE, stride,
                         reinterpret_cast<const void*>(a.offset));
  gl.VertexAttribDivisor(index, divisor);
}

void bindInteger(const Gl& gl, GLuint index, size_t offset, GLsizei stride) {
  gl.EnableVertexAttribArray(index);
  gl.VertexAttribIPointer(index, 1, GL_UNSIGNED_INT, stride, reinterpret_cast<const void*>(offset));
  gl.VertexAttribDivisor(index, 1);
}

MeshData dataOf(uint64_t key, const DrawList& list) {
  if (key == kUnitBox || key == kRound) return makeUnitBox();
  if (key == kUnitCylinder) return makeUnitCylinder();
  const auto found = list.meshes().find(key);
  return found == list.meshes().end() ? MeshData{} : found->second;
}

}  // namespace

void pointToInstances(const Gl& gl, GLuint buffer, size_t first) {
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
  constexpr GLsizei kInstance = sizeof(Instance);
  const size_t base = first * sizeof(Instance);
  bindFloats(gl, 3, {3, GL_FLOAT, base + offsetof(Instance, position)}, kInstance, 1);
  bindFloats(gl, 4, {4, GL_FLOAT, base + offsetof(Instance, orientation)}, kInstance, 1);
  bindFloats(gl, 5, {3, GL_FLOAT, base + offsetof(Instance, scale)}, kInstance, 1);
  bindFloats(gl, 6, {4, GL_UNSIGNED_BYTE, base + offsetof(Instance, color)}, kInstance, 1);
  bindInteger(gl, 7, base + offsetof(Instance, finish), kInstance);
  bindInteger(gl, 8, base + offsetof(Instance, pick), kInstance);
}

template <class T>
void SolidStore::fill(const GlBuffer& buffer, GLenum target, const std::vector<T>& data) {
  gl_->BindBuffer(target, buffer.id());
  gl_->BufferData(target, GLsizeiptr(data.size() * sizeof(T)), data.data(), GL_STATIC_DRAW);
  sent_ += data.size() * sizeof(T);
}

const SolidStore::Mesh& SolidStore::mesh(uint64_t key, const DrawList& list) {
  const auto found = meshes_.find(key);
  if (found != meshes_.end()) return found->second;
  const MeshData data = dataOf(key, list);
  Mesh made{GlBuffer(*gl_), GlBuffer(*gl_), GlBuffer(*gl_), GLsizei(data.vertices.size())};
  gl_->BindVertexArray(0);
  fill(made.vertices, GL_ARRAY_BUFFER, data.vertices);
  fill(made.positions, GL_ARRAY_BUFFER, data.positions);
  fill(made.indices, GL_ARRAY_BUFFER, data.indices);
  return meshes_.emplace(key, std::move(made)).first->second;
}

void SolidStore::describe(const Arrays& arrays, const Mesh& mesh, GLuint instances, size_t first) {
  gl_->BindVertexArray(arrays.shaded.id());
  gl_->BindBuffer(GL_ARRAY_BUFFER, mesh.vertices.id());
  for (GLuint i = 0; i < 3; ++i) bindFloats(*gl_, i, {3, GL_FLOAT, 12 * size_t(i)}, sizeof(MeshVertex), 0);
  pointToInstances(*gl_, instances, first);
  gl_->BindVertexArray(arrays.bare.id());
  gl_->BindBuffer(GL_ARRAY_BUFFER, mesh.positions.id());
  bindFloats(*gl_, 0, {3, GL_FLOAT, 0}, sizeof(pfx::Vec3), 0);
  gl_->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh.indices.id());
  pointToInstances(*gl_, instances, first);
}

SolidStore::Instances& SolidStore::instances(const BatchKey& key, const Mesh& mesh) {
  auto found = instances_.find(key);
  if (found == instances_.end()) {
    found = instances_.emplace(key, Instances{Arrays(*gl_), GlBuffer(*gl_), 0, {}}).first;
    describe(found->second.arrays, mesh, found->second.buffer.id(), 0);
  }
  return found->second;
}

void SolidStore::send(Instances& to, const Batch& batch) {
  gl_->BindBuffer(GL_ARRAY_BUFFER, to.buffer.id());
  const size_t count = batch.instances.size();
  if (count > to.capacity) {
    to.capacity = std::max(count, to.capacity + to.capacity / 2);
    gl_->BufferData(GL_ARRAY_BUFFER, GLsizeiptr(to.capacity * sizeof(Instance)), nullptr, GL_DYNAMIC_DRAW);
    to.block_revisions.clear();
  }
  to.block_revisions.resize(batch.block_revisions.size(), 0);
  const size_t blocks = batch.block_revisions.size();
  for (size_t b = 0; b < blocks;) {
    if (to.block_revisions[b] == batch.block_revisions[b]) {
      ++b;
      continue;
    }
    // Neighbouring changes go in one piece.
    const size_t first = b;
    for (; b < blocks && to.block_revisions[b] != batch.block_revisions[b]; ++b)
      to.block_revisions[b] = batch.block_revisions[b];
    const size_t begin = first * Batch::kBlock, end = std::min(b * Batch::kBlock, count);
    const size_t bytes = (end - begin) * sizeof(Instance);
    gl_->BufferSubData(GL_ARRAY_BUFFER, GLintptr(begin * sizeof(Instance)), GLsizeiptr(bytes),
                       &batch.instances[begin]);
    sent_ += bytes;
  }
}

// Meshes that changed from frame to frame would fill the memory of the GPU.
void SolidStore::forgetGone(const DrawList& list) {
  const auto isGone = [&](uint64_t key) { return key > kRound && !list.hasMesh(key); };
  std::erase_if(meshes_, [&](const auto& entry) { return isGone(entry.first); });
  std::erase_if(instances_, [&](const auto& entry) { return isGone(entry.first.mesh); });
}

size_t SolidStore::update(const DrawList& list) {
  sent_ = 0;
  draws_.clear();
  forgetGone(list);
  for (const auto& [key, batch] : list.batches()) {
    if (batch.instances.empty()) continue;
    const Mesh& shape = mesh(key.mesh, list);
    Instances& of_key = instances(key, shape);
    send(of_key, batch);
    draws_.push_back({.shaded = of_key.arrays.shaded.id(),
                      .bare = of_key.arrays.bare.id(),
                      .vertices = shape.count,
                      .instance_buffer = of_key.buffer.id(),
                      .instances = GLsizei(batch.instances.size()),
                      .layer = key.layer,
                      .round = key.mesh == kRound,
                      .block_bounds = batch.block_bounds});
  }
  sortTranslucent(list);
  gl_->BindVertexArray(0);
  return sent_;
}

void SolidStore::sortTranslucent(const DrawList& list) {
  struct Item {
    float distance;
    uint64_t mesh;
    const Instance* instance;
  };
  std::vector<Item> items;
  const CameraAxes view = axes(list.camera);
  for (const auto& [key, batch] : list.batches())
    if (key.layer == Layer::Translucent)
      for (const Instance& i : batch.instances)
        items.push_back({(i.position - list.camera.eye).dot(view.forward), key.mesh, &i});
  translucent_.clear();
  if (items.empty()) return;
  std::stable_sort(items.begin(), items.end(),
                   [](const Item& a, const Item& b) { return a.distance > b.distance; });

  std::vector<Instance> sorted;
  for (const Item& item : items) sorted.push_back(*item.instance);
  if (!sorted_) sorted_ = GlBuffer(*gl_);
  gl_->BindBuffer(GL_ARRAY_BUFFER, sorted_.id());
  gl_->BufferData(GL_ARRAY_BUFFER, GLsizeiptr(sorted.size() * sizeof(Instance)), sorted.data(),
                  GL_STREAM_DRAW);
  sent_ += sorted.size() * sizeof(Instance);
  for (size_t first = 0; first < items.size();) {
    size_t end = first;
    while (end < items.size() && items[end].mesh == items[first].mesh) ++end;
    if (sorted_arrays_.size() == translucent_.size()) sorted_arrays_.emplace_back(*gl_);
    const Arrays& arrays = sorted_arrays_[translucent_.size()];
    const Mesh& shape = mesh(items[first].mesh, list);
    describe(arrays, shape, sorted_.id(), first);
    translucent_.push_back({.shaded = arrays.shaded.id(),
                            .bare = arrays.bare.id(),
                            .vertices = shape.count,
                            .instance_buffer = sorted_.id(),
                            .instances = GLsizei(end - first),
                            .layer = Layer::Translucent,
                            .round = items[first].mesh == kRound,
                            .block_bounds = {}});
    first = end;
  }
}

}  // namespace viewer

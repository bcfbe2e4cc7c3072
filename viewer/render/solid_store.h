// Meshes and instances on the GPU. Only blocks that changed since the last frame are sent.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "viewer/draw_list/draw_list.h"
#include "viewer/render/gl_objects.h"

namespace viewer {

// What the draw calls of one batch need. Between draws both vertex arrays point to the first instance.
struct SolidDraw {
  GLuint shaded;     // vertex array with all attributes, `vertices` in a row
  GLuint bare;       // vertex array with positions alone, `vertices` indices: the same triangles
  GLsizei vertices;  // three a triangle
  GLuint instance_buffer;
  GLsizei instances;
  Layer layer;
  bool round;                               // drawn as a ray-cast capsule
  std::span<const pfx::Aabb> block_bounds;  // m, of each Batch::kBlock instances; empty: not known
};

// Makes the bound vertex array read its instances from this one of the buffer on.
void pointToInstances(const Gl& gl, GLuint buffer, size_t first);

class SolidStore {
 public:
  explicit SolidStore(const Gl& gl) : gl_(&gl) {}

  // Sends what is new in `list`, which must stay as it is while the draws are used; returns the bytes sent.
  size_t update(const DrawList& list);

  // All instances, one draw a batch, in the order of keys.
  const std::vector<SolidDraw>& draws() const { return draws_; }
  // The translucent ones from back to front, runs of one mesh as one draw.
  const std::vector<SolidDraw>& translucentDraws() const { return translucent_; }

 private:
  struct Mesh {
    GlBuffer vertices, positions, indices;
    GLsizei count = 0;  // of vertices, and of indices
  };
  struct Arrays {
    explicit Arrays(const Gl& gl) : shaded(gl), bare(gl) {}
    GlVertexArray shaded, bare;
  };
  struct Instances {
    Arrays arrays;
    GlBuffer buffer;
    size_t capacity = 0;
    std::vector<uint64_t> block_revisions;
  };
  const Mesh& mesh(uint64_t key, const DrawList& list);
  void forgetGone(const DrawList& list);
  Instances& instances(const BatchKey& key, const Mesh& mesh);
  void send(Instances& to, const Batch& batch);
  void sortTranslucent(const DrawList& list);
  void describe(const Arrays& arrays, const Mesh& mesh, GLuint instances, size_t first);
  template <class T>
  void fill(const GlBuffer& buffer, GLenum target, const std::vector<T>& data);

  const Gl* gl_;
  std::map<uint64_t, Mesh> meshes_;
  std::map<BatchKey, Instances> instances_;
  std::vector<SolidDraw> draws_, translucent_;
  GlBuffer sorted_;
  std::vector<Arrays> sorted_arrays_;
  size_t sent_ = 0;
};

}  // namespace viewer

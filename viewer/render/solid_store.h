// Meshes and instances on the GPU. Only blocks that changed since the last frame are sent.
#pragma once

#include <map>
#include <vector>

#include "viewer/draw_list/draw_list.h"
#include "viewer/render/gl_objects.h"

namespace viewer {

// What one draw call needs.
struct SolidDraw {
  GLuint vertex_array;
  GLsizei vertices, instances;
  bool round;       // drawn as a ray-cast capsule
  uint32_t layers;  // bits of the layers of its instances
};

class SolidStore {
 public:
  explicit SolidStore(const Gl& gl) : gl_(&gl) {}

  // Sends what is new in `list`; returns the bytes sent.
  size_t update(const DrawList& list);

  // All instances, one draw a mesh, in the order of keys.
  const std::vector<SolidDraw>& draws() const { return draws_; }
  // The translucent ones from back to front, runs of one mesh as one draw.
  const std::vector<SolidDraw>& translucentDraws() const { return translucent_; }

 private:
  struct Mesh {
    GlBuffer vertices;
    GLsizei count = 0;
  };
  struct Instances {
    GlVertexArray array;
    GlBuffer buffer;
    size_t capacity = 0;
    std::vector<uint64_t> block_revisions;
  };
  const Mesh& mesh(uint64_t key, const DrawList& list);
  void forgetGone(const DrawList& list);
  void send(Instances& to, const Batch& batch);
  void sortTranslucent(const DrawList& list);
  SolidDraw describe(GLuint array, const Mesh& mesh, GLuint instances, size_t first);

  const Gl* gl_;
  std::map<uint64_t, Mesh> meshes_;
  std::map<uint64_t, Instances> instances_;
  std::vector<SolidDraw> draws_, translucent_;
  GlBuffer sorted_;
  std::vector<GlVertexArray> sorted_arrays_;
  size_t sent_ = 0;
};

}  // namespace viewer

// The arrays of a scene in vectors, and the callbacks that write them and load into them.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "pfx/util/serialize/scene_serializer.h"

namespace files {

struct SceneVectors {
  std::vector<pfx::ConvexMesh> convex_meshes;
  std::vector<pfx::LargeMesh> large_meshes;
  std::vector<pfx::Shape> shapes;
  std::vector<pfx::RigidState> states;
  std::vector<pfx::RigidBody> bodies;
  std::vector<pfx::Collidable> collidables;
  std::vector<pfx::Joint> joints;
  std::vector<pfx::Pair> joint_pairs, contact_pairs;
  std::vector<pfx::ContactManifold> manifolds;

  pfx::SceneArrays arrays() {
    return {convex_meshes, large_meshes, shapes,      states,        bodies,
            collidables,   joints,       joint_pairs, contact_pairs, manifolds};
  }
  void resize(const pfx::SceneCounts& n) {
    convex_meshes.resize(n.convex_meshes), large_meshes.resize(n.large_meshes), shapes.resize(n.shapes);
    states.resize(n.states), bodies.resize(n.bodies), collidables.resize(n.collidables);
    joints.resize(n.joints), joint_pairs.resize(n.joint_pairs), contact_pairs.resize(n.contact_pairs);
    manifolds.resize(n.manifolds);
  }
};

inline pfx::SerializeCallbacks writeCalls(SceneVectors& scene) {
  return {.init = [&](pfx::SceneArrays& a) { a = scene.arrays(); },
          .term = {},
          .resize = {},
          .update = {},
          .error = {}};
}

// Loads into vectors that grow as needed.
inline pfx::SerializeCallbacks readCalls(SceneVectors& scene) {
  return {.init = [&](pfx::SceneArrays& a) { a = scene.arrays(); },
          .term = {},
          .resize =
              [&](const pfx::SceneCounts& n, pfx::SceneArrays& a) {
                scene.resize(n);
                a = scene.arrays();
                return true;
              },
          .update = {},
          .error = {}};
}

// A file in memory, or on its way there.
class TextFile {
 public:
  TextFile() : file_(std::tmpfile()) {}
  explicit TextFile(const std::string& text) : TextFile() {
    std::fwrite(text.data(), 1, text.size(), file_);
    std::rewind(file_);
  }
  ~TextFile() { std::fclose(file_); }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  std::FILE* get() const { return file_; }
  std::string text() const {
    std::rewind(file_);
    std::string out;
    for (int c = std::fgetc(file_); c != EOF; c = std::fgetc(file_)) out += static_cast<char>(c);
    return out;
  }

 private:
  std::FILE* file_;
};

inline std::string written(SceneVectors& scene) {
  const TextFile file;
  pfx::serializeWrite(file.get(), writeCalls(scene));
  return file.text();
}

}  // namespace files

// A scene with every kind of record, made without any arithmetic, so that each machine makes the same.
#pragma once

#include <limits>

#include "pfx/base_level/shape/convex_hull.h"
#include "pfx/util/mesh_builder/mesh_builder.h"
#include "tests/files/scene_vectors.h"

namespace files {

inline pfx::LargeMesh foreignMesh(pfx::LargeMeshType type) {
  const pfx::Vec3 corners[] = {
      {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 4.0f}, {4.0f, 0.0f, 4.0f}, {4.0f, 1.0f, 0.0f}};
  const uint32_t triangles[] = {0, 1, 2, 0, 2, 3}, user_data[] = {7, 0xfffffff9u};
  pfx::LargeMeshOptions options;
  options.type = type;
  options.user_data = user_data;
  return pfx::buildLargeMesh(corners, triangles, options).mesh;
}

inline SceneVectors foreignScene() {
  using namespace pfx;
  SceneVectors s;
  const Vec3 tetrahedron[] = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
  buildConvexMesh(tetrahedron, s.convex_meshes.emplace_back());
  s.large_meshes.push_back(foreignMesh(LargeMeshType::ExpandedBvh));
  s.large_meshes.push_back(foreignMesh(LargeMeshType::QuantizedBvh));
  s.shapes.push_back({Box{Vec3(0.5f, 0.25f, 1.5f)}, {}});
  s.shapes.push_back({&s.convex_meshes[0], {Vec3(1.0f, 2.0f, 3.0f), Quat::Identity()}});
  for (uint32_t i = 0; i < 3; ++i) {
    RigidState& state = s.states.emplace_back();
    state.body_id = i;
    state.position = Vec3(0.1f, -1e-40f, 16777217.0f);
    state.filter_self = 0x80000001u << i;
    s.bodies.emplace_back().mass = 0.3f;
    s.collidables.emplace_back();
  }
  s.collidables[0].inline_shape = {&s.large_meshes[0], {}};
  s.collidables[1].inline_shape = {&s.large_meshes[1], {}};
  s.collidables[2].external = s.shapes;
  s.joints.emplace_back().axis[1].spring_frequency = 2.2f;
  s.joint_pairs.push_back({0, 2, 0, 0});
  s.contact_pairs.push_back({1, 2, 0, 5});
  s.manifolds.emplace_back().num_points = 1;
  s.manifolds[0].points[0].feature = 0xdeadbeefu;
  return s;
}

}  // namespace files

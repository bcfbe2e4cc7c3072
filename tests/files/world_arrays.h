// The arrays of a world, for the serializer.
#pragma once

#include <algorithm>
#include <memory>

#include "pfx/high_level/world/world.h"
#include "tests/files/scene_vectors.h"

namespace files {

// What a world holds, in arrays of its own: meshes are copied and shapes led to the copies.
inline std::unique_ptr<SceneVectors> arraysOf(const pfx::World& world) {
  using namespace pfx;
  auto out = std::make_unique<SceneVectors>();
  std::vector<const ConvexMesh*> convex;
  std::vector<const LargeMesh*> large;
  size_t num_shapes = 0;
  const auto list = [](auto& all, const auto* mesh) {
    if (std::find(all.begin(), all.end(), mesh) == all.end()) all.push_back(mesh);
  };
  for (const Collidable& c : world.collidables()) {
    if (!c.external.empty()) num_shapes += c.external.size();
    for (const Shape& s : c.shapes()) {
      if (const auto* m = std::get_if<const ConvexMesh*>(&s.geometry)) list(convex, *m);
      if (const auto* m = std::get_if<const LargeMesh*>(&s.geometry)) list(large, *m);
    }
  }
  for (const ConvexMesh* m : convex) out->convex_meshes.push_back(*m);
  for (const LargeMesh* m : large) out->large_meshes.push_back(*m);
  const auto led = [&](Shape s) {
    if (auto* m = std::get_if<const ConvexMesh*>(&s.geometry))
      *m = &out->convex_meshes[static_cast<size_t>(std::find(convex.begin(), convex.end(), *m) -
                                                   convex.begin())];
    if (auto* m = std::get_if<const LargeMesh*>(&s.geometry))
      *m = &out->large_meshes[static_cast<size_t>(std::find(large.begin(), large.end(), *m) - large.begin())];
    return s;
  };
  out->states.assign(world.states().begin(), world.states().end());
  out->bodies.assign(world.bodies().begin(), world.bodies().end());
  out->shapes.reserve(num_shapes);
  for (const Collidable& c : world.collidables()) {
    Collidable& copy = out->collidables.emplace_back(c);
    copy.inline_shape = led(c.inline_shape);
    const size_t first = out->shapes.size();
    for (const Shape& s : c.external) out->shapes.push_back(led(s));
    copy.external = std::span(out->shapes).subspan(first);
  }
  out->joints.assign(world.joints().begin(), world.joints().end());
  for (uint32_t i = 0; i < world.jointLinks().size(); ++i)
    out->joint_pairs.push_back({world.jointLinks()[i].body_a, world.jointLinks()[i].body_b, i, 0});
  for (Pair p : world.contactPairs()) {
    const auto manifolds = world.manifolds(p);
    p.contact_id = manifolds.empty() ? kNoContact : static_cast<uint32_t>(out->manifolds.size());
    out->manifolds.insert(out->manifolds.end(), manifolds.begin(), manifolds.end());
    out->contact_pairs.push_back(p);
  }
  return out;
}

}  // namespace files

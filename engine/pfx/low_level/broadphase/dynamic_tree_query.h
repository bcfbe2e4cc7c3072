// Queries of the dynamic tree: the tests of four bounds at once and the two ways through the tree. Part of
// dynamic_tree.h.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "pfx/base_level/memory/containers.h"
#include "pfx/low_level/broadphase/dynamic_tree.h"

namespace pfx {

// A ray as the slab test wants it (A. Williams et al., An efficient and robust ray-box intersection
// algorithm, 2005).
struct DynamicTree::RayLanes {
  float origin[3], inverse[3], grow[3];

  explicit RayLanes(const TreeRay& ray) {
    for (int k = 0; k < 3; ++k) {
      origin[k] = ray.origin[k];
      grow[k] = ray.half_extent[k];
      // A component of zero becomes a tiny one: the slab is then entered before and left after all that
      // counts, or missed, without any 0 * infinity.
      const float d = std::abs(ray.motion[k]) < kTiny ? std::copysign(kTiny, ray.motion[k]) : ray.motion[k];
      inverse[k] = 1.0f / d;
    }
  }

 private:
  static constexpr float kTiny = 1e-30f;
};

// Rounding may move the distance of a slab by three parts in 2^24 on either side (T. Ize, Robust BVH ray
// traversal, JCGT 2(2), 2013); the far side is moved out by twice that.
inline constexpr float kSlabGrowth = 1.0f + 0x1p-21f;

#if defined(__SSE2__)

inline uint32_t DynamicTree::overlapMask(const Node& node, const Aabb& box) {
  __m128 hit = _mm_cmple_ps(_mm_load_ps(node.min[0]), _mm_set1_ps(box.max[0]));
  hit = _mm_and_ps(hit, _mm_cmple_ps(_mm_set1_ps(box.min[0]), _mm_load_ps(node.max[0])));
  for (int k = 1; k < 3; ++k) {
    hit = _mm_and_ps(hit, _mm_cmple_ps(_mm_load_ps(node.min[k]), _mm_set1_ps(box.max[k])));
    hit = _mm_and_ps(hit, _mm_cmple_ps(_mm_set1_ps(box.min[k]), _mm_load_ps(node.max[k])));
  }
  return static_cast<uint32_t>(_mm_movemask_ps(hit)) & ((1u << node.count) - 1);
}

inline uint32_t DynamicTree::rayMask(const Node& node, const RayLanes& ray, float max_fraction,
                                     float (&enter)[4]) {
  __m128 near = _mm_setzero_ps(), far = _mm_set1_ps(max_fraction);
  for (int k = 0; k < 3; ++k) {
    const __m128 origin = _mm_set1_ps(ray.origin[k]), inverse = _mm_set1_ps(ray.inverse[k]);
    const __m128 grow = _mm_set1_ps(ray.grow[k]);
    const __m128 a = _mm_mul_ps(_mm_sub_ps(_mm_sub_ps(_mm_load_ps(node.min[k]), grow), origin), inverse);
    const __m128 b = _mm_mul_ps(_mm_sub_ps(_mm_add_ps(_mm_load_ps(node.max[k]), grow), origin), inverse);
    near = _mm_max_ps(near, _mm_min_ps(a, b));
    far = _mm_min_ps(far, _mm_mul_ps(_mm_max_ps(a, b), _mm_set1_ps(kSlabGrowth)));
  }
  _mm_storeu_ps(enter, near);
  return static_cast<uint32_t>(_mm_movemask_ps(_mm_cmple_ps(near, far))) & ((1u << node.count) - 1);
}

#else

inline uint32_t DynamicTree::overlapMask(const Node& node, const Aabb& box) {
  uint32_t mask = 0;
  for (uint32_t i = 0; i < node.count; ++i) mask |= uint32_t{slotBounds(node, i).overlaps(box)} << i;
  return mask;
}

inline uint32_t DynamicTree::rayMask(const Node& node, const RayLanes& ray, float max_fraction,
                                     float (&enter)[4]) {
  uint32_t mask = 0;
  for (uint32_t i = 0; i < node.count; ++i) {
    float near = 0.0f, far = max_fraction;
    for (int k = 0; k < 3; ++k) {
      const float a = (node.min[k][i] - ray.grow[k] - ray.origin[k]) * ray.inverse[k];
      const float b = (node.max[k][i] + ray.grow[k] - ray.origin[k]) * ray.inverse[k];
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b) * kSlabGrowth);
    }
    enter[i] = near;
    mask |= uint32_t{near <= far} << i;
  }
  return mask;
}

#endif

// Each level leaves at most three siblings behind, and maxHeight of 2^32 leaves is 31.
inline constexpr std::size_t kTreeStack = 3 * 31 + 4;

template <class Fn>
void DynamicTree::visit(Fn&& fn) const {
  if (root_ == kNoNode) return;
  Vector<std::pair<uint32_t, uint32_t>> waiting = {{root_, 0}};  // nodes and their levels
  while (!waiting.empty()) {
    const auto [at, level] = waiting.back();
    const Node& node = nodes_[at];
    waiting.pop_back();
    for (uint32_t slot = 0; slot < node.count; ++slot) {
      const bool is_leaf = (node.child[slot] & kLeaf) != 0;
      fn(slotBounds(node, slot), level, is_leaf);
      if (!is_leaf) waiting.push_back({node.child[slot], level + 1});
    }
  }
}

template <class Fn>
void DynamicTree::overlap(const Aabb& box, Fn&& fn) const {
  if (root_ == kNoNode) return;
  std::array<uint32_t, kTreeStack> stack;
  std::size_t top = 0;
  stack[top++] = root_;
  while (top > 0) {
    const Node& node = nodes_[stack[--top]];
    for (uint32_t hits = overlapMask(node, box); hits != 0; hits &= hits - 1) {
      const Child child = node.child[std::countr_zero(hits)];
      if (child & kLeaf) {
        fn(child & ~kLeaf);
      } else {
        stack[top++] = child;
      }
    }
  }
}

template <class Fn>
void DynamicTree::castRay(const TreeRay& ray, Fn&& fn) const {
  if (root_ == kNoNode) return;
  struct Entry {
    Child child;
    float enter;
  };
  const RayLanes lanes(ray);
  float fraction = ray.max_fraction;
  std::array<Entry, kTreeStack> stack;
  std::size_t top = 0;
  stack[top++] = {root_, 0.0f};
  while (top > 0) {
    const Entry entry = stack[--top];
    if (entry.enter > fraction) continue;
    if (entry.child & kLeaf) {
      fraction = fn(entry.child & ~kLeaf, fraction);
      if (fraction <= 0.0f) return;
      continue;
    }
    const Node& node = nodes_[entry.child];
    float enter[4];
    const std::size_t first = top;
    for (uint32_t hits = rayMask(node, lanes, fraction, enter); hits != 0; hits &= hits - 1) {
      const int slot = std::countr_zero(hits);
      // Insertion keeps the farthest at the bottom.
      std::size_t at = top++;
      for (; at > first && stack[at - 1].enter < enter[slot]; --at) stack[at] = stack[at - 1];
      stack[at] = {node.child[slot], enter[slot]};
    }
  }
}

}  // namespace pfx

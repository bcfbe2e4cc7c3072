// The eight-wide tree of least expected cost for a ray, out of a given binary one.
//
// Source: H. Ylitie, T. Karras, S. Laine, Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs, HPG
// 2017, section 3.1: the cost of a subtree that becomes at most i children of a wide node follows from that of its two
// halves. A node and a leaf cost the same.
#include <algorithm>
#include <array>
#include <limits>

#include "pfx/util/mesh_builder/mesh_hierarchy.h"

namespace pfx {
namespace {

constexpr int kWidth = 8;

float halfArea(const Aabb& b) {
  const Vec3 d = b.max - b.min;
  return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
}

// Of a binary node: cost as at most i + 1 children, and how many of them the left half gets; 0: no more than with i.
// As eight children is as a wide node of its own.
struct Plan {
  float cost[kWidth];
  uint8_t left[kWidth];
};

// The best ways to hand i children out to two halves.
Plan distribute(const Plan& left, const Plan& right) {
  Plan plan{};
  for (int i = 2; i <= kWidth; ++i) {
    float best = std::numeric_limits<float>::max();
    for (int k = 1; k < i; ++k) {
      const float cost = left.cost[k - 1] + right.cost[i - k - 1];
      if (cost < best) best = cost, plan.left[i - 1] = static_cast<uint8_t>(k);
    }
    plan.cost[i - 1] = best;
  }
  return plan;
}

std::vector<Plan> makePlans(const std::vector<BinaryNode>& tree) {
  std::vector<Plan> plans(tree.size());
  for (size_t n = tree.size(); n-- > 0;) {  // halves come after what they are halves of
    Plan& plan = plans[n];
    const float area = halfArea(tree[n].bounds);
    if (tree[n].left == 0) {
      std::fill(plan.cost, plan.cost + kWidth, area);
      continue;
    }
    plan = distribute(plans[tree[n].left], plans[tree[n].left + 1]);
    plan.cost[0] = plan.cost[kWidth - 1] + area;
    for (int i = 1; i < kWidth - 1; ++i)
      if (plan.cost[i] >= plan.cost[i - 1]) plan.cost[i] = plan.cost[i - 1], plan.left[i] = 0;
  }
  return plans;
}

struct Children {
  std::array<uint32_t, kWidth> node;
  int count = 0;
};

// Appends the binary nodes that stand for `node` when it becomes at most `most` children.
void collect(const std::vector<BinaryNode>& tree, const std::vector<Plan>& plans, uint32_t node, int most,
             Children& out) {
  const Plan& plan = plans[node];
  while (most > 1 && plan.left[most - 1] == 0) --most;
  if (most == 1) {
    out.node[out.count++] = node;
    return;
  }
  const int left = plan.left[most - 1];
  collect(tree, plans, tree[node].left, left, out);
  collect(tree, plans, tree[node].left + 1, most - left, out);
}

}  // namespace

std::vector<std::array<MeshChild, 8>> collapse(const std::vector<BinaryNode>& tree) {
  const std::vector<Plan> plans = makePlans(tree);
  std::vector<std::array<MeshChild, 8>> nodes;
  struct Todo {
    uint32_t binary, parent, slot;
  };
  std::vector<Todo> stack{{0, 0, kWidth}};
  while (!stack.empty()) {
    const Todo todo = stack.back();
    stack.pop_back();
    const uint32_t index = static_cast<uint32_t>(nodes.size());
    if (todo.slot < kWidth) nodes[todo.parent][todo.slot] = index;
    nodes.emplace_back().fill(kNoChild);
    Children children;
    collect(tree, plans, todo.binary, kWidth, children);
    for (int i = children.count - 1; i >= 0; --i) {
      const BinaryNode& child = tree[children.node[i]];
      if (child.left == 0) {
        nodes[index][i] = leafChild(child.first, child.count);
      } else {
        stack.push_back({children.node[i], index, static_cast<uint32_t>(i)});
      }
    }
  }
  return nodes;
}

}  // namespace pfx

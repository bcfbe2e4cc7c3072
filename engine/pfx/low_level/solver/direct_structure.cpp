// Minimum degree on the explicit graph of joints, then the columns of the factor.
#include "pfx/low_level/solver/direct_structure.h"

#include <algorithm>
#include <utility>

namespace pfx {
namespace {

struct Side {
  uint32_t joint;
  uint8_t side;
};

Vector<Vector<Side>> sidesByBody(std::span<const JointEnds> joints, uint32_t num_bodies) {
  Vector<Vector<Side>> sides(num_bodies);
  for (uint32_t j = 0; j < joints.size(); ++j)
    for (uint8_t s = 0; s < 2; ++s)
      if (joints[j].moves[s]) sides[joints[j].body[s]].push_back({j, s});
  return sides;
}

using Neighbours = Vector<Set<uint32_t>>;

Neighbours graphOf(const Vector<Vector<Side>>& sides, size_t num_joints) {
  Neighbours n(num_joints);
  for (const auto& at_body : sides)
    for (const Side& x : at_body)
      for (const Side& y : at_body)
        if (x.joint != y.joint) n[x.joint].insert(y.joint);
  return n;
}

// Eliminates joint after joint; columns[p] are the joints that the joint at position p is coupled to at that
// moment. False when that becomes too much work.
bool eliminate(Neighbours& graph, uint64_t max_products, DirectStructure& out,
               Vector<Vector<uint32_t>>& columns) {
  Set<std::pair<size_t, uint32_t>> queue;
  for (uint32_t j = 0; j < graph.size(); ++j) queue.insert({graph[j].size(), j});
  uint64_t products = 0;
  while (!queue.empty()) {
    const uint32_t joint = queue.begin()->second;
    queue.erase(queue.begin());
    const Vector<uint32_t> others(graph[joint].begin(), graph[joint].end());
    products += others.size() * (others.size() + 1) / 2;
    if (products > max_products) return false;
    for (uint32_t o : others) {
      queue.erase({graph[o].size(), o});
      graph[o].erase(joint);
      for (uint32_t p : others)
        if (p != o) graph[o].insert(p);
      queue.insert({graph[o].size(), o});
    }
    out.order.push_back(joint);
    columns.push_back(others);
  }
  return true;
}

}  // namespace

uint32_t findBlock(const DirectStructure& s, uint32_t row, uint32_t column) {
  const auto begin = s.entries.begin() + s.column_begin[column],
             end = s.entries.begin() + s.column_begin[column + 1];
  const auto at = std::lower_bound(begin, end, row,
                                   [](const DirectStructure::Entry& e, uint32_t r) { return e.row < r; });
  return static_cast<uint32_t>(at - s.entries.begin());
}

void listUpdates(DirectStructure& s) {
  for (uint32_t p = 0; p + 1 < s.column_begin.size(); ++p)
    for (uint32_t i = s.column_begin[p]; i < s.column_begin[p + 1]; ++i)
      for (uint32_t k = s.column_begin[p]; k <= i; ++k)
        s.updates.push_back(k == i ? DirectStructure::kDiagonal
                                   : findBlock(s, s.entries[i].row, s.entries[k].row));
}

bool buildDirectStructure(std::span<const JointEnds> joints, uint32_t num_bodies, uint64_t max_products,
                          DirectStructure& out) {
  out = {};
  const auto sides = sidesByBody(joints, num_bodies);
  for (const auto& at_body : sides)
    if (at_body.size() * at_body.size() > 2 * max_products) return false;
  Neighbours graph = graphOf(sides, joints.size());
  Vector<Vector<uint32_t>> columns;
  if (!eliminate(graph, max_products, out, columns)) {
    out = {};
    return false;
  }
  Vector<uint32_t> position(joints.size());
  for (uint32_t p = 0; p < out.order.size(); ++p) position[out.order[p]] = p;
  out.column_begin.assign(1, 0);
  for (auto& column : columns) {
    for (uint32_t& joint : column) joint = position[joint];
    std::sort(column.begin(), column.end());
    for (uint32_t row : column) out.entries.push_back({row});
    out.column_begin.push_back(static_cast<uint32_t>(out.entries.size()));
  }
  listUpdates(out);
  for (const auto& at_body : sides)
    for (const Side& x : at_body)
      for (const Side& y : at_body)
        if (position[x.joint] > position[y.joint])
          out.couplings.push_back(
              {x.joint, y.joint, x.side, y.side, findBlock(out, position[x.joint], position[y.joint])});
  return true;
}

}  // namespace pfx

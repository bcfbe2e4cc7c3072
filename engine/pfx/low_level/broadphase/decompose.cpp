// Decomposition and composition of pair lists.
#include "pfx/low_level/broadphase/decompose.h"

#include <algorithm>

namespace pfx {

void decomposePairs(std::span<const Pair> prev, std::span<const Pair> cur, PairChanges& changes) {
  changes.added.clear();
  changes.kept.clear();
  changes.removed.clear();
  comparePairs(
      prev, cur, [&](const Pair& pair) { changes.added.push_back(pair); },
      [&](const Pair& pair, const Pair&) { changes.kept.push_back(pair); },
      [&](const Pair& pair) { changes.removed.push_back(pair); });
}

void composePairs(std::span<const Pair> a, std::span<const Pair> b, Vector<Pair>& out) {
  out.resize(a.size() + b.size());
  std::merge(a.begin(), a.end(), b.begin(), b.end(), out.begin(),
             [](const Pair& x, const Pair& y) { return x.key() < y.key(); });
}

}  // namespace pfx

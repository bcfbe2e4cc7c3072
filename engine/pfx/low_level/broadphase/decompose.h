// Set arithmetic on sorted lists of pairs: which pairs are new, which stay, which are gone.
#pragma once

#include <cstdint>
#include <span>

#include "pfx/base_level/collision/pair.h"
#include "pfx/base_level/memory/containers.h"

namespace pfx {

// Walks two lists of pairs, both sorted by key and without repetitions, and calls in the order of the keys
//   added(cur_pair)              for a pair only in `cur`,
//   kept(prev_pair, cur_pair)    for a pair in both,
//   removed(prev_pair)           for a pair only in `prev`.
template <class Added, class Kept, class Removed>
void comparePairs(std::span<const Pair> prev, std::span<const Pair> cur, Added&& added, Kept&& kept,
                  Removed&& removed) {
  std::size_t p = 0, c = 0;
  while (p < prev.size() && c < cur.size()) {
    const uint64_t prev_key = prev[p].key(), cur_key = cur[c].key();
    if (prev_key == cur_key) {
      kept(prev[p++], cur[c++]);
    } else if (prev_key < cur_key) {
      removed(prev[p++]);
    } else {
      added(cur[c++]);
    }
  }
  while (p < prev.size()) removed(prev[p++]);
  while (c < cur.size()) added(cur[c++]);
}

struct PairChanges {
  Vector<Pair> added;    // as in cur
  Vector<Pair> kept;     // as in prev, with its contact_id and flags
  Vector<Pair> removed;  // as in prev, so that the contact can be released
};

// Splits two lists of pairs, both sorted by key and without repetitions. The results are sorted by key.
// Allocates only to grow.
void decomposePairs(std::span<const Pair> prev, std::span<const Pair> cur, PairChanges& changes);

// Joins two sorted lists that share no key into one sorted list: kept and added pairs make the list of the
// next step.
void composePairs(std::span<const Pair> a, std::span<const Pair> b, Vector<Pair>& out);

}  // namespace pfx

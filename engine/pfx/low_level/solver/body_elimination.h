// Symbolic part of the island solver: in which order to eliminate bodies that contacts couple.
//
// Minimum degree on a matrix of bits, one row a body, so that a changed island costs microseconds and no
// memory. Ties go to the lower index. Source: T. Davis, Direct Methods for Sparse Linear Systems, 2006,
// chapter 7.
#pragma once

#include <span>

#include "pfx/base_level/memory/containers.h"
#include "pfx/low_level/island/link.h"
#include "pfx/low_level/solver/direct_structure.h"

namespace pfx {

class BodyElimination {
 public:
  // Makes the structure of num_bodies block rows that `links` (both ends < num_bodies, repeats allowed)
  // couple. Does nothing when that is what it was made for last. Returns whether it changed.
  bool update(std::span<const Link> links, uint32_t num_bodies);

  const DirectStructure& structure() const { return structure_; }
  uint32_t position(uint32_t body) const { return position_[body]; }  // in the order of elimination

 private:
  void connect();
  void eliminate();
  uint32_t leastCoupled() const;

  uint32_t num_bodies_ = 0, words_ = 0;
  Vector<Link> links_;
  Vector<uint64_t> bits_, column_;  // neighbours by body; those of the body at hand
  Vector<uint32_t> degree_;         // kEliminated afterwards
  Vector<uint32_t> position_;
  DirectStructure structure_;
};

}  // namespace pfx

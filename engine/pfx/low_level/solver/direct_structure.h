// Symbolic part of the direct joint solver: which blocks of the factor exist, and in which order to make
// them.
//
// The matrix has one block row a joint; two joints are coupled when they share a body that both can move.
// Joints are eliminated by minimum degree: for a tree that begins at the leaves and adds no block, loops add
// some. Computed once a topology. Source: T. Davis, Direct Methods for Sparse Linear Systems, 2006, chapters
// 4 and 7.
#pragma once

#include <cstdint>
#include <span>

#include "pfx/base_level/memory/containers.h"

namespace pfx {

// One side of a joint that the solver may move.
struct JointEnds {
  uint32_t body[2];  // local index of A and B
  bool moves[2];     // whether the joint may change A, B
};

struct DirectStructure {
  struct Entry {
    uint32_t row;  // position in the order, later than the column
  };
  struct Coupling {
    uint32_t joint_row, joint_column;  // local joint indices
    uint8_t side_row, side_column;     // 0: their A, 1: their B is the shared body
    uint32_t block;                    // index of the off-diagonal block
  };

  Vector<uint32_t> order;         // local joint index by position
  Vector<uint32_t> column_begin;  // (joints + 1), into entries; entry k owns off-diagonal block k
  Vector<Entry> entries;          // rows ascending in each column
  // For each column, for each pair (i, k <= i) of its entries: the block that the product changes; diagonal
  // blocks of the row are given as kDiagonal.
  Vector<uint32_t> updates;
  Vector<Coupling> couplings;

  static constexpr uint32_t kDiagonal = 0xffffffffu;

  // Work of one factorisation in block products.
  uint64_t blockProducts() const { return updates.size(); }
};

// num_bodies: local body indices in `joints` are below it. Returns false, with the structure empty, when the
// factor would need more than `max_products` block products.
bool buildDirectStructure(std::span<const JointEnds> joints, uint32_t num_bodies, uint64_t max_products,
                          DirectStructure& out);

// The off-diagonal block of two positions, row later than column, that the structure has.
uint32_t findBlock(const DirectStructure& structure, uint32_t row, uint32_t column);

// Appends the updates that follow from columns and entries.
void listUpdates(DirectStructure& structure);

}  // namespace pfx

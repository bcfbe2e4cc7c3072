// What the collision stage remembers of each pair from step to step: manifolds, and how the pair stood when
// they were found.
//
// A contact is named by Pair::contact_id and keeps its place while the pair lives. Manifolds lie in one pool,
// in blocks of 1, 2, 4, ... that a contact owns; a pair that never touched owns none. Growing the pool moves
// manifolds, so blocks are only changed in the serial parts of the stage.
#pragma once

#include <cstdint>
#include <span>

#include "pfx/base_level/collision/contact_manifold.h"
#include "pfx/base_level/collision/pair_table.h"
#include "pfx/base_level/memory/containers.h"

namespace pfx {

struct Contact {
  uint32_t first = 0;          // manifold in the pool
  uint16_t count = 0;          // manifolds in use
  uint16_t capacity_log2 = 0;  // of the block, plus one; 0: no block
  bool rolls = false;          // a round surface touches; its points follow every motion
  bool reported_touching = false;
  PairCache cache;     // separating axis and feature hints of the narrow phase
  Transform relative;  // B seen from A when the manifolds were found

  uint32_t capacity() const { return capacity_log2 == 0 ? 0u : 1u << (capacity_log2 - 1); }
};

class ContactStore {
 public:
  uint32_t add();  // a contact without manifolds; its id
  void remove(uint32_t id);
  void clear();

  size_t size() const { return contacts_.size(); }  // ids are below it

  Contact& operator[](uint32_t id) { return contacts_[id]; }
  const Contact& operator[](uint32_t id) const { return contacts_[id]; }
  std::span<ContactManifold> manifolds(uint32_t id) {
    return {pool_.data() + contacts_[id].first, contacts_[id].count};
  }
  std::span<const ContactManifold> manifolds(uint32_t id) const {
    return {pool_.data() + contacts_[id].first, contacts_[id].count};
  }

  // Replaces the manifolds of a contact. Takes a larger block when the count asks for it, which may move the
  // pool.
  void assign(uint32_t id, std::span<const ContactManifold> manifolds);

  // The same where the block is large enough already: touches nothing but this contact, and may run in
  // parallel.
  bool assignInPlace(uint32_t id, std::span<const ContactManifold> manifolds);

  // Keeps the first `count` manifolds of a contact.
  void shorten(uint32_t id, uint16_t count) { contacts_[id].count = count; }

 private:
  static constexpr int kSizeClasses = 16;
  void releaseBlock(Contact& contact);

  Vector<Contact> contacts_;
  Vector<uint32_t> free_contacts_;
  Vector<ContactManifold> pool_;
  Vector<uint32_t> free_blocks_[kSizeClasses];
};

}  // namespace pfx

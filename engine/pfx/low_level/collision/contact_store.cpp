#include "pfx/low_level/collision/contact_store.h"

#include <algorithm>
#include <bit>

namespace pfx {

uint32_t ContactStore::add() {
  if (free_contacts_.empty()) {
    contacts_.emplace_back();
    return static_cast<uint32_t>(contacts_.size()) - 1;
  }
  const uint32_t id = free_contacts_.back();
  free_contacts_.pop_back();
  contacts_[id] = {};
  return id;
}

void ContactStore::remove(uint32_t id) {
  releaseBlock(contacts_[id]);
  free_contacts_.push_back(id);
}

void ContactStore::clear() {
  contacts_.clear();
  free_contacts_.clear();
  pool_.clear();
  for (auto& blocks : free_blocks_) blocks.clear();
}

void ContactStore::releaseBlock(Contact& contact) {
  if (contact.capacity_log2 > 0) free_blocks_[contact.capacity_log2 - 1].push_back(contact.first);
  contact.capacity_log2 = 0;
  contact.count = 0;
}

bool ContactStore::assignInPlace(uint32_t id, std::span<const ContactManifold> manifolds) {
  Contact& contact = contacts_[id];
  if (manifolds.size() > contact.capacity()) return false;
  std::copy(manifolds.begin(), manifolds.end(), pool_.begin() + contact.first);
  contact.count = static_cast<uint16_t>(manifolds.size());
  return true;
}

void ContactStore::assign(uint32_t id, std::span<const ContactManifold> manifolds) {
  if (assignInPlace(id, manifolds)) return;
  Contact& contact = contacts_[id];
  releaseBlock(contact);
  const auto size_class = static_cast<uint16_t>(std::bit_width(manifolds.size() - 1));
  auto& blocks = free_blocks_[size_class];
  if (blocks.empty()) {
    contact.first = static_cast<uint32_t>(pool_.size());
    pool_.resize(pool_.size() + (size_t(1) << size_class));
  } else {
    contact.first = blocks.back();
    blocks.pop_back();
  }
  contact.capacity_log2 = static_cast<uint16_t>(size_class + 1);
  assignInPlace(id, manifolds);
}

}  // namespace pfx

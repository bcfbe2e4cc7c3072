// Pairs of bodies that the application keeps from colliding.
#pragma once

#include <cstdint>
#include <span>

#include "pfx/base_level/memory/containers.h"

namespace pfx {

class ApartPairs {
 public:
  void add(uint32_t body_a, uint32_t body_b);
  void remove(uint32_t body_a, uint32_t body_b);
  bool contains(uint32_t body_a, uint32_t body_b) const;
  void forgetBody(uint32_t body);

  std::span<const uint64_t> keys() const { return keys_; }  // Pair::key(), ascending
  void assign(Vector<uint64_t> keys) { keys_ = std::move(keys); }

 private:
  Vector<uint64_t> keys_;
};

}  // namespace pfx

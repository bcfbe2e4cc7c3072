#include "pfx/low_level/solver/body_elimination.h"

#include <algorithm>
#include <bit>

namespace pfx {
namespace {

constexpr uint32_t kEliminated = 0xffffffffu;

bool same(const Link& a, const Link& b) { return a.body_a == b.body_a && a.body_b == b.body_b; }

template <class Fn>
void forBits(std::span<const uint64_t> bits, Fn&& fn) {
  for (uint32_t w = 0; w < bits.size(); ++w)
    for (uint64_t rest = bits[w]; rest != 0; rest &= rest - 1)
      fn(64 * w + static_cast<uint32_t>(std::countr_zero(rest)));
}

}  // namespace

void BodyElimination::connect() {
  words_ = (num_bodies_ + 63) / 64;
  bits_.assign(size_t(num_bodies_) * words_, 0);
  const auto set = [&](uint32_t row, uint32_t bit) {
    bits_[size_t(row) * words_ + bit / 64] |= uint64_t(1) << bit % 64;
  };
  for (const Link& l : links_) set(l.body_a, l.body_b), set(l.body_b, l.body_a);
  degree_.assign(num_bodies_, 0);
  for (uint32_t i = 0; i < num_bodies_; ++i)
    for (uint32_t w = 0; w < words_; ++w)
      degree_[i] += static_cast<uint32_t>(std::popcount(bits_[size_t(i) * words_ + w]));
}

uint32_t BodyElimination::leastCoupled() const {
  return static_cast<uint32_t>(std::min_element(degree_.begin(), degree_.end()) - degree_.begin());
}

void BodyElimination::eliminate() {
  structure_.order.clear(), structure_.entries.clear(), structure_.updates.clear();
  structure_.column_begin.assign(1, 0);
  position_.resize(num_bodies_);
  column_.resize(words_);
  for (uint32_t p = 0; p < num_bodies_; ++p) {
    const uint32_t body = leastCoupled();
    std::copy_n(bits_.begin() + static_cast<std::ptrdiff_t>(size_t(body) * words_), words_, column_.begin());
    forBits(column_, [&](uint32_t other) {
      uint64_t* row = &bits_[size_t(other) * words_];
      for (uint32_t w = 0; w < words_; ++w) row[w] |= column_[w];
      row[other / 64] &= ~(uint64_t(1) << other % 64);
      row[body / 64] &= ~(uint64_t(1) << body % 64);
      degree_[other] = 0;
      for (uint32_t w = 0; w < words_; ++w) degree_[other] += static_cast<uint32_t>(std::popcount(row[w]));
      structure_.entries.push_back({other});  // the body; its position follows
    });
    degree_[body] = kEliminated;
    position_[body] = p;
    structure_.order.push_back(body);
    structure_.column_begin.push_back(static_cast<uint32_t>(structure_.entries.size()));
  }
}

bool BodyElimination::update(std::span<const Link> links, uint32_t num_bodies) {
  if (num_bodies == num_bodies_ && std::equal(links.begin(), links.end(), links_.begin(), links_.end(), same))
    return false;
  num_bodies_ = num_bodies;
  links_.assign(links.begin(), links.end());
  connect();
  eliminate();
  for (DirectStructure::Entry& e : structure_.entries) e.row = position_[e.row];
  for (uint32_t p = 0; p < num_bodies; ++p)
    std::sort(structure_.entries.begin() + structure_.column_begin[p],
              structure_.entries.begin() + structure_.column_begin[p + 1],
              [](const DirectStructure::Entry& a, const DirectStructure::Entry& b) { return a.row < b.row; });
  listUpdates(structure_);
  return true;
}

}  // namespace pfx

// Union-find with the lowest body as root, then two counting sorts.
#include "pfx/low_level/island/islands.h"

#include <utility>

namespace pfx {

namespace {

bool isStrictlyAscending(std::span<const uint32_t> v, uint32_t end) {
  for (std::size_t i = 1; i < v.size(); ++i) {
    if (v[i - 1] >= v[i]) return false;
  }
  return v.empty() || v.back() < end;
}

// Turns counts at [i + 1] into begins at [i]; scatter(i) then hands out places and advances begin[i], so that
// after the scatter begin[i] is the end of i. shiftBack restores it.
void accumulate(Vector<uint32_t>& counts) {
  for (std::size_t i = 1; i < counts.size(); ++i) counts[i] += counts[i - 1];
}
void shiftBack(Vector<uint32_t>& ends) {
  for (std::size_t i = ends.size() - 1; i > 0; --i) ends[i] = ends[i - 1];
  ends[0] = 0;
}

}  // namespace

Error Islands::build(uint32_t num_bodies, std::span<const uint32_t> active, std::span<const Link> links) {
  // What the last build left is cleared entry by entry: its bodies, not all bodies.
  for (uint32_t body : active_) island_[body] = kNoIsland;
  num_islands_ = 0;
  active_.clear();
  body_begin_.assign(1, 0);
  link_begin_.assign(1, 0);
  if (!isStrictlyAscending(active, num_bodies)) return Error::OutOfRange;

  parent_.resize(num_bodies, kNoIsland);
  island_.resize(num_bodies, kNoIsland);
  active_.assign(active.begin(), active.end());
  for (uint32_t body : active_) parent_[body] = body;
  unite(links);
  number();
  listBodies();
  listLinks(links);
  for (uint32_t body : active_) parent_[body] = kNoIsland;
  return Error::Ok;
}

Error Islands::build(std::span<const RigidState> states, std::span<const Link> links) {
  bodies_.clear();  // serves as the list of the active bodies until build has copied it
  for (uint32_t i = 0; i < states.size(); ++i) {
    if (isDynamic(states[i].motion_type) && !states[i].asleep) bodies_.push_back(i);
  }
  return build(static_cast<uint32_t>(states.size()), bodies_, links);
}

uint32_t Islands::root(uint32_t body) {
  while (parent_[body] != body) {
    parent_[body] = parent_[parent_[body]];
    body = parent_[body];
  }
  return body;
}

void Islands::unite(std::span<const Link> links) {
  const uint32_t n = static_cast<uint32_t>(parent_.size());
  for (const Link& link : links) {
    if (link.body_a >= n || link.body_b >= n) continue;
    if (parent_[link.body_a] == kNoIsland || parent_[link.body_b] == kNoIsland) continue;
    uint32_t a = root(link.body_a), b = root(link.body_b);
    if (a > b) std::swap(a, b);
    parent_[b] = a;
  }
}

// The root is the lowest body of its island and comes first.
void Islands::number() {
  for (uint32_t body : active_) {
    const uint32_t r = root(body);
    island_[body] = r == body ? num_islands_++ : island_[r];
  }
}

void Islands::listBodies() {
  body_begin_.assign(num_islands_ + 1, 0);
  for (uint32_t body : active_) ++body_begin_[island_[body] + 1];
  accumulate(body_begin_);
  bodies_.resize(active_.size());
  for (uint32_t body : active_) bodies_[body_begin_[island_[body]]++] = body;
  shiftBack(body_begin_);
}

uint32_t Islands::activeEnd(const Link& link) const {
  const uint32_t island = islandOf(link.body_a);
  return island != kNoIsland ? island : islandOf(link.body_b);
}

void Islands::listLinks(std::span<const Link> links) {
  link_begin_.assign(num_islands_ + 1, 0);
  for (const Link& link : links) {
    if (const uint32_t island = activeEnd(link); island != kNoIsland) ++link_begin_[island + 1];
  }
  accumulate(link_begin_);
  links_.resize(link_begin_.back());
  for (uint32_t i = 0; i < links.size(); ++i) {
    if (const uint32_t island = activeEnd(links[i]); island != kNoIsland) links_[link_begin_[island]++] = i;
  }
  shiftBack(link_begin_);
}

std::span<const uint32_t> Islands::bodies(uint32_t island) const {
  return std::span(bodies_).subspan(body_begin_[island], body_begin_[island + 1] - body_begin_[island]);
}

std::span<const uint32_t> Islands::links(uint32_t island) const {
  return std::span(links_).subspan(link_begin_[island], link_begin_[island + 1] - link_begin_[island]);
}

uint32_t Islands::islandOf(uint32_t body) const { return body < island_.size() ? island_[body] : kNoIsland; }

}  // namespace pfx

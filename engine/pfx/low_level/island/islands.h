// Islands: sets of bodies that contacts and joints connect, so that each set can be solved and put to sleep
// alone.
//
// Only active bodies connect: dynamic ones that are awake, or whatever set the caller names. A fixed or
// scripted body touches many islands and merges none. The cost is that of the active bodies and links; bodies
// that are not active cost nothing, however many there are. Union by the lowest index makes the numbering
// independent of the order of the links: islands are numbered by their lowest body.
#pragma once

#include <cstdint>
#include <span>

#include "pfx/base_level/error.h"
#include "pfx/base_level/memory/containers.h"
#include "pfx/base_level/rigid_body/rigid_state.h"
#include "pfx/low_level/island/link.h"

namespace pfx {

inline constexpr uint32_t kNoIsland = 0xffffffffu;

class Islands {
 public:
  // Makes the islands of `active` (indices < num_bodies, strictly ascending; a body without links is an
  // island of its own). A link counts for the island of its active bodies; one without an active body belongs
  // to no island. Bodies named by links need not be < num_bodies: such bodies are not active.
  // Error::OutOfRange when `active` is not as described; there are no islands then. Allocates only to grow.
  Error build(uint32_t num_bodies, std::span<const uint32_t> active, std::span<const Link> links);

  // The same with active = dynamic and awake.
  Error build(std::span<const RigidState> states, std::span<const Link> links);

  uint32_t size() const { return num_islands_; }
  std::span<const uint32_t> bodies(uint32_t island) const;  // body indices, ascending
  std::span<const uint32_t> links(uint32_t island) const;   // indices into `links` of build, ascending
  uint32_t islandOf(uint32_t body) const;                   // kNoIsland when the body is not active

 private:
  uint32_t root(uint32_t body);
  uint32_t activeEnd(const Link& link) const;
  void unite(std::span<const Link> links);
  void number();
  void listBodies();
  void listLinks(std::span<const Link> links);

  uint32_t num_islands_ = 0;
  Vector<uint32_t> active_;
  Vector<uint32_t> parent_;  // by body; kNoIsland when not active. Restored after each build.
  Vector<uint32_t> island_;  // by body; kNoIsland when not active
  Vector<uint32_t> bodies_, links_;
  Vector<uint32_t> body_begin_, link_begin_;  // (islands + 1)
};

}  // namespace pfx

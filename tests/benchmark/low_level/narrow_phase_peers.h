// The narrow phases of other engines on the bodies of a world, where those engines are installed.
#pragma once

#include <memory>
#include <vector>

#include "pfx/high_level/world/world.h"

namespace pfx_test {

struct PeerCost {
  double seconds = 0.0;  // of the narrow phase alone
  double pairs = 0.0;    // that its own broad phase found
};

class NarrowPhasePeer {
 public:
  virtual ~NarrowPhasePeer() = default;
  virtual const char* name() const = 0;
  // Moves its copies of the bodies to where those of the world are, and finds their contacts.
  virtual PeerCost findContacts(const pfx::World& world) = 0;
};

// With copies of the bodies of a world of boxes and convex meshes, one shape each.
std::unique_ptr<NarrowPhasePeer> makeBulletPeer(const pfx::World& world);
std::unique_ptr<NarrowPhasePeer> makeOdePeer(const pfx::World& world);

// Those that are installed.
std::vector<std::unique_ptr<NarrowPhasePeer>> narrowPhasePeers(const pfx::World& world);

}  // namespace pfx_test

#include "tests/benchmark/low_level/narrow_phase_peers.h"

namespace pfx_test {

std::vector<std::unique_ptr<NarrowPhasePeer>> narrowPhasePeers([[maybe_unused]] const pfx::World& world) {
  std::vector<std::unique_ptr<NarrowPhasePeer>> peers;
#ifdef VITRINE_HAS_BULLET
  peers.push_back(makeBulletPeer(world));
#endif
#ifdef VITRINE_HAS_ODE
  peers.push_back(makeOdePeer(world));
#endif
  return peers;
}

}  // namespace pfx_test

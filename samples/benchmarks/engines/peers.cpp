// Which of the other engines were found when the program was built.
#include "samples/benchmarks/engines/engine.h"

namespace samples::benchmarks {

#ifdef VITRINE_HAS_BULLET
EngineKind bulletEngine();
#endif
#ifdef VITRINE_HAS_ODE
EngineKind odeEngine();
EngineKind odeDirectEngine();
#endif

std::vector<EngineKind> peers() {
  std::vector<EngineKind> found;
#ifdef VITRINE_HAS_BULLET
  found.push_back(bulletEngine());
#endif
#ifdef VITRINE_HAS_ODE
  found.push_back(odeEngine());
#endif
  return found;
}

std::vector<EngineKind> peersWithAllSolvers() {
  std::vector<EngineKind> found = peers();
#ifdef VITRINE_HAS_ODE
  found.push_back(odeDirectEngine());
#endif
  return found;
}

}  // namespace samples::benchmarks

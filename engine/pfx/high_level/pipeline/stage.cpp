#include "pfx/high_level/pipeline/stage.h"

#include <array>
#include <chrono>
#include <utility>

#include "pfx/high_level/pipeline/stages.h"
#include "pfx/high_level/world/world_impl.h"

namespace pfx {
namespace {

bool hasSeveralBodies(const World::Impl& w) { return w.store.count() > 1; }
bool hasPairs(const World::Impl& w) { return !w.pairs.empty(); }
bool hasConstraints(const World::Impl& w) { return !w.constraints.empty() || !w.joint_step.empty(); }
bool hasContacts(const World::Impl& w) { return !w.constraints.empty(); }
bool hasSoftGears(const World::Impl& w) { return w.joint_step.hasSoftGears(); }
bool hasJoints(const World::Impl& w) { return w.joint_store.count() > 0; }
// A world that remembers nothing keeps to the plain solver, unless it is told otherwise.
bool mayNeedNewton(const World::Impl& w) {
  if (!hasContacts(w) || w.def.contact_solver == ContactSolver::Soft) return false;
  if (w.def.contact_solver == ContactSolver::Newton) return true;
  return (w.any_strained || (!w.joint_step.empty() && !stage::isJointCrowd(w))) && w.def.pipeline != Pipeline::Simple;
}
bool hasNewtonIslands(const World::Impl& w) { return w.num_newton_islands > 0; }
bool hasFreeComponents(const World::Impl& w) { return !w.free_components.empty(); }
bool hasFreeBodies(const World::Impl& w) { return !w.free_bodies.empty(); }
bool hasKeyframes(const World::Impl& w) { return w.moving.size() > w.active.size() || !w.keyframes.empty(); }
bool hasSleepers(const World::Impl& w) { return w.def.sleeping && w.num_sleepers > 0 && hasPairs(w); }
bool reportsApproaches(const World::Impl& w) { return w.def.report_events && hasPairs(w); }
bool reportsEvents(const World::Impl& w) {
  const EventStore& e = w.events;
  return w.def.report_events && (hasPairs(w) || !e.touching.empty() || !e.next_woke.empty() || !e.woke.empty() ||
                                 !e.next_fell_asleep.empty() || !e.fell_asleep.empty() || !e.end.empty() || !e.leave.empty());
}
bool hasModified(const World::Impl& w) { return !w.modified.empty(); }
bool hasMovingMeshes(const World::Impl& w) {
  for (const MeshMotion& m : w.mesh_motions)
    if (m.is_moving) return true;
  return false;
}
bool hasParticles(const World::Impl& w) { return !w.particle_store.empty(); }
bool sleeps(const World::Impl& w) { return w.def.sleeping && !w.active.empty(); }

constexpr std::array kSimple = {
    Stage{"broad phase", hasSeveralBodies, stage::findPairsAnew},
    Stage{"collision", hasPairs, stage::detectCollisions},
    Stage{"approaches", reportsApproaches, stage::noteApproaches},
    Stage{"constraints", hasPairs, stage::gatherConstraints},
    Stage{"joints", hasJoints, stage::gatherJoints},
    Stage{"choose solvers", mayNeedNewton, stage::chooseSolvers},
    Stage{"free flight", hasFreeBodies, stage::flyFree},
    Stage{"joint components", hasFreeComponents, stage::solveJointComponents},
    Stage{"island solver", hasNewtonIslands, stage::solveNewtonIslands},
    Stage{"solver set-up", hasConstraints, stage::setUpSolver},
    Stage{"solve", hasConstraints, stage::solve},
    Stage{"write back", hasConstraints, stage::writeBack},
    Stage{"gears", hasSoftGears, stage::countGears},
    Stage{"break joints", hasJoints, stage::breakJoints},
    Stage{"key frames", hasKeyframes, stage::followKeyframes},
    Stage{"continuous", hasPairs, stage::stopAtImpacts},
    Stage{"particles", hasParticles, stage::moveParticles},
    Stage{"moving meshes", hasMovingMeshes, stage::endMeshMotions},
    Stage{"events", reportsEvents, stage::reportEvents},
};

constexpr std::array kStable = {
    Stage{"broad phase", hasSeveralBodies, stage::updatePairs},
    Stage{"collision", hasPairs, stage::detectCollisions},
    Stage{"wake", hasSleepers, stage::wakeTouched},
    Stage{"approaches", reportsApproaches, stage::noteApproaches},
    Stage{"constraints", hasPairs, stage::gatherConstraints},
    Stage{"joints", hasJoints, stage::gatherJoints},
    Stage{"choose solvers", mayNeedNewton, stage::chooseSolvers},
    Stage{"free flight", hasFreeBodies, stage::flyFree},
    Stage{"joint components", hasFreeComponents, stage::solveJointComponents},
    Stage{"island solver", hasNewtonIslands, stage::solveNewtonIslands},
    Stage{"solver set-up", hasConstraints, stage::setUpSolver},
    Stage{"solve", hasConstraints, stage::solve},
    Stage{"write back", hasConstraints, stage::writeBack},
    Stage{"gears", hasSoftGears, stage::countGears},
    Stage{"break joints", hasJoints, stage::breakJoints},
    Stage{"key frames", hasKeyframes, stage::followKeyframes},
    Stage{"continuous", hasPairs, stage::stopAtImpacts},
    Stage{"store impulses", hasContacts, stage::storeImpulses},
    Stage{"modified impulses", hasModified, stage::keepModifiedImpulses},
    Stage{"particles", hasParticles, stage::moveParticles},
    Stage{"moving meshes", hasMovingMeshes, stage::endMeshMotions},
    Stage{"sleep", sleeps, stage::putToSleep},
    Stage{"events", reportsEvents, stage::reportEvents},
};

}  // namespace

std::span<const Stage> stages(Pipeline pipeline) {
  if (pipeline == Pipeline::Simple) return kSimple;
  return kStable;
}

void runStages(World::Impl& world) {
  using Clock = std::chrono::steady_clock;
  world.times.clear();
  stage::begin(world);
  uint64_t bit = 1;
  for (const Stage& s : stages(world.def.pipeline)) {
    const uint64_t this_stage = std::exchange(bit, bit << 1);
    if (!s.needed(world)) continue;
    world.stages_run |= this_stage;
    const auto start = Clock::now();
    s.run(world);
    world.times.push_back({s.name, std::chrono::duration<double, std::milli>(Clock::now() - start).count()});
  }
}

}  // namespace pfx

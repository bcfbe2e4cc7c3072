#include "samples/benchmarks/engines/race.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "samples/benchmarks/engines/processor_time.h"

namespace samples::benchmarks {
namespace {

constexpr float kTimeStep = 1.0f / 60.0f;  // s
constexpr int kBlock = 10;                 // steps of one engine in a row: long enough for warm caches

struct Lane {
  Result result;
  std::unique_ptr<Engine> engine;
  bool threaded = false;
  std::vector<double> step_ms, cpu_ms;
  std::vector<double> block_ms, block_cpu_ms;
};

void runBlock(Lane& lane, int steps) {
  double wall = 0.0, cpu = 0.0;
  for (int i = 0; i < steps; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const double cpu_start = processorSeconds();
    lane.engine->step(kTimeStep);
    lane.cpu_ms.push_back(1e3 * (processorSeconds() - cpu_start));
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
    lane.step_ms.push_back(taken.count());
    wall += lane.step_ms.back(), cpu += lane.cpu_ms.back();
  }
  lane.block_ms.push_back(wall);
  lane.block_cpu_ms.push_back(cpu);
}

void measureEnd(Lane& lane, const pfx::World& start) {
  double energy = 0.0, drift = 0.0, lowest = INFINITY;
  for (uint32_t i = 0; i < start.states().size(); ++i) {
    const pfx::RigidState& before = start.states()[i];
    const pfx::RigidBody& body = start.bodies()[i];
    if (!pfx::isDynamic(before.motion_type)) continue;
    const BodyMotion after = lane.engine->motion(i);
    const pfx::Vec3d spin = after.pose.orientation.conjugate() * after.angular_velocity;
    energy += 0.5 * double(body.mass) * after.linear_velocity.squaredNorm() +
              0.5 * spin.dot(body.inertia.cast<double>() * spin);
    drift = std::max(drift, (after.pose.position - before.position.cast<double>()).norm());
    lowest = std::min(lowest, after.pose.position.y());
  }
  lane.result.kinetic_energy = energy;
  lane.result.largest_drift = drift;
  lane.result.lowest = lowest;
}

void summarize(Lane& lane, const Lane& first) {
  lane.result.ms_per_step = spread(lane.step_ms);
  lane.result.cpu_ms = spread(lane.cpu_ms);
  lane.result.worst_ms = *std::max_element(lane.step_ms.begin(), lane.step_ms.end());
  const bool wall = lane.threaded || first.threaded;
  const std::vector<double>&ours = wall ? first.block_ms : first.block_cpu_ms,
                       &theirs = wall ? lane.block_ms : lane.block_cpu_ms;
  std::vector<double> ratios(theirs.size());
  std::transform(theirs.begin(), theirs.end(), ours.begin(), ratios.begin(), std::divides<>());
  lane.result.ratio = spread(std::move(ratios));
}

}  // namespace

Spread spread(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double q) {
    return values[static_cast<size_t>(q * static_cast<double>(values.size() - 1) + 0.5)];
  };
  return {.median = at(0.5), .lower = at(0.25), .upper = at(0.75)};
}

EngineKind pfxEngine(const Case& scene, int workers) {
  return {workers == 1 ? "pfx" : "pfx, " + std::to_string(workers) + " threads",
          [&scene, workers](const pfx::World& world) {
            pfx::WorldDef def = world.def();
            def.workers = workers;
            return makePfxEngine(def, scene.make());
          },
          workers > 1};
}

std::vector<Result> race(const Case& scene, std::span<const EngineKind> contestants, int steps) {
  pfx::World start(scene.world);
  scene.make()->build(start);

  std::vector<Lane> lanes(contestants.size());
  std::vector<Lane*> running;
  for (size_t i = 0; i < lanes.size(); ++i) {
    lanes[i].result.engine = contestants[i].name;
    lanes[i].engine = contestants[i].make(start);
    lanes[i].threaded = contestants[i].threaded;
    lanes[i].result.supported = lanes[i].engine != nullptr;
    if (lanes[i].engine) running.push_back(&lanes[i]);
  }

  for (int done = 0; done < steps; done += kBlock) {
    for (Lane* lane : running) runBlock(*lane, std::min(kBlock, steps - done));
    std::reverse(running.begin(), running.end());
  }

  std::vector<Result> results;
  for (Lane& lane : lanes) {
    if (lane.engine && steps > 0) {
      measureEnd(lane, start);
      summarize(lane, lanes.front());
    }
    results.push_back(lane.result);
  }
  return results;
}

}  // namespace samples::benchmarks

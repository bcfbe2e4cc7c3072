#include "samples/benchmarks/race.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace samples::benchmarks {
namespace {

constexpr float kTimeStep = 1.0f / 60.0f;  // s
constexpr int kBlock = 10;                 // steps of one engine in a row: long enough for warm caches

class PfxEngine final : public Engine {
 public:
  PfxEngine(const Case& scene, const pfx::WorldDef& def) : world_(def) { scene.build(world_); }
  void step(float dt) override { world_.step(dt); }
  BodyMotion motion(uint32_t body) const override {
    const pfx::RigidState& s = world_.states()[body];
    return {s.pose(), s.linear_velocity, s.angular_velocity};
  }

 private:
  pfx::World world_;
};

struct Lane {
  Result result;
  std::unique_ptr<Engine> engine;
  std::vector<double> step_ms, block_ms;
};

void runBlock(Lane& lane, int steps) {
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const auto start = std::chrono::steady_clock::now();
    lane.engine->step(kTimeStep);
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
    lane.step_ms.push_back(taken.count());
    sum += taken.count();
  }
  lane.block_ms.push_back(sum);
}

void measureEnd(Lane& lane, const pfx::World& start) {
  double energy = 0.0, drift = 0.0, lowest = INFINITY;
  for (uint32_t i = 0; i < start.states().size(); ++i) {
    const pfx::RigidState& before = start.states()[i];
    const pfx::RigidBody& body = start.bodies()[i];
    if (before.motion_type == pfx::MotionType::Fixed) continue;
    const BodyMotion after = lane.engine->motion(i);
    const pfx::Vec3 spin = after.pose.orientation.conjugate() * after.angular_velocity;
    energy += 0.5 * body.mass * after.linear_velocity.squaredNorm() + 0.5 * spin.dot(body.inertia * spin);
    drift = std::max<double>(drift, (after.pose.position - before.position).norm());
    lowest = std::min<double>(lowest, after.pose.position.y());
  }
  lane.result.kinetic_energy = energy;
  lane.result.largest_drift = drift;
  lane.result.lowest = lowest;
}

void summarize(Lane& lane, const std::vector<double>& first_block_ms) {
  lane.result.ms_per_step = spread(lane.step_ms);
  lane.result.worst_ms = *std::max_element(lane.step_ms.begin(), lane.step_ms.end());
  std::vector<double> ratios(lane.block_ms.size());
  std::transform(lane.block_ms.begin(), lane.block_ms.end(), first_block_ms.begin(), ratios.begin(),
                 std::divides<>());
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
  return {workers == 1 ? "pfx" : "pfx, several workers", [&scene, workers](const pfx::World& world) {
            pfx::WorldDef def = world.def();
            def.workers = workers;
            return std::make_unique<PfxEngine>(scene, def);
          }};
}

std::vector<Result> race(const Case& scene, std::span<const EngineKind> contestants, int steps) {
  pfx::World start;
  scene.build(start);

  std::vector<Lane> lanes(contestants.size());
  std::vector<Lane*> running;
  for (size_t i = 0; i < lanes.size(); ++i) {
    lanes[i].result.engine = contestants[i].name;
    lanes[i].engine = contestants[i].make(start);
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
      summarize(lane, lanes.front().block_ms);
    }
    results.push_back(lane.result);
  }
  return results;
}

}  // namespace samples::benchmarks

#include "samples/benchmarks/engines/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "samples/benchmarks/engines/processor_time.h"

namespace samples::benchmarks {
namespace {

constexpr double kStep = 1.0 / 60.0;  // s

using accuracy::Case;

// An engine at a number of sub-steps.
struct Contestant {
  std::string solver;
  std::function<std::unique_ptr<Engine>(int substeps)> make;
  bool substeps_inside;  // a step of the engine makes all of them
};

// The bodies of a case, without its answer.
struct CaseBodies final : Scene {
  explicit CaseBodies(const Case& c) : accuracy_case(c) {}
  void build(pfx::World& world) override { accuracy_case.make()->build(world); }
  const Case& accuracy_case;
};

struct Setting {
  const char* name;
  pfx::JointSolver joints;
  pfx::ContactSolver contacts;
};

// The usual setting first, then the solvers that it chooses from.
std::vector<Setting> settingsFor(const Case& c, const pfx::World& start) {
  using enum pfx::ContactSolver;
  std::vector<Setting> settings = {{"pfx", pfx::JointSolver::Auto, Auto}};
  if (c.free) return settings;
  if (!start.joints().empty()) {
    settings.push_back({"pfx, soft joints", pfx::JointSolver::Soft, Auto});
  } else {
    settings.push_back({"pfx, soft contacts", pfx::JointSolver::Auto, Soft});
    settings.push_back({"pfx, Newton", pfx::JointSolver::Auto, Newton});
  }
  return settings;
}

std::vector<Contestant> contestants(const Case& c, const pfx::World& start, bool with_peers) {
  std::vector<Contestant> all;
  for (const Setting& setting : settingsFor(c, start))
    all.push_back({setting.name,
                   [&c, setting](int substeps) {
                     pfx::WorldDef def = worldDef(c);
                     def.substeps = c.free ? 1 : substeps;
                     def.joint_solver = setting.joints;
                     def.contact_solver = setting.contacts;
                     return makePfxEngine(def, std::make_unique<CaseBodies>(c));
                   },
                   !c.free});
  if (!with_peers) return all;
  for (const EngineKind& kind : peersWithAllSolvers())
    if (kind.make(start)) all.push_back({kind.name, [kind, &start](int) { return kind.make(start); }, false});
  return all;
}

void stepFrame(Engine& engine, const Contestant& contestant, int substeps) {
  const int calls = contestant.substeps_inside ? 1 : substeps;
  for (int i = 0; i < calls; ++i) engine.step(static_cast<float>(kStep / calls));
}

// A run whose error is still to be measured.
struct Entry {
  const Contestant* contestant;
  size_t curve;
  SweepPoint point;
  std::unique_ptr<Engine> engine;
};

double fastestRun(const Contestant& contestant, int substeps, int frames, const SweepOptions& options) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < options.repeats; ++i) {
    const auto engine = contestant.make(substeps);
    const double begin = processorSeconds();
    for (int frame = 0; frame < frames; ++frame) stepFrame(*engine, contestant, substeps);
    best = std::min(best, processorSeconds() - begin);
    if (best > options.longest_run) break;
  }
  return best;
}

double errorNow(const Entry& entry, const accuracy::Run& answer, uint32_t num_bodies) {
  std::vector<BodyMotion> bodies;
  for (uint32_t i = 0; i < num_bodies; ++i) bodies.push_back(entry.engine->motion(i));
  const double error = answer.error(bodies);
  return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

// All runs side by side, so that the answer is computed once.
void measureErrors(const Case& c, std::span<Entry> entries, int frames) {
  const auto answer = c.make();
  pfx::World world(worldDef(c));
  answer->build(world);
  const auto num_bodies = static_cast<uint32_t>(world.states().size());
  for (int frame = 0; frame < frames; ++frame) {
    answer->advance(kStep);
    for (Entry& entry : entries) {
      if (std::isinf(entry.point.error)) continue;
      stepFrame(*entry.engine, *entry.contestant, entry.point.substeps);
      const double error = errorNow(entry, *answer, num_bodies);
      if (std::abs(error) > std::abs(entry.point.error)) entry.point.error = error;
    }
  }
}

}  // namespace

Sweep runSweep(const Case& c, const SweepOptions& options) {
  pfx::World start(worldDef(c));
  c.make()->build(start);
  const std::vector<Contestant> all = contestants(c, start, options.peers);
  const int frames = static_cast<int>(std::lround(c.seconds / kStep));

  Sweep sweep{.accuracy_case = &c, .curves = {}};
  std::vector<Entry> entries;
  for (const Contestant& contestant : all) {
    sweep.curves.push_back({contestant.solver, {}});
    for (const int substeps : options.substeps) {
      const double seconds = fastestRun(contestant, substeps, frames, options);
      const SweepPoint point{substeps, 0.0, 1e9 * seconds / frames, 1e9 * seconds / (frames * kStep)};
      entries.push_back({&contestant, sweep.curves.size() - 1, point, contestant.make(substeps)});
      if (seconds > options.longest_run) break;
    }
  }
  measureErrors(c, entries, frames);
  for (const Entry& entry : entries) sweep.curves[entry.curve].points.push_back(entry.point);
  return sweep;
}

}  // namespace samples::benchmarks

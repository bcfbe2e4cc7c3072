// vitrine measure: runs a scene without drawing it and prints its figures.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "viewer/commands/arguments.h"
#include "viewer/commands/commands.h"
#include "viewer/golden/golden_record.h"
#include "viewer/input_error.h"
#include "viewer/run/figures.h"
#include "viewer/run/progress.h"
#include "viewer/run/scene_run.h"

namespace viewer {
namespace {

using nlohmann::ordered_json;

// What --solver may choose; what it does not set is as the scene has it.
struct SolverChoice {
  const char* name;
  std::optional<pfx::JointSolver> joints;
  std::optional<pfx::ContactSolver> contacts;
};
constexpr SolverChoice kSolvers[] = {
    {"auto", {}, {}},                                                    // by island
    {"soft_step", pfx::JointSolver::Soft, pfx::ContactSolver::Soft},     // sub-stepped soft constraints for all
    {"direct", pfx::JointSolver::Direct, {}},                            // joints in one sparse system
    {"newton", {}, pfx::ContactSolver::Newton},                          // contacts of islands by Newton's method
};

const SolverChoice* findSolver(const std::string& name) {
  const auto found = std::ranges::find(kSolvers, name, &SolverChoice::name);
  return found == std::end(kSolvers) ? nullptr : found;
}

struct Options {
  std::string target, solver = "auto";
  int steps = 600, threads = 1;
  float dt = samples::kTimeStep;
  std::optional<int> substeps, iterations;
  bool json = false, poses = false, every_step = false;
};

// What a run showed from its first step to its last.
struct Measured {
  Figures final;
  double max_penetration = 0.0, max_joint_error = 0.0, max_speed = 0.0;
  double total_ms = 0.0;                                 // all steps
  std::vector<std::pair<std::string, double>> stage_ms;  // all steps, in the order of the stages
  ordered_json per_step = ordered_json::array();
};

void addStageTimes(Measured& m, const pfx::World& world) {
  for (const pfx::StageTime& t : world.stageTimes()) {
    auto slot =
        std::find_if(m.stage_ms.begin(), m.stage_ms.end(), [&](const auto& s) { return s.first == t.name; });
    if (slot == m.stage_ms.end()) slot = m.stage_ms.insert(slot, {t.name, 0.0});
    slot->second += t.milliseconds;
  }
}

template <class Vector>
ordered_json vectorJson(const Vector& v) {
  return {v.x(), v.y(), v.z()};
}

ordered_json figuresJson(const Figures& f) {
  return {{"kinetic_energy", f.kinetic_energy},
          {"potential_energy", f.potential_energy},
          {"linear_momentum", vectorJson(f.linear_momentum)},
          {"angular_momentum", vectorJson(f.angular_momentum)},
          {"max_penetration", f.max_penetration},
          {"max_joint_error", f.max_joint_error},
          {"bodies", f.counts.bodies},
          {"awake", f.counts.awake},
          {"contacts", f.counts.contact_points}};
}

Measured runSteps(SceneRun& run, const Options& options) {
  Measured m;
  Progress progress("measure " + run.spec().target(), uint64_t(options.steps));
  for (int i = 0; i < options.steps; ++i) {
    progress.at(uint64_t(i));
    const auto start = std::chrono::steady_clock::now();
    run.step();
    m.total_ms += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    addStageTimes(m, run.world());
    const Figures f = computeFigures(run.world());
    m.max_penetration = std::max(m.max_penetration, f.max_penetration);
    m.max_joint_error = std::max(m.max_joint_error, f.max_joint_error);
    m.max_speed = std::max(m.max_speed, f.max_speed);
    if (options.every_step) m.per_step.push_back(figuresJson(f));
  }
  m.final = computeFigures(run.world());
  return m;
}

ordered_json posesJson(const pfx::World& world) {
  auto poses = ordered_json::array();
  const auto states = world.states();
  for (uint32_t i = 0; i < states.size(); ++i) {
    const pfx::RigidState& s = states[i];
    const pfx::Quat& q = s.orientation;
    poses.push_back({{"name", world.name(i)},
                     {"position", vectorJson(s.position)},
                     {"orientation", {q.x(), q.y(), q.z(), q.w()}},
                     {"linear_velocity", vectorJson(s.linear_velocity)},
                     {"angular_velocity", vectorJson(s.angular_velocity)}});
  }
  return poses;
}

// What the scene itself measures: that it shows what it is meant to show.
ordered_json readingsJson(const SceneRun& run) {
  auto readings = ordered_json::array();
  for (const samples::Reading& r : run.scene().readings(run.world())) {
    ordered_json reading = {{"name", r.name}, {"unit", r.unit}, {"value", r.value}};
    if (r.limit != 0.0) {
      reading["limit"] = r.limit;
      reading["holds"] = r.value <= r.limit;
    }
    readings.push_back(std::move(reading));
  }
  return readings;
}

ordered_json describe(const SceneRun& run, const Measured& m, const Options& options) {
  const double steps = std::max(1, options.steps);
  ordered_json ms = {{"total", m.total_ms / steps}};
  for (const auto& [stage, time] : m.stage_ms) ms[stage] = time / steps;
  ordered_json json = {{"target", run.spec().target()},
                       {"steps", options.steps},
                       {"dt", options.dt},
                       {"substeps", run.world().def().substeps},
                       {"solver", options.solver},
                       {"threads", options.threads},
                       {"state_hash", hexText(run.stateHash())},
                       {"final", figuresJson(m.final)},
                       {"max",
                        {{"max_penetration", m.max_penetration},
                         {"max_joint_error", m.max_joint_error},
                         {"speed", m.max_speed}}},
                       {"ms_per_step", ms}};
  json["readings"] = readingsJson(run);
  if (options.every_step) json["per_step"] = m.per_step;
  if (options.poses) json["poses"] = posesJson(run.world());
  return json;
}

void printText(const ordered_json& json) {
  std::printf("%s: %d steps of %.6g s, %d sub-steps, %d threads\n", json["target"].get<std::string>().c_str(),
              json["steps"].get<int>(), json["dt"].get<double>(), json["substeps"].get<int>(),
              json["threads"].get<int>());
  std::printf("state hash        %s\n", json["state_hash"].get<std::string>().c_str());
  const auto row = [](const std::string& name, const ordered_json& value) {
    std::printf("%-18s%s\n", name.c_str(), value.dump().c_str());
  };
  std::printf("\nat the end\n");
  for (const auto& [key, value] : json["final"].items()) row(key, value);
  std::printf("\nlargest of the run\n");
  for (const auto& [key, value] : json["max"].items()) row(key, value);
  if (!json["readings"].empty()) std::printf("\nreadings of the scene\n");
  for (const auto& r : json["readings"]) {
    std::printf("%-40s %.6g %s", r["name"].get<std::string>().c_str(), r["value"].get<double>(),
                r["unit"].get<std::string>().c_str());
    if (r.contains("limit")) std::printf(" (%s %.6g)", r["holds"].get<bool>() ? "at most" : "more than", r["limit"].get<double>());
    std::printf("\n");
  }
  std::printf("\nms per step\n");
  for (const auto& [key, value] : json["ms_per_step"].items())
    std::printf("%-18s%.4f\n", key.c_str(), value.get<double>());
  if (!json.contains("poses")) return;
  std::printf("\nposes: position (m), orientation (x, y, z, w)\n");
  for (const auto& body : json["poses"])
    row(body["name"].get<std::string>(), ordered_json{body["position"], body["orientation"]});
}

void check(const Options& o) {
  if (!(o.dt > 0.0f) || !(o.dt <= 1.0f))
    throw InputError("--dt must be a time in seconds, above 0 and at most 1");
  if (findSolver(o.solver) == nullptr)
    throw InputError("unknown solver \"" + o.solver + "\"; known: auto, soft_step, direct, newton");
  if (o.iterations)
    throw InputError("--iterations: solver " + o.solver + " does not take a number of iterations; raise --substeps instead");
}

int measure(const Options& options) {
  check(options);
  auto results = ordered_json::array();
  const SolverChoice& solver = *findSolver(options.solver);
  for (const SceneSpec& spec : findTarget(allScenes(), options.target)) {
    SceneRun run(spec, {.dt = options.dt,
                        .substeps = options.substeps,
                        .joint_solver = solver.joints,
                        .contact_solver = solver.contacts,
                        .threads = options.threads});
    const Measured m = runSteps(run, options);
    results.push_back(describe(run, m, options));
    if (!options.json) {
      if (results.size() > 1) std::printf("\n");
      printText(results.back());
    }
  }
  // One scene is an object, as is the first of a sample; the other scenes of the sample follow under
  // "scenes".
  if (options.json) {
    ordered_json json = results.front();
    if (results.size() > 1) json["scenes"] = results;
    std::puts(json.dump(2).c_str());
  }
  return 0;
}

}  // namespace

void addMeasureCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("measure", "Run a scene without drawing it and print its figures");
  const auto options = std::make_shared<Options>();
  command->add_option("TARGET", options->target, "SAMPLE[/SCENE]")->required();
  command->add_option("--steps", options->steps, "Steps to run")
      ->check(CLI::Range(0, 10000000))
      ->capture_default_str();
  command->add_option("--dt", options->dt, "Length of a step, s (1/60)");
  command->add_option("--substeps", options->substeps, "Solver sub-steps a step")->check(CLI::Range(1, 1000));
  command->add_option("--iterations", options->iterations, "Iterations of solvers that iterate")
      ->check(CLI::Range(1, 10000));
  command->add_option("--solver", options->solver, "auto, soft_step, direct or newton")->capture_default_str();
  command->add_option("--threads", options->threads, "Threads; the result is the same for any number")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command->add_flag("--poses", options->poses, "Print every body's pose and velocity");
  command->add_flag("--every-step", options->every_step, "With --json: figures of every step under per_step");
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([&action, options] { action = [options] { return measure(*options); }; });
}

}  // namespace viewer

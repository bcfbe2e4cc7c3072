// vitrine bench: time the benchmark scenes, and hold speed against error, beside the peers that are installed.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "samples/benchmarks/engines/sweep_summary.h"
#include "viewer/bench/ladder_report.h"
#include "viewer/bench/probe_report.h"
#include "viewer/bench/race_report.h"
#include "viewer/bench/sweep_report.h"
#include "viewer/commands/arguments.h"
#include "viewer/commands/commands.h"
#include "viewer/file.h"
#include "viewer/input_error.h"

namespace viewer {
namespace {

namespace bench = samples::benchmarks;
namespace accuracy = samples::accuracy;
using nlohmann::ordered_json;

struct Options {
  std::vector<std::string> cases;
  std::string threads = "1", json, csv, svg;
  int steps = 0;  // 0: as many as the scene says
  bool quick = false, check = false, peers = false;
};

// What is to be run.
struct Choice {
  std::vector<const bench::Case*> scenes;
  std::vector<const accuracy::Case*> sweeps;
  bool ladder = false, probes = false;
};

void addScenes(Choice& choice, bool large) {
  for (const bench::Case& c : bench::cases())
    if (c.large == large) choice.scenes.push_back(&c);
}

void addSweeps(Choice& choice, bool front_page_alone) {
  for (const accuracy::Case& c : accuracy::cases())
    if (c.front_page || !front_page_alone) choice.sweeps.push_back(&c);
}

[[noreturn]] void failUnknown(const std::string& name) {
  std::string known = "scenes, large, accuracy, front-page, ladder, probes";
  for (const bench::Case& c : bench::cases()) known += ", " + std::string(c.name);
  for (const accuracy::Case& c : accuracy::cases()) known += ", " + std::string(c.name);
  throw InputError("unknown case \"" + name + "\"; known: " + known);
}

Choice choose(const std::vector<std::string>& names) {
  Choice choice;
  if (names.empty()) addScenes(choice, false), addSweeps(choice, false);
  for (const std::string& name : names) {
    if (name == "scenes") addScenes(choice, false);
    else if (name == "large") addScenes(choice, true);
    else if (name == "accuracy") addSweeps(choice, false);
    else if (name == "front-page") addSweeps(choice, true);
    else if (name == "ladder") choice.ladder = true;
    else if (name == "probes") choice.probes = true;
    else if (const bench::Case* scene = bench::findCase(name)) choice.scenes.push_back(scene);
    else if (const accuracy::Case* sweep = accuracy::findCase(name)) choice.sweeps.push_back(sweep);
    else failUnknown(name);
  }
  return choice;
}

bench::SweepOptions sweepOptions(const Options& options) {
  bench::SweepOptions out;
  if (options.quick) out.substeps = {1, 4, 16}, out.repeats = 1, out.longest_run = 0.1;
  return out;
}

std::vector<bench::Sweep> runSweeps(const Choice& choice, const Options& options) {
  std::vector<bench::Sweep> sweeps;
  for (const accuracy::Case* c : choice.sweeps) {
    std::fprintf(stderr, "bench: %s\n", std::string(c->name).c_str());
    sweeps.push_back(bench::runSweep(*c, sweepOptions(options)));
    std::printf("%s\n", sweepText(sweeps.back()).c_str());
  }
  return sweeps;
}

void writeSweeps(const std::vector<bench::Sweep>& sweeps, const Options& options, ordered_json& json) {
  for (const bench::Sweep& sweep : sweeps) json["accuracy"].push_back(sweepJson(sweep));
  if (!options.csv.empty()) writeText(options.csv, sweepsCsv(sweeps));
  if (sweeps.empty()) return;
  const bench::Profile profile = bench::performanceProfile(sweeps);
  std::printf("%s\n", profileText(profile).c_str());
  json["profile"] = profileJson(profile);
  if (options.svg.empty()) return;
  const std::filesystem::path folder = options.svg;
  for (const bench::Sweep& sweep : sweeps)
    writeText(folder / (std::string(sweep.accuracy_case->name) + ".svg"), sweepSvg(sweep));
  writeText(folder / "profile.svg", profileSvg(profile));
}

int checkSweeps(const std::vector<bench::Sweep>& sweeps) {
  int missed = 0;
  for (const bench::Sweep& sweep : sweeps) {
    const std::string what = missedBy(sweep);
    if (what.empty()) continue;
    std::printf("MISSED %s: %s\n", std::string(sweep.accuracy_case->name).c_str(), what.c_str());
    ++missed;
  }
  std::printf("%zu of %zu accuracy cases hold\n", sweeps.size() - static_cast<size_t>(missed), sweeps.size());
  return missed > 0 ? 1 : 0;
}

int runBench(const Options& options) {
  const Choice choice = choose(options.cases);
  RaceOptions race{.threads = parseThreads(options.threads), .steps = options.steps};
  if (options.quick && race.steps == 0) race.steps = 20;
  for (const std::string& file : {options.json, options.csv})
    if (!file.empty()) writeText(file, "");  // fails now rather than after minutes
  if (!options.svg.empty()) requireWritableFolder(options.svg);

  ordered_json json = {{"scenes", ordered_json::array()}, {"accuracy", ordered_json::array()}};
  for (const bench::Case* c : choice.scenes) {
    race.peers = !c->large || options.peers;
    json["scenes"].push_back(runRace(*c, race));
  }
  const std::vector<bench::Sweep> sweeps = runSweeps(choice, options);
  writeSweeps(sweeps, options, json);
  if (choice.ladder) json["ladder"] = runLadder();
  if (choice.probes) json["probes"] = runProbes();
  if (!options.json.empty()) writeText(options.json, json.dump(2) + "\n");
  return options.check ? checkSweeps(sweeps) : 0;
}

}  // namespace

void addBenchCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "bench", "Time the benchmark scenes and hold speed against error, beside installed peers");
  const auto options = std::make_shared<Options>();
  command->add_option("CASE", options->cases,
                      "Benchmark scenes and accuracy cases by name, or a group: scenes (the small ones), large, accuracy, "
                      "front-page, ladder (cost of one effect after the other), probes (quality in hard scenes). None: "
                      "scenes and accuracy");
  command->add_option("--threads", options->threads, "Numbers of threads for the scenes, for example 1,2")
      ->capture_default_str();
  command->add_option("--steps", options->steps, "Steps of each scene; default as the scene says")
      ->check(CLI::Range(1, 100000));
  command->add_flag("--quick", options->quick, "Few steps and three sub-step counts, to see that everything runs");
  command->add_flag("--peers", options->peers, "Race other engines in the large scenes too (slow)");
  command->add_flag("--check", options->check, "Exit with 1 when an accuracy case misses its target or the plateau test");
  command->add_option("--json", options->json, "Write the figures to a file");
  command->add_option("--csv", options->csv, "Write the points of the accuracy cases to a file");
  command->add_option("--svg", options->svg, "Write a diagram of each accuracy case, and the profile, into a folder");
  command->callback([&action, options] { action = [options] { return runBench(*options); }; });
}

}  // namespace viewer

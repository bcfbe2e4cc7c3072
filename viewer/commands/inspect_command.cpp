// vitrine inspect: the facts of the inspector panels as text or JSON.
#include <algorithm>
#include <charconv>
#include <cstdio>

#include "viewer/commands/commands.h"
#include "viewer/input_error.h"
#include "viewer/inspect/island_facts.h"
#include "viewer/inspect/mesh_facts.h"
#include "viewer/run/scene_run.h"

namespace viewer {
namespace {

struct Options {
  std::string target, body, mesh;
  int frame = 0;
  std::optional<uint32_t> triangle;
  bool islands = false, contacts = false, joints = false, json = false;
};

std::string refText(const Json& ref) { return valueText({"", ref}); }

// A body by its name or its index.
uint32_t findBody(const pfx::World& world, const char* option, const std::string& text) {
  const auto exists = [&](uint32_t i) { return i < world.states().size() && world.bodyId(i); };
  for (uint32_t i = 0; i < world.states().size(); ++i)
    if (exists(i) && world.name(i) == text) return i;
  uint32_t index = 0;
  const char* end = text.data() + text.size();
  if (const auto [at, error] = std::from_chars(text.data(), end, index); error == std::errc() && at == end)
    if (exists(index)) return index;
  throw InputError(std::string(option) + " \"" + text + "\": no body has this name or index");
}

std::string meshBodies(const pfx::World& world) {
  std::string names;
  for (uint32_t i = 0; i < world.states().size(); ++i)
    if (meshOfBody(world, i)) names += (names.empty() ? "" : ", ") + bodyTitle(world, i);
  return names.empty() ? "this scene has none" : "this scene has: " + names;
}

// What was asked for: a sheet for each part, under the key of the JSON.
struct Report {
  Json islands, contacts;
  std::optional<FactSheet> body, mesh, triangle;
  FactList joints{"joints", {}};
};

Json contactsJson(const pfx::World& world) {
  Json contacts = Json::array();
  for (const pfx::Pair& pair : world.contactPairs()) {
    Json contact = toJson(contactFacts(world, pair));
    if (!contact["points"].empty()) contacts.push_back(std::move(contact));
  }
  return contacts;
}

Report report(const pfx::World& world, const Options& o) {
  Report r;
  if (o.islands) {
    r.islands = Json::array();
    for (uint32_t i = 0; i < world.numIslands(); ++i) r.islands.push_back(islandJson(world, i));
  }
  if (o.contacts) r.contacts = contactsJson(world);
  if (o.joints)
    for (uint32_t i = 0; i < world.jointLinks().size(); ++i)
      if (world.jointLinks()[i].exists) r.joints.items.push_back(jointFacts(world, i));
  if (!o.body.empty()) r.body = bodyFacts(world, findBody(world, "--body", o.body));
  if (o.mesh.empty()) return r;
  const uint32_t body = findBody(world, "--mesh", o.mesh);
  const auto placed = meshOfBody(world, body);
  if (!placed) throw InputError("--mesh \"" + o.mesh + "\": this body has no large mesh; " + meshBodies(world));
  r.mesh = meshFacts(world, body);
  if (!o.triangle) return r;
  if (*o.triangle >= placed->mesh->numFacets())
    throw InputError("--triangle " + std::to_string(*o.triangle) + ": the mesh has triangles 0 .. " +
                     std::to_string(placed->mesh->numFacets() - 1));
  r.triangle = triangleFacts(world, body, *o.triangle);
  return r;
}

Json countsJson(const pfx::WorldCounts& c) {
  return {{"bodies", c.bodies},
          {"awake", c.awake},
          {"pairs", c.pairs},
          {"touching_pairs", c.touching_pairs},
          {"contact_points", c.contact_points},
          {"islands", c.islands},
          {"joints", c.joints}};
}

void printJson(const SceneRun& run, const Options& o, const Report& r) {
  Json json = {{"target", run.spec().target()}, {"frame", o.frame}, {"counts", countsJson(run.world().counts())}};
  if (o.islands) json["islands"] = r.islands;
  if (o.contacts) json["contacts"] = r.contacts;
  if (o.joints) {
    json["joints"] = Json::array();
    for (const FactSheet& joint : r.joints.items) json["joints"].push_back(toJson(joint));
  }
  if (r.body) json["body"] = toJson(*r.body);
  if (r.mesh) json["mesh"] = toJson(*r.mesh);
  if (r.triangle) json["triangle"] = toJson(*r.triangle);
  std::puts(json.dump(2).c_str());
}

// The first few by name; --json has all.
std::string memberList(const Json& bodies) {
  constexpr size_t kShown = 8;
  std::string members;
  for (size_t i = 0; i < std::min(kShown, bodies.size()); ++i) members += (i > 0 ? ", " : "") + refText(bodies[i]);
  if (bodies.size() > kShown) members += " and " + std::to_string(bodies.size() - kShown) + " more";
  return members;
}

void printIslands(const Json& islands) {
  std::printf("\nisland  bodies  contacts  joints  still for s  why, members\n");
  for (const Json& island : islands)
    std::printf("%6u  %6zu  %8zu  %6u  %11.2f  %s\n%47s%s\n", island["id"].get<uint32_t>(), island["bodies"].size(),
                island["contacts"].get<size_t>(), island["joints"].get<uint32_t>(),
                island["sleep_timer"].get<double>(), island["why"].get<std::string>().c_str(), "",
                memberList(island["bodies"]).c_str());
  if (islands.empty()) std::printf("no island is awake\n");
}

void printContacts(const Json& contacts) {
  std::printf("\ncontacts: position (m), normal from the first to the second, distance (m), impulse (N s)\n");
  const auto number = [](const Json& list, size_t i) { return list[i].get<double>(); };
  for (const Json& contact : contacts) {
    std::printf("%s - %s\n", refText(contact["body_a"]).c_str(), refText(contact["body_b"]).c_str());
    for (const Json& p : contact["points"]) {
      const Json &x = p["position"], &n = p["normal"];
      std::printf("  (%.4f, %.4f, %.4f)  (%.3f, %.3f, %.3f)  %+.6f  %.5f", number(x, 0), number(x, 1), number(x, 2),
                  number(n, 0), number(n, 1), number(n, 2), p["distance"].get<double>(), p["impulse"].get<double>());
      if (p.contains("triangle"))
        std::printf("  triangle %u of %s", p["triangle"].get<uint32_t>(), refText(p["mesh"]).c_str());
      std::printf("\n");
    }
  }
  if (contacts.empty()) std::printf("no bodies touch\n");
}

void printSheet(const char* title, const FactSheet& sheet) {
  std::printf("\n%s\n%s", title, toText(sheet, 2).c_str());
}

// One line for each contact point on the mesh; --json and --triangle have all of it.
void printMesh(FactSheet mesh) {
  const std::vector<FactSheet> touches = std::move(mesh.lists.front().items);
  mesh.lists.clear();
  printSheet("mesh", mesh);
  std::printf("\nwhat rests on it\n%s", touches.empty() ? "nothing\n" : "island  triangle  distance m  impulse N s  body\n");
  for (const FactSheet& touch : touches) {
    const Json t = toJson(touch);
    std::printf("%6u  %8u  %+10.6f  %11.5f  %s\n", t["island"].get<uint32_t>(), t["triangle"].get<uint32_t>(),
                t["distance"].get<double>(), t["impulse"].get<double>(), refText(t["body"]).c_str());
  }
}

void printText(const SceneRun& run, const Options& o, const Report& r) {
  std::printf("%s, frame %d\n", run.spec().target().c_str(), o.frame);
  const Json counts = countsJson(run.world().counts());
  for (const auto& [key, value] : counts.items())
    std::printf("  %-16s%u\n", key.c_str(), value.get<uint32_t>());
  if (o.islands) printIslands(r.islands);
  if (o.contacts) printContacts(r.contacts);
  for (const FactSheet& joint : r.joints.items) printSheet("joint", joint);
  if (r.body) printSheet("body", *r.body);
  if (r.mesh && !r.triangle) printMesh(*r.mesh);
  if (r.triangle) printSheet("triangle", *r.triangle);
}

int inspect(Options options) {
  if (options.triangle && options.mesh.empty()) throw InputError("--triangle needs --mesh BODY");
  const bool named = options.joints || !options.mesh.empty() || !options.body.empty();
  if (!options.islands && !options.contacts && !named) options.islands = options.contacts = true;
  SceneRun run(findScene(allScenes(), options.target));
  run.stepTo(uint64_t(options.frame));
  const Report facts = report(run.world(), options);
  options.json ? printJson(run, options, facts) : printText(run, options, facts);
  return 0;
}

}  // namespace

void addInspectCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "inspect", "Islands, contacts, joints, bodies and triangles of one frame, as text or JSON (SI units)");
  const auto options = std::make_shared<Options>();
  command->add_option("TARGET", options->target, "SAMPLE/SCENE")->required();
  command->add_option("--frame", options->frame, "Steps to run first")
      ->check(CLI::Range(0, 1000000))
      ->required();
  command->add_flag("--islands", options->islands, "Islands, and why each is awake");
  command->add_flag("--contacts", options->contacts, "Contacts (without any choice: islands and contacts)");
  command->add_flag("--joints", options->joints, "Joints, with errors, loads and all axes");
  command->add_option("--body", options->body, "All about one body, by name or index");
  command->add_option("--mesh", options->mesh, "The large mesh of a body, by name or index, and what rests on it");
  command->add_option("--triangle", options->triangle, "All about one triangle of --mesh, by index");
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([&action, options] { action = [options] { return inspect(*options); }; });
}

}  // namespace viewer

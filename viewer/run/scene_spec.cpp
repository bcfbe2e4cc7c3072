// Scenes by the name that the command line uses.
#include "viewer/run/scene_spec.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "pfx/base_level/shape/aabb.h"
#include "pfx/high_level/scene_file/nearest_name.h"
#include "pfx/high_level/scene_file/scene_file.h"
#include "pfx/high_level/world/snapshot.h"
#include "samples/all_in_world.h"
#include "viewer/input_error.h"

namespace viewer {
namespace {

std::string nearestTarget(std::span<const SceneSpec> scenes, std::string_view wanted) {
  std::string best;
  size_t best_distance = ~size_t(0);
  const auto offer = [&](std::string_view spelling, const std::string& target) {
    const size_t d = pfx::editDistance(wanted, spelling);
    if (d < best_distance) best_distance = d, best = target;
  };
  for (const SceneSpec& s : scenes) {
    const auto bare = std::string_view(s.sample).substr(s.sample.find('_') + 1);  // "stable" of "2_stable"
    offer(s.sample, s.sample);
    offer(bare, s.sample);
    offer(s.target(), s.target());
    offer(s.name, s.target());
  }
  return best;
}

class FileScene final : public samples::Scene, public samples::AllInWorld {
 public:
  explicit FileScene(std::shared_ptr<const pfx::SceneDef> def) : def_(std::move(def)) {}
  void build(pfx::World& world) override { pfx::buildScene(*def_, world); }

 private:
  std::shared_ptr<const pfx::SceneDef> def_;
};

// A world in the middle of its run.
class SnapshotScene final : public samples::Scene {
 public:
  explicit SnapshotScene(std::shared_ptr<const std::vector<std::byte>> bytes) : bytes_(std::move(bytes)) {}
  void build(pfx::World& world) override { world.restore(*bytes_); }

 private:
  std::shared_ptr<const std::vector<std::byte>> bytes_;
};

// Far enough for the eye to see all bodies that can move, or all when none can.
samples::CameraPose cameraAround(const pfx::World& world) {
  pfx::Aabb moving, all;
  for (uint32_t i = 0; i < world.states().size(); ++i) {
    const pfx::RigidState& s = world.states()[i];
    const pfx::Collidable& c = world.collidables()[i];
    const pfx::Aabb box = pfx::transformedAabb(s.pose(), c.center, c.half_extent);
    all.extend(box);
    if (s.motion_type != pfx::MotionType::Fixed) moving.extend(box);
  }
  const pfx::Aabb& box = moving.min.x() <= moving.max.x() ? moving : all;
  if (!(box.min.x() <= box.max.x())) return {};
  constexpr float kDistances = 3.0f;  // of the eye, in radii of what it looks at
  return {.target = box.center(), .distance = std::max(3.0f, kDistances * box.halfExtent().norm())};
}

// A trial world finds what is wrong with the scene before anything is run.
SceneSpec sceneOfFile(const std::string& path) {
  try {
    const auto def = std::make_shared<const pfx::SceneDef>(pfx::readScene(std::filesystem::path(path)));
    pfx::World trial(def->world);
    pfx::buildScene(*def, trial);
    return {.sample = std::filesystem::path(path).stem().string(),
            .name = "scene",
            .shows = path,
            .camera = cameraAround(trial),
            .frames = {0, 60, 240},
            .world = def->world,
            .make = [def] { return std::unique_ptr<samples::Scene>(new FileScene(def)); }};
  } catch (const pfx::SceneError& e) {
    throw InputError(e.what());
  }
}

bool isSnapshotFile(const std::string& path) {
  char begin[8] = {};
  std::ifstream file(path, std::ios::binary);
  file.read(begin, sizeof begin - 1);
  return std::string_view(begin) == "PFXSNAP";
}

SceneSpec sceneOfSnapshot(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto data = std::as_bytes(std::span(text));
  const auto bytes = std::make_shared<const std::vector<std::byte>>(data.begin(), data.end());
  try {
    pfx::World trial;
    trial.restore(*bytes);
    return {.sample = std::filesystem::path(path).stem().string(),
            .name = "snapshot",
            .shows = path,
            .camera = cameraAround(trial),
            .frames = {0, 60, 240},
            .world = trial.def(),
            .make = [bytes] { return std::unique_ptr<samples::Scene>(new SnapshotScene(bytes)); }};
  } catch (const pfx::SnapshotError& e) {
    throw InputError(path + ": " + e.what());
  }
}

}  // namespace

std::vector<SceneSpec> allScenes() {
  std::vector<SceneSpec> out;
  for (const samples::SceneEntry& e : samples::scenes())
    out.push_back({std::string(e.sample), std::string(e.name), std::string(e.shows), e.camera, e.frames,
                   e.world, e.make});
  return out;
}

std::vector<SceneSpec> findTarget(std::span<const SceneSpec> scenes, std::string_view target) {
  const auto slash = target.find('/');
  const std::string_view sample = target.substr(0, slash);
  std::vector<SceneSpec> found;
  for (const SceneSpec& s : scenes)
    if (s.sample == sample && (slash == target.npos || s.name == target.substr(slash + 1)))
      found.push_back(s);
  if (!found.empty()) return found;

  const std::string text(target);
  if (std::filesystem::path(text).extension() == ".xml") {
    if (!std::filesystem::exists(text)) throw InputError(text + ": no such scene file");
    return {sceneOfFile(text)};
  }
  if (isSnapshotFile(text)) return {sceneOfSnapshot(text)};
  const std::string nearest = nearestTarget(scenes, target);
  throw InputError("unknown sample or scene \"" + text + "\"" +
                   (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?") +
                   " (vitrine list shows all)");
}

SceneSpec findScene(std::span<const SceneSpec> scenes, std::string_view target) {
  std::vector<SceneSpec> found = findTarget(scenes, target);
  if (found.size() == 1) return std::move(found.front());
  throw InputError("\"" + std::string(target) + "\" has " + std::to_string(found.size()) +
                   " scenes; name one, for example " + found.front().target());
}

}  // namespace viewer

// Sample 11_xml_import: scenes that are nothing but files.
#include "pfx/high_level/scene_file/scene_file.h"
#include "samples/all_in_world.h"
#include "samples/registry.h"
#include "xml_scenes.h"

namespace samples {
namespace {

using namespace pfx;

class FileScene final : public Scene, public AllInWorld {
 public:
  explicit FileScene(const SceneText& text) : def_(readScene(text)) {}
  void build(World& world) override { buildScene(def_, world); }

 private:
  SceneDef def_;
};

SceneText cards() { return {.xml = xml_scenes::kHouseOfCards, .name = "house_of_cards.xml"}; }
SceneText machine() { return {.xml = xml_scenes::kMachine, .name = "machine.xml"}; }
SceneText example() { return {.xml = xml_scenes::kExample, .name = "example.xml"}; }

}  // namespace

std::vector<SceneEntry> xmlImportScenes() {
  return {
      {.sample = "11_xml_import",
       .name = "house_of_cards",
       .shows = "house_of_cards.xml: three storeys of cards that nothing but friction holds",
       .camera = {.target = Vec3(0.0f, 1.4f, 0.0f), .distance = 6.5f, .yaw_deg = 28.0f, .pitch_deg = 14.0f},
       .frames = {0, 60, 240},
       .world = readScene(cards()).world,
       .make = [] { return std::unique_ptr<Scene>(new FileScene(cards())); }},
      {.sample = "11_xml_import",
       .name = "machine",
       .shows = "machine.xml: a motor, two gears and a crank drive a piston that kicks a ball",
       .camera = {.target = Vec3(6.0f, 3.0f, 0.0f), .distance = 17.0f, .yaw_deg = 18.0f, .pitch_deg = 14.0f},
       .frames = {0, 60, 240},
       .world = readScene(machine()).world,
       .make = [] { return std::unique_ptr<Scene>(new FileScene(machine())); }},
      {.sample = "11_xml_import",
       .name = "example",
       .shows = "example.xml: every kind of element, each with a comment in the file",
       .camera = {.target = Vec3(0.0f, 1.5f, 0.0f), .distance = 18.0f, .yaw_deg = 30.0f, .pitch_deg = 22.0f},
       .frames = {0, 60, 240},
       .world = readScene(example()).world,
       .make = [] { return std::unique_ptr<Scene>(new FileScene(example())); }},
  };
}

}  // namespace samples

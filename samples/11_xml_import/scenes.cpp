// Sample 11_xml_import: scenes that come from files.
#include <algorithm>
#include <array>

#include "pfx/high_level/scene_file/urdf_reader.h"
#include "samples/all_in_world.h"
#include "samples/registry.h"
#include "samples/shared/builders.h"
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

// The robot of arm.urdf. Where the engine reads no URDF files, arm.xml stands for it: the same bodies and joints to the bit.
SceneDef readArm() {
  if (canReadUrdf()) return readUrdf(SceneText{.xml = xml_scenes::kArmUrdf, .name = "arm.urdf"});
  return readScene(SceneText{.xml = xml_scenes::kArm, .name = "arm.xml"});
}

// Springs on its joints are led through a few poses, so that it clears a pillar of boxes away again and again.
class Arm final : public Scene {
 public:
  void build(World& world) override {
    buildScene(readArm(), world);
    for (size_t i = 0; i < joints_.size(); ++i) {
      joints_[i] = jointNamed(world, kNames[i]);
      AxisConstraint& drive = world.joint(joints_[i]).axis[kTwist];
      drive.spring_frequency = 6.0f;
      drive.spring_damping = 1.0f;
    }
    addGround(world);
    for (int i = 0; i < 8; ++i)
      for (const float z : {-0.16f, 0.16f})
        addBody(world, "box", Box{Vec3(0.15f, 0.075f, 0.15f)}, Vec3(1.5f, 0.075f + 0.15f * static_cast<float>(i), z), 0.5f);
  }

  void beforeStep(World& world, float dt) override {
    time_ += dt;
    for (size_t i = 0; i < joints_.size(); ++i) world.joint(joints_[i]).axis[kTwist].spring_target = targetOf(i);
  }

  // How well the joints hold what they must while the drives pull.
  std::vector<Reading> readings(const World& world) const override {
    double gap = 0.0;
    for (uint32_t i = 0; i < world.joints().size(); ++i)
      gap = std::max(gap, static_cast<double>(world.jointError(i).distance));
    return {{"widest joint", "mm", 1000.0 * gap, 1.0}};
  }

 private:
  static constexpr int kTwist = 3;
  static constexpr std::array<std::string_view, 4> kNames = {"turn", "shoulder", "elbow", "wrist"};

  static JointId jointNamed(const World& world, std::string_view name) {
    uint32_t i = 0;
    while (world.jointName(i) != name) ++i;
    return world.jointId(i);
  }

  struct Pose {
    float time;                  // s
    std::array<float, 4> angle;  // rad, of the joints in the order of kNames
  };
  static constexpr std::array<Pose, 6> kPoses = {{{0.0f, {0.0f, 0.0f, 0.0f, 0.0f}},
                                                  {1.0f, {1.0f, 0.9f, 1.2f, 0.9f}},
                                                  {2.2f, {-1.0f, 0.9f, 1.2f, 0.9f}},
                                                  {3.0f, {-1.0f, 1.25f, 0.95f, 0.8f}},
                                                  {4.2f, {1.0f, 1.25f, 0.95f, 0.8f}},
                                                  {5.5f, {0.0f, -0.5f, 1.6f, 0.6f}}}};

  // Smooth from pose to pose; the last one stays.
  float targetOf(size_t joint) const {
    size_t next = 1;
    while (next + 1 < kPoses.size() && kPoses[next].time < time_) ++next;
    const Pose &from = kPoses[next - 1], &to = kPoses[next];
    const float s = std::clamp((time_ - from.time) / (to.time - from.time), 0.0f, 1.0f);
    return from.angle[joint] + s * s * (3.0f - 2.0f * s) * (to.angle[joint] - from.angle[joint]);
  }

  std::array<JointId, 4> joints_;
  float time_ = 0.0f;  // s
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
       .camera = {.target = Vec3(-0.8f, 1.3f, 0.5f), .distance = 14.5f, .yaw_deg = 30.0f, .pitch_deg = 18.0f},
       .frames = {0, 60, 240},
       .world = readScene(example()).world,
       .make = [] { return std::unique_ptr<Scene>(new FileScene(example())); }},
      {.sample = "11_xml_import",
       .name = "arm",
       .shows = "arm.urdf: springs on the joints of a robot lead its hand through a pillar of boxes and back",
       .camera = {.target = Vec3(0.5f, 1.0f, 0.0f), .distance = 6.0f, .yaw_deg = 35.0f, .pitch_deg = 18.0f},
       .frames = {0, 100, 250},
       .world = {},
       .make = [] { return std::unique_ptr<Scene>(new Arm()); }},
  };
}

}  // namespace samples

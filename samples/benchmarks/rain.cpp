// Ragdolls that rain onto a field of meshes: 300 figures of 14 bones on 100 cells of ground with a ring each.
#include <array>

#include "pfx/base_level/math/trig.h"
#include "pfx/util/mesh_builder/mesh_builder.h"
#include "samples/benchmarks/scenes.h"
#include "samples/shared/builders.h"

namespace samples::benchmarks {
namespace {

using namespace pfx;

struct Bone {
  const char* name;
  int parent;  // -1: the root
  Vec3 at;     // m, of its middle from that of the pelvis
  float half_length, radius;
  bool upright;  // along Y, otherwise along X
  bool hinge;    // about X, otherwise a cone about Y
  Vec3 joint;    // m, from the middle of the pelvis
  float low, high, cone;  // rad: of the hinge or the twist; of the swing
};

// A figure of 1.75 m that faces +Z, its arms hanging down.
std::vector<Bone> makeBones() {
  const float turn = 0.26f;
  std::vector<Bone> bones = {
      {"pelvis", -1, {0, 0, 0}, 0.07f, 0.13f, false, false, {0, 0, 0}, 0, 0, 0},
      {"loin", 0, {0, 0.16f, 0}, 0.06f, 0.12f, false, false, {0, 0.08f, 0}, -turn, turn, 0.44f},
      {"waist", 1, {0, 0.30f, 0}, 0.08f, 0.10f, false, false, {0, 0.23f, 0}, -turn, turn, 0.44f},
      {"chest", 2, {0, 0.46f, 0}, 0.11f, 0.145f, false, false, {0, 0.37f, 0}, -0.17f, 0.17f, 0.26f},
      {"neck", 3, {0, 0.67f, 0}, 0.03f, 0.07f, true, false, {0, 0.61f, 0}, -turn, turn, 0.78f},
      {"head", 4, {0, 0.80f, 0}, 0.035f, 0.0975f, true, false, {0, 0.72f, 0}, -turn, turn, 0.26f},
  };
  for (const float side : {1.0f, -1.0f}) {
    const int first = static_cast<int>(bones.size());
    const float leg = 0.10f * side, arm = 0.30f * side;
    bones.push_back({"thigh", 0, {leg, -0.27f, 0}, 0.2f, 0.09f, true, false, {leg, -0.05f, 0}, -0.5f, 0.5f, 0.9f});
    bones.push_back({"calf", first, {leg, -0.70f, 0}, 0.2f, 0.075f, true, true, {leg, -0.48f, 0}, 0.0f, 2.2f, 0});
    bones.push_back({"upper arm", 3, {arm, 0.42f, 0}, 0.12f, 0.07f, true, false, {arm, 0.56f, 0}, -0.5f, 0.5f, 1.2f});
    bones.push_back({"forearm", first + 2, {arm, 0.12f, 0}, 0.14f, 0.05f, true, true, {arm, 0.28f, 0}, -2.2f, 0.0f, 0});
  }
  return bones;
}

using Figure = std::array<BodyId, 14>;

// Every joint is drawn back to its rest pose at 1 Hz and has some friction of its own.
void limber(Joint& joint) {
  for (int i = 3; i < kNumJointAxes; ++i) {
    AxisConstraint& axis = joint.axis[i];
    if (axis.lock == JointLock::Fixed || (joint.cone && i == 5)) continue;
    axis.spring_frequency = 1.0f;
    axis.spring_damping = 0.7f;
    axis.motor_max_force = 5.0f;
  }
}

Figure addFigure(World& world, const Vec3& at) {
  static const std::vector<Bone> bones = makeBones();
  static const Quat upright = rotation(Vec3::UnitZ(), 0.5f * kPi);
  Figure figure;
  for (size_t i = 0; i < bones.size(); ++i) {
    const Bone& b = bones[i];
    const float r = b.radius, volume = kPi * r * r * (2.0f * b.half_length + 4.0f / 3.0f * r);
    figure[i] = world.addBody({.name = b.name,
                               .pose = {at + b.at, b.upright ? upright : Quat(Quat::Identity())},
                               .shapes = {shape(Capsule{b.half_length, r})},
                               .mass = 1000.0f * volume,
                               .restitution = 0.0f,
                               .rolling_resistance = 0.2f * r});
    if (b.parent < 0) continue;
    const BodyId parent = figure[static_cast<size_t>(b.parent)];
    JointParams params = SwingTwistJointParams{.anchor_point = at + b.joint,
                                               .twist_axis = Vec3::UnitY(),
                                               .twist_lower_angle = b.low,
                                               .twist_upper_angle = b.high,
                                               .swing_upper_angle = b.cone};
    if (b.hinge)
      params = HingeJointParams{
          .anchor_point = at + b.joint, .axis = Vec3::UnitX(), .lower_angle = b.low, .upper_angle = b.high};
    const JointId joint = world.addJoint({.name = b.name, .body_a = parent, .body_b = figure[i], .params = params});
    limber(world.joint(joint));
  }
  return figure;
}

LargeMesh makeGrid() {
  constexpr uint32_t kCells = 8;
  std::vector<Vec3> vertices;
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i <= kCells; ++i)
    for (uint32_t k = 0; k <= kCells; ++k) {
      vertices.emplace_back(1.875f * static_cast<float>(i) - 7.5f, 0.0f, 1.875f * static_cast<float>(k) - 7.5f);
      if (i == kCells || k == kCells) continue;
      const uint32_t a = i * (kCells + 1) + k, b = a + kCells + 1;
      indices.insert(indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  return buildLargeMesh(vertices, indices).mesh;
}

LargeMesh makeRing() {
  constexpr uint32_t kSides = 16;
  std::vector<Vec3> vertices;
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i < kSides; ++i)
    for (uint32_t k = 0; k < kSides; ++k) {
      const SinCos along = sincos(2.0f * kPi * static_cast<float>(i) / kSides);
      const SinCos across = sincos(2.0f * kPi * static_cast<float>(k) / kSides);
      const float r = 3.75f + across.cos;
      vertices.emplace_back(r * along.cos, r * along.sin, across.sin);
      const auto at = [](uint32_t a, uint32_t b) { return a % kSides * kSides + b % kSides; };
      indices.insert(indices.end(),
                     {at(i, k), at(i + 1, k), at(i, k + 1), at(i, k + 1), at(i + 1, k), at(i + 1, k + 1)});
    }
  return buildLargeMesh(vertices, indices).mesh;
}

class Rain final : public Scene {
 public:
  void build(World& world) override {
    const LargeMesh *grid = world.keep(makeGrid()), *ring = world.keep(makeRing());
    for (int row = 0; row < kCells; ++row)
      for (int column = 0; column < kCells; ++column)
        world.addBody({.name = "cell",
                       .pose = {.position = center(row, column)},
                       .motion_type = MotionType::Fixed,
                       .shapes = {shape(grid), shape(ring)},
                       .restitution = 0.0f});
  }

  // One column of cells at a time gets its thirty figures; those of the first columns are replaced later.
  void beforeStep(World& world, float) override {
    const uint64_t step = world.stepCount();
    constexpr std::array<uint64_t, 13> kTimes = {0, 16, 64, 80, 128, 144, 192, 208, 256, 272, 320, 336, 384};
    for (size_t n = 0; n < kTimes.size(); ++n)
      if (kTimes[n] == step) pour(world, static_cast<int>(n % kCells));
  }

 private:
  static constexpr int kCells = 10;

  static Vec3 center(int row, int column) {
    return {15.0f * (static_cast<float>(column) - 4.5f), 0.0f, 15.0f * (static_cast<float>(row) - 4.5f)};
  }

  void pour(World& world, int column) {
    std::vector<Figure>& figures = columns_[static_cast<size_t>(column)];
    for (const Figure& figure : figures)
      for (const BodyId bone : figure) world.removeBody(bone);
    figures.clear();
    for (int row = 0; row < kCells; ++row)
      for (int i = 0; i < 3; ++i)
        figures.push_back(addFigure(world, center(row, column) + Vec3(0.75f * static_cast<float>(i), 20.0f, 0.0f)));
  }

  std::array<std::vector<Figure>, kCells> columns_;
};

}  // namespace

Case rainCase() {
  return {.name = "rain",
          .shows = "300 ragdolls of 14 bones fall onto meshes, column by column",
          .make = [] { return std::unique_ptr<Scene>(std::make_unique<Rain>()); },
          .steps = 400,
          .starts_at_rest = false,
          .large = true,
          .world = {.gravity = Vec3(0.0f, -10.0f, 0.0f)},
          .camera = {.target = {-30.0f, 2.0f, 30.0f}, .distance = 75.0f, .yaw_deg = -30.0f, .pitch_deg = 18.0f},
          .frames = {110}};
}

}  // namespace samples::benchmarks

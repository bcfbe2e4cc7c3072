// The tutorial: what a program does with a World, in five scenes.
#include <algorithm>
#include <array>
#include <string>

#include "pfx/base_level/math/trig.h"
#include "samples/registry.h"
#include "samples/shared/builders.h"
#include "samples/shared/ragdoll.h"
#include "samples/tutorial/town.h"

namespace samples {
namespace {

using namespace pfx;

// Numbers that are the same everywhere. G. Marsaglia, Xorshift RNGs, Journal of Statistical Software 8(14),
// 2003.
class Random {
 public:
  uint32_t next() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return state_;
  }
  float between(float low, float high) {
    return low + (high - low) * static_cast<float>(next() >> 8) * 0x1p-24f;
  }

 private:
  uint32_t state_ = 1234;
};

Geometry primitive(uint32_t kind, float half) {
  switch (kind % 4) {
    case 0:
      return Sphere{half};
    case 1:
      return Box{Vec3::Constant(half)};
    case 2:
      return Capsule{half, 0.6f * half};
    default:
      return Cylinder{half, half};
  }
}

double asleepOf(const World& world) {
  double asleep = 0.0;
  for (const RigidState& s : world.states()) asleep += s.asleep;
  return asleep;
}

// Bodies come and go: every half second the oldest is removed, and its place is taken by a new one.
struct Primitives final : Scene {
  static constexpr uint32_t kBodies = 24;
  static constexpr uint64_t kEvery = 30;  // steps

  void build(World& world) override {
    addGround(world);
    const auto post = [&](float x, float z, float wide, float deep) {
      world.addBody({.name = "rim",
                     .pose = {.position = Vec3(x, 0.3f, z)},
                     .motion_type = MotionType::Fixed,
                     .shapes = {shape(Box{Vec3(wide, 0.3f, deep)})}});
    };
    for (const float side : {-1.0f, 1.0f})
      post(side * 5.2f, 0.0f, 0.2f, 5.4f), post(0.0f, side * 5.2f, 5.0f, 0.2f);
    for (uint32_t i = 0; i < kBodies; ++i)
      bodies_.push_back(drop(world, 3.0f + 1.3f * static_cast<float>(i / 4)));
  }

  void beforeStep(World& world, float) override {
    if (world.stepCount() % kEvery != kEvery - 1) return;
    world.removeBody(bodies_.front());
    bodies_.erase(bodies_.begin());
    bodies_.push_back(drop(world, 9.0f));
    ++replaced_;
  }

  std::vector<Reading> readings(const World& world) const override {
    double valid = 0.0;
    for (const BodyId id : bodies_) valid += world.isValid(id);
    return {{"bodies in the world", "", static_cast<double>(world.counts().bodies), 29.0},
            {"valid handles, of 24", "", valid},
            {"bodies replaced", "", static_cast<double>(replaced_)},
            {"places in the arrays", "", static_cast<double>(world.states().size()), 29.0}};
  }

 private:
  BodyId drop(World& world, float height) {
    const uint32_t kind = random_.next() >> 8;
    const float half = random_.between(0.45f, 0.8f), x = random_.between(-3.5f, 3.5f);
    const float z = random_.between(-3.5f, 3.5f);
    return addBody(world, "primitive", primitive(kind, half), Vec3(x, height, z), 2.0f);
  }

  std::vector<BodyId> bodies_;
  Random random_;
  uint32_t replaced_ = 0;
};

// The tower sleeps until a ball comes; what it does not reach is never woken.
struct Tower final : Scene {
  static constexpr uint64_t kThrow = 260;

  void build(World& world) override {
    addGround(world);
    addTower(world, {});
  }

  void beforeStep(World& world, float) override {
    if (world.stepCount() != kThrow) return;
    world.addBody({.name = "ball",
                   .pose = {.position = Vec3(-4.0f, 13.0f, 26.0f)},
                   .linear_velocity = Vec3(3.0f, 2.0f, -30.0f),
                   .shapes = {shape(Sphere{1.4f})},
                   .mass = 6.0f,
                   .angular_damping = 1.0f});
  }

  std::vector<Reading> readings(const World& world) const override {
    return {{"asleep, of 192", "", asleepOf(world)}, {"ms of the last step", "ms", lastStep(world)}};
  }

 private:
  static double lastStep(const World& world) {
    double sum = 0.0;
    for (const StageTime& t : world.stageTimes()) sum += t.milliseconds;
    return sum;
  }
};

// Ragdolls tumble down steps on four sides.
struct Ragdolls final : Scene {
  static constexpr int kSteps = 5;

  void build(World& world) override {
    addGround(world);
    for (int i = 0; i < kSteps; ++i) {
      const float half = 7.0f - 1.1f * static_cast<float>(i), y = 0.5f * static_cast<float>(i);
      world.addBody({.name = "step " + std::to_string(i),
                     .pose = {.position = Vec3(0.0f, y + 0.25f, 0.0f)},
                     .motion_type = MotionType::Fixed,
                     .shapes = {shape(Box{Vec3(half, 0.25f, half)})}});
    }
    for (int i = 0; i < 5; ++i) {
      const float turn = 2.0f * kPi / 5.0f * static_cast<float>(i);
      const SinCos place = sincos(turn);
      dolls_.push_back(addRagdoll(
          world, "ragdoll " + std::to_string(i),
          {.position = Vec3(2.6f * place.sin, 5.0f + 0.7f * static_cast<float>(i), 2.6f * place.cos),
           .orientation = rotation(Vec3::UnitY(), turn) * rotation(Vec3::UnitX(), 0.5f)}));
    }
  }

  std::vector<Reading> readings(const World& world) const override {
    double error = 0.0, lowest = 1e9;
    for (uint32_t i = 0; i < world.joints().size(); ++i)
      error = std::max(error, double(world.jointError(i).distance));
    for (const Ragdoll& doll : dolls_)
      for (const BodyId id : doll.bodies)
        lowest = std::min(lowest, double(world.states()[id.index].position.y()));
    return {{"largest joint error", "mm", 1e3 * error, 50.0}, {"lowest part above the ground", "m", lowest}};
  }

 private:
  std::vector<Ragdoll> dolls_;
};

// The town as one mesh, and 108 bodies that rain on it. With rays: a column that turns above the fountain.
struct TownScene : Scene {
  void build(World& world) override {
    const LargeMesh* mesh = world.keep(makeTownMesh(town_));
    town_body_ = world.addBody({.name = "town", .motion_type = MotionType::Fixed, .shapes = {shape(mesh)}});
    Random random;
    for (int y = 0; y < 3; ++y)
      for (int i = 0; i < 36; ++i) {
        const uint32_t kind = random.next() >> 8;
        const float x = 3.4f * (static_cast<float>(i % 6) - 2.5f) + random.between(-0.6f, 0.6f);
        const float z = 3.4f * (static_cast<float>(i / 6) - 2.5f) + random.between(-0.6f, 0.6f);
        addBody(world, "primitive", primitive(kind, 0.5f), Vec3(x, 10.0f + 2.5f * static_cast<float>(y), z),
                1.0f);
      }
  }

  void draw(const World&, Canvas& canvas) const override { painter_.draw(canvas); }

  std::vector<Reading> readings(const World& world) const override {
    double below = 0.0;
    for (const RigidState& s : world.states())
      below += isDynamic(s.motion_type) && s.position.y() < townGround(s.position.x(), s.position.z());
    return {{"triangles of the town", "", static_cast<double>(town_.numTriangles())},
            {"bodies below the ground", "", below},
            {"asleep, of 108", "", asleepOf(world)}};
  }

 protected:
  Town town_ = makeTown();
  TownPainter painter_{town_};
  BodyId town_body_;
};

struct TownRays final : TownScene {
  static constexpr int kRays = 50;
  static constexpr float kArea = 8.1f, kHeight = 6.0f;  // m
  static constexpr float kTurnPerStep = 0.02f;          // rad

  void build(World& world) override {
    TownScene::build(world);
    column_ = world.addBody({.name = "column",
                             .pose = pose(),
                             .motion_type = MotionType::Keyframe,
                             .shapes = {shape(Cylinder{0.5f, 0.45f})}});
  }

  void beforeStep(World& world, float dt) override {
    angle_ += kTurnPerStep;
    world.moveKeyframe(column_, pose(), dt);
  }

  void afterStep(World& world, float) override {
    inside_.clear();
    world.findOverlaps({.geometry = area_, .pose = {.position = center()}}, inside_);
    for (int i = 0; i < kRays; ++i) rays_[static_cast<size_t>(i)] = ray(i);
    world.castRays(rays_, hits_);
  }

  void draw(const World& world, Canvas& canvas) const override {
    TownScene::draw(world, canvas);
    if (world.stepCount() == 0) return;
    for (size_t i = 0; i < kRays; ++i) {
      const RayInput& r = rays_[i];
      const RayOutput& hit = hits_[i];
      const Vec3 end = hit.hit ? hit.point : Vec3(r.start + r.direction);
      const Color color = !hit.hit ? 0xffb0b6bdu : hit.body == town_body_.index ? 0xff3f86b8u : 0xffd64545u;
      canvas.line(r.start, end, {.color = color, .width = 1.2f});
      if (!hit.hit) continue;
      canvas.point(hit.point, {.color = color, .width = 6.0f});
      canvas.arrow(hit.point, hit.point + 0.6f * hit.normal, {.color = color, .width = 1.5f});
    }
  }

  std::vector<Reading> readings(const World& world) const override {
    double hits = 0.0, on_bodies = 0.0, outside = 0.0;
    for (const RayOutput& hit : hits_) {
      if (!hit.hit) continue;
      hits += 1.0;
      on_bodies += hit.body != town_body_.index;
      outside += !std::binary_search(inside_.begin(), inside_.end(), hit.body);
    }
    std::vector<Reading> all = TownScene::readings(world);
    all.push_back({"rays that hit, of 50", "", hits});
    all.push_back({"rays that hit a body", "", on_bodies});
    all.push_back({"hits outside of the area", "", outside});
    return all;
  }

 private:
  static Vec3 center() { return Vec3(0.0f, kHeight, 0.0f); }
  Transform pose() const {
    return {center(), rotation(Vec3::UnitY(), angle_) * rotation(Vec3::UnitZ(), 0.5f * kPi)};
  }

  // Spirals of rays round the column, downwards, each as long as the area allows.
  RayInput ray(int i) const {
    const SinCos turn =
        sincos(angle_ + 2.0f * kPi / 10.0f * static_cast<float>(i % 10) + 0.2f * static_cast<float>(i / 10));
    const SinCos down = sincos(0.3f + 0.22f * static_cast<float>(i / 10));
    const Vec3 along(down.cos * turn.cos, -down.sin, down.cos * turn.sin);
    const float length = kArea / along.cwiseAbs().maxCoeff();
    return {.start = center() + 0.5f * Vec3(turn.cos, 0.0f, turn.sin), .direction = 0.93f * length * along};
  }

  Geometry area_ = Box{Vec3::Constant(kArea)};
  BodyId column_;
  float angle_ = 0.0f;
  std::vector<uint32_t> inside_;
  std::array<RayInput, kRays> rays_;
  std::array<RayOutput, kRays> hits_;
};

template <class T>
std::unique_ptr<Scene> make() {
  return std::make_unique<T>();
}

}  // namespace

std::vector<SceneEntry> tutorialScenes() {
  const std::string_view sample = "tutorial";
  const WorldDef sleeping{.sleeping = true};
  const WorldDef town{.sleeping = true, .extent = Vec3(250.0f, 100.0f, 250.0f)};
  const CameraPose over_town{
      .target = Vec3(0.0f, 3.6f, -4.0f), .distance = 50.0f, .yaw_deg = 22.0f, .pitch_deg = 30.0f};
  return {
      {.sample = sample,
       .name = "primitives",
       .shows = "bodies are added and removed while the world runs: places are used again, old handles die",
       .camera = {.target = Vec3(0.0f, 3.4f, 0.0f), .distance = 23.0f, .yaw_deg = 30.0f, .pitch_deg = 22.0f},
       .frames = {40, 150, 600},
       .world = sleeping,
       .make = make<Primitives>},
      {.sample = sample,
       .name = "tower",
       .shows = "one call a step: the tower sleeps (grey), and a ball wakes the island that it hits",
       .camera = {.target = Vec3(0.0f, 6.5f, 0.0f), .distance = 44.0f, .yaw_deg = 40.0f, .pitch_deg = 24.0f},
       .frames = {60, 259, 330},
       .world = sleeping,
       .make = make<Tower>},
      {.sample = sample,
       .name = "ragdolls",
       .shows = "five ragdolls of eleven bodies and ten joints tumble down the steps and come to rest",
       .camera = {.target = Vec3(0.0f, 2.0f, 0.0f), .distance = 21.0f, .yaw_deg = 30.0f, .pitch_deg = 24.0f},
       .frames = {20, 75, 400},
       .world = sleeping,
       .make = make<Ragdolls>},
      {.sample = sample,
       .name = "town",
       .shows = "108 bodies rain on a town that is one mesh of two thousand triangles; none falls through",
       .camera = over_town,
       .frames = {0, 110, 600},
       .world = town,
       .make = make<TownScene>},
      {.sample = sample,
       .name = "town_rays",
       .shows = "fifty rays turn above the fountain, within a box of 8.1 m: blue hits are the town, red ones "
                "bodies",
       .camera = {.target = Vec3(0.0f, 2.4f, -0.5f), .distance = 25.0f, .yaw_deg = 12.0f, .pitch_deg = 30.0f},
       .frames = {90, 150, 420},
       .world = town,
       .make = make<TownRays>}};
}

}  // namespace samples

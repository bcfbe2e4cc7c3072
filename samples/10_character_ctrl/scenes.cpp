// Sample 10_character_ctrl: characters on a course, on slopes and steps, and in a crowd.
#include <algorithm>
#include <cmath>

#include "pfx/base_level/math/trig.h"
#include "samples/10_character_ctrl/course.h"
#include "samples/10_character_ctrl/troupe.h"
#include "samples/registry.h"
#include "samples/shared/builders.h"

namespace samples {
namespace {

using namespace pfx;

constexpr Outfit kBlue{}, kGreen{0xff6d9a5fu, 0xff2f3d2au}, kRed{0xffb8574eu, 0xff3a2523u},
    kViolet{0xff7d6aa8u, 0xff2c2740u}, kYellow{0xffd9ab45u, 0xff4a3a1bu};
constexpr std::array kOutfits = {kBlue, kGreen, kRed, kViolet, kYellow};

// Follows a list of legs, over and over.
class Guide {
 public:
  explicit Guide(std::span<const Leg> way) : way_(way) {}

  CharacterInput next(const Vec3& feet, float platform_x, float dt) {
    if (ended(feet, platform_x)) leg_ = (leg_ + 1) % way_.size(), time_ = 0.0f;
    time_ += dt;
    const Leg& leg = way_[leg_];
    return {.direction = leg.speed * directionTo(feet, leg.to),
            .run = leg.run,
            .jump = leg.jump && time_ < 0.2f,
            .crouch = leg.crouch};
  }

 private:
  bool ended(const Vec3& feet, float platform_x) const {
    const Leg& leg = way_[leg_];
    if (time_ >= leg.seconds) return true;
    switch (leg.until) {
      case Leg::Until::There:
        return Vec3(feet.x() - leg.to.x(), 0.0f, feet.z() - leg.to.z()).norm() < 0.15f;
      case Leg::Until::PlatformNear:
        return platform_x < -0.4f;
      case Leg::Until::PlatformFar:
        return platform_x > 2.2f;
      case Leg::Until::Time:
        return false;
    }
    return false;
  }

  std::span<const Leg> way_;
  size_t leg_ = 0;
  float time_ = 0.0f;  // s, in this leg
};

struct CourseScene final : Scene {
  enum Who { Hero, Walker, Rider, Shoved };

  void build(World& world) override {
    course_ = addCourse(world);
    troupe_.add(world, {.name = "hero", .feet = kHeroStart, .heading = 0.5f * kPi, .params = params_}, kBlue);
    troupe_.add(world, {.name = "walker", .feet = kWalkerStart, .heading = -0.5f * kPi}, kGreen);
    troupe_.add(world, {.name = "rider", .feet = kTurntableAt + Vec3(0.8f, 0.1f, 0.0f)}, kYellow);
    troupe_.add(world, {.name = "shoved", .feet = kShovedStart}, kRed);
    trail_.reserve(kTrail);
  }

  void beforeStep(World& world, float dt) override {
    time_ += dt;
    world.moveKeyframe(course_.platform, course_.platformPose(time_), dt);
    world.moveKeyframe(course_.bar, course_.barPose(time_), dt);
    world.moveKeyframe(course_.turntable, course_.turntablePose(time_), dt);
    const float platform_x = world.states()[course_.platform.index].position.x();
    const auto feet = [&](Who who) { return feetOf(troupe_[who], world); };
    troupe_.input(Hero) = is_controlled_ ? controlled_ : hero_.next(feet(Hero), platform_x, dt);
    troupe_.input(Walker) = walker_.next(feet(Walker), platform_x, dt);
    troupe_.input(Shoved) = {.direction = 0.6f * directionTo(feet(Shoved), kShovedStart)};
    for (Character& c : troupe_.characters()) c.params = params_;
    troupe_.beforeStep(world, dt);
  }

  void afterStep(World& world, float dt) override {
    troupe_.afterStep(world, dt);
    const Vec3 feet = feetOf(troupe_[Hero], world);
    const bool taken_off = troupe_[Hero].state == CharacterState::Jump;
    if (taken_off && !was_jumping_) take_off_ = last_feet_.y(), jump_height_ = 0.0f;
    if (taken_off) jump_height_ = std::max(jump_height_, feet.y() - take_off_);
    was_jumping_ = taken_off;
    last_feet_ = feet;
    measureRide(world);
    if (world.stepCount() % 4 != 0) return;
    if (trail_.size() == kTrail) trail_.erase(trail_.begin());
    trail_.push_back(feet + Vec3(0.0f, 0.04f, 0.0f));
  }

  void draw(const World& world, Canvas& canvas) const override {
    drawTrack(canvas);
    for (size_t i = 1; i < trail_.size(); ++i)
      canvas.line(trail_[i - 1], trail_[i], {.color = 0xff3f7f93u, .width = 2.0f});
    troupe_.draw(world, canvas);
  }

  uint64_t stateHash() const override { return troupe_.stateHash(); }

  std::vector<Parameter> parameters() override {
    CharacterParams& p = params_;
    return {{"walking speed", "m/s", &p.walk_speed, 0.5f, 3.0f},
            {"running speed", "m/s", &p.run_speed, 2.0f, 8.0f},
            {"height of a jump", "m", &p.jump_height, 0.2f, 2.0f},
            {"highest step", "m", &p.step_height, 0.05f, 0.45f},
            {"steepest slope", "rad", &p.max_slope, 0.2f, 1.4f},
            {"force while pushing", "N", &p.push_force, 50.0f, 2000.0f}};
  }

  std::vector<Reading> readings(const World& world) const override {
    (void)world;
    return {{"states reached, of 11", "", static_cast<double>(troupe_.statesReached())},
            {"rider's drift on the turntable", "mm", 1e3 * static_cast<double>(drift_), 1.0},
            {"overlap of two characters", "mm", 1e3 * static_cast<double>(troupe_.deepestOverlap()), 20.0},
            {"height of the last jump", "m", static_cast<double>(jump_height_)},
            {"v^2 / 2g of a jump", "m", static_cast<double>(params_.jump_height)}};
  }

  bool isControlled() const override { return true; }
  void control(const Controls& controls) override {
    is_controlled_ = true;
    controlled_ = inputOf(controls);
  }

 private:
  static constexpr size_t kTrail = 160;

  // A painted lane under the parts of the way that lie on the ground.
  static void drawTrack(Canvas& canvas) {
    struct Lane {
      float x0, z0, x1, z1;
    };
    constexpr Lane kLanes[] = {{-8.4f, 3.1f, -6.0f, 4.9f},   {3.3f, -0.6f, 5.1f, 1.95f},
                               {-2.3f, -0.9f, 3.3f, 0.9f},   {-2.3f, -2.9f, -0.5f, -0.9f},
                               {-0.5f, -2.9f, 7.1f, -1.1f},  {5.3f, -4.9f, 7.1f, -2.9f},
                               {-6.4f, -4.9f, 5.3f, -3.1f},  {-5.5f, -3.1f, -3.7f, 0.55f},
                               {-8.4f, 0.55f, -3.1f, 2.35f}, {-8.4f, 2.35f, -6.6f, 3.1f}};
    for (const Lane& lane : kLanes) {
      const Vec3 center(0.5f * (lane.x0 + lane.x1), 0.0f, 0.5f * (lane.z0 + lane.z1));
      const Vec3 half(0.5f * (lane.x1 - lane.x0), 0.006f, 0.5f * (lane.z1 - lane.z0));
      canvas.solid(Box{half}, {center, Quat::Identity()}, {0xffc98f6eu, Finish::Matte});
    }
  }

  void measureRide(const World& world) {
    const Vec3 at =
        world.states()[course_.turntable.index].pose().applyInverse(feetOf(troupe_[Rider], world));
    if (world.stepCount() == 30) ride_start_ = at;
    if (world.stepCount() > 30) drift_ = std::max(drift_, (at - ride_start_).norm());
  }

  Course course_;
  Troupe troupe_;
  CharacterParams params_;
  Guide hero_{heroWay()}, walker_{walkerWay()};
  std::vector<Vec3> trail_;
  CharacterInput controlled_;
  Vec3 ride_start_ = Vec3::Zero(), last_feet_ = kHeroStart;
  float time_ = 0.0f, drift_ = 0.0f, take_off_ = 0.0f, jump_height_ = 0.0f;
  bool is_controlled_ = false, was_jumping_ = false;
};

// Lanes side by side: slopes of 15 to 60 degrees and steps of 0.1 to 0.4 m. All walk up; two are refused.
struct SlopesAndSteps final : Scene {
  static constexpr std::array kDegrees = {15.0f, 30.0f, 45.0f, 60.0f};
  static constexpr std::array kSteps = {0.1f, 0.2f, 0.3f, 0.4f};
  static constexpr float kLane = 2.0f, kTop = 2.4f, kFoot = 0.0f;

  void build(World& world) override {
    addGround(world);
    for (size_t i = 0; i < kDegrees.size(); ++i) addRamp(world, laneOf(i), kDegrees[i] * kPi / 180.0f);
    for (size_t i = 0; i < kSteps.size(); ++i) addFlight(world, laneOf(kDegrees.size() + i), kSteps[i]);
    for (size_t i = 0; i < kDegrees.size() + kSteps.size(); ++i)
      troupe_.add(
          world,
          {.name = "climber " + std::to_string(i), .feet = Vec3(laneOf(i), 0.0f, 2.2f), .heading = kPi},
          kOutfits[i % kOutfits.size()]);
  }

  void beforeStep(World& world, float dt) override {
    for (size_t i = 0; i < troupe_.size(); ++i) {
      troupe_.input(i) = {.direction = directionTo(feetOf(troupe_[i], world), Vec3(laneOf(i), 0.0f, -11.5f)),
                          .run = runs_ > 0.5f};
    }
    troupe_.beforeStep(world, dt);
  }

  void afterStep(World& world, float dt) override {
    troupe_.afterStep(world, dt);
    for (const size_t refused : {size_t{3}, size_t{7}})
      refused_climb_ = std::max(refused_climb_, feetOf(troupe_[refused], world).y());
    const Vec3 v = world.states()[troupe_[1].body.index].linear_velocity;
    const float height = feetOf(troupe_[1], world).y();
    if (height > 0.5f && height < 1.8f) slope_speed_ = v.norm();
  }

  void draw(const World& world, Canvas& canvas) const override {
    troupe_.draw(world, canvas);
    for (size_t i = 0; i < kDegrees.size(); ++i)
      canvas.label(Vec3(laneOf(i), 0.25f, 1.2f), std::to_string(static_cast<int>(kDegrees[i])) + " deg");
    for (size_t i = 0; i < kSteps.size(); ++i)
      canvas.label(Vec3(laneOf(4 + i), 0.25f, 1.2f),
                   std::to_string(static_cast<int>(std::lround(100.0f * kSteps[i]))) + " cm");
  }

  uint64_t stateHash() const override { return troupe_.stateHash(); }
  std::vector<Parameter> parameters() override { return {{"run (1) or walk (0)", "", &runs_, 0.0f, 1.0f}}; }
  std::vector<Reading> readings(const World&) const override {
    return {{"climb of the two that are refused", "mm", 1e3 * static_cast<double>(refused_climb_), 10.0},
            {"speed along the slope of 30 degrees", "m/s", static_cast<double>(slope_speed_)}};
  }

 private:
  static float laneOf(size_t i) { return kLane * (static_cast<float>(i) - 3.5f); }

  static void addDeck(World& world, float x, float z) {
    world.addBody({.name = "deck",
                   .pose = {.position = Vec3(x, 0.5f * kTop, 0.5f * (z - 12.0f))},
                   .motion_type = MotionType::Fixed,
                   .shapes = {shape(Box{Vec3(0.46f * kLane, 0.5f * kTop, 0.5f * (z + 12.0f))})}});
  }

  static void addRamp(World& world, float x, float angle) {
    const float half = 0.5f * kTop / sin(angle), thick = 0.15f;
    const Quat turn = rotation(Vec3::UnitX(), angle);
    const Vec3 up = turn * Vec3::UnitY(), along = turn * Vec3::UnitZ();
    world.addBody({.name = "ramp",
                   .pose = {Vec3(x, 0.0f, kFoot) - half * along - thick * up, turn},
                   .motion_type = MotionType::Fixed,
                   .shapes = {shape(Box{Vec3(0.46f * kLane, thick, half)})}});
    addDeck(world, x, kFoot - kTop / tan(angle));
  }

  static void addFlight(World& world, float x, float height) {
    const int count = static_cast<int>(std::lround(kTop / height));
    const float depth = std::max(0.3f, height);
    for (int i = 0; i + 1 < count; ++i) {
      const float y = height * static_cast<float>(i + 1), z = kFoot - depth * (static_cast<float>(i) + 0.5f);
      world.addBody({.name = "step",
                     .pose = {.position = Vec3(x, 0.5f * y, z)},
                     .motion_type = MotionType::Fixed,
                     .shapes = {shape(Box{Vec3(0.46f * kLane, 0.5f * y, 0.5f * depth)})}});
    }
    addDeck(world, x, kFoot - depth * static_cast<float>(count - 1));
  }

  Troupe troupe_;
  float runs_ = 0.0f, refused_climb_ = 0.0f, slope_speed_ = 0.0f;
};

// A ring of characters, each of which wants to the far side, with boxes in the middle that they shove about.
struct Crowd final : Scene {
  static constexpr int kPeople = 16;
  static constexpr float kRing = 7.0f;

  void build(World& world) override {
    addGround(world);
    for (int i = 0; i < 7; ++i) {
      const SinCos turn = sincos(2.0f * kPi / 6.0f * static_cast<float>(i));
      const float radius = i < 6 ? 1.6f : 0.0f;
      world.addBody({.name = "box " + std::to_string(i),
                     .pose = {.position = Vec3(radius * turn.cos, 0.4f, radius * turn.sin)},
                     .shapes = {shape(Box{Vec3::Constant(0.4f)})},
                     .mass = 15.0f});
    }
    for (int i = 0; i < kPeople; ++i)
      troupe_.add(world,
                  {.name = "walker " + std::to_string(i), .feet = place(i, 0.0f), .heading = headingOf(i)},
                  kOutfits[static_cast<size_t>(i) % kOutfits.size()]);
  }

  void beforeStep(World& world, float dt) override {
    time_ += dt;
    const bool back = static_cast<int>(time_ / kTurn) % 2 == 1;
    for (int i = 0; i < kPeople; ++i) {
      const auto k = static_cast<size_t>(i);
      const Vec3 feet = feetOf(troupe_[k], world), goal = place(i, back ? 0.0f : kPi);
      // All keep a little to the right, or nobody would get past the middle.
      const Vec3 ahead = directionTo(feet, goal);
      const float aside = std::min(0.05f * (goal - feet).norm(), 0.35f);
      troupe_.input(k) = {.direction = ahead + aside * Vec3(-ahead.z(), 0.0f, ahead.x()),
                          .run = i % 4 == 0,
                          .crouch = i % 8 == 3};
    }
    troupe_.beforeStep(world, dt);
  }
  void afterStep(World& world, float dt) override { troupe_.afterStep(world, dt); }
  void draw(const World& world, Canvas& canvas) const override { troupe_.draw(world, canvas, kUnnamed); }
  uint64_t stateHash() const override { return troupe_.stateHash(); }

  std::vector<Reading> readings(const World& world) const override {
    int arrived = 0;
    for (int i = 0; i < kPeople; ++i)
      arrived += (feetOf(troupe_[static_cast<size_t>(i)], world) - place(i, kPi)).norm() < 0.5f;
    return {{"overlap of two characters", "mm", 1e3 * static_cast<double>(troupe_.deepestOverlap()), 20.0},
            {"on the far side, of 16", "", static_cast<double>(arrived)}};
  }

 private:
  static constexpr bool kUnnamed = false;  // sixteen labels hide what they name
  static constexpr float kTurn = 14.0f;    // s, until they want back

  static float angleOf(int i) { return 2.0f * kPi / static_cast<float>(kPeople) * static_cast<float>(i); }
  static float headingOf(int i) { return -0.5f * kPi - angleOf(i); }
  static Vec3 place(int i, float turn) {
    const SinCos at = sincos(angleOf(i) + turn);
    return kRing * Vec3(at.cos, 0.0f, at.sin);
  }

  Troupe troupe_;
  float time_ = 0.0f;
};

template <class T>
std::unique_ptr<Scene> make() {
  return std::make_unique<T>();
}

}  // namespace

std::vector<SceneEntry> characterScenes() {
  const std::string_view sample = "10_character_ctrl";
  return {
      {.sample = sample,
       .name = "course",
       .shows =
           "stairs, a moving platform, a chute too steep to climb, hurdle, tunnel, crate: the label is the "
           "state; arrows, Shift, Space and Ctrl take over",
       .camera =
           {.target = Vec3(-0.6f, 0.3f, 0.2f), .distance = 15.5f, .yaw_deg = 200.0f, .pitch_deg = 32.0f},
       .frames = {240, 640, 1612},
       .world = {},
       .make = make<CourseScene>},
      {.sample = sample,
       .name = "slopes_and_steps",
       .shows = "slopes to 45 degrees and steps to 30 cm are climbed; 60 degrees and 40 cm are refused",
       .camera =
           {.target = Vec3(0.0f, 1.0f, -2.2f), .distance = 16.0f, .yaw_deg = -12.0f, .pitch_deg = 23.0f},
       .frames = {60, 210, 480},
       .world = {},
       .make = make<SlopesAndSteps>},
      {.sample = sample,
       .name = "crowd",
       .shows = "sixteen characters cross at one place and shove boxes and each other; nobody overlaps",
       .camera = {.target = Vec3(0.0f, 0.6f, 0.0f), .distance = 17.0f, .yaw_deg = 20.0f, .pitch_deg = 30.0f},
       .frames = {60, 240, 600},
       .world = {},
       .make = make<Crowd>}};
}

}  // namespace samples

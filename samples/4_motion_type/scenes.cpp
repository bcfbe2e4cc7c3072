// Sample 4_motion_type: what moves whom.
#include <algorithm>
#include <string>

#include "pfx/base_level/math/trig.h"
#include "samples/registry.h"
#include "samples/shared/builders.h"
#include "samples/shared/drift.h"

namespace samples {
namespace {

using namespace pfx;

// A bar turned from outside sweeps through a wall. It never deviates, whatever it hits.
struct Keyframe final : Scene {
  void build(World& world) override {
    addGround(world);
    bar_ = world.addBody({.name = "bar",
                          .pose = pose(),
                          .motion_type = MotionType::Keyframe,
                          .shapes = {shape(Box{Vec3(5.0f, 0.25f, 0.5f)})}});
    const auto first = static_cast<uint32_t>(world.states().size());
    addWall(world, Vec3(-3.0f, 0.0f, 0.0f), {.rows = 5});
    wall_ = Drift(world, first);
  }

  void beforeStep(World& world, float dt) override {
    angle_ += turn_per_step_;
    world.moveKeyframe(bar_, pose(), dt);
  }

  std::vector<Parameter> parameters() override {
    return {{"turn of the bar a step", "rad", &turn_per_step_, -0.05f, 0.05f}};
  }
  std::vector<Reading> readings(const World& world) const override {
    const Transform now = world.states()[bar_.index].pose(), told = pose();
    const double off = (now.apply(Vec3(5.0f, 0.0f, 0.0f)) - told.apply(Vec3(5.0f, 0.0f, 0.0f))).norm();
    return {{"bar off its path", "mm", 1e3 * off, 1.0},
            {"farthest box of the wall", "m", static_cast<double>(wall_.largest(world))}};
  }

 private:
  Transform pose() const { return {Vec3(0.0f, 2.0f, 0.0f), rotation(Vec3::UnitY(), angle_)}; }

  BodyId bar_;
  Drift wall_;
  float angle_ = 0.5f * kPi, turn_per_step_ = 0.02f;
};

// Two equal bars fall from the level into two equal walls. Only the active one moves its wall.
struct OneWay final : Scene {
  static constexpr float kHalfLength = 4.5f, kHinge = 9.8f, kLane = 4.0f;

  void build(World& world) override {
    const BodyId ground = addGround(world);
    for (const bool one_way : {true, false}) {
      const float z = one_way ? -kLane : kLane;
      const Vec3 hinge(0.0f, kHinge, z);
      const BodyId bar = world.addBody({.name = one_way ? "one-way bar" : "active bar",
                                        .pose = {.position = hinge - Vec3(kHalfLength, 0.0f, 0.0f)},
                                        .motion_type = one_way ? MotionType::OneWay : MotionType::Active,
                                        .shapes = {shape(Box{Vec3(kHalfLength, 0.25f, 0.25f)})},
                                        .mass = mass_});
      world.addJoint({.name = one_way ? "one-way hinge" : "active hinge",
                      .body_a = ground,
                      .body_b = bar,
                      .params = BallJointParams{.anchor_point = hinge, .damping = 0.002f}});
      const auto first = static_cast<uint32_t>(world.states().size());
      addWall(world, Vec3(0.0f, 0.0f, z), {.rows = 5});
      walls_[one_way] = Drift(world, first);
      bars_[one_way] = bar;
    }
  }

  void draw(const World& world, Canvas& canvas) const override {
    for (const bool one_way : {true, false}) {
      const Transform bar = world.states()[bars_[one_way].index].pose();
      canvas.point(bar.apply(Vec3(kHalfLength, 0.0f, 0.0f)), {.width = 9.0f});
      canvas.label(bar.apply(Vec3(kHalfLength, 0.0f, 0.0f)) + Vec3(0.0f, 0.7f, 0.0f),
                   one_way ? "OneWay" : "Active");
    }
  }

  std::vector<Parameter> parameters() override {
    return {{"mass of a bar", "kg", &mass_, 1.0f, 100.0f, Parameter::Takes::OnRestart}};
  }
  std::vector<Reading> readings(const World& world) const override {
    return {{"wall of the one-way bar moved", "m", static_cast<double>(walls_[true].largest(world)), 0.01},
            {"wall of the active bar moved", "m", static_cast<double>(walls_[false].largest(world))}};
  }

 private:
  BodyId bars_[2];
  Drift walls_[2];
  float mass_ = 15.0f;
};

// Two boxes on arms swing through a wall that only notices them.
struct Trigger final : Scene {
  static constexpr float kArm = 6.0f, kHinge = 7.2f, kLane = 2.2f;

  void build(World& world) override {
    const BodyId ground = addGround(world);
    trigger_ = world.addBody({.name = "trigger",
                              .pose = {.position = Vec3(0.0f, 4.0f, 0.0f)},
                              .motion_type = MotionType::Trigger,
                              .shapes = {shape(Box{Vec3(0.5f, 4.0f, 5.0f)})}});
    for (const bool one_way : {true, false}) {
      const Vec3 hinge(0.0f, kHinge, one_way ? -kLane : kLane);
      const float side = one_way ? -1.0f : 1.0f;
      const BodyId box = world.addBody({.name = one_way ? "one-way box" : "active box",
                                        .pose = {.position = hinge + Vec3(side * kArm, 0.0f, 0.0f)},
                                        .motion_type = one_way ? MotionType::OneWay : MotionType::Active,
                                        .shapes = {shape(Box{Vec3::Constant(0.5f)})},
                                        .mass = 15.0f});
      world.addJoint({.name = one_way ? "one-way arm" : "active arm",
                      .body_a = ground,
                      .body_b = box,
                      .params = BallJointParams{.anchor_point = hinge}});
      boxes_[one_way] = box;
    }
  }

  void afterStep(World& world, float) override {
    for (const bool one_way : {true, false}) {
      const bool inside = finds(world, boxes_[one_way].index) > 0;
      passages_[one_way] += inside && !was_inside_[one_way];
      was_inside_[one_way] = inside;
    }
  }

  void draw(const World& world, Canvas& canvas) const override {
    for (const bool one_way : {true, false}) {
      const RigidState& box = world.states()[boxes_[one_way].index];
      const Vec3 hinge(0.0f, kHinge, one_way ? -kLane : kLane);
      canvas.line(hinge, box.position, {.width = 2.5f});
      canvas.point(hinge, {.width = 8.0f});
      const int points = finds(world, boxes_[one_way].index);
      std::string text = one_way ? "OneWay" : "Active";
      if (points > 0) text = "Find Contact " + std::to_string(boxes_[one_way].index) + " (" + text + ")";
      canvas.label(box.position + Vec3(0.0f, 0.95f, 0.0f), text);
    }
    for (const Pair& pair : world.contactPairs()) {
      if (pair.body_a != trigger_.index && pair.body_b != trigger_.index) continue;
      const Transform a = world.states()[pair.body_a].pose();
      for (const ContactManifold& m : world.manifolds(pair))
        for (int i = 0; i < m.num_points; ++i)
          canvas.point(a.apply(m.points[i].local_a), {.color = 0xffd64545u, .width = 9.0f});
    }
  }

  std::vector<Reading> readings(const World& world) const override {
    return {{"contact points of the active box", "", static_cast<double>(finds(world, boxes_[false].index))},
            {"contact points of the one-way box", "", static_cast<double>(finds(world, boxes_[true].index))},
            {"passages of the active box", "", static_cast<double>(passages_[false])},
            {"passages of the one-way box", "", static_cast<double>(passages_[true])}};
  }

 private:
  // Contact points of the trigger with a body.
  int finds(const World& world, uint32_t body) const {
    int points = 0;
    for (const Pair& pair : world.contactPairs()) {
      if (std::minmax(pair.body_a, pair.body_b) != std::minmax(trigger_.index, body)) continue;
      for (const ContactManifold& m : world.manifolds(pair)) points += m.num_points;
    }
    return points;
  }

  BodyId trigger_;
  BodyId boxes_[2];
  int passages_[2] = {0, 0};
  bool was_inside_[2] = {false, false};
};

template <class T>
std::unique_ptr<Scene> make() {
  return std::make_unique<T>();
}

}  // namespace

std::vector<SceneEntry> motionTypeScenes() {
  const std::string_view sample = "4_motion_type";
  return {
      {.sample = sample,
       .name = "keyframe",
       .shows = "a bar that is turned from outside sweeps a wall away and never deviates",
       .camera = {.target = Vec3(0.0f, 1.5f, 0.0f), .distance = 19.0f, .yaw_deg = 40.0f, .pitch_deg = 28.0f},
       .frames = {0, 90, 240},
       .world = {},
       .make = make<Keyframe>},
      {.sample = sample,
       .name = "one_way",
       .shows =
           "two equal bars fall into two equal walls: the one-way bar is stopped by its wall and does not "
           "move it, the active one knocks its wall over",
       .camera = {.target = Vec3(0.0f, 4.2f, 0.0f), .distance = 25.0f, .yaw_deg = -52.0f, .pitch_deg = 16.0f},
       .frames = {0, 95, 240},
       .world = {},
       .make = make<OneWay>},
      {.sample = sample,
       .name = "trigger",
       .shows =
           "two boxes swing through a wall that only notices them: contacts are found, no velocity changes",
       .camera = {.target = Vec3(0.0f, 3.8f, 0.0f), .distance = 21.0f, .yaw_deg = 38.0f, .pitch_deg = 16.0f},
       .frames = {0, 82, 120},
       .world = {},
       .make = make<Trigger>}};
}

}  // namespace samples

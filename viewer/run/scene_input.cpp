#include "viewer/run/scene_input.h"

#include <algorithm>
#include <string>

namespace viewer {
namespace {

using pfx::Vec3;

struct Apply {
  SceneRun& run;

  // Position and velocity are those of the held point, so that the body swings under it.
  void operator()(const Pull& pull) const {
    constexpr float kRate = 10.0f;              // rad/s, of the spring
    constexpr float kMaxAcceleration = 120.0f;  // m/s^2
    pfx::World& world = run.world();
    if (pull.body >= world.states().size() || !pfx::isDynamic(world.states()[pull.body].motion_type)) return;
    const pfx::BodyId id = world.bodyId(pull.body);
    if (!world.isValid(id)) return;
    pfx::RigidState& s = world.state(id);
    const Vec3 arm = s.orientation * pull.local;
    const Vec3 velocity = s.linear_velocity + s.angular_velocity.cross(arm);
    Vec3 acceleration = kRate * kRate * (pull.target - s.position - arm) - 2.0f * kRate * velocity;
    if (acceleration.norm() > kMaxAcceleration) acceleration *= kMaxAcceleration / acceleration.norm();
    const float mass = world.bodies()[pull.body].mass;
    const pfx::Mat3 r = s.orientation.toRotationMatrix();
    const Vec3 impulse = 0.5f * mass * run.settings().dt * acceleration;
    s.linear_velocity += impulse / mass;
    s.angular_velocity += r * world.bodies()[pull.body].inertia.inverse() * r.transpose() * arm.cross(impulse);
    s.angular_velocity *= 0.96f;
  }

  void operator()(const ThrowBall& ball) const {
    constexpr float kMassOfUnitRadius = 8000.0f;  // kg, of a ball with a radius of 1 m
    run.world().addBody({.name = "thrown ball " + std::to_string(run.world().states().size()),
                         .pose = {ball.from, pfx::Quat::Identity()},
                         .linear_velocity = ball.velocity,
                         .shapes = {pfx::Shape{pfx::Sphere{ball.radius}, {}}},
                         .mass = kMassOfUnitRadius * ball.radius * ball.radius * ball.radius});
  }

  void operator()(const SetParameter& set) const {
    std::vector<samples::Parameter> all = run.scene().parameters();
    if (set.index < all.size()) *all[set.index].value = std::clamp(set.value, all[set.index].low, all[set.index].high);
  }

  void operator()(const SetTimeStep& set) const { run.setTimeStep(set.dt); }

  void operator()(const samples::Controls& controls) const {
    if (run.scene().isControlled()) run.scene().control(controls);
  }

  void operator()(const pfx::SolverSettings& settings) const { run.world().setSolver(settings); }
};

}  // namespace

void applyInput(SceneRun& run, const SceneInput& input) { std::visit(Apply{run}, input); }

void stepTo(SceneRun& run, uint64_t steps, std::span<const TimedInput> inputs) {
  while (run.world().stepCount() < steps) {
    for (const TimedInput& input : std::ranges::equal_range(inputs, run.world().stepCount(), {}, &TimedInput::step))
      applyInput(run, input.what);
    run.step();
  }
}

}  // namespace viewer

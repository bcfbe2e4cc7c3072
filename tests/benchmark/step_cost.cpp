// Steps a world of one kind of body, to be run under an instruction counter: step_cost KIND BODIES STEPS.
//
// Kinds: fixed, asleep, free, spinning, resting, hanging. Bodies fall asleep before the first counted step, and two runs
// of different length tell what a step costs (cost_test.py).
#include <cstdlib>
#include <iostream>
#include <string>

#include "pfx/high_level/world/world.h"

namespace {

using namespace pfx;

struct Request {
  std::string kind;
  int bodies, steps;
};

BodyDef bodyOf(const std::string& kind, int i) {
  const Vec3 place(2.0f * static_cast<float>(i % 16), 0.5f, 2.0f * static_cast<float>(i / 16));
  BodyDef body{.pose = {.position = place}, .shapes = {{.geometry = Box{Vec3::Constant(0.5f)}}}, .restitution = 0.0f};
  if (kind == "fixed") body.motion_type = MotionType::Fixed;
  if (kind == "free") body.shapes = {{.geometry = Sphere{0.5f}}};
  if (kind == "spinning") {
    body.shapes = {{.geometry = Box{Vec3(0.5f, 0.3f, 0.2f)}}};
    body.angular_velocity = Vec3(5.0f, 1.5f, 1.0f);
  }
  return body;
}

void fill(World& world, const Request& request) {
  const bool floor = request.kind == "asleep" || request.kind == "resting";
  if (floor)
    world.addBody({.pose = {.position = Vec3(0, -1, 0)},
                   .motion_type = MotionType::Fixed,
                   .shapes = {{.geometry = Box{Vec3(60, 1, 60)}}},
                   .restitution = 0.0f});
  for (int i = 0; i < request.bodies; ++i) {
    const BodyId body = world.addBody(bodyOf(request.kind, i));
    if (request.kind != "hanging") continue;
    const Vec3 hook = world.states()[body.index].position + Vec3(0.8f, 0.5f, 0.0f);
    const BodyId post = world.addBody({.pose = {.position = hook},
                                       .motion_type = MotionType::Fixed,
                                       .shapes = {{.geometry = Sphere{0.05f}}},
                                       .filter_self = 0});
    world.addJoint({.body_a = post, .body_b = body, .params = BallJointParams{.anchor_point = hook}});
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: step_cost fixed|asleep|free|spinning|resting|hanging BODIES STEPS\n";
    return 2;
  }
  const Request request{argv[1], std::atoi(argv[2]), std::atoi(argv[3])};
  const bool weightless = request.kind == "free" || request.kind == "spinning";
  World world({.gravity = Vec3(0.0f, weightless ? 0.0f : -9.8f, 0.0f),
               .simd = SimdLevel::Sse2,
               .sleeping = request.kind == "asleep",
               .sleep_steps = 2});
  fill(world, request);
  for (int i = 0; i < 12 + request.steps; ++i) world.step(1.0f / 60.0f);
  const WorldCounts counts = world.counts();
  std::cout << counts.bodies << " bodies, " << counts.awake << " awake\n";
  return request.kind == "asleep" && counts.awake > 0 ? 1 : 0;
}

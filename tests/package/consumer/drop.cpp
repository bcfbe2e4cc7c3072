// Drops a sphere onto a fixed box and checks that it comes to rest on top of it.
// Uses nothing but the installed headers and library.
#include <cmath>
#include <cstdio>

#include "pfx/high_level/world/world.h"

int main() {
  pfx::World world;
  world.addBody({.name = "ground",
                 .pose = {.position = {0.0f, -1.0f, 0.0f}},
                 .motion_type = pfx::MotionType::Fixed,
                 .shapes = {{.geometry = pfx::Box{{5.0f, 1.0f, 5.0f}}}}});
  const pfx::BodyId ball = world.addBody({.name = "ball",
                                          .pose = {.position = {0.0f, 2.0f, 0.0f}},
                                          .shapes = {{.geometry = pfx::Sphere{0.5f}}},
                                          .restitution = 0.0f});
  for (int i = 0; i < 180; ++i) world.step(1.0f / 60.0f);

  const float height = world.states()[ball.index].position.y();
  std::printf("the ball rests %.4f m above the ground\n", height - 0.5f);
  // Soft contacts sink by less than a millimetre under this weight.
  return std::abs(height - 0.5f) < 1e-3f ? 0 : 1;
}

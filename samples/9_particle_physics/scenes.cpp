// Sample 9_particle_physics: cloth, hair, a rope bridge and jelly, with two-way contact with rigid bodies.
#include "samples/9_particle_physics/particle_scene.h"
#include "samples/registry.h"

namespace samples {

using pfx::Vec3;

std::vector<SceneEntry> particlePhysicsScenes() {
  return {{.sample = "9_particle_physics",
           .name = "curtain",
           .shows = "a ball swings into a curtain on nine rings; threads that are pulled show their strain (red: 0.5 %)",
           .camera = {.target = Vec3(0.0f, 2.2f, 0.2f), .distance = 7.0f, .yaw_deg = 38.0f, .pitch_deg = 12.0f},
           .frames = {0, 50, 110},
           .world = {},
           .make = makeCurtain},
          {.sample = "9_particle_physics",
           .name = "drape",
           .shows = "a sheet falls over a ball, a box and a roll and lies in folds, without stretching",
           .camera = {.target = Vec3(0.0f, 0.65f, 0.1f), .distance = 5.6f, .yaw_deg = 32.0f, .pitch_deg = 27.0f},
           .frames = {0, 45, 200},
           .world = {},
           .make = makeDrape},
          {.sample = "9_particle_physics",
           .name = "hair",
           .shows = "roots follow the shaken head exactly, strands lag behind and keep their curl",
           .camera = {.target = Vec3(0.0f, 1.8f, 0.0f), .distance = 4.0f, .yaw_deg = 30.0f, .pitch_deg = 6.0f},
           .frames = {30, 60, 120},
           .world = {},
           .make = makeHair},
          {.sample = "9_particle_physics",
           .name = "bridge",
           .shows = "a rope bridge gives way under the balls and the barrel that roll over it; ropes coloured by strain (red: 0.5 %)",
           .camera = {.target = Vec3(0.0f, 2.1f, 0.0f), .distance = 12.0f, .yaw_deg = 25.0f, .pitch_deg = 20.0f},
           .frames = {0, 90, 170},
           .world = {},
           .make = makeBridge},
          {.sample = "9_particle_physics",
           .name = "jelly",
           .shows = "a cube and a ball of jelly give way and keep their volume, even under a weight",
           .camera = {.target = Vec3(0.0f, 1.1f, 0.0f), .distance = 7.5f, .yaw_deg = 25.0f, .pitch_deg = 14.0f},
           .frames = {0, 40, 120},
           .world = {},
           .make = makeJelly}};
}

}  // namespace samples

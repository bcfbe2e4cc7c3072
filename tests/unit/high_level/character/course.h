// A ground, and one or several characters that are led over it.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "pfx/base_level/rigid_body/rotation_update.h"
#include "pfx/high_level/character/character.h"

namespace pfx {

inline constexpr float kDt = 1.0f / 60.0f;
inline constexpr float kGravity = 9.8f;

struct Course {
  World world;
  std::vector<Character> characters;
  std::vector<CharacterInput> inputs;
  std::set<CharacterState> seen;  // of the first character
  BodyId ground = addBox(Vec3(0.0f, -1.0f, 0.0f), Vec3(100.0f, 1.0f, 100.0f), MotionType::Fixed);

  BodyId addBox(const Vec3& at, const Vec3& half_extent, MotionType type, float mass = 1.0f,
                const Quat& turn = Quat::Identity()) {
    return world.addBody({.name = "box",
                          .pose = {at, turn},
                          .motion_type = type,
                          .shapes = {Shape{Box{half_extent}, {}}},
                          .mass = mass});
  }

  Character& add(const Vec3& feet, float heading = 0.0f) {
    characters.push_back(addCharacter(world, {.feet = feet, .heading = heading}));
    inputs.push_back({});
    return characters.back();
  }

  void step() {
    ASSERT_EQ(updateCharacters(world, characters, inputs, kDt), Error::Ok);
    world.step(kDt);
    if (!characters.empty()) seen.insert(characters.front().state);
  }
  void run(float seconds) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds / kDt)); ++i) step();
  }
  // The first character.
  Vec3 feet(size_t i = 0) const { return feetOf(characters[i], world); }
  const RigidState& body(size_t i = 0) const { return world.states()[characters[i].body.index]; }
  CharacterState state() const { return characters.front().state; }
};

// A slope that rises towards +z from the line z = foot.
inline void addSlope(Course& course, float angle, float foot) {
  const Quat turn = expMap(-angle * Vec3::UnitX());
  const Vec3 half(5.0f, 1.0f, 20.0f);
  const Vec3 corner = turn * Vec3(0.0f, half.y(), -half.z());
  course.addBox(Vec3(0.0f, 0.0f, foot) - corner, half, MotionType::Fixed, 1.0f, turn);
}

// Steps of that height and depth towards +z, the first riser at z = 2.
inline void addStairs(Course& course, int count, float height, float depth) {
  for (int i = 0; i < count; ++i) {
    const float h = height * static_cast<float>(i + 1);
    course.addBox(Vec3(0.0f, 0.5f * h, 2.0f + depth * (static_cast<float>(i) + 0.5f)),
                  Vec3(3.0f, 0.5f * h, 0.5f * depth), MotionType::Fixed);
  }
  const float top = height * static_cast<float>(count);
  course.addBox(Vec3(0.0f, 0.5f * top, 2.0f + depth * static_cast<float>(count) + 5.0f),
                Vec3(3.0f, 0.5f * top, 5.0f), MotionType::Fixed);
}

}  // namespace pfx

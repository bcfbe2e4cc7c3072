// Characters: capsules that walk, run, jump, crouch and climb steps among everything else in a world.
//
// A character is an Active body that never turns over. Before each step the controller looks at what is
// around it, moves on in its table of states, and gives the body the velocity that it wants: along the
// ground, up a step, along a wall. The step then treats it like any other body, so that it pushes and is
// pushed, carries and is carried, and the force of its legs is bounded. Everything that a controller
// remembers is in Character, which may be copied, saved and put back as it is, together with a snapshot of
// the world.
#pragma once

#include <span>

#include "pfx/high_level/character/character_state.h"
#include "pfx/high_level/world/world.h"

namespace pfx {

struct CharacterParams {
  float radius = 0.3f;            // m
  float height = 1.8f;            // m, of the whole capsule
  float crouch_height = 1.1f;     // m, 2 radius .. height
  float mass = 80.0f;             // kg
  float walk_speed = 1.6f;        // m/s, along the ground
  float run_speed = 4.5f;         // m/s
  float sneak_speed = 0.8f;       // m/s
  float climb_speed = 2.5f;       // m/s, up and down steps at most
  float jump_height = 0.8f;       // m, of the feet
  float step_height = 0.3f;       // m, highest step that it takes
  float max_slope = 0.87f;        // rad, steepest ground that it walks on
  float drive_force = 800.0f;     // N, of its legs along the ground
  float push_force = 400.0f;      // N, of its legs while it pushes
  float air_acceleration = 3.0f;  // m/s^2, steering without ground
  float turn_speed = 9.0f;        // rad/s
};

struct CharacterDef {
  std::string name = "character";
  Vec3 feet = Vec3::Zero();  // m, lowest point
  float heading = 0.0f;      // rad about y; 0 faces +z
  CharacterParams params = {};
  uint32_t filter_self = 0xffffffffu;
  uint32_t filter_target = 0xffffffffu;
};

// What is asked of a character in a step.
struct CharacterInput {
  Vec3 direction = Vec3::Zero();  // world, y is ignored; a length below 1 means slower, above counts as 1
  bool run = false, jump = false, crouch = false;
};

// What is below a character.
struct CharacterSupport {
  uint32_t body = kNoBody;              // kNoBody: nothing near
  float gap = 0.0f;                     // m, below the feet; negative: they are in it
  Vec3 point = Vec3::Zero();            // m, world
  Vec3 contact_normal = Vec3::UnitY();  // unit, from the body to the capsule; slants on an edge
  Vec3 normal = Vec3::UnitY();          // unit, of the ground that the edge belongs to
};

// What a character does in the coming step.
struct CharacterDecision {
  Vec3 velocity = Vec3::Zero();  // m/s
  Vec3 reaction = Vec3::Zero();  // N s, of its legs on the support
  float gravity_scale = 1.0f;
  bool is_low = false;
};

struct Character {
  CharacterParams params;
  BodyId body = {};
  CharacterState state = CharacterState::Stand;
  float time_in_state = 0.0f;  // s
  float heading = 0.0f;        // rad about y; 0 faces +z
  bool is_low = false;         // the capsule has its crouching height
  bool jump_was_asked = false;
  CharacterSupport support = {};        // found before the last step
  Vec3 ground_velocity = Vec3::Zero();  // m/s, of the support where it was, in the last step
  Vec3 drive = Vec3::Zero();            // m/s, along the ground, that it meant to have in the last step
  float landing_speed = 0.0f;           // m/s, downwards, of the last landing
  float fall_speed = 0.0f;              // m/s, downwards, the largest since it left the ground
  float time_since_climb = 1e9f;        // s
  CharacterDecision decision = {};      // in the last update

  float height() const { return is_low ? params.crouch_height : params.height; }
};

// Adds the body of a character. Throws std::invalid_argument that names the character and the parameter out
// of range.
Character addCharacter(World& world, const CharacterDef& def);

// Before each World::step(dt), after scripted bodies were told where to go: moves every character on by one
// step. All of them look at the world first and act then, so their order does not matter. Characters whose
// body is gone are left alone. Error::OutOfRange for spans of different length; nothing is done then.
Error updateCharacters(World& world, std::span<Character> characters, std::span<const CharacterInput> inputs,
                       float dt);

// m, lowest point of the capsule.
Vec3 feetOf(const Character& character, const World& world);

// Unit vector that the character faces.
Vec3 facingOf(const Character& character);

// Of what the controllers remember, to be compared between runs.
uint64_t hashCharacters(std::span<const Character> characters);

}  // namespace pfx

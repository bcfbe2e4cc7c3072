#include "pfx/high_level/character/character.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "pfx/base_level/math/trig.h"
#include "pfx/base_level/rigid_body/rotation_update.h"
#include "pfx/high_level/character/character_motion.h"
#include "pfx/high_level/character/character_probe.h"
#include "pfx/util/state_hash/state_hash.h"

namespace pfx {
namespace {

constexpr float kNear = 0.02f;                          // m, feet this near touch the ground
constexpr float kLeaving = 0.5f;                        // m/s, away from the ground: no landing
constexpr float kClimbMemory = 0.15f;                   // s, between two steps of a flight it still climbs
constexpr float kRecovery = 0.05f;                      // s of recovery for each m/s of a landing
constexpr float kSoftLanding = 2.0f;                    // m/s, that need none
constexpr float kPushReach = 0.03f, kPushKeep = 0.12f;  // m ahead, to begin and to go on with pushing
constexpr float kTurnInertia = 1e6f;                    // kg m^2, so that no contact turns a character over

Quat upright() {
  const float half = 0.70710678f;
  return Quat(half, 0.0f, 0.0f, half);
}

Quat headingTurn(float heading) {
  const SinCos half = sincos(0.5f * heading);
  return Quat(half.cos, 0.0f, half.sin, 0.0f);
}

Shape capsuleOf(const Character& c) {
  const float r = c.params.radius;
  return {Capsule{0.5f * c.height() - r, r}, {.orientation = upright()}};
}

Vec3 horizontal(const Vec3& v) { return Vec3(v.x(), 0.0f, v.z()); }

void requireBetween(const CharacterDef& def, const char* name, float value, float low, float high) {
  if (value >= low && value <= high) return;
  throw std::invalid_argument("character \"" + def.name + "\": " + name + " = " + std::to_string(value) +
                              ", must be " + std::to_string(low) + " .. " + std::to_string(high));
}

void check(const CharacterDef& def) {
  constexpr float kMost = 1e6f;
  const CharacterParams& p = def.params;
  requireBetween(def, "radius", p.radius, 0.05f, kMost);
  requireBetween(def, "height", p.height, 2.0f * p.radius, kMost);
  requireBetween(def, "crouch height", p.crouch_height, 2.0f * p.radius, p.height);
  requireBetween(def, "step height", p.step_height, 0.0f, 0.5f * p.crouch_height);
  requireBetween(def, "max slope", p.max_slope, 0.0f, 1.5f);
  requireBetween(def, "heading", def.heading, -kMost, kMost);
  for (const auto& [name, value] : {std::pair{"walk speed", p.walk_speed},
                                    {"run speed", p.run_speed},
                                    {"sneak speed", p.sneak_speed},
                                    {"climb speed", p.climb_speed},
                                    {"jump height", p.jump_height},
                                    {"drive force", p.drive_force},
                                    {"push force", p.push_force},
                                    {"air acceleration", p.air_acceleration},
                                    {"turn speed", p.turn_speed}})
    requireBetween(def, name, value, 0.0f, kMost);
}

// One character's step, from what it finds to what it does.
class Controller {
 public:
  Controller(const World& world, Character& c, const CharacterInput& input, float dt)
      : world_(world), c_(c), input_(input), dt_(dt), body_(world.states()[c.body.index]), probe_(world, c) {
    wish_ = horizontal(input.direction);
    if (!wish_.allFinite()) wish_.setZero();
    wish_ = clampedTo(wish_, 1.0f);
  }

  CharacterDecision decide() {
    findGround();
    changeState();
    turn();
    c_.fall_speed = isGrounded(c_.state) ? 0.0f : std::max(c_.fall_speed, -body_.linear_velocity.y());
    CharacterDecision d;
    if (isGrounded(c_.state)) {
      d = isKinematicGround() ? walk() : walkOnMovable();
    } else {
      d = fly();
    }
    d.is_low = isLow(c_.state) || (c_.is_low && !has_headroom_);
    return d;
  }

 private:
  bool isKinematicGround() const { return !isDynamic(ground().motion_type); }
  const RigidState& ground() const { return world_.states()[c_.support.body]; }

  // Where the material point of the ground goes in the coming step, as a velocity.
  Vec3 groundVelocity() const {
    if (c_.support.body == kNoBody) return Vec3::Zero();
    const RigidState& g = ground();
    const Vec3 arm = c_.support.point - g.position;
    if (isDynamic(g.motion_type)) return g.linear_velocity + g.angular_velocity.cross(arm);
    if (g.angular_velocity.isZero(0.0f)) return g.linear_velocity;
    return g.linear_velocity + (expMap(dt_ * g.angular_velocity) * arm - arm) / dt_;
  }

  void findGround() {
    const float reach = isGrounded(c_.state) ? c_.params.step_height + kNear : kNear;
    const uint32_t last = c_.support.body;
    c_.support = probe_.findSupport(probe_.center(), reach);
    const Vec3 now = groundVelocity();
    // The character moved with the ground in the last step; on other ground it goes by what that does now.
    slip_ =
        body_.linear_velocity - (c_.support.body == last && isGrounded(c_.state) ? c_.ground_velocity : now);
    c_.ground_velocity = now;
  }

  CharacterFacts facts() {
    CharacterFacts f;
    const bool touches = c_.support.body != kNoBody && c_.support.gap <= kNear;
    const bool walkable = c_.support.body != kNoBody && probe_.canWalkOn(c_.support.normal);
    const bool leaves = slip_.dot(c_.support.contact_normal) > kLeaving;
    f.on_ground = walkable && (isGrounded(c_.state) || (touches && !leaves));
    f.on_steep = touches && !walkable && !leaves;
    f.rises = body_.linear_velocity.y() > 0.0f;
    f.moves = !wish_.isZero(1e-3f);
    f.runs = input_.run;
    f.jumps = input_.jump && !c_.jump_was_asked;
    f.crouches = input_.crouch;
    has_headroom_ = !c_.is_low || probe_.hasHeadroom();
    f.has_headroom = has_headroom_;
    f.climbs = c_.time_since_climb < kClimbMemory;
    f.pushes = f.moves && pushes();
    f.is_recovering = c_.landing_speed > kSoftLanding && c_.time_in_state < kRecovery * c_.landing_speed;
    return f;
  }

  bool pushes() const {
    const float reach = c_.state == CharacterState::Push ? kPushKeep : kPushReach;
    const ShapeCastOutput hit = probe_.cast(probe_.center(), reach * wish_.normalized(), kMovableObstacles);
    return hit.hit && hit.body != c_.support.body;
  }

  void changeState() {
    const CharacterFacts f = facts();
    const CharacterState old = c_.state;
    c_.state = nextState(old, f);
    c_.time_in_state += dt_;
    c_.time_since_climb = std::min(c_.time_since_climb + dt_, 1e9f);
    c_.jump_was_asked = input_.jump;
    if (c_.state == old) return;
    c_.time_in_state = 0.0f;
    if (c_.state == CharacterState::Land) c_.landing_speed = c_.fall_speed;
    starts_jump_ = c_.state == CharacterState::Jump;
  }

  void turn() {
    if (wish_.isZero(1e-3f)) return;
    float away = atan2(wish_.x(), wish_.z()) - c_.heading;
    away -= 2.0f * kPi * std::floor(away / (2.0f * kPi) + 0.5f);
    const float most = c_.params.turn_speed * dt_;
    c_.heading += std::clamp(away, -most, most);
    c_.heading -= 2.0f * kPi * std::floor(c_.heading / (2.0f * kPi) + 0.5f);
  }

  float speed() const {
    switch (c_.state) {
      case CharacterState::Run:
        return c_.params.run_speed;
      case CharacterState::Crouch:
      case CharacterState::Sneak:
        return c_.params.sneak_speed;
      case CharacterState::Climb:
        return input_.run ? c_.params.run_speed : c_.params.walk_speed;
      case CharacterState::Land:
        return c_.params.sneak_speed;
      default:
        return c_.params.walk_speed;
    }
  }

  float legForce() const {
    return c_.state == CharacterState::Push ? c_.params.push_force : c_.params.drive_force;
  }

  Vec3 targetDrive() const { return alongGround(speed() * wish_, c_.support.normal); }

  // On ground that does not feel the character.
  CharacterDecision walk() {
    const Vec3& n = c_.support.normal;
    // After a step was taken the velocity says nothing about the drive.
    const Vec3 had = c_.time_since_climb <= dt_ ? c_.drive : Vec3(slip_ - slip_.dot(n) * n);
    const Vec3 now = alongGround(had, n);
    c_.drive = now + clampedTo(targetDrive() - now, legForce() / c_.params.mass * dt_);
    const GroundMotion motion = planGroundMotion(probe_, c_.params, c_.drive, c_.ground_velocity, dt_);
    if (motion.climbs) c_.time_since_climb = 0.0f;
    return {.velocity = motion.velocity, .gravity_scale = 0.0f};
  }

  // On a body that gives way: legs push it back, within what friction holds, and the weight rests on it.
  CharacterDecision walkOnMovable() {
    const RigidBody& g = world_.bodies()[c_.support.body];
    const Vec3& n = c_.support.normal;
    const Vec3 slip = slip_ - slip_.dot(n) * n;
    // Gravity pulls it down a slope in the course of the step: half before, half after.
    const Vec3 pull = world_.def().gravity - world_.def().gravity.dot(n) * n;
    const Vec3 missing = targetDrive() - slip - 0.5f * dt_ * pull;
    c_.drive = slip;
    const float weight = c_.params.mass * world_.def().gravity.norm();
    const float grip = std::min(legForce(), g.friction * weight) * dt_;
    const float shared_mass = 1.0f / (1.0f / c_.params.mass + inverseMassAt(g, missing));
    const Vec3 impulse = clampedTo(shared_mass * missing, grip);
    return {.velocity = body_.linear_velocity + impulse / c_.params.mass, .reaction = -impulse};
  }

  // 1/kg, of the support against an impulse along `direction` at the feet.
  float inverseMassAt(const RigidBody& g, const Vec3& direction) const {
    const float length = direction.norm();
    if (length == 0.0f) return 1.0f / g.mass;
    const Vec3 lever = (c_.support.point - ground().position).cross(direction / length);
    return 1.0f / g.mass +
           lever.dot(worldInverseInertia(ground().orientation, makeInertia(g.inertia)) * lever);
  }

  CharacterDecision fly() {
    Vec3 v = body_.linear_velocity;
    const Vec3 missing = speed() * wish_ - horizontal(v);
    // Steering never brakes what the character brought along.
    const bool steers =
        !wish_.isZero(1e-3f) && (c_.state != CharacterState::Slide || wish_.dot(c_.support.normal) > 0.0f);
    if (steers) v += clampedTo(missing, c_.params.air_acceleration * dt_);
    c_.drive.setZero();
    if (starts_jump_)
      v.y() = std::sqrt(2.0f * world_.def().gravity.norm() * c_.params.jump_height) +
              std::max(0.0f, c_.ground_velocity.y());
    return {.velocity = v};
  }

  const World& world_;
  Character& c_;
  const CharacterInput& input_;
  float dt_;
  const RigidState& body_;
  CharacterProbe probe_;
  Vec3 wish_;                 // horizontal, at most of length 1
  Vec3 slip_ = Vec3::Zero();  // m/s, against the ground
  bool has_headroom_ = true, starts_jump_ = false;
};

void pushGround(World& world, const Character& c, const Vec3& impulse) {
  if (impulse.isZero(0.0f)) return;
  const BodyId id = world.bodyId(c.support.body);
  RigidState& g = world.state(id);
  const RigidBody& body = world.bodies()[id.index];
  g.linear_velocity += impulse / body.mass;
  const Vec3 moment = (c.support.point - g.position).cross(impulse);
  g.angular_velocity += worldInverseInertia(g.orientation, makeInertia(body.inertia)) * moment;
}

void apply(World& world, Character& c) {
  const CharacterDecision& d = c.decision;
  world.body(c.body).gravity_scale = d.gravity_scale;
  RigidState& s = world.state(c.body);
  s.linear_velocity = d.velocity;
  s.angular_velocity.setZero();
  s.orientation = headingTurn(c.heading);
  pushGround(world, c, d.reaction);
  if (d.is_low == c.is_low) return;
  c.is_low = d.is_low;
  const float change = 0.5f * (c.params.height - c.params.crouch_height);
  s.position.y() += c.is_low ? -change : change;
  const Shape shape = capsuleOf(c);
  world.setShapes(c.body, {&shape, 1});
}

}  // namespace

Character addCharacter(World& world, const CharacterDef& def) {
  check(def);
  Character c{.params = def.params, .heading = def.heading};
  c.body = world.addBody(
      {.name = def.name,
       .pose = {def.feet + Vec3(0.0f, 0.5f * def.params.height, 0.0f), headingTurn(def.heading)},
       .shapes = {capsuleOf(c)},
       .mass = def.params.mass,
       .inertia = kTurnInertia * Mat3::Identity(),
       .restitution = 0.0f,
       .friction = 0.0f,
       .filter_self = def.filter_self,
       .filter_target = def.filter_target});
  return c;
}

Error updateCharacters(World& world, std::span<Character> characters, std::span<const CharacterInput> inputs,
                       float dt) {
  if (characters.size() != inputs.size()) return Error::OutOfRange;
  if (!(dt > 0.0f) || !std::isfinite(dt)) return Error::InvalidValue;
  for (size_t i = 0; i < characters.size(); ++i)
    if (world.isValid(characters[i].body))
      characters[i].decision = Controller(world, characters[i], inputs[i], dt).decide();
  for (Character& c : characters)
    if (world.isValid(c.body)) apply(world, c);
  return Error::Ok;
}

Vec3 feetOf(const Character& character, const World& world) {
  return world.states()[character.body.index].position - Vec3(0.0f, 0.5f * character.height(), 0.0f);
}

uint64_t hashCharacters(std::span<const Character> characters) {
  uint64_t hash = 0;
  for (const Character& c : characters) {
    const std::array<float, 10> remembered = {static_cast<float>(c.state),
                                              c.time_in_state,
                                              c.heading,
                                              c.is_low ? 1.0f : 0.0f,
                                              c.drive.x(),
                                              c.drive.y(),
                                              c.drive.z(),
                                              c.landing_speed,
                                              c.fall_speed,
                                              c.time_since_climb};
    const std::array<uint64_t, 2> both = {hash, hashBytes(std::as_bytes(std::span(remembered)))};
    hash = hashBytes(std::as_bytes(std::span(both)));
  }
  return hash;
}

Vec3 facingOf(const Character& character) {
  const SinCos turn = sincos(character.heading);
  return Vec3(turn.sin, 0.0f, turn.cos);
}

}  // namespace pfx

// The five ways a body may take part in the simulation, and the two tables that follow from them.
#pragma once

#include <cstdint>

namespace pfx {

enum class MotionType : uint8_t {
  Fixed = 0,     // infinite mass, never moves
  Active = 1,    // moves and collides by the laws of mechanics; may sleep
  Keyframe = 2,  // pose after the step is given from outside; pushes others, is not pushed; may sleep
  OneWay = 3,    // is pushed by others, never pushes them; may sleep
  Trigger = 4,   // neither pushes nor is pushed; its contacts are recorded
};

inline constexpr int kNumMotionTypes = 5;

// True for types whose velocity the solver may change.
constexpr bool isDynamic(MotionType t) { return t == MotionType::Active || t == MotionType::OneWay; }

// Whether the broad phase and the collision detection consider a pair of these types (symmetric).
constexpr bool detectsCollision(MotionType a, MotionType b) {
  constexpr auto F = MotionType::Fixed, K = MotionType::Keyframe, O = MotionType::OneWay, T = MotionType::Trigger;
  const auto both = [&](MotionType x, MotionType y) { return (a == x && b == y) || (a == y && b == x); };
  return !(both(F, F) || both(F, K) || both(K, K) || both(O, O) || both(T, T));
}

// Whether the solver handles a pair of these types (symmetric).
constexpr bool solvesConstraint(MotionType a, MotionType b) {
  return a != MotionType::Trigger && b != MotionType::Trigger && (isDynamic(a) || isDynamic(b)) &&
         !(a == MotionType::OneWay && b == MotionType::OneWay);
}

}  // namespace pfx

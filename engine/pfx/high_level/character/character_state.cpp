#include "pfx/high_level/character/character_state.h"

#include <array>

namespace pfx {
namespace {

using S = CharacterState;
using F = CharacterFacts;

constexpr uint32_t bit(S s) { return 1u << static_cast<uint32_t>(s); }

constexpr uint32_t kAll = (1u << kNumCharacterStates) - 1;
constexpr uint32_t kGrounded = kAll & ~(bit(S::Jump) | bit(S::Fall) | bit(S::Slide));
constexpr uint32_t kLow = bit(S::Crouch) | bit(S::Sneak);

// The first row whose state and condition match leads on; without one the state stays.
struct Transition {
  uint32_t from;
  bool (*when)(const F&);
  S to;
};

constexpr bool staysLow(const F& f) { return f.crouches; }
constexpr bool mustStayLow(const F& f) { return f.crouches || !f.has_headroom; }

constexpr std::array kTransitions = {
    Transition{kGrounded & ~kLow, [](const F& f) { return f.jumps && f.on_ground; }, S::Jump},
    Transition{kLow, [](const F& f) { return f.jumps && f.on_ground && f.has_headroom; }, S::Jump},
    Transition{kGrounded, [](const F& f) { return !f.on_ground && f.on_steep; }, S::Slide},
    Transition{kGrounded, [](const F& f) { return !f.on_ground; }, S::Fall},
    Transition{bit(S::Jump), [](const F& f) { return !f.rises; }, S::Fall},
    Transition{bit(S::Fall), [](const F& f) { return f.on_ground; }, S::Land},
    Transition{bit(S::Fall), [](const F& f) { return f.on_steep; }, S::Slide},
    Transition{bit(S::Slide), [](const F& f) { return !f.on_ground && !f.on_steep; }, S::Fall},
    Transition{bit(S::Slide), [](const F& f) { return f.on_ground; }, S::Stand},
    Transition{bit(S::Land), [](const F& f) { return f.is_recovering; }, S::Land},
    Transition{kLow, [](const F& f) { return mustStayLow(f) && f.moves; }, S::Sneak},
    Transition{kLow, mustStayLow, S::Crouch},
    Transition{kGrounded, [](const F& f) { return staysLow(f) && f.moves; }, S::Sneak},
    Transition{kGrounded, staysLow, S::Crouch},
    Transition{kGrounded, [](const F& f) { return f.climbs && f.moves; }, S::Climb},
    Transition{kGrounded, [](const F& f) { return f.pushes && f.moves; }, S::Push},
    Transition{kGrounded, [](const F& f) { return f.runs && f.moves; }, S::Run},
    Transition{kGrounded, [](const F& f) { return f.moves; }, S::Walk},
    Transition{kGrounded, [](const F&) { return true; }, S::Stand},
};

constexpr std::array<std::string_view, kNumCharacterStates> kNames = {
    "stand", "walk", "run", "push", "climb", "crouch", "sneak", "jump", "fall", "land", "slide"};

}  // namespace

std::string_view toString(CharacterState state) {
  const auto i = static_cast<size_t>(state);
  return i < kNames.size() ? kNames[i] : "unknown";
}

CharacterState nextState(CharacterState state, const CharacterFacts& facts) {
  for (const Transition& t : kTransitions)
    if ((t.from & bit(state)) != 0 && t.when(facts)) return t.to;
  return state;
}

}  // namespace pfx

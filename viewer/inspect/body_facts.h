// What is known of bodies, contacts and joints of a world.
#pragma once

#include "pfx/high_level/world/world.h"
#include "viewer/inspect/fact_sheet.h"

namespace viewer {

// {"index", "name"}: how facts name a body or a joint.
Json bodyRef(const pfx::World& world, uint32_t body);
Json jointRef(const pfx::World& world, uint32_t joint);
std::string bodyTitle(const pfx::World& world, uint32_t body);  // "box 12", or "body 13" without a name

// The island of the body; nothing when the body does not move or sleeps without one.
std::optional<uint32_t> islandOfBody(const pfx::World& world, uint32_t body);

// Index into contactPairs(); nothing when the bounds of the bodies do not meet.
std::optional<uint32_t> findPair(const pfx::World& world, uint32_t body_a, uint32_t body_b);

// Of an existing body.
FactSheet bodyFacts(const pfx::World& world, uint32_t body);
// Of a pair that is a contact: the bodies, what they share, and a list of "points".
FactSheet contactFacts(const pfx::World& world, const pfx::Pair& pair);
// Of an existing joint: the bodies, errors and loads, and a list of its six "axes".
FactSheet jointFacts(const pfx::World& world, uint32_t joint);

}  // namespace viewer

// Between manifolds and the solver's rows: copying in before the solve, copying impulses out after it.
#pragma once

#include <span>

#include "pfx/base_level/collision/contact_manifold.h"
#include "pfx/base_level/constraint/contact_rows.h"

namespace pfx {

// What makes a contact hard for sequential impulses.
enum class ContactStrain : uint8_t {
  None,
  Loaded,   // carries many times the weight of its lighter body
  Leaning,  // may hold up what stands only while nothing gives way
  Small,    // its bodies are hardly larger than what soft rows give way by
};

// One manifold to be solved.
struct ContactConstraint {
  ContactManifold* manifold;
  uint32_t solver_a, solver_b;  // indices of solver bodies
  bool writable_a, writable_b;  // whether the solver may change A, B
  bool round_a, round_b;        // whether A, B rolls: its contact point is no fixed point of the body
  float friction;               // of the pair
  float restitution;            // of the pair
  float rolling_resistance = 0.0f, torsional_resistance = 0.0f;  // m, of the pair
  ContactStrain strain = ContactStrain::None;
};

// Where the friction of a point acts, as a share of its distance from the centre of the manifold: a face that presses
// evenly resists spin with the mean distance of its area, not with that of its corners. 2/3 for a disc; for boxes
// between 0.54 of a square and 0.5 of a bar.
float frictionSpread(const ContactConstraint& constraint);

// Copies up to eight constraints into a batch; the lanes left over point at `idle_body` and stay neutral.
void fillContactRows(ContactRows& rows, std::span<const ContactConstraint* const> constraints,
                     uint32_t idle_body);

// Whether a contact resists the turning of its bodies; its batch needs RollingRows.
inline bool resistsTurning(const ContactConstraint& c) {
  return c.rolling_resistance > 0.0f || c.torsional_resistance > 0.0f;
}

void fillRollingRows(RollingRows& rows, std::span<const ContactConstraint* const> constraints);

// Writes the impulses of a batch back to the manifolds it was filled from.
void storeContactImpulses(const ContactRows& rows, std::span<const ContactConstraint* const> constraints);

}  // namespace pfx

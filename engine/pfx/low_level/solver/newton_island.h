// The solver for islands that defeat sequential impulses: tall stacks, heavy things on light ones, arches, machines that
// press on what they hold.
//
// All contacts and joints of the island are solved together by Newton's method on the velocity, with a block-sparse
// factor in double precision, so that neither the height of a stack nor the ratio of masses limits how well
// it stands:
//
//   for each sub-step: forces -> solve with overlaps pushed apart -> move -> solve again without the push
//   at the end:        solve for the speeds after impacts
//
// The second solve starts from the impulses of the first, so that it ends at rest where the first was in
// balance. At rest neither needs an iteration. Source as in newton_contact.h; sub-steps and relax pass as in
// soft_step.h.
#pragma once

#include <span>

#include "pfx/base_level/memory/containers.h"
#include "pfx/low_level/solver/body_elimination.h"
#include "pfx/low_level/solver/direct_body.h"
#include "pfx/low_level/solver/newton_contact.h"
#include "pfx/low_level/solver/newton_joint.h"

namespace pfx {

struct NewtonParams {
  double h = 1.0 / 240.0;  // s, of a sub-step
  int substeps = 4;
  double give = 2e-3;                  // R in units of the inverse effective mass of a row
  double max_overlap = 1e-3;           // share of the lever of a point that its load presses in at most
  double push_rate = 0.4;              // share of an overlap that a sub-step takes back
  double max_push_speed = 0.65;        // m/s
  double restitution_threshold = 0.5;  // m/s
};

// What belongs to an island. bodies: indices of states, ascending, with everything that the constraints name; motions: by
// entry of bodies, inertia null for bodies that constraints do not move. The solver_a and solver_b of contacts are
// indices of states.
struct NewtonIslandDef {
  std::span<const uint32_t> bodies;
  std::span<const BodyMotion> motions;
  std::span<const ContactConstraint> contacts;
  std::span<const JointConstraint> joints;
};

class NewtonIsland {
 public:
  // Takes over an island at the start of a step.
  void begin(std::span<const RigidState> states, std::span<const RigidBody> rigid_bodies, const NewtonIslandDef& island,
             const NewtonParams& params);

  // The whole step. Writes the states of the dynamic bodies and the impulses of the manifolds. False, with nothing
  // written, when the answer would throw a body: where bodies are jammed, the circles of friction may not settle.
  bool advance(std::span<RigidState> states);

  uint32_t iterations() const { return iterations_; }  // of Newton's method, in the last step

 private:
  uint32_t localOf(uint32_t body) const;
  void addContact(const ContactConstraint& constraint);
  void addJoint(const JointConstraint& constraint);
  struct Load {
    double weight, carried;  // N s on a point: were it the weight of the whole island; in the last step
  };
  void setStiffness(NewtonPoint& point, const double (&inverse_mass)[2], const Load& load) const;
  void makeStructure();
  void startSubstep();
  void setBias(bool push);
  void linearizeJoints(bool push);
  void solve();
  double fastest() const;
  void move();
  void bounce();
  void store(std::span<RigidState> states);

  void updateMass();
  void evaluate(bool fix_radius);
  double gradient();
  void factor();
  void search();
  double slopeAt(double step) const;
  double lineSearch(double slope) const;
  double iterate(int most);
  void soften(double factor);
  double* velocityOf(uint32_t body) { return &velocity_[size_t(body) * 6]; }

  NewtonParams params_;
  uint32_t iterations_ = 0;
  std::span<const uint32_t> body_index_;  // of the caller; valid during the step
  Vector<DirectBody> bodies_;
  Vector<TransformDouble> start_;  // poses at the start of the step
  Vector<uint32_t> moving_;        // local indices of dynamic bodies; their order is that of the blocks
  Vector<uint32_t> block_of_;      // by local index
  Vector<NewtonContact> contacts_;
  Vector<NewtonJoint> joints_;
  Vector<Link> links_;  // of blocks, by contact or joint that couples two
  BodyElimination elimination_;
  Vector<Mat3d> inertia_;                                           // kg m^2, world axes, by local index
  Vector<double> velocity_, free_velocity_, direction_, gradient_;  // six a body, by local index
  Vector<double> diagonal_, off_diagonal_, scratch_, x_;
  double tolerance_ = 0.0;  // m/s
  double weight_ = 0.0;     // N, of the island, and the strength of its motors
  bool factored_ = false;
};

}  // namespace pfx

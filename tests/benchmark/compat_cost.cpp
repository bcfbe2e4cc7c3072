// The documented pipeline twice: `compat_cost compat` calls the stages of physics_effects.h, `compat_cost native` does the
// same work with the engine's own functions and records. tests/benchmark/compat_cost.py counts the instructions of both.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "compat/physics_effects.h"
#include "pfx/base_level/collision/contact_manifold.h"
#include "pfx/base_level/rigid_body/rigid_state.h"
#include "pfx/low_level/solver/sequential_impulse.h"

using namespace sce::PhysicsEffects;

namespace {

constexpr int kBoxes = 64, kIterations = 5, kVisits = 2, kPushVisits = 2;
constexpr float kStep = 0.016f;

// Boxes that rest on a floor, each touching it alone; pairs and contacts are found once.
struct World {
  std::vector<PfxRigidState> states{kBoxes + 1};
  std::vector<PfxRigidBody> bodies{kBoxes + 1};
  std::vector<PfxCollidable> collidables{kBoxes + 1};
  std::vector<PfxSolverBody> solver_bodies{kBoxes + 1};
  std::vector<PfxContactManifold> contacts{kBoxes};
  std::vector<PfxConstraintPair> pairs{kBoxes};
  std::vector<PfxSortData16> work{1024};

  World() {
    for (PfxUInt16 i = 0; i <= kBoxes; ++i) {
      PfxShape shape;
      shape.setBox(i == 0 ? PfxBox(100, 1, 100) : PfxBox(0.5f, 0.5f, 0.5f));
      collidables[i].addShape(shape);
      collidables[i].finish();
      bodies[i].setInertia(pfxCalcInertiaBox(PfxVector3(0.5f), 1.0f));
      states[i].setPosition(i == 0 ? PfxVector3(0, -1, 0) : PfxVector3(1.5f * static_cast<float>(i % 8), 0.499f, 1.5f * static_cast<float>(i / 8)));
      states[i].setMotionType(i == 0 ? kPfxMotionTypeFixed : kPfxMotionTypeActive);
      states[i].setRigidBodyId(i);
      if (i == 0) continue;
      PfxConstraintPair& pair = pairs[i - 1u];
      pair = {};
      pfxSetRigidBodyIdA(pair, 0), pfxSetRigidBodyIdB(pair, i);
      pfxSetMotionMaskA(pair, states[0].getMotionMask()), pfxSetMotionMaskB(pair, states[i].getMotionMask());
      pfxSetActive(pair, true), pfxSetContactId(pair, i - 1u);
      contacts[i - 1u].reset(0, i);
    }
    PfxDetectCollisionParam detect;
    detect.contactPairs = pairs.data(), detect.numContactPairs = kBoxes, detect.offsetContactManifolds = contacts.data();
    detect.offsetRigidStates = states.data(), detect.offsetCollidables = collidables.data(), detect.numRigidBodies = kBoxes + 1;
    pfxDetectCollision(detect);
  }
};

void solveByStages(World& w) {
  const PfxUInt32 n = kBoxes + 1;
  PfxSetupSolverBodiesParam setup;
  setup.states = w.states.data(), setup.bodies = w.bodies.data(), setup.solverBodies = w.solver_bodies.data(), setup.numRigidBodies = n;
  pfxSetupSolverBodies(setup);
  PfxSetupContactConstraintsParam contact;
  contact.contactPairs = w.pairs.data(), contact.numContactPairs = kBoxes, contact.offsetContactManifolds = w.contacts.data();
  contact.offsetRigidStates = w.states.data(), contact.offsetRigidBodies = w.bodies.data();
  contact.offsetSolverBodies = w.solver_bodies.data(), contact.numRigidBodies = n, contact.timeStep = kStep;
  pfxSetupContactConstraints(contact);
  PfxSolveConstraintsParam solve;
  solve.workBuff = w.work.data(), solve.workBytes = static_cast<PfxUInt32>(w.work.size() * 16);
  solve.contactPairs = w.pairs.data(), solve.numContactPairs = kBoxes, solve.offsetContactManifolds = w.contacts.data();
  solve.offsetRigidStates = w.states.data(), solve.offsetSolverBodies = w.solver_bodies.data();
  solve.numRigidBodies = n, solve.iteration = kIterations;
  pfxSolveConstraints(solve);
}

// The same with records and functions of the engine.
struct NativeWorld {
  std::vector<pfx::RigidState> states;
  std::vector<pfx::ImpulseBody> bodies{kBoxes + 1};
  struct Manifold {
    int count = 0;
    pfx::ContactPoint points[4];
    pfx::ImpulsePoint impulses[4] = {};
    pfx::Vec3 normal = pfx::Vec3::Zero();
  };
  std::vector<Manifold> manifolds{kBoxes};

  explicit NativeWorld(const World& w) {
    for (const PfxRigidState& s : w.states) {
      pfx::RigidState& n = states.emplace_back();
      n.position = {s.getPosition()[0], s.getPosition()[1], s.getPosition()[2]};
      n.motion_type = s.getMotionType() == kPfxMotionTypeFixed ? pfx::MotionType::Fixed : pfx::MotionType::Active;
    }
    for (int i = 0; i < kBoxes; ++i) {
      Manifold& m = manifolds[i];
      m.count = w.contacts[i].getNumContacts();
      for (int k = 0; k < m.count; ++k) {
        const PfxContactPoint& p = w.contacts[i].getContactPoint(k);
        m.points[k].local_a = {p.m_localPointA[0], p.m_localPointA[1], p.m_localPointA[2]};
        m.points[k].local_b = {p.m_localPointB[0], p.m_localPointB[1], p.m_localPointB[2]};
        m.points[k].distance = p.m_distance;
        m.normal = {p.getNormal()[0], p.getNormal()[1], p.getNormal()[2]};
      }
    }
  }
};

void solveNatively(NativeWorld& w) {
  const pfx::Mat3 inv_inertia = pfx::Vec3(6, 6, 6).asDiagonal();
  for (size_t i = 0; i < w.states.size(); ++i) {
    w.bodies[i] = {};
    if (w.states[i].motion_type == pfx::MotionType::Fixed) continue;
    w.bodies[i].inv_mass = 1.0f;
    const pfx::Mat3 r = w.states[i].orientation.toRotationMatrix();
    Eigen::Map<pfx::Mat3>(w.bodies[i].inv_inertia) = r * inv_inertia * r.transpose();
  }
  const pfx::RigidState& a = w.states[0];
  for (size_t i = 0; i < w.manifolds.size(); ++i) {
    const pfx::RigidState& b = w.states[i + 1];
    NativeWorld::Manifold& m = w.manifolds[i];
    for (int k = 0; k < m.count; ++k) {
      const pfx::Vec3 arm_a = a.orientation * m.points[k].local_a, arm_b = b.orientation * m.points[k].local_b;
      const pfx::Vec3 v = a.linear_velocity + a.angular_velocity.cross(arm_a) - b.linear_velocity - b.angular_velocity.cross(arm_b);
      pfx::setupImpulsePoint({arm_a, arm_b, v, m.normal, m.points[k].distance, 0.2f, 0.2f, kStep}, {w.bodies[0], w.bodies[i + 1]}, m.impulses[k]);
    }
  }
  const auto each = [&w](auto&& fn) {
    for (size_t i = 0; i < w.manifolds.size(); ++i) fn(pfx::ImpulsePair{w.bodies[0], w.bodies[i + 1]}, w.manifolds[i]);
  };
  each([](pfx::ImpulsePair pair, NativeWorld::Manifold& m) {
    for (int k = 0; k < m.count; ++k) pfx::warmStart(pair, m.impulses[k]);
  });
  for (int it = 0; it < kIterations; ++it) {
    each([](pfx::ImpulsePair pair, NativeWorld::Manifold& m) {
      for (int visit = 0; visit < kVisits; ++visit)
        for (int k = 0; k < m.count; ++k) pfx::solveImpulses(pair, 0.6f, m.impulses[k]);
    });
  }
  int sweeps = 0;
  for (const NativeWorld::Manifold& m : w.manifolds)
    for (int k = 0; k < m.count; ++k)
      sweeps = std::max(sweeps, m.points[k].distance < -pfx::kSoftOverlap ? kPushVisits * kIterations : m.impulses[k].push_rhs > 0.0f ? 1 : 0);
  for (int i = 0; i < sweeps; ++i) {
    each([](pfx::ImpulsePair pair, NativeWorld::Manifold& m) {
      for (int k = 0; k < m.count; ++k) pfx::solvePush(pair, 0.6f, m.impulses[k]);
    });
  }
  for (size_t i = 1; i < w.states.size(); ++i) {
    w.states[i].linear_velocity += Eigen::Map<pfx::Vec3>(w.bodies[i].dv);
    w.states[i].angular_velocity += Eigen::Map<pfx::Vec3>(w.bodies[i].dw);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: compat_cost compat|native STEPS\n"), 2;
  const bool compat = std::strcmp(argv[1], "compat") == 0;
  const int steps = std::atoi(argv[2]);
  World world;
  NativeWorld native(world);
  for (int i = 0; i < steps; ++i) {
    if (compat) solveByStages(world);
    else solveNatively(native);
  }
  const float v = compat ? world.states[5].getLinearVelocity()[1] : native.states[5].linear_velocity.y();
  std::printf("%.6f\n", static_cast<double>(v));
  return 0;
}

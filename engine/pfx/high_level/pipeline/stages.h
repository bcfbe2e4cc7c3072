// The stages of a step, each a function over what the world holds.
#pragma once

#include "pfx/base_level/memory/containers.h"
#include "pfx/high_level/world/world.h"
#include "pfx/low_level/solver/joint_components.h"

namespace pfx::stage {

void begin(World::Impl& world);              // lists the awake bodies
void findPairsAnew(World::Impl& world);      // pairs and contacts from nothing
void updateTree(World::Impl& world);         // bounds of everything that moved
void updatePairs(World::Impl& world);        // pairs, keeping the contacts of those that stay
void detectCollisions(World::Impl& world);   // manifolds of all pairs
void gatherConstraints(World::Impl& world);  // manifolds to be solved; bodies that fly free
void gatherJoints(World::Impl& world);       // components of joints, and who solves each
void chooseSolvers(World::Impl& world);      // islands that the island solver takes
void flyFree(World::Impl& world);            // bodies without a constraint, in closed form
void solveJointComponents(World::Impl& world);  // components of joints without contacts, alone
void solveNewtonIslands(World::Impl& world);  // those islands, alone
void setUpSolver(World::Impl& world);        // solver bodies and rows
void solve(World::Impl& world);              // the sub-steps
void writeBack(World::Impl& world);          // solver bodies to states
void followKeyframes(World::Impl& world);    // key-frame bodies reach their pose
void storeImpulses(World::Impl& world);      // rows to manifolds, for the next step
void wakeTouched(World::Impl& world);        // islands that something touches wake up
void countGears(World::Impl& world);         // how far soft gears have turned
void breakJoints(World::Impl& world);        // joints beyond their strength are removed
void rememberPoses(World::Impl& world);      // where everything that moves starts from
void stopAtImpacts(World::Impl& world);      // what moves far goes through nothing
void moveParticles(World::Impl& world);       // particle systems, and the bodies that they push
void endMeshMotions(World::Impl& world);      // surfaces that were deformed stand still again
void putToSleep(World::Impl& world);         // islands at rest fall asleep
void noteApproaches(World::Impl& world);     // how fast bodies come together that do not touch yet
void reportEvents(World::Impl& world);       // touches that began and ended, bodies that fell asleep and woke
void keepModifiedImpulses(World::Impl& world);  // of changed manifolds, for the next step

// Parts of other stages.
void dropApart(World::Impl& world, Vector<Pair>& pairs);  // pairs that may not collide; ascending
void modifyContacts(World::Impl& world);                       // lets the application change constraints

// Motion of a body under outer forces, in sub-steps of h seconds.
BodyMotion makeMotion(const World::Impl& world, uint32_t body, float h);

// Whether the world has so many joints that they make do with the cheapest solver.
bool isJointCrowd(const World::Impl& world);

// Fills in the bodies of a component for a step.
void beginComponent(World::Impl& world, JointComponent& component, const DirectStepParams& params);

}  // namespace pfx::stage

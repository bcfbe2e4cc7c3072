// The stages of a step, each a function over what the world holds.
#pragma once

#include "pfx/high_level/world/world.h"

namespace pfx::stage {

void begin(World::Impl& world);              // lists the awake bodies
void findPairsAnew(World::Impl& world);      // pairs and contacts from nothing
void updatePairs(World::Impl& world);        // pairs, keeping the contacts of those that stay
void detectCollisions(World::Impl& world);   // manifolds of all pairs
void gatherConstraints(World::Impl& world);  // manifolds to be solved; bodies that fly free
void flyFree(World::Impl& world);            // bodies without a constraint, in closed form
void setUpSolver(World::Impl& world);        // solver bodies and rows
void solve(World::Impl& world);              // the sub-steps
void writeBack(World::Impl& world);          // solver bodies to states
void followKeyframes(World::Impl& world);    // key-frame bodies reach their pose
void storeImpulses(World::Impl& world);      // rows to manifolds, for the next step
void wakeTouched(World::Impl& world);        // islands that something touches wake up
void putToSleep(World::Impl& world);         // islands at rest fall asleep

}  // namespace pfx::stage

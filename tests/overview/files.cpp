// Chapter 7: a scene is written through the callbacks, changed, and read back; a damaged file says where it is damaged.
// `files FILE` keeps the scene for viewer.cpp.
#include <cmath>
#include <cstring>

#include <physics_effects.h>

#include "check.h"

using namespace sce::PhysicsEffects;

#define NUM_RIGIDBODIES 3

static PfxRigidState states[NUM_RIGIDBODIES];
static PfxRigidBody bodies[NUM_RIGIDBODIES];
static PfxCollidable collidables[NUM_RIGIDBODIES];
static PfxJoint joints[1];
static PfxUInt32 room = NUM_RIGIDBODIES, loaded = 0, lastProgress = 0, lastMax = 0;
static PfxInt32 lastError = SCE_PFX_OK;
static PfxUInt32 lastTags = 0;

static void init(PfxSerializeBuffers& buffers, PfxSerializeCapacity& capacity) {
  buffers.states = states;
  buffers.bodies = bodies;
  buffers.collidables = collidables;
  buffers.joints = joints;
  capacity.numRigidBodies = room;
  capacity.numJoints = 1;
}
static void term(PfxSerializeBuffers&, PfxSerializeCapacity& capacity) { loaded = capacity.numRigidBodies; }
static PfxBool resize(PfxSerializeBuffers&, PfxSerializeCapacity& capacity, const PfxSerializeCapacity& capacityLoaded) {
  if (capacityLoaded.numRigidBodies > NUM_RIGIDBODIES) return false;
  capacity.numRigidBodies = capacityLoaded.numRigidBodies;
  return true;
}
static void update(PfxUInt32 progress, PfxUInt32 max) {
  CHECK(progress >= lastProgress && progress <= max);
  lastProgress = progress;
  lastMax = max;
}
static void error(PfxInt32 code, const char* const* tags, PfxUInt32 numTags) {
  lastError = code;
  lastTags = numTags;
  for (PfxUInt32 i = 0; i < numTags; i++) CHECK(std::strlen(tags[i]) > 0);
}

int main(int argc, char** argv) {
  for (PfxUInt16 i = 0; i < NUM_RIGIDBODIES; i++) {
    PfxShape shape;
    shape.reset();
    shape.setBox(PfxBox(PfxVector3(1.0f + i)));
    collidables[i].reset();
    collidables[i].addShape(shape);
    collidables[i].finish();
    bodies[i].setMass(2.0f + i);
    states[i].reset();
    states[i].setPosition(PfxVector3(1.5f * i, 0.1f, 0.0f));
    states[i].setRigidBodyId(i);
  }
  PfxBallJointInitParam ball;
  CHECK(pfxInitializeBallJoint(joints[0], states[0], states[1], ball) == SCE_PFX_OK);

  PfxSerializeFuncs funcs;
  funcs.initFunc = init;
  funcs.termFunc = term;
  funcs.errorFunc = error;
  std::FILE* file = argc > 1 ? std::fopen(argv[1], "w+") : std::tmpfile();
  CHECK(pfxSerializeWrite(file, funcs) == SCE_PFX_OK);
  std::fputs("behind", file);  // the file stays open

  for (int i = 0; i < NUM_RIGIDBODIES; i++) states[i].reset(), bodies[i].reset(), collidables[i].reset();
  funcs.resizeFunc = resize;
  funcs.updateFunc = update;
  room = 1;
  std::rewind(file);
  CHECK(pfxSerializeRead(file, funcs) == SCE_PFX_OK);
  CHECK(loaded == NUM_RIGIDBODIES);
  CHECK(lastMax > 0 && lastProgress == lastMax);
  for (int i = 0; i < NUM_RIGIDBODIES; i++) {
    CHECK(states[i].getPosition()[0] == 1.5f * i);
    CHECK(states[i].getPosition()[1] == 0.1f);
    CHECK(bodies[i].getMass() == 2.0f + i);
    CHECK(collidables[i].getShape(0).getBox().m_half[0] == 1.0f + i);
  }
  std::fclose(file);

  file = std::tmpfile();
  std::fputs("not a file of this kind", file);
  std::rewind(file);
  CHECK(pfxSerializeRead(file, funcs) != SCE_PFX_OK);
  CHECK(SCE_PFX_FAILED(lastError));
  std::fclose(file);
  return failures == 0 ? 0 : 1;
}

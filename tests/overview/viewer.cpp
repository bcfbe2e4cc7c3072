// Chapters 7 and 8: a debug viewer. Knows nothing of the program that wrote the file: reads whatever bodies and joints are in
// it and draws them. `viewer FILE`; the file of files.cpp has three boxes, two of them on a joint.
#include <cstdlib>

#include <physics_effects.h>

#include "check.h"

using namespace sce::PhysicsEffects;

static PfxSerializeBuffers scene;
static PfxSerializeCapacity loaded;
static int points = 0, lines = 0, aabbs = 0;

static void init(PfxSerializeBuffers&, PfxSerializeCapacity&) {}
static PfxBool resize(PfxSerializeBuffers& buffers, PfxSerializeCapacity& capacity, const PfxSerializeCapacity& capacityLoaded) {
  buffers.states = new PfxRigidState[capacityLoaded.numRigidBodies];
  buffers.bodies = new PfxRigidBody[capacityLoaded.numRigidBodies];
  buffers.collidables = new PfxCollidable[capacityLoaded.numRigidBodies];
  buffers.joints = new PfxJoint[capacityLoaded.numJoints];
  capacity = capacityLoaded;
  scene = buffers;
  return true;
}
static void term(PfxSerializeBuffers&, PfxSerializeCapacity& capacity) { loaded = capacity; }

static void drawPoint(const PfxVector3&, const PfxVector3&) { points++; }
static void drawLine(const PfxVector3&, const PfxVector3&, const PfxVector3&) { lines++; }
static void drawAabb(const PfxVector3& center, const PfxVector3& half, const PfxVector3&) {
  std::printf("box at (%.1f, %.1f, %.1f), %.1f m wide\n", center[0], center[1], center[2], 2.0f * half[0]);
  aabbs++;
}

int main(int argc, char** argv) {
  std::FILE* file = argc > 1 ? std::fopen(argv[1], "r") : NULL;
  if (file == NULL) return 2;
  PfxSerializeFuncs funcs;
  funcs.initFunc = init;
  funcs.termFunc = term;
  funcs.resizeFunc = resize;
  CHECK(pfxSerializeRead(file, funcs) == SCE_PFX_OK);
  std::fclose(file);

  PfxDebugRender render;
  render.setDebugRenderPointFunc(drawPoint);
  render.setDebugRenderLineFunc(drawLine);
  render.setDebugRenderAabbFunc(drawAabb);
  render.resetVisible(loaded.numRigidBodies);
  render.renderAabb(scene.states, scene.collidables, loaded.numRigidBodies);
  render.renderLocalAxis(scene.states, loaded.numRigidBodies);
  render.renderJoint(scene.joints, loaded.numJoints, scene.states);
  CHECK(loaded.numRigidBodies == 3 && loaded.numJoints == 1);
  CHECK(aabbs == 3 && lines == 3 * 3 + 6 && points == 2);
  delete[] scene.states;
  delete[] scene.bodies;
  delete[] scene.collidables;
  delete[] scene.joints;
  return failures == 0 ? 0 : 1;
}

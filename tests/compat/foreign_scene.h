// A scene of the overview's API with every kind of record, made without arithmetic whose result depends on the machine.
#pragma once

#include <cstdio>

#include "tests/compat/terrain.h"

namespace compat_tests {

struct ForeignScene {
  PfxRigidState states[3];
  PfxRigidBody bodies[3];
  PfxCollidable collidables[3];
  PfxShape shapes[2];
  PfxConvexMesh convex;
  PfxLargeTriMesh large;
  PfxJoint joint;
  PfxBroadphasePair pair = {};
  PfxContactManifold contact;

  PfxInt32 create() {
    const PfxFloat corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const PfxUInt16 faces[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    PfxCreateConvexMeshParam param;
    param.verts = corners, param.numVerts = 4, param.triangles = faces, param.numTriangles = 4;
    const PfxInt32 errors = pfxCreateConvexMesh(convex, param) | createRectangle(large, 8.0f, 4.0f);
    PfxShape shape;
    shape.setLargeTriMesh(&large);
    collidables[0].addShape(shape);
    shape.setConvexMesh(&convex);
    collidables[1].addShape(shape);
    static const PfxUInt16 ids[] = {0, 1};
    collidables[2].reset(shapes, ids, 2);
    shape.setSphere(PfxSphere(0.1f));
    shape.setOffsetPosition(PfxVector3(1.0f, 2.0f, 3.0f));
    collidables[2].addShape(shape);
    shape.setCapsule(PfxCapsule(0.3f, 0.7f));
    collidables[2].addShape(shape);
    for (PfxUInt16 i = 0; i < 3; ++i) {
      collidables[i].finish();
      bodies[i].setMass(3.0f), bodies[i].setFriction(0.1f);
      states[i].setPosition(PfxVector3(0.1f, -1e-20f, 16777217.0f));
      states[i].setLinearVelocity(PfxVector3(3e38f, -0.0f, 1.0f / 3.0f));
      states[i].setContactFilterSelf(0x12345678u), states[i].setContactFilterTarget(0xfffffffeu);
      states[i].setMotionType(i == 0 ? kPfxMotionTypeFixed : kPfxMotionTypeActive);
      states[i].setRigidBodyId(i);
    }
    PfxHingeJointInitParam hinge;
    hinge.lowerAngle = -0.5f, hinge.upperAngle = 0.7f;
    const PfxInt32 joint_error = pfxInitializeHingeJoint(joint, states[0], states[1], hinge);
    pfxSetRigidBodyIdA(pair, 1), pfxSetRigidBodyIdB(pair, 2), pfxSetKey(pair, pfxCalcUniqueKey(1, 2));
    pfxSetMotionMaskA(pair, states[1].getMotionMask()), pfxSetMotionMaskB(pair, states[2].getMotionMask()), pfxSetActive(pair, true);
    contact.reset(1, 2);
    contact.addContactPoint(-0.01f, PfxVector3(0, 1, 0), PfxPoint3(0.1f, 0.2f, 0.3f), PfxPoint3(0.4f, 0.5f, 0.6f));
    return errors | joint_error;
  }
  ~ForeignScene() { pfxReleaseLargeTriMesh(large), pfxReleaseConvexMesh(convex); }
};

// The scene that the callbacks work on, as plain functions know no context.
inline ForeignScene*& foreignScene() {
  static ForeignScene* scene = nullptr;
  return scene;
}
inline void setForeignBuffers(PfxSerializeBuffers& b, PfxSerializeCapacity& c) {
  ForeignScene& s = *foreignScene();
  b.states = s.states, b.bodies = s.bodies, b.collidables = s.collidables, b.shapes = s.shapes;
  b.convexMeshes = &s.convex, b.largeTriMeshes = &s.large, b.joints = &s.joint, b.pairs = &s.pair, b.contacts = &s.contact;
  c.numRigidBodies = 3, c.numShapes = 2;
  c.numConvexMeshes = c.numLargeTriMeshes = c.numJoints = c.numPairs = c.numContacts = 1;
}
inline PfxInt32 writeForeignScene(std::FILE* file, ForeignScene& scene) {
  foreignScene() = &scene;
  return pfxSerializeWrite(file, setForeignBuffers);
}

}  // namespace compat_tests

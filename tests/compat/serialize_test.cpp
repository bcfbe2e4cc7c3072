// Chapter 7: serialization through callbacks.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/compat/foreign_scene.h"
#include "tests/compat/scene.h"

using namespace compat_tests;

namespace {

// What the callbacks work on, as plain functions know no context.
struct Calls {
  Scene* scene = nullptr;
  PfxShape shapes[2];
  PfxLargeTriMesh large[1];
  PfxConvexMesh convex[1];
  bool may_resize = true;
  int inits = 0, terms = 0, resizes = 0, errors = 0;
  PfxInt32 code = SCE_PFX_OK;
  std::string place;
  std::vector<PfxUInt32> progress;
  PfxUInt32 most = 0;
  PfxSerializeCapacity loaded;
};
Calls calls;
long long live = 0;

void setBuffers(PfxSerializeBuffers& b, PfxSerializeCapacity& c) {
  Scene& s = *calls.scene;
  b.states = s.states.data(), b.bodies = s.bodies.data(), b.collidables = s.collidables.data();
  b.shapes = calls.shapes, b.largeTriMeshes = calls.large, b.convexMeshes = calls.convex;
  b.joints = s.joints.data(), b.pairs = s.pairs.data(), b.contacts = s.contacts.data();
  c.numRigidBody = static_cast<PfxUInt32>(s.states.size());
  c.numShapes = 2, c.numLargeTriMeshes = 1, c.numConvexMeshes = 1;
  c.numJoints = static_cast<PfxUInt32>(s.joints.size());
  c.numPairs = static_cast<PfxUInt32>(s.pairs.size()), c.numContacts = static_cast<PfxUInt32>(s.contacts.size());
}
void init(PfxSerializeBuffers& b, PfxSerializeCapacity& c) { ++calls.inits, setBuffers(b, c); }
void term(PfxSerializeBuffers&, PfxSerializeCapacity& c) { ++calls.terms, calls.loaded = c; }
PfxBool resize(PfxSerializeBuffers& b, PfxSerializeCapacity& c, const PfxSerializeCapacity& loaded) {
  ++calls.resizes;
  if (!calls.may_resize) return false;
  Scene& s = *calls.scene;
  s.states.resize(loaded.numRigidBodies), s.bodies.resize(loaded.numRigidBodies), s.collidables.resize(loaded.numRigidBodies);
  s.joints.resize(loaded.numJoints), s.pairs.resize(loaded.numPairs), s.contacts.resize(loaded.numContacts);
  setBuffers(b, c);
  return true;
}
void update(PfxUInt32 progress, PfxUInt32 max) { calls.progress.push_back(progress), calls.most = max; }
void error(PfxInt32 code, const char* const* tags, PfxUInt32 numTags) {
  ++calls.errors, calls.code = code, calls.place.clear();
  for (PfxUInt32 i = 0; i < numTags; ++i) calls.place += std::string(i == 0 ? "" : "/") + tags[i];
}

void* countedAlloc(size_t align, size_t size) { return ++live, std::aligned_alloc(align, (size + align - 1) / align * align); }
void* countedRealloc(void*, size_t, size_t) { return nullptr; }
void countedFree(void* p) { --live, std::free(p); }

void createMeshes() {
  static const PfxFloat verts[] = {-5, 0, -5, 5, 0, -5, -5, 0, 5, 5, 0, 5};
  static const PfxUInt16 triangles[] = {0, 2, 1, 1, 2, 3};
  PfxCreateLargeTriMeshParam large;
  large.verts = verts, large.numVerts = 4, large.triangles = triangles, large.numTriangles = 2;
  large.flag = SCE_PFX_MESH_FLAG_USE_BVH | SCE_PFX_MESH_FLAG_USE_QUANTIZED;
  ASSERT_EQ(pfxCreateLargeTriMesh(calls.large[0], large), SCE_PFX_OK);
  static const PfxFloat corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  static const PfxUInt16 faces[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  PfxCreateConvexMeshParam convex;
  convex.verts = corners, convex.numVerts = 4, convex.triangles = faces, convex.numTriangles = 4;
  ASSERT_EQ(pfxCreateConvexMesh(calls.convex[0], convex), SCE_PFX_OK);
}
void releaseMeshes() { pfxReleaseLargeTriMesh(calls.large[0]), pfxReleaseConvexMesh(calls.convex[0]); }

// A mesh ground, a tetrahedron, a compound and two boxes on a joint, some steps old.
void build(Scene& scene) {
  PfxShape shape;
  shape.setLargeTriMesh(&calls.large[0]);
  scene.add(shape, PfxVector3(0.0f), kPfxMotionTypeFixed);
  shape.reset();
  shape.setConvexMesh(&calls.convex[0]);
  scene.add(shape, PfxVector3(2, 1, 0), kPfxMotionTypeActive);
  const PfxUInt16 compound = scene.addBox(PfxVector3(0.5f), PfxVector3(-2, 1, 0), kPfxMotionTypeActive);
  static const PfxUInt16 ids[] = {0, 1};
  ASSERT_EQ(scene.collidables[compound].reset(calls.shapes, ids, 2), SCE_PFX_OK);
  shape.reset();
  shape.setBox(PfxBox(0.5f, 0.25f, 0.5f));
  scene.collidables[compound].addShape(shape);
  shape.setOffsetPosition(PfxVector3(0, 0.5f, 0));
  scene.collidables[compound].addShape(shape);
  ASSERT_EQ(scene.collidables[compound].finish(), SCE_PFX_OK);
  scene.addBox(PfxVector3(0.5f), PfxVector3(0, 3, 0), kPfxMotionTypeFixed);
  scene.addBox(PfxVector3(0.5f), PfxVector3(2, 3, 0), kPfxMotionTypeActive);
  scene.joints.emplace_back();
  PfxHingeJointInitParam hinge;
  hinge.anchorPoint = PfxVector3(0, 3, 0), hinge.axis = PfxVector3(0, 0, 1);
  ASSERT_EQ(pfxInitializeHingeJoint(scene.joints[0], scene.states[3], scene.states[4], hinge), SCE_PFX_OK);
  for (int i = 0; i < 60; ++i) scene.step();
}

class CompatSerialize : public testing::Test {
 protected:
  void SetUp() override {
    live = 0;
    pfxSetUtilityAllocator(countedAlloc, countedRealloc, countedFree);
    calls = Calls();
    createMeshes();
    build(written_);
    calls.scene = &written_;
    file_ = std::tmpfile();
    ASSERT_EQ(pfxSerializeWrite(file_, init, term, error), SCE_PFX_OK);
    ASSERT_EQ(calls.inits, 1);
    ASSERT_EQ(calls.terms, 1);
    ASSERT_EQ(calls.errors, 0);
    length_ = std::ftell(file_);
  }
  void TearDown() override {
    releaseMeshes();
    EXPECT_EQ(live, 0);
    pfxSetUtilityAllocator(nullptr, nullptr, nullptr);
    if (file_ != nullptr) std::fclose(file_);
  }
  // Forgets the meshes that were written, and reads into a scene.
  PfxInt32 readInto(Scene& scene, std::FILE* file) {
    releaseMeshes();
    const bool may_resize = calls.may_resize;
    calls = Calls();
    calls.scene = &scene, calls.may_resize = may_resize;
    std::rewind(file);
    return pfxSerializeRead(file, init, term, resize, update, error);
  }
  std::string text() {
    std::string s(static_cast<size_t>(length_), ' ');
    std::rewind(file_);
    EXPECT_EQ(std::fread(s.data(), 1, s.size(), file_), s.size());
    return s;
  }
  PfxInt32 readText(const std::string& s) {
    std::FILE* file = std::tmpfile();
    std::fwrite(s.data(), 1, s.size(), file);
    Scene scene;
    const PfxInt32 code = readInto(scene, file);
    std::fclose(file);
    return code;
  }

  Scene written_;
  std::FILE* file_ = nullptr;
  long length_ = 0;
};

TEST_F(CompatSerialize, WhatIsReadGoesOnAsWhatWasWritten) {
  // A line of the application behind the data: the library has not closed the file.
  std::fputs("mine\n", file_);
  Scene read;
  ASSERT_EQ(readInto(read, file_), SCE_PFX_OK) << calls.place;
  char line[16];
  std::string rest;
  while (std::fgets(line, sizeof line, file_) != nullptr) rest += line;
  EXPECT_NE(rest.find("mine"), std::string::npos);
  EXPECT_EQ(calls.inits, 1);
  EXPECT_EQ(calls.resizes, 1);
  EXPECT_EQ(calls.terms, 1);
  EXPECT_EQ(calls.errors, 0);
  EXPECT_EQ(calls.loaded.numRigidBody, 5u);
  EXPECT_EQ(calls.loaded.numJoints, 1u);
  EXPECT_GT(live, 0);  // the meshes

  for (int i = 0; i < 60; ++i) read.step();
  const Scene after = read;
  releaseMeshes();
  createMeshes();  // the scene that was written points at these
  for (int i = 0; i < 60; ++i) written_.step();
  for (size_t i = 0; i < written_.states.size(); ++i)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(after.states[i].getPosition()[k], written_.states[i].getPosition()[k]) << i;
}

TEST_F(CompatSerialize, ProgressNeverFallsAndEndsAtItsMaximum) {
  Scene read;
  ASSERT_EQ(readInto(read, file_), SCE_PFX_OK);
  ASSERT_FALSE(calls.progress.empty());
  for (size_t i = 1; i < calls.progress.size(); ++i) EXPECT_LE(calls.progress[i - 1], calls.progress[i]);
  EXPECT_EQ(calls.progress.back(), calls.most);
}

TEST_F(CompatSerialize, WithoutRoomAndWithoutResizingReadingFails) {
  Scene read;
  calls.may_resize = false;
  EXPECT_NE(readInto(read, file_), SCE_PFX_OK);
  EXPECT_EQ(calls.errors, 1);
  EXPECT_EQ(calls.terms, 1);
  EXPECT_EQ(calls.loaded.numRigidBodies, 0u);
  std::rewind(file_);
  EXPECT_NE(pfxSerializeRead(file_, init), SCE_PFX_OK);  // all but init may be left out
}

TEST_F(CompatSerialize, EachKindOfDamageHasItsCode) {
  const std::string good = text();
  const auto with = [&](const std::string& what, const std::string& instead) {
    std::string s = good;
    const size_t at = s.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return s.replace(at, what.size(), instead);
  };
  EXPECT_EQ(readText("nonsense"), SCE_PFX_ERR_SERIALIZE_INVALID_FILE);
  EXPECT_EQ(readText(with("(physics-effects 1", "(physics-effects 9")), SCE_PFX_ERR_SERIALIZE_INVALID_VERSION);
  EXPECT_EQ(readText(with("(linear-velocity", "(linear-velocitx")), SCE_PFX_ERR_SERIALIZE_INVALID_TAG);
  EXPECT_EQ(calls.place.rfind("physics-effects/states/state 0", 0), 0u) << calls.place;
  EXPECT_EQ(readText(with("(body-id 0", "(body-id x")), SCE_PFX_ERR_SERIALIZE_INVALID_FORM);
  EXPECT_EQ(readText(with("(states 5)", "(states 4)")), SCE_PFX_ERR_SERIALIZE_INVALID_COUNT);
  EXPECT_EQ(readText(with("(motion-type 0)", "(motion-type 7)")), SCE_PFX_ERR_SERIALIZE_INVALID_DATA);
  EXPECT_NE(readText(good.substr(0, good.size() / 2)), SCE_PFX_OK);
}

TEST_F(CompatSerialize, AFileThatIsCutAnywhereIsAnErrorAndLoadsNothing) {
  const std::string good = text();
  for (int cut = 0; cut < 37; ++cut) {
    EXPECT_NE(readText(good.substr(0, good.size() * static_cast<size_t>(cut) / 37)), SCE_PFX_OK) << cut;
    EXPECT_EQ(calls.errors, 1);
    EXPECT_EQ(calls.loaded.numRigidBodies, 0u);
    EXPECT_EQ(live, 0) << "memory of meshes of a file that was refused";
  }
}

TEST_F(CompatSerialize, MissingFilesFunctionsAndArraysAreErrors) {
  EXPECT_EQ(pfxSerializeWrite(nullptr, init), SCE_PFX_ERR_INVALID_VALUE);
  EXPECT_EQ(pfxSerializeRead(nullptr, init), SCE_PFX_ERR_INVALID_VALUE);
  EXPECT_EQ(pfxSerializeWrite(file_, nullptr), SCE_PFX_ERR_INVALID_VALUE);
  const PfxSerializeInitFunc numbersWithoutArrays = [](PfxSerializeBuffers&, PfxSerializeCapacity& c) { c.numRigidBodies = 3; };
  EXPECT_NE(pfxSerializeWrite(file_, numbersWithoutArrays), SCE_PFX_OK);
  std::rewind(file_);
  EXPECT_NE(pfxSerializeRead(file_, numbersWithoutArrays), SCE_PFX_OK);
}

// The file was written by tests/support/compat_foreign_writer.cpp, compiled for a machine that puts the highest byte first.
TEST(CompatSerializeForeign, C7_04AFileOfAMachineOfTheOtherByteOrderIsTheSame) {
  std::ifstream in(std::string(VITRINE_SOURCE_DIR) + "/tests/compat/data/big_endian.txt");
  std::stringstream text;
  text << in.rdbuf();
  ForeignScene here, loaded;
  ASSERT_EQ(here.create(), SCE_PFX_OK);
  char* written = nullptr;
  size_t bytes = 0;
  std::FILE* memory = open_memstream(&written, &bytes);
  ASSERT_EQ(writeForeignScene(memory, here), SCE_PFX_OK);
  std::fclose(memory);
  EXPECT_EQ(text.str(), std::string(written, bytes));
  std::free(written);

  std::string file = text.str();
  std::FILE* foreign = fmemopen(file.data(), file.size(), "r");
  foreignScene() = &loaded;
  ASSERT_EQ(pfxSerializeRead(foreign, setForeignBuffers), SCE_PFX_OK);
  std::fclose(foreign);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(loaded.states[i].getPosition()[k], here.states[i].getPosition()[k]);
      EXPECT_EQ(loaded.states[i].getLinearVelocity()[k], here.states[i].getLinearVelocity()[k]);
    }
    EXPECT_EQ(loaded.states[i].getContactFilterSelf(), 0x12345678u);
    EXPECT_EQ(loaded.states[i].getMotionType(), here.states[i].getMotionType());
    EXPECT_EQ(loaded.bodies[i].getFriction(), 0.1f);
    EXPECT_EQ(loaded.collidables[i].getNumShapes(), here.collidables[i].getNumShapes());
  }
  EXPECT_EQ(loaded.large.m_numFacets, 2u);
  EXPECT_EQ(loaded.convex.m_numVerts, 4);
  EXPECT_EQ(loaded.joint.m_constraints[3].m_movableUpperLimit, 0.7f);
  EXPECT_EQ(loaded.contact.getContactPoint(0).m_distance, -0.01f);
}

}  // namespace

// Chapter 3: types, vector math, task manager. Written as the users of the overview write it.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <type_traits>
#include <vector>

// Names of the application that are those of the engine: the API must not mind.
struct RigidState {};
struct Shape {};
[[maybe_unused]] static int pfx = 0;

#include "compat/physics_effects.h"

using namespace sce::PhysicsEffects;

static_assert(sizeof(PfxInt8) == 1 && sizeof(PfxUInt8) == 1 && sizeof(PfxInt16) == 2 && sizeof(PfxUInt16) == 2);
static_assert(sizeof(PfxInt32) == 4 && sizeof(PfxUInt32) == 4 && sizeof(PfxInt64) == 8 && sizeof(PfxUInt64) == 8);
static_assert(std::is_signed<PfxInt32>::value && std::is_unsigned<PfxUInt32>::value);
static_assert(std::is_same<PfxBool, bool>::value && std::is_same<PfxFloat, float>::value);
static_assert(std::is_same<PfxPoint3, sce::Vectormath::Scalar::Aos::Point3>::value);
static_assert(std::is_same<PfxVector3, sce::Vectormath::Scalar::Aos::Vector3>::value);
static_assert(std::is_same<PfxVector4, sce::Vectormath::Scalar::Aos::Vector4>::value);
static_assert(std::is_same<PfxQuat, sce::Vectormath::Scalar::Aos::Quat>::value);
static_assert(std::is_same<PfxMatrix3, sce::Vectormath::Scalar::Aos::Matrix3>::value);
static_assert(std::is_same<PfxMatrix4, sce::Vectormath::Scalar::Aos::Matrix4>::value);
static_assert(std::is_same<PfxTransform3, sce::Vectormath::Scalar::Aos::Transform3>::value);
static_assert(std::is_same<PfxFloatInVec, sce::Vectormath::Scalar::floatInVec>::value);
static_assert(std::is_same<PfxBoolInVec, sce::Vectormath::Scalar::boolInVec>::value);
static_assert(sizeof(PfxSortData16) == 16 && sizeof(PfxSortData32) == 32 && sizeof(PfxBroadphasePair) == 16);
static_assert(std::is_same<PfxBroadphasePair, PfxConstraintPair>::value, "any API takes either kind of pair");

namespace {

TEST(CompatTypes, VectorsHaveTheOperatorsOfTheText) {
  PfxVector3 v(1.0f, 2.0f, 3.0f);
  v = 2.0f * v + PfxVector3(1.0f) - v / 2.0f;
  EXPECT_FLOAT_EQ(v[0], 2.5f);
  EXPECT_FLOAT_EQ(v[2], 5.5f);
  v[1] = 7.0f;
  EXPECT_EQ(v.getY(), 7.0f);
  EXPECT_FLOAT_EQ(mulPerElem(v, PfxVector3(2.0f, 3.0f, 4.0f))[2], 22.0f);
  EXPECT_FLOAT_EQ(dot(PfxVector3::xAxis(), v), 2.5f);
  EXPECT_FLOAT_EQ(cross(PfxVector3::xAxis(), PfxVector3::yAxis())[2], 1.0f);
  const PfxPoint3 p = PfxPoint3(1, 2, 3) + v;
  EXPECT_FLOAT_EQ((p - PfxPoint3(1, 2, 3))[0], 2.5f);
  PfxVector4 w(v, 1.0f);
  w *= 2.0f;
  EXPECT_FLOAT_EQ(w[3], 2.0f);
  const PfxFloatInVec s(0.5f);
  EXPECT_FLOAT_EQ((v * s)[1], 3.5f);
  EXPECT_TRUE(PfxBoolInVec(true) && s < PfxFloatInVec(1.0f));
}

TEST(CompatTypes, RotationsAgreeInAllTheirForms) {
  const PfxQuat q = PfxQuat::rotation(0.7f, normalize(PfxVector3(1, 2, 3)));
  const PfxVector3 v(0.3f, -1.0f, 2.0f), expected = rotate(q, v);
  const PfxMatrix3 m(q);
  const PfxTransform3 t(q, PfxVector3(1, 0, 0));
  const PfxMatrix4 m4(t);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR((m * v)[k], expected[k], 1e-6f);
    EXPECT_NEAR((t * PfxPoint3(v))[k], expected[k] + (k == 0), 1e-6f);
    EXPECT_NEAR((m4 * PfxPoint3(v))[k], expected[k] + (k == 0), 1e-6f);
    EXPECT_NEAR((orthoInverse(t) * (t * PfxPoint3(v)))[k], v[k], 1e-6f);
    EXPECT_NEAR(rotate(PfxQuat(m), v)[k], expected[k], 1e-6f);
    EXPECT_NEAR((affineInverse(m4) * (m4 * PfxPoint3(v)))[k], v[k], 1e-5f);
  }
  EXPECT_NEAR(determinant(m), 1.0f, 1e-6f);
}

TEST(CompatTypes, InversesUndoAndSignsAndRootsGoByElement) {
  PfxMatrix4 m(PfxQuat::rotationX(0.4f), PfxVector3(1, 2, 3));
  m.setElem(1, 3, 0.25f).setElem(3, 3, 2.0f);  // a projection too
  const PfxMatrix4 one = m * inverse(m);
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) EXPECT_NEAR(one[c][r], c == r ? 1.0f : 0.0f, 1e-6f);
  const PfxVector3 signs = copySignPerElem(PfxVector3(1, 2, 3), PfxVector3(-5, 5, -5));
  EXPECT_TRUE(signs[0] == -1.0f && signs[1] == 2.0f && signs[2] == -3.0f);
  EXPECT_FLOAT_EQ(rsqrtPerElem(PfxVector3(4.0f))[1], 0.5f);
  EXPECT_EQ(PfxVector4(PfxQuat(1, 2, 3, 4))[3], 4.0f);
  EXPECT_EQ((PfxVector3(1, 0, 0) + PfxPoint3(2, 0, 0)).getX(), 3.0f);
}

TEST(CompatTypes, MacrosStandWhereTheOldOnesStood) {
  SCE_PFX_ALIGNED(128) static char before[3];
  static SCE_PFX_ALIGNED(128) char between[3];
  static char behind[3] SCE_PFX_ALIGNED(128);
  for (const char* p : {before, between, behind}) EXPECT_TRUE(SCE_PFX_PTR_IS_ALIGNED128(p));
  PfxInt32 a = 1, b = 2;
  SCE_PFX_SWAP(PfxInt32, a, b);
  EXPECT_TRUE(a == 2 && b == 1);
  PfxRigidState state;
  const PfxUInt8 type = kPfxMotionTypeKeyframe;  // as read from a table
  state.setMotionType(type);
  EXPECT_EQ(state.getMotionType(), kPfxMotionTypeKeyframe);
}

TEST(CompatHeapManager, GivesBackInReverseOrderAndRefusesWhatDoesNotFit) {
  SCE_PFX_ALIGNED(128) static unsigned char buffer[1024];
  PfxHeapManager pool(buffer, sizeof buffer);
  const int rest = pool.getRest();
  void* a = pool.allocate(100);
  void* b = pool.allocate(1, 128);
  EXPECT_TRUE(SCE_PFX_PTR_IS_ALIGNED16(a) && SCE_PFX_PTR_IS_ALIGNED128(b));
  EXPECT_GE(static_cast<unsigned char*>(b), static_cast<unsigned char*>(a) + 100);
  const int held = pool.getAllocated();
  EXPECT_EQ(held + pool.getRest(), 1024);
  EXPECT_EQ(pool.allocate(1024), nullptr);
  EXPECT_EQ(pool.allocate(~size_t(0)), nullptr);
  EXPECT_EQ(pool.getAllocated(), held);
  void* c = pool.allocate(static_cast<size_t>(pool.getRest()) - 32);
  ASSERT_NE(c, nullptr);
  std::memset(c, 0xff, static_cast<size_t>(static_cast<unsigned char*>(buffer) + 1024 - static_cast<unsigned char*>(c)) - 32);
  pool.deallocate(c), pool.deallocate(b);
  EXPECT_EQ(pool.allocate(1, 128), b);
  pool.deallocate(b), pool.deallocate(nullptr), pool.deallocate(a);
  EXPECT_EQ(pool.getRest(), rest);
  pool.allocate(500), pool.clear();
  EXPECT_EQ(pool.getAllocated(), 0);
}

TEST(CompatPerfCounter, SectionsLieBetweenEvenAndOddMarks) {
  PfxPerfCounter perf;
  perf.countBegin("one"), perf.countEnd();
  perf.countBegin("two");
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  perf.countEnd();
  EXPECT_EQ(perf.getNumMarks(), 4);
  EXPECT_GE(perf.getCountTime(2), 2.0f);
  EXPECT_LT(perf.getCountTime(0), perf.getCountTime(2));
  EXPECT_EQ(perf.getCountTime(3), 0.0f);
  for (int i = 0; i < 100; ++i) perf.countBegin("more");
  EXPECT_EQ(perf.getNumMarks(), PfxPerfCounter::kMaxMarks);
  perf.resetCount();
  EXPECT_EQ(perf.getCountTime(0), 0.0f);
}

TEST(CompatTypes, ErrorCodesAreNegativeAndDistinct) {
  const PfxInt32 codes[] = {SCE_PFX_ERR_INVALID_VALUE,
                            SCE_PFX_ERR_INVALID_ALIGN,
                            SCE_PFX_ERR_OUT_OF_BUFFER,
                            SCE_PFX_ERR_OUT_OF_MAX_PAIRS,
                            SCE_PFX_ERR_OUT_OF_RANGE,
                            SCE_PFX_ERR_OUT_OF_RANGE_TRIANGLES,
                            SCE_PFX_ERR_OUT_OF_RANGE_ISLANDS,
                            SCE_PFX_ERR_OUT_OF_WORLD,
                            SCE_PFX_ERR_INVALID_FLAG,
                            SCE_PFX_ERR_SERIALIZE_LOADING_FAILED,
                            SCE_PFX_ERR_SERIALIZE_INVALID_COUNT};
  for (const PfxInt32& a : codes) {
    EXPECT_LT(a, SCE_PFX_OK);
    for (const PfxInt32& b : codes) EXPECT_TRUE(&a == &b || a != b);
  }
  EXPECT_EQ(PfxUInt32(SCE_PFX_ERR_SERIALIZE_LOADING_FAILED), 0x80880010u);
  EXPECT_EQ(PfxUInt32(SCE_PFX_ERR_SERIALIZE_INVALID_COUNT), 0x80880018u);
}

TEST(CompatTaskManager, StartsAndStopsAHundredTimes) {
  sceSysmoduleLoadModule(SCE_SYSMODULE_ULT);
  const PfxUInt32 bytes = PfxPsp2TaskManager::getWorkBytes(2);
  void* work = std::aligned_alloc(16, SCE_PFX_BYTES_ALIGN16(bytes));
  std::vector<PfxSortData16> data(1000), scratch(1000);
  for (int i = 0; i < 100; ++i) {
    PfxTaskManager* tasks = new PfxPsp2TaskManager(2, 2, work, bytes);
    ASSERT_EQ(tasks->initialize(), SCE_PFX_OK);
    for (PfxUInt32 k = 0; k < 1000; ++k) pfxSetKey(data[k], 1000 - k);
    EXPECT_EQ(pfxParallelSort(data.data(), 1000, scratch.data(), 16000, tasks), SCE_PFX_OK);
    EXPECT_EQ(pfxGetKey(data[0]), 1u);
    EXPECT_EQ(tasks->finalize(), SCE_PFX_OK);
    delete tasks;
  }
  std::free(work);
  sceSysmoduleUnloadModule(SCE_SYSMODULE_ULT);
}

TEST(CompatTaskManager, RefusesBuffersThatAreMissingShortOrMisaligned) {
  alignas(16) char work[1024];
  EXPECT_EQ(PfxTaskManager(2, 2, nullptr, sizeof work).initialize(), SCE_PFX_ERR_INVALID_VALUE);
  EXPECT_EQ(PfxTaskManager(0, 2, work, sizeof work).initialize(), SCE_PFX_ERR_INVALID_VALUE);
  EXPECT_EQ(PfxTaskManager(2, 2, work + 4, sizeof work - 4).initialize(), SCE_PFX_ERR_INVALID_ALIGN);
  EXPECT_EQ(PfxTaskManager(2, 2, work, 1).initialize(), SCE_PFX_ERR_OUT_OF_BUFFER);
}

TEST(CompatSort, RefusesBuffersThatAreMissingShortOrMisaligned) {
  std::vector<PfxSortData16> data(4), work(4);
  for (PfxUInt32 i = 0; i < 4; ++i) pfxSetKey(data[i], 4 - i);
  EXPECT_EQ(pfxParallelSort(data.data(), 4, nullptr, 64), SCE_PFX_ERR_INVALID_VALUE);
  EXPECT_EQ(pfxParallelSort(data.data(), 4, work.data(), 63), SCE_PFX_ERR_OUT_OF_BUFFER);
  EXPECT_EQ(pfxParallelSort(data.data(), 3, reinterpret_cast<char*>(work.data()) + 4, 60), SCE_PFX_ERR_INVALID_ALIGN);
  EXPECT_EQ(pfxGetKey(data[0]), 4u);  // nothing was sorted
}

}  // namespace

// Serialization of arrays: what goes through a file comes out the same to the bit, every callback is called
// when it should be, and each kind of damage has its own error and its place.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <memory_resource>
#include <sstream>

#include "pfx/util/state_hash/state_hash.h"
#include "tests/files/foreign_scene.h"
#include "tests/files/scene_run.h"
#include "tests/files/world_arrays.h"

namespace {

using namespace pfx;
using files::arraysOf;
using files::readCalls;
using files::SceneVectors;
using files::TextFile;
using files::writeCalls;
using files::written;

// The same scene after some steps, so that there are contacts and impulses.
std::unique_ptr<SceneVectors> sampleArrays(std::string_view target, int steps = 90) {
  samples::RunningScene run(*samples::findScenes(target).front());
  for (int i = 0; i < steps; ++i) run.step();
  return arraysOf(run.world);
}

class SampleArrays : public testing::TestWithParam<const char*> {};

TEST_P(SampleArrays, GoThroughAFileToTheBit) {
  const auto original = sampleArrays(GetParam());
  const TextFile file(written(*original));
  SceneVectors loaded;
  ASSERT_EQ(serializeRead(file.get(), readCalls(loaded)), SerializeError::Ok);
  EXPECT_EQ(hashStates(loaded.states), hashStates(original->states));
  EXPECT_EQ(loaded.manifolds.size(), original->manifolds.size());
  // Everything else: what is loaded is written as the same text, and text gives every bit of a number.
  EXPECT_EQ(written(loaded), written(*original));
}

TEST_P(SampleArrays, GiveAWorldThatMovesLikeTheOriginal) {
  samples::RunningScene run(*samples::findScenes(GetParam()).front());
  const auto original = arraysOf(run.world);
  const TextFile file(written(*original));
  SceneVectors loaded;
  ASSERT_EQ(serializeRead(file.get(), readCalls(loaded)), SerializeError::Ok);
  World worlds[2] = {World({.sleeping = false}), World({.sleeping = false})};
  for (int k = 0; k < 2; ++k) {
    SceneVectors& from = k == 0 ? *original : loaded;
    for (size_t i = 0; i < from.states.size(); ++i) {
      const auto shapes = from.collidables[i].shapes();
      worlds[k].addBody({.pose = from.states[i].pose(),
                         .motion_type = from.states[i].motion_type,
                         .shapes = {shapes.begin(), shapes.end()},
                         .mass = from.bodies[i].mass,
                         .friction = from.bodies[i].friction});
    }
    for (int step = 0; step < 60; ++step) worlds[k].step(1.0f / 60.0f);
  }
  EXPECT_EQ(worlds[0].stateHash(), worlds[1].stateHash());
}

INSTANTIATE_TEST_SUITE_P(Scenes, SampleArrays,
                         testing::Values("1_simple/primitives", "3_sleep/landscape", "6_joint/basic_joints",
                                         "2_stable/landscape"),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           std::ranges::replace(name, '/', '_');
                           return name;
                         });

// One body in full, for tests of values.
SceneVectors oneBody() {
  SceneVectors s;
  s.states.emplace_back();
  s.bodies.emplace_back();
  s.collidables.emplace_back().inline_shape = {Sphere{0.5f}, {}};
  return s;
}

TEST(Serialize, EveryFloatKeepsItsBits) {
  SceneVectors s = oneBody();
  s.joints.emplace_back();  // its axes have an infinite force
  const float odd[] = {std::numeric_limits<float>::denorm_min(),
                       -0.0f,
                       1.0f / 3.0f,
                       16777217.0f,
                       -1e-38f,
                       std::numeric_limits<float>::max(),
                       std::nextafter(1.0f, 2.0f),
                       3.1e-45f};
  for (float x : odd) s.states.emplace_back().position = Vec3(x, -x, x);
  const TextFile file(written(s));
  SceneVectors loaded;
  ASSERT_EQ(serializeRead(file.get(), readCalls(loaded)), SerializeError::Ok);
  EXPECT_EQ(hashStates(loaded.states), hashStates(s.states));
  EXPECT_EQ(loaded.joints[0].axis[0].max_force, std::numeric_limits<float>::infinity());
}

TEST(Serialize, EverySizeOfNumberIsTheSameText) {
  SceneVectors s = oneBody();
  s.states[0].filter_self = 0x80000001u;
  s.states[0].position = Vec3(0.1f, -2.5f, 1e10f);
  const std::string text = written(s);
  EXPECT_NE(text.find("(state (position 0.1 -2.5 1e+10) (orientation 0 0 0 1)"), std::string::npos) << text;
  EXPECT_NE(text.find("(filter-self 2147483649)"), std::string::npos) << text;
}

TEST(Serialize, CallbacksComeInTheirOrder) {
  const auto original = sampleArrays("1_simple/primitives");
  const TextFile file(written(*original));
  SceneVectors loaded;
  std::string calls;
  uint32_t last = 0, most = 0;
  SerializeCallbacks c = readCalls(loaded);
  const auto init = c.init;
  const auto resize = c.resize;
  c.init = [&](SceneArrays& a) { calls += 'i', init(a); };
  c.resize = [&](const SceneCounts& n, SceneArrays& a) {
    calls += 'r';
    EXPECT_EQ(n.states, 7u);
    return resize(n, a);
  };
  c.update = [&](uint32_t progress, uint32_t max) {
    EXPECT_GE(progress, last);
    last = progress, most = max;
  };
  c.term = [&](const SceneCounts& n) {
    calls += 't';
    EXPECT_EQ(n.states, 7u);
    EXPECT_EQ(n.convex_meshes, 1u);
    EXPECT_EQ(n.manifolds, original->manifolds.size());
  };
  c.error = [&](const SerializeFailure&) { calls += 'e'; };
  EXPECT_EQ(serializeRead(file.get(), c), SerializeError::Ok);
  EXPECT_EQ(calls, "irt");
  EXPECT_EQ(last, most);
  EXPECT_GT(most, 0u);
}

TEST(Serialize, RoomThatSufficesIsNotAskedForAgainAndTheRestOfItStays) {
  const auto original = sampleArrays("1_simple/primitives", 0);
  const TextFile file(written(*original));
  SceneVectors loaded;
  loaded.resize({10, 10, 10, 10, 10, 10, 10, 10, 40, 40});
  loaded.states[9].position = Vec3(4.0f, 5.0f, 6.0f);
  SerializeCallbacks c = readCalls(loaded);
  c.resize = {};
  EXPECT_EQ(serializeRead(file.get(), c), SerializeError::Ok);
  EXPECT_EQ(hashStates(std::span(loaded.states).first(7)), hashStates(original->states));
  EXPECT_EQ(loaded.states[9].position, Vec3(4.0f, 5.0f, 6.0f));
}

struct Outcome {
  SerializeError error = SerializeError::Ok;
  std::string place;
  uint32_t terminated_with = 99;  // states
  bool changed = false;
};

// Reads into arrays that are there already, and looks whether they changed.
Outcome readText(const std::string& text, bool may_resize = true) {
  SceneVectors target = oneBody();
  target.states[0].position = Vec3(1.0f, 2.0f, 3.0f);
  const uint64_t before = hashStates(target.states);
  Outcome out;
  SerializeCallbacks c = readCalls(target);
  if (!may_resize) c.resize = [](const SceneCounts&, SceneArrays&) { return false; };
  c.error = [&](const SerializeFailure& f) { out.place = describe(f); };
  c.term = [&](const SceneCounts& n) { out.terminated_with = n.states; };
  const TextFile file(text);
  out.error = serializeRead(file.get(), c);
  out.changed = hashStates(target.states) != before;
  return out;
}

// The text of a small scene with `from` replaced by `to`.
std::string changed(const std::string& from, const std::string& to) {
  SceneVectors s = oneBody();
  std::string text = written(s);
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from << " is not in\n" << text;
  return text.replace(at, from.size(), to);
}

struct Damage {
  std::string from, to;
  SerializeError error;
  std::string place;
};

class DamagedDocument : public testing::TestWithParam<Damage> {};

TEST_P(DamagedDocument, HasItsOwnErrorWithThePlaceAndChangesNothing) {
  const Outcome out = readText(changed(GetParam().from, GetParam().to));
  EXPECT_EQ(out.error, GetParam().error) << toString(out.error);
  EXPECT_EQ(out.place, GetParam().place);
  EXPECT_EQ(out.terminated_with, 0u);
  EXPECT_FALSE(out.changed);
}

INSTANTIATE_TEST_SUITE_P(
    All, DamagedDocument,
    testing::Values(
        Damage{"(pfx-scene", "(someone-elses", SerializeError::File, "not a file of this kind"},
        Damage{"(pfx-scene 1", "(pfx-scene 2", SerializeError::Version,
               "line 1: pfx-scene: the file is of another version"},
        Damage{"(position 0 0 0)", "(position 0 0 0", SerializeError::Parenthesis,
               "line 10: pfx-scene > states > state 0 > position: a closing parenthesis is missing"},
        Damage{"(position 0 0 0)", "position 0 0 0)", SerializeError::Parenthesis,
               "line 10: pfx-scene > states > state 0 > position: an opening parenthesis is missing"},
        Damage{"(mass 1)", "(maas 1)", SerializeError::Tag,
               "line 13: pfx-scene > bodies > body 0 > mass: the group has another tag"},
        Damage{"(mass 1)", "(mass one)", SerializeError::Form,
               "line 13: pfx-scene > bodies > body 0 > mass: this is not a number of the right kind"},
        Damage{"(mass 1)", "(mass 1e99)", SerializeError::Form,
               "line 13: pfx-scene > bodies > body 0 > mass: a number is too large or too small"},
        Damage{"(mass 1)", "(mass nan)", SerializeError::Data,
               "line 13: pfx-scene > bodies > body 0 > mass: a number is not one (NaN)"},
        Damage{"(mass 1)", "(mass -1)", SerializeError::Data,
               "line 13: pfx-scene > bodies > body 0: a mass is negative or not finite"},
        Damage{"(mass 1)", "(mass 2)", SerializeError::Data,
               "line 14: pfx-scene > bodies > check: the check sum is wrong: something in this array was "
               "changed"},
        Damage{"(motion-type 1)", "(motion-type 9)", SerializeError::Data,
               "line 10: pfx-scene > states > state 0 > motion-type: a kind is unknown"},
        Damage{"(bodies 1)", "(bodies 2)", SerializeError::Count,
               "line 12: pfx-scene > bodies: the number differs from the one at the beginning"}),
    [](const auto& damage) { return std::to_string(damage.index); });

TEST(Serialize, ARecordTooManyOrTooFewIsCounted) {
  SceneVectors s = oneBody();
  const std::string text = written(s);
  const size_t begin = text.find("(body (mass"), end = text.find("\n", begin) + 1;
  std::string more = text, less = text;
  more.insert(begin, text.substr(begin, end - begin));
  less.erase(begin, end - begin);
  EXPECT_EQ(readText(more).error, SerializeError::Count);
  EXPECT_EQ(readText(more).place, "line 13: pfx-scene > bodies: there are more records than announced");
  EXPECT_EQ(readText(less).error, SerializeError::Count);
  EXPECT_EQ(readText(less).place, "line 12: pfx-scene > bodies: there are fewer records than announced");
}

TEST(Serialize, AnIndexOfNothingIsRefusedEvenWhenTheSumIsRight) {
  SceneVectors s = oneBody();
  s.joint_pairs.push_back({0, 1, 0, 0});
  const TextFile file;
  std::string place;
  SerializeCallbacks c = writeCalls(s);
  c.error = [&](const SerializeFailure& f) { place = describe(f); };
  EXPECT_EQ(serializeWrite(file.get(), c), SerializeError::Data);
  EXPECT_EQ(place, "pfx-scene > joint-pairs > joint-pair 0: a pair names a body that is not there");
  EXPECT_EQ(file.text(), "") << "nothing is written of a scene that cannot be";
}

TEST(Serialize, WhatIsNotANumberIsNotWritten) {
  SceneVectors s = oneBody();
  s.states[0].linear_velocity.y() = std::numeric_limits<float>::quiet_NaN();
  const TextFile file;
  EXPECT_EQ(serializeWrite(file.get(), writeCalls(s)), SerializeError::Data);
  EXPECT_EQ(file.text(), "");
}

TEST(Serialize, WithoutAFileOrAnInitFunctionItIsAnError) {
  SceneVectors s = oneBody();
  const TextFile file(written(s));
  EXPECT_EQ(serializeWrite(nullptr, writeCalls(s)), SerializeError::File);
  EXPECT_EQ(serializeRead(nullptr, readCalls(s)), SerializeError::File);
  EXPECT_EQ(serializeWrite(file.get(), {}), SerializeError::Data);
  EXPECT_EQ(serializeRead(file.get(), {}), SerializeError::Data);
}

TEST(Serialize, AFileThatCannotBeWrittenOrReadIsAnError) {
  SceneVectors s = oneBody();
  std::FILE* full = std::fopen("/dev/full", "w");
  if (full != nullptr) {
    EXPECT_EQ(serializeWrite(full, writeCalls(s)), SerializeError::Saving);
    std::fclose(full);
  }
  const TextFile closed_for_reading(written(s));
  std::FILE* folder = std::fopen(VITRINE_SOURCE_DIR, "r");
  if (folder != nullptr) {
    EXPECT_EQ(serializeRead(folder, readCalls(s)), SerializeError::Loading);
    std::fclose(folder);
  }
}

TEST(Serialize, ABufferThatIsNotEnlargedIsAnErrorAndChangesNothing) {
  const auto original = sampleArrays("1_simple/primitives", 0);
  const Outcome out = readText(written(*original), false);
  EXPECT_EQ(out.error, SerializeError::Loading);
  EXPECT_EQ(out.place, "pfx-scene > convex-meshes: the buffers are too small for the file");
  EXPECT_EQ(out.terminated_with, 0u);
  EXPECT_FALSE(out.changed);
}

TEST(Serialize, TheFileStaysOpenBehindTheDocument) {
  SceneVectors s = oneBody();
  const TextFile file;
  ASSERT_EQ(serializeWrite(file.get(), writeCalls(s)), SerializeError::Ok);
  std::fputs("score 42", file.get());
  std::rewind(file.get());
  ASSERT_EQ(serializeRead(file.get(), readCalls(s)), SerializeError::Ok);
  int score = 0;
  EXPECT_EQ(std::fscanf(file.get(), " score %d", &score), 1);
  EXPECT_EQ(score, 42);
}

TEST(Serialize, LineEndsOfOtherPlatformsDoNotMatter) {
  SceneVectors s = oneBody();
  std::string text;
  for (const char c : written(s)) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(readText(text).error, SerializeError::Ok);
}

// Counts what is taken and given back.
class CountedMemory : public std::pmr::memory_resource {
 public:
  size_t bytes = 0, most = 0;

 private:
  void* do_allocate(size_t size, size_t alignment) override {
    bytes += size, most = std::max(most, bytes);
    return std::pmr::new_delete_resource()->allocate(size, alignment);
  }
  void do_deallocate(void* place, size_t size, size_t alignment) override {
    bytes -= size;
    std::pmr::new_delete_resource()->deallocate(place, size, alignment);
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

// C7-19, C7-20 without the overview's names: the memory of large meshes is the default resource's, and is given back with
// the array that the application read them into.
TEST(Serialize, MeshesThatAreReadTakeTheMemoryThatTheApplicationNames) {
  const std::string text = written(*sampleArrays("2_stable/landscape", 0));
  CountedMemory memory;
  std::pmr::memory_resource* before = std::pmr::set_default_resource(&memory);
  {
    SceneVectors loaded;
    const TextFile file(text);
    EXPECT_EQ(serializeRead(file.get(), readCalls(loaded)), SerializeError::Ok);
    ASSERT_EQ(loaded.large_meshes.size(), 1u);
    // 128 triangles: vertices, facets and the hierarchy over them.
    EXPECT_GT(memory.bytes, 128u * 16u);
  }
  std::pmr::set_default_resource(before);
  EXPECT_EQ(memory.bytes, 0u);
  EXPECT_GT(memory.most, 0u);
}

// The file was written by foreign_writer.cpp, compiled for a machine of 64 bits that puts the highest byte
// first.
TEST(Serialize, AFileOfAMachineOfTheOtherByteOrderIsTheSame) {
  std::ifstream in(std::string(VITRINE_SOURCE_DIR) + "/tests/files/data/big_endian.scene");
  std::stringstream text;
  text << in.rdbuf();
  SceneVectors here = files::foreignScene(), loaded;
  EXPECT_EQ(text.str(), written(here));
  const TextFile file(text.str());
  ASSERT_EQ(serializeRead(file.get(), readCalls(loaded)), SerializeError::Ok);
  EXPECT_EQ(hashStates(loaded.states), hashStates(here.states));
}

}  // namespace

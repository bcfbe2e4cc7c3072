// Scene files: every sample goes through one unchanged, and a mistake is named with its place.
#include "pfx/high_level/scene_file/scene_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "tests/files/scene_run.h"

namespace {

using namespace pfx;
using samples::RunningScene;
using samples::SceneEntry;

class SampleScene : public testing::TestWithParam<SceneEntry> {};

TEST_P(SampleScene, GoesThroughAFileUnchangedAndContinuesTheSame) {
  RunningScene original(GetParam()), script(GetParam());
  World loaded;
  loadScene(SceneText{.xml = writeScene(original.world)}, loaded);
  ASSERT_EQ(loaded.stateHash(), original.world.stateHash());
  EXPECT_EQ(writeScene(loaded), writeScene(original.world));
  for (int i = 0; i < 60; ++i) {
    original.step();
    script.stepIn(loaded);
    ASSERT_EQ(loaded.stateHash(), original.world.stateHash()) << "step " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(All, SampleScene, testing::ValuesIn(samples::scenes().begin(), samples::scenes().end()),
                         [](const auto& scene) { return samples::testName(scene.param); });

constexpr std::string_view kTwoBodies = R"(<scene version="1">
  <world gravity="0 -9.8 0"/>
  <body id="post" motion="fixed"><box half-extent="0.5 2 0.5"/></body>
  <body id="arm" position="2 2 0" mass="3"><capsule half-length="1" radius="0.1"/></body>
  JOINT
</scene>)";

std::string withJoint(const std::string& joint) {
  std::string text(kTwoBodies);
  return text.replace(text.find("JOINT"), 5, joint);
}

World load(const std::string& xml) {
  World world;
  loadScene(SceneText{.xml = xml, .name = "test.xml"}, world);
  return world;
}

std::string errorOf(const std::string& xml) {
  try {
    load(xml);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "no error";
}

TEST(SceneFile, EveryKindOfJointIsReadAndWrittenWithAllItsParameters) {
  const std::string kinds[] = {
      R"(<ball body-a="post" body-b="arm" anchor="0.6 2 0" damping="0.1" bias="0.5"/>)",
      R"(<swing-twist body-a="post" body-b="arm" anchor="0.6 2 0" axis="1 0 0" twist-lower="-0.3" swing-upper="0.4"/>)",
      R"(<hinge body-a="post" body-b="arm" anchor="0.6 2 0" axis="0 0 1" lower="-1" upper="0.5"/>)",
      R"(<slider body-a="post" body-b="arm" axis="1 0 0" lower="-0.5" upper="0.5"/>)",
      R"(<fixed body-a="post" body-b="arm" break-force="100" break-torque="20" bodies-collide="true"/>)",
      R"(<universal body-a="post" body-b="arm" axis="1 0 0" up="0 0 1" swing1-lower="-0.2"/>)",
      R"(<distance body-a="post" body-b="arm" anchor-a="0 2 0" anchor-b="1 2 0" spring-frequency="2"/>)",
      R"(<gear body-a="post" body-b="arm" axis-a="0 1 0" axis-b="1 0 0" ratio="-2.5"/>)"};
  for (const std::string& kind : kinds) {
    const World world = load(withJoint(kind));
    ASSERT_EQ(world.counts().joints, 1u) << kind;
    const std::string written = writeScene(world);
    EXPECT_EQ(writeScene(load(written)), written) << kind;
  }
}

TEST(SceneFile, AHingeReadsLikeTheOneMadeInCode) {
  const World world = load(withJoint(
      R"(<hinge name="elbow" body-a="post" body-b="arm" anchor="0.6 2 0" axis="0 0 1" lower="-1" upper="0.5"/>)"));
  const Joint made = makeHingeJoint(world.states()[0], world.states()[1],
                                    {.anchor_point = Vec3(0.6f, 2.0f, 0.0f),
                                     .axis = Vec3::UnitZ(),
                                     .lower_angle = -1.0f,
                                     .upper_angle = 0.5f});
  const Joint& read = world.joints()[0];
  EXPECT_EQ(world.jointName(0), "elbow");
  EXPECT_EQ(read.kind, JointKind::Hinge);
  EXPECT_EQ(read.anchor_b, made.anchor_b);
  EXPECT_EQ(read.frame_a.coeffs(), made.frame_a.coeffs());
  EXPECT_EQ(read.axis[3].lower, -1.0f);
  EXPECT_EQ(read.axis[3].upper, 0.5f);
}

TEST(SceneFile, AnAxisElementAddsAMotor) {
  const World world = load(withJoint(R"(<hinge body-a="post" body-b="arm" axis="0 0 1">
    <axis name="twist" motor-speed="2" motor-max-force="50"/></hinge>)"));
  EXPECT_EQ(world.joints()[0].axis[3].motor_speed, 2.0f);
  EXPECT_EQ(world.joints()[0].axis[3].motor_max_force, 50.0f);
}

TEST(SceneFile, FloatsKeepTheirBits) {
  World world;
  const float tiny = std::numeric_limits<float>::denorm_min(), third = 1.0f / 3.0f;
  world.addBody({.name = "a<b>&\"c\"",
                 .pose = {.position = Vec3(tiny, third, -1e30f)},
                 .linear_velocity = Vec3(std::nextafter(1.0f, 2.0f), -0.0f, 16777217.0f),
                 .shapes = {Shape{Sphere{0.1f}, {}}, Shape{Box{Vec3(0.1f, 0.2f, 0.3f)}, {.position = Vec3(third, 0.0f, 0.0f)}}},
                 .mass = 0.7f,
                 .filter_self = 0xfffffffeu});
  const World loaded = load(writeScene(world));
  EXPECT_EQ(loaded.stateHash(), world.stateHash());
  EXPECT_EQ(loaded.name(0), world.name(0));
  EXPECT_EQ(loaded.bodies()[0].inertia, world.bodies()[0].inertia);
  EXPECT_EQ(loaded.states()[0].filter_self, 0xfffffffeu);
}

TEST(SceneFile, AMaterialGivesItsBodiesTheirSurface) {
  const World world = load(R"(<scene><material id="ice" friction="0.02"/>
    <body material="ice"><sphere/></body><body material="ice" friction="0.3"><sphere/></body></scene>)");
  EXPECT_EQ(world.bodies()[0].friction, 0.02f);
  EXPECT_EQ(world.bodies()[1].friction, 0.3f);
}

struct Mistake {
  std::string xml, message;
};

class SceneMistake : public testing::TestWithParam<Mistake> {};

TEST_P(SceneMistake, IsNamedWithItsPlace) { EXPECT_EQ(errorOf(GetParam().xml), GetParam().message); }

INSTANTIATE_TEST_SUITE_P(
    All, SceneMistake,
    testing::Values(
        Mistake{"<scene>\n<bodi/>\n</scene>", "test.xml:2: <bodi>: unknown element \"bodi\"; did you mean \"body\"?"},
        Mistake{"<scene>\n\n<body masss='1'><sphere/></body></scene>",
                "test.xml:3: <body>: unknown attribute \"masss\"; did you mean \"mass\"?"},
        Mistake{"<scene>\n<body><sphere radius='big'/></body></scene>",
                "test.xml:2: <sphere>: radius: \"big\" is not a number"},
        Mistake{"<scene>\n<body><sphere radius='nan'/></body></scene>",
                "test.xml:2: <sphere>: radius: \"nan\" is not a number"},
        Mistake{"<scene>\n<body position='1 2'><sphere/></body></scene>",
                "test.xml:2: <body>: position has 2 numbers, must have 3"},
        Mistake{"<scene>\n<body motion='activ'><sphere/></body></scene>",
                "test.xml:2: <body>: unknown value of motion \"activ\"; did you mean \"active\"?"},
        Mistake{"<scene>\n<body mass='-1' name='b'><sphere/></body></scene>",
                "test.xml:2: <body>: body \"b\": mass = -1.000000 kg, must be > 0"},
        Mistake{"<scene>\n<body/></scene>", "test.xml:2: <body>: the body has no shape"},
        Mistake{"<scene>\n<body><sphere/>\n</scene>", "test.xml:3: Start-end tags mismatch"},
        Mistake{"<scene version='9'/>", "test.xml:1: <scene>: version 9, this program reads 1"},
        Mistake{"<scene>\n<convex-mesh id='m'><vertices>\n0 0 0\n1 0 zero\n</vertices></convex-mesh></scene>",
                "test.xml:4: <vertices>: \"zero\" is not a number"},
        Mistake{"<scene>\n<convex-mesh id='m'><vertices>0 0 0 1 0 0 0 1 0</vertices></convex-mesh></scene>",
                "test.xml:2: <convex-mesh>: the input is degenerate"},
        Mistake{"<scene>\n<large-mesh id='m'><vertices>0 0 0 1 0 0 0 1 0</vertices>"
                "<triangles>0 1 3</triangles></large-mesh></scene>",
                "test.xml:2: <large-mesh>: a value is out of range (number 0)"},
        Mistake{"<scene>\n<body><large-mesh mesh='m'/></body></scene>",
                "test.xml:2: <large-mesh>: there is no mesh \"m\" before this line"},
        Mistake{"<scene>\n<ball body-a='a' body-b='b'/></scene>",
                "test.xml:2: <ball>: there is no body with the id \"a\" before this line"},
        Mistake{"<scene>\n<large-mesh id='m' file='missing.obj'/></scene>", "missing.obj: cannot be opened"}));

TEST(SceneFile, AnErrorLeavesTheWorldAsItIs) {
  World world = load(withJoint(""));
  world.step(1.0f / 60.0f);
  const uint64_t before = world.stateHash();
  EXPECT_THROW(loadScene(SceneText{.xml = "<scene><body><sphere radius='-1'/></body></scene>"}, world), SceneError);
  EXPECT_EQ(world.stateHash(), before);
  EXPECT_EQ(world.stepCount(), 1u);
}

class ObjFile : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void write(const char* name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / "vitrine_obj_file_test";
};

TEST_F(ObjFile, NextToTheSceneGivesItsTriangles) {
  write("quad.obj", "# two triangles\nv 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nvn 0 1 0\nf 1//1 2//1 -2 4/1/1\n");
  write("scene.xml",
        "<scene><large-mesh id='q' file='quad.obj'/><body motion='fixed'><large-mesh mesh='q'/></body></scene>");
  World world;
  loadScene(folder_ / "scene.xml", world);
  const auto* mesh = std::get<const LargeMesh*>(world.collidables()[0].shapes()[0].geometry);
  EXPECT_EQ(mesh->numFacets(), 2u);
  EXPECT_FLOAT_EQ(mesh->surface_bounds.max.x(), 1.0f);
}

TEST_F(ObjFile, WithAMistakeIsNamedWithItsLine) {
  write("bad.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n");
  write("scene.xml", "<scene><large-mesh id='q' file='bad.obj'/></scene>");
  World world;
  try {
    loadScene(folder_ / "scene.xml", world);
    FAIL() << "the face uses a vertex that is not there";
  } catch (const SceneError& e) {
    EXPECT_EQ(std::string(e.what()),
              (folder_ / "bad.obj").string() + ":3: the face uses vertex 3, there are 2 so far");
  }
}

}  // namespace

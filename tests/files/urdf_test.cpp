// URDF files become the bodies and joints that they describe.
#include "pfx/high_level/scene_file/urdf_reader.h"

#include <gtest/gtest.h>

#include "pfx/base_level/joint/joint_coordinates.h"

namespace {

using namespace pfx;

std::filesystem::path armFile() { return std::filesystem::path(VITRINE_SOURCE_DIR) / "samples/11_xml_import/arm.urdf"; }

uint32_t bodyNamed(const World& world, std::string_view name) {
  for (uint32_t i = 0; i < world.states().size(); ++i)
    if (world.name(i) == name) return i;
  throw std::logic_error("no body of this name");
}

class Urdf : public testing::Test {
 protected:
  void SetUp() override {
    if (!canReadUrdf()) GTEST_SKIP() << "built without liburdfdom";
  }
};

TEST_F(Urdf, LinksStandWhereTheyDoWhenAllJointsAreAtZero) {
  World world;
  buildScene(readUrdf(armFile()), world);
  EXPECT_EQ(world.counts().bodies, 5u) << "the tool point is only a name";
  EXPECT_EQ(world.counts().joints, 4u);
  // Heights along z of the file, which is y here: of the centres of mass.
  EXPECT_NEAR(world.states()[bodyNamed(world, "turret")].position.y(), 0.5f, 1e-5f);
  EXPECT_NEAR(world.states()[bodyNamed(world, "upper arm")].position.y(), 1.2f, 1e-5f);
  EXPECT_NEAR(world.states()[bodyNamed(world, "forearm")].position.y(), 2.1f, 1e-5f);
  EXPECT_NEAR(world.states()[bodyNamed(world, "hand")].position.y(), 2.6f, 1e-5f);
  EXPECT_EQ(world.states()[bodyNamed(world, "base")].motion_type, MotionType::Fixed);
  EXPECT_EQ(world.bodies()[bodyNamed(world, "upper arm")].mass, 6.0f);
  EXPECT_EQ(world.collidables()[bodyNamed(world, "hand")].shapes().size(), 3u);
  // Half lengths out of whole ones, and a cylinder that stands upright.
  const Collidable& turret = world.collidables()[bodyNamed(world, "turret")];
  const Aabb box = transformedAabb(world.states()[bodyNamed(world, "turret")].pose(), turret.center, turret.half_extent);
  // The rim of a cylinder that is tilted by the rounding of a float rises by the root of that: 3e-4 of its radius.
  EXPECT_NEAR(box.max.y() - box.min.y(), 0.4f, 3e-4f);
  EXPECT_NEAR(box.max.x() - box.min.x(), 0.44f, 3e-4f);
}

TEST_F(Urdf, JointsTurnAboutTheirAxesWithinTheirLimits) {
  World world;
  buildScene(readUrdf(armFile()), world);
  uint32_t shoulder = 0;
  while (world.jointName(shoulder) != "shoulder") ++shoulder;
  const AxisConstraint& axis = world.joints()[shoulder].axis[3];
  EXPECT_EQ(axis.lock, JointLock::Limit);
  EXPECT_EQ(axis.lower, -1.6f);
  EXPECT_EQ(axis.upper, 1.6f);
  // A positive turn about y of the file (-z here) takes what points up towards x.
  Joint& joint = world.joint(world.jointId(shoulder));
  joint.axis[3].spring_frequency = 3.0f;
  joint.axis[3].spring_damping = 1.0f;
  joint.axis[3].spring_target = 1.0f;
  for (int i = 0; i < 120; ++i) world.step(1.0f / 60.0f);
  EXPECT_GT(world.states()[bodyNamed(world, "upper arm")].position.x(), 0.3f);
  for (uint32_t i = 0; i < world.joints().size(); ++i) EXPECT_LT(world.jointError(i).distance, 1e-3f) << world.jointName(i);
}

TEST_F(Urdf, InertiaIsTurnedFromItsOwnAxesToThoseOfTheLink) {
  const std::string text = R"(<robot name="r"><link name="a">
    <inertial><origin xyz="0.1 0 0" rpy="0 0 1.5707963"/><mass value="2"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="3" iyz="0" izz="2.5"/></inertial>
    <collision><geometry><sphere radius="0.5"/></geometry></collision></link></robot>)";
  World world;
  buildScene(readUrdf(SceneText{.xml = text, .name = "r.urdf"}, {.position = Vec3::Zero(), .fixed_root = false}), world);
  const Mat3 inertia = world.bodies()[0].inertia;
  EXPECT_NEAR(inertia(0, 0), 3.0f, 1e-5f);
  EXPECT_NEAR(inertia(1, 1), 1.0f, 1e-5f);
  EXPECT_NEAR(inertia(2, 2), 2.5f, 1e-5f);
  EXPECT_NEAR(world.collidables()[0].shapes()[0].offset.position.x(), -0.1f, 1e-6f) << "from the centre of mass";
}

// Where there is no liburdfdom the sample shows arm.xml instead.
TEST_F(Urdf, TheArmAsASceneFileIsTheSameToTheBit) {
  World urdf, xml;
  buildScene(readUrdf(armFile()), urdf);
  loadScene(armFile().replace_extension(".xml"), xml);
  EXPECT_EQ(writeScene(xml), writeScene(urdf));
  for (int i = 0; i < 60; ++i) urdf.step(1.0f / 60.0f), xml.step(1.0f / 60.0f);
  EXPECT_EQ(xml.stateHash(), urdf.stateHash());
}

std::string errorOf(const std::string& text) {
  try {
    readUrdf(SceneText{.xml = text, .name = "r.urdf"});
  } catch (const SceneError& e) {
    return e.what();
  }
  return "no error";
}

TEST_F(Urdf, AMistakeIsNamedWithItsPlace) {
  EXPECT_EQ(errorOf("<robot name='r'>\n<link name='a'>\n</robot>"), "r.urdf:3: Start-end tags mismatch");
  EXPECT_EQ(errorOf(R"(<robot name="r"><link name="a"/><link name="b"><collision><geometry><sphere radius="1"/></geometry>
    </collision></link><joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint></robot>)"),
            "r.urdf: link \"b\": has no <inertial>, so its mass is not known");
  const std::string missing = errorOf(R"(<robot name="r"><link name="a"/><joint name="j" type="fixed"><parent link="a"/>
    <child link="nobody"/></joint></robot>)");
  EXPECT_TRUE(missing.starts_with("r.urdf: ")) << missing;
  EXPECT_NE(missing.find("nobody"), std::string::npos) << missing;
  EXPECT_EQ(errorOf(R"(<robot name="r"><link name="a"><collision><geometry><mesh filename="a.stl"/></geometry></collision></link></robot>)"),
            "r.urdf: link \"a\": the mesh \"a.stl\" is no OBJ file");
}

TEST(UrdfMissing, IsAnErrorThatSaysSo) {
  if (canReadUrdf()) GTEST_SKIP() << "built with liburdfdom";
  EXPECT_NE(errorOf("<robot/>").find("liburdfdom"), std::string::npos);
}

}  // namespace

// Recordings: what is written is read back, and damaged files are errors.
#include "viewer/run/recording.h"

#include <gtest/gtest.h>

#include "pfx/base_level/shape/primitives.h"
#include "viewer/input_error.h"

namespace golden_tests {
using namespace viewer;

pfx::World fallingSpheres(int count) {
  pfx::World world;
  for (int i = 0; i < count; ++i) {
    pfx::BodyDef def;
    def.pose.position = pfx::Vec3(2.0f * float(i), 5.0f, 0.0f);
    def.angular_velocity = pfx::Vec3(1.0f, 2.0f, 3.0f);
    def.shapes = {pfx::Shape{pfx::Sphere{0.5f}, {}}};
    world.addBody(def);
  }
  return world;
}

struct FallScene final : samples::Scene {
  void build(pfx::World& world) override { world = fallingSpheres(3); }
};

std::vector<uint8_t> recordFall(int steps) {
  SceneSpec spec;
  spec.sample = "1_simple", spec.name = "falling";
  spec.make = [] { return std::make_unique<FallScene>(); };
  SceneRun run(spec);
  RecordingWriter writer({.target = spec.target(),
                          .dt = 1.0f / 60.0f,
                          .substeps = 4,
                          .parameters = {2.5f},
                          .inputs = {{1, ThrowBall{pfx::Vec3(1, 2, 3), pfx::Vec3(4, 5, 6), 0.5f}},
                                     {1, Pull{2, pfx::Vec3(1, 0, 0), pfx::Vec3(0, 9, 0)}},
                                     {4, samples::Controls{.right = 1.0f, .heading = 2.0f, .jump = true}},
                                     {5, pfx::SolverSettings{9, pfx::JointSolver::Soft, pfx::ContactSolver::Newton}}}});
  for (int i = 0; i <= steps; ++i) {
    run.stepTo(uint64_t(i));
    writer.add(captureFrame(run));
  }
  return writer.bytes();
}

TEST(Recording, EveryFrameComesBackInAnyOrder) {
  const Recording recording(recordFall(10), "fall");
  EXPECT_EQ(recording.head().target, "1_simple/falling");
  EXPECT_EQ(recording.head().substeps, 4u);
  ASSERT_EQ(recording.numFrames(), 11u);
  pfx::World reference = fallingSpheres(3);
  for (int i = 0; i < 7; ++i) reference.step(1.0f / 60.0f);
  const RecordedFrame frame = recording.frame(7);
  EXPECT_EQ(frame.step, 7u);
  EXPECT_EQ(frame.state_hash, reference.stateHash());
  EXPECT_EQ(recording.frame(0).step, 0u);
  EXPECT_THROW(recording.frame(11), std::out_of_range);

  pfx::World other = fallingSpheres(3);
  applyFrame(other, frame);
  EXPECT_EQ(other.stateHash(), reference.stateHash());
}

TEST(Recording, InputsAndParametersComeBack) {
  const Recording recording(recordFall(2), "fall");
  const RecordingHead& head = recording.head();
  EXPECT_EQ(head.parameters, std::vector<float>{2.5f});
  ASSERT_EQ(head.inputs.size(), 4u);
  EXPECT_EQ(std::get<ThrowBall>(head.inputs[0].what).velocity, pfx::Vec3(4, 5, 6));
  EXPECT_EQ(std::get<Pull>(head.inputs[1].what).target, pfx::Vec3(0, 9, 0));
  EXPECT_EQ(std::get<Pull>(head.inputs[1].what).body, 2u);
  EXPECT_EQ(head.inputs[2].step, 4u);
  const auto& steered = std::get<samples::Controls>(head.inputs[2].what);
  EXPECT_EQ(steered.heading, 2.0f);
  EXPECT_TRUE(steered.jump && !steered.run && !steered.crouch);
  EXPECT_EQ(std::get<pfx::SolverSettings>(head.inputs[3].what),
            (pfx::SolverSettings{9, pfx::JointSolver::Soft, pfx::ContactSolver::Newton}));
}

TEST(Recording, AnotherNumberOfBodiesIsAnError) {
  const Recording recording(recordFall(1), "fall");
  pfx::World other = fallingSpheres(2);
  EXPECT_THROW(applyFrame(other, recording.frame(0)), InputError);
}

TEST(Recording, TruncatedAndDamagedFilesAreErrors) {
  const std::vector<uint8_t> bytes = recordFall(2);
  for (size_t length = 0; length < bytes.size(); ++length)
    EXPECT_THROW(Recording({bytes.begin(), bytes.begin() + std::ptrdiff_t(length)}, "cut"), InputError)
        << length;
  for (size_t bit = 0; bit < bytes.size() * 8; bit += 3) {
    std::vector<uint8_t> damaged = bytes;
    damaged[bit / 8] ^= uint8_t(1u << bit % 8);
    EXPECT_THROW(Recording(damaged, "bit"), InputError) << "bit " << bit;
  }
}

}  // namespace golden_tests

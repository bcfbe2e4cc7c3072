// Free rotation against what it must keep: momentum and energy, for slender bodies and fast ones.
#include "pfx/base_level/rigid_body/rotation_update.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace pfx;

double energy(const Rotation& r, const Mat3& moments) {
  const Vec3 w = r.orientation.conjugate() * r.angular_velocity;
  return 0.5 * static_cast<double>(w.dot(moments * w));
}

// A rod a hundred times as long as wide has moments 1 : 10^4. An error in its direction becomes a spin ten thousand
// times as large.
TEST(RotationUpdate, SlenderAndFastBodiesKeepTheirEnergy) {
  for (const float ratio : {2.0f, 10.0f, 100.0f, 1e4f})
    for (const float spin : {0.0f, 10.0f, 100.0f, 1000.0f}) {
      Mat3 moments = Mat3::Zero();
      moments.diagonal() = Vec3(1.0f / ratio, 1.0f, 1.01f);
      const Inertia inertia = makeInertia(moments);
      Rotation r{Quat::Identity(), Vec3(spin, 20, 5)};
      const double start = energy(r, moments);
      const Vec3 momentum = moments * r.angular_velocity;
      double worst = 0.0;
      constexpr int kSteps = 2400;
      for (int i = 0; i < kSteps; ++i) {
        r = advanceRotation(r, inertia, 1.0f / 240.0f);
        worst = std::max(worst, std::abs(energy(r, moments) / start - 1.0));
      }
      const Mat3 turn = r.orientation.toRotationMatrix();
      const Vec3 end = turn * (moments * (turn.transpose() * r.angular_velocity));
      EXPECT_LT(worst, 0.05) << "ratio " << ratio << ", spin " << spin;
      // What a step keeps is a velocity, rounded: half an ulp of the spin, times the largest moment.
      const float rounding = 6e-8f * kSteps * spin;
      EXPECT_LT((end - momentum).norm(), rounding + 2e-3f * momentum.norm()) << "ratio " << ratio << ", spin " << spin;
    }
}

// The axis of a symmetric top goes round its momentum at the rate L / I, in closed form.
TEST(RotationUpdate, AFastTopPrecessesAtItsRate) {
  Mat3 moments = Mat3::Zero();
  moments.diagonal() = Vec3(1e-3f, 1.0f, 1.0f);
  const Inertia inertia = makeInertia(moments);
  Rotation r{Quat::Identity(), Vec3(5000, 6, 0)};
  const Vec3 momentum = moments * r.angular_velocity;
  constexpr int kSteps = 240;
  for (int i = 0; i < kSteps; ++i) r = advanceRotation(r, inertia, 1.0f / 240.0f);
  const Vec3 expected = expMap(momentum) * Vec3::UnitX();  // one second
  EXPECT_LT((r.orientation * Vec3::UnitX() - expected).norm(), 0.02f);
}

}  // namespace

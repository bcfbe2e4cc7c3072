// ACC-01 to ACC-03: bodies that nothing touches.
#include "pfx/base_level/math/trig.h"
#include "samples/accuracy/case.h"
#include "samples/accuracy/integrate.h"
#include "samples/accuracy/rotation.h"

namespace samples::accuracy {
namespace {

using namespace pfx;

// A thrown ball: p0 + v0 t + g t^2 / 2.
struct Flight final : Run {
  const Vec3d v0 = Vec3d(3, 10, -2), w0 = Vec3d(1, 2, 3);
  double time = 0.0;

  void build(World& world) override {
    world.addBody({.name = "ball",
                   .linear_velocity = v0.cast<float>(),
                   .angular_velocity = w0.cast<float>(),
                   .shapes = {{.geometry = Sphere{0.5f}}}});
  }
  void advance(double dt) override { time += dt; }
  std::vector<Truth> truth() const override {
    const Vec3d p = v0 * time + 0.5 * time * time * Vec3d(0, -double(kGravity), 0);
    return {{0, {.position = p, .orientation = turn(time * w0)}}};
  }
  double error(std::span<const BodyMotion> bodies) const override {
    return (bodies[0].pose.position - truth()[0].pose.position).norm();
  }
};

// A box with the moments of inertia 1, 2 and 2.5 kg m^2, spinning freely. Its angular momentum L is constant, so
// that its orientation alone has to be integrated: q' = w q / 2 with w = R I^-1 R^T L.
struct FreeTop final : Run {
  explicit FreeTop(const Vec3d& spin) : w0(spin) {}
  const Vec3d w0, moments = Vec3d(1, 2, 2.5);
  Eigen::Vector4d q = Eigen::Vector4d(0, 0, 0, 1);  // x, y, z, w

  void build(World& world) override {
    world.addBody({.name = "top",
                   .angular_velocity = w0.cast<float>(),
                   .shapes = {{.geometry = Box{Vec3(1.3228756555f, 0.8660254038f, 0.5f)}}},
                   .mass = 3.0f});
  }
  void advance(double dt) override {
    const Vec3d momentum = moments.cwiseProduct(w0);
    q = rungeKutta(q, dt, 32, [&](const Eigen::Vector4d& c) {
          const Quatd at = Quatd(c).normalized();
          const Vec3d w = at * (at.conjugate() * momentum).cwiseQuotient(moments);
          return orientationRate(w, c);
        }).normalized();
  }
  std::vector<Truth> truth() const override { return {{0, {.orientation = Quatd(q)}}}; }
  double error(std::span<const BodyMotion> bodies) const override {
    return angleBetween(Quatd(q), bodies[0].pose.orientation);
  }
};

}  // namespace

// The floors of the tops are 10 kappa eps, with the growth kappa of a small error (34 and 487) and eps = 6e-8; that of
// the flight is what 180 roundings of a place 14 m away add up to.
std::vector<Case> freeMotionCases() {
  return {
      {.id = "ACC-01",
       .name = "flight",
       .shows = "a thrown ball is where its parabola is",
       .metric = "position",
       .unit = "m",
       .target = 1e-4,
       .floor = 5e-5,
       .seconds = 3,
       .smooth = true,
       .make = [] { return std::unique_ptr<Run>(std::make_unique<Flight>()); },
       .free = true},
      {.id = "ACC-02",
       .name = "free_top",
       .shows = "a box of three different moments of inertia tumbles freely",
       .metric = "attitude",
       .unit = "rad",
       .target = 5e-4,
       .floor = 2e-5,
       .seconds = 10,
       .smooth = true,
       .make = [] { return std::unique_ptr<Run>(std::make_unique<FreeTop>(Vec3d(1, 2, 3))); },
       .front_page = true,
       .free = true,
       .gravity = Vec3::Zero()},
      {.id = "ACC-03",
       .name = "flipping_top",
       .shows = "spun about its middle axis, the box turns over every 4.55 s",
       .metric = "attitude",
       .unit = "rad",
       .target = 0.02,
       .floor = 3e-4,
       .seconds = 10,
       .smooth = true,
       .make = [] { return std::unique_ptr<Run>(std::make_unique<FreeTop>(Vec3d(0.2, 5, 0.2))); },
       .free = true,
       .gravity = Vec3::Zero()},
  };
}

}  // namespace samples::accuracy

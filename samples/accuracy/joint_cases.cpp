// ACC-04, 05, 07, 08 and 09: rods and chains on joints, and a top on a ball joint.
#include "samples/accuracy/case.h"
#include "samples/accuracy/integrate.h"
#include "samples/accuracy/planar_chain.h"
#include "samples/accuracy/rotation.h"

namespace samples::accuracy {
namespace {

using namespace pfx;

BodyId addPost(World& world) {
  return world.addBody({.name = "post",
                        .motion_type = MotionType::Fixed,
                        .shapes = {{.geometry = Box{Vec3::Constant(0.02f)}}},
                        .filter_self = 0});
}

// A rod along its own y axis that collides with nothing.
BodyId addRod(World& world, const ChainShape& rod, const Vec3d& at, double angle) {
  const Vec3d half = 0.5 * Vec3d(rod.width, rod.length, rod.width);
  return world.addBody({.name = "rod",
                        .pose = {.position = at.cast<float>(), .orientation = turnZ(angle).cast<float>()},
                        .shapes = {{.geometry = Box{half.cast<float>()}}},
                        .mass = static_cast<float>(rod.mass),
                        .filter_self = 0});
}

// Rods in a row, released at rest; bodies 1 .. links, then the ball when it has a mass.
struct ChainRun : Run {
  ChainRun(const ChainShape& shape_in, double angle, int steps_a_frame, bool hinges_in)
      : shape(shape_in), chain(shape_in, angle), start(angle), steps(steps_a_frame), hinges(hinges_in) {}

  void build(World& world) override {
    BodyId last = addPost(world);
    for (int i = 0; i < shape.links; ++i) {
      const BodyId next = addRod(world, shape, chain.middle(i), start);
      join(world, last, next, chain.joint(i));
      last = next;
    }
    if (shape.ball_mass == 0.0) return;
    const Vec3 end = chain.joint(shape.links).cast<float>();
    const BodyId ball = world.addBody({.name = "ball",
                                       .pose = {.position = end, .orientation = turnZ(start).cast<float>()},
                                       .shapes = {{.geometry = Sphere{static_cast<float>(shape.ball_radius)}}},
                                       .mass = static_cast<float>(shape.ball_mass),
                                       .filter_self = 0});
    world.addJoint({.body_a = last, .body_b = ball, .params = FixedJointParams{.anchor_point = end}});
  }
  void advance(double dt) override { chain.advance(dt, steps); }
  std::vector<Truth> truth() const override {
    std::vector<Truth> all;
    for (int i = 0; i < shape.links; ++i)
      all.push_back({static_cast<uint32_t>(i + 1), {chain.middle(i), turnZ(chain.angle(i))}});
    if (shape.ball_mass > 0.0)
      all.push_back({static_cast<uint32_t>(shape.links + 1),
                     {chain.joint(shape.links), turnZ(chain.angle(shape.links - 1))}});
    return all;
  }
  void join(World& world, BodyId a, BodyId b, const Vec3d& at) const {
    const Vec3 anchor = at.cast<float>();
    if (hinges)
      world.addJoint(
          {.body_a = a, .body_b = b, .params = HingeJointParams{.anchor_point = anchor, .axis = Vec3::UnitZ()}});
    else
      world.addJoint({.body_a = a, .body_b = b, .params = BallJointParams{.anchor_point = anchor}});
  }

  const ChainShape shape;
  PlanarChain chain;
  const double start;
  const int steps;
  const bool hinges;
};

// Judged by the largest error of an angle.
struct Pendulum final : ChainRun {
  Pendulum(int links, double angle) : ChainRun({.links = links}, angle, 64, true) {}
  double error(std::span<const BodyMotion> bodies) const override {
    double worst = 0.0;
    for (int i = 0; i < shape.links; ++i) {
      const double off = wrapped(angleAboutZ(bodies[size_t(i) + 1].pose.orientation) - chain.angle(i));
      if (std::abs(off) > std::abs(worst)) worst = off;
    }
    return worst;
  }
};

// Ten links of 0.1 kg and a ball, released from horizontal; judged by the place of the ball.
struct HeavyChain final : ChainRun {
  explicit HeavyChain(double ball_mass)
      : ChainRun({.links = 10, .length = 0.2, .width = 0.04, .mass = 0.1, .ball_mass = ball_mass, .ball_radius = 0.2},
                 0.5 * kPiDouble, 128, false) {}
  double error(std::span<const BodyMotion> bodies) const override {
    return (bodies[11].pose.position - chain.joint(10)).norm();
  }
};

// A hundred links between two points at 0.8 of its length, started where they hang in equilibrium: link i has the
// slope W (i + 1/2 - n/2) / H, and H follows from the span.
struct Catenary final : Run {
  static constexpr int kLinks = 100;
  static constexpr double kLength = 0.1, kMass = 0.05, kPull = 16.5883588538047;  // m, kg, N
  std::vector<Vec3d> nodes = {Vec3d::Zero()};
  std::vector<double> angles;

  Catenary() {
    for (int i = 0; i < kLinks; ++i) {
      const double slope = kMass * double(kGravity) * (i + 0.5 - 0.5 * kLinks) / kPull;
      const Vec3d along = Vec3d(1, slope, 0).normalized();
      nodes.push_back(nodes.back() + kLength * along);
      angles.push_back(pfx::atan2(along.x(), -along.y()));
    }
  }
  Vec3d middle(int i) const { return 0.5 * (nodes[size_t(i)] + nodes[size_t(i) + 1]); }

  void build(World& world) override {
    const BodyId post = addPost(world);
    BodyId last = post;
    const ChainShape rod{.length = kLength, .width = 0.02, .mass = kMass};
    for (int i = 0; i <= kLinks; ++i) {
      const BodyId next = i < kLinks ? addRod(world, rod, middle(i), angles[size_t(i)]) : post;
      world.addJoint({.body_a = last,
                      .body_b = next,
                      .params = BallJointParams{.anchor_point = nodes[size_t(i)].cast<float>()}});
      last = next;
    }
  }
  void advance(double) override {}
  std::vector<Truth> truth() const override {
    std::vector<Truth> all;
    for (int i = 0; i < kLinks; ++i) all.push_back({uint32_t(i + 1), {middle(i), turnZ(angles[size_t(i)])}});
    return all;
  }
  double error(std::span<const BodyMotion> bodies) const override {
    double worst = 0.0;
    for (int i = 0; i < kLinks; ++i)
      worst = std::max(worst, (bodies[size_t(i) + 1].pose.position - middle(i)).norm());
    return worst;
  }
};

// A disc whose centre is 0.5 m from a ball joint, spun at 120 rad/s and let go at 60 degrees: it nutates in cusps.
// The momentum L about the joint changes by the moment of the weight.
struct HeavyTop final : Run {
  static constexpr double kArm = 0.5, kMass = 2.0, kSpin = 120.0;
  const Vec3d moments = Vec3d(0.0625, 0.0316666666666667 + kMass * kArm * kArm, 0.0316666666666667 + kMass * kArm * kArm);
  Eigen::Vector<double, 7> state;  // orientation x, y, z, w; L

  HeavyTop() {
    const Vec3d axis(0.0, 0.5, 0.86602540378443865);
    state << Quatd::FromTwoVectors(Vec3d::UnitX(), axis).coeffs(), moments[0] * kSpin * axis;
  }
  static Quatd orientation(const Eigen::Vector<double, 7>& s) { return Quatd(s.head<4>().eval()).normalized(); }
  Vec3d axis() const { return orientation(state) * Vec3d::UnitX(); }

  void build(World& world) override {
    const BodyId post = addPost(world);
    const BodyId top = world.addBody({.name = "top",
                                      .pose = {(kArm * axis()).cast<float>(), orientation(state).cast<float>()},
                                      .angular_velocity = (kSpin * axis()).cast<float>(),
                                      .shapes = {{.geometry = Cylinder{0.025f, 0.25f}}},
                                      .mass = static_cast<float>(kMass),
                                      .filter_self = 0});
    world.addJoint({.body_a = post, .body_b = top, .params = BallJointParams{}});
  }
  void advance(double dt) override {
    state = rungeKutta(state, dt, 512, [&](const Eigen::Vector<double, 7>& s) {
      const Quatd q = orientation(s);
      const Vec3d w = q * (q.conjugate() * s.tail<3>()).cwiseQuotient(moments);
      const Vec3d arm = kArm * (q * Vec3d::UnitX());
      Eigen::Vector<double, 7> rate;
      rate << orientationRate(w, s.head<4>()), arm.cross(Vec3d(0, -kMass * double(kGravity), 0));
      return rate;
    });
    state.head<4>().normalize();
  }
  std::vector<Truth> truth() const override { return {{1, {kArm * axis(), orientation(state)}}}; }
  double error(std::span<const BodyMotion> bodies) const override {
    return angleBetween(bodies[1].pose.orientation * Vec3d::UnitX(), axis());
  }
};

template <class T, auto... arguments>
std::unique_ptr<Run> make() {
  return std::make_unique<T>(arguments...);
}

}  // namespace

std::vector<Case> jointCases() {
  return {
      {.id = "ACC-04",
       .name = "heavy_top",
       .shows = "a disc spinning at 120 rad/s on a ball joint is let go and nutates",
       .metric = "axis",
       .unit = "rad",
       .target = 0.05,
       .floor = 1e-5,
       .seconds = 5,
       .smooth = true,
       .make = make<HeavyTop>},
      {.id = "ACC-05",
       .name = "pendulum",
       .shows = "a rod on a hinge, released from horizontal, for ten seconds",
       .metric = "angle",
       .unit = "rad",
       .target = 5e-3,
       .floor = 1e-5,
       .seconds = 10,
       .smooth = true,
       .make = make<Pendulum, 1, 0.5 * kPiDouble>,
       .front_page = true},
      {.id = "ACC-07",
       .name = "double_pendulum",
       .shows = "two rods, released from horizontal, for two seconds",
       .metric = "angle",
       .unit = "rad",
       .target = 5e-3,
       .floor = 1e-5,
       .seconds = 2,
       .smooth = true,
       .make = make<Pendulum, 2, 0.5 * kPiDouble>},
      {.id = "ACC-08",
       .name = "chain",
       .shows = "ten links and a ball as heavy as a link swing for a second",
       .metric = "tip",
       .unit = "m",
       .target = 0.02,
       .floor = 1e-5,
       .seconds = 1,
       .smooth = true,
       .make = make<HeavyChain, 0.1>},
      {.id = "ACC-08",
       .name = "heavy_chain",
       .shows = "ten links hold a ball of a thousand times the mass of a link",
       .metric = "tip",
       .unit = "m",
       .target = 0.02,
       .floor = 1e-5,
       .seconds = 1,
       .smooth = true,
       .make = make<HeavyChain, 100.0>,
       .front_page = true},
      {.id = "ACC-09",
       .name = "catenary",
       .shows = "a hundred links hang between two points in exact equilibrium",
       .metric = "deviation",
       .unit = "m",
       .target = 1e-3,
       .floor = 1e-4,
       .seconds = 5,
       .smooth = true,
       .make = make<Catenary>},
  };
}

}  // namespace samples::accuracy

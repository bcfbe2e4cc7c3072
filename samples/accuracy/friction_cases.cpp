// ACC-11 to ACC-16: sliding, sticking, rolling, spinning and bouncing on a floor.
#include "samples/accuracy/case.h"
#include "samples/accuracy/integrate.h"
#include "samples/accuracy/rotation.h"

namespace samples::accuracy {
namespace {

using namespace pfx;

struct Surface {
  float friction = 0.0f, restitution = 0.0f;
};

void addFloor(World& world, const Surface& surface) {
  world.addBody({.name = "floor",
                 .pose = {.position = {0.0f, -1.0f, 0.0f}},
                 .motion_type = MotionType::Fixed,
                 .shapes = {{.geometry = Box{{20.0f, 1.0f, 20.0f}}}},
                 .restitution = surface.restitution,
                 .friction = surface.friction});
}

// Body 1 on body 0, the floor. Moved by friction alone, its velocity changes along one straight line, for as long
// as it slides.
struct SlidingRun : Run {
  double time = 0.0, stop = 0.0;                                // s, time when the friction changes
  Vec3d v0 = Vec3d::Zero(), slip = Vec3d::Zero(), centre = Vec3d::Zero();  // slip: unit, direction of sliding
  double deceleration = 0.0;                                    // m/s^2

  void advance(double dt) override { time += dt; }
  Vec3d position() const {
    const double t = std::min(time, stop), rest = time - t;
    const Vec3d v1 = v0 - deceleration * stop * slip;
    return centre + v0 * t - 0.5 * deceleration * t * t * slip + v1 * rest;
  }
  std::vector<Truth> truth() const override { return {{1, {.position = position()}}}; }
  Vec3d deviation(std::span<const BodyMotion> bodies) const { return bodies[1].pose.position - position(); }
};

// A box of 1 x 0.5 x 1 m, at 5 m/s along x with friction 0.3. Judged by the way relative to v^2 / (2 mu g).
struct SlidingBox final : SlidingRun {
  static constexpr double kSpeed = 5.0, kFriction = 0.3;
  SlidingBox() {
    v0 = Vec3d(kSpeed, 0, 0), slip = Vec3d::UnitX(), centre = Vec3d(0, 0.25, 0);
    deceleration = kFriction * double(kGravity), stop = kSpeed / deceleration;
  }
  void build(World& world) override {
    addFloor(world, {.friction = float(kFriction)});
    world.addBody({.name = "box",
                   .pose = {.position = centre.cast<float>()},
                   .linear_velocity = v0.cast<float>(),
                   .shapes = {{.geometry = Box{{0.5f, 0.25f, 0.5f}}}},
                   .restitution = 0.0f,
                   .friction = float(kFriction)});
  }
  double error(std::span<const BodyMotion> bodies) const override {
    return deviation(bodies).x() / (0.5 * kSpeed * stop);
  }
};

// The same box at rest on a slope of atan(0.5) - 1 degree: it stays. Judged by how far it creeps.
struct StickingBox final : SlidingRun {
  void build(World& world) override {
    centre = Vec3d(0, 0.25, 0);
    addFloor(world, {.friction = 0.5f});
    world.addBody({.name = "box",
                   .pose = {.position = centre.cast<float>()},
                   .shapes = {{.geometry = Box{{0.5f, 0.25f, 0.5f}}}},
                   .restitution = 0.0f,
                   .friction = 0.5f});
  }
  double error(std::span<const BodyMotion> bodies) const override { return deviation(bodies).x(); }
};

// A ball on the floor: the point of contact slides along u = v + w x (-r y), and friction turns neither u nor itself,
// so that the centre runs along a parabola until u is used up. Judged by the place.
struct Ball final : SlidingRun {
  const double radius, friction;
  const Vec3d w0;
  Ball(double r, double mu, const Vec3d& v, const Vec3d& w) : radius(r), friction(mu), w0(w) {
    v0 = v, centre = Vec3d(0, r, 0);
    const Vec3d u = v + w.cross(Vec3d(0, -r, 0));
    slip = u.normalized(), deceleration = mu * double(kGravity), stop = u.norm() / (3.5 * deceleration);
  }
  void build(World& world) override {
    addFloor(world, {.friction = float(friction)});
    world.addBody({.name = "ball",
                   .pose = {.position = centre.cast<float>()},
                   .linear_velocity = v0.cast<float>(),
                   .angular_velocity = w0.cast<float>(),
                   .shapes = {{.geometry = Sphere{float(radius)}}},
                   .restitution = 0.0f,
                   .friction = float(friction)});
  }
  double error(std::span<const BodyMotion> bodies) const override { return deviation(bodies).norm(); }
};

// A disc that slides and spins: each element of its face, under uniform pressure, is slowed against its own motion.
// Sliding and spinning end together. Source: Z. Farkas et al., Phys. Rev. Lett. 90, 248302, 2003.
struct Puck final : Run {
  static constexpr double kRadius = 0.1, kHalfHeight = 0.005, kFriction = 0.3, kSpeed = 2.0, kSpin = 30.0;
  Eigen::Vector4d state = Eigen::Vector4d(0, kSpeed, 0, kSpin);  // x, v, angle, w

  void build(World& world) override {
    addFloor(world, {.friction = float(kFriction)});
    world.addBody({.name = "puck",
                   .pose = {.position = Vec3(0, float(kHalfHeight), 0), .orientation = upright().cast<float>()},
                   .linear_velocity = Vec3(float(kSpeed), 0, 0),
                   .angular_velocity = Vec3(0, float(kSpin), 0),
                   .shapes = {{.geometry = Cylinder{float(kHalfHeight), float(kRadius)}}},
                   .restitution = 0.0f,
                   .friction = float(kFriction)});
  }
  static Quatd upright() { return turnZ(0.5 * kPiDouble); }

  // Mean over the disc of the direction of motion, and of its moment, by the midpoint rule in rings and sectors.
  static Eigen::Vector4d rate(const Eigen::Vector4d& s) {
    constexpr int kRings = 32, kSectors = 64;
    double force = 0.0, moment = 0.0;
    for (int i = 0; i < kRings; ++i) {
      const double r = (i + 0.5) / kRings * kRadius, weight = 2.0 * r / (kRadius * kRings * kRadius);
      for (int k = 0; k < kSectors; ++k) {
        const Vec3d& ring = directions()[size_t(k)];
        const double ux = s[1] + s[3] * r * ring.y(), uy = -s[3] * r * ring.x();
        const double speed = std::sqrt(ux * ux + uy * uy) + 1e-12;
        force += weight * kRadius / kSectors * ux / speed;
        moment += weight * kRadius / kSectors * r * (ux * ring.y() - uy * ring.x()) / speed;
      }
    }
    const double limit = kFriction * double(kGravity);
    return {s[1], -limit * force, s[3], -limit * moment / (0.5 * kRadius * kRadius)};
  }
  static const std::vector<Vec3d>& directions() {
    static const std::vector<Vec3d> table = [] {
      std::vector<Vec3d> all;
      for (int k = 0; k < 64; ++k) {
        const SinCosDouble t = sincos((k + 0.5) / 32.0 * kPiDouble);
        all.emplace_back(t.cos, t.sin, 0.0);
      }
      return all;
    }();
    return table;
  }
  void advance(double dt) override {
    for (int i = 0; i < 4 && state[1] > 0.0; ++i) {
      const Eigen::Vector4d next = rungeKutta(state, 0.25 * dt, 1, rate);
      if (next[1] <= 0.0 || next[3] <= 0.0) {
        state[1] = state[3] = 0.0;
        break;
      }
      state = next;
    }
  }
  std::vector<Truth> truth() const override {
    return {{1, {Vec3d(state[0], kHalfHeight, 0), turn(Vec3d(0, state[2], 0)) * upright()}}};
  }
  // Of the way, relative to the whole of it; the spin shows in the picture and in the way.
  double error(std::span<const BodyMotion> bodies) const override {
    constexpr double kDistance = 1.0880617;  // m
    return (bodies[1].pose.position.x() - state[0]) / kDistance;
  }
};

// A ball dropped from 1 m that keeps 0.8 of its speed. Judged by the height that its energy reaches, while it is in
// the middle of one of the first three flights, relative to 0.64^k.
struct Bounce final : Run {
  static constexpr double kRadius = 0.25, kHeight = 1.0, kKept = 0.8;
  double time = 0.0;

  void build(World& world) override {
    addFloor(world, {.restitution = float(kKept)});
    world.addBody({.name = "ball",
                   .pose = {.position = Vec3(0, float(kRadius + kHeight), 0)},
                   .shapes = {{.geometry = Sphere{float(kRadius)}}},
                   .restitution = float(kKept),
                   .friction = 0.0f});
  }
  void advance(double dt) override { time += dt; }

  struct Flight {
    int number;            // 0: the fall
    double since, length;  // s
    double apex;           // m
  };
  Flight flight() const {
    const double g = double(kGravity);
    Flight f{0, 0.0, std::sqrt(2.0 * kHeight / g), kHeight};
    double begin = 0.0;
    while (time > begin + f.length && f.number < 20) {
      begin += f.length;
      f.apex *= kKept * kKept;
      f = {f.number + 1, 0.0, 2.0 * std::sqrt(2.0 * f.apex / g), f.apex};
    }
    f.since = time - begin;
    return f;
  }
  std::vector<Truth> truth() const override {
    const Flight f = flight();
    const double g = double(kGravity);
    const double fall = f.number == 0 ? f.since : f.since - 0.5 * f.length;
    return {{1, {.position = Vec3d(0, kRadius + f.apex - 0.5 * g * fall * fall, 0)}}};
  }
  double error(std::span<const BodyMotion> bodies) const override {
    const Flight f = flight();
    if (f.number < 1 || f.number > 3 || std::abs(f.since / f.length - 0.5) > 0.25) return 0.0;
    const double v = bodies[1].linear_velocity.y();
    const double reached = bodies[1].pose.position.y() - kRadius + 0.5 * v * v / double(kGravity);
    return reached / f.apex - 1.0;
  }
};

template <class T>
std::unique_ptr<Run> make() {
  return std::make_unique<T>();
}

Vec3 downSlope(double angle) {
  const SinCosDouble t = sincos(angle);
  return (double(kGravity) * Vec3d(t.sin, -t.cos, 0)).cast<float>();
}

}  // namespace

std::vector<Case> frictionCases() {
  return {
      {.id = "ACC-11",
       .name = "sliding_box",
       .shows = "a box at 5 m/s is stopped by friction",
       .metric = "way",
       .unit = "",
       .target = 1e-3,
       .floor = 1e-5,
       .seconds = 2.5,
       .smooth = false,
       .make = make<SlidingBox>},
      {.id = "ACC-12",
       .name = "sticking_box",
       .shows = "a box stays on a slope one degree below the critical one",
       .metric = "creep",
       .unit = "m",
       .target = 1e-5,
       .floor = 1e-6,
       .seconds = 2,
       .smooth = false,
       .make = make<StickingBox>,
       .gravity = downSlope(0.4636476090008061 - kPiDouble / 180.0)},
      {.id = "ACC-13",
       .name = "slip_to_roll",
       .shows = "a sliding ball begins to roll at 5/7 of its speed",
       .metric = "place",
       .unit = "m",
       .target = 6e-4,
       .floor = 1e-5,
       .seconds = 2,
       .smooth = false,
       .make = [] { return std::unique_ptr<Run>(std::make_unique<Ball>(0.5, 0.2, Vec3d(4, 0, 0), Vec3d::Zero())); }},
      {.id = "ACC-14",
       .name = "masse_shot",
       .shows = "a spinning ball runs along a parabola until it rolls",
       .metric = "place",
       .unit = "m",
       .target = 2e-3,
       .floor = 1e-5,
       .seconds = 2,
       .smooth = false,
       .make = [] { return std::unique_ptr<Run>(std::make_unique<Ball>(0.1, 0.3, Vec3d(2, 0, 1), Vec3d(0, 5, 30))); }},
      {.id = "ACC-15",
       .name = "puck",
       .shows = "a disc slides and spins, and both end at the same time",
       .metric = "way",
       .unit = "",
       .target = 0.05,
       .floor = 1e-4,
       .seconds = 1.5,
       .smooth = false,
       .make = make<Puck>,
       .front_page = true},
      {.id = "ACC-16",
       .name = "bounce",
       .shows = "a ball that keeps 0.8 of its speed reaches 0.64 of its height",
       .metric = "height",
       .unit = "",
       .target = 5e-3,
       .floor = 1e-5,
       .seconds = 2.4,
       .smooth = false,
       .make = make<Bounce>},
  };
}

}  // namespace samples::accuracy

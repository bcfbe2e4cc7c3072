// Probes of what ought to stand, rest or hang.
#include "samples/benchmarks/probe_world.h"
#include "samples/benchmarks/probes.h"
#include "samples/hard_cases/card_house.h"

namespace samples::benchmarks {
namespace {

using namespace pfx;

constexpr int kTwentySeconds = 1200;

template <int Millimetres>
std::string cardHouse(int substeps) {
  ProbeWorld w(substeps);
  w.addFloor();
  hard_cases::addCardHouse(w.world, {.friction = 0.7f,
                                     .half_thickness = 0.0005f * Millimetres,
                                     .rolling_resistance = 0.0005f * Millimetres * 0.05f});
  return w.restText(kTwentySeconds);
}

template <int Boxes, bool Gaps>
std::string column(int substeps) {
  ProbeWorld w(substeps);
  w.addFloor();
  const Material m{.rolling_resistance = Gaps ? 0.05f : 0.0f};
  for (int i = 0; i < Boxes; ++i)
    w.add(Box{Vec3::Constant(0.5f)}, Vec3(0, 0.5f + static_cast<float>(i) * (Gaps ? 1.25f : 1.0f), 0), 1000.0f, m);
  return w.restText(kTwentySeconds);
}

std::string balls(int substeps) {
  ProbeWorld w(substeps);
  w.addFloor();
  for (int i = 0; i < 30; ++i)
    w.add(Sphere{0.5f}, Vec3(0, 0.5f + static_cast<float>(i), 0), 523.6f, {.rolling_resistance = 0.05f});
  return w.restText(kTwentySeconds);
}

// A box of Ratio times the mass of the others is dropped by 1 m onto a pyramid of ten rows.
template <int Ratio>
std::string loadedPyramid(int substeps) {
  ProbeWorld w(substeps);
  w.addFloor();
  for (int row = 0; row < 10; ++row)
    for (int i = 0; i < 10 - row; ++i)
      w.add(Box{Vec3::Constant(0.5f)},
            Vec3(static_cast<float>(i) - 0.5f * static_cast<float>(9 - row), 0.5f + static_cast<float>(row), 0), 1.0f);
  w.add(Box{Vec3::Constant(0.5f)}, Vec3(0, 11.5f, 0), static_cast<float>(Ratio));
  w.witness.begin(w.world);
  w.run(120);
  const double deep = w.penetration();
  w.run(480);
  int fallen = 0;
  double drift = 0.0;
  for (uint32_t i = 1; i <= 55; ++i) {
    const Vec3 moved = w.world.states()[i].position - w.witness.start[i];
    if (moved.y() < -0.5f) ++fallen;
    drift = std::max(drift, double(moved.norm()));
  }
  if (fallen > 0) return described("%d of 55 boxes fell, pen %.3g mm after 2 s", fallen, 1e3 * deep);
  return described("stands, drift %.3g mm, pen %.3g mm after 2 s", 1e3 * drift, 1e3 * deep);
}

template <int Ratio>
std::string heavyOnLight(int substeps) {
  ProbeWorld w(substeps);
  w.addFloor();
  w.add(Box{Vec3::Constant(0.5f)}, Vec3(0, 0.5f, 0), 1.0f);
  w.add(Box{Vec3::Constant(0.5f)}, Vec3(0, 1.5f, 0), static_cast<float>(Ratio));
  w.run(300);
  return described("pen %.3g mm", 1e3 * w.penetration());
}

template <int Centimetres>
std::string smallPyramid(int substeps) {
  ProbeWorld w(substeps);
  w.addFloor();
  const float edge = 0.01f * Centimetres;
  for (int row = 0; row < 30; ++row)
    for (int i = 0; i < 30 - row; ++i)
      w.add(Box{Vec3::Constant(0.5f * edge)},
            Vec3((static_cast<float>(i) - 0.5f * static_cast<float>(29 - row)) * edge,
                 (0.5f + static_cast<float>(row)) * edge, 0),
            1000.0f * edge * edge * edge);
  return w.restText(600);
}


// Links of one metre, released from horizontal with a ball at their end.
template <int Links, int BallDecimetres>
std::string chain(int substeps) {
  ProbeWorld w(substeps);
  const float ball = 0.1f * BallDecimetres;
  BodyId last = w.addFixed(Sphere{0.1f}, Vec3::Zero());
  const auto mass = [](float volume) { return 1000.0f * volume; };
  for (int i = 0; i < Links; ++i) {
    const auto x = static_cast<float>(i);
    const BodyId link = w.add(Capsule{0.5f, 0.125f}, Vec3(x + 0.5f, 0, 0), mass(0.0573f));
    w.world.addJoint({.body_a = last, .body_b = link, .params = BallJointParams{.anchor_point = Vec3(x, 0, 0)}});
    last = link;
  }
  const Vec3 end(static_cast<float>(Links), 0, 0);
  const BodyId load = w.add(Sphere{ball}, end + Vec3(ball, 0, 0), mass(4.18879f * ball * ball * ball));
  w.world.addJoint({.body_a = last, .body_b = load, .params = BallJointParams{.anchor_point = end}});
  double longest = 0.0;
  for (int i = 0; i < 600; ++i) {
    w.world.step(kTimeStep);
    longest = std::max(longest, double(w.state(load).position.norm()));
  }
  const double length = double(end.x() + ball);
  return described("stretch %.3g %%", 100.0 * (longest / length - 1.0));
}

// 150 planks between two points, each held to the next by two ball joints.
std::string bridge(int substeps) {
  ProbeWorld w(substeps);
  constexpr int kPlanks = 150;
  constexpr float kPitch = 0.25f;
  const BodyId post = w.addFixed(Sphere{0.1f}, Vec3::Zero());
  BodyId last = post;
  std::vector<BodyId> planks;
  for (int i = 0; i <= kPlanks; ++i) {
    const float x = kPitch * static_cast<float>(i);
    const BodyId next =
        i < kPlanks ? w.add(Box{Vec3(0.5f * kPitch, 0.05f, 0.5f)}, Vec3(x + 0.5f * kPitch, 0, 0), 20.0f) : post;
    for (const float z : {-0.5f, 0.5f})
      w.world.addJoint({.body_a = last, .body_b = next, .params = BallJointParams{.anchor_point = Vec3(x, 0, z)}});
    if (i < kPlanks) planks.push_back(next);
    last = next;
  }
  const int asleep = w.rest(1800);
  double length = kPitch;
  for (int i = 1; i < kPlanks; ++i)
    length += double((w.state(planks[size_t(i)]).position - w.state(planks[size_t(i) - 1]).position).norm());
  return described("stretch %.3g %%, %s", 100.0 * (length / (kPlanks * double(kPitch)) - 1.0),
                   asleep < 0 ? "awake after 30 s" : "asleep");
}

// A plate that meets four hundred boxes in the same step.
std::string plateOnBoxes(int substeps) {
  ProbeWorld w(substeps);
  for (int i = 0; i < 400; ++i)
    w.addFixed(Box{Vec3::Constant(0.5f)}, Vec3(static_cast<float>(i % 20) - 9.5f, -0.5f, static_cast<float>(i / 20) - 9.5f));
  const BodyId plate = w.add(Box{Vec3(10, 0.1f, 10)}, Vec3(0, 0.1f, 0), 8000.0f);
  w.run(1);
  const uint32_t touching = w.world.counts().touching_pairs;
  w.run(120);
  return described("%u contacts in the first step, sinks %.3g mm", touching, 1e3 * (0.1 - double(w.state(plate).position.y())));
}

}  // namespace

std::span<const Probe> restProbes() {
  static constexpr Probe kProbes[] = {
      {"house of 40 cards, 2 mm", cardHouse<2>, "asleep at step 66, drift 14 mm, drop 34 mm"},
      {"house of 40 cards, 10 mm", cardHouse<10>, "asleep at step 41, drift 3 mm"},
      {"column of 40 boxes dropped with gaps", column<40, true>, "asleep at step 258, drift 170 mm"},
      {"column of 40 boxes", column<40, false>, "asleep at step 97, drift 14 mm, drop 440 mm"},
      {"column of 80 boxes", column<80, false>, "awake after 1200 steps, sways 970 mm"},
      {"column of 30 balls", balls, "asleep at step 173"},
      {"pyramid, load of 100", loadedPyramid<100>, "stands, drift 540 mm, pen 24 mm after 2 s"},
      {"pyramid, load of 300", loadedPyramid<300>, "stands, drift 130 mm, pen 41 mm after 2 s"},
      {"pyramid, load of 1000", loadedPyramid<1000>, "45 of 55 boxes fell, pen 670 mm"},
      {"cube of 10 on 1", heavyOnLight<10>, "pen 3 mm"},
      {"cube of 100 on 1", heavyOnLight<100>, "pen 28 mm"},
      {"cube of 1000 on 1", heavyOnLight<1000>, "pen 297 mm"},
      {"pyramid of 30 rows, boxes of 5 cm", smallPyramid<5>, "asleep at step 96, drift 19 mm, drop 63 mm"},
      {"pyramid of 30 rows, boxes of 2 cm", smallPyramid<2>, "asleep at step 87, drift 15 mm"},
      {"32 links and a ball of 585", chain<32, 20>, "stretch 34 %"},
      {"10 links and a ball of 585", chain<10, 20>, "stretch 29 %"},
      {"32 links and a ball of 9", chain<32, 5>, "stretch 1.6 %"},
      {"bridge of 150 planks", bridge, "stretch 10.4 %, never sleeps"},
      {"plate on 400 boxes", plateOnBoxes, "16 contacts in the first step, sinks 90 mm"},
  };
  return kProbes;
}

}  // namespace samples::benchmarks

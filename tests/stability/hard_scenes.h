// Scenes of the hard stability cases, each with the knob that makes it harder.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <vector>

#include "pfx/base_level/shape/convex_hull.h"
#include "pfx/high_level/world/world.h"

namespace pfx_test {

using namespace pfx;

inline constexpr float kStep = 1.0f / 60.0f;

inline WorldDef hardDef() {
  WorldDef def;
  def.gravity = Vec3(0.0f, -9.81f, 0.0f);
  return def;
}

struct BoxDef {
  Vec3 half_extent = Vec3::Constant(0.5f);  // m
  Vec3 position = Vec3::Zero();
  Quat orientation = Quat::Identity();
  float mass = 1.0f;      // kg
  float friction = 0.6f;  // of the pair, when both have the same
};

inline BodyId addBox(World& world, const BoxDef& box, MotionType type = MotionType::Active) {
  return world.addBody({.name = "box",
                        .pose = {box.position, box.orientation},
                        .motion_type = type,
                        .shapes = {{Box{box.half_extent}}},
                        .mass = box.mass,
                        .restitution = 0.0f,
                        .friction = box.friction});
}

inline BodyId addFloor(World& world, float friction = 0.6f) {
  return addBox(world, {.half_extent = Vec3(50, 1, 50), .position = Vec3(0, -1, 0), .friction = friction},
                MotionType::Fixed);
}

// Column of unit boxes that touch exactly, from the bottom up.
inline void addColumn(World& world, const std::vector<float>& masses, const Vec3& at = Vec3::Zero()) {
  for (size_t i = 0; i < masses.size(); ++i)
    addBox(world, {.position = at + Vec3(0, 0.5f + static_cast<float>(i), 0), .mass = masses[i]});
}

// What a scene has come to.
struct Standing {
  double drift = 0.0;        // m, largest of any body
  double penetration = 0.0;  // m, deepest
  double speed = 0.0;        // m/s, largest of any body
  double tilt = 0.0;         // rad, largest of any body
};

inline double deepest(const World& world) {
  float depth = 0.0f;
  for (const Pair& pair : world.contactPairs())
    for (const ContactManifold& m : world.manifolds(pair))
      for (int i = 0; i < m.num_points; ++i) depth = std::max(depth, -m.points[i].distance);
  return static_cast<double>(depth);
}

// Runs a world and watches it, in steps of `step` seconds. `from`: seconds after which speeds count.
class Watch {
 public:
  explicit Watch(World& world, float step = kStep)
      : world_(world), step_(step), start_(world.states().begin(), world.states().end()) {}

  void run(double seconds, double from = 0.0) {
    for (int i = 0; i < stepsOf(seconds); ++i) {
      world_.step(step_);
      if (i >= stepsOf(from)) look();
    }
    finish();
  }
  // Whether no body has moved by more than `limit`; gives up early.
  bool stands(double seconds, double limit) {
    for (int i = 0; i < stepsOf(seconds); ++i) {
      world_.step(step_);
      if (i % 20 != 19) continue;
      finish();
      if (!(seen.drift < limit)) return false;
    }
    return true;
  }

  Standing seen;

 private:
  int stepsOf(double seconds) const { return static_cast<int>(seconds / static_cast<double>(step_) + 0.5); }
  void look() {
    seen.penetration = std::max(seen.penetration, deepest(world_));
    for (const RigidState& s : world_.states())
      if (isDynamic(s.motion_type))
        seen.speed = std::max(seen.speed, static_cast<double>(s.linear_velocity.norm()));
  }
  void finish() {
    seen.drift = seen.tilt = 0.0;
    for (size_t i = 0; i < start_.size(); ++i) {
      const RigidState& s = world_.states()[i];
      const auto moved = static_cast<double>((s.position - start_[i].position).norm());
      seen.drift = std::isfinite(moved) ? std::max(seen.drift, moved) : 1e30;
      const Quat turn = s.orientation * start_[i].orientation.conjugate();
      seen.tilt = std::max(seen.tilt, 2.0 * std::asin(std::min(1.0, static_cast<double>(turn.vec().norm()))));
    }
  }

  World& world_;
  float step_;  // s
  std::vector<RigidState> start_;
};

// Plates that grow by 1.3 and double their mass from layer to layer, the smallest (0.5 m) at the bottom.
inline void addInvertedPyramid(World& world, int layers, float mass_ratio = 2.0f) {
  constexpr float kThickness = 0.1f;
  float size = 0.5f, mass = 1.0f;
  for (int i = 0; i < layers; ++i, size *= 1.3f, mass *= mass_ratio)
    addBox(world, {.half_extent = 0.5f * Vec3(size, kThickness, size),
                   .position = Vec3(0, kThickness * (0.5f + static_cast<float>(i)), 0),
                   .mass = mass});
}

// Levels of three blocks crosswise; returns the blocks from the bottom up.
inline std::vector<BodyId> addJenga(World& world, int levels) {
  const Vec3 block(0.75f, 0.15f, 0.25f);  // m, whole: a third as wide as long
  std::vector<BodyId> blocks;
  for (int level = 0; level < levels; ++level) {
    const bool across = level % 2 == 1;
    for (int i = -1; i <= 1; ++i) {
      const float side = 0.25f * static_cast<float>(i), y = 0.15f * (0.5f + static_cast<float>(level));
      const Vec3 half = 0.5f * (across ? Vec3(block.z(), block.y(), block.x()) : block) - Vec3(0, 0, 0);
      // a gap of half a millimetre between the blocks of a level
      const Vec3 shrunk = half - (across ? Vec3(2.5e-4f, 0, 0) : Vec3(0, 0, 2.5e-4f));
      blocks.push_back(addBox(world, {.half_extent = shrunk,
                                      .position = across ? Vec3(side, y, 0) : Vec3(0, y, side),
                                      .mass = 0.5f,
                                      .friction = 0.5f}));
    }
  }
  return blocks;
}

// Card house: `storeys` rows of leaning pairs with a level card over neighbouring pairs.
struct CardHouse {
  int storeys = 5;
  float friction = 0.6f;
  float lean = 25.0f;                      // degrees from upright
  float thickness = 2e-3f;                 // m
  Vec3 card = Vec3(0.063f, 0.088f, 0.0f);  // m, width (z) and height
};
inline void addCardHouse(World& world, const CardHouse& d) {
  const float angle = d.lean * static_cast<float>(M_PI) / 180.0f, s = std::sin(angle), c = std::cos(angle);
  const float h = d.card.y(), t = d.thickness;
  // Two cards that lean against each other: the inner upper edges touch at x = 0, each card turned about z.
  const float reach = h * s + t * c, height = h * c + t * s;  // of a leaning card's bounds
  const float pitch = 2.0f * reach;
  const auto add = [&](const Vec3& at, float turn, const Vec3& half) {
    addBox(world, {.half_extent = half,
                   .position = at,
                   .orientation = Quat(Eigen::AngleAxisf(turn, Vec3::UnitZ())),
                   .mass = 2e-3f,
                   .friction = d.friction});
  };
  const Vec3 half(0.5f * t, 0.5f * h, 0.5f * d.card.x());
  float y = 0.0f;
  for (int storey = 0; storey < d.storeys; ++storey) {
    const int pairs = d.storeys - storey;
    const float first = -0.5f * pitch * static_cast<float>(pairs - 1);
    for (int i = 0; i < pairs; ++i) {
      const float x = first + pitch * static_cast<float>(i);
      add(Vec3(x - 0.5f * reach, y + 0.5f * height, 0), -angle, half);
      add(Vec3(x + 0.5f * reach, y + 0.5f * height, 0), angle, half);
    }
    y += height;
    // A level card spans from the tip of one pair to the tip of the next.
    for (int i = 0; i + 1 < pairs; ++i) {
      const float x = first + pitch * (static_cast<float>(i) + 0.5f);
      addBox(world, {.half_extent = Vec3(0.5f * pitch - 1e-4f, 0.5f * t, 0.5f * d.card.x()),
                     .position = Vec3(x, y + 0.5f * t, 0),
                     .mass = 2e-3f,
                     .friction = d.friction});
    }
    y += t;
  }
}

// Semicircular arch of n voussoirs of mean radius 1 on fixed springers; radial joints, thickness / radius as
// given.
inline void addArch(World& world, int n, float thickness, float friction = 0.9f) {
  const float inner = 1.0f - 0.5f * thickness, outer = 1.0f + 0.5f * thickness, width = 0.2f;
  const float half_angle = 0.5f * static_cast<float>(M_PI) / static_cast<float>(n);
  const auto wedge = [&](float from, float to, float mass, MotionType type) {
    const float middle = 0.5f * (from + to), part = 0.5f * (to - from);
    // In the frame of the stone the radius points along y.
    std::vector<Vec3> corners;
    for (const float z : {-width, width})
      for (const float r : {inner, outer})
        for (const float sign : {-1.0f, 1.0f})
          corners.push_back(Vec3(sign * r * std::sin(part), r * std::cos(part), 0.5f * z));
    // centre of mass of the trapezoid
    const float a = inner * std::cos(part), b = outer * std::cos(part);
    const float center = 2.0f / 3.0f * (b * b * b - a * a * a) / (b * b - a * a);
    for (Vec3& p : corners) p.y() -= center;
    ConvexMesh mesh;
    if (buildConvexMesh(corners, mesh) != Error::Ok) return;
    const float angle = middle - 0.5f * static_cast<float>(M_PI);  // from the top, about z
    world.addBody({.name = "voussoir",
                   .pose = {center * Vec3(std::cos(middle), std::sin(middle), 0),
                            Quat(Eigen::AngleAxisf(angle, Vec3::UnitZ()))},
                   .motion_type = type,
                   .shapes = {{world.keep(std::move(mesh))}},
                   .mass = mass,
                   .restitution = 0.0f,
                   .friction = friction});
  };
  const auto at = [&](int i) { return 2.0f * half_angle * static_cast<float>(i); };
  for (int i = 0; i < n; ++i) wedge(at(i), at(i + 1), 1.0f, MotionType::Active);
  wedge(at(0) - 2.0f * half_angle, at(0), 1.0f, MotionType::Fixed);
  wedge(at(n), at(n + 1), 1.0f, MotionType::Fixed);
}

// Largest value of an ascending list for which `holds`, by trying them in order until the first failure; 0:
// none.
inline double margin(std::initializer_list<double> values, const std::function<bool(double)>& holds) {
  double best = 0.0;
  for (const double v : values) {
    if (!holds(v)) break;
    best = v;
  }
  return best;
}

}  // namespace pfx_test

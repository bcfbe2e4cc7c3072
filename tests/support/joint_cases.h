// Shared by the accuracy tests of joints: rods, spheres and grounds, energies, gaps, and reference tables.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pfx/high_level/world/world.h"

namespace pfx_test {

using namespace pfx;

inline constexpr float kDt = 1.0f / 60.0f;
inline constexpr double kGravity = 9.81;  // m/s^2, of all reference tables

inline nlohmann::json reference(const std::string& name) {
  std::ifstream file(std::string(VITRINE_SOURCE_DIR) + "/tests/accuracy/ref/" + name + ".json");
  return nlohmann::json::parse(file);
}

inline WorldDef worldDef(int substeps, JointSolver solver = JointSolver::Auto) {
  WorldDef def;
  def.gravity = Vec3(0.0f, -static_cast<float>(kGravity), 0.0f);
  def.substeps = substeps;
  def.joint_solver = solver;
  return def;
}

inline Quat aboutZ(double angle) {
  return Quat(static_cast<float>(std::cos(angle / 2)), 0, 0, static_cast<float>(std::sin(angle / 2)));
}

inline BodyId addPost(World& world, const Vec3& at = Vec3::Zero()) {
  return world.addBody({.name = "post",
                        .pose = {.position = at},
                        .motion_type = MotionType::Fixed,
                        .shapes = {{Box{Vec3::Constant(0.01f)}}},
                        .filter_self = 0});
}

// A rod whose long side is its y axis, its middle at `at`, turned by `angle` (rad) about z from hanging.
// Collides with nothing.
struct Rod {
  float length = 1.0f, width = 0.1f;  // m
  float mass = 1.0f;                  // kg
};
inline BodyId addRod(World& world, const Rod& rod, const Vec3& at, double angle) {
  return world.addBody({.name = "rod",
                        .pose = {.position = at, .orientation = aboutZ(angle)},
                        .shapes = {{Box{0.5f * Vec3(rod.width, rod.length, rod.width)}}},
                        .mass = rod.mass,
                        .filter_self = 0});
}

inline Vec3 downAt(double angle, double length) {
  return Vec3(static_cast<float>(length * std::sin(angle)), static_cast<float>(-length * std::cos(angle)),
              0.0f);
}

inline double angleAboutZ(const RigidState& s) {
  return 2.0 * std::atan2(static_cast<double>(s.orientation.z()), static_cast<double>(s.orientation.w()));
}

inline double wrapped(double angle) { return std::remainder(angle, 2.0 * M_PI); }

inline double energy(const World& world) {
  double sum = 0.0;
  for (size_t i = 0; i < world.states().size(); ++i) {
    const RigidState& s = world.states()[i];
    if (!isDynamic(s.motion_type)) continue;
    const RigidBody& b = world.bodies()[i];
    const Mat3d r = s.orientation.cast<double>().normalized().toRotationMatrix();
    const Vec3d w = r.transpose() * s.angular_velocity.cast<double>();
    sum += b.mass * (0.5 * s.linear_velocity.cast<double>().squaredNorm() + kGravity * s.position.y()) +
           0.5 * w.dot(b.inertia.cast<double>() * w);
  }
  return sum;
}

inline double largestGap(const World& world) {
  double worst = 0.0;
  for (uint32_t i = 0; i < world.joints().size(); ++i)
    if (world.jointLinks()[i].exists) worst = std::max(worst, world.jointError(i).distance);
  return worst;
}

// One line of the report: what was measured, in which unit, and what it should stay below.
inline void report(const char* what, double measured, double target, const char* unit) {
  std::printf("  %-52s %+11.3e %-6s (target %.1e)%s\n", what, measured, unit, target,
              std::abs(measured) < target ? "" : "  MISSED");
}

// Where the signed error is largest.
struct Worst {
  double value = 0.0;
  void add(double x) {
    if (std::abs(x) > std::abs(value)) value = x;
  }
};

}  // namespace pfx_test

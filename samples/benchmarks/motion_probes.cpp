// Probes of what ought to move: to spin on, slide smoothly, bounce, and stop at walls.
#include "pfx/base_level/math/trig.h"
#include "pfx/util/mesh_builder/mesh_builder.h"
#include "samples/benchmarks/probe_world.h"
#include "samples/benchmarks/probes.h"

namespace samples::benchmarks {
namespace {

using namespace pfx;

// A box spun about its middle axis, which turns over again and again.
std::string spinningBox(int substeps) {
  ProbeWorld w(substeps, Vec3::Zero());
  const BodyId box = w.add(Box{Vec3(0.5f, 0.1f, 0.25f)}, Vec3::Zero(), 100.0f);
  w.world.state(box).angular_velocity = Vec3(0.01f, 0.01f, 10.0f);
  const auto look = [&] {
    const RigidState& s = w.state(box);
    const Vec3d spin = s.orientation.cast<double>().conjugate() * s.angular_velocity.cast<double>();
    const Vec3d momentum = w.world.bodies()[box.index].inertia.cast<double>() * spin;
    return std::pair(0.5 * spin.dot(momentum), momentum.norm());
  };
  const auto [energy, momentum] = look();
  w.run(600);
  const auto [energy10, momentum10] = look();
  w.run(3000);
  const auto [energy60, momentum60] = look();
  return described("energy %.2f %%, |L| %.2f %% after 10 s; %.2f %%, %.2f %% after 60 s", 100 * energy10 / energy,
                   100 * momentum10 / momentum, 100 * energy60 / energy, 100 * momentum60 / momentum);
}

LargeMesh flatGrid(float half, float cell) {
  const int side = static_cast<int>(2.0f * half / cell + 0.5f);
  return makeTerrain({.cells = side, .half_extent = half, .height = 0.0f, .bowl = 0.0f});
}

// A frictionless box at 10 m/s over the edges of a flat mesh.
template <int CellCentimetres>
std::string boxOnMesh(int substeps) {
  ProbeWorld w(substeps);
  const LargeMesh* grid = w.world.keep(flatGrid(48.0f, 0.01f * CellCentimetres));
  w.addFixed(grid, Vec3::Zero(), {.friction = 0.0f});
  const BodyId box = w.add(Box{Vec3::Constant(0.5f)}, Vec3(-20, 0.5f, 0.1f), 1000.0f, {.friction = 0.0f});
  w.world.state(box).linear_velocity = Vec3(10, 0, 1);
  const double speed = double(w.state(box).linear_velocity.norm());
  double bump = 0.0;
  for (int i = 0; i < 240; ++i) {
    w.world.step(kTimeStep);
    if (i > 5) bump = std::max(bump, std::abs(double(w.state(box).linear_velocity.y())));
  }
  return described("|vy| at most %.2g mm/s, speed loss %.2g %%", 1e3 * bump,
                   100 * (1 - double(w.state(box).linear_velocity.norm()) / speed));
}

std::string ballOnMesh(int substeps) {
  ProbeWorld w(substeps);
  w.addFixed(w.world.keep(flatGrid(48.0f, 1.0f)), Vec3::Zero());
  const BodyId ball = w.add(Sphere{0.5f}, Vec3(-30, 0.5f, 0.1f), 500.0f);
  w.world.state(ball).linear_velocity = Vec3(10, 0, 0);
  w.run(240);
  return described("rolls at %.4f m/s (5/7 of 10: 7.1429)", double(w.state(ball).linear_velocity.x()));
}

// A slab with thousands of triangles under it.
template <int HalfMetres>
std::string slabOnMesh(int substeps) {
  ProbeWorld w(substeps);
  w.addFixed(w.world.keep(flatGrid(HalfMetres + 4.0f, 0.5f)), Vec3::Zero());
  const BodyId slab = w.add(Box{Vec3(HalfMetres, 0.5f, HalfMetres)}, Vec3(0.1f, 1.0f, 0.2f), 1000.0f);
  w.run(300);
  return described("rests at y = %.4f m (0.5)", double(w.state(slab).position.y()));
}

enum class Obstacle { FixedWall, Wall, Ball };

// Balls of 5 cm radius at 100 m/s, each at another phase of the step, at something 5 cm thick or of 5 cm radius.
template <Obstacle What>
std::string bullets(int substeps) {
  int missed = 0;
  for (int i = 0; i < 100; ++i) {
    ProbeWorld w(substeps, Vec3::Zero());
    const Vec3 at(10, 0, 0);
    if (What == Obstacle::FixedWall) w.addFixed(Box{Vec3(0.025f, 1, 1)}, at);
    if (What == Obstacle::Wall) w.add(Box{Vec3(0.025f, 1, 1)}, at, 100.0f);
    if (What == Obstacle::Ball) w.add(Sphere{0.05f}, at, 0.5f);
    const BodyId bullet = w.add(Sphere{0.05f}, Vec3(0.017f * static_cast<float>(i), 0, 0), 0.5f);
    w.world.state(bullet).linear_velocity = Vec3(100, 0, 0);
    w.run(12);
    const double wall = double(w.world.states()[0].position.x());
    if (double(w.state(bullet).position.x()) > wall) ++missed;
  }
  return described("%d of 100 pass through", missed);
}

// A box on a slope at a share of the critical angle of friction 0.5.
template <int Percent>
std::string slope(int substeps) {
  const double angle = pfx::atan2(0.5, 1.0) * Percent / 100.0;
  const SinCosDouble t = pfx::sincos(angle);
  ProbeWorld w(substeps, (10.0 * Vec3d(t.sin, -t.cos, 0)).cast<float>());
  w.addFloor({.friction = 0.5f});
  const BodyId box = w.add(Box{Vec3(0.5f, 0.25f, 0.5f)}, Vec3(0, 0.25f, 0), 500.0f, {.friction = 0.5f});
  w.run(600);
  const RigidState& s = w.state(box);
  if (Percent < 100) return described("creeps %.2g mm in 10 s", 1e3 * double(s.position.x()));
  return described("slides at %.3f m/s (theory %.3f)", double(s.linear_velocity.x()), 100.0 * (t.sin - 0.5 * t.cos));
}

// A ball that keeps all of its speed, dropped from 5 m.
std::string bounces(int substeps) {
  ProbeWorld w(substeps);
  const Material elastic{.friction = 0.0f, .restitution = 1.0f};
  w.addFloor(elastic);
  const BodyId ball = w.add(Sphere{0.5f}, Vec3(0, 5.5f, 0), 500.0f, elastic);
  std::string apexes = "apexes";
  double last = 0.0, highest = 0.0;
  int count = 0;
  for (int i = 0; i < 3000 && count < 10; ++i) {
    w.world.step(kTimeStep);
    const double v = double(w.state(ball).linear_velocity.y());
    if (last > 0.0 && v <= 0.0) {
      highest = double(w.state(ball).position.y()) - 0.5 + v * v / 20.0;
      if (++count == 1 || count == 2 || count == 10) apexes += described(" %.3f", highest);
    }
    last = v;
  }
  return apexes + " m (1st, 2nd, 10th)";
}

}  // namespace

std::span<const Probe> motionProbes() {
  static constexpr Probe kProbes[] = {
      {"box spun about its middle axis", spinningBox, "energy 81 %, |L| 90 % after 10 s; 36 %, 60 % after 60 s"},
      {"box at 10 m/s over a mesh, cells of 1 m", boxOnMesh<100>, "|vy| at most 1.2 mm/s, speed loss 0.03 %"},
      {"box at 10 m/s over a mesh, cells of 25 cm", boxOnMesh<25>, "|vy| at most 1.2 mm/s, speed loss 0.03 %"},
      {"ball over a mesh", ballOnMesh, "rolls at 7.15 m/s"},
      {"slab of 10 m on 800 triangles", slabOnMesh<5>, "falls through"},
      {"slab of 40 m on 12,800 triangles", slabOnMesh<20>, "falls through"},
      {"ball at 100 m/s at a fixed wall", bullets<Obstacle::FixedWall>, "0 of 100 pass through"},
      {"ball at 100 m/s at a free wall", bullets<Obstacle::Wall>, "94 of 100 pass through"},
      {"ball at 100 m/s at a ball", bullets<Obstacle::Ball>, "84 of 100 pass through"},
      {"slope at 0.98 of the critical angle", slope<98>, "creeps 1.2 mm, then sleeps"},
      {"slope at 1.02 of the critical angle", slope<102>, "slides at 1.42 m/s (theory 1.04)"},
      {"elastic ball from 5 m", bounces, "apexes 4.966 4.946 4.918 m"},
  };
  return kProbes;
}

std::span<const Probe> probes() {
  static const std::vector<Probe> table = [] {
    std::vector<Probe> all;
    for (const auto family : {restProbes, motionProbes})
      for (const Probe& p : family()) all.push_back(p);
    return all;
  }();
  return table;
}

}  // namespace samples::benchmarks

// Sample 8_deform_mesh: a large mesh whose vertices move while bodies stand on it.
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "pfx/base_level/math/trig.h"
#include "pfx/util/mesh_builder/mesh_builder.h"
#include "pfx/util/state_hash/state_hash.h"
#include "samples/registry.h"
#include "samples/shared/builders.h"

namespace samples {
namespace {

using namespace pfx;

constexpr int kCells = 64;        // along each edge: 8,192 triangles
constexpr float kHalf = 10.0f;    // m
constexpr float kThickness = 1.0f;  // m

// A square sheet of triangles whose height is a function of place and time.
class DeformScene : public Scene {
 public:
  void build(World& world) override {
    const LargeMesh* mesh = world.keep(makeSheet());
    world.addBody(
        {.name = "surface", .motion_type = MotionType::Fixed, .shapes = {shape(mesh)}, .friction = 0.7f});
    world.deformMesh(mesh, vertices_, 0.0f);  // as it stands: a mesh that is going to move
    addBodies(world);
  }

  void afterStep(World& world, float dt) override {
    time_ += dt;
    if (!moves()) return;
    place(time_);
    const auto* mesh = std::get<const LargeMesh*>(world.collidables()[0].shapes()[0].geometry);
    world.deformMesh(mesh, vertices_, isSudden() ? 0.0f : dt);
  }

  uint64_t stateHash() const override { return hashBytes(std::as_bytes(std::span(vertices_))); }

  // The lowest any body reaches below the surface under its centre.
  std::vector<Reading> readings(const World& world) const override {
    float deepest = 0.0f;
    int below = 0;
    for (uint32_t i = 1; i < world.states().size(); ++i) {
      const Vec3& p = world.states()[i].position;
      if (std::max(std::abs(p.x()), std::abs(p.z())) > kHalf) continue;
      const float under = height(p.x(), p.z(), time_) - p.y();
      deepest = std::max(deepest, under);
      below += under > 0.0f;
    }
    return {{"bodies below the surface", "", static_cast<double>(below)},
            {"deepest centre below the surface", "m", deepest, 0.01},
            {"triangles", "", 2.0 * kCells * kCells}};
  }

  // Every other line of vertices, so that one sees the surface move.
  void draw(const World&, Canvas& canvas) const override {
    constexpr int kEvery = 2;
    constexpr Stroke kThread{0xffa9a294u, 1.0f};
    const Vec3 lift(0.0f, 0.012f, 0.0f);
    for (int i = 0; i <= kCells; i += kEvery)
      for (int k = 0; k < kCells; ++k) {
        canvas.line(vertex(i, k) + lift, vertex(i, k + 1) + lift, kThread);
        canvas.line(vertex(k, i) + lift, vertex(k + 1, i) + lift, kThread);
      }
  }

 protected:
  virtual float height(float x, float z, float t) const = 0;
  virtual void addBodies(World& world) = 0;
  virtual bool moves() const { return true; }
  virtual bool isSudden() const { return false; }
  float time() const { return time_; }

  // A box, a ball, a capsule and a cylinder in turn, side by side in a square round the centre.
  static void addMixed(World& world, int side, float pitch, float y) {
    for (int i = 0; i < side * side; ++i) {
      const Vec3 at((static_cast<float>(i % side) - 0.5f * static_cast<float>(side - 1)) * pitch, y,
                    (static_cast<float>(i / side) - 0.5f * static_cast<float>(side - 1)) * pitch);
      const int kind = (i + i / side) % 4;
      if (kind == 0) addBody(world, "box", Box{Vec3(0.4f, 0.3f, 0.4f)}, at, 2.0f);
      if (kind == 1) addBody(world, "ball", Sphere{0.38f}, at, 2.0f);
      if (kind == 2) addBody(world, "capsule", Capsule{0.3f, 0.25f}, at, 2.0f);
      if (kind == 3) addBody(world, "cylinder", Cylinder{0.3f, 0.35f}, at, 2.0f);
    }
  }

 private:
  static constexpr int kSide = kCells + 1;

  const Vec3& vertex(int i, int k) const { return vertices_[static_cast<size_t>(i * kSide + k)]; }

  LargeMesh makeSheet() {
    vertices_.resize(static_cast<size_t>(kSide * kSide));
    std::vector<uint32_t> indices;
    for (int i = 0; i < kCells; ++i)
      for (int k = 0; k < kCells; ++k) {
        const auto at = [&](int di, int dk) { return static_cast<uint32_t>((i + di) * kSide + k + dk); };
        indices.insert(indices.end(), {at(0, 0), at(0, 1), at(1, 0), at(1, 0), at(0, 1), at(1, 1)});
      }
    for (int i = 0; i < kSide; ++i)
      for (int k = 0; k < kSide; ++k)
        vertices_[static_cast<size_t>(i * kSide + k)] =
            Vec3(2.0f * kHalf * static_cast<float>(i) / kCells - kHalf, 0.0f,
                 2.0f * kHalf * static_cast<float>(k) / kCells - kHalf);
    place(0.0f);
    LargeMeshResult built = buildLargeMesh(vertices_, indices, {.thickness = kThickness});
    if (built.error != Error::Ok) throw std::logic_error("the sheet is not a mesh");
    return std::move(built.mesh);
  }

  void place(float t) {
    for (Vec3& v : vertices_) v.y() = height(v.x(), v.z(), t);
  }

  std::vector<Vec3> vertices_;
  float time_ = 0.0f;
};

// A wave runs along x and grows in the first second.
class Wave final : public DeformScene {
 public:
  std::vector<Parameter> parameters() override {
    return {{"height of the wave", "m", &amplitude_, 0.0f, 0.8f}, {"speed of the wave", "m/s", &speed_, 0.0f, 4.0f}};
  }

 private:
  float height(float x, float z, float t) const override {
    constexpr float kWaveNumber = 1.2f;  // 1/m
    const float grown = std::min(1.0f, t);
    return grown * amplitude_ * (sin(kWaveNumber * (x - speed_ * t)) + 0.25f * sin(0.8f * z));
  }
  void addBodies(World& world) override { addMixed(world, 6, 1.9f, 0.5f); }

  float amplitude_ = 0.45f, speed_ = 1.2f;
};

// Three blows stamp craters with rims into a sheet, one after the other; bodies are thrown up and roll in.
class Crater final : public DeformScene {
 public:
  std::vector<Parameter> parameters() override {
    return {{"depth of a crater", "m", &depth_, 0.2f, 2.0f, Parameter::Takes::OnRestart},
            {"time of a blow", "s", &duration_, 0.02f, 0.5f, Parameter::Takes::OnRestart}};
  }

 private:
  struct Blow {
    float x, z, radius, start;
  };
  static constexpr std::array<Blow, 3> kBlows = {{{-1.5f, 0.8f, 2.6f, 0.6f}, {3.2f, -2.6f, 2.0f, 1.5f}, {1.8f, 3.6f, 1.7f, 2.3f}}};

  // A bowl (1 - r^2)^2 with a rim that rises round it.
  float height(float x, float z, float t) const override {
    float y = 0.0f;
    for (const Blow& b : kBlows) {
      const float r2 = ((x - b.x) * (x - b.x) + (z - b.z) * (z - b.z)) / (b.radius * b.radius);
      const float s = std::clamp((t - b.start) / duration_, 0.0f, 1.0f), stamped = s * s * (3.0f - 2.0f * s);
      if (r2 < 1.0f) y -= stamped * depth_ * (1.0f - r2) * (1.0f - r2);
      if (r2 < 4.0f) y += 0.12f * stamped * depth_ * r2 * (1.0f - 0.25f * r2) * (1.0f - 0.25f * r2) * 2.0f;
    }
    return y;
  }
  bool moves() const override {
    return std::any_of(kBlows.begin(), kBlows.end(), [&](const Blow& b) {
      return time() > b.start - 0.02f && time() < b.start + duration_ + 0.02f;
    });
  }
  void addBodies(World& world) override { addMixed(world, 6, 1.7f, 0.45f); }

  float depth_ = 1.3f, duration_ = 0.12f;
};

// The whole surface jumps by half a metre within one step, up and down again; whatever stands on it or hovers just above
// must not be on the other side afterwards.
class Jump final : public DeformScene {
 public:
  std::vector<Parameter> parameters() override { return {{"height of a jump", "m", &jump_, 0.0f, 1.0f}}; }

 private:
  static constexpr float kPeriod = 0.75f;  // s
  static int phase(float t) { return static_cast<int>((t + 1e-4f) / kPeriod) % 2; }

  float height(float x, float z, float t) const override {
    return jump_ * static_cast<float>(phase(t)) + 0.15f * sin(0.9f * x) * cos(0.8f * z);
  }
  bool isSudden() const override { return true; }
  bool moves() const override { return phase(time()) != phase(time() - kTimeStep); }
  void addBodies(World& world) override {
    addMixed(world, 6, 1.7f, 0.6f);
    for (int i = 0; i < 9; ++i)
      addBody(world, "hovering ball", Sphere{0.25f},
              Vec3(2.0f * static_cast<float>(i % 3) - 2.0f, 2.0f, 2.0f * static_cast<float>(i / 3) - 2.0f), 1.0f);
  }

  float jump_ = 0.5f;
};

template <class T>
std::unique_ptr<Scene> make() {
  return std::make_unique<T>();
}

}  // namespace

std::vector<SceneEntry> deformMeshScenes() {
  const CameraPose camera{.target = Vec3(0.0f, 0.2f, 0.0f), .distance = 20.0f, .yaw_deg = 30.0f, .pitch_deg = 24.0f};
  return {{.sample = "8_deform_mesh",
           .name = "wave",
           .shows = "a wave travels through 8,192 triangles, and what stands on them rides up and down with it",
           .camera = camera,
           .frames = {0, 75, 240},
           .world = {},
           .make = make<Wave>},
          {.sample = "8_deform_mesh",
           .name = "crater",
           .shows = "three blows stamp craters into the mesh; bodies are thrown from the rims and roll into the bowls",
           .camera = camera,
           .frames = {30, 48, 260},
           .world = {},
           .make = make<Crater>},
          {.sample = "8_deform_mesh",
           .name = "jump",
           .shows = "the mesh jumps up by 0.5 m within one step and down again, and nothing ends up below it",
           .camera = camera,
           .frames = {44, 46, 150},
           .world = {},
           .make = make<Jump>}};
}

}  // namespace samples

// HARD-04, 05 and 06: what stands by friction and balance alone. A tower of blocks, houses of cards, arches.
#include <cmath>

#include "pfx/base_level/math/trig.h"
#include "pfx/base_level/shape/convex_hull.h"
#include "samples/hard_cases/card_house.h"
#include "samples/hard_cases/witness.h"
#include "samples/shared/builders.h"

namespace samples::hard_cases {
namespace {

using namespace pfx;

void addFloor(World& world, float friction) {
  world.addBody({.name = "floor",
                 .pose = {.position = Vec3(0, -2, 0)},
                 .motion_type = MotionType::Fixed,
                 .shapes = {shape(Box{Vec3(60, 2, 60)})},
                 .restitution = 0.0f,
                 .friction = friction});
}

// Eighteen levels of three blocks, crosswise. After two seconds one of them is drawn out at 2 cm/s.
struct BlockTower final : WitnessedScene {
  static constexpr int kLevels = 18;
  static constexpr float kWidth = 0.25f, kHeight = 0.15f, kLength = 0.75f, kGap = 0.004f;  // m
  BodyId drawn;

  void fill(World& world) override {
    addFloor(world, 0.5f);
    for (int level = 0; level < kLevels; ++level) {
      const Quat turn = rotation(Vec3::UnitY(), level % 2 == 0 ? 0.0f : 0.5f * kPi);
      for (int i = -1; i <= 1; ++i) {
        const Vec3 at(static_cast<float>(i) * (kWidth + kGap), (static_cast<float>(level) + 0.5f) * kHeight, 0);
        const BodyId block = world.addBody({.name = "block",
                                            .pose = {turn * at, turn},
                                            .shapes = {shape(Box{0.5f * Vec3(kWidth, kHeight, kLength)})},
                                            .mass = 10.0f,
                                            .restitution = 0.0f,
                                            .friction = 0.5f});
        if (level == 10 && i == 0) drawn = block;
      }
    }
  }
  void beforeStep(World& world, float) override {
    if (world.stepCount() < 120) return;
    world.state(drawn).linear_velocity = Vec3(0, 0, 0.02f);
  }
  std::vector<Reading> readings(const World& world) const override {
    int displaced = 0;
    for (uint32_t i = 1; i < world.states().size(); ++i)
      if (i != drawn.index && witness().drift(world, i) > 0.01) ++displaced;
    return {{"other blocks more than 1 cm away", "", static_cast<double>(displaced), 3.0},
            {"way of the drawn block", "m", witness().drift(world, drawn.index)}};
  }
};

// Five storeys of cards, leaning by 25 degrees: 30 lean, 10 lie. Friction of tan(25 deg) / 2 =
// 0.233 is what it takes: with 0.6 the house stands, with 0.2 it must fall.
struct CardHouses final : WitnessedScene {
  uint32_t tops[2] = {};

  void fill(World& world) override {
    addFloor(world, 0.6f);
    tops[0] = addCardHouse(world, {.x = -1.3f, .friction = 0.6f});
    tops[1] = addCardHouse(world, {.x = 1.3f, .friction = 0.2f});
  }

  std::vector<Reading> readings(const World& world) const override {
    const auto sunk = [&](uint32_t top) { return double(witness().start[top].y() - world.states()[top].position.y()); };
    return {{"friction 0.6: top sank by", "m", sunk(tops[0]), 0.05},
            {"friction 0.2: top sank by (it must fall)", "m", sunk(tops[1])}};
  }
};

// Semicircles of 21 wedges. They need a thickness of 0.1068 of the radius: 0.115 stands, 0.100 must fall.
struct Arches final : WitnessedScene {
  static constexpr int kWedges = 21;
  static constexpr float kRadius = 5.0f, kDepth = 0.5f;  // m; depth: half extent
  uint32_t keystones[2] = {};

  void fill(World& world) override {
    addFloor(world, 1.0f);
    keystones[0] = addArch(world, -6.2f, 0.115f);
    keystones[1] = addArch(world, 6.2f, 0.100f);
  }

  static uint32_t addArch(World& world, float x, float thickness) {
    const float half = 0.5f * kPi / kWedges;
    const float inner = kRadius * (1.0f - 0.5f * thickness), outer = kRadius * (1.0f + 0.5f * thickness);
    std::vector<Vec3> points;
    for (const float angle : {-half, half})
      for (const float r : {inner, outer})
        for (const float z : {-kDepth, kDepth}) points.emplace_back(r * pfx::sin(angle), r * pfx::cos(angle), z);
    ConvexMesh mesh;
    if (buildConvexMesh(points, mesh) != Error::Ok) throw std::logic_error("the wedge is not a convex mesh");
    const Vec3 centre = mesh.centroid;
    for (Vec3& p : points) p -= centre;
    if (buildConvexMesh(points, mesh) != Error::Ok) throw std::logic_error("the wedge is not a convex mesh");
    const ConvexMesh* wedge = world.keep(std::move(mesh));
    uint32_t keystone = 0;
    for (int i = 0; i < kWedges; ++i) {
      const Quat turn = rotation(Vec3::UnitZ(), (0.5f * static_cast<float>(kWedges - 1) - static_cast<float>(i)) * 2.0f * half);
      const BodyId id = world.addBody({.name = "wedge",
                                       .pose = {Vec3(x, 0, 0) + turn * centre, turn},
                                       .shapes = {shape(wedge)},
                                       .mass = 100.0f,
                                       .restitution = 0.0f,
                                       .friction = 1.0f});
      if (i == kWedges / 2) keystone = id.index;
    }
    return keystone;
  }

  std::vector<Reading> readings(const World& world) const override {
    return {{"0.115: keystone moved by", "m", witness().drift(world, keystones[0]), 0.005},
            {"0.100: keystone moved by (it must fall)", "m", witness().drift(world, keystones[1])}};
  }
};

template <class T>
std::unique_ptr<Scene> make() {
  return std::make_unique<T>();
}

}  // namespace

uint32_t addCardHouse(World& world, const CardHouse& house) {
  constexpr int kStoreys = 5;
  constexpr float kHalf = 0.2f, kDeep = 0.1f;  // m, half extents of a card
  const float x = house.x, thin = house.half_thickness;
  const float lean = 25.0f * kPi / 180.0f, s = pfx::sin(lean), c = pfx::cos(lean);
  const float pitch = 2.0f * kHalf + 0.0002f, rise = 2.0f * (kHalf * c + thin * s);
  const auto addCard = [&](const Vec3& at, float angle) {
    const BodyId card = world.addBody({.name = "card",
                                       .pose = {at, rotation(Vec3::UnitZ(), angle)},
                                       .shapes = {shape(Box{Vec3(thin, kHalf, kDeep)})},
                                       .mass = 50.0f * thin,
                                       .restitution = 0.0f,
                                       .friction = house.friction,
                                       .rolling_resistance = house.rolling_resistance});
    return card.index;
  };
  // A slab of its own friction, so that houses of different friction may share a floor.
  world.addBody({.name = "slab",
                 .pose = {.position = Vec3(x, 0.01f, 0)},
                 .motion_type = MotionType::Fixed,
                 .shapes = {shape(Box{Vec3(1.2f, 0.01f, 0.2f)})},
                 .restitution = 0.0f,
                 .friction = house.friction});
  float base = 0.02f;
  uint32_t top = 0;
  for (int tents = kStoreys; tents > 0; --tents) {
    const auto middle = [&](int i, int count) {
      return x + pitch * (static_cast<float>(i) - 0.5f * static_cast<float>(count - 1));
    };
    for (int i = 0; i < tents; ++i) {
      const float out = kHalf * s + thin * c, y = base + kHalf * c + thin * s;
      addCard({middle(i, tents) - out, y, 0}, -lean);
      top = addCard({middle(i, tents) + out, y, 0}, lean);
    }
    for (int i = 0; i + 1 < tents; ++i) addCard({middle(i, tents - 1), base + rise + thin, 0}, 0.5f * kPi);
    base += rise + 2.0f * thin;
  }
  return top;
}

std::vector<SceneEntry> structureScenes() {
  const std::string_view sample = "hard_cases";
  return {
      {.sample = sample,
       .name = "block_tower",
       .shows = "one block of 54 is drawn out slowly; the tower stays",
       .camera = {.target = {0, 1.35f, 0}, .distance = 5.0f, .yaw_deg = 32.0f, .pitch_deg = 12.0f},
       .frames = {0, 120, 420},
       .world = {},
       .make = make<BlockTower>},
      {.sample = sample,
       .name = "card_houses",
       .shows = "the house of rough cards stands, the one of slippery cards must fall",
       .camera = {.target = {0, 0.85f, 0}, .distance = 5.0f, .yaw_deg = 14.0f, .pitch_deg = 10.0f},
       .frames = {0, 24, 60},
       .world = {},
       .make = make<CardHouses>},
      {.sample = sample,
       .name = "arches",
       .shows = "statics lets the left arch stand by 8 % of its thickness, the right one lacks 6 %",
       .camera = {.target = {0, 2.6f, 0}, .distance = 24.0f, .yaw_deg = 12.0f, .pitch_deg = 8.0f},
       .frames = {0, 60, 120},
       .world = {},
       .make = make<Arches>},
  };
}

}  // namespace samples::hard_cases

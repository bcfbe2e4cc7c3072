#include "samples/tutorial/town.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "pfx/base_level/math/trig.h"
#include "pfx/util/mesh_builder/mesh_builder.h"

namespace samples {
namespace {

using namespace pfx;

constexpr float kHalf = 26.4f, kCell = 2.4f;  // m, of the ground and of its squares
constexpr float kBankFoot = -12.0f, kBankTop = -14.4f,
                kUpper = 2.4f;   // m: the upper town lies north of the square
constexpr float kCoat = 0.012f;  // m, of paint on the mesh

// A house: a box under a gable roof whose ridge runs along x or z.
struct House {
  float x, z;          // m, middle
  float wide, deep;    // m, half extents along x and z
  float eaves, ridge;  // m above the ground
  bool ridge_along_x;
  bool chimney = true;
};

constexpr House kHouses[] = {
    // round the square
    {-10.6f, -7.6f, 2.4f, 2.6f, 4.2f, 6.4f, false},
    {-10.6f, 4.4f, 2.2f, 2.2f, 3.6f, 5.4f, false},
    {-10.4f, 9.4f, 2.4f, 2.0f, 4.6f, 6.6f, true},
    {10.6f, -7.4f, 2.4f, 2.4f, 4.8f, 7.0f, false},
    {10.4f, 4.6f, 2.2f, 2.4f, 3.8f, 5.8f, false},
    {10.8f, 9.8f, 2.4f, 2.0f, 3.4f, 5.2f, true},
    {-4.6f, 11.6f, 2.2f, 2.2f, 4.0f, 6.0f, true},
    {4.8f, 11.8f, 2.4f, 2.4f, 4.4f, 6.4f, true},
    // behind
    {-17.4f, -8.2f, 2.6f, 2.4f, 3.4f, 5.2f, true},
    {-17.6f, 4.8f, 2.4f, 2.6f, 4.0f, 6.0f, false},
    {-17.4f, 11.0f, 2.6f, 2.2f, 3.2f, 5.0f, true},
    {17.4f, -8.0f, 2.4f, 2.6f, 3.8f, 5.8f, false},
    {17.6f, 4.6f, 2.4f, 2.4f, 4.2f, 6.2f, true},
    {17.4f, 10.8f, 2.4f, 2.4f, 3.4f, 5.4f, false},
    {-4.8f, 18.6f, 2.4f, 2.4f, 3.6f, 5.4f, false},
    {4.8f, 18.8f, 2.2f, 2.4f, 3.8f, 5.8f, false},
    {-11.2f, 18.4f, 2.4f, 2.2f, 3.4f, 5.2f, true},
    {11.4f, 18.6f, 2.6f, 2.2f, 4.0f, 6.0f, true},
    // the upper town
    {-9.2f, -18.6f, 2.4f, 2.2f, 3.6f, 5.6f, true},
    {-15.4f, -18.8f, 2.2f, 2.6f, 4.0f, 6.0f, false},
    {9.4f, -18.6f, 2.4f, 2.2f, 3.8f, 5.8f, true},
    {15.6f, -19.0f, 2.4f, 2.4f, 3.4f, 5.2f, false},
};

class Builder {
 public:
  Town town;

  // Corners counter-clockwise seen from outside.
  void triangle(const Vec3& a, const Vec3& b, const Vec3& c, TownPart part) {
    const auto first = static_cast<uint32_t>(town.points.size());
    town.user_data.push_back(static_cast<uint32_t>(town.numTriangles()) << 3 | static_cast<uint32_t>(part));
    town.points.insert(town.points.end(), {a, b, c});
    town.indices.insert(town.indices.end(), {first, first + 1, first + 2});
  }
  void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, TownPart part) {
    triangle(a, b, c, part);
    triangle(a, c, d, part);
  }

  // Four walls and a lid; no floor.
  void block(const Vec3& low, const Vec3& high, TownPart wall, TownPart lid) {
    const float x0 = low.x(), y0 = low.y(), z0 = low.z(), x1 = high.x(), y1 = high.y(), z1 = high.z();
    quad({x0, y0, z1}, {x1, y0, z1}, {x1, y1, z1}, {x0, y1, z1}, wall);
    quad({x1, y0, z0}, {x0, y0, z0}, {x0, y1, z0}, {x1, y1, z0}, wall);
    quad({x1, y0, z1}, {x1, y0, z0}, {x1, y1, z0}, {x1, y1, z1}, wall);
    quad({x0, y0, z0}, {x0, y0, z1}, {x0, y1, z1}, {x0, y1, z0}, wall);
    quad({x0, y1, z1}, {x1, y1, z1}, {x1, y1, z0}, {x0, y1, z0}, lid);
  }

  // A painted rectangle on a wall: middle, half sides.
  void pane(const Vec3& middle, const Vec3& right, const Vec3& up) {
    const Vec3 lift = 2.0f * kCoat * right.cross(up).normalized();
    const auto first = static_cast<uint32_t>(town.window_points.size());
    for (const auto& [s, t] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}})
      town.window_points.push_back(middle + lift + s * right + t * up);
    town.window_indices.insert(town.window_indices.end(),
                               {first, first + 1, first + 2, first, first + 2, first + 3});
  }
};

Vec3 at(const House& h, float along, float y, float across) {
  return h.ridge_along_x ? Vec3(h.x + along, y, h.z - across) : Vec3(h.x + across, y, h.z + along);
}

// Windows on two floors of the long walls, a door in the middle of one.
void addWindows(Builder& b, const House& h, float ground) {
  const float length = h.ridge_along_x ? h.wide : h.deep, depth = h.ridge_along_x ? h.deep : h.wide;
  for (const float side : {-1.0f, 1.0f}) {
    const Vec3 right = -side * (at(h, 0.32f, 0.0f, 0.0f) - at(h, 0.0f, 0.0f, 0.0f)), up(0.0f, 0.45f, 0.0f);
    for (const float along : {-0.6f, 0.0f, 0.6f}) {
      if (along == 0.0f)
        b.pane(at(h, 0.0f, ground + 0.85f, side * depth), 1.3f * right, Vec3(0.0f, 0.85f, 0.0f));
      else
        b.pane(at(h, along * length, ground + 1.35f, side * depth), right, up);
      if (h.eaves > 3.5f) b.pane(at(h, along * length, ground + h.eaves - 0.95f, side * depth), right, up);
    }
  }
}

void addChimney(Builder& b, const House& h, float ground) {
  const Vec3 c = at(h, 0.55f * (h.ridge_along_x ? h.wide : h.deep), 0.0f, 0.5f);
  const float top = ground + h.ridge + 0.5f;
  b.block(Vec3(c.x() - 0.3f, ground + h.eaves, c.z() - 0.3f), Vec3(c.x() + 0.3f, top, c.z() + 0.3f),
          TownPart::Stone, TownPart::Stone);
}

void addHouse(Builder& b, const House& h) {
  constexpr float kOver = 0.35f, kThick = 0.18f;  // m, of the roof
  const float g = townGround(h.x, h.z), length = h.ridge_along_x ? h.wide : h.deep;
  const float depth = h.ridge_along_x ? h.deep : h.wide, eaves = g + h.eaves, ridge = g + h.ridge;
  const auto p = [&](float along, float y, float across) { return at(h, along, y, across); };
  const float drop = kOver * (h.ridge - h.eaves) / depth;  // of the eaves below the top of the wall
  for (const float side : {-1.0f, 1.0f}) {
    const auto q = [&](float along, float y, float across) { return p(side * along, y, side * across); };
    b.quad(q(length, g - 0.3f, depth), q(-length, g - 0.3f, depth), q(-length, eaves, depth),
           q(length, eaves, depth), TownPart::Wall);
    b.quad(q(length, g - 0.3f, -depth), q(length, g - 0.3f, depth), q(length, eaves, depth),
           q(length, eaves, -depth), TownPart::Wall);
    b.triangle(q(length, eaves, -depth), q(length, eaves, depth), q(length, ridge, 0.0f), TownPart::Wall);
    const float l = length + kOver, d = depth + kOver, low = eaves - drop;
    b.quad(q(l, low + kThick, d), q(-l, low + kThick, d), q(-l, ridge + kThick, 0.0f),
           q(l, ridge + kThick, 0.0f), TownPart::Roof);
    b.quad(q(l, low, d), q(-l, low, d), q(-l, low + kThick, d), q(l, low + kThick, d), TownPart::Roof);
    b.quad(q(l, low, d), q(l, low + kThick, d), q(l, ridge + kThick, 0.0f), q(l, ridge, 0.0f),
           TownPart::Roof);
    b.quad(q(-l, low + kThick, d), q(-l, low, d), q(-l, ridge, 0.0f), q(-l, ridge + kThick, 0.0f),
           TownPart::Roof);
  }
  if (h.chimney) addChimney(b, h, g);
  addWindows(b, h, g);
}

TownPart groundPart(float x, float z) {
  const bool square = std::abs(x) < 8.4f && std::abs(z) < 8.4f;
  const bool street =
      (std::abs(z) < 2.4f && std::abs(x) < 24.0f) || (std::abs(x) < 2.4f && std::abs(z) < 24.0f);
  return square || street ? TownPart::Paving : TownPart::Grass;
}

void addGroundOf(Builder& b) {
  constexpr int kCells = static_cast<int>(2.0f * kHalf / kCell + 0.5f);
  const auto p = [](int i, int k) {
    const float x = kCell * static_cast<float>(i) - kHalf, z = kCell * static_cast<float>(k) - kHalf;
    return Vec3(x, townGround(x, z), z);
  };
  for (int i = 0; i < kCells; ++i)
    for (int k = 0; k < kCells; ++k) {
      const Vec3 middle = 0.5f * (p(i, k) + p(i + 1, k + 1));
      b.quad(p(i, k), p(i, k + 1), p(i + 1, k + 1), p(i + 1, k), groundPart(middle.x(), middle.z()));
    }
}

void addStairs(Builder& b) {
  constexpr int kSteps = 8;
  const float rise = kUpper / static_cast<float>(kSteps), tread = 0.45f;
  for (int i = 0; i < kSteps; ++i) {
    const float z = kBankTop + tread * static_cast<float>(kSteps - i), y = rise * static_cast<float>(i);
    b.quad({-2.2f, y, z}, {2.2f, y, z}, {2.2f, y + rise, z}, {-2.2f, y + rise, z}, TownPart::Step);
    b.quad({-2.2f, y + rise, z}, {2.2f, y + rise, z}, {2.2f, y + rise, z - tread},
           {-2.2f, y + rise, z - tread}, TownPart::Step);
  }
  for (const float x : {-2.5f, 2.2f})
    for (int i = 0; i < kSteps; i += 2) {
      const float z = kBankTop + tread * static_cast<float>(kSteps - i), y = rise * static_cast<float>(i + 2);
      b.block({x, -0.3f, z - 2.0f * tread}, {x + 0.3f, y + 0.5f, z}, TownPart::Stone, TownPart::Stone);
    }
}

Vec3 onCircle(float radius, float y, int corner, int corners, const Vec3& center) {
  const SinCos turn = sincos(2.0f * kPi * static_cast<float>(corner) / static_cast<float>(corners));
  return center + Vec3(radius * turn.sin, y, radius * turn.cos);
}

void addFountain(Builder& b) {
  constexpr int kSides = 12;
  const Vec3 c(0.0f, 0.0f, 0.0f);
  const auto ring = [&](float r0, float y0, float r1, float y1, TownPart part) {
    for (int i = 0; i < kSides; ++i)
      b.quad(onCircle(r0, y0, i, kSides, c), onCircle(r0, y0, i + 1, kSides, c),
             onCircle(r1, y1, i + 1, kSides, c), onCircle(r1, y1, i, kSides, c), part);
  };
  ring(2.6f, -0.1f, 2.6f, 0.6f, TownPart::Stone);
  ring(2.6f, 0.6f, 2.25f, 0.6f, TownPart::Stone);
  ring(2.25f, 0.6f, 2.25f, 0.3f, TownPart::Stone);
  ring(2.25f, 0.3f, 0.4f, 0.3f, TownPart::Water);
  ring(0.4f, 0.3f, 0.3f, 1.7f, TownPart::Stone);
  ring(0.3f, 1.7f, 0.9f, 1.9f, TownPart::Stone);
  for (int i = 0; i < kSides; ++i)
    b.triangle(onCircle(0.9f, 1.9f, i, kSides, c), onCircle(0.9f, 1.9f, i + 1, kSides, c),
               c + Vec3(0.0f, 2.0f, 0.0f), TownPart::Stone);
}

void addChurch(Builder& b) {
  addHouse(b, {0.0f, -20.6f, 2.6f, 4.2f, 5.4f, 8.6f, false, false});
  const float x0 = -1.5f, x1 = 1.5f, z0 = -18.2f, z1 = -15.6f, top = kUpper + 10.5f, spire = top + 4.5f;
  b.block({x0, kUpper - 0.3f, z0}, {x1, top, z1}, TownPart::Wall, TownPart::Wall);
  const Vec3 tip(0.0f, spire, 0.5f * (z0 + z1));
  const float o = 0.3f;
  const std::array<Vec3, 4> eaves = {Vec3(x0 - o, top, z1 + o), Vec3(x1 + o, top, z1 + o),
                                     Vec3(x1 + o, top, z0 - o), Vec3(x0 - o, top, z0 - o)};
  for (size_t i = 0; i < 4; ++i) b.triangle(eaves[i], eaves[(i + 1) % 4], tip, TownPart::Roof);
  b.quad(eaves[3], eaves[2], eaves[1], eaves[0], TownPart::Roof);
  b.pane({0.0f, kUpper + 1.2f, z1}, {0.7f, 0.0f, 0.0f}, {0.0f, 1.2f, 0.0f});
  b.pane({0.0f, kUpper + 5.0f, z1}, {0.45f, 0.0f, 0.0f}, {0.0f, 0.8f, 0.0f});
  for (const float side : {-1.0f, 1.0f})
    b.pane({side * x1, kUpper + 8.6f, tip.z()}, {0.0f, 0.0f, -side * 0.5f}, {0.0f, 0.9f, 0.0f});
  b.pane({0.0f, kUpper + 8.6f, z1}, {0.5f, 0.0f, 0.0f}, {0.0f, 0.9f, 0.0f});
}

// Low walls along the edge of the upper town, on both sides of the stairs, and benches on the square.
void addWalls(Builder& b) {
  for (const float side : {-1.0f, 1.0f}) {
    const float x0 = side < 0.0f ? -20.4f : 3.2f, x1 = side < 0.0f ? -3.2f : 20.4f;
    b.block({x0, kUpper - 0.4f, kBankTop - 0.5f}, {x1, kUpper + 0.7f, kBankTop - 0.1f}, TownPart::Stone,
            TownPart::Stone);
    for (const float z : {-5.0f, 5.0f})
      b.block({side * 5.0f - 0.9f, -0.1f, z - 0.3f}, {side * 5.0f + 0.9f, 0.45f, z + 0.3f}, TownPart::Step,
              TownPart::Step);
  }
}

constexpr Color kColors[kNumTownParts] = {0xff9bab7au, 0xffcfc6b4u, 0xffeadfc8u, 0xffbe6a4au,
                                          0xffa9a59bu, 0xffd8cfbeu, 0xff6f9fb5u};
constexpr Color kWindowColor = 0xff4d4a45u;

}  // namespace

std::string_view toString(TownPart part) {
  constexpr std::array<std::string_view, kNumTownParts> kNames = {"grass", "paving", "wall", "roof",
                                                                  "stone", "step",   "water"};
  return kNames[static_cast<size_t>(part)];
}

float townGround(float x, float z) {
  const float bank = std::clamp((kBankFoot - z) / (kBankFoot - kBankTop), 0.0f, 1.0f) * kUpper;
  const float out = std::max({std::abs(x) - 21.6f, std::abs(z) - 21.6f, 0.0f});
  return bank + 0.6f * out;
}

Town makeTown() {
  Builder b;
  addGroundOf(b);
  for (const House& h : kHouses) addHouse(b, h);
  addChurch(b);
  addStairs(b);
  addFountain(b);
  addWalls(b);
  return std::move(b.town);
}

LargeMesh makeTownMesh(const Town& town) {
  LargeMeshOptions options;
  options.type = LargeMeshType::QuantizedBvh;
  options.user_data = town.user_data;
  LargeMeshResult built = buildLargeMesh(town.points, town.indices, options);
  if (built.error != Error::Ok) throw std::logic_error("the town is not a mesh");
  return std::move(built.mesh);
}

TownPainter::TownPainter(const Town& town) {
  for (size_t t = 0; t < town.numTriangles(); ++t) {
    Coat& coat = coats_[static_cast<size_t>(partOf(town.user_data[t]))];
    const Vec3 &a = town.points[town.indices[3 * t]], &b = town.points[town.indices[3 * t + 1]],
               &c = town.points[town.indices[3 * t + 2]];
    const Vec3 lift = kCoat * (b - a).cross(c - a).normalized();
    for (const Vec3& p : {a, b, c}) {
      coat.indices.push_back(static_cast<uint32_t>(coat.points.size()));
      coat.points.push_back(p + lift);
    }
  }
  windows_ = {town.window_points, town.window_indices};
}

void TownPainter::draw(Canvas& canvas) const {
  for (int i = 0; i < kNumTownParts; ++i)
    canvas.surface({.points = coats_[i].points, .indices = coats_[i].indices},
                   {kColors[i], i == static_cast<int>(TownPart::Water) ? Finish::Glossy : Finish::Matte});
  canvas.surface({.points = windows_.points, .indices = windows_.indices}, {kWindowColor, Finish::Glossy});
}

}  // namespace samples

#include "samples/9_particle_physics/particle_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "pfx/high_level/particles/particle_builder.h"

namespace samples {

using namespace pfx;

namespace {

// Turn that takes the x axis to a unit vector.
Quat turnFromX(const Vec3& direction) {
  const Vec3 axis = Vec3::UnitX().cross(direction);
  const Quat twice(1.0f + direction.x(), axis.x(), axis.y(), axis.z());
  return direction.x() > -0.9999f ? Quat(twice.normalized()) : Quat(0.0f, 0.0f, 1.0f, 0.0f);
}

float strainOf(const ParticleSystem& p, const ParticleStrand& s, size_t link) {
  return (p.positions()[s.particles[link]] - p.positions()[s.particles[link + 1]]).norm() / s.lengths[link] - 1.0f;
}

uint32_t blend(float a, float b, float t) { return static_cast<uint32_t>(a + t * (b - a)); }

}  // namespace

Color heatColor(float heat) {
  constexpr std::array<std::array<float, 3>, 4> kStops = {{{30, 80, 190}, {30, 150, 90}, {230, 170, 30}, {210, 40, 30}}};
  const float t = 3.0f * std::clamp(heat, 0.0f, 1.0f);
  const auto k = std::min(static_cast<size_t>(t), size_t(2));
  const float f = t - static_cast<float>(k);
  const auto channel = [&](size_t i) { return blend(kStops[k][i], kStops[k + 1][i], f); };
  return 0xff000000u | channel(0) << 16 | channel(1) << 8 | channel(2);
}

namespace {

constexpr int kFiner = 3;         // points of the drawn surface from particle to particle
constexpr int kCheck = 4;         // every so many threads
constexpr float kCheckLift = 0.003f, kThreadLift = 0.006f;  // m, above the surface
constexpr float kPulled = 0.1f;   // share of kShownStrain from which a thread is coloured

// A sheet as a finer grid on the smooth surface through its particles (E. Catmull, R. Rom, A Class of Local Interpolating
// Splines, 1974), which shows folds round where the particles would show corners.
class SmoothSheet {
 public:
  SmoothSheet(std::span<const Vec3> particles, int columns, int rows)
      : columns_(kFiner * (columns - 1) + 1), rows_(kFiner * (rows - 1) + 1) {
    std::vector<Vec3> along;  // (rows x finer columns)
    for (int r = 0; r < rows; ++r) refine(particles.subspan(static_cast<size_t>(r * columns)), {columns, 1}, along);
    std::vector<Vec3> across;  // (finer columns x finer rows)
    for (int c = 0; c < columns_; ++c) refine(std::span(along).subspan(static_cast<size_t>(c)), {rows, columns_}, across);
    for (int r = 0; r < rows_; ++r)
      for (int c = 0; c < columns_; ++c) points_.push_back(across[static_cast<size_t>(c * rows_ + r)]);
  }

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  std::span<const Vec3> points() const { return points_; }
  std::vector<uint32_t> triangles() const { return clothTriangles(columns_, rows_); }
  const Vec3& at(int r, int c) const { return points_[static_cast<size_t>(r * columns_ + c)]; }
  Vec3 normal(int r, int c) const {
    const int up = std::min(r + 1, rows_ - 1), down = std::max(r - 1, 0);
    const int right = std::min(c + 1, columns_ - 1), left = std::max(c - 1, 0);
    return (at(up, c) - at(down, c)).cross(at(r, right) - at(r, left)).normalized();
  }

 private:
  struct Run {
    int count, stride;
  };
  static void refine(std::span<const Vec3> from, const Run& run, std::vector<Vec3>& to) {
    const auto at = [&](int i) { return from[static_cast<size_t>(std::clamp(i, 0, run.count - 1) * run.stride)]; };
    for (int i = 0; i + 1 < run.count; ++i)
      for (int k = 0; k < kFiner; ++k) {
        const float t = static_cast<float>(k) / kFiner;
        const Vec3 a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
        to.push_back(b + 0.5f * t * ((c - a) + t * ((2.0f * a - 5.0f * b + 4.0f * c - d) + t * (3.0f * (b - c) + d - a))));
      }
    to.push_back(at(run.count - 1));
  }

  int columns_, rows_;
  std::vector<Vec3> points_;
};

// Stripes of one fine cell along and across, `lift` (m) above the sheet or, when negative, below it.
struct Check {
  std::vector<Vec3> points;
  std::vector<uint32_t> triangles;

  Check(const SmoothSheet& sheet, float lift) {
    for (int r = 0; r + 1 < sheet.rows(); r += kFiner * kCheck) addStripe(sheet, {r, true}, lift);
    for (int c = 0; c + 1 < sheet.columns(); c += kFiner * kCheck) addStripe(sheet, {c, false}, lift);
    if (lift < 0.0f)
      for (size_t i = 0; i < triangles.size(); i += 3) std::swap(triangles[i], triangles[i + 1]);
  }

 private:
  struct Line {
    int at;      // row or column of the fine grid
    bool along;  // a row
  };
  void addStripe(const SmoothSheet& sheet, const Line& line, float lift) {
    const int count = line.along ? sheet.columns() : sheet.rows();
    for (int k = 0; k < count; ++k) {
      const auto a = static_cast<uint32_t>(points.size()), b = a + 1, c = a + 2, d = a + 3;
      for (const int side : {0, 1}) {
        const int row = line.along ? line.at + side : k, column = line.along ? k : line.at + side;
        points.push_back(sheet.at(row, column) + lift * sheet.normal(row, column));
      }
      if (k + 1 == count) continue;
      if (line.along)
        triangles.insert(triangles.end(), {a, b, d, a, d, c});
      else
        triangles.insert(triangles.end(), {a, c, d, a, d, b});
    }
  }
};

// A link of a sheet from one particle to the next along its row or down its column.
struct Link {
  int row, column;
  bool along;
};

// On both sides of the surface.
void drawThread(const SmoothSheet& sheet, const Link& link, const Stroke& stroke, Canvas& canvas) {
  int r = kFiner * link.row, c = kFiner * link.column;
  for (int k = 0; k < kFiner; ++k) {
    const int r1 = r + (link.along ? 0 : 1), c1 = c + (link.along ? 1 : 0);
    const Vec3 from = kThreadLift * sheet.normal(r, c), to = kThreadLift * sheet.normal(r1, c1);
    canvas.line(sheet.at(r, c) + from, sheet.at(r1, c1) + to, stroke);
    canvas.line(sheet.at(r, c) - from, sheet.at(r1, c1) - to, stroke);
    r = r1, c = c1;
  }
}

}  // namespace

void drawSheet(const ParticleSystem& p, const SheetView& v, Canvas& canvas) {
  const SmoothSheet sheet(p.positions().subspan(v.first), v.columns, v.rows);
  canvas.surface({.points = sheet.points(), .indices = sheet.triangles(), .two_sided = true}, v.paint);
  for (const float lift : {kCheckLift, -kCheckLift}) {
    const Check check(sheet, lift);
    canvas.surface({.points = check.points, .indices = check.triangles}, {v.check, v.paint.finish});
  }
  const auto columns = static_cast<uint32_t>(v.columns), end = v.first + columns * static_cast<uint32_t>(v.rows);
  for (const ParticleStrand& s : p.strands()) {
    if (s.particles.front() < v.first || s.particles.front() >= end) continue;
    for (size_t k = 0; k + 1 < s.particles.size(); ++k) {
      const float heat = std::abs(strainOf(p, s, k)) / kShownStrain;
      if (heat < kPulled) continue;
      const uint32_t from = s.particles[k] - v.first;
      const Link link{static_cast<int>(from / columns), static_cast<int>(from % columns),
                      s.particles[k + 1] == s.particles[k] + 1};
      drawThread(sheet, link, {heatColor(heat), 1.6f}, canvas);
    }
  }
}

namespace {

void drawRod(const Vec3& a, const Vec3& b, float radius, const Paint& paint, Canvas& canvas) {
  const float length = (b - a).norm();
  if (length > 0.0f)
    canvas.solid(Capsule{0.5f * length, radius}, {0.5f * (a + b), turnFromX((b - a) / length)}, paint);
}

float radiusAt(const ThreadView& view, size_t link, size_t links) {
  const float share = links > 1 ? static_cast<float>(link) / static_cast<float>(links - 1) : 0.0f;
  return view.radius * (1.0f - share * (1.0f - view.tip));
}

}  // namespace

void drawStrand(const ParticleSystem& p, const ParticleStrand& s, const ThreadView& view, Canvas& canvas) {
  const size_t links = s.particles.size() - 1;
  for (size_t k = 0; k < links; ++k) {
    Paint paint = view.paint;
    if (view.strain) paint.color = heatColor(std::abs(strainOf(p, s, k)) / kShownStrain);
    drawRod(p.positions()[s.particles[k]], p.positions()[s.particles[k + 1]], radiusAt(view, k, links), paint, canvas);
  }
}

void drawRods(std::span<const Vec3> path, const ThreadView& view, Canvas& canvas) {
  for (size_t k = 0; k + 1 < path.size(); ++k)
    drawRod(path[k], path[k + 1], radiusAt(view, k, path.size() - 1), view.paint, canvas);
}

void ParticleScene::add(World& world, ParticleDef def) {
  def.settings.substeps = static_cast<int>(substeps_);
  def.settings.iterations = static_cast<int>(iterations_);
  def.settings.friction = friction_;
  def.settings.damping = damping_;
  id_ = world.addParticles(def);
}

void ParticleScene::beforeStep(World& world, float dt) {
  script(world, dt);
  ParticleSettings s = world.particles(id_).settings();
  s.substeps = std::max(1, static_cast<int>(substeps_));
  s.iterations = std::max(1, static_cast<int>(iterations_));
  s.friction = friction_;
  s.damping = damping_;
  world.particles(id_).setSettings(s);
}

void ParticleScene::afterStep(World& world, float) {
  worst_strain_ = std::max(worst_strain_, particles(world).maxStrain());
}

std::vector<Parameter> ParticleScene::parameters() {
  return {{"sub-steps", "", &substeps_, 1.0f, 32.0f},
          {"rounds a sub-step", "", &iterations_, 1.0f, 8.0f},
          {"friction", "", &friction_, 0.0f, 1.5f},
          {"damping", "1/s", &damping_, 0.0f, 5.0f}};
}

std::vector<Reading> ParticleScene::readings(const World& world) const {
  return {{"largest strain now", "%", 100.0 * particles(world).maxStrain(), strain_limit_},
          {"largest strain so far", "%", 100.0 * worst_strain_, strain_limit_},
          {"particles", "", static_cast<double>(particles(world).positions().size())}};
}

}  // namespace samples

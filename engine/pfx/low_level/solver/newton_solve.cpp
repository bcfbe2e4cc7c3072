// Newton's method on the velocities of an island: gradient, factor, exact line search.
#include <algorithm>
#include <cmath>

#include "pfx/low_level/solver/direct_factor.h"
#include "pfx/low_level/solver/newton_island.h"

namespace pfx {
namespace {

constexpr int kMaxIterations = 20;
// The circle of friction follows the normal impulses up to this iteration; with fixed circles the problem is
// convex and every further one descends.
constexpr int kRadiusIterations = 8;
constexpr int kMaxLineSteps = 12;
constexpr int kWarmIterations = 6;
// Error above which a guess counts as bad, in units of the tolerance.
constexpr double kCold = 1e3;
constexpr int kSoftLevels = 6;
constexpr double kSoftFactor = 3.0;
constexpr int kSoftIterations = 2;
// A step is long enough when the slope has fallen to this share.
constexpr double kFlat = 0.05;

Vec3d head(const double* v) { return Vec3d(v[0], v[1], v[2]); }
Vec3d tail(const double* v) { return Vec3d(v[3], v[4], v[5]); }

}  // namespace

void NewtonIsland::evaluate(bool fix_radius) {
  for (NewtonContact& c : contacts_) {
    const double *va = velocityOf(c.body[0]), *vb = velocityOf(c.body[1]);
    for (int i = 0; i < c.num_points; ++i) {
      NewtonPoint& p = c.points[i];
      rowSpeeds(c, p, va, vb, p.speed);
      if (!fix_radius)
        p.radius = c.friction * std::max(0.0, p.base[0] - p.stiffness[0] * (p.speed[0] + p.bias));
      impulsesAt(p, p.speed, p.impulse);
    }
  }
  for (NewtonJoint& n : joints_) pfx::evaluate(n, velocityOf(n.joint.body[0]), velocityOf(n.joint.body[1]));
}

// Gradient M (v - free) - J^T f; returns the largest speed that it would change a body by.
double NewtonIsland::gradient() {
  for (uint32_t i : moving_) {
    const double *v = velocityOf(i), *free = &free_velocity_[size_t(i) * 6];
    const Vec3d p = (head(v) - head(free)) / bodies_[i].inv_mass, l = inertia_[i] * (tail(v) - tail(free));
    double* g = &gradient_[size_t(i) * 6];
    for (int k = 0; k < 3; ++k) g[k] = p[k], g[3 + k] = l[k];
  }
  for (const NewtonContact& c : contacts_)
    for (int i = 0; i < c.num_points; ++i)
      addImpulse(c, c.points[i], -1.0, &gradient_[size_t(c.body[0]) * 6], &gradient_[size_t(c.body[1]) * 6]);
  for (const NewtonJoint& n : joints_)
    addImpulses(n, -1.0, &gradient_[size_t(n.joint.body[0]) * 6], &gradient_[size_t(n.joint.body[1]) * 6]);
  double worst = 0.0;
  for (uint32_t i : moving_) {
    const double* g = &gradient_[size_t(i) * 6];
    const DirectBody& b = bodies_[i];
    const double energy = b.inv_mass * head(g).squaredNorm() + tail(g).dot(b.inverse * tail(g));
    worst = std::max(worst, b.inv_mass * energy);
  }
  return std::sqrt(worst);
}

void NewtonIsland::factor() {
  bool changed = !factored_;
  for (NewtonContact& c : contacts_)
    for (int i = 0; i < c.num_points; ++i) changed = setCurvature(c.points[i]) || changed;
  for (NewtonJoint& n : joints_) changed = setCurvature(n) || changed;
  if (!changed) return;
  factored_ = true;
  std::fill(diagonal_.begin(), diagonal_.end(), 0.0);
  std::fill(off_diagonal_.begin(), off_diagonal_.end(), 0.0);
  const auto diagonal = [&](uint32_t body) {
    return &diagonal_[size_t(elimination_.position(block_of_[body])) * 36];
  };
  for (uint32_t i : moving_) {
    double* d = diagonal(i);
    for (int k = 0; k < 3; ++k) d[7 * k] = 1.0 / bodies_[i].inv_mass;
    for (int r = 0; r < 3; ++r)
      for (int k = 0; k < 3; ++k) d[6 * (3 + r) + 3 + k] = inertia_[i](r, k);
  }
  const auto blocks = [&](const uint32_t (&body)[2], const bool (&moves)[2], uint32_t block) -> NewtonBlocks {
    return {moves[0] ? diagonal(body[0]) : nullptr, moves[1] ? diagonal(body[1]) : nullptr,
            moves[0] && moves[1] ? &off_diagonal_[size_t(block) * 36] : nullptr};
  };
  for (const NewtonContact& c : contacts_) addCurvature(c, blocks(c.body, c.moves, c.block));
  for (const NewtonJoint& n : joints_) addCurvature(n, blocks(n.joint.body, n.joint.moves, n.block));
  factorDirect<6>(elimination_.structure(), {diagonal_, off_diagonal_}, scratch_);
}

void NewtonIsland::search() {
  for (uint32_t i : moving_)
    for (int k = 0; k < 6; ++k)
      x_[size_t(elimination_.position(block_of_[i])) * 6 + k] = -gradient_[size_t(i) * 6 + k];
  solveDirect<6>(elimination_.structure(), {diagonal_, off_diagonal_}, x_);
  for (uint32_t i : moving_)
    for (int k = 0; k < 6; ++k)
      direction_[size_t(i) * 6 + k] = x_[size_t(elimination_.position(block_of_[i])) * 6 + k];
  for (NewtonContact& c : contacts_)
    for (int i = 0; i < c.num_points; ++i)
      rowSpeeds(c, c.points[i], &direction_[size_t(c.body[0]) * 6], &direction_[size_t(c.body[1]) * 6],
                c.points[i].change);
  for (NewtonJoint& n : joints_)
    setChange(n, &direction_[size_t(n.joint.body[0]) * 6], &direction_[size_t(n.joint.body[1]) * 6]);
}

// Slope of the objective along the search direction.
double NewtonIsland::slopeAt(double step) const {
  double sum = 0.0;
  for (uint32_t i : moving_) {
    const double *d = &direction_[size_t(i) * 6], *v = &velocity_[size_t(i) * 6],
                 *free = &free_velocity_[size_t(i) * 6];
    const Vec3d p = head(v) + step * head(d) - head(free), w = tail(v) + step * tail(d) - tail(free);
    sum += head(d).dot(p) / bodies_[i].inv_mass + tail(d).dot(inertia_[i] * w);
  }
  for (const NewtonContact& c : contacts_) {
    for (int i = 0; i < c.num_points; ++i) {
      const NewtonPoint& p = c.points[i];
      double speed[3], impulse[3];
      for (int k = 0; k < 3; ++k) speed[k] = p.speed[k] + step * p.change[k];
      impulsesAt(p, speed, impulse);
      sum -= impulse[0] * p.change[0] + impulse[1] * p.change[1] + impulse[2] * p.change[2];
    }
  }
  for (const NewtonJoint& n : joints_) sum += pfx::slopeAt(n, step);
  return sum;
}

// The whole step, unless the slope has turned there; then between, by false position (Illinois).
double NewtonIsland::lineSearch(double slope) const {
  double low = 0.0, low_slope = slope, high = 1.0, high_slope = slopeAt(1.0);
  if (high_slope <= -kFlat * slope) return 1.0;
  for (int i = 0; i < kMaxLineSteps; ++i) {
    const double middle = low + (high - low) * low_slope / (low_slope - high_slope);
    const double at = slopeAt(middle);
    if (std::abs(at) <= -kFlat * slope) return middle;
    if (at < 0.0) {
      low = middle, low_slope = at, high_slope *= 0.5;
    } else {
      high = middle, high_slope = at, low_slope *= 0.5;
    }
  }
  return low > 0.0 ? low : high;
}

double NewtonIsland::iterate(int most) {
  for (int i = 0;; ++i) {
    evaluate(i >= kRadiusIterations);
    const double error = gradient();
    if (error <= tolerance_ || i == most) return error;
    factor();
    search();
    double slope = 0.0;
    for (uint32_t b : moving_)
      for (int k = 0; k < 6; ++k) slope += gradient_[size_t(b) * 6 + k] * direction_[size_t(b) * 6 + k];
    if (!(slope < 0.0)) return error;
    const double step = lineSearch(slope);
    for (uint32_t b : moving_)
      for (int k = 0; k < 6; ++k) velocityOf(b)[k] += step * direction_[size_t(b) * 6 + k];
    ++iterations_;
  }
}

void NewtonIsland::soften(double factor) {
  for (NewtonContact& c : contacts_)
    for (int i = 0; i < c.num_points; ++i)
      for (double& k : c.points[i].stiffness) k *= factor;
}

// From a good guess a few iterations do. From a bad one (an impact, a new load, a change of solver) contacts
// would come and go one by one; then it starts with contacts that give way, which find their balance at once,
// and stiffens them.
void NewtonIsland::solve() {
  if (iterate(kWarmIterations) > kCold * tolerance_) {
    double softened = 1.0;
    for (int i = 0; i < kSoftLevels; ++i) softened /= kSoftFactor;
    soften(softened);
    for (int i = 0; i < kSoftLevels; ++i) {
      iterate(kSoftIterations);
      soften(kSoftFactor);
    }
  }
  iterate(kMaxIterations);
}

}  // namespace pfx

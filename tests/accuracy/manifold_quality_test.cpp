// ACC-32: the four points of a box turned on another by 0 to 45 degrees, against the exact polygon of their overlap.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "pfx/base_level/collision/pair_table.h"
#include "pfx/low_level/solver/soft_step.h"

namespace pfx {
namespace {

struct Point {
  double x, y;
};

// The square of half extent one, cut by the same square turned by `angle`. Sutherland and Hodgman in double precision.
std::vector<Point> overlap(double angle) {
  std::vector<Point> p = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  for (int k = 0; k < 4; ++k) {
    const double nx = std::cos(angle + k * M_PI_2), ny = std::sin(angle + k * M_PI_2);
    std::vector<Point> out;
    for (size_t i = 0; i < p.size(); ++i) {
      const Point a = p[i], b = p[(i + 1) % p.size()];
      const double da = nx * a.x + ny * a.y - 1.0, db = nx * b.x + ny * b.y - 1.0;
      if (da <= 0.0) out.push_back(a);
      if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) {
        const double t = da / (da - db);
        out.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
      }
    }
    p = out;
  }
  return p;
}

double area(const std::vector<Point>& p) {
  double sum = 0.0;
  for (size_t i = 0; i < p.size(); ++i) {
    const Point a = p[i], b = p[(i + 1) % p.size()];
    sum += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return sum;
}

// Mean distance from the centre under uniform pressure: friction torque is mu N times it. Of the triangle from the centre
// to an edge at distance d the integral of r over the area is d^3 / 3 times that of sec^3, which has a closed form.
double frictionRadius(const std::vector<Point>& p) {
  double integral = 0.0;
  for (size_t i = 0; i < p.size(); ++i) {
    const Point a = p[i], b = p[(i + 1) % p.size()];
    const double length = std::hypot(b.x - a.x, b.y - a.y), d = (a.x * b.y - a.y * b.x) / length;
    const auto sec3 = [&](const Point& q) {
      const double t = ((b.x - a.x) * q.x + (b.y - a.y) * q.y) / length / d;  // tangent of the angle from the foot
      return 0.5 * (t * std::sqrt(1.0 + t * t) + std::asinh(t));
    };
    integral += d * d * d / 3.0 * (sec3(b) - sec3(a));
  }
  return integral / area(p);
}

TEST(ManifoldQuality, FourPointsOfATurnedBoxKeepCentreAndNearlyTheAreaOfTheOverlap) {
  const Shape box{Box{Vec3::Ones()}, {}};
  double least_area = 1.0, worst_centre = 0.0, least_radius = 1e9, most_radius = 0.0;
  for (int step = 0; step <= 90; ++step) {
    const double angle = step * M_PI / 360.0;
    const Transform pose{Vec3(0.0f, 1.9999f, 0.0f), Quat(Eigen::AngleAxisf(static_cast<float>(angle), Vec3::UnitY()))};
    ContactManifold m;
    ASSERT_EQ(collideShapes({box, {}, box, pose, 0.01f}, m), 4) << angle;
    std::vector<Point> kept;
    Point centre{0.0, 0.0};
    double radius = 0.0;
    for (int i = 0; i < 4; ++i) {
      const Vec3& p = m.points[i].local_a;
      kept.push_back({p.z(), p.x()});
      centre.x += 0.25 * p.z(), centre.y += 0.25 * p.x();
      radius += 0.25 * std::hypot(p.z(), p.x());
    }
    std::sort(kept.begin(), kept.end(), [](Point a, Point b) { return std::atan2(a.y, a.x) < std::atan2(b.y, b.x); });
    const auto exact = overlap(angle);
    least_area = std::min(least_area, area(kept) / area(exact));
    worst_centre = std::max(worst_centre, std::hypot(centre.x, centre.y));
    least_radius = std::min(least_radius, radius / frictionRadius(exact));
    most_radius = std::max(most_radius, radius / frictionRadius(exact));
  }
  std::printf("area kept >= %.3f, centre off by <= %.2g, friction radius %.3f to %.3f of the exact one\n", least_area,
              worst_centre, least_radius, most_radius);
  // The best four corners of a regular octagon hold 1 / sqrt 2 of its area.
  EXPECT_GT(least_area, 0.7071 - 1e-4);
  // They lie in pairs opposite each other, whatever the angle.
  EXPECT_LT(worst_centre, 1e-5);
  // Friction acts at a share of the way to the corners, so that a twist is held as by the whole square.
  const double spread = SoftStepParams{}.friction_spread;
  std::printf("friction radius as solved %.3f to %.3f of the exact one (0.9 to 1.15 wanted)\n", spread * least_radius,
              spread * most_radius);
  EXPECT_GT(spread * least_radius, 0.9);
  EXPECT_LT(spread * most_radius, 1.15);
  // Four corners of equal load hold a twist better than the whole square does: sqrt 2 against 0.7652.
  EXPECT_LT(most_radius, 1.4142 / 0.7652 + 1e-3);
  EXPECT_GT(least_radius, 1.0);
}

}  // namespace
}  // namespace pfx

#include "pfx/low_level/solver/newton_contact.h"

#include <algorithm>
#include <cmath>

namespace pfx {
namespace {

NewtonJacobian rowAlong(const NewtonContact& c, const NewtonPoint& p, double along1, double along2) {
  NewtonJacobian r;
  for (int i = 0; i < 3; ++i) {
    const double axis = along1 * c.axis[1][i] + along2 * c.axis[2][i];
    r.b[i] = axis, r.a[i] = -axis;
    r.b[3 + i] = along1 * p.turn[1][1][i] + along2 * p.turn[1][2][i];
    r.a[3 + i] = -(along1 * p.turn[0][1][i] + along2 * p.turn[0][2][i]);
  }
  return r;
}

NewtonJacobian normalRow(const NewtonContact& c, const NewtonPoint& p) {
  NewtonJacobian r;
  for (int i = 0; i < 3; ++i) {
    r.b[i] = c.axis[0][i], r.a[i] = -c.axis[0][i];
    r.b[3 + i] = p.turn[1][0][i], r.a[3 + i] = -p.turn[0][0][i];
  }
  return r;
}

void addOuter(double* block, double weight, const double (&row)[6], const double (&column)[6]) {
  for (int i = 0; i < 6; ++i) {
    const double w = weight * row[i];
    for (int k = 0; k < 6; ++k) block[6 * i + k] += w * column[k];
  }
}

}  // namespace

void addRow(bool a_is_row, const NewtonBlocks& blocks, double weight, const NewtonJacobian& r) {
  if (blocks.a) addOuter(blocks.a, weight, r.a, r.a);
  if (blocks.b) addOuter(blocks.b, weight, r.b, r.b);
  if (!blocks.pair) return;
  if (a_is_row)
    addOuter(blocks.pair, weight, r.a, r.b);
  else
    addOuter(blocks.pair, weight, r.b, r.a);
}

void addImpulse(const NewtonContact& c, const NewtonPoint& p, double sign, double* a, double* b) {
  for (int k = 0; k < 3; ++k) {
    const double f = sign * p.impulse[k];
    for (int i = 0; i < 3; ++i) {
      a[i] -= f * c.axis[k][i];
      b[i] += f * c.axis[k][i];
      a[3 + i] -= f * p.turn[0][k][i];
      b[3 + i] += f * p.turn[1][k][i];
    }
  }
}

void impulsesAt(const NewtonPoint& p, const double (&speed)[3], double (&out)[3]) {
  out[0] = std::max(0.0, p.base[0] - p.stiffness[0] * (speed[0] + p.bias));
  const double y1 = p.base[1] - p.stiffness[1] * speed[1], y2 = p.base[2] - p.stiffness[1] * speed[2];
  const double length2 = y1 * y1 + y2 * y2;
  const double share = length2 > p.radius * p.radius ? p.radius / std::sqrt(length2) : 1.0;
  out[1] = share * y1, out[2] = share * y2;
}

// Friction that sticks has curvature 1 / R both ways, friction that slides only across its direction, and
// less.
bool setCurvature(NewtonPoint& p) {
  double now[4] = {p.impulse[0] > 0.0 ? p.stiffness[0] : 0.0, p.radius > 0.0 ? p.stiffness[1] : 0.0, 0.0,
                   0.0};
  const double y1 = p.base[1] - p.stiffness[1] * p.speed[1], y2 = p.base[2] - p.stiffness[1] * p.speed[2];
  const double length2 = y1 * y1 + y2 * y2;
  if (length2 > p.radius * p.radius) {
    const double length = std::sqrt(length2);
    now[1] = p.stiffness[1] * p.radius / length;
    now[2] = -y2 / length, now[3] = y1 / length;
  }
  const bool same = std::equal(now, now + 4, p.curvature);
  std::copy(now, now + 4, p.curvature);
  return !same;
}

void addCurvature(const NewtonContact& c, const NewtonBlocks& blocks) {
  for (int i = 0; i < c.num_points; ++i) {
    const NewtonPoint& p = c.points[i];
    if (p.curvature[0] > 0.0) addRow(c.a_is_row, blocks, p.curvature[0], normalRow(c, p));
    if (!(p.curvature[1] > 0.0)) continue;
    if (p.curvature[2] == 0.0 && p.curvature[3] == 0.0) {
      addRow(c.a_is_row, blocks, p.curvature[1], rowAlong(c, p, 1.0, 0.0));
      addRow(c.a_is_row, blocks, p.curvature[1], rowAlong(c, p, 0.0, 1.0));
    } else {
      addRow(c.a_is_row, blocks, p.curvature[1], rowAlong(c, p, p.curvature[2], p.curvature[3]));
    }
  }
}

}  // namespace pfx

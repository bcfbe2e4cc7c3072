#include "pfx/base_level/rigid_body/rotation_update.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>

#include "pfx/base_level/math/trig.h"

namespace pfx {
namespace {

// Angular velocity of a body with momentum l at orientation q.
Vec3 velocityAt(const Quat& q, const Inertia& inertia, const Vec3& l) {
  const Mat3 r = q.toRotationMatrix();
  return r * (inertia.inverse_body * (r.transpose() * l));
}

Quat midpoint(const Quat& q, const Inertia& inertia, const Vec3& l, const Vec3& w, float h) {
  const Quat half = expMap(0.5f * h * w) * q;
  return expMap(h * velocityAt(half, inertia, l)) * q;
}

Quat rungeKuttaMuntheKaas4(const Quat& q, const Inertia& inertia, const Vec3& l, const Vec3& w, float h) {
  const Vec3 k1 = h * w;
  const Vec3 k2 = h * velocityAt(expMap(0.5f * k1) * q, inertia, l);
  const Vec3 k3 = h * velocityAt(expMap(0.5f * k2 - 0.125f * k1.cross(k2)) * q, inertia, l);
  const Vec3 k4 = h * velocityAt(expMap(k3) * q, inertia, l);
  const Vec3 u = (k1 + 2.0f * k2 + 2.0f * k3 + k4) / 6.0f + k4.cross(k1) / 12.0f;
  return expMap(u) * q;
}

// Share of the kinetic energy that a step may change before it is made by splitting instead. An error in the direction
// of a slender body spins it up by the ratio of its moments, and a body that turns far in a step is beyond a series.
constexpr float kEnergyError = 1e-3f, kEnergyErrorSlender = 1e-5f;
constexpr float kSlender = 30.0f;  // product of the traces of inertia and inverse; 9 for a ball, 22 for a box 1 : 1 : 4

// Principal moments and axes; the first is that of a top, the one that is least like the other two.
struct Top {
  Vec3 moments;  // kg m^2
  Mat3 axes;     // columns, body axes, right-handed
};

Top topOf(const Mat3& inertia) {
  Top top{inertia.diagonal(), Mat3::Identity()};
  if (!inertia.isDiagonal(0.0f)) {
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia);
    top = {solver.eigenvalues(), solver.eigenvectors()};
  }
  int order[3] = {0, 1, 2};
  std::sort(order, order + 3, [&](int i, int k) { return std::pair(top.moments[i], i) < std::pair(top.moments[k], k); });
  const Vec3& m = top.moments;
  const bool is_rod = m[order[1]] * m[order[1]] >= m[order[0]] * m[order[2]];
  const int first = is_rod ? order[0] : order[2], second = order[1];
  Top out;
  out.moments = Vec3(m[first], m[second], m[3 - first - second]);
  out.axes.col(0) = top.axes.col(first);
  out.axes.col(1) = top.axes.col(second);
  out.axes.col(2) = out.axes.col(0).cross(out.axes.col(1));
  return out;
}

// Flow of a symmetric top, which is exact however fast it spins, between two half flows of what its third moment
// differs from the second. Each part keeps the momentum, and no error of the orientation turns into energy.
// Source: A. Dullweber, B. Leimkuhler, R. McLachlan, Symplectic splitting methods for rigid body molecular dynamics,
// J. Chem. Phys. 107, 1997.
Quat splitting(const Quat& q, const Inertia& inertia, const Vec3& l, float h) {
  const Top top = topOf(inertia.body);
  const Vec3 spin_axis = top.axes.col(0), third_axis = top.axes.col(2);
  const float difference = 1.0f / top.moments[2] - 1.0f / top.moments[1];
  const auto turnThird = [&](const Quat& from) {
    const float along = (from * third_axis).dot(l);
    return Quat(from * expMap(0.5f * h * difference * along * third_axis));
  };
  const Quat half = turnThird(q);
  const float spin = (1.0f / top.moments[0] - 1.0f / top.moments[1]) * (half * spin_axis).dot(l);
  return turnThird(expMap(h / top.moments[1] * l) * half * expMap(h * spin * spin_axis));
}

}  // namespace

Quat expMap(const Vec3& u) {
  const float angle2 = u.squaredNorm();
  float s, c;  // sin(angle / 2) / angle, cos(angle / 2)
  if (angle2 < 0.25f) {
    // Taylor series in (angle/2)^2; the first term left out is below half an ulp of a float.
    const float x = 0.25f * angle2;
    s = 0.5f * (1.0f - x * (1.0f / 6.0f - x * (1.0f / 120.0f - x * (1.0f / 5040.0f))));
    c = 1.0f - x * (0.5f - x * (1.0f / 24.0f - x * (1.0f / 720.0f)));
  } else {
    const float angle = std::sqrt(angle2);
    const SinCos half = sincos(0.5f * angle);
    s = half.sin / angle;
    c = half.cos;
  }
  return Quat(c, s * u.x(), s * u.y(), s * u.z());
}

Inertia makeInertia(const Mat3& inertia) {
  const Mat3 off = inertia - inertia(0, 0) * Mat3::Identity();
  return {inertia, inertia.inverse(), off.cwiseAbs().maxCoeff() < 1e-6f * inertia(0, 0)};
}

Rotation advanceRotation(const Rotation& start, const Inertia& inertia, float h) {
  const Quat& q = start.orientation;
  const Vec3& w = start.angular_velocity;
  const float turn2 = w.squaredNorm() * h * h;
  if (turn2 == 0.0f) return start;
  if (inertia.spherical || turn2 < 1e-6f) return {(expMap(h * w) * q).normalized(), w};
  const Mat3 r = q.toRotationMatrix();
  const Vec3 l = r * (inertia.body * (r.transpose() * w));
  const Quat moved =
      turn2 < 0.0025f ? midpoint(q, inertia, l, w, h) : rungeKuttaMuntheKaas4(q, inertia, l, w, h);
  const Quat q1 = moved.normalized();
  const Vec3 w1 = velocityAt(q1, inertia, l);
  const bool is_slender = inertia.body.trace() * inertia.inverse_body.trace() > kSlender;
  if (std::abs(l.dot(w1 - w)) <= (is_slender ? kEnergyErrorSlender : kEnergyError) * l.dot(w)) return {q1, w1};
  const Quat q2 = splitting(q, inertia, l, h).normalized();
  return {q2, velocityAt(q2, inertia, l)};
}

Mat3 worldInverseInertia(const Quat& orientation, const Inertia& inertia) {
  if (inertia.spherical) return inertia.inverse_body;
  const Mat3 r = orientation.toRotationMatrix();
  return r * inertia.inverse_body * r.transpose();
}

}  // namespace pfx

#include "pfx/low_level/solver/impulse_joint.h"

#include <algorithm>
#include <cmath>

namespace pfx {
namespace {

using Map3 = Eigen::Map<Vec3>;
using ConstMap3 = Eigen::Map<const Vec3>;

// Rate that the axis is to reach, between which impulses, and the share of the rate that damping leaves over the one it takes.
struct AxisGoal {
  float rate, lower, upper, left = 0.0f;
};
AxisGoal axisGoal(const ImpulseJointInput& in) {
  const AxisConstraint& axis = in.axis;
  const float most = axis.max_force, x = static_cast<float>(in.value), h = in.time_step;
  if (axis.lock == JointLock::Fixed) return {-axis.bias * (x - axis.lower) / h, -most, most};
  const bool limited = axis.lock == JointLock::Limit;
  if (limited && x > axis.upper) return {-axis.bias * (x - axis.upper) / h, -most, 0.0f};
  if (limited && x < axis.lower) return {-axis.bias * (x - axis.lower) / h, 0.0f, most};
  const float end = x + in.rate * h;
  const float damping = std::clamp(axis.damping, 0.0f, 1.0f);
  if (damping > 0.0f && (!limited || (end >= axis.lower && end <= axis.upper))) return {0.0f, -most, most, (1.0f - damping) / damping};
  if (!limited) return {0.0f, 0.0f, 0.0f};
  // Inside the range the axis may come as near to the limit that it moves towards as there is way left.
  const bool up = axis.upper - end < end - axis.lower;
  const float rate = ((up ? axis.upper : axis.lower) - x) / h;
  if (!std::isfinite(rate)) return {0.0f, 0.0f, 0.0f};
  return {rate, up ? -most : 0.0f, up ? 0.0f : most};
}

Vec3d part(const ImpulseJointRow& row, int i) { return ConstMap3(row.jacobian + 3 * i).cast<double>(); }

double rateOf(ImpulsePair p, const ImpulseJointRow& row) {
  const float* v[] = {p.a.dv, p.a.dw, p.b.dv, p.b.dw};
  double rate = 0.0;
  for (int i = 0; i < 4; ++i) rate += part(row, i).dot(ConstMap3(v[i]).cast<double>());
  return rate;
}

Mat3d turnOf(const ImpulseBody& body) { return Eigen::Map<const Mat3>(body.inv_inertia).cast<double>(); }

// Change of velocity that a unit impulse of the row gives: M^-1 J^T.
struct Response {
  Vec3d v[4];
};
Response responseOf(ImpulsePair p, const ImpulseJointRow& row) {
  return {{p.a.inv_mass * part(row, 0), turnOf(p.a) * part(row, 1), p.b.inv_mass * part(row, 2), turnOf(p.b) * part(row, 3)}};
}

void apply(ImpulsePair p, const ImpulseJoint& joint, const double (&impulse)[kNumJointAxes]) {
  Vec3d sum[4] = {Vec3d::Zero(), Vec3d::Zero(), Vec3d::Zero(), Vec3d::Zero()};
  for (int i = 0; i < kNumJointAxes; ++i)
    for (int k = 0; k < 4; ++k) sum[k] += impulse[i] * part(*joint.row[i], k);
  Map3(p.a.dv) += (p.a.inv_mass * sum[0]).cast<float>();
  Map3(p.a.dw) += (turnOf(p.a) * sum[1]).cast<float>();
  Map3(p.b.dv) += (p.b.inv_mass * sum[2]).cast<float>();
  Map3(p.b.dw) += (turnOf(p.b) * sum[3]).cast<float>();
}

constexpr int packed(int i, int k) { return i >= k ? i * (i + 1) / 2 + k : packed(k, i); }

// The rows that can act, as a small problem with bounds: rates a x = want, where lower <= x <= upper lets them be reached.
class BoundedRows {
 public:
  BoundedRows(ImpulsePair pair, const ImpulseJoint& joint) {
    for (int i = 0; i < kNumJointAxes; ++i) {
      const ImpulseJointRow& row = *joint.row[i];
      const double diagonal = joint.coupling[packed(i, i)];
      if (row.lower == row.upper || !(row.weight > 0.0f) || !(diagonal > 0.0)) continue;
      axis_[count_] = i;
      lower_[count_] = static_cast<double>(row.lower) - row.impulse;
      upper_[count_] = static_cast<double>(row.upper) - row.impulse;
      want_[count_] = row.rhs * diagonal - rateOf(pair, row) - static_cast<double>(row.softness) * row.impulse;
      for (int k = 0; k <= count_; ++k) a_[count_][k] = a_[k][count_] = joint.coupling[packed(i, axis_[k])];
      a_[count_][count_] += row.softness;
      ++count_;
    }
  }

  // Principal pivoting by the least index: finite for a positive definite matrix. Source: K. G. Murty, Linear
  // Complementarity, Linear and Nonlinear Programming, 1988, chapter 4.
  void solve() {
    constexpr int kMostPivots = 64;  // as many as there are sets of six rows
    for (int pivot = 0; pivot < kMostPivots; ++pivot) {
      solveFree();
      if (!exchangeOne()) return;
    }
    for (int i = 0; i < count_; ++i) x_[i] = std::clamp(x_[i], lower_[i], upper_[i]);
  }

  int count() const { return count_; }
  int axis(int i) const { return axis_[i]; }
  double change(int i) const { return x_[i]; }

 private:
  enum class At { Free, Lower, Upper };

  // L D L^T of the free rows in place; the others stand at their bounds. A row that the others determine is left out.
  void solveFree() {
    double l[kNumJointAxes][kNumJointAxes], d[kNumJointAxes], y[kNumJointAxes];
    for (int i = 0; i < count_; ++i) {
      if (at_[i] != At::Free) {
        x_[i] = at_[i] == At::Lower ? lower_[i] : upper_[i];
        d[i] = 0.0;
        continue;
      }
      y[i] = want_[i], d[i] = a_[i][i];
      for (int k = 0; k < count_; ++k)
        if (at_[k] != At::Free) y[i] -= a_[i][k] * (at_[k] == At::Lower ? lower_[k] : upper_[k]);
      for (int k = 0; k < i; ++k) {
        l[i][k] = 0.0;
        if (d[k] == 0.0) continue;
        double s = a_[i][k];
        for (int q = 0; q < k; ++q)
          if (d[q] != 0.0) s -= l[i][q] * d[q] * l[k][q];
        l[i][k] = s / d[k];
        d[i] -= l[i][k] * s;
        y[i] -= l[i][k] * y[k];
      }
      if (!(d[i] > kDetermined * a_[i][i])) d[i] = 0.0, x_[i] = 0.0;
    }
    for (int i = count_ - 1; i >= 0; --i) {
      if (d[i] == 0.0) continue;
      x_[i] = y[i] / d[i];
      for (int k = i + 1; k < count_; ++k)
        if (d[k] != 0.0) x_[i] -= l[k][i] * x_[k];
    }
  }

  // Moves the first row that stands wrong to a bound or off it; false when none does.
  bool exchangeOne() {
    for (int i = 0; i < count_; ++i) {
      const At before = at_[i];
      if (before == At::Free) {
        if (x_[i] < lower_[i]) at_[i] = At::Lower;
        if (x_[i] > upper_[i]) at_[i] = At::Upper;
      } else {
        double missing = want_[i];
        for (int k = 0; k < count_; ++k) missing -= a_[i][k] * x_[k];
        if (before == At::Lower ? missing > 0.0 : missing < 0.0) at_[i] = At::Free;
      }
      if (at_[i] != before) return true;
    }
    return false;
  }

  static constexpr double kDetermined = 1e-10;  // share of a row's own response that must be left beside the others

  int count_ = 0;
  int axis_[kNumJointAxes];
  double a_[kNumJointAxes][kNumJointAxes], want_[kNumJointAxes], lower_[kNumJointAxes], upper_[kNumJointAxes];
  double x_[kNumJointAxes];
  At at_[kNumJointAxes] = {};
};

}  // namespace

void setupImpulseJointRow(const ImpulseJointInput& in, ImpulsePair p, ImpulseJointRow& row) {
  for (int k = 0; k < 6; ++k) {
    row.jacobian[k] = static_cast<float>(in.jacobian_a[k]);
    row.jacobian[6 + k] = static_cast<float>(in.jacobian_b[k]);
  }
  const Response response = responseOf(p, row);
  double k = 0.0;
  for (int i = 0; i < 4; ++i) k += part(row, i).dot(response.v[i]);
  const AxisGoal goal = axisGoal(in);
  row.inv_diag = k > 0.0 ? static_cast<float>(1.0 / k) : 0.0f;
  row.rhs = (goal.rate - in.rate) * row.inv_diag;
  row.lower = goal.lower, row.upper = goal.upper;
  row.softness = goal.left;
  row.weight = std::clamp(in.axis.weight, 0.0f, 1.0f);
  row.impulse = in.warm_start && row.weight > 0.0f ? std::clamp(row.impulse, row.lower, row.upper) : 0.0f;
}

namespace {

// Rate that a unit impulse of a row gives it while the rows that hold both ways hold: the last pivot of L D L^T.
double responseBesideHeldRows(const ImpulseJoint& joint, int axis) {
  int order[kNumJointAxes], n = 0;
  for (int i = 0; i < kNumJointAxes; ++i) {
    const ImpulseJointRow& row = *joint.row[i];
    if (i != axis && row.lower < 0.0f && row.upper > 0.0f && row.softness == 0.0f && row.weight > 0.0f) order[n++] = i;
  }
  order[n++] = axis;
  double l[kNumJointAxes][kNumJointAxes], d[kNumJointAxes];
  for (int i = 0; i < n; ++i) {
    const double whole = d[i] = joint.coupling[packed(order[i], order[i])];
    for (int k = 0; k < i; ++k) {
      double s = joint.coupling[packed(order[i], order[k])];
      for (int q = 0; q < k; ++q) s -= l[i][q] * d[q] * l[k][q];
      l[i][k] = d[k] > 0.0 ? s / d[k] : 0.0;
      d[i] -= l[i][k] * s;
    }
    if (!(d[i] > 1e-10 * whole)) d[i] = 0.0;
  }
  return d[n - 1];
}

}  // namespace

void coupleImpulseRows(ImpulsePair pair, const ImpulseJoint& joint) {
  for (int i = 0; i < kNumJointAxes; ++i) {
    const Response response = responseOf(pair, *joint.row[i]);
    for (int k = 0; k <= i; ++k) {
      double rate = 0.0;
      for (int q = 0; q < 4; ++q) rate += part(*joint.row[k], q).dot(response.v[q]);
      joint.coupling[packed(i, k)] = rate;
    }
  }
  float softness[kNumJointAxes];
  for (int i = 0; i < kNumJointAxes; ++i)
    softness[i] = joint.row[i]->softness > 0.0f ? joint.row[i]->softness * static_cast<float>(responseBesideHeldRows(joint, i)) : 0.0f;
  for (int i = 0; i < kNumJointAxes; ++i) joint.row[i]->softness = softness[i];
}

void warmStart(ImpulsePair pair, const ImpulseJoint& joint) {
  double impulse[kNumJointAxes];
  for (int i = 0; i < kNumJointAxes; ++i) impulse[i] = joint.row[i]->impulse;
  apply(pair, joint, impulse);
}

void solveImpulses(ImpulsePair pair, const ImpulseJoint& joint) {
  BoundedRows rows(pair, joint);
  rows.solve();
  double change[kNumJointAxes] = {};
  for (int i = 0; i < rows.count(); ++i) {
    ImpulseJointRow& row = *joint.row[rows.axis(i)];
    const float before = row.impulse;
    row.impulse = std::clamp(before + row.weight * static_cast<float>(rows.change(i)), row.lower, row.upper);
    change[rows.axis(i)] = static_cast<double>(row.impulse) - before;
  }
  apply(pair, joint, change);
}

}  // namespace pfx

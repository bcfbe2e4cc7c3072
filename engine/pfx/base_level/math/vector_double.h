// Double-precision twins of the vector types, for the few places where masses of very different size meet.
#pragma once

#include "pfx/base_level/math/transform.h"

namespace pfx {

using Vec3d = Eigen::Vector3d;
using Mat3d = Eigen::Matrix3d;
using Quatd = Eigen::Quaternion<double, Eigen::DontAlign>;

struct TransformDouble {
  Vec3d position = Vec3d::Zero();         // m
  Quatd orientation = Quatd::Identity();  // unit
};

inline TransformDouble toDouble(const Transform& t) {
  return {t.position.cast<double>(), t.orientation.cast<double>().normalized()};
}

}  // namespace pfx

#include "samples/accuracy/error_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "pfx/base_level/math/trig.h"

namespace samples::accuracy {

using namespace pfx;

namespace {

constexpr Stroke kFrame{0xff6b6f76u, 1.0f}, kZero{0xffa3a7adu, 1.0f}, kCurve{0xffd1495bu, 2.0f};
constexpr size_t kMostSegments = 240;

}  // namespace

ErrorPlot::ErrorPlot(const CameraPose& camera, double seconds)
    : seconds_(seconds), width_(static_cast<size_t>(std::lround(seconds / static_cast<double>(kTimeStep)))) {
  constexpr float kDegree = kPi / 180.0f;
  const SinCos yaw = sincos(camera.yaw_deg * kDegree), pitch = sincos(camera.pitch_deg * kDegree);
  const Vec3 right(yaw.cos, 0.0f, -yaw.sin), up(-yaw.sin * pitch.sin, pitch.cos, -yaw.cos * pitch.sin);
  // Shares of the distance: the view is about 1.4 wide and 0.8 high.
  middle_left_ = camera.target + camera.distance * (0.2f * right + 0.25f * up);
  along_ = 0.4f * camera.distance * right;
  up_ = 0.08f * camera.distance * up;
}

Vec3 ErrorPlot::at(double time, double height) const {
  return middle_left_ + static_cast<float>(time) * along_ + static_cast<float>(height) * up_;
}

void ErrorPlot::add(double error) {
  if (errors_.size() < width_) errors_.push_back(error);
}

void ErrorPlot::draw(std::string_view metric, std::string_view unit, double least, Canvas& canvas) const {
  double most = least;
  for (const double e : errors_) most = std::max(most, std::abs(e));
  const std::array<Vec3, 4> corners = {at(0, -1), at(1, -1), at(1, 1), at(0, 1)};
  for (size_t k = 0; k < 4; ++k) canvas.line(corners[k], corners[(k + 1) % 4], kFrame);
  canvas.line(at(0, 0), at(1, 0), kZero);
  const size_t count = errors_.size(), stride = count / kMostSegments + 1;
  const auto place = [&](size_t i) { return at(static_cast<double>(i) / static_cast<double>(width_), errors_[i] / most); };
  for (size_t i = stride; i < count; i += stride) canvas.line(place(i - stride), place(i), kCurve);
  std::array<char, 96> text;
  std::snprintf(text.data(), text.size(), "%.*s: +-%.1e %.*s, %.3g s", static_cast<int>(metric.size()), metric.data(), most,
                static_cast<int>(unit.size()), unit.data(), seconds_);
  canvas.label(at(0.5, 1.3), text.data());
}

}  // namespace samples::accuracy

#include "viewer/render/label_places.h"

#include <algorithm>
#include <cmath>

namespace viewer {

namespace {

constexpr int kReach = 7;  // lines that a label may move up or down

}  // namespace

LabelPlaces::LabelPlaces(float picture_height, float line_height)
    : line_height_(line_height), rows_(size_t(std::max(1.0f, std::ceil(picture_height / line_height)))) {}

size_t LabelPlaces::row(float y) const {
  return size_t(std::clamp(y / line_height_, 0.0f, float(rows_.size() - 1)));
}

bool LabelPlaces::isFree(const LabelBox& box) const {
  for (size_t i = row(box.y0); i <= row(box.y1); ++i)
    if (std::any_of(rows_[i].begin(), rows_[i].end(), [&](const LabelBox& b) { return b.overlaps(box); })) return false;
  return true;
}

void LabelPlaces::take(const LabelBox& box) {
  for (size_t i = row(box.y0); i <= row(box.y1); ++i) rows_[i].push_back(box);
}

std::optional<LabelBox> LabelPlaces::find(const LabelBox& wanted, float anchor_x) {
  const float other_side = 2.0f * anchor_x - wanted.x0 - wanted.x1;
  for (int step = 0; step <= 2 * kReach; ++step) {
    // 0, one up, one down, two up, ...
    const float down = float(step % 2 == 0 ? step / 2 : -(step + 1) / 2) * line_height_;
    for (const float along : {0.0f, other_side}) {
      const LabelBox box{wanted.x0 + along, wanted.y0 + down, wanted.x1 + along, wanted.y1 + down};
      if (!isFree(box)) continue;
      take(box);
      return box;
    }
  }
  return std::nullopt;
}

}  // namespace viewer

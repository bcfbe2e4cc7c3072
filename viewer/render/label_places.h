// Free places for labels, so that none covers another.
#pragma once

#include <optional>
#include <vector>

namespace viewer {

struct LabelBox {
  float x0, y0, x1, y1;  // px

  bool overlaps(const LabelBox& b) const { return x0 < b.x1 && b.x0 < x1 && y0 < b.y1 && b.y0 < y1; }
};

class LabelPlaces {
 public:
  LabelPlaces(float picture_height, float line_height);  // px

  // Nothing else will be put there.
  void take(const LabelBox& box);
  // The place that is wanted or the nearest free one some lines above or below it, on the same side of the anchor or on
  // the other; nothing when all of them are taken. What is found is taken.
  std::optional<LabelBox> find(const LabelBox& wanted, float anchor_x);

 private:
  bool isFree(const LabelBox& box) const;
  size_t row(float y) const;

  float line_height_;
  std::vector<std::vector<LabelBox>> rows_;  // what is taken, by line of the picture; in each line that it touches
};

}  // namespace viewer

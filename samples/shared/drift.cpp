#include "samples/shared/drift.h"

#include <algorithm>
#include <cmath>

#include "pfx/util/debug_render/palette.h"

namespace samples {

using namespace pfx;

Drift::Drift(const World& world, uint32_t first_body) : first_(first_body) {
  for (uint32_t i = first_body; i < world.states().size(); ++i) start_.push_back(world.states()[i].position);
}

float Drift::of(const World& world, uint32_t body) const {
  return (world.states()[body].position - start_[body - first_]).norm();
}

float Drift::largest(const World& world) const {
  float most = 0.0f;
  for (uint32_t i = 0; i < start_.size(); ++i) most = std::max(most, of(world, first_ + i));
  return most;
}

std::vector<Color> driftColors(const World& world, const Drift& drift) {
  constexpr float kReddest = 0.6f;  // m
  std::vector<Color> colors(world.states().size(), 0);
  for (uint32_t i = drift.firstBody(); i < colors.size(); ++i) {
    if (!isDynamic(world.states()[i].motion_type)) continue;
    const float share = std::min(drift.of(world, i) / kReddest, 1.0f);
    colors[i] = hsvColor(0.11f * (1.0f - share), 0.3f + 0.5f * share, 0.88f);
  }
  return colors;
}

std::string millimetres(float metres) {
  const long tenths = std::lround(1e4f * metres);
  if (tenths >= 100) return std::to_string((tenths + 5) / 10) + " mm";
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " mm";
}

}  // namespace samples

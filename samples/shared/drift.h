// How far bodies have come from where they stood.
#pragma once

#include <string>
#include <vector>

#include "pfx/high_level/world/world.h"

namespace samples {

class Drift {
 public:
  Drift() = default;
  // Watches the bodies from `first_body` on, as they stand now.
  explicit Drift(const pfx::World& world, uint32_t first_body = 0);

  float of(const pfx::World& world, uint32_t body) const;  // m, of a watched body
  float largest(const pfx::World& world) const;            // m

 private:
  uint32_t first_ = 0;
  std::vector<pfx::Vec3> start_;
};

// "12 mm", or "0.4 mm" for a small one.
std::string millimetres(float metres);

}  // namespace samples

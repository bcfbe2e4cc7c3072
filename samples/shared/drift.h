// How far bodies have come from where they stood.
#pragma once

#include <string>
#include <vector>

#include "pfx/high_level/world/world.h"
#include "samples/canvas.h"

namespace samples {

class Drift {
 public:
  Drift() = default;
  // Watches the bodies from `first_body` on, as they stand now.
  explicit Drift(const pfx::World& world, uint32_t first_body = 0);

  float of(const pfx::World& world, uint32_t body) const;  // m, of a watched body
  float largest(const pfx::World& world) const;            // m
  uint32_t firstBody() const { return first_; }

 private:
  uint32_t first_ = 0;
  std::vector<pfx::Vec3> start_;
};

// By body: from cream to red by how far it has come; 0 of those that are not watched or cannot move.
std::vector<pfx::Color> driftColors(const pfx::World& world, const Drift& drift);

// "12 mm", or "0.4 mm" for a small one.
std::string millimetres(float metres);

}  // namespace samples

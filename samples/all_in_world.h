// A scene says of itself that it remembers nothing from step to step besides the world.
#pragma once

namespace samples {

// Base of such scenes, beside Scene. A snapshot of the world is all that is needed to bring one back to an earlier
// step; every other scene has to be run again from its start.
class AllInWorld {
 public:
  virtual ~AllInWorld() = default;
};

}  // namespace samples

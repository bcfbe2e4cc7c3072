// The hash of a picture.
#include "viewer/image/image.h"

#include <xxhash.h>

namespace viewer {

uint64_t imageHash(const Image& image) {
  const uint64_t seed = uint64_t(uint32_t(image.width)) << 32 | uint32_t(image.height);
  return XXH3_64bits_withSeed(image.rgba.data(), image.rgba.size(), seed);
}

}  // namespace viewer

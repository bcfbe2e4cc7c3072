// Return codes of the lower floors. World and the file readers wrap them with a message that names the place.
#pragma once

#include <cstdint>

namespace pfx {

enum class Error : uint32_t {
  Ok = 0,
  NullPointer,      // a required pointer or span is empty
  OutOfRange,       // an index, count or size lies outside its documented range
  InvalidValue,     // NaN, infinity, a negative size, a non-unit quaternion
  InvalidAlignment, // a buffer is not aligned as documented
  OutOfBuffer,      // a work buffer is too short; retry with the size that the ...Bytes() function returns
  OutOfMaxPairs,    // the pair buffer is full; nothing was lost silently, retry with a larger one
  OutOfMaxContacts, // the contact pool is full
  OutOfWorld,       // the body lies outside the world box; its proxy is valid all the same
  NotConvex,        // a convex mesh was asked for from concave input
  Degenerate,       // empty, flat or zero-area input where a solid is needed
};

const char* toString(Error error);

}  // namespace pfx

// What can be wrong with a file of serialized records, and where.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace pfx {

enum class SerializeError : uint32_t {
  Ok = 0,
  Loading,      // the file cannot be read or ends too early, or there was no buffer to load it into
  Saving,       // the file cannot be written
  Data,         // a value is not allowed: NaN, an unknown kind, an index of nothing, or a wrong check sum
  Parenthesis,  // a parenthesis is missing or one too many
  File,         // no file was given, or it is none of this kind
  Version,      // the file is of another version
  Tag,          // a group has another tag than the one expected
  Form,         // a number is not written as one, or does not fit
  Count,        // there are more or fewer records than announced
};

const char* toString(SerializeError error);

// Tags from the outermost group to the one that `error` is about. A record of an array is named with its
// number, as "state 3" (from 0).
struct SerializeFailure {
  SerializeError error = SerializeError::Ok;
  std::span<const char* const> tags;
  uint32_t line = 0;       // of the file, from 1; 0 when writing
  std::string_view cause;  // in words
};

// "line 12: pfx-scene > states > state 3 > position: cause"
std::string describe(const SerializeFailure& failure);

}  // namespace pfx

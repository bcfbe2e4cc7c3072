// The caller's mistake: a bad argument, a file that is missing or damaged.
// what() is one line that names the file or the argument, the place in it and the cause; the program exits
// with 2.
#pragma once

#include <stdexcept>
#include <string>

namespace viewer {

struct InputError : std::runtime_error {
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
};

}  // namespace viewer

// A shared library opened at run time, so that the program starts where the library is missing.
#pragma once

#include <string>
#include <vector>

namespace viewer {

// Stays open until the process ends: GL drivers keep threads and exit handlers.
class Library {
 public:
  // Opens the first name that exists. Throws ContextError with the loader's reason when none does.
  explicit Library(const std::vector<std::string>& names);

  // The address of a function. Throws ContextError naming it when the library has no such function.
  template <class F>
  F function(const char* name) const {
    return reinterpret_cast<F>(address(name));
  }

 private:
  void* address(const char* name) const;
  void* handle_ = nullptr;
};

}  // namespace viewer

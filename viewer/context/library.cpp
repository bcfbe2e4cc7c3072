#include "viewer/context/library.h"

#include <dlfcn.h>

#include "viewer/context/gl_context.h"

namespace viewer {

Library::Library(const std::vector<std::string>& names) {
  std::string reason;
  for (const std::string& name : names) {
    handle_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle_) return;
    if (reason.empty()) reason = dlerror();
  }
  throw ContextError(reason);
}

void* Library::address(const char* name) const {
  void* found = dlsym(handle_, name);
  if (!found) throw ContextError(std::string("the library has no function ") + name);
  return found;
}

}  // namespace viewer

// The backends, one function each. All throw ContextError with the reason of a failure.
#pragma once

#include <memory>

#include "viewer/context/gl_context.h"

namespace viewer {

std::unique_ptr<GlContext> openOsMesa();
std::unique_ptr<GlContext> openEgl();
std::unique_ptr<GlContext> openHiddenGlfw();

// Removes the variables that makeContext documents.
void clearRasterizerEnvironment();

}  // namespace viewer

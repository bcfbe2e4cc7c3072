// Verify results as a JUnit file, for CI servers.
#pragma once

#include <span>
#include <string>

#include "viewer/golden/verify.h"

namespace viewer {

std::string junitXml(std::span<const FrameResult> results, double seconds);

}  // namespace viewer

// The HTML report of a golden test: a folder that needs nothing outside itself.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "viewer/golden/verify.h"

namespace viewer {

struct ReportHead {
  std::string renderer;  // fingerprint that drew the pictures
  double seconds = 0.0;  // the whole test
};

// Indices of `results`, worst first: failures before passes, then by the largest visible difference.
std::vector<size_t> worstFirst(std::span<const FrameResult> results);

// Writes folder/index.html and folder/images/, replacing those of an earlier report. Returns the path of
// index.html. Throws InputError when something cannot be written.
std::filesystem::path writeReport(const std::filesystem::path& folder, std::span<const FrameResult> results,
                                  const ReportHead& head);

}  // namespace viewer

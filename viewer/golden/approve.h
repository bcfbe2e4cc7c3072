// Makes what was drawn the new truth, and writes down why.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "viewer/golden/verify.h"

namespace viewer {

struct Approval {
  std::vector<std::string> written;  // names of images that were accepted
  std::vector<std::string> removed;  // names of stale images that were deleted
};

// Accepts every failed picture of `results` into golden_dir, removes stale ones, and adds one line with date,
// reason and names to golden_dir/APPROVALS.md. Pictures that passed stay as they are, and so do tolerances
// with their reasons. Pictures of a scene that failed cannot be accepted and are left. Throws InputError when
// the reason is empty or a file cannot be written.
Approval approve(std::span<const FrameResult> results, const std::filesystem::path& golden_dir,
                 const std::string& reason);

}  // namespace viewer

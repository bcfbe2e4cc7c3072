// The facts beside a golden image: what it shows, of which state, drawn by what. SCENE_FRAME.json beside
// SCENE_FRAME.png.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "samples/scene.h"
#include "viewer/image/verdict.h"

namespace viewer {

// An image that needs other limits than the rest says why.
struct Tolerance {
  Limits limits;
  std::string reason;
};

struct GoldenRecord {
  std::string target;         // "2_stable/tower"
  int frame = 0;              // steps before the picture was taken
  int substeps = 0;           // of each step
  int width = 0, height = 0;  // px
  uint64_t state_hash = 0;    // of the world
  uint64_t image_hash = 0;    // of the pixels
  samples::CameraPose camera;
  std::string renderer;  // fingerprint of the rasteriser
  std::optional<Tolerance> tolerance;
};

// Throws InputError naming the file and what is wrong in it.
GoldenRecord readRecord(const std::filesystem::path& file);
void writeRecord(const std::filesystem::path& file, const GoldenRecord& record);

bool sameCamera(const samples::CameraPose& a, const samples::CameraPose& b);

// Hashes as files and reports show them: 16 hex digits.
std::string hexText(uint64_t value);

// DIR/SAMPLE/SCENE_FRAME with the given extension: the one place that names images.
std::filesystem::path framePath(const std::filesystem::path& dir, std::string_view target, int frame,
                                std::string_view extension);

}  // namespace viewer

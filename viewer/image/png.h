// PNG files, through libpng.
//
// Reading is strict, because a golden image that was damaged must not pass for a picture: the chunk structure
// and every checksum are tested before libpng sees the file, and whatever is wrong becomes an InputError.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "viewer/image/image.h"

namespace viewer {

inline constexpr int kMaxImageSide = 16384;  // px; larger images are refused

// The picture in `bytes`. Throws InputError, beginning with `name`, for anything but one complete PNG.
Image decodePng(std::span<const uint8_t> bytes, std::string_view name);

// The bytes of a PNG file: RGB when every pixel is opaque, RGBA otherwise. Throws InputError for an empty
// image.
std::vector<uint8_t> encodePng(const Image& image);

// Throw InputError naming the file and the cause. writePng makes missing folders and replaces the file in one
// step, so that a reader never sees half of it.
Image readPng(const std::filesystem::path& file);
void writePng(const std::filesystem::path& file, const Image& image);

}  // namespace viewer

// PNG through libpng's simplified interface; what it does not test (checksums of skipped chunks, a cut tail)
// is tested here first.
#include "viewer/image/png.h"

#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

#include "viewer/file.h"
#include "viewer/input_error.h"

namespace viewer {
namespace {

constexpr std::array<uint8_t, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

uint32_t bigEndian(std::span<const uint8_t> b) {
  return uint32_t(b[0]) << 24 | uint32_t(b[1]) << 16 | uint32_t(b[2]) << 8 | uint32_t(b[3]);
}

[[noreturn]] void fail(std::string_view name, const std::string& cause) {
  throw InputError(std::string(name) + ": " + cause);
}

// Walks the chunks: IHDR first, IEND last, every length inside the file, every checksum right.
// Source: W3C, Portable Network Graphics Specification, second edition, 2003, section 5.
void checkChunks(std::span<const uint8_t> bytes, std::string_view name) {
  if (bytes.size() < kSignature.size() || !std::equal(kSignature.begin(), kSignature.end(), bytes.begin()))
    fail(name, "not a PNG file");
  std::string_view type;
  for (size_t at = kSignature.size(); at < bytes.size();) {
    const auto rest = bytes.subspan(at);
    if (type == "IEND") fail(name, "data after the end of the PNG");
    if (rest.size() < 12 || bigEndian(rest) > rest.size() - 12)
      fail(name, "PNG is cut off at byte " + std::to_string(at));
    const size_t length = bigEndian(rest);
    const bool first = type.empty();
    type = std::string_view(reinterpret_cast<const char*>(rest.data()) + 4, 4);
    if (first != (type == "IHDR")) fail(name, "PNG header is missing or not in its place");
    if (crc32(0, rest.data() + 4, static_cast<uInt>(length + 4)) != bigEndian(rest.subspan(8 + length)))
      fail(name, "PNG is damaged: wrong checksum at byte " + std::to_string(at));
    at += 12 + length;
  }
  if (type != "IEND") fail(name, "PNG is cut off: its end is missing");
}

// Frees what libpng allocated for an image on every way out.
struct PngImage {
  png_image image{};
  PngImage() { image.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&image); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

}  // namespace

Image decodePng(std::span<const uint8_t> bytes, std::string_view name) {
  checkChunks(bytes, name);
  PngImage png;
  if (!png_image_begin_read_from_memory(&png.image, bytes.data(), bytes.size()))
    fail(name, png.image.message);
  if (png.image.width > unsigned(kMaxImageSide) || png.image.height > unsigned(kMaxImageSide))
    fail(name, std::to_string(png.image.width) + "x" + std::to_string(png.image.height) +
                   " px is more than " + std::to_string(kMaxImageSide) + " a side");
  png.image.format = PNG_FORMAT_RGBA;
  Image out{int(png.image.width), int(png.image.height), {}};
  out.rgba.resize(PNG_IMAGE_SIZE(png.image));
  if (!png_image_finish_read(&png.image, nullptr, out.rgba.data(), 0, nullptr)) fail(name, png.image.message);
  return out;
}

std::vector<uint8_t> encodePng(const Image& image) {
  if (image.empty() || image.rgba.size() != image.numPixels() * 4)
    throw InputError("cannot write an image without pixels");
  std::vector<uint8_t> rgb;
  rgb.reserve(image.numPixels() * 3);
  bool opaque = true;
  for (size_t i = 0; i < image.rgba.size() && opaque; i += 4) {
    rgb.insert(rgb.end(), &image.rgba[i], &image.rgba[i] + 3);
    opaque = image.rgba[i + 3] == 255;
  }
  PngImage png;
  png.image.width = unsigned(image.width);
  png.image.height = unsigned(image.height);
  png.image.format = opaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  // Filter NONE and a low level: on flat rendered pictures that is both four times faster and smaller than
  // the default.
  png.image.flags = PNG_IMAGE_FLAG_FAST;
  const uint8_t* pixels = opaque ? rgb.data() : image.rgba.data();
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png.image);
  std::vector<uint8_t> bytes(size);
  if (!png_image_write_to_memory(&png.image, bytes.data(), &size, 0, pixels, 0, nullptr))
    throw InputError(std::string("PNG: ") + png.image.message);
  bytes.resize(size);
  return bytes;
}

Image readPng(const std::filesystem::path& file) { return decodePng(readFile(file), file.string()); }

void writePng(const std::filesystem::path& file, const Image& image) { writeFile(file, encodePng(image)); }

}  // namespace viewer

// PNG in and out: what is written is read back, and every damaged file is an error with the file's name.
#include "viewer/image/png.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "pictures.h"
#include "viewer/input_error.h"

namespace golden_tests {
using namespace viewer;

Image randomImage(int width, int height, bool opaque) {
  std::mt19937 random(uint32_t(width * 31 + height));
  Image image{width, height, {}};
  image.rgba.resize(image.numPixels() * 4);
  for (size_t i = 0; i < image.rgba.size(); ++i)
    image.rgba[i] = opaque && i % 4 == 3 ? uint8_t(255) : uint8_t(random());
  return image;
}

TEST(Png, ReadsBackWhatWasWritten) {
  for (const bool opaque : {true, false})
    for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {64, 33}}) {
      const Image image = randomImage(width, height, opaque);
      EXPECT_EQ(decodePng(encodePng(image), "memory"), image)
          << width << "x" << height << " opaque " << opaque;
    }
}

TEST(Png, WritesIntoFoldersThatDoNotExistYet) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "vitrine_png_test";
  std::filesystem::remove_all(folder);
  const Image image = randomImage(5, 4, true);
  writePng(folder / "a" / "b.png", image);
  EXPECT_EQ(readPng(folder / "a" / "b.png"), image);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "a"), {}), 1)
      << "a part file was left";
  std::filesystem::remove_all(folder);
}

std::string errorOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Png, NamesTheFileAndTheCause) {
  EXPECT_EQ(errorOf([] { readPng("/nonexistent/x.png"); }),
            "/nonexistent/x.png: cannot read: No such file or directory");
  EXPECT_EQ(errorOf([] { readPng("/"); }), "/: cannot read: Is a directory");
  EXPECT_EQ(errorOf([] { writePng("/dev/null/x.png", randomImage(2, 2, true)); }),
            "/dev/null: cannot make this folder: Not a directory");
  const std::string text = "this is no picture";
  EXPECT_EQ(errorOf([&] {
              decodePng({reinterpret_cast<const uint8_t*>(text.data()), text.size()}, "t.png");
            }),
            "t.png: not a PNG file");
  EXPECT_NE(errorOf([] { encodePng({}); }), "");
}

TEST(Png, EveryTruncationIsAnError) {
  const std::vector<uint8_t> bytes = encodePng(randomImage(23, 11, false));
  for (size_t length = 0; length < bytes.size(); ++length) {
    const std::vector<uint8_t> cut(bytes.begin(),
                                   bytes.begin() + std::ptrdiff_t(length));  // its own block, for ASan
    EXPECT_EQ(errorOf([&] { decodePng(cut, "cut.png"); }).substr(0, 9), "cut.png: ") << length;
  }
}

TEST(Png, EveryFlippedBitIsAnError) {
  const std::vector<uint8_t> bytes = encodePng(randomImage(9, 5, true));
  for (size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    std::vector<uint8_t> damaged = bytes;
    damaged[bit / 8] ^= uint8_t(1u << bit % 8);
    EXPECT_NE(errorOf([&] { decodePng(damaged, "bit.png"); }), "") << "bit " << bit;
  }
}

TEST(Png, DataBehindTheEndIsAnError) {
  std::vector<uint8_t> bytes = encodePng(randomImage(4, 4, true));
  bytes.push_back(0);
  EXPECT_EQ(errorOf([&] { decodePng(bytes, "x.png"); }), "x.png: data after the end of the PNG");
}

TEST(Png, HugeSizesAreRefusedBeforeMemoryIsTaken) {
  // A header of 1000000 x 1000000 px with a right checksum.
  const std::vector<uint8_t> bytes = {0x89, 'P', 'N', 'G', 13,  10,   26,   10,   0,    0,    0,    13,
                                      'I',  'H', 'D', 'R', 0,   0x0f, 0x42, 0x40, 0,    0x0f, 0x42, 0x40,
                                      8,    6,   0,   0,   0,   0x5c, 0x6d, 0x38, 0x7d, 0,    0,    0,
                                      0,    'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
  const std::string error = errorOf([&] { decodePng(bytes, "huge.png"); });
  EXPECT_EQ(error.substr(0, 10), "huge.png: ");
}

TEST(ImageHash, DependsOnSizeAndEveryPixel) {
  const Image a = randomImage(6, 4, true);
  Image b = a;
  b.width = 4, b.height = 6;
  EXPECT_NE(imageHash(a), imageHash(b));
  b = a;
  b.rgba.back() ^= 1;
  EXPECT_NE(imageHash(a), imageHash(b));
  EXPECT_EQ(imageHash(a), imageHash(Image(a)));
}

}  // namespace golden_tests

// Parsers of command-line values.
#include "viewer/commands/arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "viewer/input_error.h"

namespace viewer {
namespace {

constexpr int kMaxFrame = 1000000;  // about five hours at 60 steps a second
constexpr int kMaxSide = 8192;      // px, what the renderer can draw
constexpr int kMaxThreads = 64;

template <class Number>
std::optional<Number> parseNumber(std::string_view text) {
  Number value{};
  const auto [at, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || at != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<int> parseWithin(std::string_view text, int low, int high) {
  const auto value = parseNumber<int>(text);
  return value && *value >= low && *value <= high ? value : std::nullopt;
}

std::vector<std::string> splitAt(const std::string& text, char separator) {
  std::vector<std::string> parts;
  size_t begin = 0;
  for (size_t end = text.find(separator); end != std::string::npos; end = text.find(separator, begin)) {
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  parts.push_back(text.substr(begin));
  return parts;
}

[[noreturn]] void fail(const char* option, const std::string& given, const std::string& rule) {
  throw InputError(std::string(option) + " \"" + given + "\": " + rule);
}

float parseFinite(const std::string& text, const std::string& all) {
  const auto value = parseNumber<float>(text);
  if (!value || !std::isfinite(*value)) fail("--camera", all, "\"" + text + "\" is not a number");
  return *value;
}

}  // namespace

std::vector<int> parseFrames(const std::string& text) {
  std::vector<int> frames;
  for (const std::string& part : splitAt(text, ',')) {
    const auto frame = parseWithin(part, 0, kMaxFrame);
    if (!frame)
      fail("--frames", text,
           "\"" + part + "\" is not a frame number (0 .. " + std::to_string(kMaxFrame) +
               "); example: --frames 0,60,120");
    frames.push_back(*frame);
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

PixelSize parseSize(const std::string& text) {
  const std::vector<std::string> parts = splitAt(text, 'x');
  const auto width = parseWithin(parts[0], 1, kMaxSide);
  const auto height = parts.size() == 2 ? parseWithin(parts[1], 1, kMaxSide) : std::nullopt;
  if (!width || !height)
    fail("--size", text,
         "not WIDTHxHEIGHT in pixels (1 .. " + std::to_string(kMaxSide) + "); example: --size 640x360");
  return {*width, *height};
}

ShardChoice parseShard(const std::string& text) {
  const std::vector<std::string> parts = splitAt(text, '/');
  const auto count = parts.size() == 2 ? parseWithin(parts[1], 1, 10000) : std::nullopt;
  const auto index = count ? parseWithin(parts[0], 1, *count) : std::nullopt;
  if (!index) fail("--shard", text, "not I/N with 1 <= I <= N; example: --shard 1/3");
  return {*index, *count};
}

std::vector<int> parseThreads(const std::string& text) {
  std::vector<int> threads;
  for (const std::string& part : splitAt(text, ',')) {
    const auto number = parseWithin(part, 1, kMaxThreads);
    if (!number)
      fail("--threads", text,
           "\"" + part + "\" is not a number of threads (1 .. " + std::to_string(kMaxThreads) + ")");
    threads.push_back(*number);
  }
  return threads;
}

std::vector<std::string> splitList(const std::string& text) {
  std::vector<std::string> parts = splitAt(text, ',');
  std::erase(parts, "");
  return parts;
}

samples::CameraPose parseCamera(const std::string& text, samples::CameraPose base) {
  for (const std::string& part : splitList(text)) {
    const size_t equals = part.find('=');
    const std::string key = part.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : part.substr(equals + 1);
    const std::vector<std::string> numbers = splitAt(value, '/');
    if (key == "yaw")
      base.yaw_deg = parseFinite(value, text);
    else if (key == "pitch")
      base.pitch_deg = parseFinite(value, text);
    else if (key == "distance")
      base.distance = parseFinite(value, text);
    else if (key == "target" && numbers.size() == 3)
      for (int i = 0; i < 3; ++i) base.target[i] = parseFinite(numbers[size_t(i)], text);
    else
      fail("--camera", text,
           "\"" + part + "\" is not known; example: --camera yaw=30,pitch=20,distance=12,target=0/1/0");
  }
  if (!(base.distance > 0.0f)) fail("--camera", text, "distance must be positive");
  return base;
}

}  // namespace viewer

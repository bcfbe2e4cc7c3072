// Golden records as JSON.
#include "viewer/golden/golden_record.h"

#include <charconv>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "viewer/file.h"
#include "viewer/input_error.h"

namespace viewer {
namespace {

using nlohmann::ordered_json;

uint64_t parseHex(const std::string& text) {
  uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, value, 16);
  if (text.size() != 16 || error != std::errc() || at != end)
    throw std::runtime_error("\"" + text + "\" is not a hash of 16 hex digits");
  return value;
}

ordered_json cameraJson(const samples::CameraPose& c) {
  return {{"target", {c.target.x(), c.target.y(), c.target.z()}},
          {"distance", c.distance},
          {"yaw_deg", c.yaw_deg},
          {"pitch_deg", c.pitch_deg}};
}

samples::CameraPose parseCamera(const ordered_json& json) {
  samples::CameraPose c;
  const auto& target = json.at("target");
  for (int i = 0; i < 3; ++i) c.target[i] = target.at(size_t(i)).get<float>();
  c.distance = json.at("distance").get<float>();
  c.yaw_deg = json.at("yaw_deg").get<float>();
  c.pitch_deg = json.at("pitch_deg").get<float>();
  return c;
}

ordered_json toleranceJson(const Tolerance& t) {
  return {{"max_channel", t.limits.max_channel},
          {"pixels_over", t.limits.pixels_over},
          {"max_block", t.limits.max_block},
          {"other_max_block_flip", t.limits.other_max_block_flip},
          {"other_mean_flip", t.limits.other_mean_flip},
          {"reason", t.reason}};
}

Tolerance parseTolerance(const ordered_json& json) {
  Tolerance t;
  t.reason = json.value("reason", "");
  if (t.reason.empty()) throw std::runtime_error("a tolerance needs a reason");
  t.limits.max_channel = json.value("max_channel", t.limits.max_channel);
  t.limits.pixels_over = json.value("pixels_over", t.limits.pixels_over);
  t.limits.max_block = json.value("max_block", t.limits.max_block);
  t.limits.other_max_block_flip = json.value("other_max_block_flip", t.limits.other_max_block_flip);
  t.limits.other_mean_flip = json.value("other_mean_flip", t.limits.other_mean_flip);
  return t;
}

GoldenRecord parseRecord(const ordered_json& json) {
  GoldenRecord r;
  r.target = json.at("target").get<std::string>();
  r.frame = json.at("frame").get<int>();
  r.substeps = json.at("substeps").get<int>();
  r.width = json.at("size").at(0).get<int>();
  r.height = json.at("size").at(1).get<int>();
  r.state_hash = parseHex(json.at("state_hash").get<std::string>());
  r.image_hash = parseHex(json.at("image_hash").get<std::string>());
  r.camera = parseCamera(json.at("camera"));
  r.renderer = json.at("renderer").get<std::string>();
  if (json.contains("tolerance")) r.tolerance = parseTolerance(json.at("tolerance"));
  return r;
}

}  // namespace

GoldenRecord readRecord(const std::filesystem::path& file) {
  const std::string text = readText(file);
  try {
    return parseRecord(ordered_json::parse(text));
  } catch (const std::exception& error) {
    throw InputError(file.string() + ": " + error.what());
  }
}

void writeRecord(const std::filesystem::path& file, const GoldenRecord& r) {
  ordered_json json = {{"target", r.target},
                       {"frame", r.frame},
                       {"steps", r.frame},
                       {"substeps", r.substeps},
                       {"size", {r.width, r.height}},
                       {"state_hash", hexText(r.state_hash)},
                       {"image_hash", hexText(r.image_hash)},
                       {"camera", cameraJson(r.camera)},
                       {"renderer", r.renderer}};
  if (r.tolerance) json["tolerance"] = toleranceJson(*r.tolerance);
  writeText(file, json.dump(2) + "\n");
}

bool sameCamera(const samples::CameraPose& a, const samples::CameraPose& b) {
  return a.target == b.target && a.distance == b.distance && a.yaw_deg == b.yaw_deg &&
         a.pitch_deg == b.pitch_deg;
}

std::string hexText(uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

std::filesystem::path framePath(const std::filesystem::path& dir, std::string_view target, int frame,
                                std::string_view extension) {
  return dir / (std::string(target) + "_" + std::to_string(frame) + std::string(extension));
}

}  // namespace viewer

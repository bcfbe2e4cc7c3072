// Writes the pictures of a golden test and the page that shows them.
#include "viewer/golden/report.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "viewer/file.h"
#include "viewer/golden/report_page.h"
#include "viewer/input_error.h"

namespace viewer {
namespace fs = std::filesystem;
namespace {

using nlohmann::ordered_json;

// Larger is worse. A failure without a picture to compare is worse than any difference.
double badness(const FrameResult& r) {
  const bool compared = !r.actual_png.empty() && !r.expected_png.empty();
  const double shown = r.verdict.flip ? double(r.verdict.flip->max_block) : 0.0;
  return (r.pass ? 0.0 : 4.0) + (r.pass || compared ? 0.0 : 2.0) + shown;
}

// Saves one picture and returns its address relative to the page; empty when there is none.
std::string savePicture(const fs::path& folder, const FrameResult& r, const char* kind,
                        std::span<const uint8_t> png) {
  if (png.empty()) return "";
  const fs::path name = framePath("images", r.target, r.frame, std::string(".") + kind + ".png");
  writeFile(folder / name, png);
  return name.generic_string();
}

ordered_json describe(const fs::path& folder, const FrameResult& r) {
  const Verdict& v = r.verdict;
  ordered_json json = {{"name", r.name()},
                       {"target", r.target},
                       {"frame", r.frame},
                       {"pass", r.pass},
                       {"exact", v.exact},
                       {"triage", toText(r.triage)},
                       {"why", r.why},
                       {"same_rasteriser", r.same_rasteriser},
                       {"state_expected", r.golden.renderer.empty() ? "" : hexText(r.golden.state_hash)},
                       {"state_actual", r.actual.renderer.empty() ? "" : hexText(r.actual.state_hash)},
                       {"max_channel", v.difference.max_channel},
                       {"pixels_over", v.difference.pixels_over},
                       {"max_block", v.difference.max_block},
                       {"worst", {v.difference.worst_x, v.difference.worst_y}},
                       {"tolerance", r.golden.tolerance ? r.golden.tolerance->reason : ""}};
  if (v.flip) json["mean_flip"] = v.flip->mean, json["max_block_flip"] = v.flip->max_block;
  json["actual"] = savePicture(folder, r, "actual", r.actual_png);
  if (v.exact) return json;
  json["expected"] = savePicture(folder, r, "expected", r.expected_png);
  json["difference"] = savePicture(folder, r, "difference", r.difference_png);
  json["heat"] = savePicture(folder, r, "heat", r.heat_png);
  return json;
}

// JSON that may stand inside a <script> element.
std::string scriptSafe(std::string json) {
  for (size_t at = json.find("</"); at != std::string::npos; at = json.find("</", at))
    json.replace(at, 2, "<\\/");
  return json;
}

}  // namespace

std::vector<size_t> worstFirst(std::span<const FrameResult> results) {
  std::vector<size_t> order(results.size());
  std::iota(order.begin(), order.end(), size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return badness(results[a]) > badness(results[b]); });
  return order;
}

fs::path writeReport(const fs::path& folder, std::span<const FrameResult> results, const ReportHead& head) {
  std::error_code error;
  fs::remove_all(folder / "images", error);
  ordered_json frames = ordered_json::array();
  for (size_t i : worstFirst(results)) frames.push_back(describe(folder, results[i]));
  const ordered_json data = {
      {"renderer", head.renderer}, {"seconds", head.seconds}, {"frames", std::move(frames)}};

  std::string page(kReportPage);
  const std::string_view mark = "@DATA@";
  const std::string text = data.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  page.replace(page.find(mark), mark.size(), scriptSafe(text));
  const fs::path index = folder / "index.html";
  writeText(index, page);
  return index;
}

}  // namespace viewer

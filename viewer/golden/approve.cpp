// Approval of golden images.
#include "viewer/golden/approve.h"

#include <algorithm>
#include <ctime>

#include "viewer/file.h"
#include "viewer/input_error.h"

namespace viewer {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kLogHead =
    "# Approvals\n\nEach line: when golden images were accepted, why, and which. Written by `vitrine verify "
    "--approve`.\n\n";

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", &utc);
  return text;
}

std::string join(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

void log(const fs::path& file, const std::string& reason, const Approval& approval) {
  std::string text = fs::exists(file) ? readText(file) : std::string(kLogHead);
  text += "- " + today() + " - " + reason;
  if (!approval.written.empty()) text += " - accepted " + join(approval.written);
  if (!approval.removed.empty()) text += " - removed " + join(approval.removed);
  writeText(file, text + "\n");
}

}  // namespace

Approval approve(std::span<const FrameResult> results, const fs::path& golden_dir,
                 const std::string& reason) {
  const auto visible = [](char c) { return c != ' ' && c != '\t' && c != '\n' && c != '\r'; };
  if (std::none_of(reason.begin(), reason.end(), visible)) throw InputError("--approve needs --reason TEXT");
  std::string one_line = reason;
  std::replace(one_line.begin(), one_line.end(), '\n', ' ');

  Approval approval;
  for (const FrameResult& r : results) {
    const fs::path picture = framePath(golden_dir, r.target, r.frame, ".png");
    const fs::path record = framePath(golden_dir, r.target, r.frame, ".json");
    if (r.pass || r.triage == Triage::SceneError) continue;
    if (r.triage == Triage::StaleGolden) {
      std::error_code ignored;
      fs::remove(picture, ignored), fs::remove(record, ignored);
      approval.removed.push_back(r.name());
      continue;
    }
    GoldenRecord accepted = r.actual;
    accepted.tolerance = r.golden.tolerance;
    writeFile(picture, r.actual_png);
    writeRecord(record, accepted);
    approval.written.push_back(r.name());
  }
  if (!approval.written.empty() || !approval.removed.empty())
    log(golden_dir / "APPROVALS.md", one_line, approval);
  return approval;
}

}  // namespace viewer

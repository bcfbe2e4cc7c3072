// vitrine compare: the image metric on two files.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "viewer/commands/commands.h"
#include "viewer/image/png.h"
#include "viewer/image/verdict.h"

namespace viewer {
namespace {

struct Options {
  std::string a, b, diff, heat;
  bool json = false, other_rasteriser = false;
};

nlohmann::ordered_json describe(const Verdict& v, const FlipResult* flip) {
  nlohmann::ordered_json json = {{"equal", v.exact},       {"verdict", v.pass ? "pass" : "fail"},
                                 {"why", v.why},           {"pixels_over", nullptr},
                                 {"max_channel", nullptr}, {"max_block", nullptr},
                                 {"mean_flip", nullptr}};
  if (!flip) return json;  // the sizes differ: there is nothing to measure
  json["pixels_over"] = v.difference.pixels_over;
  json["max_channel"] = v.difference.max_channel;
  json["max_block"] = v.difference.max_block;
  json["worst_block"] = {v.difference.worst_x, v.difference.worst_y};
  json["mean_flip"] = flip->mean;
  json["max_block_flip"] = flip->max_block;
  return json;
}

void printText(const Verdict& v, const FlipResult* flip) {
  std::printf("%s: %s\n", v.pass ? "pass" : "fail", v.why.c_str());
  if (!flip) return;
  const ImageDifference& d = v.difference;
  std::printf("largest channel difference  %d levels\n", d.max_channel);
  std::printf("pixels over %d levels        %u\n", kVisibleLevels, d.pixels_over);
  std::printf("worst 8x8 block             %.3f levels at %d, %d\n", double(d.max_block), d.worst_x,
              d.worst_y);
  std::printf("FLIP mean, worst block      %.5f, %.4f\n", double(flip->mean), double(flip->max_block));
}

int compare(const Options& options) {
  const Image a = readPng(options.a), b = readPng(options.b);
  const Verdict v = judge(a, b, options.other_rasteriser ? Rasteriser::Other : Rasteriser::Same);
  std::optional<FlipResult> flip = v.flip;
  if (!flip && a.sameSize(b)) flip = measureFlip(a, b);
  if (flip && !options.diff.empty()) writePng(options.diff, differenceImage(a, b));
  if (flip && !options.heat.empty()) writePng(options.heat, heatImage(a.width, a.height, flip->map));
  const FlipResult* measured = flip ? &*flip : nullptr;
  if (options.json)
    std::puts(describe(v, measured).dump(2).c_str());
  else
    printText(v, measured);
  return v.pass ? 0 : 1;
}

}  // namespace

void addCompareCommand(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("compare", "The image metric on two PNG files; exit 1 when they do not match");
  const auto options = std::make_shared<Options>();
  command->add_option("A", options->a, "Golden image")->required();
  command->add_option("B", options->b, "Image to judge")->required();
  command->add_option("--diff", options->diff, "Write the difference, 8 times amplified, as PNG");
  command->add_option("--heat", options->heat, "Write the FLIP heat map as PNG");
  command->add_flag("--other-rasteriser", options->other_rasteriser,
                    "Judge by the looser rule for another rasteriser");
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([&action, options] { action = [options] { return compare(*options); }; });
}

}  // namespace viewer

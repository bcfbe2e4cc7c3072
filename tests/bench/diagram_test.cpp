// Diagrams are well-formed SVG and show every point where it belongs.
#include <gtest/gtest.h>

#include <limits>
#include <pugixml.hpp>

#include "viewer/bench/diagram.h"

namespace viewer {
namespace {

pugi::xml_document parsed(const Diagram& diagram) {
  pugi::xml_document document;
  const std::string svg = drawSvg(diagram);
  EXPECT_TRUE(document.load_string(svg.c_str())) << svg;
  return document;
}

Diagram example() {
  return {.title = "a < b & c",
          .subtitle = "",
          .x_label = "cost",
          .y_label = "error",
          .curves = {{"ours", {{10, 1e-2, "1"}, {100, 1e-4, "4"}}}, {"theirs", {{10, 1.0, ""}, {1000, 0.1, ""}}}},
          .target = Diagram::Mark{1e-3, "target"},
          .floor = 1e-5,
          .limits = {}};
}

TEST(Diagram, isWellFormedWhateverTheTexts) {
  const auto document = parsed(example());
  EXPECT_STREQ(document.child("svg").child("text").text().get(), "a < b & c");
}

TEST(Diagram, hasOneMarkerAPointAndNamesEachCurveTwice) {
  const std::string svg = drawSvg(example());
  const auto count = [&](const std::string& what) {
    size_t found = 0;
    for (size_t at = svg.find(what); at != svg.npos; at = svg.find(what, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("<circle"), 3u) << "two points and the legend";
  EXPECT_EQ(count(">ours<"), 2u) << "in the legend and at the end of the curve";
  EXPECT_EQ(count(">theirs<"), 2u);
}

TEST(Diagram, aLegendOfManyCurvesEndsBeforeThePictureDoes) {
  Diagram diagram = example();
  for (const char* name : {"pfx, soft contacts", "pfx, Newton", "Bullet, float", "ODE, double", "ODE direct, double"})
    diagram.curves.push_back({name, {{10, 1e-2, ""}}});
  const auto document = parsed(diagram);
  const double right = document.child("svg").attribute("width").as_double();
  size_t entries = 0;
  for (const auto& entry : document.child("svg").children("text")) {
    if (std::string_view(entry.attribute("class").value()) != "legend") continue;
    ++entries;
    EXPECT_LT(entry.attribute("x").as_double() + 6.6 * double(std::string_view(entry.text().get()).size()), right);
  }
  EXPECT_EQ(entries, diagram.curves.size());
}

TEST(Diagram, aCheaperAndBetterPointLiesToTheLeftAndBelow) {
  const auto document = parsed(example());
  std::vector<std::pair<double, double>> circles;
  for (const auto& circle : document.child("svg").children("circle"))
    circles.emplace_back(circle.attribute("cx").as_double(), circle.attribute("cy").as_double());
  ASSERT_GE(circles.size(), 2u);
  EXPECT_LT(circles[0].first, circles[1].first);
  EXPECT_LT(circles[0].second, circles[1].second) << "y points down: the smaller error is lower";
}

TEST(Diagram, failuresAndNothingAtAllCanBeDrawn) {
  Diagram diagram = example();
  diagram.curves[0].points[1].y = std::numeric_limits<double>::infinity();
  parsed(diagram);
  diagram.curves.clear();
  diagram.target.reset();
  diagram.floor.reset();
  parsed(diagram);
  diagram.form = Diagram::Form::Shares;
  diagram.curves = {{"ours", {{1, 0, ""}, {1, 0.5, ""}, {4, 1, ""}}}};
  parsed(diagram);
}

}  // namespace
}  // namespace viewer

// A board beside an accuracy scene on which its error is plotted over time.
#pragma once

#include <string_view>
#include <vector>

#include "samples/canvas.h"
#include "samples/scene.h"

namespace samples::accuracy {

class ErrorPlot {
 public:
  // Upper right in the scene's start view, and parallel to it. `seconds` fill its width.
  ErrorPlot(const CameraPose& camera, double seconds);

  void add(double error);  // of each step of kTimeStep; those beyond its width are left out
  // The height stands for the largest error so far, of either sign, and for `least` while all are smaller.
  void draw(std::string_view metric, std::string_view unit, double least, Canvas& canvas) const;

 private:
  pfx::Vec3 at(double time, double height) const;  // shares of width and half height: 0 .. 1, -1 .. 1

  pfx::Vec3 middle_left_, along_, up_;  // m; to the right and the upper edge
  double seconds_;
  size_t width_;  // steps
  std::vector<double> errors_;
};

}  // namespace samples::accuracy

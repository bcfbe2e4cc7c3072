// Diagrams of measured curves, as SVG: cost against error on logarithmic axes, and performance profiles.
//
// Curves have a colour that people with any kind of colour vision can tell apart, a marker of their own, an entry in the
// legend and their name at their end.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace viewer {

struct DiagramPoint {
  double x, y;        // y may be infinite: it is drawn at the upper edge as a failure
  std::string label;  // beside the marker; may be empty
};

struct DiagramCurve {
  std::string name;
  std::vector<DiagramPoint> points;
};

struct Diagram {
  enum class Form {
    LogLog,  // both axes logarithmic, points joined by lines
    Shares,  // x logarithmic, y from 0 to 1, steps
  };
  struct Mark {
    double at;
    std::string label;
  };

  Form form = Form::LogLog;
  std::string title, subtitle, x_label, y_label;
  std::vector<DiagramCurve> curves;  // the first one is ours, and drawn strongest
  std::optional<Mark> target;        // a level of y to get below
  std::optional<double> floor;       // below this level of y, differences mean nothing
  std::vector<Mark> limits;          // values of x
};

std::string drawSvg(const Diagram& diagram);

}  // namespace viewer

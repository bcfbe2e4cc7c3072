#include "viewer/bench/diagram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>

namespace viewer {
namespace {

constexpr double kWidth = 720, kHeight = 460;                                  // px
constexpr double kLeft = 74, kRight = 152, kTop = 78, kBottom = 58;            // px, round the plot
constexpr double kPlotWidth = kWidth - kLeft - kRight, kPlotHeight = kHeight - kTop - kBottom;
constexpr double kHighest = 1e3;  // errors above it count as failures in a diagram

// Source of the colours: M. Okabe, K. Ito, Color universal design, 2008.
constexpr std::array kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a6d00", "#56b4e9", "#444444"};

std::string text(const char* format, ...) {
  std::array<char, 512> buffer;
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer.data(), buffer.size(), format, arguments);
  va_end(arguments);
  return buffer.data();
}

std::string escaped(const std::string& raw) {
  std::string out;
  for (const char c : raw) {
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else if (c == '>') out += "&gt;";
    else out += c;
  }
  return out;
}

// 10 to a power, with superscript digits.
std::string powerOfTen(int exponent) {
  static constexpr std::array kDigits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  if (exponent >= 0 && exponent <= 3) return std::to_string(static_cast<int>(std::lround(std::pow(10.0, exponent))));
  if (exponent == -1) return "0.1";
  if (exponent == -2) return "0.01";
  std::string out = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) out += kDigits[static_cast<size_t>(digit - '0')];
  return out;
}

// From values to pixels.
struct Axes {
  double x_low, x_high;  // decades
  double y_low, y_high;  // decades, or shares
  bool log_y;

  double x(double value) const {
    return kLeft + kPlotWidth * std::clamp((std::log10(value) - x_low) / (x_high - x_low), 0.0, 1.0);
  }
  double y(double value) const {
    const double at = log_y ? std::log10(std::max(value, 1e-300)) : value;
    return kTop + kPlotHeight * (1.0 - std::clamp((at - y_low) / (y_high - y_low), 0.0, 1.0));
  }
};

bool failed(double error) { return !(error <= kHighest); }

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double value) { low = std::min(low, value), high = std::max(high, value); }
};

Axes makeAxes(const Diagram& d) {
  Range x, y;
  for (const DiagramCurve& curve : d.curves)
    for (const DiagramPoint& p : curve.points) {
      x.add(std::log10(p.x));
      if (!failed(p.y) && p.y > 0.0) y.add(std::log10(p.y));
    }
  if (d.target) y.add(std::log10(d.target->at));
  if (d.floor) y.low = std::max(y.low, std::log10(*d.floor) - 1.0);
  if (!(x.low <= x.high)) x = {0.0, 1.0};
  if (!(y.low <= y.high)) y = {-1.0, 0.0};
  if (d.form == Diagram::Form::Shares) return {0.0, std::max(1.0, std::ceil(x.high)), 0.0, 1.0, false};
  return {std::floor(x.low), std::floor(x.high) + 1.0, std::floor(y.low), std::floor(y.high) + 1.0, true};
}

std::string drawText(double x, double y, const char* style, const std::string& content) {
  return text("<text x='%.1f' y='%.1f' %s>", x, y, style) + escaped(content) + "</text>\n";
}

std::string drawGrid(const Diagram& d, const Axes& a) {
  std::string out = text("<rect x='%g' y='%g' width='%g' height='%g' fill='#ffffff' stroke='#c9ccd1'/>\n", kLeft, kTop,
                         kPlotWidth, kPlotHeight);
  const auto line = [&](double x1, double y1, double x2, double y2, const char* style) {
    out += text("<line x1='%.1f' y1='%.1f' x2='%.1f' y2='%.1f' %s/>\n", x1, y1, x2, y2, style);
  };
  const double bottom = kTop + kPlotHeight, right = kLeft + kPlotWidth;
  for (int i = static_cast<int>(a.x_low); i <= static_cast<int>(a.x_high); ++i) {
    const double x = a.x(std::pow(10.0, i));
    line(x, kTop, x, bottom, "stroke='#e4e6ea'");
    line(x, bottom, x, bottom + 5, "stroke='#8a8f98'");
    out += drawText(x, bottom + 20, "text-anchor='middle' class='tick'", powerOfTen(i));
    for (int k = 2; k < 10 && i < static_cast<int>(a.x_high); ++k) {
      const double minor = a.x(k * std::pow(10.0, i));
      line(minor, bottom, minor, bottom + 3, "stroke='#b5b9c0'");
    }
  }
  const int y_ticks = a.log_y ? static_cast<int>(a.y_high - a.y_low) : 4;
  for (int i = 0; i <= y_ticks; ++i) {
    const double value = a.log_y ? std::pow(10.0, a.y_low + i) : 0.25 * i;
    line(kLeft, a.y(value), right, a.y(value), "stroke='#e4e6ea'");
    line(kLeft - 5, a.y(value), kLeft, a.y(value), "stroke='#8a8f98'");
    out += drawText(kLeft - 9, a.y(value) + 4, "text-anchor='end' class='tick'",
                    a.log_y ? powerOfTen(static_cast<int>(a.y_low) + i) : text("%d %%", 25 * i));
  }
  out += drawText(kLeft + 0.5 * kPlotWidth, kHeight - 14, "text-anchor='middle' class='axis'", d.x_label);
  const double middle = kTop + 0.5 * kPlotHeight;
  out += drawText(18, middle, text("text-anchor='middle' class='axis' transform='rotate(-90 18 %.1f)'", middle).c_str(),
                  d.y_label);
  return out;
}

std::string drawMarks(const Diagram& d, const Axes& a) {
  std::string out;
  if (d.floor && a.y(*d.floor) < kTop + kPlotHeight) {
    out += text("<rect x='%g' y='%.1f' width='%g' height='%.1f' fill='#eceef1'/>\n", kLeft, a.y(*d.floor), kPlotWidth,
                kTop + kPlotHeight - a.y(*d.floor));
    out += drawText(kLeft + 8, kTop + kPlotHeight - 7, "class='note'", "rounding of floats");
  }
  for (const Diagram::Mark& m : d.limits) {
    const double at = std::log10(m.at);
    if (at <= a.x_low || at >= a.x_high) continue;
    out += text("<line x1='%.1f' y1='%g' x2='%.1f' y2='%g' stroke='#9aa0a8' stroke-dasharray='2 4'/>\n", a.x(m.at), kTop,
                a.x(m.at), kTop + kPlotHeight);
    out += drawText(a.x(m.at) - 4, kTop + 13, "text-anchor='end' class='note'", m.label);
  }
  if (d.target) {
    const double y = a.y(d.target->at);
    out += text("<line x1='%g' y1='%.1f' x2='%g' y2='%.1f' stroke='#6b7280' stroke-dasharray='7 4'/>\n", kLeft, y,
                kLeft + kPlotWidth, y);
    out += drawText(kLeft + 8, y - 5, "class='note'", d.target->label);
  }
  return out;
}

std::string drawMarker(size_t curve, double x, double y) {
  const char* color = kColors[curve % kColors.size()];
  const double r = curve == 0 ? 5.0 : 4.2;
  switch (curve % 4) {
    case 0: return text("<circle cx='%.1f' cy='%.1f' r='%.1f' fill='%s' stroke='#fff'/>\n", x, y, r, color);
    case 1:
      return text("<rect x='%.1f' y='%.1f' width='%.1f' height='%.1f' fill='%s' stroke='#fff'/>\n", x - r, y - r, 2 * r,
                  2 * r, color);
    case 2:
      return text("<path d='M%.1f %.1fl%.1f %.1fh%.1fz' fill='%s' stroke='#fff'/>\n", x, y - 1.3 * r, 1.2 * r, 2.2 * r,
                  -2.4 * r, color);
    default:
      return text("<path d='M%.1f %.1fl%.1f %.1fl%.1f %.1fl%.1f %.1fz' fill='%s' stroke='#fff'/>\n", x, y - 1.35 * r,
                  1.35 * r, 1.35 * r, -1.35 * r, 1.35 * r, -1.35 * r, -1.35 * r, color);
  }
}

std::string drawCurve(const Diagram& d, const Axes& a, size_t index) {
  const DiagramCurve& curve = d.curves[index];
  const char* color = kColors[index % kColors.size()];
  std::string path, markers;
  double last_y = 0.0;
  for (const DiagramPoint& p : curve.points) {
    const double x = a.x(p.x), y = a.log_y && failed(p.y) ? kTop : a.y(p.y);
    if (d.form == Diagram::Form::Shares && !path.empty()) path += text("L%.1f %.1f", x, last_y);
    path += text("%s%.1f %.1f", path.empty() ? "M" : "L", x, y);
    last_y = y;
    if (d.form == Diagram::Form::Shares) continue;
    if (failed(p.y))
      markers += text("<path d='M%.1f %.1fl10 10m0 -10l-10 10' stroke='%s' stroke-width='2.5'/>\n", x - 5, y - 5, color);
    else
      markers += drawMarker(index, x, y);
    if (index == 0 && !p.label.empty())
      markers += drawText(x - 3, y + (y > kTop + kPlotHeight - 24 ? -11 : 19), "text-anchor='middle' class='note'", p.label);
  }
  if (d.form == Diagram::Form::Shares && !path.empty())
    path += text("L%.1f %.1f", kLeft + kPlotWidth, last_y);
  return text("<path fill='none' stroke='%s' stroke-width='%g' stroke-linejoin='round' d='", color,
              index == 0 ? 3.0 : 1.8) +
         path + "'/>\n" + markers;
}

// Names at the ends of the curves, pushed apart where they would overlap.
std::string drawNames(const Diagram& d, const Axes& a) {
  struct Name {
    size_t curve;
    double x, y, at;  // at: where the text goes
  };
  std::vector<Name> names;
  for (size_t i = 0; i < d.curves.size(); ++i) {
    if (d.curves[i].points.empty()) continue;
    const DiagramPoint& end = d.curves[i].points.back();
    const double x = d.form == Diagram::Form::Shares ? kLeft + kPlotWidth : a.x(end.x);
    const double y = a.log_y && failed(end.y) ? kTop : a.y(end.y);
    names.push_back({i, x, y, y});
  }
  std::ranges::stable_sort(names, {}, &Name::y);
  constexpr double kLine = 16;  // px
  for (size_t i = 1; i < names.size(); ++i) names[i].at = std::max(names[i].at, names[i - 1].at + kLine);
  const double over = names.empty() ? 0.0 : names.back().at - (kTop + kPlotHeight);
  for (Name& n : names)
    if (over > 0.0) n.at -= over;

  std::string out;
  const double column = kLeft + kPlotWidth + 12;
  for (const Name& n : names) {
    const char* color = kColors[n.curve % kColors.size()];
    out += text("<path fill='none' stroke='%s' stroke-opacity='0.45' d='M%.1f %.1fL%.1f %.1f'/>\n", color, n.x + 6, n.y,
                column - 3, n.at);
    out += drawText(column, n.at + 4, text("fill='%s' font-weight='%s'", color, n.curve == 0 ? "bold" : "normal").c_str(),
                    d.curves[n.curve].name);
  }
  return out;
}

struct LegendPlace {
  double x;
  int row;
};

// In rows that end before the picture does.
std::vector<LegendPlace> placeLegend(const Diagram& d) {
  constexpr double kSample = 30, kLetter = 6.6, kGap = 18, kMargin = 8;  // px
  std::vector<LegendPlace> places;
  LegendPlace next{kLeft, 0};
  for (const DiagramCurve& curve : d.curves) {
    const double width = kSample + kLetter * static_cast<double>(curve.name.size());
    if (next.x > kLeft && next.x + width > kWidth - kMargin) next = {kLeft, next.row + 1};
    places.push_back(next);
    next.x += width + kGap;
  }
  return places;
}

std::string drawLegend(const Diagram& d) {
  constexpr double kOneRow = 62, kFirstOfTwo = 52, kRowHeight = 15;  // px
  const std::vector<LegendPlace> places = placeLegend(d);
  std::string out;
  for (size_t i = 0; i < d.curves.size(); ++i) {
    const auto [x, row] = places[i];
    const double y = places.back().row == 0 ? kOneRow : kFirstOfTwo + kRowHeight * row;
    out += text("<line x1='%.1f' y1='%g' x2='%.1f' y2='%g' stroke='%s' stroke-width='%g'/>\n", x, y, x + 24, y,
                kColors[i % kColors.size()], i == 0 ? 3.0 : 1.8);
    if (d.form == Diagram::Form::LogLog) out += drawMarker(i, x + 12, y);
    out += drawText(x + 30, y + 4, "class='legend'", d.curves[i].name);
  }
  return out;
}

}  // namespace

std::string drawSvg(const Diagram& d) {
  const Axes axes = makeAxes(d);
  std::string out = text("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %g %g' width='%g' height='%g' "
                         "font-family='Helvetica,Arial,sans-serif' font-size='12'>\n",
                         kWidth, kHeight, kWidth, kHeight);
  out += "<style>.tick{fill:#4b5563}.axis{fill:#1f2937;font-size:13px}.note{fill:#6b7280;font-size:11px}"
         ".legend{fill:#1f2937}</style>\n";
  out += text("<rect width='%g' height='%g' fill='#fbfbf9'/>\n", kWidth, kHeight);
  out += drawText(kLeft, 20, "font-size='17' font-weight='bold' fill='#111827'", d.title);
  out += drawText(kLeft, 37, "font-size='12.5' fill='#4b5563'", d.subtitle);
  out += drawGrid(d, axes) + drawMarks(d, axes);
  for (size_t i = d.curves.size(); i-- > 0;) out += drawCurve(d, axes, i);
  out += drawNames(d, axes) + drawLegend(d);
  return out + "</svg>\n";
}

}  // namespace viewer

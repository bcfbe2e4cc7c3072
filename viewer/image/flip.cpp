// LDR-FLIP. A picture goes to a linearised Lab space, is blurred as the eye blurs, and is compared by colour;
// edges and points are compared on its lightness; both are joined at the end.
#include "viewer/image/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "viewer/image/metric.h"

namespace viewer {
namespace {

using Plane = std::vector<float>;
using Color3 = std::array<float, 3>;
struct Planes {
  int width, height;
  std::array<Plane, 3> p;
};

constexpr float kPixelsPerDegree = 0.7f * (3840.0f / 0.7f) * std::numbers::pi_v<float> / 180.0f;

// sRGB primaries with a D65 white (IEC 61966-2-1), rows X, Y, Z.
constexpr float kToXyz[3][3] = {{0.41238656f, 0.35759149f, 0.18045049f},
                                {0.21263682f, 0.71518298f, 0.07218020f},
                                {0.01933062f, 0.11919716f, 0.95037259f}};
constexpr float kToRgb[3][3] = {{3.24100323f, -1.53739897f, -0.49861588f},
                                {-0.96922426f, 1.87592999f, 0.04155423f},
                                {0.05563942f, -0.20401120f, 1.05714897f}};
constexpr Color3 kWhite = {0.95042854f, 1.0f, 1.08890037f};

Color3 transform(const float (&m)[3][3], const Color3& v) {
  Color3 out;
  for (size_t r = 0; r < 3; ++r) out[r] = m[r][0] * v[0] + m[r][1] * v[1] + m[r][2] * v[2];
  return out;
}

float toLinear(float s) { return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f); }

// Section 4.1, opponent space Y Cx Cz: Lab without its cube root.
Color3 toOpponent(const Color3& linear) {
  const Color3 xyz = transform(kToXyz, linear);
  const float x = xyz[0] / kWhite[0], y = xyz[1] / kWhite[1], z = xyz[2] / kWhite[2];
  return {116.0f * y - 16.0f, 500.0f * (x - y), 200.0f * (y - z)};
}

Color3 fromOpponent(const Color3& o) {
  const float y = (o[0] + 16.0f) / 116.0f;
  return transform(kToRgb, {(y + o[1] / 500.0f) * kWhite[0], y * kWhite[1], (y - o[2] / 200.0f) * kWhite[2]});
}

// CIE Lab with the Hunt adjustment of section 4.1: colour counts for less where it is dark.
Color3 toHuntLab(const Color3& linear) {
  const Color3 xyz = transform(kToXyz, linear);
  constexpr float kDelta = 6.0f / 29.0f;
  Color3 f;
  for (size_t c = 0; c < 3; ++c) {
    const float t = xyz[c] / kWhite[c];
    f[c] = t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0f * kDelta * kDelta) + 4.0f / 29.0f;
  }
  const float lightness = 116.0f * f[1] - 16.0f;
  return {lightness, 0.01f * lightness * 500.0f * (f[0] - f[1]), 0.01f * lightness * 200.0f * (f[1] - f[2])};
}

// HyAB distance: city block in lightness, Euclidean in colour.
float hyab(const Color3& a, const Color3& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

Planes toOpponentPlanes(const Image& image) {
  std::array<float, 256> linear;
  for (size_t i = 0; i < linear.size(); ++i) linear[i] = toLinear(float(i) / 255.0f);
  Planes out{image.width, image.height, {}};
  for (Plane& plane : out.p) plane.resize(image.numPixels());
  for (size_t i = 0; i < image.numPixels(); ++i) {
    const uint8_t* px = &image.rgba[i * 4];
    const Color3 o = toOpponent({linear[px[0]], linear[px[1]], linear[px[2]]});
    for (size_t c = 0; c < 3; ++c) out.p[c][i] = o[c];
  }
  return out;
}

// out[i] += weight * in[i]; the loop that all filtering ends in, so that it runs over whole rows.
void addRow(float* out, const float* in, float weight, int count) {
  for (int i = 0; i < count; ++i) out[i] += weight * in[i];
}

// Convolution with a separable kernel of odd length; pixels beyond the border repeat it.
Plane convolve(const Plane& in, int width, int height, const Plane& along_x, const Plane& along_y) {
  const int radius_x = int(along_x.size()) / 2, radius_y = int(along_y.size()) / 2;
  Plane rows(in.size(), 0.0f), out(in.size(), 0.0f), padded(size_t(width + 2 * radius_x));
  for (int y = 0; y < height; ++y) {
    const float* row = &in[size_t(y) * size_t(width)];
    for (int i = 0; i < int(padded.size()); ++i)
      padded[size_t(i)] = row[std::clamp(i - radius_x, 0, width - 1)];
    for (size_t k = 0; k < along_x.size(); ++k)
      addRow(&rows[size_t(y) * size_t(width)], &padded[k], along_x[k], width);
  }
  for (int y = 0; y < height; ++y)
    for (int k = 0; k < int(along_y.size()); ++k) {
      const int from = std::clamp(y + k - radius_y, 0, height - 1);
      addRow(&out[size_t(y) * size_t(width)], &rows[size_t(from) * size_t(width)], along_y[size_t(k)], width);
    }
  return out;
}

// One Gaussian of the contrast sensitivity function: a sqrt(pi/b) exp(-pi^2 x^2 / b), x in degrees.
struct CsfTerm {
  float a, b;
};

// Section 4.1, table 1: the filter of each channel is a sum of Gaussians, each of which is separable.
Plane eyeFilter(const Plane& in, int width, int height, std::array<CsfTerm, 2> terms) {
  constexpr float kPi = std::numbers::pi_v<float>;
  const int radius = int(std::ceil(3.0f * std::sqrt(0.04f / (2.0f * kPi * kPi)) * kPixelsPerDegree));
  Plane out(in.size(), 0.0f);
  float total = 0.0f;
  for (const CsfTerm& term : terms) {
    if (term.a == 0.0f) continue;
    Plane kernel;
    float sum = 0.0f;
    for (int i = -radius; i <= radius; ++i) {
      const float x = float(i) / kPixelsPerDegree;
      kernel.push_back(std::exp(-kPi * kPi * x * x / term.b));
      sum += kernel.back();
    }
    const float weight = term.a * std::sqrt(kPi / term.b);
    const Plane part = convolve(in, width, height, kernel, kernel);
    for (size_t i = 0; i < out.size(); ++i) out[i] += weight * part[i];
    total += weight * sum * sum;
  }
  for (float& v : out) v /= total;
  return out;
}

std::vector<Color3> toPerceivedLab(const Planes& o) {
  const Plane y = eyeFilter(o.p[0], o.width, o.height, {CsfTerm{1.0f, 0.0047f}, CsfTerm{0.0f, 1e-5f}});
  const Plane cx = eyeFilter(o.p[1], o.width, o.height, {CsfTerm{1.0f, 0.0053f}, CsfTerm{0.0f, 1e-5f}});
  const Plane cz = eyeFilter(o.p[2], o.width, o.height, {CsfTerm{34.1f, 0.04f}, CsfTerm{13.5f, 0.025f}});
  std::vector<Color3> lab(y.size());
  for (size_t i = 0; i < lab.size(); ++i) {
    Color3 rgb = fromOpponent({y[i], cx[i], cz[i]});
    for (float& c : rgb) c = std::clamp(c, 0.0f, 1.0f);
    lab[i] = toHuntLab(rgb);
  }
  return lab;
}

// Section 4.2: strength of edges and of points, from first and second derivatives of a Gaussian as wide as
// the eye's.
struct Features {
  Plane edge, point;
};

Features findFeatures(const Planes& o) {
  constexpr float kFeatureWidth = 0.082f;  // degrees
  const float sigma = 0.5f * kFeatureWidth * kPixelsPerDegree;
  const int radius = int(std::ceil(3.0f * sigma));
  Plane smooth, first, second;
  for (int i = -radius; i <= radius; ++i) {
    const float x = float(i);
    const float g = std::exp(-x * x / (2.0f * sigma * sigma));
    smooth.push_back(g);
    first.push_back(-x * g);
    second.push_back((x * x / (sigma * sigma) - 1.0f) * g);
  }
  // Positive weights sum to 1 and negative ones to -1; the smoothing across is normalised by itself.
  const auto normalise = [](Plane& kernel) {
    float positive = 0.0f, negative = 0.0f;
    for (float k : kernel) (k > 0.0f ? positive : negative) += k;
    for (float& k : kernel) k /= k > 0.0f ? positive : (negative != 0.0f ? -negative : 1.0f);
  };
  normalise(smooth), normalise(first), normalise(second);

  Plane lightness(o.p[0].size());
  for (size_t i = 0; i < lightness.size(); ++i) lightness[i] = (o.p[0][i] + 16.0f) / 116.0f;
  const auto strength = [&](const Plane& derivative) {
    Plane x = convolve(lightness, o.width, o.height, derivative, smooth);
    const Plane y = convolve(lightness, o.width, o.height, smooth, derivative);
    for (size_t i = 0; i < x.size(); ++i) x[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
    return x;
  };
  return {strength(first), strength(second)};
}

// Section 4.1.3: colour errors are compressed so that small ones use most of the range.
float redistribute(float distance, float max_distance) {
  constexpr float kPower = 0.7f, kSmall = 0.4f, kSmallRange = 0.95f;
  const float limit = std::pow(max_distance, kPower), d = std::pow(distance, kPower), knee = kSmall * limit;
  return d < knee ? kSmallRange * d / knee : kSmallRange + (1.0f - kSmallRange) * (d - knee) / (limit - knee);
}

float maxBlockMean(const Plane& map, int width, int height) {
  float worst = 0.0f;
  for (int y0 = 0; y0 < height; y0 += kBlock)
    for (int x0 = 0; x0 < width; x0 += kBlock) {
      const int y1 = std::min(y0 + kBlock, height), x1 = std::min(x0 + kBlock, width);
      float sum = 0.0f;
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) sum += map[size_t(y) * size_t(width) + size_t(x)];
      worst = std::max(worst, sum / float((y1 - y0) * (x1 - x0)));
    }
  return worst;
}

}  // namespace

FlipResult measureFlip(const Image& reference, const Image& test) {
  if (!reference.sameSize(test) || reference.rgba.size() != test.rgba.size())
    throw std::invalid_argument("images of different size cannot be compared");
  const Planes a = toOpponentPlanes(reference), b = toOpponentPlanes(test);
  const std::vector<Color3> lab_a = toPerceivedLab(a), lab_b = toPerceivedLab(b);
  const Features feature_a = findFeatures(a), feature_b = findFeatures(b);
  const float max_distance = hyab(toHuntLab({0.0f, 1.0f, 0.0f}), toHuntLab({0.0f, 0.0f, 1.0f}));

  FlipResult out;
  out.map.resize(reference.numPixels());
  double sum = 0.0;
  for (size_t i = 0; i < out.map.size(); ++i) {
    const float color = redistribute(hyab(lab_a[i], lab_b[i]), max_distance);
    const float feature = std::max(std::abs(feature_a.edge[i] - feature_b.edge[i]),
                                   std::abs(feature_a.point[i] - feature_b.point[i]));
    const float feature_error = std::min(1.0f, std::sqrt(feature / std::numbers::sqrt2_v<float>));
    // Equation 11: a feature error raises the colour error towards 1.
    out.map[i] = std::clamp(std::pow(color, 1.0f - feature_error), 0.0f, 1.0f);
    if (color == 0.0f) out.map[i] = feature_error >= 1.0f ? 1.0f : 0.0f;
    sum += double(out.map[i]);
  }
  out.mean = out.map.empty() ? 0.0f : float(sum / double(out.map.size()));
  out.max_block = maxBlockMean(out.map, reference.width, reference.height);
  return out;
}

}  // namespace viewer

#include "ripstop/output/colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ripstop/core/error.h"

namespace ripstop::inline output {
namespace {

double to_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double to_linear(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

double cube(double x) {
  return x * x * x;
}

/// Linear light of an Oklab colour; components outside 0 .. 1 cannot be shown.
/// l' = L + 0.396 a + 0.216 b, ...; (l, m, s) = (l'^3, m'^3, s'^3); (r, g, b) = M (l, m, s)  (Ottosson 2020)
std::array<double, 3> linear_light(double lightness, double chroma, double hue) {
  const double a = chroma * std::cos(hue), b = chroma * std::sin(hue);
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {+4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

/// L rises from 0.33 to 0.93 while the hue turns from violet to yellow. The chroma is reduced at blue-green, where
/// screens show the least of it, and further where even that is too much.
Colour exact_scale_colour(double fraction) {
  const double hue = (318 - 210 * fraction) * std::numbers::pi / 180;
  const double level = 0.33 + 0.60 * fraction;
  for (double chroma = 0.15 - 0.22 * fraction + 0.24 * fraction * fraction;; chroma -= 0.001) {
    const std::array<double, 3> light = linear_light(level, chroma, hue);
    const auto [least, most] = std::minmax_element(light.begin(), light.end());
    if ((*least >= 0 && *most <= 1) || chroma <= 0) {
      return {to_srgb(light[0]), to_srgb(light[1]), to_srgb(light[2])};
    }
  }
}

}  // namespace

Colour scale_colour(double fraction) {
  constexpr int steps = 256;
  static const std::vector<Colour> table = [] {
    std::vector<Colour> colours;
    for (int i = 0; i < steps; ++i) colours.push_back(exact_scale_colour(i / (steps - 1.0)));
    return colours;
  }();
  const double within = fraction > 0 ? std::min(fraction, 1.0) : 0;  // also not-a-number
  return table[static_cast<std::size_t>(std::lround(within * (steps - 1)))];
}

double lightness(Colour colour) {
  const double r = to_linear(colour.red), g = to_linear(colour.green), b = to_linear(colour.blue);
  return 0.2104542553 * std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b) +
         0.7936177850 * std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b) -
         0.0040720468 * std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
}

Colour series_colour(std::size_t index) {
  constexpr std::array<Colour, 7> colours = {{{0.00, 0.45, 0.70},
                                              {0.84, 0.37, 0.00},
                                              {0.00, 0.62, 0.45},
                                              {0.80, 0.47, 0.65},
                                              {0.13, 0.15, 0.18},
                                              {0.90, 0.62, 0.00},
                                              {0.34, 0.71, 0.91}}};
  return colours[index % colours.size()];
}

ColourRange colour_range(const std::vector<double>& values, double clipped) {
  std::vector<double> sorted;
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted),
               [](double value) { return std::isfinite(value); });
  if (sorted.empty())
    throw Error(ExitCode::bad_data, "a picture needs at least one finite value for its colours");
  std::sort(sorted.begin(), sorted.end());
  const auto skipped = static_cast<std::size_t>(clipped * static_cast<double>(sorted.size() - 1));
  ColourRange range{sorted[skipped], sorted[sorted.size() - 1 - skipped]};
  if (range.low == range.high) {
    const double half = range.low == 0 ? 0.5 : 0.05 * std::abs(range.low);
    range = {range.low - half, range.high + half};
  }
  return range;
}

}  // namespace ripstop::inline output

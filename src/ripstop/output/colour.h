// Colours of pictures and plots.
#pragma once

#include <cstdint>
#include <vector>

namespace ripstop::inline output {

/// sRGB, 0 .. 1.
struct Colour {
  double red = 0, green = 0, blue = 0;
};

inline constexpr Colour ink{0.13, 0.15, 0.18};       // text and lines
inline constexpr Colour faint{0.82, 0.84, 0.87};     // grids
inline constexpr Colour panel{0.955, 0.962, 0.97};   // background of drawings
inline constexpr Colour no_value{0.62, 0.62, 0.62};  // cells whose value is not a number

/// Scale for magnitudes, 0 (dark violet) over blue and green to 1 (yellow). The lightness L of Oklab
/// (B. Ottosson, 2020) rises evenly, so equal steps look equal, in grey too and to the colour-blind.
/// Below 0 and above 1 the ends.
Colour scale_colour(double fraction);

/// Oklab's lightness, 0 (black) .. 1 (white).
double lightness(Colour colour);

/// Colours of series for colour-blind readers (M. Okabe and K. Ito, 2008), in order.
Colour series_colour(std::size_t index);

/// The range that a scale shows [unit of the values].
struct ColourRange {
  double low = 0, high = 1;
};
/// From the smallest to the largest finite value but for `clipped` of them at either end, so that single
/// peaks do not darken the rest. Widened when all are equal. Throws Error(bad_data) without a finite value.
ColourRange colour_range(const std::vector<double>& values, double clipped = 0);

}  // namespace ripstop::inline output

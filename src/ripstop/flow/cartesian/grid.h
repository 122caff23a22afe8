// Metrics of a rectilinear grid, one axis at a time, and the padded layout of the fields on it.
#pragma once

#include <cstddef>
#include <vector>

#include "ripstop/flow/cartesian/memory.h"

namespace ripstop::inline flow::cartesian {

/// Condition of a variable at one end of an axis.
enum class End { zero_gradient, fixed_value };

/// One axis of n cells. Face f is the low side of cell f; face n is the high end.
struct Axis {
  int n = 0;
  std::vector<double> edge;              // n + 1 [m]
  std::vector<double> width;             // n [m]
  std::vector<double> inverse_width;     // n [1/m]
  std::vector<double> weight_low;        // n + 1: face value = w q[f-1] + (1-w) q[f], linear interpolation
  std::vector<double> inverse_distance;  // n + 1: 1 / distance of the two values that a face parts [1/m]
  std::vector<double> slope_low;         // n: dq/dx at cell c = slope_low (q[c] - q[c-1])
  std::vector<double> slope_high;        // n:                 + slope_high (q[c+1] - q[c]), Gauss linear
  std::vector<double>
      ratio_low;  // n + 1: distance of the centres on either side of face f over that at f - 1
  std::vector<double> ratio_high;  // n + 1: ... over that at f + 1
};

/// Axis from its n + 1 edges, increasing. At an end with a fixed value the distance is the half cell, at one
/// with zero gradient the inverse distance is zero. Throws Error(usage) if the edges do not increase.
Axis make_axis(std::vector<double> edges, End low, End high);

/// Fields carry one layer of ghost cells; rows start on a cache line.
struct Layout {
  int nx = 0, ny = 0, nz = 0;
  int stride_y = 0;  // values from a row to the next
  int stride_z = 0;  // values from a plane to the next

  static constexpr int lead = 8;  // values before cell 0 of a row, so that cell 0 is aligned to 64 bytes

  Layout() = default;
  Layout(int nx_, int ny_, int nz_);

  std::size_t values() const { return static_cast<std::size_t>(stride_z) * (nz + 2); }
  std::ptrdiff_t at(int i, int j, int k) const {
    return lead + i + static_cast<std::ptrdiff_t>(j + 1) * stride_y +
           static_cast<std::ptrdiff_t>(k + 1) * stride_z;
  }
  /// Offset of cell (i, j) inside a single plane (rings of planes in the sweeps).
  std::ptrdiff_t in_plane(int i, int j) const {
    return lead + i + static_cast<std::ptrdiff_t>(j + 1) * stride_y;
  }
};

}  // namespace ripstop::inline flow::cartesian

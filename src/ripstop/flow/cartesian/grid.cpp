#include "ripstop/flow/cartesian/grid.h"

#include <fmt/format.h>

#include <algorithm>

#include "ripstop/core/error.h"

namespace ripstop::inline flow::cartesian {

Axis make_axis(std::vector<double> edges, End low, End high) {
  Axis axis;
  axis.n = static_cast<int>(edges.size()) - 1;
  if (axis.n < 2) throw Error(ExitCode::usage, "flow grid: an axis needs at least 2 cells");
  const int n = axis.n;
  axis.edge = std::move(edges);
  axis.width.resize(n);
  axis.inverse_width.resize(n);
  for (int c = 0; c < n; ++c) {
    axis.width[c] = axis.edge[c + 1] - axis.edge[c];
    if (!(axis.width[c] > 0)) {
      throw Error(ExitCode::usage,
                  fmt::format("flow grid: edges must increase, but edge {} is {} and edge {} is {}", c,
                              axis.edge[c], c + 1, axis.edge[c + 1]));
    }
    axis.inverse_width[c] = 1 / axis.width[c];
  }
  axis.weight_low.assign(n + 1, 0.5);  // ghost cells are as wide as their neighbours
  axis.inverse_distance.assign(n + 1, 0);
  for (int f = 1; f < n; ++f) {
    axis.weight_low[f] = axis.width[f] / (axis.width[f - 1] + axis.width[f]);
    axis.inverse_distance[f] = 2 / (axis.width[f - 1] + axis.width[f]);
  }
  if (low == End::fixed_value) axis.inverse_distance[0] = 2 / axis.width[0];
  if (high == End::fixed_value) axis.inverse_distance[n] = 2 / axis.width[n - 1];
  axis.slope_low.resize(n);
  axis.slope_high.resize(n);
  for (int c = 0; c < n; ++c) {
    axis.slope_low[c] = axis.weight_low[c] * axis.inverse_width[c];
    axis.slope_high[c] = (1 - axis.weight_low[c + 1]) * axis.inverse_width[c];
  }
  const auto apart = [&](int f) {  // ghost cells again as wide as their neighbours
    return 0.5 * (axis.width[std::max(f - 1, 0)] + axis.width[std::min(f, n - 1)]);
  };
  axis.ratio_low.resize(n + 1);
  axis.ratio_high.resize(n + 1);
  for (int f = 0; f <= n; ++f) {
    axis.ratio_low[f] = apart(f) / apart(std::max(f - 1, 0));
    axis.ratio_high[f] = apart(f) / apart(std::min(f + 1, n));
  }
  return axis;
}

Layout::Layout(int nx_, int ny_, int nz_)
    : nx(nx_), ny(ny_), nz(nz_), stride_y((lead + nx_ + 1 + 7) / 8 * 8), stride_z(stride_y * (ny_ + 2)) {}

}  // namespace ripstop::inline flow::cartesian

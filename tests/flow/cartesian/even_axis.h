#pragma once

#include <vector>

#include "ripstop/flow/cartesian/grid.h"

namespace ripstop::testing {

/// n cells alike from `low` on, with nothing fixed at the ends.
inline cartesian::Axis even_axis(double low, double size, int n) {
  std::vector<double> edges(n + 1);
  for (int i = 0; i <= n; ++i) edges[i] = low + size * i / n;
  return cartesian::make_axis(edges, cartesian::End::zero_gradient, cartesian::End::zero_gradient);
}

}  // namespace ripstop::testing

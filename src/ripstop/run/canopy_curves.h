// Curves over time, one for each canopy of a cluster.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ripstop/fsi/cluster_motion.h"
#include "ripstop/output/plot.h"

namespace ripstop::inline run {

template <class Value>
std::vector<PlotSeries> canopy_curves(const std::vector<CanopyRow>& rows, Value value) {
  std::vector<PlotSeries> curves;
  for (const CanopyRow& row : rows) {
    const auto k = static_cast<std::size_t>(row.canopy) - 1;
    if (k == curves.size()) curves.push_back({"canopy " + std::to_string(k + 1), {}, {}, true, false, k > 0});
    curves[k].x.push_back(row.time), curves[k].y.push_back(value(row));
  }
  return curves;
}

}  // namespace ripstop::inline run

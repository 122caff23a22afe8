// Search for the spread angle of a cluster at which the force of each canopy points along its axis.
#pragma once

#include <optional>
#include <vector>

#include "ripstop/case/cluster.h"
#include "ripstop/fsi/steady_state.h"

namespace ripstop::inline run {

/// Spread angle of the next solution, or nothing where the last one is at an end of the range and its forces point
/// out of it. The first steps follow the forces, so that the equilibrium is stable: the forces are inclined
/// outward below it and inward above. Between two solutions that enclose it the next angle is that of the regula falsi.
/// `trials` are not empty, and none of them is within the tolerance [deg].
std::optional<double> next_spread_angle(const std::vector<SpreadTrial>& trials, const SpreadRange& range);

}  // namespace ripstop::inline run

// Results of the canopies of a cluster.
#pragma once

#include <vector>

#include "ripstop/run/steady/steady.h"

namespace ripstop::inline run {

/// Of a solver with a cluster; `tensions` are those of all springs, `drag_coefficient` is on S0 of all canopies.
ClusterResult cluster_result(const SteadySolver& solver, const SteadyState& state,
                             const std::vector<double>& tensions, double drag_coefficient,
                             const Settings& resolved);
/// Of a canopy along its own axis, mean over the canopies.
CanopySize mean_size(const Cluster& cluster, const std::vector<Vec3>& shape);
/// The result is experimental, and the angle may be far from equilibrium.
std::vector<std::string> cluster_warnings(const ClusterResult& cluster);

}  // namespace ripstop::inline run

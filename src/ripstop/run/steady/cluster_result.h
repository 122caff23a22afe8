// Results of the canopies of a cluster.
#pragma once

#include <string>
#include <vector>

#include "ripstop/run/steady/steady.h"

namespace ripstop::inline run {

/// Mean over the canopies of the angle between the force at the centre of the skirt and the axis of the canopy,
/// positive outward [deg].
double force_angle(const Cluster& cluster, const SteadyState& state);
/// Of a solver with a cluster; `tensions` are those of all springs, `drag_coefficient` is on S0 of all canopies.
ClusterResult cluster_result(const SteadySolver& solver, const SteadyState& state,
                             const std::vector<double>& tensions, double drag_coefficient,
                             const Settings& resolved);
/// Of the canopies that remain when the largest one fails: they carry the load of all in a steady descent, so that all
/// loads within a canopy are load_after_failure() times those of the run. The load of the hardware below the confluence
/// does not change, and the hardware is left out.
Margins margins_after_failure(const SteadySolver& solver, std::vector<double> tensions, StressPeak stress,
                              const Settings& resolved);
/// Of a canopy along its own axis, mean over the canopies.
CanopySize mean_size(const Cluster& cluster, const std::vector<Vec3>& shape);
/// The result is experimental, the angle may be far from equilibrium, and a member too weak when a canopy fails.
std::vector<std::string> cluster_warnings(const ClusterResult& cluster);

}  // namespace ripstop::inline run

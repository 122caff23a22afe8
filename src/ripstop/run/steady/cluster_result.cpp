#include "ripstop/run/steady/cluster_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ripstop/canopy/shape.h"
#include "ripstop/canopy/stress.h"
#include "ripstop/case/cluster.h"
#include "ripstop/core/angle.h"
#include "ripstop/core/words.h"

namespace ripstop::inline run {
namespace {

constexpr double largest_force_angle = 2;    // [deg]
constexpr double largest_difference = 0.05;  // between riser loads

/// Of the load on canopy `k` about the confluence, about y of the canopy: from its axis z outward to x [N m].
double spreading_moment(const Cluster& cluster, const SteadyState& state, int k) {
  return cluster.frame(k).in(state.canopy_moments.at(static_cast<std::size_t>(k))).y;
}

}  // namespace

bool in_equilibrium(const ClusterResult& cluster) {
  return std::abs(cluster.force_angle_deg) <= equilibrium_tolerance;
}

bool search_failed(const ClusterResult& cluster) {
  return cluster.search && cluster.search->size() >= most_spread_trials && !in_equilibrium(cluster);
}

double force_angle(const Cluster& cluster, const SteadyState& state) {
  double mean = 0;
  for (int k = 0; k < cluster.canopies(); ++k) {
    const std::vector<Vec3> shape = cluster.own(k, state.shape);
    const auto fixed = static_cast<std::size_t>(cluster.one(k).fixed.front());
    const double arm = norm(skirt_centroid(cluster.one(k), shape) - shape[fixed]);
    const double force = norm(state.canopy_forces.at(static_cast<std::size_t>(k)));
    mean += spreading_moment(cluster, state, k) / (force * arm) / degree / cluster.canopies();
  }
  return mean;
}

ClusterResult cluster_result(const SteadySolver& solver, const SteadyState& state,
                             const std::vector<double>& tensions, double drag_coefficient,
                             const Settings& resolved) {
  const Cluster& cluster = *solver.cluster();
  const Case& given = resolved.written();
  ClusterResult result;
  result.spread_angle_deg = cluster.layout().spread / degree;
  result.force_angle_deg = force_angle(cluster, state);
  result.gap = cluster.gap(state.shape);
  double least = std::numeric_limits<double>::infinity(), most = 0, sum = 0;
  for (int k = 0; k < cluster.canopies(); ++k) {
    const std::vector<Vec3> shape = cluster.own(k, state.shape);
    const Vec3 force = state.canopy_forces.at(static_cast<std::size_t>(k));
    const CanopyMesh& one = cluster.one(k);
    ClusterCanopy& canopy = result.canopies.emplace_back();
    if (!cluster.equal()) canopy.size_ratio = size_ratio(given, k);
    canopy.azimuth_deg = cluster.layout().azimuth(k) / degree;
    canopy.drag = force.z;
    canopy.force = norm(force);
    canopy.spreading_moment = spreading_moment(cluster, state, k);
    for (const LineTension& t : line_tensions(one, cluster.part(k, tensions)))
      canopy.max_line_tension = std::max(canopy.max_line_tension, t.largest_tension);
    canopy.projected_diameter = canopy_size(one, shape).projected_diameter;
    // Loads of canopies of other sizes are compared by the area.
    const double load = canopy.force / (size_ratio(given, k) * size_ratio(given, k));
    least = std::min(least, load), most = std::max(most, load), sum += load;
  }
  result.difference = (most - least) / (sum / cluster.canopies());
  if (const auto& single = given.cluster->single_drag_coefficient)
    result.cluster_factor = drag_coefficient / *single;
  return result;
}

Margins margins_after_failure(const SteadySolver& solver, std::vector<double> tensions, StressPeak stress,
                              const Settings& resolved) {
  const double more = load_after_failure(resolved.written());
  for (double& tension : tensions) tension *= more;
  stress.warp *= more, stress.weft *= more;
  Margins margins = case_margins(resolved, solver.mesh(), tensions, stress);
  std::erase_if(margins.members, [&](const Margin& m) { return resolved.hardware().contains(m.member); });
  take_weakest(margins);
  return margins;
}

CanopySize mean_size(const Cluster& cluster, const std::vector<Vec3>& shape) {
  std::vector<std::vector<Vec3>> canopies;
  for (int k = 0; k < cluster.canopies(); ++k) canopies.push_back(cluster.own(k, shape));
  return mean_size(cluster.one(), canopies);
}

std::vector<std::string> cluster_warnings(const ClusterResult& cluster) {
  std::vector<std::string> all = {
      "cluster: the loads of a cluster are experimental (docs/guide/cluster-of-canopies.md)"};
  if (std::abs(cluster.force_angle_deg) > largest_force_angle)
    all.push_back(fmt::format(
        "cluster.spread_angle_deg = {:.4g}: no equilibrium; the forces of the canopies are inclined to "
        "their axes by {} deg and would {} the angle",
        cluster.spread_angle_deg, rounded(std::abs(cluster.force_angle_deg), 2),
        cluster.force_angle_deg > 0 ? "increase" : "reduce"));
  if (cluster.difference > largest_difference)
    all.push_back(
        fmt::format("cluster: the riser loads of the canopies differ by {} %; their mean is not that "
                    "of a symmetric flow (use finer cells, or flow.unsteady = true)",
                    rounded(100 * cluster.difference, 2)));
  for (const std::string& text : margin_warnings(cluster.one_failed))
    all.push_back("when one canopy of the cluster fails, " + text);
  return all;
}

}  // namespace ripstop::inline run

#include "ripstop/fsi/equilibrium.h"

#include <algorithm>
#include <cmath>

#include "ripstop/cloth/restraint.h"

namespace ripstop::inline fsi {
namespace {

constexpr int most_free_steps = 40000;  // without regularisation, where a loaded shape exists
// First and strongest regularisation in regularisation_unit(), and the factor from one attempt to the next.
constexpr double first_attempt = 3, strongest_attempt = 48, next_attempt = 4;
// In time an averaging window costs more than the cloth: up to so many regularised equilibria precede the next window.
constexpr int most_repetitions = 4;

}  // namespace

double regularisation_unit(const std::vector<double>& pressure, const std::vector<double>& area) {
  double sum = 0, whole = 0;
  for (std::size_t c = 0; c < area.size(); ++c) sum += std::abs(pressure[c]) * area[c], whole += area[c];
  return sum / std::pow(whole, 1.5);
}

ClothState cloth_at(const Cloth& cloth, const std::vector<Vec3>& positions) {
  ClothState state = start_state(cloth);
  set_positions(state, cloth, positions);
  return state;
}

Equilibrium find_equilibrium(const Cloth& cloth, const std::vector<Vec3>& previous, const Loads& loads,
                             const EquilibriumOptions& how, ThreadTeam& team,
                             const std::function<void(const RelaxProgress&)>& report) {
  Equilibrium found;
  RelaxOptions options;
  options.tolerance = how.tolerance;
  options.regularisation = how.regularisation;
  if (how.shape_is_loaded) options.max_steps = most_free_steps;
  const auto relax_further = [&] {
    const RelaxResult result = relax(found.cloth, cloth, loads, options, team, report);
    found.steps += result.steps;
    return result;
  };
  const auto relax_from_previous = [&] {
    found.cloth = cloth_at(cloth, previous);
    return relax_further();
  };
  RelaxResult relaxed = relax_from_previous();
  while (how.shape_is_loaded && !relaxed.converged && options.regularisation < strongest_attempt * how.unit) {
    options.regularisation = std::max(first_attempt * how.unit, next_attempt * options.regularisation);
    relaxed = relax_from_previous();
  }
  for (int n = 1;
       n < most_repetitions && relaxed.converged && relaxed.regularisation_share > how.repeat_above; ++n) {
    const ClothState reached = found.cloth;
    if (const RelaxResult further = relax_further(); further.converged)
      relaxed = further;
    else
      found.cloth = reached;
  }
  found.converged = relaxed.converged;
  found.residual = relaxed.residual;
  found.regularisation = options.regularisation;
  found.regularisation_share = relaxed.regularisation_share;
  return found;
}

Equilibrium find_equilibrium(const Cluster& cluster, const std::vector<ClothPtr>& each, const Cloth& all,
                             const std::vector<Vec3>& previous, const Loads& loads,
                             const EquilibriumOptions& how, ThreadTeam& team,
                             const std::function<void(const RelaxProgress&)>& report) {
  Equilibrium found;
  found.converged = true;
  std::vector<Vec3> shape = previous;
  for (int k = 0; k < cluster.canopies(); ++k) {
    const Cluster::Frame axes = cluster.frame(k);
    const Cloth& one = *each[cluster.equal() ? 0 : static_cast<std::size_t>(k)];
    Loads own{cluster.part(k, loads.cell_pressure), cluster.part(k, loads.node_force)};
    for (Vec3& force : own.node_force) force = axes.in(force);
    const Equilibrium canopy =
        find_equilibrium(one, cluster.own(k, previous), own, how, team, [&](const RelaxProgress& progress) {
          if (report) report({found.steps + progress.steps, progress.residual, progress.kinetic_energy});
        });
    for (const Vec3& force : pivot_restraint(one, canopy.cloth, own))
      found.restraint.push_back(axes.out(force));
    cluster.put(k, cluster.upright(k, positions(canopy.cloth, one)), shape);
    found.converged = found.converged && canopy.converged;
    found.steps += canopy.steps;
    found.residual = std::max(found.residual, canopy.residual);
    found.regularisation = std::max(found.regularisation, canopy.regularisation);
    found.regularisation_share = std::max(found.regularisation_share, canopy.regularisation_share);
  }
  found.cloth = cloth_at(all, shape);
  return found;
}

}  // namespace ripstop::inline fsi

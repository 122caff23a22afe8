#include "ripstop/fsi/equilibrium.h"

#include <algorithm>
#include <cmath>

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

}  // namespace ripstop::inline fsi

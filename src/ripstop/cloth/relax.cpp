// Equilibrium by dynamic relaxation with kinetic damping (Barnes 1999, Int. J. Space Structures 14).
//
// Fictitious masses m = margin kappa / 2, with kappa the node's stiffness of step_bound, make a step of 1
// stable everywhere, so every part of the cloth moves as fast as it can. Whenever the kinetic energy passes a
// peak, that is when sum f . (v + v') turns negative, all velocities are set to 0.
//
// Stops alone kill the slowest mode and may leave its overtones alone for ever (a bar pulled at its ends has
// cos(n pi / 2) of them left after each). So between stops the motion is also damped at the rate 3 / t of
// Nesterov's accelerated descent, t steps since the stop, which wears off before it slows the slow modes:
//   v' = t / (t + 3) v + (t + 3/2) / (t + 3) f / m
// is leapfrog with implicit damping, stable for the same masses, and starts from rest with half a kick.
//
// A parachute hangs on one point and may turn about it. Under a follower pressure that is neutral: a small
// moment of a wrinkled shape would turn it for ever. So the moment of the loads about that point is cancelled
// by the smallest node forces that do, and the turning taken out of the velocities.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ripstop/cloth/bound.h"
#include "ripstop/cloth/pivot.h"
#include "ripstop/cloth/stepper.h"
#include "ripstop/core/error.h"

namespace ripstop {
namespace {

constexpr double margin = 1.2;    // on the masses, for stiffening between two refreshes
constexpr int steps_a_look = 50;  // between looks at the applied load and the report
// Steps between two refreshes of the masses: they follow closely while the cloth is far from equilibrium.
// Tape stiffens tenfold at strains that a wild start (sails with fullness, gathered cloth) or the jerk of
// lines that come taut makes within a few steps.
int steps_a_refresh(const RelaxResult& result) {
  if (result.steps < 500) return 5;
  return result.residual > 1 ? steps_a_look : 400;
}

Stepper::Fictitious fictitious_masses(const Cloth& cloth, const ClothState& state) {
  Stepper::Fictitious masses{node_stiffness(cloth, state).stiffness};
  // A node without any stiffness (a hole in the cloth) rests where it is.
  for (double& mass : masses.mass) mass *= 0.5 * margin;
  for (int node : cloth.mesh.fixed) masses.mass[node] = 0;
  for (const Tie& tie : cloth.mesh.ties) masses.mass[tie.node] = 0;
  return masses;
}

double fictitious_energy(const Cloth& cloth, const ClothState& state, const std::vector<double>& mass) {
  double sum = 0;
  for (std::size_t node = 0; node < mass.size(); ++node) {
    const Vec3 v = get(state.v.data(), cloth.slot[node]);
    sum += 0.5 * mass[node] * dot(v, v);
  }
  return sum;
}

void undo_last_move(ClothState& state, const Cloth& cloth) {
  for (std::size_t i = 0; i < state.x.size(); ++i) state.x[i] -= state.v[i];
  follow(cloth, state.x.data(), 0, cloth.row_count, true);
  mirror(cloth, state.x.data(), 0, cloth.row_count);
}

double mean_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0;
  for (std::size_t node = 0; node < a.size(); ++node) sum += norm(a[node] - b[node]);
  return sum / static_cast<double>(a.size());
}

}  // namespace

RelaxResult relax(ClothState& state, const Cloth& cloth, const Loads& loads, const RelaxOptions& options,
                  ThreadTeam& team, const std::function<void(const RelaxProgress&)>& report) {
  const std::vector<Vec3> start = positions(state, cloth);
  std::fill(state.v.begin(), state.v.end(), 0.0);
  Stepper::Fictitious masses = fictitious_masses(cloth, state);
  Stepper stepper(cloth, loads, state, masses, team.size());
  for (int rank = 0; rank < team.size(); ++rank) stepper.stop(rank);
  RelaxResult result;
  const std::optional<Vec3> pivot = pivot_of(cloth, state);
  int since_refresh = 0;
  while (!result.converged && result.steps < options.max_steps) {
    const AppliedLoad applied = applied_load(cloth, state, loads, pivot.value_or(Vec3{}));
    if (pivot) {
      std::vector<Vec3> force = loads.node_force;
      cancel_moment(cloth, state, applied.moment, *pivot, force);
      stepper.set_node_force(force);
      result.unbalanced_moment = norm(applied.moment);
    }
    const double scale = std::max(applied.norm, options.least_load);
    const int refresh_after = steps_a_refresh(result);
    const int count = std::min({steps_a_look, refresh_after, options.max_steps - result.steps});
    int done = 0;
    team.run([&](int rank) {
      for (int i = 0; i < count; ++i) {
        stepper.add_forces(rank);
        team.barrier();
        stepper.move_kept(rank);
        team.barrier();
        const RowSums sums = stepper.sums();
        const double residual = std::sqrt(sums.force_squared) / scale;
        const bool ends = residual <= options.tolerance;
        if (sums.power < 0 && !ends) stepper.stop(rank);
        stepper.follow_masters(rank);
        if (rank == 0) {
          ++done;
          result.residual = residual;
          result.converged = ends;
        }
        team.barrier();
        if (ends) break;
      }
    });
    result.steps += done;
    check_health(cloth, state);
    if (pivot && !result.converged) stop_turning(cloth, state, masses.mass, *pivot);
    if (report) report({result.steps, result.residual, fictitious_energy(cloth, state, masses.mass)});
    since_refresh += done;
    if (since_refresh >= refresh_after && !result.converged) {
      since_refresh = 0;
      masses = fictitious_masses(cloth, state);
      stepper.set_masses(masses);
    }
  }
  if (result.converged) undo_last_move(state, cloth);  // the residual is that of the positions before it
  std::fill(state.v.begin(), state.v.end(), 0.0);
  result.mean_displacement = mean_distance(positions(state, cloth), start);
  return result;
}

}  // namespace ripstop

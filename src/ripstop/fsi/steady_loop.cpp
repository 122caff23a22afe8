#include "ripstop/fsi/steady_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "ripstop/canopy/shape.h"
#include "ripstop/core/error.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/flow/apart.h"
#include "ripstop/flow/steady.h"
#include "ripstop/fsi/flow_sampling.h"
#include "ripstop/fsi/ledger.h"
#include "ripstop/fsi/lines_apart.h"
#include "ripstop/fsi/next_load.h"

namespace ripstop::inline fsi {
namespace {

void require_inside(const FlowGrid& grid, const Mesh& mesh, const std::vector<Cell>& cells) {
  const Vec3 far = grid.origin + grid.size;
  for (const Cell& cell : cells) {
    for (const int node : cell.corner) {
      if (node < 0) continue;
      const Vec3 p = mesh.start[node];
      if (p.x < grid.origin.x || p.y < grid.origin.y || p.z < grid.origin.z || p.x > far.x || p.y > far.y ||
          p.z > far.z) {
        throw Error(
            ExitCode::usage,
            fmt::format("the canopy does not fit into the flow domain: cloth at ({:.3g}, {:.3g}, {:.3g}) m, "
                        "domain from ({:.3g}, {:.3g}, {:.3g}) to ({:.3g}, {:.3g}, {:.3g}) m",
                        p.x, p.y, p.z, grid.origin.x, grid.origin.y, grid.origin.z, far.x, far.y, far.z));
      }
    }
  }
}

/// The flow of a cluster needs air between the canopies.
void require_apart(const Cluster& cluster, const std::vector<Vec3>& shape) {
  const double gap = cluster.gap(shape);
  if (gap > 0) return;
  throw ClusterTouches(
      ExitCode::usage,
      fmt::format(
          "the canopies of the cluster touch: at the spread angle of {:.4g} deg their cloth crosses the "
          "plane midway between two of them by {:.3g} m; increase that angle or the length of the riser",
          cluster.layout().spread * 180 / std::numbers::pi, -0.5 * gap),
      {"spread angle", "length of the riser"});
}

/// Force and moment about the confluence of the load on each canopy.
void enter_canopies(SteadyState& state, const Cluster& cluster, const FlowField& field,
                    std::size_t triangles) {
  state.canopy_forces.assign(cluster.canopies(), {});
  state.canopy_moments.assign(cluster.canopies(), {});
  const std::size_t of_one = triangles / cluster.canopies();
  for (const SheetLoad& load : field.sheet_loads) {
    if (load.body != 0) continue;
    const std::size_t k = load.triangle / of_one;
    state.canopy_forces[k] += load.force;
    state.canopy_moments[k] += cross(load.point - cluster.confluence(), load.force);
  }
}

double largest_coefficient(const Mesh& mesh) {
  double largest = 0;
  for (const Patch& patch : mesh.patches) {
    for (const SpringLaw& law : patch.law) {
      for (const double k : law.coefficients) largest = std::max(largest, std::abs(k));
    }
  }
  return largest;
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

SteadySolver::SteadySolver(SteadyProblem problem, FlowEngine& engine)
    : problem_(std::move(problem)),
      flow_(engine.start(problem_.flow)),
      cloth_(make_cloth(problem_.mesh, {.linear = problem_.settings.linear})),
      cells_(cells_of(problem_.mesh)),
      convergence_(problem_.settings, problem_.averaging_window, problem_.mesh.fixed),
      team_(problem_.settings.threads) {
  for (const Patch& patch : problem_.mesh.patches) {
    area_.insert(area_.end(), patch.cell_area.begin(),
                 patch.cell_area.begin() + (patch.rows - 1) * patch.columns);
  }
  if (const auto& cluster = problem_.cluster)
    for (int k = 0; k < (cluster->equal() ? 1 : cluster->canopies()); ++k)
      canopies_.push_back(make_cloth(cluster->one(k), {.linear = problem_.settings.linear}));
  require_inside(problem_.flow.grid, problem_.mesh, cells_);
  require_lines_apart(problem_.mesh, problem_.mesh.start, problem_.flow.bodies);
}

SteadyState SteadySolver::start() const {
  SteadyState state;
  state.shape = problem_.mesh.start;
  const Freestream& air = problem_.flow.air;
  state.pressure.assign(cells_.size(), 0.5 * air.density * air.speed() * air.speed());
  state.accelerator.update = problem_.settings.acceleration;
  state.accelerator.relaxation = problem_.settings.relaxation;
  return state;
}

bool SteadySolver::finished(const SteadyState& state) const {
  return state.converged || static_cast<int>(state.iterations.size()) >= problem_.settings.max_iterations;
}

FlowField SteadySolver::iterate(SteadyState& state, const SteadyReport& report) {
  const auto begin = std::chrono::steady_clock::now();
  SteadyIteration now;
  now.iteration = static_cast<int>(state.iterations.size()) + 1;

  // Equilibrium of the cloth under the present load.
  Loads loads = loads_of(state, cells_);
  const Equilibrium cloth = solve_cloth(state, loads, now, report);
  const std::vector<Vec3> shape = positions(cloth.cloth, *cloth_);
  enter_shape_change(now, state.shape, shape);
  for (std::size_t node = 0; node < cloth.restraint.size(); ++node)
    loads.node_force[node] += cloth.restraint[node];
  enter_cloth(now, state, cloth.cloth, loads, shape, problem_.mesh, *cloth_, cells_);
  for (const Vec3& force : cloth.restraint) now.line_tension -= force.z;
  if (problem_.cluster) require_apart(*problem_.cluster, shape);

  // Move the surface, advance the flow.
  const CanopySurface canopy(cells_, shape, problem_.flow.grid);
  require_apart(canopy.triangles, problem_.flow.bodies);
  const bool in_full = convergence_.asks_for_full_flow(state, now);
  flow_->place(0, canopy.triangles);
  FlowField field = advance_flow(state, shape, now, in_full, report);
  enter_flow(now, state, field, problem_.mesh, shape);
  state.body_forces.clear(), state.body_moments.clear();
  for (std::size_t n = 1; n < field.bodies.size(); ++n) {
    state.body_forces.push_back(field.bodies[n].force);
    state.body_moments.push_back(field.bodies[n].moment);
  }
  if (problem_.cluster) enter_canopies(state, *problem_.cluster, field, canopy.triangles.size());
  now.cut_cells = static_cast<int>(canopy.cut_cells.size());
  now.printed_tolerance = printed_tolerance(now.flow_residual);

  // Transfer the load.
  state.sides = sides_of_cloth(field, canopy, problem_.flow.has_sheets());
  const ClothLoad answer = load_on_cloth(problem_.settings.load, field, canopy, state.sides, now);

  // Convergence, and the load of the next iteration.
  state.converged = convergence_.reached(state, now, in_full);
  state.shape = shape;
  state.applied = state.pressure;
  update_load(state, answer, now.drag_change, area_, problem_.settings);
  now.wall_time = seconds_since(begin);
  state.iterations.push_back(now);
  if (state.converged && problem_.averaging_window && !state.in_time) begin_windows(state, problem_.settings);
  return field;
}

Equilibrium SteadySolver::solve_cloth(const SteadyState& state, const Loads& loads, SteadyIteration& now,
                                      const SteadyReport& report) {
  EquilibriumOptions options;
  options.tolerance = problem_.settings.cloth_tolerance;
  // A run that starts from a neighbour has a shape under load; the canopy as sewn is none.
  options.shape_is_loaded = !(state.shape == problem_.mesh.start);
  options.unit = regularisation_unit(state.pressure, area_);
  if (!state.iterations.empty()) options.regularisation = state.iterations.back().regularisation;
  if (state.in_time) options.repeat_above = regularisation_tolerance / 4;
  const auto shown = [&](const RelaxProgress& progress) {
    if (report) report({.stage = SteadyStage::cloth, .iteration = now.iteration, .cloth = progress});
  };
  Equilibrium found = problem_.cluster ? find_equilibrium(*problem_.cluster, canopies_, *cloth_, state.shape,
                                                          loads, options, team_, shown)
                                       : find_equilibrium(*cloth_, state.shape, loads, options, team_, shown);
  if (!found.converged) {
    throw QuantityError(
        ExitCode::not_converged,
        fmt::format("coupling iteration {}: no equilibrium of the cloth, residual {:.2e} after {} steps "
                    "(tolerance {:.1e}); try a larger cloth tolerance or a finer cloth mesh",
                    now.iteration, found.residual, found.steps, options.tolerance),
        {"cloth tolerance", "cloth mesh"});
  }
  now.cloth_steps = found.steps;
  now.cloth_residual = found.residual;
  now.regularisation = found.regularisation;
  now.regularisation_share = found.regularisation_share;
  return found;
}

void SteadySolver::enter_first_estimate(SteadyState& state, const std::vector<Vec3>& shape,
                                        const FlowProgress& progress) const {
  const bool one_canopy = problem_.flow.bodies.size() == 1 && !problem_.cluster;
  if (!one_canopy || !state.iterations.empty() || state.first_estimate ||
      progress.iteration < FirstEstimate::flow_iterations)
    return;
  state.first_estimate = {problem_.flow.air.speed(), progress.drag,
                          canopy_size(problem_.mesh, shape).projected_diameter};
}

FlowField SteadySolver::advance_flow(SteadyState& state, const std::vector<Vec3>& shape,
                                     const SteadyIteration& now, bool in_full, const SteadyReport& report) {
  if (state.in_time) {
    return averaged_flow(
        *flow_, problem_.flow, *problem_.averaging_window, in_full, state, record_,
        [&](const WatchProgress& progress) {
          if (report) report({.stage = SteadyStage::time, .iteration = now.iteration, .time = progress});
          return true;
        });
  }
  return solve_to_rest(*flow_, convergence_.stopping(problem_.flow, now, in_full),
                       [&](const FlowProgress& progress) {
                         enter_first_estimate(state, shape, progress);
                         if (report)
                           report({.stage = SteadyStage::flow, .iteration = now.iteration, .flow = progress});
                         return true;
                       });
}

// R dx^2 / (S0 K_max): the tolerance of omega in [NFM] Eq. 19.
double SteadySolver::printed_tolerance(double flow_residual) const {
  const Vec3 h = problem_.flow.grid.spacing();
  const double dx = std::cbrt(h.x * h.y * h.z);
  return flow_residual * dx * dx / (problem_.reference_area * largest_coefficient(problem_.mesh));
}

}  // namespace ripstop::inline fsi

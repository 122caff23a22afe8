#include "ripstop/fsi/ledger.h"

#include <cmath>
#include <limits>

#include "ripstop/canopy/section_balance.h"
#include "ripstop/fsi/approach.h"

namespace ripstop::inline fsi {
namespace {

bool within(double a, double b, double tolerance) {
  return std::abs(a - b) <= tolerance * std::abs(b);
}

}  // namespace

Loads loads_of(const SteadyState& state, const std::vector<Cell>& cells) {
  const std::vector<double> no_pressure(cells.size(), 0.0);
  return {state.pressure, node_forces({no_pressure, state.residual_traction}, cells, state.shape)};
}

void enter_cloth(SteadyIteration& now, const SteadyState& state, const ClothState& equilibrium, Loads loads,
                 const std::vector<Vec3>& shape, const CanopyMesh& mesh, const Cloth& cloth,
                 const std::vector<Cell>& cells) {
  const Wrench load = wrench_of({state.pressure, state.residual_traction}, cells, shape);
  now.nodal_load = load.force.z;
  now.axial_moment = load.moment.z;
  now.line_tension = force_on_fixed(cloth, equilibrium).z;
  const std::vector<Vec3> pressures = node_forces({state.pressure, {}}, cells, shape);
  for (std::size_t node = 0; node < shape.size(); ++node) loads.node_force[node] += pressures[node];
  now.section_gap = largest_section_gap(mesh, cloth, equilibrium, loads.node_force);
}

void enter_flow(SteadyIteration& now, const SteadyState& state, const FlowField& field,
                const CanopyMesh& mesh, const std::vector<Vec3>& shape) {
  now.in_time = state.in_time;
  if (now.in_time) now.drag_error = state.window.error;
  now.flow_iterations = field.last.iteration;
  now.flow_residual = state.in_time ? 0 : largest_residual(field.last);
  now.flow_converged = field.converged;
  now.flow_averaged = field.average.iterations;
  now.drag_deviation = field.average.drag_deviation;
  now.drag_left = field.drag_left;
  const Vec3 others = force_on_others(field.bodies);
  now.fluid_force = field.porous_force.z - others.z;
  now.momentum_deficit = field.momentum_deficit.z - others.z;
  now.approach_speed = approach_speed(field, mesh, shape);
  now.drag_change = state.iterations.empty()
                        ? std::numeric_limits<double>::infinity()
                        : std::abs(now.fluid_force / state.iterations.back().fluid_force - 1);
}

double ledger_gap(const SteadyIteration& now) {
  const double nodes = std::abs(now.nodal_load / now.fluid_force - 1),
               lines = std::abs(now.line_tension / now.fluid_force - 1);
  return nodes > lines || std::isnan(nodes) ? nodes : lines;
}

bool ledger_closes(const SteadyIteration& now, double tolerance) {
  return within(now.nodal_load, now.fluid_force, tolerance) &&
         within(now.line_tension, now.fluid_force, tolerance);
}

bool momentum_closes(const SteadyIteration& now, double tolerance) {
  return within(now.momentum_deficit, now.fluid_force, tolerance);
}

}  // namespace ripstop::inline fsi

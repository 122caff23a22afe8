// The force ledger of the steady loop: the axial load at every hand-over, from the momentum of the flow to the riser.
#pragma once

#include <vector>

#include "ripstop/flow/flow.h"
#include "ripstop/fsi/equilibrium.h"
#include "ripstop/fsi/steady_state.h"
#include "ripstop/parachute/canopy_mesh.h"

namespace ripstop::inline fsi {

/// The load of `state` as the cloth takes it.
Loads loads_of(const SteadyState& state, const std::vector<Cell>& cells);

/// Loads of the cloth in equilibrium under `loads` at `shape`: sum of the nodal loads, moment about the axis,
/// tension at the fixed end, balance of the sections.
void enter_cloth(SteadyIteration& now, const SteadyState& state, const ClothState& equilibrium, Loads loads,
                 const std::vector<Vec3>& shape, const CanopyMesh& mesh, const Cloth& cloth,
                 const std::vector<Cell>& cells);

/// Loads of the flow around the new shape: force on the canopy, momentum deficit of the box, convergence.
void enter_flow(SteadyIteration& now, const SteadyState& state, const FlowField& field,
                const CanopyMesh& mesh, const std::vector<Vec3>& shape);

/// Largest relative difference between fluid force, nodal load and line tension at convergence; for a mean over
/// iterations or in time also between fluid force and momentum deficit: a wake that still grows keeps some of it.
inline constexpr double ledger_tolerance = 0.01;

/// The larger of the relative differences of nodal load and line tension from the fluid force.
double ledger_gap(const SteadyIteration& now);
/// Fluid force, nodal load and line tension agree within `tolerance`.
bool ledger_closes(const SteadyIteration& now, double tolerance);
/// Fluid force and momentum deficit agree within `tolerance`.
bool momentum_closes(const SteadyIteration& now, double tolerance);

}  // namespace ripstop::inline fsi

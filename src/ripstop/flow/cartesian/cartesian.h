// The built-in flow engine: steady RANS on a rectilinear grid with a porous canopy, the discrete operators of
// OpenFOAM's rhoPorousSimpleFoam on that grid. Theory: docs/theory/flow-cartesian.md.
#pragma once

#include <memory>

#include "ripstop/flow/flow.h"

namespace ripstop::inline flow {

struct CartesianSettings {
  int threads = 0;              // 0: as many as the process may run on
  bool compressible = true;     // perfect gas at constant total enthalpy; false: constant density
  bool second_order = false;    // limited linear convection of the velocity; false: upwind
  bool grid_sequencing = true;  // a cold start solves coarser grids first
  int pressure_cycles = 2;      // multigrid V cycles an iteration
  double relax_pressure = 1.0;  // (0, 1]
  double relax_velocity = 0.7;  // (0, 1]; the converged answer depends on it a little, through the face flux
  double relax_march = 0.8;     // (0, 1]; of the momentum step, no effect on the answer
  double relax_turbulence = 0.95;  // (0, 1]
  SmallEddies small_eddies = SmallEddies::wale;
};

/// Throws Error(usage) for settings outside their ranges.
std::unique_ptr<FlowEngine> make_cartesian(const CartesianSettings& settings = {});

}  // namespace ripstop::inline flow

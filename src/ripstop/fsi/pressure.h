// The uniform pressure difference that represents the air.
#pragma once

#include <functional>

#include "ripstop/core/thread_team.h"
#include "ripstop/parachute/canopy_mesh.h"

namespace ripstop::inline fsi {

struct UniformPressure {
  double pressure = 0;    // dp [Pa]
  double load = 0;        // axial, that it puts on the riser in equilibrium [N]
  double axial_area = 0;  // load / pressure: the cloth's projection along the axis [m2]
  int relaxations = 0;
};

/// Equilibrium of the mesh under a uniform `pressure` [Pa]. Throws Error(not_converged).
UniformPressure load_under(double pressure, const Mesh& mesh, bool linear, ThreadTeam& team);

/// The dp with which the equilibrium carries `load` [N] within 0.1 %: dp = load / A(dp), [NFM] as corrected. The
/// shape hardly depends on dp, so two or three equilibria suffice. Throws Error(not_converged). `alive` is called at
/// intervals; its exceptions end the search.
UniformPressure pressure_for(double load, const CanopyMesh& mesh, bool linear, ThreadTeam& team,
                             const std::function<void()>& alive = {});

}  // namespace ripstop::inline fsi

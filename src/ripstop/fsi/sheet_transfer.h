// The air's load on the faces of its grid, handed to the cells of the cloth: force and moment are kept.
#pragma once

#include <vector>

#include "ripstop/core/thread_team.h"
#include "ripstop/core/vec3.h"
#include "ripstop/flow/flow.h"
#include "ripstop/mesh/mesh.h"

namespace ripstop::inline fsi {

/// A force a unit area of cloth that varies as the velocity of a rigid body does: at_centre + twist x (x -
/// c), c the cloth's centre of area.
struct RigidTraction {
  Vec3 at_centre;  // [Pa]
  Vec3 twist;      // [Pa/m]
};

/// Loads of the air on the cloth: a pressure difference, and a small residual traction that closes the sums.
struct ClothLoad {
  std::vector<double> pressure;  // inside over outside, one a cell, 0 where there is no cloth [Pa]
  RigidTraction residual_traction;
  std::vector<Vec3> of_folds =
      {};  // a force per unit area of each cell in addition to both, with Folds::filled; else none [Pa]
};

/// Few: an inflated canopy. Filled: one that opens, most of whose cloth lies in folds.
enum class Folds { few, filled };

/// Force and its moment about the origin.
struct Wrench {
  Vec3 force;   // [N]
  Vec3 moment;  // [N m]
};
Wrench wrench_of(const std::vector<SheetLoad>& loads);
Wrench wrench_of(const ClothLoad& load, const std::vector<Cell>& cells, const std::vector<Vec3>& positions);

/// The pressure of every cell is the weighted plane through the pressures of the faces near it; the residual traction
/// is the smallest traction (in the mean square over the cloth) that makes force and moment those of `loads`. Cloth
/// in folds narrower than the flow's cells takes the pressure of open cloth nearby with the same orientation; with
/// Folds::filled the difference of the pressures on its two sides nearby, as a pleat is open to the air at its mouth,
/// and the remaining force of the air on it is applied in its neighbourhood. `surface` is surface_of(cells,
/// positions), the sheet of the loads. `team` shares the work; the load does not depend on it.
ClothLoad load_of_flow(const std::vector<SheetLoad>& loads, const FlowGrid& grid,
                       const std::vector<Triangle>& surface, const std::vector<Cell>& cells,
                       const std::vector<Vec3>& positions, Folds folds = Folds::few,
                       ThreadTeam* team = nullptr);

/// On every node, a quarter of the load of each cell that it is a corner of [N].
std::vector<Vec3> node_forces(const ClothLoad& load, const std::vector<Cell>& cells,
                              const std::vector<Vec3>& positions);

/// Root mean square of the traction over that of the pressure, over the cloth.
double residual_traction_share(const ClothLoad& load, const std::vector<Cell>& cells,
                               const std::vector<Vec3>& positions);

}  // namespace ripstop::inline fsi

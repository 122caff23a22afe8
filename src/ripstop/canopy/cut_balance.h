// The canopy cut in two across its axis: what cloth and lines carry through the cut must be what the air does
// to the part beyond it. Stress and load are computed apart, so that this checks the one by the other.
#pragma once

#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/mesh/mesh.h"

namespace ripstop {

/// Forces along z on the part at z < height by the part beyond it; moments about the axis x = y = 0.
struct CutBalance {
  double height = 0;       // z of the cut [m]
  double cloth_force = 0;  // of the stress in the cells that it cuts [N]
  double cord_force = 0;   // of lines, tapes and seams that cross it [N]
  double air_force = 0;    // of the load on the nodes beyond it [N]
  double moment = 0;       // of cloth and cords [N m]
  double air_moment = 0;   // [N m]
};

/// At equilibrium cloth_force + cord_force = air_force and moment = air_moment, up to the size of a cell.
/// `stress` is one a cell, `tensions` one a spring of the mesh, `load` the force on every node.
CutBalance cut_balance(const Mesh& mesh, const std::vector<Vec3>& positions,
                       const std::vector<CellStress>& stress, const std::vector<double>& tensions,
                       const std::vector<Vec3>& load, double height);

}  // namespace ripstop

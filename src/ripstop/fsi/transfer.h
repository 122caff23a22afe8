// Between cloth and flow: the surface that cuts the grid, and the pressure that the flow puts on the cloth.
#pragma once

#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/flow/flow.h"
#include "ripstop/mesh/mesh.h"

namespace ripstop::inline fsi {

/// Two triangles for every cell with cloth.
std::vector<Triangle> surface_of(const std::vector<Cell>& cells, const std::vector<Vec3>& positions);

/// Pressure on both sides of every cell of cloth, over the outlet's pressure [Pa]; 0 where there is no cloth.
struct SidePressures {
  std::vector<double> inside, outside;

  std::vector<double> difference() const;
};

/// Reads the pressure one cell's thickness off the cloth on either side, from cells that no cloth
/// cuts: within the cut cells the pressure is on its way from one side to the other. Cloth
/// outside the grid gets zero.
SidePressures sample_sides(const FlowField& field, const std::vector<int>& porous_cells,
                           const std::vector<Cell>& cells, const std::vector<Vec3>& positions);

/// Sum of pressure difference times area vector over the cells [N].
Vec3 pressure_force(const std::vector<Cell>& cells, const std::vector<Vec3>& positions,
                    const std::vector<double>& difference);

}  // namespace ripstop::inline fsi

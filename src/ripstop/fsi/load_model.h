// From the flow about the canopy to the load on its cloth, in one of three models.
#pragma once

#include <vector>

#include "ripstop/flow/flow.h"
#include "ripstop/fsi/coupling_settings.h"
#include "ripstop/fsi/sheet_transfer.h"
#include "ripstop/fsi/steady_iteration.h"
#include "ripstop/fsi/transfer.h"

namespace ripstop::inline fsi {

/// The canopy as the flow sees it.
struct CanopySurface {
  const std::vector<Cell>& cells;
  const std::vector<Vec3>& shape;  // positions of the nodes [m]
  std::vector<Triangle> triangles;
  std::vector<int> cut_cells;  // of the flow

  CanopySurface(const std::vector<Cell>& cells, const std::vector<Vec3>& shape, const FlowGrid& grid);
};

/// The load of the flow whose axial force is now.fluid_force. `sides` are the pressures at the cloth, see
/// sides_of_cloth(). Enters transfer_factor and residual_traction into `now`. Throws Error(diverged) where sampled
/// pressures cannot be scaled to the force of the flow.
ClothLoad load_on_cloth(CanopyLoad model, const FlowField& field, const CanopySurface& canopy,
                        const SidePressures& sides, SteadyIteration& now);

/// A porous sheet has undisturbed pressures on both sides up to the cloth; otherwise cells that the cloth cuts are left
/// out.
SidePressures sides_of_cloth(const FlowField& field, const CanopySurface& canopy, bool sheet);

}  // namespace ripstop::inline fsi

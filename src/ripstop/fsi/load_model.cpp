#include "ripstop/fsi/load_model.h"

#include <fmt/format.h>

#include <cmath>

#include "ripstop/core/error.h"

namespace ripstop::inline fsi {
namespace {

double axial_force(const CanopySurface& canopy, const std::vector<double>& pressure) {
  return pressure_force(canopy.cells, canopy.shape, pressure).z;
}

}  // namespace

CanopySurface::CanopySurface(const std::vector<Cell>& all, const std::vector<Vec3>& x, const FlowGrid& grid)
    : cells(all), shape(x), triangles(surface_of(all, x)), cut_cells(ripstop::cut_cells(grid, triangles)) {}

SidePressures sides_of_cloth(const FlowField& field, const CanopySurface& canopy, bool sheet) {
  return sample_sides(field, sheet ? std::vector<int>{} : canopy.cut_cells, canopy.cells, canopy.shape);
}

ClothLoad load_on_cloth(CanopyLoad model, const FlowField& field, const CanopySurface& canopy,
                        const SidePressures& sides, SteadyIteration& now) {
  ClothLoad load{sides.difference(), {}};
  if (model == CanopyLoad::of_flow)
    load = load_of_flow(loads_on(0, field.sheet_loads), field.grid, canopy.triangles, canopy.cells,
                        canopy.shape);
  now.transfer_factor = now.fluid_force / axial_force(canopy, load.pressure);
  now.residual_traction = residual_traction_share(load, canopy.cells, canopy.shape);
  if (model == CanopyLoad::uniform) {
    const std::vector<double> one(canopy.cells.size(), 1.0);
    load.pressure.assign(canopy.cells.size(), now.fluid_force / axial_force(canopy, one));
  }
  if (model != CanopyLoad::sampled) return load;
  // The flow's force on the cut cells also contains the resistance along the cloth, and the stepped cells differ from
  // the cloth: the sum of sampled differences is not equal to it. They are scaled by one factor, which is reported.
  if (!(now.transfer_factor > 0) || !std::isfinite(now.transfer_factor)) {
    throw Error(
        ExitCode::diverged,
        fmt::format(
            "coupling iteration {}: the pressures at the cloth give a force of {:.3g} N against the flow, "
            "but the air load is {:.3g} N; the grid is too coarse for this canopy, or the flow is wrong",
            now.iteration, now.fluid_force / now.transfer_factor, now.fluid_force));
  }
  for (double& dp : load.pressure) dp *= now.transfer_factor;
  return load;
}

}  // namespace ripstop::inline fsi

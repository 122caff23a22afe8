#include "ripstop/flow/cartesian/discretisation.h"

namespace ripstop::inline flow::cartesian {

Discretisation::Discretisation(const FlowGrid& grid_, const Freestream& air_,
                               const CartesianSettings& settings_, End side, bool open, bool quarter_)
    : grid(grid_),
      air(air_),
      settings(settings_),
      quarter(quarter_),
      x(make_axis(grid.edges(0), End::zero_gradient, End::zero_gradient)),
      y(make_axis(grid.edges(1), End::zero_gradient, End::zero_gradient)),
      z(make_axis(grid.edges(2), open ? End::zero_gradient : End::fixed_value, End::zero_gradient)),
      xp(make_axis(grid.edges(0), quarter ? End::zero_gradient : side, side)),
      yp(make_axis(grid.edges(1), quarter ? End::zero_gradient : side, side)),
      zp(make_axis(grid.edges(2), open ? End::fixed_value : End::zero_gradient, End::fixed_value)),
      layout(grid.nx, grid.ny, grid.nz) {
  // Beyond a side with fixed pressure the pressure has a ghost, a whole cell away; the correction, which is zero in
  // the face in the multigrid, has its own conductances there.
  for (Axis* axis : {&xp, &yp}) axis->inverse_distance.front() *= 0.5, axis->inverse_distance.back() *= 0.5;
  if (open) zp.inverse_distance.front() *= 0.5;
  // Across a plane of symmetry the mirrored cell is a neighbour like any other; no mass passes, whatever the pressure.
  if (!quarter) return;
  for (Axis* axis : {&x, &y}) axis->inverse_distance.front() = axis->inverse_width.front();
}

RowMetrics Discretisation::metrics(int j, int k, const Axis& along_x, const Axis& along_y,
                                   const Axis& along_z) const {
  RowMetrics m;
  m.n = grid.nx;
  m.sy = layout.stride_y;
  m.sz = layout.stride_z;
  m.x_width = along_x.width.data();
  m.x_inverse_width = along_x.inverse_width.data();
  m.x_weight_low = along_x.weight_low.data();
  m.x_inverse_distance = along_x.inverse_distance.data();
  m.x_slope_low = along_x.slope_low.data();
  m.x_slope_high = along_x.slope_high.data();
  m.y = cross_metrics(along_y, j);
  m.z = cross_metrics(along_z, k);
  return m;
}

}  // namespace ripstop::inline flow::cartesian

// The box as the solver sees it: axes, metrics of rows, layout of the fields, air and numerics.
#pragma once

#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/cartesian/grid.h"
#include "ripstop/flow/cartesian/rows.h"

namespace ripstop::inline flow::cartesian {

constexpr double heat_capacity = 1007;  // c_p of air [J/(kg K)]

struct Discretisation {
  /// `side` is the condition of the pressure at the sides; `open`: at all six faces, and none has given
  /// velocities; `quarter`: the low sides are planes of symmetry.
  Discretisation(const FlowGrid& grid, const Freestream& air, const CartesianSettings& settings, End side,
                 bool open = false, bool quarter = false);

  /// Of row (j, k) for convected quantities, and for the pressure.
  RowMetrics metrics(int j, int k) const { return metrics(j, k, x, y, z); }
  RowMetrics pressure_metrics(int j, int k) const { return metrics(j, k, xp, yp, zp); }

  FlowGrid grid;
  Freestream air;
  CartesianSettings settings;
  bool quarter;     // the planes x = 0 and y = 0 mirror the flow (quarter.h)
  Axis x, y, z;     // for transport: fixed at the inlet, if there is one
  Axis xp, yp, zp;  // for the pressure: fixed at the outlet, the sides as given; see the constructor
  Layout layout;

 private:
  RowMetrics metrics(int j, int k, const Axis& along_x, const Axis& along_y, const Axis& along_z) const;
};

}  // namespace ripstop::inline flow::cartesian

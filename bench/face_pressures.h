// Mean pressure coefficients on the two sides of a body.
#pragma once

#include <cmath>

#include "ripstop/flow/flow.h"

namespace ripstop {

struct FacePressures {
  double front = 0, back = 0;  // weighted with the area across the flow
};

/// Over the faces across z that a body parts: of the cells before and behind them.
inline FacePressures face_pressures(const FlowField& field, int body, double dynamic_pressure) {
  const FlowGrid& grid = field.grid;
  FacePressures mean;
  double area = 0;
  for (const SheetLoad& load : field.sheet_loads) {
    if (load.body != body || load.force.z == 0) continue;
    int k = grid.cell_at(2, load.point.z);
    if (grid.centre(2, k) > load.point.z) --k;
    const int i = grid.cell_at(0, load.point.x), j = grid.cell_at(1, load.point.y);
    const double share = std::abs(load.force.z / load.drop);
    area += share;
    mean.front += share * field.pressure[grid.index(i, j, k)];
    mean.back += share * field.pressure[grid.index(i, j, k + 1)];
  }
  return {mean.front / (area * dynamic_pressure), mean.back / (area * dynamic_pressure)};
}

}  // namespace ripstop

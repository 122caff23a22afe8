// Loads of the faces for a given drop of pressure over the cloth, without the flow.
#pragma once

#include <functional>
#include <vector>

#include "ripstop/flow/cartesian/sheet_faces.h"
#include "ripstop/flow/flow.h"
#include "ripstop/fsi/transfer.h"

namespace ripstop {

inline FlowGrid box(int n) {
  return {{-0.803, -0.797, 0.3}, {1.6, 1.6, 1.6}, n, n, n};
}

using Field = std::function<double(Vec3)>;

/// Face loads of a flow whose pressure drops by `drop` at the cloth.
inline std::vector<SheetLoad> loads_of(const std::vector<Triangle>& triangles, const FlowGrid& grid,
                                       const Field& drop) {
  using cartesian::End;
  const auto axis = [&](int a) {
    return cartesian::make_axis(grid.edges(a), End::zero_gradient, End::zero_gradient);
  };
  std::vector<SheetLoad> loads;
  for (const cartesian::SheetFace& f : cartesian::sheet_faces(axis(0), axis(1), axis(2), triangles)) {
    const double h = grid.spacing().x, side = f.against ? -1 : 1;
    const double slant = f.axis == 0 ? f.normal.x : f.axis == 1 ? f.normal.y : f.normal.z;
    SheetLoad load;
    load.triangle = f.triangle;
    load.point = f.point;
    load.outward = f.outward;
    load.cover = f.cover;
    load.area = load.cover * h * h * slant;
    load.drop = load.cover * drop(f.point);
    const double force = side * load.drop * h * h;
    load.force = {f.axis == 0 ? force : 0, f.axis == 1 ? force : 0, f.axis == 2 ? force : 0};
    loads.push_back(load);
  }
  return loads;
}

}  // namespace ripstop

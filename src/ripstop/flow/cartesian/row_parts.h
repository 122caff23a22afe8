// Parts of the row kernels: gradients in a cell, and values on its six faces.
//
// Always inlined, so that they are compiled for the level of the kernel that calls them, see simd.h. Their results
// are kept in variables that are neither const nor copied: others are stored in memory by g++ 12, which prevents
// vectorisation of the loop. A kernel has its row as a copy, so that the compiler sees that the loop does not change
// it.
#pragma once

#include "ripstop/flow/cartesian/loops.h"
#include "ripstop/flow/cartesian/rows.h"
#include "ripstop/flow/cartesian/simd.h"

namespace ripstop::inline flow::cartesian {

struct Gradient {
  double x, y, z;
};

/// One value on each face of a cell: west, east, south, north, below, above.
struct Faces {
  double w, e, s, n, b, a;
};

[[gnu::always_inline]] inline double sum(const Faces& f) {
  return f.w + f.e + f.s + f.n + f.b + f.a;
}

/// Of q at cell i, [q]/m.
template <class Number>
[[gnu::always_inline]] inline Gradient gradient(const RowMetrics& m, const Number* q, std::ptrdiff_t i) {
  const auto at = [&](std::ptrdiff_t step) { return static_cast<double>(q[i + step]); };
  const double here = at(0);
  return {m.x_slope_high[i] * (at(1) - here) + m.x_slope_low[i] * (here - at(-1)),
          m.y.slope_high * (at(m.sy) - here) + m.y.slope_low * (here - at(-m.sy)),
          m.z.slope_high * (at(m.sz) - here) + m.z.slope_low * (here - at(-m.sz))};
}

/// Adds the contribution of the jumps at the faces of cell i to the gradient of a quantity.
[[gnu::always_inline]] inline void add_jumps(const RowMetrics& m, const FaceView& jump, std::ptrdiff_t i,
                                             Gradient& g) {
  g.x += m.x_slope_high[i] * jump.x[i + 1] + m.x_slope_low[i] * jump.x[i];
  g.y += m.y.slope_high * jump.y_high[i] + m.y.slope_low * jump.y[i];
  g.z += m.z.slope_high * jump.z_high[i] + m.z.slope_low * jump.z[i];
}

/// q interpolated to the faces of cell i; the neighbours along z have rows of their own.
[[gnu::always_inline]] inline Faces on_faces(const RowMetrics& m, const Column& q, std::ptrdiff_t i) {
  const double *w = m.x_weight_low + i, *c = q.here + i;
  return {w[0] * c[-1] + (1 - w[0]) * c[0],
          w[1] * c[0] + (1 - w[1]) * c[1],
          m.y.weight_low * c[-m.sy] + (1 - m.y.weight_low) * c[0],
          m.y.weight_high * c[0] + (1 - m.y.weight_high) * c[m.sy],
          m.z.weight_low * q.below[i] + (1 - m.z.weight_low) * c[0],
          m.z.weight_high * c[0] + (1 - m.z.weight_high) * q.above[i]};
}

/// Mass that flows into cell i through its faces, 0 where it flows out [kg/(m2 s)].
[[gnu::always_inline]] inline Faces inflow(const RowMetrics& m, const VectorView<const double>& flux,
                                           std::ptrdiff_t i) {
  return {positive(flux.x[i]),         positive(-flux.x[i + 1]), positive(flux.y[i]),
          positive(-flux.y[i + m.sy]), positive(flux.z[i]),      positive(-flux.z[i + m.sz])};
}

/// sum a q_nb over the neighbours of cell i.
[[gnu::always_inline]] inline double from_neighbours(const Faces& a, const Stencil& q, std::ptrdiff_t i) {
  return a.w * q.here[i - 1] + a.e * q.here[i + 1] + a.s * q.south[i] + a.n * q.north[i] + a.b * q.below[i] +
         a.a * q.above[i];
}

}  // namespace ripstop::inline flow::cartesian

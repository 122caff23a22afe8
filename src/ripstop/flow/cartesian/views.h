// Views of fields: the rows of cells that a kernel reads and writes.
//
// Pointers are to cell 0 of a row; q[i - 1], q[i + 1] are the neighbours along x, q[i - sy], q[i + sy] along y,
// q[i - sz], q[i + sz] along z. A view has pointers of its own where a neighbouring row may lie elsewhere: in a ring
// of planes, in a row of boundary values, or among the new values. A view is a few pointers, owns nothing and is made
// anew for each row.
#pragma once

#include <cstddef>

#include "ripstop/flow/cartesian/memory.h"

namespace ripstop::inline flow::cartesian {

/// Three quantities along a row: a vector in its cells, or the fluxes through the low faces across x, y and z.
template <class Number>
struct VectorView {
  Number *x = nullptr, *y = nullptr, *z = nullptr;

  VectorView() = default;
  VectorView(Number* x_, Number* y_, Number* z_) : x(x_), y(y_), z(z_) {}
  operator VectorView<const Number>() const { return {x, y, z}; }
};
inline VectorView<double> row_of(Array<double>& x, Array<double>& y, Array<double>& z, std::ptrdiff_t at) {
  return {&x[at], &y[at], &z[at]};
}
inline VectorView<const double> row_of(const Array<double>& x, const Array<double>& y, const Array<double>& z,
                                       std::ptrdiff_t at) {
  return {&x[at], &y[at], &z[at]};
}

/// A quantity in a row and in those of the planes below it (towards the inlet) and above it.
struct Column {
  const double *here = nullptr, *below = nullptr, *above = nullptr;
};

/// A quantity in a row and in the four rows around it.
struct Stencil {
  const double *here = nullptr, *south = nullptr, *north = nullptr, *below = nullptr, *above = nullptr;
};
/// Of a field, all rows in their places.
inline Stencil stencil(const double* here, std::ptrdiff_t sy, std::ptrdiff_t sz) {
  return {here, here - sy, here + sy, here - sz, here + sz};
}

/// The same of three components.
struct VectorStencil {
  Stencil x, y, z;
};

/// A quantity on the faces of a row's cells: the n + 1 across x, and the low and high ones across y and z.
struct FaceView {
  const double *x = nullptr, *y = nullptr, *y_high = nullptr, *z = nullptr, *z_high = nullptr;
  explicit operator bool() const { return x != nullptr; }
};

/// A sheet on the faces of a row: the pressure jump of the last iteration, by how much the law differs from it [Pa],
/// and the law's slope over the velocity [Pa s/m]. Empty where no sheet passes.
struct SheetView {
  FaceView held, excess, stiffness;
};

/// Resistance of porous cells, R = linear + rho |U| quadratic [kg/(m3 s)]: mu d and f / 2.
struct ResistanceView {
  const double *linear = nullptr, *quadratic = nullptr;
};

/// The momentum equation solved for the velocity: H/A [m/s], 1/A and 1/(A - sum a_nb) [m3 s/kg].
template <class Number>
struct MatrixView {
  VectorView<Number> h;
  Number *ra = nullptr, *rc = nullptr;

  operator MatrixView<const Number>() const { return {h, ra, rc}; }
};

/// Stress through the faces across x, y and z: three components each, `component` values apart [Pa].
template <class Number>
struct StressView {
  Number *x = nullptr, *y = nullptr, *z = nullptr;
  std::ptrdiff_t component = 0;

  operator StressView<const Number>() const { return {x, y, z, component}; }
};

}  // namespace ripstop::inline flow::cartesian

// The row kernels of a step in time (time_step.cpp): views as in rows.h.
#pragma once

#include <cstddef>

#include "ripstop/flow/cartesian/rows.h"

namespace ripstop::inline flow::cartesian {

/// Viscosity of unresolved eddies from the velocity gradient, and the part of the stress whose normal
/// derivative is not that of the component itself.
struct EddyRow {
  RowMetrics m;
  double viscosity = 0;           // mu of the air [Pa s]
  double density = 0;             // [kg/m3]
  const double* along = nullptr;  // part of the mixing length squared that changes along the row [m^(2/3)]
  double across = 0;              // and the rest of it [m^(4/3)]
  VectorView<const double> velocity;
  // Results.
  double* mu = nullptr;       // mu + mu_t [Pa s]
  StressView<double> stress;  // mu du_a/dx_c of the axes a, three components c each
};
void eddy_row(const EddyRow& row);

/// How a row of faces across one axis interpolates; along the row either one number or one a face.
struct FaceWeights {
  double low = 0;                        // weight of the cell below the face
  double ratio_low = 0, ratio_high = 0;  // of distances, see Axis; 0 where there is no second cell
  double inverse_distance = 0;           // [1/m]
};

/// Momentum that passes the low faces of a row along one axis, by convection and stress [Pa].
struct PassingRow {
  int count = 0;
  std::ptrdiff_t step = 0;                   // from the cell below a face to the one above it
  std::ptrdiff_t far_low = 0, far_high = 0;  // from the cell above the face to the second ones on either side
  const double* flux = nullptr;              // through the faces [kg/(m2 s)]
  VectorView<const double> velocity;
  const double *mu = nullptr, *mu_low = nullptr;          // of the cells above and below the faces
  const double *stress = nullptr, *stress_low = nullptr;  // three components each
  std::ptrdiff_t component = 0;                           // values from a component to the next
  FaceWeights across;                                     // the same for all faces; or, along x,
  const Axis* along = nullptr;                            // one a face, with upwind values in its ends
  VectorView<double> passing;                             // results
};
void passing_row(const PassingRow& row);
/// Through faces in the boundary: the flux of the air from its upstream side.
void boundary_passing_row(const PassingRow& row);
/// And the stress along the normal in a side, 2 mu du_n/dn by the ghosts: `velocity` and `passing` are those of
/// the axis across it, `mu` of the cells inside.
void side_stress_row(const PassingRow& row, const double* velocity, const double* mu, double inverse_width,
                     double* passing);

/// From the momentum that passes the faces of a row's cells to their velocity before the pressure acts.
struct RateRow {
  RowMetrics m;
  FaceView u, v, w;                // of each component, the momentum that passes the faces [Pa]
  VectorView<const double> force;  // on the air [N/m3]
  VectorView<const double> velocity;
  const double* rho = nullptr;
  ResistanceView resistance;
  double inverse_step = 0;     // [1/s]
  double now = 1, before = 0;  // weights of this rate and of the last one
  VectorView<double> rate;     // the last one, then this one [N/m3]
  MatrixView<double> matrix;
  bool uniform = false;  // no porous cells, one density: ra and rc are there already, the same in all cells
};
void rate_row(const RateRow& row);

/// Of the cells of a row: the largest sum over the axes of |flux| / width [kg/(m3 s)], and the sum of the mass that
/// stays in a cell or leaves it, times the cell width [kg/(m2 s)].
struct CourantSums {
  double largest = 0, defect = 0;
};
CourantSums courant_row(const RowMetrics& m, VectorView<const double> flux);

}  // namespace ripstop::inline flow::cartesian

// The row kernels of a step in time (time_step.cpp): pointers as in rows.h.
#pragma once

#include <cstddef>

#include "ripstop/flow/cartesian/rows.h"

namespace ripstop::cartesian {

/// Viscosity of unresolved eddies from the velocity gradient, and the part of the stress whose normal
/// derivative is not that of the component itself.
struct EddyRow {
  RowMetrics m;
  double viscosity = 0;           // mu of the air [Pa s]
  double density = 0;             // [kg/m3]
  const double* along = nullptr;  // part of the mixing length squared that changes along the row [m^(2/3)]
  double across = 0;              // and the rest of it [m^(4/3)]
  const double *u = nullptr, *v = nullptr, *w = nullptr;
  // Results.
  double* mu = nullptr;                                // mu + mu_t [Pa s]
  double *tx = nullptr, *ty = nullptr, *tz = nullptr;  // mu du_a/dx_c of the axes a, three components c each
  std::ptrdiff_t component = 0;                        // values from a component to the next
};
void eddy_row(EddyRow& row);

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
  const double *u = nullptr, *v = nullptr, *w = nullptr;
  const double *mu = nullptr, *mu_low = nullptr;       // of the cells above and below the faces
  const double *t = nullptr, *t_low = nullptr;         // three components each
  std::ptrdiff_t component = 0;                        // values from a component to the next
  FaceWeights across;                                  // the same for all faces; or, along x,
  const Axis* along = nullptr;                         // one a face, with upwind values in its ends
  double *pu = nullptr, *pv = nullptr, *pw = nullptr;  // results
};
void passing_row(PassingRow& row);
/// Through faces in the boundary: the flux of the air from its upstream side.
void boundary_passing_row(const PassingRow& row);
/// And the stress along the normal in a side, 2 mu du_n/dn by the ghosts: `velocity` and `passing` are those of
/// the axis across it, `mu` of the cells inside.
void side_stress_row(const PassingRow& row, const double* velocity, const double* mu, double inverse_width,
                     double* passing);

/// From the momentum that passes the faces of a row's cells to their velocity before the pressure acts.
struct RateRow {
  RowMetrics m;
  const double *xu = nullptr, *xv = nullptr, *xw = nullptr;  // n + 1 faces
  const double *yu = nullptr, *yv = nullptr, *yw = nullptr, *yu_high = nullptr, *yv_high = nullptr,
               *yw_high = nullptr;
  const double *zu = nullptr, *zv = nullptr, *zw = nullptr, *zu_high = nullptr, *zv_high = nullptr,
               *zw_high = nullptr;
  const double *body_u = nullptr, *body_v = nullptr, *body_w = nullptr;  // [N/m3]
  const double *u = nullptr, *v = nullptr, *w = nullptr, *rho = nullptr;
  const double *linear = nullptr, *quadratic = nullptr;            // of porous cells, see MomentumRow
  double inverse_step = 0;                                         // [1/s]
  double now = 1, before = 0;                                      // weights of this rate and of the last one
  double *rate_u = nullptr, *rate_v = nullptr, *rate_w = nullptr;  // the last ones, then these [N/m3]
  double *hu = nullptr, *hv = nullptr, *hw = nullptr;              // [m/s]
  double *ra = nullptr, *rc = nullptr;                             // [m3 s/kg]
  bool uniform = false;  // no porous cells, one density: ra and rc are there already, the same in all cells
};
void rate_row(RateRow& row);

/// Of the cells of a row: the largest sum over the axes of |flux| / width, and the sum of the mass that stays
/// in a cell or leaves it.
struct CourantRow {
  RowMetrics m;
  const double *fx = nullptr, *fy = nullptr, *fz = nullptr;
  double largest = 0;  // [kg/(m3 s)]
  double defect = 0;   // times the cell width [kg/(m2 s)]
};
void courant_row(CourantRow& row);

}  // namespace ripstop::cartesian

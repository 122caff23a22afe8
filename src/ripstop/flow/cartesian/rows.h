// The row kernels: each works on one row of cells along x and touches nothing but the rows it is given.
//
// Pointers are to cell 0 of the row; q[i - 1], q[i + 1] are the neighbours along x, q[i - sy], q[i + sy]
// along y, q[i - sz], q[i + sz] along z. Where the neighbour plane lies elsewhere (a ring of planes, a
// boundary value), it has a pointer of its own, `below` (towards the inlet) or `above`. Mass fluxes are per
// area, rho u [kg/(m2 s)], positive along the axis, kept at the low face of a cell.
#pragma once

#include <cstddef>

#include "ripstop/flow/cartesian/grid.h"

namespace ripstop::cartesian {

/// Metrics of an axis across the row: those of cell c, as plain numbers.
struct CrossMetrics {
  double inverse_width = 0;
  double weight_low = 0, weight_high = 0;      // of the lower value on the low and on the high face
  double distance_low = 0, distance_high = 0;  // inverse distances over the low and the high face [1/m]
  double slope_low = 0, slope_high = 0;
};
CrossMetrics cross_metrics(const Axis& axis, int c);

/// Grid data of every kernel.
struct RowMetrics {
  int n = 0;
  std::ptrdiff_t sy = 0, sz = 0;
  const double *x_width = nullptr, *x_inverse_width = nullptr, *x_weight_low = nullptr,
               *x_inverse_distance = nullptr, *x_slope_low = nullptr, *x_slope_high = nullptr;
  CrossMetrics y, z;
};

/// A sum of |residual| and the factor that OpenFOAM divides it by (lduMatrix::solver::normFactor).
struct ResidualSum {
  double residual = 0, scale = 0;
};

struct TurbulenceRow {
  RowMetrics m;
  double viscosity = 0;   // mu [Pa s]
  double relaxation = 0;  // of k and omega
  // In time, else 0: one over the step [1/s], and over the largest width of the cells along y and z [1/m].
  double inverse_step = 0, inverse_across = 0;
  double mean_k = 0, mean_omega = 0;
  const double *u = nullptr, *v = nullptr, *w = nullptr;
  const double *k = nullptr, *omega = nullptr, *rho = nullptr;
  const double *k_below = nullptr, *k_above = nullptr;          // for convection and diffusion
  const double *omega_below = nullptr, *omega_above = nullptr;  // across the z faces
  const double *k_south = nullptr, *k_north = nullptr, *omega_south = nullptr,
               *omega_north = nullptr;  // and y
  const double *fx = nullptr, *fy = nullptr, *fz = nullptr;
  const double *mut = nullptr, *mut_below = nullptr, *mut_above = nullptr;  // eddy viscosity [Pa s]
  const double* wall = nullptr;  // distance to the cloth [m]; null: no wall anywhere
  double* limit_new = nullptr;   // factor of the eddy viscosity; with a wall only
  // Results.
  double *k_new = nullptr, *omega_new = nullptr;
  double* mu_new = nullptr;                            // mu + mu_t [Pa s]
  double *tx = nullptr, *ty = nullptr, *tz = nullptr;  // three components each, see below
  std::ptrdiff_t component = 0;                        // values from a component to the next
  ResidualSum k_sum, omega_sum;
  double total_k = 0, total_omega = 0;  // of the new values, times the cell width
};
void turbulence_row(TurbulenceRow& row);
/// k without the eddies that cells of these widths resolve
void unresolved_row(int n, const double* width, double across, const double* omega, double* k);
/// mut *= limit, that of the shear-stress limiter
void limit_row(int n, const double* limit, double* mut);
/// mut = rho k / omega
void eddy_viscosity_row(int n, const double* rho, const double* k, const double* omega, double* mut);

/// Pressure jumps of a sheet on the faces of a row: x has n + 1 of them.
struct SheetJumps {
  const double *x = nullptr, *y = nullptr, *y_high = nullptr, *z = nullptr, *z_high = nullptr;
  explicit operator bool() const { return x != nullptr; }
};

/// One axis of the faces of cell c, for the limited correction of the upwind face value.
struct FaceMetrics {
  double inverse_width = 0, weight_low = 0, weight_high = 0;  // as CrossMetrics
  double low_low = 0, low_high = 0;    // ratios of distances at the low face, 0 at an end of the axis
  double high_low = 0, high_high = 0;  // and at the high face
};
FaceMetrics face_metrics(const Axis& axis, int c);

struct ConvectionRow {
  int n = 0;
  const Axis* x = nullptr;
  FaceMetrics y, z;
  std::ptrdiff_t sy = 0, sz = 0;
  std::ptrdiff_t south2 = 0, north2 = 0, below2 = 0, above2 = 0;  // to the second neighbours, 0 where none is
  const double *fx = nullptr, *fy = nullptr, *fz = nullptr;
  const double* q = nullptr;
  double* source = nullptr;  // second-order part of the right-hand side
};
void convection_row(const ConvectionRow& row);

struct MomentumRow {
  RowMetrics m;
  double relaxation = 0;        // in the face flux
  double march_relaxation = 0;  // of the step itself
  double mean_u = 0, mean_v = 0, mean_w = 0;
  const double *u = nullptr, *v = nullptr, *w = nullptr, *p = nullptr, *rho = nullptr;
  const double *u_below = nullptr, *v_below = nullptr, *w_below = nullptr;
  const double *u_above = nullptr, *v_above = nullptr, *w_above = nullptr;
  const double *u_south = nullptr, *v_south = nullptr, *w_south = nullptr;
  const double *u_north = nullptr, *v_north = nullptr, *w_north = nullptr;
  const double *fx = nullptr, *fy = nullptr, *fz = nullptr;
  const double *mu = nullptr, *mu_below = nullptr, *mu_above = nullptr;
  const double *tx = nullptr, *ty = nullptr, *tz = nullptr, *tz_below = nullptr, *tz_above = nullptr;
  std::ptrdiff_t component = 0;
  const double* linear = nullptr;                                           // mu d [kg/(m3 s)]
  const double* quadratic = nullptr;                                        // f / 2 [1/m]
  const double *extra_u = nullptr, *extra_v = nullptr, *extra_w = nullptr;  // of ConvectionRow
  SheetJumps sheet, stiffness;
  double inertia = 0;  // rho U; over the least width, least A next to a sheet [kg/(m2 s)]
  // Results: H/A, 1/A and the predicted velocity.
  double *hu = nullptr, *hv = nullptr, *hw = nullptr, *ra = nullptr, *rc = nullptr;
  double *u_new = nullptr, *v_new = nullptr, *w_new = nullptr;
  ResidualSum u_sum, v_sum, w_sum;
};
void momentum_row(MomentumRow& row);

struct PressureRow {
  RowMetrics m;  // m.z is that of the pressure: fixed value at the outlet
  double y_width = 0, z_width = 0;
  const double *hu = nullptr, *hv = nullptr, *hw = nullptr;
  const double *ra = nullptr, *rc = nullptr, *rho = nullptr, *p = nullptr;
  bool uniform = false;  // ra, rc and rho are those of cell 0 in all cells
  const double *hw_above = nullptr, *rho_above = nullptr, *ra_above = nullptr, *rc_above = nullptr,
               *p_above = nullptr;
  bool inlet = false;                   // the low z face brings inlet_speed * rho
  const double* inlet_speed = nullptr;  // [m/s]; elsewhere zeros
  bool outlet = false;                  // the high z face has the pressure of the outlet
  double mean_p = 0;
  const double *fx = nullptr, *fy = nullptr, *fz = nullptr;  // of the last iteration; with sheets only
  SheetJumps held, excess, stiffness;
  float *cx = nullptr, *cy = nullptr, *cz = nullptr;  // conductances of the low faces [m s]
  float* cz_above = nullptr;                          // of the outlet's faces, where outlet is set
  float* rhs = nullptr;                               // minus the mass that the cell loses [kg/s]
  ResidualSum sum;
};
void pressure_row(PressureRow& row);

struct FluxRow {
  RowMetrics m;
  const double *hu = nullptr, *hv = nullptr, *hw = nullptr;
  const double *ra = nullptr, *rc = nullptr, *rho = nullptr, *p = nullptr;
  bool uniform = false;  // as above
  const float* dp = nullptr;
  const double* inlet_speed = nullptr;  // where the low z faces are the inlet's [m/s]; else null
  SheetJumps held, excess, stiffness;   // of the low faces
  double *change_x = nullptr, *change_y = nullptr, *change_z = nullptr;  // of the jumps; null: none
  double *fx = nullptr, *fy = nullptr, *fz = nullptr;                    // fx has n + 1 faces
};
/// Fluxes through the low faces of the row and through its last x face.
void flux_row(FluxRow& row);

struct OutletRow {
  int n = 0;
  double inverse_distance = 0;
  const double *hw = nullptr, *ra = nullptr, *rc = nullptr, *rho = nullptr, *p = nullptr;
  const double* outlet_p = nullptr;
  const float* dp = nullptr;
  double* fz = nullptr;  // at the outlet's faces
};
void outlet_flux_row(OutletRow& row);

struct VelocityRow {
  RowMetrics m;
  double gas_constant = 0;  // R [J/(kg K)]
  double pressure0 = 0;     // [Pa] absolute, at the outlet
  double temperature = 0;   // of the free stream [K]
  double speed2 = 0;        // of the free stream, squared
  double half_cp = 0;       // 1 / (2 c_p) [kg K/J]
  const double *ra = nullptr, *rc = nullptr, *p = nullptr;
  const float* dp = nullptr;
  SheetJumps held, change;  // jumps of the last pressure, and by how much they differ now
  double relaxation = 0;    // of the pressure
  const double *hu = nullptr, *hv = nullptr, *hw = nullptr;
  double *u = nullptr, *v = nullptr, *w = nullptr;
  double* rho = nullptr;                                      // null where it is constant
  double total_u = 0, total_v = 0, total_w = 0, total_p = 0;  // times the cell width
};
void velocity_row(VelocityRow& row);

}  // namespace ripstop::cartesian

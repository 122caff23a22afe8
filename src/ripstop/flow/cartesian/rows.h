// The row kernels: each works on one row of cells along x and touches nothing but the views it is given (views.h).
// Mass fluxes are per area, rho u [kg/(m2 s)], positive along the axis, kept at the low face of a cell.
#pragma once

#include <cstddef>

#include "ripstop/core/vec3.h"
#include "ripstop/flow/cartesian/grid.h"
#include "ripstop/flow/cartesian/views.h"

namespace ripstop::inline flow::cartesian {

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
  VectorView<const double> velocity;
  Stencil k, omega;
  const double* rho = nullptr;
  VectorView<const double> flux;
  Column mut;                    // eddy viscosity [Pa s]
  const double* wall = nullptr;  // distance to the cloth [m]; null: no wall anywhere
  // Results.
  double* limit_new = nullptr;  // factor of the eddy viscosity; with a wall only
  double *k_new = nullptr, *omega_new = nullptr;
  double* mu_new = nullptr;   // mu + mu_t [Pa s]
  StressView<double> stress;  // the explicit part of it
};
struct TurbulenceSums {
  ResidualSum k, omega;
  double total_k = 0, total_omega = 0;  // of the new values, times the cell width
};
TurbulenceSums turbulence_row(const TurbulenceRow& row);
/// k without the eddies that cells of these widths resolve
void unresolved_row(int n, const double* width, double across, const double* omega, double* k);
/// mut *= limit, that of the shear-stress limiter
void limit_row(int n, const double* limit, double* mut);
/// mut = rho k / omega
void eddy_viscosity_row(int n, const double* rho, const double* k, const double* omega, double* mut);

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
  VectorView<const double> flux;
  const double* q = nullptr;
  double* source = nullptr;  // second-order part of the right-hand side
};
void convection_row(const ConvectionRow& row);

struct MomentumRow {
  RowMetrics m;
  double relaxation = 0;        // in the face flux
  double march_relaxation = 0;  // of the step itself
  double inertia = 0;           // rho U; over the least width, least A next to a sheet [kg/(m2 s)]
  Vec3 mean;                    // velocity over the box
  VectorStencil velocity;
  const double *p = nullptr, *rho = nullptr;
  VectorView<const double> flux;
  Column mu;
  StressView<const double> stress;
  const double *stress_below = nullptr, *stress_above = nullptr;  // its part z in the planes below and above
  ResistanceView resistance;
  VectorView<const double> force;  // on the air, and that of ConvectionRow [N/m3]
  SheetView sheet;
  // Results.
  MatrixView<double> matrix;
  VectorView<double> predicted;  // velocity
};
struct MomentumSums {
  ResidualSum u, v, w;
};
MomentumSums momentum_row(const MomentumRow& row);

struct PressureRow {
  RowMetrics m;  // m.z is that of the pressure: fixed value at the outlet
  double y_width = 0, z_width = 0;
  MatrixView<const double> matrix;
  const double *rho = nullptr, *p = nullptr, *p_above = nullptr;
  bool uniform = false;                 // ra, rc and rho are those of cell 0 in all cells
  bool inlet = false;                   // the low z face brings inlet_speed * rho
  const double* inlet_speed = nullptr;  // [m/s]; elsewhere zeros
  bool outlet = false;                  // the high z face has the pressure of the outlet
  double mean_p = 0;
  VectorView<const double> flux;  // of the last iteration; with sheets only
  SheetView sheet;
  // Results.
  VectorView<float> conductance;  // of the low faces [m s], and of the outlet's where outlet is set
  float* rhs = nullptr;           // minus the mass that the cell loses [kg/s]
};
ResidualSum pressure_row(const PressureRow& row);

struct FluxRow {
  RowMetrics m;
  MatrixView<const double> matrix;
  const double *rho = nullptr, *p = nullptr;
  bool uniform = false;  // as above
  const float* dp = nullptr;
  const double* inlet_speed = nullptr;  // where the low z faces are the inlet's [m/s]; else null
  SheetView sheet;                      // of the low faces
  VectorView<double> change;            // of the jumps; null: none
  VectorView<double> flux;              // x has n + 1 faces
};
/// Fluxes through the low faces of the row and through its last x face.
void flux_row(const FluxRow& row);
/// And through its faces in the outlet, at this distance from the cells and with this pressure.
void outlet_flux_row(const FluxRow& row, double inverse_distance, const double* pressure);

/// Of a perfect gas at constant total enthalpy.
struct Gas {
  double constant = 0;     // R [J/(kg K)]
  double pressure = 0;     // [Pa] absolute, at the outlet
  double temperature = 0;  // of the free stream [K]
  double speed2 = 0;       // of the free stream, squared
  double half_cp = 0;      // 1 / (2 c_p) [kg K/J]
};

struct VelocityRow {
  RowMetrics m;
  Gas gas;
  MatrixView<const double> matrix;
  const double* p = nullptr;
  const float* dp = nullptr;
  FaceView held, change;  // jumps of the last pressure, and by how much they differ now
  double relaxation = 0;  // of the pressure
  // Results.
  VectorView<double> velocity;
  double* rho = nullptr;  // null where it is constant
};
/// Sums times the cell width.
struct VelocitySums {
  double u = 0, v = 0, w = 0, p = 0;
};
VelocitySums velocity_row(const VelocityRow& row);

}  // namespace ripstop::inline flow::cartesian

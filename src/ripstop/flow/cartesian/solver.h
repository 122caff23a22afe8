// One SIMPLE solver on one grid: the fields, and an iteration as three marches over the planes of the grid.
#pragma once

#include <string>
#include <vector>

#include "ripstop/core/thread_team.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/cartesian/grid.h"
#include "ripstop/flow/cartesian/multigrid.h"
#include "ripstop/flow/cartesian/porous.h"
#include "ripstop/flow/cartesian/rows.h"

namespace ripstop::cartesian {

constexpr double heat_capacity = 1007;              // c_p of air [J/(kg K)]
constexpr double gas_constant_of_air = 8314.46 / 28.9;  // R [J/(kg K)]

struct Fields {
  Array<double> u, v, w;     // [m/s]
  Array<double> p;           // over the outlet's [Pa]
  Array<double> rho;         // [kg/m3]
  Array<double> k, omega;    // [m2/s2], [1/s]
  Array<double> fx, fy, fz;  // mass flux per area through the low faces [kg/(m2 s)]
  Array<double> ra;          // 1 / (A + R) [m3 s/kg]
};

/// Sums over the grid that an iteration makes, row by row so that their order is fixed.
struct Sums {
  enum Name {
    u_residual, v_residual, w_residual, p_residual, k_residual, omega_residual,
    u_scale, v_scale, w_scale, p_scale, k_scale, omega_scale,
    u_mean, v_mean, w_mean, p_mean, k_mean, omega_mean,
    drag_x, drag_y, drag_z, imbalance, count
  };
  double value[count] = {};
};

class Solver {
 public:
  Solver(const FlowProblem& problem, const FlowGrid& grid, PorousRows porous, const CartesianSettings& settings,
         ThreadTeam& team);

  /// Uniform stream everywhere.
  void start_uniform();
  /// Fields interpolated from another solver's grid of the same box.
  void start_from(const Solver& other);
  /// One SIMPLE iteration; the residuals are those of the fields it started from.
  FlowProgress iterate();
  /// The first cell that is not finite or beyond reason, as "field u at (x, y, z)"; empty if none.
  std::string first_bad_value() const;

  FlowField field() const;
  const FlowGrid& grid() const { return grid_; }
  const Fields& fields() const { return f_; }
  Fields& fields() { return f_; }
  const Sums& sums() const { return total_; }
  Sums& sums() { return total_; }
  int iteration() const { return iteration_; }
  void set_iteration(int iteration) { iteration_ = iteration; }
  void fill_ghosts();

 private:
  // The march of momentum and turbulence, plane by plane towards the outlet (solver_march.cpp).
  void march(int rank);
  void eddy_viscosity(int k, Range rows);
  void turbulence(int k, Range rows);
  void commit_turbulence(int k, Range rows);
  void momentum(int k, Range rows);
  void commit_momentum(int k, Range rows);
  void pressure(int k, Range rows);
  // The march that corrects fluxes, pressure and velocity (solver_correct.cpp).
  void correct(int rank);
  void flux(int k, Range rows);
  void relax_pressure(int k, Range rows);
  void velocity(int k, Range rows);

  void add_up(int rank, int from, int to);
  RowMetrics metrics(int j, int k) const;
  Sums& row_sums(int j, int k) { return rows_[static_cast<std::size_t>(k) * grid_.ny + j]; }
  Vec3 porous_force_of_row(int j, int k) const;
  double momentum_deficit() const;

  FlowGrid grid_;
  Freestream air_;
  bool duct_ = false;
  CartesianSettings settings_;
  ThreadTeam& team_;
  PorousRows porous_;
  Axis x_, y_, z_, zp_;  // z_ for transport (fixed inlet), zp_ for the pressure (fixed outlet)
  Layout layout_;
  Fields f_;
  Multigrid multigrid_;
  double inlet_k_ = 0, inlet_omega_ = 0, gas_constant_ = 0, pressure0_ = 0;

  // Rings of planes: what the march passes from one stage to the next stays in cache.
  struct Rings {
    Array<double> mut[3], mu[4];
    Array<double> tx[2], ty[2], tz[3];  // three components each
    Array<double> k[2], omega[2];
    Array<double> h[2], predicted[2];  // three components each
    Array<double> zeros, inlet_w, inlet_k, inlet_omega;
  };
  Rings ring_;
  std::size_t plane_ = 0;  // values a plane
  std::vector<Sums> rows_;
  std::vector<Sums> planes_;
  Sums total_;
  int iteration_ = 0;
};

}  // namespace ripstop::cartesian

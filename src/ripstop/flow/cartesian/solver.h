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
#include "ripstop/flow/cartesian/sheet.h"

namespace ripstop::cartesian {

constexpr double heat_capacity = 1007;                     // c_p of air [J/(kg K)]
constexpr double gas_constant_of_air = 8314.47 / 28.9647;  // R [J/(kg K)]

struct Fields {
  Array<double> u, v, w;     // [m/s]
  Array<double> p;           // over the outlet's [Pa]
  Array<double> rho;         // [kg/m3]
  Array<double> k, omega;    // [m2/s2], [1/s]
  Array<double> fx, fy, fz;  // mass flux per area through the low faces [kg/(m2 s)]
};

/// Sums over the grid that an iteration makes, row by row so that their order is fixed.
struct Sums {
  enum Name {
    u_residual,
    v_residual,
    w_residual,
    p_residual,
    k_residual,
    omega_residual,
    u_scale,
    v_scale,
    w_scale,
    p_scale,
    k_scale,
    omega_scale,
    u_mean,
    v_mean,
    w_mean,
    p_mean,
    k_mean,
    omega_mean,
    drag_x,
    drag_y,
    drag_z,
    count
  };
  double value[count] = {};
};

/// Blocks of rows that an iteration cuts the grid into; the same for any number of threads.
int block_count(const FlowGrid& grid);

/// What the march passes from plane to plane of a block: rings of planes that hold the block's rows and two
/// more on each side.
struct MarchRings {
  explicit MarchRings(std::size_t plane);
  std::ptrdiff_t at(const Layout& layout, int j, int first_row) const {
    return Layout::lead + static_cast<std::ptrdiff_t>(j - first_row + 3) * layout.stride_y;
  }
  std::size_t plane = 0;
  Array<double> mut[3], mu[3];
  Array<double> tx[2], ty[2], tz[3], predicted[2];  // three components each
  Array<double> scratch;
};

class Solver {
 public:
  Solver(const FlowProblem& problem, const FlowGrid& grid, PorousRows porous,
         const CartesianSettings& settings, ThreadTeam& team);

  /// Uniform stream everywhere.
  void start_uniform();
  /// Fields interpolated from another solver's grid of the same box, and scaled from its air to this one's.
  void start_from(const Solver& other);
  /// One SIMPLE iteration; the residuals are those of the fields it started from.
  FlowProgress iterate();
  /// The first cell that is not finite or beyond reason, as "field u at (x, y, z)"; empty if none.
  std::string first_bad_value() const;

  FlowField field() const;
  const FlowGrid& grid() const { return grid_; }
  const Freestream& air() const { return air_; }
  Sides sides() const { return sides_; }
  bool shut() const { return sheets_.shut(); }
  const Fields& fields() const { return f_; }
  Fields& fields() { return f_; }
  const Sums& sums() const { return total_; }
  Sums& sums() { return total_; }
  void fill_ghosts();

 private:
  // Turbulence and momentum (solver_march.cpp); H/A, 1/A, new k and omega.
  void march(int rank, IndexRange rows);
  void eddy_viscosity(MarchRings& rings, int k, IndexRange rows) const;
  void turbulence(MarchRings& rings, int k, IndexRange rows);
  void momentum(MarchRings& rings, int k, IndexRange rows);
  void convection(int k, IndexRange rows);  // convection.cpp
  // The rest (solver_correct.cpp).
  void pressure(int k, IndexRange rows);
  void flux(int k, IndexRange rows);
  void velocity(int k, IndexRange rows);
  void relax_pressure(int k);
  void side_ghosts(Array<double>& field, int k, double across_x, double across_y) const;
  template <class Visit>
  void each_side_face(int k, Visit&& visit) const;
  void entrain(Array<double>& field, int k, int normal, double stream) const;
  void entraining_conductances(int j, int k);
  bool entraining() const { return sides_ == Sides::entraining; }
  void end_ghosts(Array<double>& field, int k, double inlet, double back) const;
  void march_ghosts(int k);
  void pressure_ghosts(int k);
  void correction_ghosts(int k);
  void velocity_ghosts(int k);

  void add_up(int rank, int from, int to);
  RowMetrics metrics(int j, int k) const { return metrics(j, k, x_, y_, z_); }
  RowMetrics pressure_metrics(int j, int k) const { return metrics(j, k, xp_, yp_, zp_); }
  RowMetrics metrics(int j, int k, const Axis& x, const Axis& y, const Axis& z) const;
  Sums& row_sums(int j, int k) { return rows_[static_cast<std::size_t>(k) * grid_.ny + j]; }
  Vec3 porous_force_of_row(int j, int k) const;
  SheetJumps jumps(int j, int k, const double* (SheetRows::*row)(int, int, int) const) const;
  double momentum_deficit() const;

  FlowGrid grid_;
  Freestream air_;
  Sides sides_ = Sides::zero_gradient;
  CartesianSettings settings_;
  ThreadTeam& team_;
  PorousRows porous_;
  Axis x_, y_, z_;     // for transport: fixed at the inlet
  Axis xp_, yp_, zp_;  // for the pressure: fixed at the outlet and at entraining sides, see the constructor
  SheetRows sheets_;
  Layout layout_;
  Fields f_;
  Multigrid multigrid_;
  double inlet_k_ = 0, inlet_omega_ = 0, gas_constant_ = 0, pressure0_ = 0;

  struct Constant {  // rows that stand for boundary values
    Array<double> zeros, inlet_w, inlet_k, inlet_omega;
  };
  Constant constant_;
  Array<double> hu_, hv_, hw_, ra_, rc_;  // H / (A + R) [m/s], 1 / (A + R) [m3 s/kg]
  Array<double> new_k_, new_omega_;
  Array<double> body_u_, body_v_, body_w_;     // force on the air [N/m3]; empty: none
  Array<double> extra_u_, extra_v_, extra_w_;  // the same and second-order convection; empty: upwind
  Array<double> wall_;                         // distance to the nearest sheet [m]; empty: no sheets
  Array<double> limit_, new_limit_;            // of the eddy viscosity
  Array<double> outlet_p_;                     // pressure at the outlet's faces, one plane [Pa]; empty: zero
  std::vector<MarchRings> rings_;              // one a thread
  std::vector<Sums> rows_;
  std::vector<Sums> planes_;
  Sums total_;
  int iteration_ = 0;
};

}  // namespace ripstop::cartesian

// One solver on one grid: a flow's state, and an iteration (simple.cpp) or a step in time (time_step.cpp) as
// named stages over the planes of the grid.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "ripstop/core/thread_team.h"
#include "ripstop/flow/cartesian/boundary.h"
#include "ripstop/flow/cartesian/discretisation.h"
#include "ripstop/flow/cartesian/multigrid.h"
#include "ripstop/flow/cartesian/porous.h"
#include "ripstop/flow/cartesian/sheet.h"
#include "ripstop/flow/cartesian/state.h"
#include "ripstop/flow/cartesian/sums.h"
#include "ripstop/flow/cartesian/time_rows.h"

namespace ripstop::inline flow::cartesian {

/// Bodies and forces in the flow.
struct Obstacles {
  PorousRows porous;
  SheetRows sheets;
  Array<double> wall;  // distance to the nearest sheet [m]; empty: no sheets, or not asked for yet
  Array<double> body_u, body_v, body_w;  // force on the air [N/m3]; empty: none
};

/// The last few planes of a quantity: that of plane k takes the place of plane k - `planes`.
template <int planes>
struct Ring {
  double* row(int k, std::ptrdiff_t in) { return &plane[(k + planes) % planes][in]; }
  std::array<Array<double>, planes> plane;
};

/// Data that the march passes from plane to plane of a block: rings of planes with the rows of the block and
/// two more on each side.
struct MarchRings {
  explicit MarchRings(std::size_t plane);
  std::ptrdiff_t at(const Layout& layout, int j, int first_row) const {
    return Layout::lead + static_cast<std::ptrdiff_t>(j - first_row + 3) * layout.stride_y;
  }
  StressView<double> stress(int k, std::ptrdiff_t in) {
    return {tx.row(k, in), ty.row(k, in), tz.row(k, in), component};
  }
  /// Velocity by the momentum equation; in time, the momentum that passes along the stream.
  VectorView<double> predicted(int k, std::ptrdiff_t in) {
    double* x = vector.row(k, in);
    return {x, x + component, x + 2 * component};
  }
  std::ptrdiff_t component = 0;  // values from a component to the next
  Ring<3> mut, mu;
  Ring<2> tx, ty, vector;  // three components each
  Ring<3> tz;
  Array<double> scratch;
};

/// Data of one iteration that the next one does not use.
struct Scratch {
  Scratch(const Discretisation& d, int threads);

  Array<double> zeros, density;      // rows; the latter in time, where there is one density
  Array<double> hu, hv, hw, ra, rc;  // H / (A + R) [m/s], 1 / (A + R) [m3 s/kg]
  MatrixView<double> matrix(std::ptrdiff_t at) { return {row_of(hu, hv, hw, at), &ra[at], &rc[at]}; }
  double all_inverse = 0;  // common value of all ra and rc; 0: each has its own
  Array<double> new_k, new_omega, new_limit;
  Array<double> extra_u, extra_v, extra_w;  // force on the air and second-order convection; empty: upwind
  std::vector<MarchRings> rings;            // one a thread
  bool in_time = false;                     // a step in time, not an iteration
  double now = 1, before = 0;               // weights of the rates of a step
  Array<double> pull_u, pull_v,
      pull_w;                   // rows: force on the air of a stream that changes [N/m3]; empty: none
  std::vector<double> mixing;   // of EddyRow::along
  std::vector<double> fastest;  // Courant rate, one a plane [kg/(m3 s)]
  SumTable sums;
};

class Solver {
 public:
  /// In the uniform stream. `porous` are the problem's porous cells on this grid.
  Solver(const FlowProblem& problem, const FlowGrid& grid, PorousRows porous,
         const CartesianSettings& settings, ThreadTeam& team);

  void start_uniform();
  /// Fields interpolated from a coarser grid of the same box, with the same air.
  void start_from(const Solver& coarse);
  /// Fields interpolated from other cells or boundaries, with the same air and the stream of their last step; on the
  /// same cells jumps, rates and time too.
  void continue_from(const Solver& other);
  /// The cloth has moved; the flow continues.
  void place(PorousRows porous, const std::vector<FlowBody>& bodies);
  /// One SIMPLE iteration; the residuals are those of the fields it started from.
  FlowProgress iterate();
  /// Preparation of the first step in time: memory for the rates, air of one density.
  void begin_time();
  /// The undisturbed stream at the end of the next step, where it changes [m/s], [m/s2].
  void stream(Vec3 velocity, Vec3 acceleration);
  /// The same, into the inlet.
  void let_stream_in();
  /// Step for a Courant number [s].
  double longest_step(double courant_number);
  /// The same, chosen such that steps remain equal [s].
  double next_step(double courant_number);
  /// One step in time [s].
  FlowStep step(double length);
  /// Whether every value is finite and within bounds that no flow of this air reaches.
  bool within_reason();
  /// The first cell that is not finite or beyond those bounds, as "field u at (x, y, z)"; empty if none.
  std::string first_bad_value() const;
  FlowField field() const;
  /// `loads`: FlowField::bodies.
  void add_to(FieldMean& mean, std::vector<BodyLoad> loads) const;
  /// Loads of the air on these cells; the moment is about a point.
  BodyLoad load_on(const PorousCells& porous, Vec3 about) const;
  std::vector<SheetLoad> sheet_loads() const { return in_the_way_.sheets.loads(s_, d_.layout); }

  const Discretisation& discretisation() const { return d_; }
  const FlowGrid& grid() const { return d_.grid; }
  /// Whether sheets leave next to nothing of the box's cross-section open.
  bool shut() const { return in_the_way_.sheets.shut(); }
  const State& state() const { return s_; }
  State& state() { return s_; }
  /// Whether all six faces are open to a stream of any direction.
  bool open() const { return b_.open(); }

 private:
  // One thread's walk over its planes, its blocks of rows, or the rows of its blocks plane by plane, in any order
  // otherwise; all threads meet after it.
  template <class Stage>
  void each_plane(int rank, const Stage& stage);
  template <class Stage>
  void each_block(int rank, const Stage& stage);
  template <class Kernel>
  void each_row(int rank, const Kernel& kernel);
  /// Steps in time where no cell is porous have one density and one 1/A.
  bool uniform() const { return t_.in_time && in_the_way_.porous.empty(); }
  const double* density_of_row(int j, int k) const {
    return t_.in_time ? &t_.density[Layout::lead] : &s_.f.rho[d_.layout.at(0, j, k)];
  }
  /// The share of a pressure correction that is taken.
  double pressure_share() const { return t_.in_time ? 1 : d_.settings.relax_pressure; }
  // Turbulence and momentum (stage_transport.cpp): H/A, 1/A, new k and omega.
  void convection(int j, int k);  // convection.cpp
  void march(int rank, IndexRange rows);
  void eddy_viscosity(MarchRings& rings, int k, IndexRange rows) const;
  void mirror_viscosity(double* row, int j) const;
  // A step in time (time_step.cpp).
  void rates(int rank, IndexRange rows);
  void eddies(MarchRings& rings, int k, IndexRange rows);
  void model_eddies(MarchRings& rings, int k, IndexRange rows);
  bool modelled() const { return d_.settings.small_eddies == SmallEddies::des; }
  PassingRow passing_of(MarchRings& rings, int j, int k, IndexRange rows) const;
  void pass_along_stream(MarchRings& rings, int k, IndexRange rows) const;
  void pass_in_plane(MarchRings& rings, int k, IndexRange rows);
  void rate(MarchRings& rings, int j, int k, IndexRange rows);
  void courant(int k);
  FlowStep close_step(Vec3 velocity_before, Vec3 held_back);
  bool northward() const { return s_.iteration % 2 == 0; }  // direction of the march through a plane
  void turbulence(MarchRings& rings, int k, IndexRange rows);
  TurbulenceRow turbulence_of(MarchRings& rings, int j, int k, IndexRange rows);
  void momentum(MarchRings& rings, int k, IndexRange rows);
  VectorStencil velocity_around(MarchRings& rings, int j, int k, IndexRange rows) const;
  VectorView<const double> force_on(std::ptrdiff_t at) const;
  MomentumRow momentum_of(MarchRings& rings, int j, int k, IndexRange rows);
  // The rest (stage_pressure.cpp).
  void matrix_ghosts(int k);
  void pressure(int j, int k);
  void correct(int rank);
  VectorView<double> changes(int j, int k);
  void flux(int j, int k);
  void velocity(int j, int k);
  void relax_pressure(int k);
  Vec3 porous_force_of_row(int j, int k) const;

  FlowField field_without_cells() const;
  void draw_cells(FlowField& field, double share) const;
  void take_new_turbulence();
  FlowProgress close_iteration();
  /// Of the whole box, from the sum over the cells of this grid.
  Vec3 of_whole_box(Vec3 sum) const;
  struct Bounded {
    const char* name;
    const Array<double>* values;
    double bound;
  };
  std::array<Bounded, 6> bounded() const;
  FaceView on_faces(int j, int k, const std::vector<double>& values) const;
  SheetView sheet(int j, int k) const;

  Discretisation d_;
  Boundaries b_;
  Obstacles in_the_way_;
  State s_;
  Scratch t_;
  Multigrid multigrid_;
  ThreadTeam& team_;
};

/// Rows of a plane, one after the other.
struct RowOrder {
  IndexRange rows;
  bool northward = true;
};
template <class Kernel>
void for_rows(RowOrder order, const Kernel& kernel) {
  const auto [begin, end] = order.rows;
  for (int step = 0; step < end - begin; ++step) kernel(order.northward ? begin + step : end - 1 - step);
}

/// Blocks of rows that the grid is divided into; the same for any number of threads.
int block_count(const FlowGrid& grid);

template <class Stage>
void Solver::each_plane(int rank, const Stage& stage) {
  const IndexRange planes = part_of(d_.grid.nz, rank, team_.size());
  for (int k = planes.begin; k < planes.end; ++k) stage(k);
  team_.barrier();
}

template <class Stage>
void Solver::each_block(int rank, const Stage& stage) {
  const int count = block_count(d_.grid);
  const IndexRange blocks = part_of(count, rank, team_.size());
  for (int b = blocks.begin; b < blocks.end; ++b) stage(part_of(d_.grid.ny, b, count));
  team_.barrier();
}

template <class Kernel>
void Solver::each_row(int rank, const Kernel& kernel) {
  each_block(rank, [&](IndexRange rows) {
    for (int k = 0; k < d_.grid.nz; ++k) for_rows({rows}, [&](int j) { kernel(j, k); });
  });
}

}  // namespace ripstop::inline flow::cartesian

// Geometric multigrid for the pressure correction: sum over faces of c (e_P - e_nb) = rhs, in float.
//
// The conductances c live on the low faces of the cells; a closed face has c = 0, and the ghost cells of e
// stay 0, which is the value in the outlet and in entraining sides. Cells are joined in pairs along each axis
// (an odd last cell stays alone); residuals are summed, corrections interpolated linearly. Red-black
// smoothing: the order of the rows, and so the number of threads, does not matter to the last bit.
#pragma once

#include <array>
#include <vector>

#include "ripstop/core/thread_team.h"
#include "ripstop/flow/cartesian/grid.h"

namespace ripstop::inline flow::cartesian {

struct MultigridLevel {
  Layout layout;
  Array<float> e, rhs, cx, cy, cz;

  // How this level came from the finer one; empty on the finest.
  struct Joint {
    std::vector<int> first;                      // n + 1: first fine cell of a coarse cell
    std::vector<int> near, far;                  // for each fine cell: two coarse cells ...
    std::vector<float> near_weight, far_weight;  // ... and their weights
  };
  Joint x, y, z;
};

class Multigrid {
 public:
  Multigrid() = default;
  /// The pressure's axes: ends with a fixed value hold the correction at zero, the others are closed.
  Multigrid(const Axis& x, const Axis& y, const Axis& z);

  /// The finest level: the caller fills rhs and the conductances, and reads e.
  MultigridLevel& finest() { return levels_.front(); }
  const MultigridLevel& finest() const { return levels_.front(); }

  /// e = 0, then `cycles` V cycles. Called by every rank of the team at once.
  void solve(ThreadTeam& team, int rank, int cycles);

  /// The same by conjugate gradients with a V cycle as preconditioner, until the residual has fallen to
  /// `reduction` of its start (2-norm) or `most` cycles are spent; how many were. For walls that a cycle alone does
  /// not see on its coarse levels. rhs is spent. The first direction is `last`, the solution of a like problem, which
  /// takes this one's place there; without one, or where that is 0, it is a cycle's. Called by every rank of the team
  /// at once.
  int solve_conjugate(ThreadTeam& team, int rank, double reduction, int most, Array<float>* last = nullptr);

  /// sum |rhs - A e| on the finest level; for tests. One thread.
  double residual() const;

 private:
  void coarsen(ThreadTeam& team, int rank);
  /// `from_zero`: the level's e is taken as zero, independent of its content.
  void cycle(std::size_t level, bool from_zero, ThreadTeam* team, int rank);
  /// Parts of solve_conjugate(), on the finest level; every rank calls them. Sums of the results of of_row(j, k,
  /// index of cell 0 of the row), plane by plane in the order of the planes; every rank gets them.
  using Sums = std::array<double, 3>;
  template <class Row>
  Sums sum_of_rows(ThreadTeam& team, int rank, const Row& of_row);
  /// Calls work(index of cell 0 of the row), and waits for all ranks.
  template <class Row>
  void each_row(ThreadTeam& team, int rank, const Row& work);
  void clear(Array<float>& a, IndexRange planes) const;

  std::vector<MultigridLevel> levels_;
  Array<float> solution_, direction_, image_;  // of the conjugate gradients
  std::vector<Sums> planes_;
};

}  // namespace ripstop::inline flow::cartesian

// Forces on the nodes of a cloth, of fabric, irregular springs, drawstring, pressure and point loads: shared by the
// explicit time step (step.cpp) and the relaxation (relaxation_step.h). Internal to cloth/.
//
// The rows of the patches are divided among the threads. A row is integrated as soon as its force is complete, while it
// is in the cache. A thread also computes the springs of the two rows before its own, for the force that they
// exert on its rows. Rows that another thread still reads (two on either side of a border) wait until every thread is
// done. The order of every sum is fixed, so that the result is the same to the last bit for any number of threads.
#pragma once

#include <algorithm>
#include <vector>

#include "ripstop/cloth/kernel.h"
#include "ripstop/cloth/layout.h"
#include "ripstop/core/thread_team.h"

namespace ripstop::inline cloth {

class Forces {
 public:
  /// `damped`: the dampers of springs and drawstring act too.
  Forces(const Cloth& cloth, const Loads& loads, bool damped, int threads);
  void set_node_force(const std::vector<Vec3>& force);
  /// Regularisation: every node is pulled towards its place in `towards` (vector layout), by area of cloth [Pa/m].
  void regularise(double per_area, const AlignedDoubles& towards);

  /// Of irregular springs and of the drawstring, and point loads on nodes outside patches. `record` may be empty.
  void add_irregular_springs(int rank, const ClothState& state, const SpringRecord& record = {});
  /// Of fabric, pressure and point loads on the rows of a rank: calls integrate(row, f) for each row that no other
  /// thread reads, f [N] in vector layout. Irregular nodes keep their share of f for on_irregular().
  template <class Integrate>
  void add_fabric(int rank, const ClothState& state, const Integrate& integrate);
  /// The same call for the rows that others read. A barrier before it.
  template <class Integrate>
  void finish_fabric(int rank, const Integrate& integrate) const;

  /// Force of the fabric on irregular node k, to which damping is added. A barrier between this and on_irregular().
  Vec3 of_fabric(int k) const { return get(irregular_.data(), k); }
  void set_of_fabric(int k, Vec3 force) { put(irregular_.data(), k, force); }
  /// Sum of all forces on irregular node k.
  Vec3 on_irregular(int k) const {
    const Cloth::IrregularNode& node = cloth_.irregular[k];
    Vec3 force = of_fabric(k);
    for (int i = node.first_share; i < node.end_share; ++i)
      force += cloth_.shares[i].weight * get(irregular_.data(), cloth_.shares[i].source);
    return force;
  }

  /// The work of a rank: its rows; visit(begin, end, n) for its irregular nodes, in ranges that are numbered by the
  /// rows they lie in, then by blocks of nodes outside patches.
  IndexRange rows(int rank) const { return {workers_[rank].begin_row, workers_[rank].end_row}; }
  template <class Visit>
  void for_irregular_nodes(int rank, const Visit& visit) const;
  int irregular_ranges() const { return cloth_.row_count + loose_blocks_; }

  /// Positions and velocities of tied nodes and ghosts. A barrier before it.
  void follow_masters(int rank, ClothState& state) const;

  /// Input of a record of the step.
  int threads() const { return static_cast<int>(workers_.size()); }
  bool damps_fabric() const { return damps_fabric_; }
  double damper_power(int row) const { return damper_power_[row]; }  // of a row's dampers, last step [W]
  double drawstring_tension() const { return string_tension_; }      // [N], of that the damper's:
  double drawstring_damper() const { return string_damper_; }
  const AlignedDoubles& pressure() const { return pressure_; }  // compile_pressure()
  /// Power of the dampers of one of the rank's rows at any positions and velocities in vector layout [W].
  double damper_power_at(int rank, int row, const AlignedDoubles& x, const AlignedDoubles& v);

 private:
  static constexpr int rows_in_turn = 3;
  static constexpr int loose_block = 64;  // nodes outside patches whose sums one thread adds: whole vectors
  struct Piece {                          // rows of one patch
    int patch, begin, end;
    bool shared_below, shared_above;
    bool waits(int row) const {
      return (shared_below && row < begin + ghosts) || (shared_above && row >= end - ghosts);
    }
  };
  struct Worker {
    std::vector<Piece> pieces;
    int begin_row = 0, end_row = 0;
    AlignedDoubles buffer;  // three rows in turn, one for forces on another's rows, the waiting rows
    std::size_t row_doubles = 0;
    std::vector<int> waiting;  // in order of their buffers
    double* others_row() { return buffer.data() + rows_in_turn * row_doubles; }
    const double* waiting_row(std::size_t i) const {
      return buffer.data() + (rows_in_turn + 1 + i) * row_doubles;
    }
  };
  void deal_rows(int threads);
  double* force_row(Worker& worker, const Piece& piece, int row);
  double add_row_springs(Worker& worker, const Piece& piece, int row, const ClothState& state);
  void complete_row(int row, const ClothState& state, double* f);
  void add_drawstring(const ClothState& state);

  const Cloth& cloth_;
  bool damped_, damps_fabric_;
  AlignedDoubles pressure_, node_force_;
  AlignedDoubles regular_shape_, regular_stiffness_;  // see regularise(), in vector layout; empty: none
  // In vector layout: of fabric on irregular nodes, of irregular springs, of the drawstring's parts (see Cloth::Share).
  AlignedDoubles irregular_;
  std::vector<double> damper_power_;  // by row [W]
  double string_tension_ = 0, string_damper_ = 0;
  int loose_blocks_ = 0;
  std::vector<Worker> workers_;
};

template <class Integrate>
void Forces::add_fabric(int rank, const ClothState& state, const Integrate& integrate) {
  Worker& worker = workers_[rank];
  for (const Piece& piece : worker.pieces) {
    const PatchLayout& patch = cloth_.patches[piece.patch];
    for (int row = piece.begin; row < std::min(piece.end, ghosts); ++row)
      std::fill_n(force_row(worker, piece, row), 3 * patch.row_slots(), 0.0);
    for (int row = std::max(0, piece.begin - ghosts); row < piece.end; ++row) {
      const double power = add_row_springs(worker, piece, row, state);
      if (row < piece.begin) continue;
      const int number = patch.first_row + row;
      damper_power_[number] = power;
      double* const f = force_row(worker, piece, row);
      complete_row(number, state, f);
      if (!piece.waits(row)) integrate(number, f);
    }
  }
}

template <class Integrate>
void Forces::finish_fabric(int rank, const Integrate& integrate) const {
  const Worker& worker = workers_[rank];
  for (std::size_t i = 0; i < worker.waiting.size(); ++i) integrate(worker.waiting[i], worker.waiting_row(i));
}

// The nodes of a row belong to the row's thread, which has moved its neighbours; the others are dealt out.
template <class Visit>
void Forces::for_irregular_nodes(int rank, const Visit& visit) const {
  const IndexRange mine = rows(rank), blocks = part_of(loose_blocks_, rank, threads());
  for (int row = mine.begin; row < mine.end; ++row)
    visit(cloth_.irregular_of_row[row], cloth_.irregular_of_row[row + 1], row);
  const int loose = cloth_.irregular_of_row.back(), all = static_cast<int>(cloth_.irregular.size());
  for (int block = blocks.begin; block < blocks.end; ++block)
    visit(loose + block * loose_block, std::min(all, loose + (block + 1) * loose_block),
          cloth_.row_count + block);
}

}  // namespace ripstop::inline cloth

// One step over the cloth in three phases with a barrier after each; the order of every sum is fixed, so the
// result is the same to the last bit for any number of threads. Internal to cloth/.
//
//   add_forces     springs and pressure row by row; a row moves as soon as its force is complete
//   move_kept      the nodes that irregular springs and ties touch, and the rows next to another thread's
//   follow_masters tied nodes and ghosts
//
// A thread computes the springs of the two rows before its own once more, for the force they give to its
// rows. Rows that another thread still reads (two on either side of a border) move after the barrier.
#pragma once

#include <vector>

#include "ripstop/cloth/blocks.h"
#include "ripstop/cloth/bound.h"
#include "ripstop/cloth/kernel.h"
#include "ripstop/cloth/layout.h"

namespace ripstop {

inline constexpr int kept_block = 64;  // kept nodes whose sums are added by one thread: whole vectors
inline constexpr int rows_in_turn = 3;

class Stepper {
 public:
  /// Real masses and damping.
  Stepper(const Cloth& cloth, const Loads& loads, ClothState& state, double dt, int threads);

  /// Fictitious masses, no damping, sums over the rows and kept nodes for the relaxation.
  struct Fictitious {
    std::vector<Symmetric> inverse_mass;  // by node; 0: does not move
    /// Projection on what a node may move along, by node; only of nodes that springs outside the lattice touch is it
    /// other than 1. Empty: all are free.
    std::vector<Symmetric> freedom;
  };
  Stepper(const Cloth& cloth, const Loads& loads, ClothState& state, const Fictitious& masses, int threads);
  void set_masses(const Fictitious& masses);
  void set_node_force(const std::vector<Vec3>& force);
  /// Of a relaxation: pulls every node toward where it is in `at` (vector layout), by area of cloth [Pa/m].
  void hold(double per_area, const AlignedDoubles& at);

  /// Of a relaxation: blocks that move besides; null: none.
  void set_blocks(const Blocks* blocks);

  void add_forces(int rank);
  void move_kept(int rank);
  /// After move_kept with a barrier after each: forces on the blocks; what every block moves by; and the rank's nodes
  /// with their blocks. That returns what it adds to RowSums::power, the same on every rank.
  void gather_blocks(int rank);
  void solve_blocks(int rank);
  double move_blocks(int rank);
  void follow_masters(int rank);
  /// After move_kept, with a barrier before follow_masters: sets the velocities of the rank's nodes to 0; their next
  /// kick is half a step's, as a leapfrog starts from rest (a whole one diverges when stops follow each other).
  void stop(int rank);

  /// From here on every step adds to `record`; finish_record() when the last step is done.
  void start_record(StepRecord& record);
  void finish_record();
  /// Before velocities change other than by a step: what the dampers outside the lattice have taken up to there.
  void close_dampers(int rank);
  /// After follow_masters: the work of the pressure since remember_positions() or
  /// start_record(). A barrier between.
  void add_pressure_work(int rank);
  void remember_positions(int rank);
  /// Of one step in so many, with a barrier after each: before add_forces; after follow_masters; and then: what the
  /// lattice's dampers take beside what add_forces sums up.
  bool looks_at_dampers() const { return record_ && damped_lattice_; }
  void remember_step(int rank);
  void change_of_step(int rank);
  void look_at_dampers(int rank, int steps);

  /// After move_kept, the same on every rank: force residual and power before the last move.
  RowSums sums() const;

 private:
  struct Piece {  // rows of one patch
    int patch, begin, end;
    bool shared_below, shared_above;
  };
  struct Pace {
    double kick = 1, keep = 1;  // factors on the next step's f dt / m and v
  };
  struct Worker {
    std::vector<Piece> pieces;
    int begin_row = 0, end_row = 0;
    Pace pace;
    int steps_since_stop = 0;
    AlignedDoubles buffer;  // three rows in turn, one for what nobody wants, the waiting rows
    std::size_t row_doubles = 0;
    std::vector<int> waiting;  // rows that move after the barrier, in order of their buffers
    AlignedDoubles motion;     // of the blocks along a row
    double block_kick = 0;     // of the step that is under way
  };
  void prepare(int threads);
  void step_piece(Worker& worker, const Piece& piece);
  void complete_row(int row, double* f);
  void move(int row, const double* f, Pace pace);
  void move_kept_nodes(int begin, int end);
  RowSums relax_kept_nodes(int begin, int end, Pace pace);
  Vec3 force_on_kept(int k) const;
  void sum_row_blocks(int row, const double* f);
  void move_kept_with_blocks(int begin, int end, double kick);
  void pull_drawstring();
  void record_fixed_force();
  template <class Work>
  void each_row(int rank, const Work& work) const;

  const Cloth& cloth_;
  ClothState& state_;
  double dt_;
  bool damped_, sums_wanted_, damped_lattice_ = false;
  AlignedDoubles pressure_, node_force_;
  AlignedDoubles hold_at_, hold_stiffness_;            // in vector layout; empty: not held
  AlignedDoubles inverse_mass_, area_;                 // by slot; 0 for kept nodes; no areas: no damping
  std::vector<double> kept_inverse_mass_, kept_area_;  // by kept node; 0: does not move
  AlignedDoubles inverse_tensor_;                      // of a relaxation, see RowRelaxation; by slot
  std::vector<Symmetric> kept_inverse_tensor_;         // likewise, by kept node
  std::vector<Symmetric> kept_freedom_;                // see Fictitious
  std::vector<char> kept_alone_;                       // whether a kept node moves with no block
  const Blocks* blocks_ = nullptr;
  // See Blocks: forces by chunk and by what moves alike [N]; of blocks, [3 x padded].
  AlignedDoubles block_sums_, motion_force_, block_force_, block_move_;
  // In vector layout: of kept nodes, of kept springs, of the drawstring's parts (see Cloth::Share).
  AlignedDoubles kept_force_;
  std::vector<Worker> workers_;
  std::vector<RowSums> row_sums_, kept_sums_, loose_sums_;

  // The dampers of kept nodes and springs take F . (v + v') / 2 in a step. v' is known when the next step
  // begins: so half of F . v is added at once and the rest of the last step's F then.
  struct Damper {
    Vec3 force;
    double energy = 0;  // over dt [W]
  };
  static void take(Damper& damper, Vec3 force, Vec3 v);
  StepRecord* record_ = nullptr;
  AlignedDoubles before_;                         // positions when the work was last looked at
  AlignedDoubles step_x_, step_v_, step_change_;  // before a step whose dampers are looked at, and of v in it
  std::vector<double> row_work_, row_damped_;     // [J], over dt [W]; by row
  std::vector<Damper> kept_dampers_;
  AlignedDoubles spring_damper_, spring_taken_, spring_peak_;  // likewise, see SpringForces
  std::vector<Damper> string_dampers_;                         // of the drawstring's parts
  std::vector<int> fixed_kept_;                                // kept nodes that are fixed
};

}  // namespace ripstop

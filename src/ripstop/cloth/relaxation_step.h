// One step of the dynamic relaxation (relax.cpp): nodes with fictitious masses move under the forces (forces.h), then
// blocks of them (blocks.h). Sums over rows and irregular nodes are the same for any number of threads. Internal to
// cloth/.
#pragma once

#include <vector>

#include "ripstop/cloth/blocks.h"
#include "ripstop/cloth/forces.h"
#include "ripstop/cloth/stability_limit.h"

namespace ripstop::inline cloth {

struct FictitiousMasses {
  std::vector<Symmetric> inverse;  // by node; 0: does not move
  /// Projection on the free directions of a node; only nodes of springs outside the lattice have other values
  /// than 1. Empty: all are free.
  std::vector<Symmetric> freedom;
};

class RelaxationStep {
 public:
  RelaxationStep(const Cloth& cloth, Forces& forces, ClothState& state, const FictitiousMasses& masses);
  void set_masses(const FictitiousMasses& masses);
  /// Blocks that move in addition to their nodes; null: none.
  void set_blocks(const Blocks* blocks);

  /// The stages, called by every rank with a barrier after each: rows; irregular nodes and the rows next to another
  /// thread's;
  void move_rows(int rank);
  void move_irregular_nodes(int rank);
  /// with blocks: the forces on them, the motion of every block, and the nodes of the rank with their blocks.
  /// Returns the contribution to RowSums::power, the same on every rank;
  void gather_blocks(int rank);
  void solve_blocks(int rank);
  double move_blocks(int rank);
  /// and where the motion stops, the velocities of the rank's nodes set to 0. Their next kick is half a step's, as a
  /// leapfrog starts from rest (a whole one diverges when stops follow each other).
  void stop(int rank);

  /// After move_irregular_nodes(), the same on every rank: force residual and power before the last move.
  RowSums sums() const;

 private:
  struct Pace {
    double kick = 1, keep = 1;  // factors on the next step's f / m and v
  };
  struct Worker {
    Pace pace;
    int steps_since_stop = 0;
    AlignedDoubles motion;  // of the blocks along a row
    double block_kick = 0;  // of the step that is under way
  };
  void move_row(int row, const double* f, Pace pace);
  RowSums move_irregular(int begin, int end, Pace pace);
  void sum_row_blocks(int row, const double* f);
  void move_irregular_with_blocks(int begin, int end, double kick);

  const Cloth& cloth_;
  Forces& forces_;
  ClothState& state_;
  AlignedDoubles inverse_tensor_;             // see RowRelaxation; by slot, 0 for irregular nodes
  std::vector<Symmetric> irregular_inverse_;  // likewise, by irregular node
  std::vector<Symmetric> irregular_freedom_;  // see FictitiousMasses
  std::vector<char> moves_alone_;             // whether an irregular node moves with no block
  const Blocks* blocks_ = nullptr;
  // See Blocks: forces by chunk and by group of equal motion [N]; of blocks, [3 x padded].
  AlignedDoubles block_sums_, motion_force_, block_force_, block_move_;
  std::vector<RowSums> row_sums_, irregular_sums_;
  std::vector<Worker> workers_;
};

}  // namespace ripstop::inline cloth

// The second level of the relaxation: blocks of cloth that move as a whole. A node by itself is as heavy as its springs
// are stiff, and so is a wave as long as the canopy, though it hardly stretches a spring; a block of them is as heavy
// as the springs that leave it. Internal to cloth/.
//
// In kernel layout a block is a few rows of a lane's vectors [edge, next edge): a chunk is these eight lanes of a row.
#pragma once

#include <vector>

#include "ripstop/cloth/layout.h"
#include "ripstop/core/thread_team.h"

namespace ripstop::inline cloth {

class Blocks {
 public:
  /// Nodes of `restricted` (by node; empty: none) move by themselves only.
  explicit Blocks(const Cloth& cloth, const std::vector<char>& restricted = {});

  int count() const { return count_; }
  /// Rounded up to whole pairs of vectors; how long an array over the blocks is.
  int padded() const { return padded_; }
  /// -1: fixed, tied or restricted.
  int block_of(int node) const { return block_of_node_[node]; }

  /// With K the tangent stiffness and I the motion of the nodes with their blocks,
  ///   (I y)^T K I y <= y^T C y   for C = I^T L I,   L = sum k |x_i - x_j|^2 over the springs,
  /// since k n n^T + T/l (1 - n n^T) <= k. Keeps `scale` times the inverse of C, for each direction alike; `also` is
  /// added to the diagonal, by node [N/m]. Looks at the present tangents and does nothing while none outgrew C.
  void set_stiffness(const Cloth& cloth, const ClothState& state, const std::vector<double>& also,
                     double scale, ThreadTeam& team);
  /// In groups of eight rows: the inverse's element (i, j) at 8 (i / 8 * padded + j) + i % 8.
  const double* inverse() const { return inverse_.data(); }

  /// Sums over the chunks of rows, then over eights of nodes outside patches, in vector layout: 24 doubles each.
  int chunk_count() const { return static_cast<int>(motion_of_.size()); }
  /// First chunk of a row, and the edges of its chunks among its vectors.
  int first_chunk(int row) const { return first_chunk_[row]; }
  const std::vector<int>& edges(int row) const { return edges_[row_patch_[row]]; }
  /// Where a irregular node's force is added among the sums: 24 chunk + lane.
  int sum_of_irregular(int k) const { return sum_of_irregular_[k]; }
  /// Block of that place; -1: none.
  int block_of_sum(int sum) const {
    return block_of_[lanes * motion_of_[sum / (3 * lanes)] + sum % (3 * lanes)];
  }
  /// r [3 x padded] = the sums of every block, by way of those of chunks that move alike (`of_motions`, 24 doubles
  /// each). One of `parts` computes the blocks of about as many chunks as the others.
  void gather(const AlignedDoubles& sums, AlignedDoubles& of_motions, AlignedDoubles& r, int part,
              int parts) const;
  int motion_count() const { return static_cast<int>(block_of_.size()) / lanes; }
  /// The chunk's motion: y [3 x padded] times `kick` in vector layout.
  void spread(int chunk, const double* y, double kick, double* motion) const;
  /// Chunks of the same number move alike.
  int motion_of(int chunk) const { return motion_of_[chunk]; }

 private:
  /// A spring between two blocks, or a block and a fixed node (-1), with the weights of the masters of tied
  /// ends.
  struct Crossing {
    int a, b;            // blocks
    int node_a, node_b;  // its ends
    double scale, rest_length;
    const SpringLaw* law;  // the cloth's
  };
  /// Motions and blocks that have to do with each other only, and their chunks: begin and end.
  struct Group {
    IndexRange chunks, motions, blocks;
  };
  /// `up` blocks over its rows.
  void add_patch(const Patch& patch, const PatchLayout& layout, const std::vector<int>& block_of_column,
                 int up);
  void add_loose(const Cloth& cloth);
  void list_crossings(const Cloth& cloth);
  std::vector<Crossing> crossings_;
  std::vector<double> diagonal_;  // of C when it was inverted
  AlignedDoubles inverse_;
  int count_ = 0, padded_ = 0;
  std::vector<Group> groups_;  // in order of all three
  std::vector<int> row_patch_;
  std::vector<std::vector<int>> edges_;  // by patch
  std::vector<int> first_chunk_;         // by row
  std::vector<int> motion_of_;           // by chunk
  std::vector<int> block_of_;            // by lane of a motion
  std::vector<int> sum_of_irregular_;
  std::vector<int> block_of_node_;  // see block_of()
};

}  // namespace ripstop::inline cloth

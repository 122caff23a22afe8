// The compiled cloth: how nodes, springs and ties lie in memory for the kernels. Internal to cloth/.
//
// A row of C columns is divided into 8 strips of M = ceil(C / 8) columns, and the strips are laid side by side:
// vector m of the row contains columns m, M + m, 2M + m, ... The neighbour at column + 1 is therefore the next vector
// in every lane: each load and store is aligned and no lanes are shuffled. Two ghost vectors at the end of the row
// hold copies of the strips' (and, when periodic, the row's) first two columns; springs that reach into them add
// their force there, and the row's end folds it back. Two rows of padding follow each patch.
//
//   slot of a node   patch.first + 8 * ((M + 2) * row + column % M) + column / M
//   vector arrays    24 doubles a vector: 8 x, 8 y, 8 z;
//                    component c of slot i at 24 * (i / 8) + i % 8 + 8 * c
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/core/aligned.h"

namespace ripstop::inline cloth {

inline constexpr int lanes = 8;
inline constexpr int ghosts = 2;
inline constexpr int max_degree = 8;

constexpr int at(int slot) {
  return 3 * (slot & ~(lanes - 1)) + (slot & (lanes - 1));
}
inline Vec3 get(const double* vectors, int slot) {
  const double* p = vectors + at(slot);
  return {p[0], p[lanes], p[2 * lanes]};
}
inline void put(double* vectors, int slot, Vec3 a) {
  double* p = vectors + at(slot);
  p[0] = a.x, p[lanes] = a.y, p[2 * lanes] = a.z;
}

/// T = compression K_1 max(e, e_b) + sum_k c_k max(e, 0)^k, without a branch;
/// c_1 = (1 - compression) K_1, c_k = K_k.
struct FamilyLaw {
  double both = 0;                                 // compression K_1
  double buckled = 0;                              // e_b <= 0, minus the buckling strain
  std::array<double, max_degree> positive_part{};  // c_1 .. c_n
};

struct PatchLayout {
  int rows = 0, columns = 0;
  int vectors = 0;               // M
  int first = 0;                 // slot of row 0, column 0
  int first_row = 0;             // number of row 0 among the rows of all patches
  std::size_t first_spring = 0;  // into Cloth::lattice, row after row
  std::size_t first_share = 0;   // into Cloth::damper_shares, likewise
  int degree = 1;
  bool damped = false;
  std::array<FamilyLaw, direction_count> law;
  std::array<double, direction_count> damping{}, viscosity{};
  /// Ghost slots of a row and the slots they copy, relative to the row's first.
  struct Copy {
    int ghost, source;
  };
  std::vector<Copy> copies;

  int row_slots() const { return lanes * (vectors + ghosts); }
  int slot(int row, int column) const {
    return first + row_slots() * row + lanes * (column % vectors) + column / vectors;
  }
  const double* springs(const AlignedDoubles& lattice, int row) const {
    return lattice.data() + first_spring + static_cast<std::size_t>(row) * vectors * springs_per_vector;
  }
  /// Of a row of a damped patch: Patch::viscosity_share, one a node; that of the spring toward (row + 1,
  /// column - 1) is the share of the node where the spring is kept.
  const double* damper_share(const AlignedDoubles& shares, int row) const {
    return shares.data() + first_share + static_cast<std::size_t>(row) * vectors * lanes;
  }
  /// Twelve arrays a vector: 1 / rest length and width of the six directions. The spring toward (row + 1,
  /// column - 1) is kept at column - 1.
  static constexpr int springs_per_vector = 2 * direction_count * lanes;
};

/// Springs outside the lattice, between two irregular nodes, in the mesh's order and in blocks of eight. The last
/// block is filled up with springs without force.
struct IrregularSprings {
  int blocks = 0;
  int degree = 1;                  // the highest of their laws
  std::vector<std::int64_t> a, b;  // at(slot) of the ends
  AlignedDoubles inverse_rest, damping;
  AlignedDoubles both, buckled;  // scale compression K_1 and e_b, see FamilyLaw
  AlignedDoubles positive_part;  // scale c_k; eight of c_1, eight of c_2, ... of each block
};

struct ContactLayout;

struct Cloth {
  Mesh mesh;  // with linearised laws, when so asked
  ClothOptions options;

  int slots = 0;
  std::vector<int> slot;  // of every node
  std::vector<PatchLayout> patches;
  int row_count = 0;               // over all patches
  std::vector<int> row_patch;      // patch of every row
  AlignedDoubles lattice;          // springs, see PatchLayout
  AlignedDoubles damper_shares;    // of damped patches, see PatchLayout
  std::vector<double> total_mass;  // [kg] with the share of tied nodes; 0 for a tied node; by node
  std::vector<double> area;        // [m2] cloth of every node, by node
  std::vector<Cell> cells;         // cells_of() the mesh
  std::vector<char> is_tied, is_fixed;

  /// Fixed nodes, nodes with irregular springs, ties or masters of ties, and nodes outside patches, in
  /// the order of their slots. The pass over the rows does not move them and stores the lattice's force on them.
  struct IrregularNode {
    int slot, node;
    int first_share, end_share;  // forces that are added to the lattice's, into `shares`
  };
  std::vector<IrregularNode> irregular;
  std::vector<int> irregular_of_row;  // row_count + 1 edges into `irregular`; nodes outside patches follow
  struct Share {
    int source;  // irregular node or, from first_spring_force on, irregular spring, then parts of the drawstring
    double weight;
  };
  std::vector<Share> shares;
  IrregularSprings springs;
  int first_spring_force = 0;  // the number of irregular nodes, rounded up to a whole vector
  std::vector<int> rings;      // slots of the drawstring's rings, its first again at the end; empty: none
  int first_string_force = 0;  // behind the springs' forces, those of the drawstring's parts

  struct Master {
    int slot;
    double weight;
  };
  struct Follower {
    int slot;
    int first_master, end_master;
  };
  std::vector<Follower> followers;  // tied nodes in the order of their slots
  std::vector<Master> masters;
  std::vector<int> followers_of_row;  // row_count + 1 edges into `followers`

  std::shared_ptr<const ContactLayout> contact;  // null: cloth passes through cloth

  int patch_row(int row) const { return row - patches[row_patch[row]].first_row; }
  int row_slot(int row) const {
    const PatchLayout& patch = patches[row_patch[row]];
    return patch.first + patch.row_slots() * (row - patch.first_row);
  }
};

/// Positions or velocities: tied nodes follow their masters, ghosts their sources; rows [begin, end), and
/// the followers outside patches when `loose`.
void follow(const Cloth& cloth, double* vectors, int begin_row, int end_row, bool loose);
void mirror(const Cloth& cloth, double* vectors, int begin_row, int end_row);

/// Pressure per cell in kernel layout, an eighth of it (a quarter to each corner, half the cross product).
/// Empty when there is none. Throws Error(bad_data) on a wrong length.
AlignedDoubles compile_pressure(const Cloth& cloth, const Loads& loads);
/// Point forces in vector layout; empty when there are none.
AlignedDoubles compile_node_force(const Cloth& cloth, const Loads& loads);

/// "disk (row 3, column 14)" or "line 7": where a node is, for messages.
std::string place_of(const Mesh& mesh, int node);

}  // namespace ripstop::inline cloth

// The mesh of a cloth solver: structured patches of lumped masses, and a few irregular springs.
//
// Node numbering is logical (no padding): node = patch.first_node + row * patch.columns + column,
// then the nodes that lie on no patch. A solver may use another layout; its results are in this numbering.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/material/spring_law.h"

namespace ripstop::inline mesh {

/// The six unique springs of a node, each toward the forward neighbour (row + dr, column + dc).
enum Direction { along_row, along_column, shear_up, shear_down, bend_row, bend_column, direction_count };
struct Offset {
  int row, column;
};
inline constexpr Offset direction_offset[direction_count] = {{0, 1}, {1, 0}, {1, 1}, {1, -1}, {0, 2}, {2, 0}};

/// A lattice of rows x columns nodes. Column + 1 of the last column is column 0 when periodic, else absent.
struct Patch {
  std::string name;  // for messages: "arm 2"
  int rows = 0;
  int columns = 0;
  bool periodic = false;
  int first_node = 0;
  int piece =
      0;  // positions as cut are comparable within one piece: contact does not exempt others as neighbours
  SpringLaw law[direction_count];        // per width, [N/m]
  double damping[direction_count] = {};  // C [N s/m] of every spring of the family
  /// In addition a Kelvin-Voigt solid: C gains viscosity share w / L0 of the spring. [N s/m]
  double viscosity[direction_count] = {};
  std::vector<double> viscosity_share;  // [row * columns + column], see share_index(); empty: 1
  /// [direction][row * columns + column]; width 0: no spring. rest_length [m] > 0 wherever width > 0.
  std::vector<double> rest_length[direction_count];
  std::vector<double> width[direction_count];
  /// Cell (row, column) has corners (row, column), (row, column+1), (row+1, column+1), (row+1, column);
  /// there are (rows - 1) x columns of them stored, [row * columns + column]; 0 where there is no cloth.
  std::vector<double> cell_area;                    // as cut, [m2]
  int fabric = 0;                                   // index into Mesh::fabric_names, for reports
  Direction warp = along_column, weft = along_row;  // the springs that lie along the yarns

  int node(int row, int column) const { return first_node + row * columns + column; }
  /// A spring's share is that of the cell that it bounds or crosses.
  int share_index(int direction, int row, int column) const {
    if (direction == shear_down) column = column > 0 ? column - 1 : columns - 1;
    return row * columns + column;
  }
  /// C of the spring of node (row, column) toward `direction` [N s/m]
  double damping_of(int direction, int row, int column) const {
    const std::size_t i = static_cast<std::size_t>(row) * columns + column;
    const double share = viscosity_share.empty() ? 1.0 : viscosity_share[share_index(direction, row, column)];
    return damping[direction] +
           viscosity[direction] * share * width[direction][i] / rest_length[direction][i];
  }
};

/// A spring outside the lattice.
struct Spring {
  int a = 0, b = 0;
  double rest_length = 0;  // [m]
  double scale = 1;        // width [m] where the law is per width, else 1
  int law = 0;             // index into Mesh::laws
  double damping = 0;      // C [N s/m]
  int part = 0;            // index into Mesh::parts
};

/// Node `node` follows its masters: x = sum weight * x_master, weights sum to 1, masters are free or fixed
/// nodes (never themselves tied). Its mass and every force on it go to the masters with the same weights.
struct Tie {
  struct Master {
    int node;
    double weight;
  };
  int node = 0;
  std::vector<Master> masters;
};

/// A cord without mass that runs without friction, once round, through rings at nodes: one tension along all of it,
/// T = law(e) with e = length / rest_length - 1 of the polygon through the rings, nothing where e < 0. Its energy is
/// rest_length times the law's at e, whatever way the length is shared out between the rings.
struct Drawstring {
  std::vector<int> rings;  // nodes in order; the last is followed by the first
  double rest_length = 0;  // [m]
  SpringLaw law;           // [N]
  double damping = 0;      // C of the rate of the whole length, where it is taut [N s/m]
};

struct Mesh {
  std::vector<Vec3> start;   // positions at the start of a run [m]
  std::vector<double> mass;  // [kg]; of a tied node: its own, before it is handed to the masters
  std::vector<Patch> patches;
  std::vector<SpringLaw> laws;  // of `springs`; [N/m] per width or [N]
  std::vector<Spring> springs;
  std::vector<Tie> ties;
  std::optional<Drawstring> drawstring;
  std::vector<int> fixed;          // nodes that do not move
  std::vector<std::string> parts;  // of `springs`, names for messages: "hem tape", "line 7"
  std::vector<std::string> fabric_names;

  int node_count() const { return static_cast<int>(start.size()); }
  int cell_count() const;  // over all patches, holes counted: the length of every per-cell array
};

/// The four corners of every cell of every patch, patch after patch, in the order of cell_area; a cell
/// without cloth has corner[0] = -1. The quad's area vector (half the cross product of its diagonals 0->2 and
/// 1->3) points from the cloth's inner side, on which a pressure > 0 presses, to its outer one.
struct Cell {
  int corner[4];
};
std::vector<Cell> cells_of(const Mesh& mesh);

/// Area vector of a possibly warped quad: half the cross product of its diagonals [m2].
inline Vec3 area_vector(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  return 0.5 * cross(c - a, d - b);
}

}  // namespace ripstop::inline mesh

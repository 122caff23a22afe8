// What every canopy family needs to build its Mesh: lattices from a flat pattern, tape, lines, ties.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "ripstop/material/lattice.h"
#include "ripstop/material/material.h"
#include "ripstop/parachute/mesh.h"

namespace ripstop {

/// Consecutive nodes and the lengths between them as cut [m]: lengths[i] from nodes[i] to nodes[i + 1].
struct Path {
  std::vector<int> nodes;
  std::vector<double> lengths;

  double length() const;
  /// `next` begins where this path ends, or `gap` [m] farther on.
  void append(const Path& next, double gap);
  /// `next` begins with this path's last node.
  void extend(const Path& next);
};

/// Where the nodes of a patch lie at the start, and how its cloth is cut.
struct PatchShape {
  int rows = 0, columns = 0;
  bool periodic = false;
  std::function<Vec3(int row, int column)> start;
  /// Corners of cell (row, column) of the flat pattern, in the order of Cell; absent: the start shape is an
  /// isometry of the cloth as cut.
  std::function<std::array<Vec3, 4>(int row, int column)> cut = {};
  /// A spring over two cells along a row is as long as both cells together: a flat strip rolled into a ring,
  /// or gores sewn together. Else it is as long as the start shape has it.
  bool rolled_rows = false;
  FabricCut grain = FabricCut::block;  // how the yarns lie on the lattice
};

class MeshBuilder {
 public:
  Mesh mesh;

  /// Index of a named part, made on first use.
  int part(const std::string& name);
  /// Index of a law in Mesh::laws.
  int law(SpringLaw law);
  /// A single lumped mass [kg].
  int add_node(Vec3 start, double mass);

  /// A lattice of cloth with its nodes; rest lengths, widths, areas and masses follow from the cloth as cut.
  /// Returns the patch's index.
  int add_patch(const std::string& name, const PatchShape& shape, const Fabric& fabric);

  /// A row or a part of a column of a patch, with the lengths of the cloth as cut. A row of a periodic patch
  /// ends on its first node.
  Path row(int patch, int row) const;
  Path column(int patch, int column, int first_row, int last_row) const;

  /// The nodes along radial `part` of `parts`, which lies on a column of every patch, from the first patch's
  /// lower edge to the last one's upper edge. The patches follow one another edge to edge, each tied to the
  /// next, which holds the shared node.
  Path radial(const std::vector<int>& patches, int part, int parts) const;

  /// The last row of `lower` lies on the first row of `upper`, which has as many columns or half as many.
  void tie_rows(int lower, int upper);

  /// Tape along a path, in parallel to the cloth; its mass goes to the nodes.
  void add_tape(const Path& path, const Tape& tape, int law, int part);

  /// A chain of line (axial springs between neighbours, bending springs over two) along existing nodes; adds
  /// the line's mass to them and returns the axial springs' indices.
  std::vector<int> add_chain(const Path& path, const Line& line, int axial_law, int bending_law, int part);

  void tie(int node, std::vector<Tie::Master> masters);
  /// Replaces masters that are tied themselves by their own masters, and places every tied node where its
  /// masters have it; call once when all ties are known.
  void flatten_ties();

 private:
  const WovenLaws& laws_of(const Fabric& fabric);
  void set_laws(Patch& patch, const WovenLaws& laws, FabricCut grain);

  std::map<std::string, WovenLaws> laws_;  // by the fabric's name: a fit takes tens of milliseconds
};

}  // namespace ripstop

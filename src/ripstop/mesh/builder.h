// How a Mesh is built: lattices of cloth from a flat pattern, springs along paths, ties.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "ripstop/material/lattice.h"
#include "ripstop/material/material.h"
#include "ripstop/mesh/mesh.h"

namespace ripstop::inline mesh {

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
  /// or strips sewn together. Else it is as long as the start shape has it.
  bool rolled_rows = false;
  FabricCut grain = FabricCut::block;  // how the yarns lie on the lattice
};

/// Springs along a path in parallel to the cloth.
struct Strand {
  int law = 0;                // index into Mesh::laws
  int part = 0;               // index into Mesh::parts
  double scale = 1;           // width [m] where the law is per width, else 1
  double damping = 0;         // C of every spring [N s/m]
  double linear_density = 0;  // [kg/m]
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

  /// The last row of `lower` lies on the first row of `upper`, which has as many columns or half as many.
  void tie_rows(int lower, int upper);

  /// Springs between the neighbours on a path; the strand's mass goes to the nodes. Returns their indices.
  std::vector<int> add_springs(const Path& path, const Strand& strand);

  void tie(int node, std::vector<Tie::Master> masters);
  /// Replaces masters that are tied themselves by their own masters, and places every tied node where its
  /// masters have it; call once when all ties are known.
  void flatten_ties();

 private:
  const WovenLaws& laws_of(const Fabric& fabric);
  void set_laws(Patch& patch, const WovenLaws& laws, FabricCut grain);

  std::map<std::string, WovenLaws> laws_;  // by the fabric's name: a fit takes tens of milliseconds
};

}  // namespace ripstop::inline mesh

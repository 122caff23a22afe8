// What every canopy family needs to build its Mesh: lattices from a flat pattern, tape, lines, ties.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ripstop/material/material.h"
#include "ripstop/parachute/mesh.h"

namespace ripstop {

class MeshBuilder {
 public:
  Mesh mesh;

  /// Index of a named part, made on first use.
  int part(const std::string& name);
  /// Index of a law in Mesh::laws.
  int law(SpringLaw law);
  /// A single lumped mass [kg].
  int add_node(Vec3 start, double mass);

  /// A lattice of cloth with its nodes. `position(row, column)` is both the start and, up to an isometry of
  /// each cell, the cloth as cut. `rolled_rows`: the rows are a flat strip rolled into a ring, so the springs
  /// that span two cells along a row are as long as both cells together. Rest lengths, widths, areas and
  /// masses follow. Returns the patch's index.
  int add_patch(const std::string& name, int rows, int columns, bool periodic, bool rolled_rows,
                const Fabric& fabric, const std::function<Vec3(int row, int column)>& position);

  /// Tape along consecutive nodes, in parallel to the cloth; its mass goes to the nodes.
  void add_tape(const std::vector<int>& nodes, bool closed, const Tape& tape, int law, int part);

  /// A chain of line (axial springs between neighbours, bending springs over two) along existing nodes; adds
  /// the line's mass to them and returns the axial springs' indices. Rest lengths are those of the start.
  std::vector<int> add_chain(const std::vector<int>& nodes, const Line& line, int axial_law, int bending_law,
                             int part);

  void tie(int node, std::vector<Tie::Master> masters);
  /// Replaces masters that are tied themselves by their own masters; call once when all ties are known.
  void flatten_ties();
};

}  // namespace ripstop

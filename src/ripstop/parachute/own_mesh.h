// A canopy that is put together node by node, in place of that of a family. It is made of the materials of a case. The
// frame is that of a family: z is downstream, and the plane z = 0 lies at flow.canopy_position_m.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ripstop/parachute/build.h"
#include "ripstop/parachute/sewing.h"

namespace ripstop::inline parachute {

/// A lattice of cloth, row by row. Warp runs from row to row. The outer side is that of (next column) x (next row); a
/// pressure > 0 acts on the inner side.
struct ClothLattice {
  int rows = 0, columns = 0;
  bool closed = false;       // the first column follows the last one
  std::vector<Vec3> points;  // at the start, rows x columns
  /// As cut: points of a flat pattern, rows x columns (closed: columns + 1). Empty: `points` is an isometry of the cloth
  /// as cut.
  std::vector<Vec3> flat = {};
};

class OwnMesh {
 public:
  /// Without cloth.
  explicit OwnMesh(PartMaterials materials) : materials_(std::move(materials)) {}
  /// From the mesh of a family.
  OwnMesh(CanopyMesh mesh, PartMaterials materials);

  // All of them throw Error(usage) for input that no mesh can have. Nodes are numbered from 0 in the order in which
  // they are added; the first of the new nodes is returned.
  int add_cloth(const std::string& name, const ClothLattice& lattice);
  int add_nodes(const std::vector<Vec3>& points);
  /// A suspension line through nodes; lengths [m] between them as cut, empty: those at the start.
  void add_line(const std::vector<int>& nodes, const std::vector<double>& lengths);
  /// Tape along nodes, likewise.
  void add_tape(const std::vector<int>& nodes, const std::vector<double>& lengths);
  /// `node` follows its masters, which are not tied themselves; without weights all have the same.
  void tie(int node, const std::vector<int>& masters, const std::vector<double>& weights);
  void fix(const std::vector<int>& nodes);
  /// The edge of the mouth in order, for the skirt diameter and the length of the canopy.
  void set_skirt(const std::vector<int>& nodes);

  /// Throws Error(usage) for a mesh without cloth or fixed node, and for a free node without mass.
  CanopyMesh mesh() const;

 private:
  void require_nodes(const std::vector<int>& nodes) const;
  Path path(const std::vector<int>& nodes, std::vector<double> lengths) const;

  PartMaterials materials_;
  CanopyBuilder builder_;
};

/// Cloth as cut [m2].
double cloth_area(const Mesh& mesh);

}  // namespace ripstop::inline parachute

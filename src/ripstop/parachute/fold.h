// The folded start of an opening: disks zigzag-folded into cones and bands into cylinders, without strain.
#pragma once

#include <string>
#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/parachute/canopy_mesh.h"

namespace ripstop::inline parachute {

struct Folding {
  double initial_radius = 0;  // of the folded skirt, midway between its inner and outer folds [m]
  int folds = 0;              // outer folds (as many inner ones); 0: one a line
  double slack = 0;           // by which a line is longer than its way from confluence to skirt [m]
};

/// Smallest radius of the inner folds of a canopy of gores, over the radius of its seams as cut.
inline constexpr double least_inner_share = 0.02;

struct FoldedStart {
  std::vector<Vec3> positions;  // logical numbering [m]
  int folds = 0;
  double inner_radius = 0, outer_radius = 0;  // of the skirt's folds [m]
};

/// Every patch of `mesh` must be a flat disk, a cylinder or a frustum about the axis x = y = 0 with whole columns
/// round it. Between two neighbouring fold lines, which follow columns, the cloth stays plane, so every spring keeps
/// its length except those that resist bending over a fold. The fold line of column 0, where the first line runs, is
/// an inner one. Fixed nodes and the riser stay where they are; the pieces follow each other along the lines, each as
/// far downstream as its lines allow without being stretched. Throws Error(usage) when the number of folds does not
/// divide every ring's columns or the radius does not fit, Error(bad_data) for a mesh of another kind.
FoldedStart fold(const CanopyMesh& mesh, const Folding& folding);

/// Throws Error(usage) when fold lines would not follow columns of every ring.
void check_folds(const Mesh& mesh, int folds);

/// Whether fold() takes the mesh: disks, cylinders and frusta of revolution only.
bool folds_without_strain(const Mesh& mesh);

/// The mesh without the springs that a fold line crosses, so that the folded start is at rest: a crease does
/// not resist being unfolded. Those are springs over two cells, and on a flat sheet, which has folds along
/// diagonals of cells, the other diagonals of these cells. Throws Error(usage) as fold().
CanopyMesh with_creases(const CanopyMesh& mesh, const FoldedStart& folded);

/// Strains of the springs at given positions.
struct StartStrain {
  /// Largest |strain| of all springs along and across the cloth, of tape and lines; a spring that does
  /// not resist being pushed further counts only when stretched.
  double largest = 0;
  std::string part;    // where: "disk", "line 3"
  double bending = 0;  // largest |strain| of the springs that resist bending
};
StartStrain start_strain(const Mesh& mesh, const std::vector<Vec3>& positions);

}  // namespace ripstop::inline parachute

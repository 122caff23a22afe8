// The folded start of a canopy cut as one flat sheet, such as a cross.
#pragma once

#include "ripstop/parachute/fold.h"

namespace ripstop::inline parachute {

/// Whether all the cloth lies in one plane across the axis and no patch goes round it.
bool is_flat_sheet(const Mesh& mesh);

/// The sheet as a cone about the axis with four outer and four inner folds through its middle, 45 degrees
/// apart: those of the middle square's diagonals and those along the arms, which follow the mesh. Between two
/// folds it stays plane. The folds along the arms are the inner ones. Throws Error(usage) for another number
/// of folds, or when the lattice has no column on the fold lines, or the radius does not fit.
FoldedStart fold_sheet(const CanopyMesh& mesh, const Folding& folding);

}  // namespace ripstop::inline parachute

// A first folded shape of a canopy of gores with curved seams, which has no fold without strain.
#pragma once

#include "ripstop/parachute/fold.h"

namespace ripstop::inline parachute {

/// A zigzag about the axis of every ring of nodes: fold lines follow columns, seams on inner folds. Every row keeps
/// the length of its strips and every fold line the length of its columns, counted from the vent, where the rows are
/// level: the middle of a gore is therefore higher than its seams. The angle between rows and columns is not
/// preserved. `share`: of the seams' radius as cut that the inner folds keep. The free lines stay where they are; the
/// vent lies at z = 0. Throws Error(usage) when the strips are too short for the share, or the folds do not fit.
FoldedStart zigzag_of_gores(const Mesh& mesh, int folds, double share);

}  // namespace ripstop::inline parachute

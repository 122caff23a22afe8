// The folded start of any canopy: without strain where its cloth allows it, else with the least
// that a relaxation finds.
#pragma once

#include "ripstop/core/thread_team.h"
#include "ripstop/parachute/fold.h"

namespace ripstop::inline fsi {

/// Disks, cylinders and cones of revolution as fold(), flat sheets as fold_sheet(). Canopies of gores
/// start from the zigzag of zigzag_of_gores() and are relaxed without loads, all springs equally stiff,
/// until none is strained by more than a part of ten thousand or little more is gained. A start with more
/// strain than a part of a thousand or with pierced edges is computed again, with cloth that wrinkles from
/// the beginning. `symmetry` is the number of turns that map the canopy as cut onto itself; the folded one
/// keeps those that also map its folds. Throws as fold(), and Error(usage) where a strain above 10 % remains.
FoldedStart folded_start(const CanopyMesh& mesh, const Folding& folding, int symmetry, ThreadTeam& team);

}  // namespace ripstop::inline fsi

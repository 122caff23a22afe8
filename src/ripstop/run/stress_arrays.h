// The cloth's stresses as arrays of a VTK file.
#pragma once

#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/output/vtk.h"

namespace ripstop::inline run {

/// On the cells of cloth: `stress_max_n_per_m` with `stress_max_direction`, `stress_min_n_per_m`, `warp_n_per_m`,
/// `weft_n_per_m`, `tautness` (0 slack, 1 wrinkled, 2 taut), `von_mises_n_per_m`, `strain_max`; and
/// `von_mises_strip_n_per_m`, the mean over a strip that the strength test is made on (strip_stress()).
std::vector<VtkArray> stress_arrays(const Mesh& mesh, const std::vector<Vec3>& positions,
                                    const std::vector<CellStress>& stress);

}  // namespace ripstop::inline run

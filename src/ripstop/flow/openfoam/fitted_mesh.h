// A mesh whose faces lie on the sheets: the grid's cells, halved about the cloth and moved onto it by OpenFOAM's
// snappyHexMesh.
#pragma once

#include <filesystem>
#include <vector>

#include "ripstop/flow/flow.h"
#include "ripstop/flow/openfoam/baffles.h"
#include "ripstop/flow/openfoam/case_reader.h"
#include "ripstop/flow/openfoam/programs.h"

namespace ripstop::inline flow::openfoam {

/// Makes constant/polyMesh of the case in `folder`, which contains system/blockMeshDict of the grid, with the patches
/// inlet, outlet, sides and of every sheet clothN_low and clothN_high. `levels`: times that the cells at the cloth
/// are halved. Without any cloth yet it is the grid. Throws Error(external) that names the tool, and Error(external)
/// if checkMesh rejects the mesh.
void make_fitted_mesh(const std::filesystem::path& folder, const FlowProblem& problem, int levels,
                      const Programs& programs);

struct FittedMesh {
  MeshPart part;
  std::vector<BafflePatch> patches;  // one a sheet
};
/// The result of make_fitted_mesh(). Faces do not represent details finer than they are: each represents more of the
/// sheet than its own area, and together all of it. Throws Error(external) if this difference is large: cells too
/// coarse for the cloth.
FittedMesh read_fitted_mesh(const std::filesystem::path& folder, const FlowProblem& problem);

}  // namespace ripstop::inline flow::openfoam

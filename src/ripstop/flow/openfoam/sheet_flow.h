// Flow through sheets on OpenFOAM: simpleFoam on the cells of the grid, with the cloth in the faces that it parts.
#pragma once

#include <filesystem>
#include <memory>

#include "ripstop/flow/flow.h"
#include "ripstop/flow/openfoam/installation.h"
#include "ripstop/flow/openfoam/openfoam.h"

namespace ripstop::inline flow::openfoam {

/// A flow of constant density. It owns `folder`, the case of OpenFOAM. Throws Error(usage) for unsupported
/// features.
std::unique_ptr<Flow> start_sheet_flow(const FlowProblem& problem, const OpenFoamSettings& settings,
                                       const std::filesystem::path& folder, const Installation& installation);

}  // namespace ripstop::inline flow::openfoam

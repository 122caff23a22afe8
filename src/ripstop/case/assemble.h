// From a case to what the solvers take: the mesh in the flow's frame, the flow problem, the coupled problem.
#pragma once

#include "ripstop/case/resolve.h"
#include "ripstop/flow/flow.h"
#include "ripstop/fsi/steady.h"
#include "ripstop/parachute/build.h"

namespace ripstop {

PartMaterials part_materials(const Case& given);
/// The canopy's start shape with its skirt at canopy_position(given), axis on x = y = 0, inlet at z = 0.
CanopyMesh parachute_mesh(const Case& given);
/// Box, air and the canopy cloth's resistance; its cut cells are left to the coupling.
FlowProblem flow_problem(const Case& given);
SteadyProblem steady_problem(const Case& given);

}  // namespace ripstop

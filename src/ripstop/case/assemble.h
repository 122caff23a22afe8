// From a case to the input of the solvers: the mesh in the frame of the flow, the flow problem, the coupled
// problem.
#pragma once

#include <optional>

#include "ripstop/case/settings.h"
#include "ripstop/flow/flow.h"
#include "ripstop/fsi/steady_loop.h"
#include "ripstop/parachute/build.h"
#include "ripstop/parachute/cluster.h"

namespace ripstop::inline cases {

/// The canopy's start shape with its skirt at flow.canopy_position_m, axis on x = y = 0, inlet at z = 0. With a `design`
/// in place of the settings' own: of that, of the same materials. With a mesh of the user's `own` (own_mesh.h): that one,
/// its plane z = 0 at flow.canopy_position_m.
CanopyMesh parachute_mesh(const Settings& resolved, const CanopyMesh* own = nullptr);
CanopyMesh parachute_mesh(const Design& design, const Settings& resolved);
/// The canopies of a cluster; absent for a single one.
std::optional<Cluster> cluster_of(const Settings& resolved);
/// Each canopy of a cluster with its mesh_as_cut().
Cluster cluster_as_cut(const Settings& resolved);
/// The mesh of a steady run: of all canopies. Otherwise parachute_mesh().
CanopyMesh steady_mesh(const Settings& resolved, const CanopyMesh* own = nullptr);
/// The mesh of a flight: of all canopies, whose risers end at one node.
CanopyMesh flying_mesh(const Settings& resolved);
/// A parachute_mesh() with parachute_mass(): hems, allowances and loops of lines, which the mesh does not have, are
/// added to all of its nodes in proportion.
CanopyMesh mesh_as_cut(CanopyMesh mesh, const Settings& resolved);
/// The mass of these additions [kg].
double mass_beyond(const CanopyMesh& mesh, const Settings& resolved);
/// Box, air and the canopy cloth's resistance; its cut cells are left to the coupling.
FlowProblem flow_problem(const Settings& resolved);
/// Throws Error(usage) if flow.angle_of_attack_deg is not 0; `what` does not support one.
void require_axial_stream(const FlowSettings& flow, const char* what);
/// Why a steady run solves the whole box, as a clause; empty: a quarter is enough.
std::string why_full_box(const Settings& resolved, const CanopyMesh& mesh, const FlowProblem& problem,
                         bool own_mesh = false);
SteadyProblem steady_problem(const Settings& resolved, const CanopyMesh* own = nullptr);

}  // namespace ripstop::inline cases

#include "ripstop/case/assemble.h"

#include <fmt/format.h>

#include <numeric>
#include <utility>

#include "ripstop/canopy/mirror.h"
#include "ripstop/case/bodies.h"
#include "ripstop/case/cluster.h"
#include "ripstop/case/cost.h"
#include "ripstop/case/payload.h"
#include "ripstop/core/error.h"
#include "ripstop/flow/engines.h"
#include "ripstop/flow/projections.h"
#include "ripstop/flow/symmetry.h"
#include "ripstop/parachute/cross.h"
#include "ripstop/parachute/own_mesh.h"

namespace ripstop::inline cases {

namespace {

CanopyMesh in_flow(CanopyMesh mesh, const Settings& resolved) {
  const double z = resolved.flow().canopy_position_m;
  for (Vec3& p : mesh.start) p.z += z;
  return mesh;
}

CanopyMesh mesh_of(const std::optional<Cluster>& cluster, const Settings& resolved, const CanopyMesh* own) {
  return cluster ? cluster->mesh() : parachute_mesh(resolved, own);
}

/// The settings of each canopy of a cluster; those of one if they are equal.
std::vector<Settings> settings_of_canopies(const Settings& resolved) {
  if (equal_canopies(resolved.written())) return {resolved};
  std::vector<Settings> each;
  for (int k = 0; k < canopy_count(resolved.written()); ++k) each.push_back(canopy_settings(resolved, k));
  return each;
}

}  // namespace

CanopyMesh parachute_mesh(const Settings& resolved, const CanopyMesh* own) {
  return own ? in_flow(*own, resolved) : parachute_mesh(resolved.parachute(), resolved);
}

CanopyMesh mesh_as_cut(CanopyMesh mesh, const Settings& resolved) {
  const double whole = parachute_mass(resolved), share = whole / (whole - mass_beyond(mesh, resolved));
  for (double& mass : mesh.mass) mass *= share;
  return mesh;
}

double mass_beyond(const CanopyMesh& mesh, const Settings& resolved) {
  return parachute_mass(resolved) - std::accumulate(mesh.mass.begin(), mesh.mass.end(), 0.0);
}

CanopyMesh parachute_mesh(const Design& design, const Settings& resolved) {
  require_cloth_memory(design);
  return in_flow(build_mesh(design, resolved.materials()), resolved);
}

std::optional<Cluster> cluster_of(const Settings& resolved) {
  const std::optional<ClusterKeys>& keys = resolved.written().cluster;
  if (!keys) return {};
  std::vector<CanopyMesh> canopies;
  for (const Settings& canopy : settings_of_canopies(resolved)) canopies.push_back(parachute_mesh(canopy));
  return Cluster(std::move(canopies), layout_of(*keys));
}

Cluster cluster_as_cut(const Settings& resolved) {
  std::vector<CanopyMesh> canopies;
  for (const Settings& canopy : settings_of_canopies(resolved))
    canopies.push_back(mesh_as_cut(parachute_mesh(canopy), canopy));
  return Cluster(std::move(canopies), layout_of(*resolved.written().cluster));
}

CanopyMesh steady_mesh(const Settings& resolved, const CanopyMesh* own) {
  return mesh_of(cluster_of(resolved), resolved, own);
}

CanopyMesh flying_mesh(const Settings& resolved) {
  if (const std::optional<Cluster> cluster = cluster_of(resolved)) return join_risers(cluster->mesh()).mesh;
  return parachute_mesh(resolved);
}

FlowProblem flow_problem(const Settings& resolved) {
  const FlowSettings& flow = resolved.flow();
  FlowProblem problem;
  problem.grid = flow_grid(flow);
  problem.air.velocity = flow.speed_m_s * wind_direction(flow.angle_of_attack_deg, flow.azimuth_deg);
  problem.air.density = flow.density_kg_m3;
  problem.air.viscosity = flow.viscosity_pa_s;
  problem.air.temperature = flow.temperature_k;
  problem.air.turbulence_intensity = flow.turbulence_intensity;
  problem.air.viscosity_ratio = flow.viscosity_ratio;
  problem.sides = flow.sides;
  problem.outlet = flow.outlet;
  problem.jet = jet_of(flow.tunnel);
  problem.stopping.residual = flow.residual;
  problem.stopping.max_iterations = flow.max_iterations;
  problem.stopping.average_over = flow.average_over;
  const ClothResistance& cloth = resolved.materials().canopy.resistance;
  if (flow.porosity_model == PorosityModel::sheet) {
    problem.bodies = {sheet_body({}, as_sheet(cloth))};
    for (FlowBody& body : rigid_bodies(resolved)) problem.bodies.push_back(std::move(body));
  } else {
    const PorousCellLaw cells = as_cells(cloth);
    problem.bodies = {porous_body({{}, cells.darcy, cells.forchheimer})};
  }
  return problem;
}

void require_axial_stream(const FlowSettings& flow, const char* what) {
  if (flow.angle_of_attack_deg == 0) return;
  throw Error(ExitCode::usage,
              fmt::format("flow.angle_of_attack_deg = {:g}: {} keeps the canopy on the axis of the stream; "
                          "set it to 0, or use flow_problem() of the library for a flow without cloth",
                          flow.angle_of_attack_deg, what));
}

namespace {

// The force on coarse cells depends on a few cells at the skirt, in a quarter on four at a time, and the coupling may
// then alternate between two shapes. The whole of so coarse a domain is solved in seconds.
constexpr double fewest_cells_across = 16;

}  // namespace

std::string why_full_box(const Settings& resolved, const CanopyMesh& mesh, const FlowProblem& problem,
                         bool own_mesh) {
  const FlowSettings& flow = resolved.flow();
  if (flow.symmetry == FlowSymmetry::full) return "flow.symmetry is \"full\"";
  if (!engine_of(flow.engine).can.quarters)
    return fmt::format("the flow engine \"{}\" has no planes of symmetry", flow.engine);
  if (flow.unsteady) return "the flow is unsteady";
  if (flow.mesh == FlowMesh::fitted) return "the cells are fitted to the cloth";
  if (!resolved.written().bodies.empty()) return "there are rigid bodies in the flow";
  if (!equal_canopies(resolved.written())) return "the canopies of the cluster have different sizes";
  // Rounding decides whether cloth touches a cell, and the published values are those of the full box.
  if (flow.porosity_model == PorosityModel::paper && flow.symmetry == FlowSymmetry::automatic)
    return "the \"paper\" model is compared with the full domain of its source";
  if (flow.tunnel.kind == TunnelKind::open_jet && flow.symmetry == FlowSymmetry::automatic)
    return "the stream is an open jet";
  if (std::string reason = why_not_mirrored(problem); !reason.empty()) return reason;
  if (const double across = cells_across(resolved);
      across < fewest_cells_across && flow.symmetry == FlowSymmetry::automatic)
    return fmt::format("there are {:.1f} flow cells across the canopy, fewer than {:g}", across,
                       fewest_cells_across);
  // Wrinkles make the cloth asymmetric: docs/tables/symmetry.md.
  if (resolved.parachute().canopy.as<Cross>() && !own_mesh && flow.symmetry == FlowSymmetry::automatic)
    return "the cloth of a cross wrinkles without symmetry";
  if (mirror_images(mesh)) return {};
  if (const int gores = resolved.parachute().gores; gores % 2 != 0 && !own_mesh)
    return fmt::format("the number of gores is odd ({})", gores);
  return "the canopy is not its own mirror image in the planes x = 0 and y = 0";
}

SteadyProblem steady_problem(const Settings& resolved, const CanopyMesh* own) {
  require_axial_stream(resolved.flow(), "a steady run");
  if (own) require_one_canopy(resolved, "a run with a mesh of your own");
  std::optional<Cluster> cluster = cluster_of(resolved);
  SteadyProblem problem{mesh_of(cluster, resolved, own),
                        flow_problem(resolved),
                        own ? cloth_area(*own) : nominal_area(resolved.parachute()),
                        resolved.coupling(),
                        std::nullopt,
                        {}};
  problem.own_mesh = own != nullptr;
  problem.cluster = std::move(cluster);
  problem.reference_area *= area_ratio(resolved.written());
  if (const FlowSettings& flow = resolved.flow(); flow.unsteady) {
    const WatchKeys& keys = flow.watch;
    problem.averaging_window = {keys.courant, keys.standard_error, keys.shortest, keys.longest,
                                inflated_diameter(resolved.parachute())};
  }
  problem.full_box_because = why_full_box(resolved, problem.mesh, problem.flow, problem.own_mesh);
  problem.flow.quarter = problem.full_box_because.empty();
  if (resolved.flow().symmetry == FlowSymmetry::quarter && !problem.flow.quarter)
    throw Error(ExitCode::usage,
                fmt::format("flow.symmetry = \"quarter\": not possible, because {}; set it to \"auto\" or "
                            "\"full\"",
                            problem.full_box_because));
  return problem;
}

}  // namespace ripstop::inline cases

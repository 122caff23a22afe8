#include "ripstop/case/opening.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include "ripstop/case/assemble.h"
#include "ripstop/case/cluster.h"
#include "ripstop/case/cost.h"
#include "ripstop/case/deployment.h"
#include "ripstop/case/tape.h"
#include "ripstop/core/error.h"
#include "ripstop/core/words.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/fsi/pressure.h"

namespace ripstop::inline cases {
namespace {

// The equilibrium that turns a drag into a pressure is found on a mesh of at most so many nodes: its area
// differs by a few parts of a thousand.
constexpr int equilibrium_nodes = 3000;

// Undamped cloth that wrinkles gains energy from time steps near the stability limit (docs/theory/inflation.md). A loss
// factor of 0.6 % at 100 Hz, below that of nylon (assumed).
constexpr double coupled_cloth_damping = 1e-5;  // [s]

double pressure_of(const Settings& opening, const LoadSource& source, int threads,
                   const std::function<void()>& alive) {
  if (!source.steady_drag) return *opening.inflation().pressure_pa;
  Design coarse = opening.parachute();
  coarse.mesh.cloth_nodes = std::min(equilibrium_nodes, coarse.mesh.cloth_nodes);
  ThreadTeam team(threads);
  return pressure_for(*source.steady_drag, parachute_mesh(coarse, opening), opening.coupling().linear, team,
                      alive)
      .pressure;
}

/// The container at `start`.
Container container_of(const PackedParachute& packed, const DeploymentPhase& start) {
  return {packed.bag_mass,      packed.bag_drag_area, packed.canopy_mass,
          packed.canopy_length, packed.strip_force,   start.payload_speed - start.bag_speed};
}

bool lines_first(const Settings& opening) {
  return opening.deployment()->order == DeploymentKeys::Order::lines_first;
}

/// The state at which the canopy begins to leave its bag; canopy first, at which the lines come taut.
const DeploymentPhase& start_of_opening(const Deployment& deployment, const Settings& opening) {
  return *deployment.phase(lines_first(opening) ? canopy_leaves : lines_stretch);
}

/// The opening begins at that state, within the container if its lines come first.
void start_from(const Deployment& deployment, const Settings& opening, InflationProblem& problem) {
  if (deployment.stopped)
    throw Error(
        ExitCode::usage,
        fmt::format("[deployment]: the canopy does not open. {}. A lower deployment.strip_force_n or "
                    "line_force_n, a larger pilot_drag_area_m2, a higher relative_speed_m_s or a higher "
                    "airspeed at deployment (--speed; {:g} m/s) pulls it out",
                    *deployment.stopped, opening.flow().speed_m_s));
  const DeploymentPhase& start = start_of_opening(deployment, opening);
  problem.air->flow.air.velocity =
      (start.payload_speed / problem.air->flow.air.speed()) * problem.air->flow.air.velocity;
  if (lines_first(opening)) problem.air->container = container_of(packed_parachute(opening), start);
}

/// Payload::density_ratio in the standard atmosphere, from the height that the case gives.
std::function<double(double)> density_below(const std::optional<double>& height) {
  if (!height) return {};
  return [from = *height](double fallen) { return density_ratio(from, fallen); };
}

/// The option that has replaced flow.speed_m_s of the case; empty: none.
std::string speed_option(const Case& given) {
  const auto origin = given.origins.find("flow.speed_m_s");
  return origin == given.origins.end() ? "" : origin->second.option;
}

void take_opening_speed(Case& opening) {
  std::optional<double>& deployed = opening.payload.deployment_speed_m_s;
  FlowKeys& flow = opening.flow;
  if (!deployed && !flow.speed_m_s)
    throw Error(ExitCode::usage,
                "the airspeed at deployment is missing: give --speed M/S, or payload.deployment_speed_m_s in "
                "the case");
  if (!deployed) return;
  if (!speed_option(opening).empty()) {
    if (!opening.parachute.tape.material) take_tape(tape_material(opening), opening);
    deployed = flow.speed_m_s;
    return;
  }
  if (*deployed > fastest_stream)
    throw Error(ExitCode::usage,
                fmt::format("payload.deployment_speed_m_s = {:g}: an opening can be computed up to {:g} m/s, "
                            "below Mach 0.3; give a lower speed with --speed",
                            *deployed, fastest_stream));
  if (!flow.density_kg_m3 && !flow.height_m) flow.density_kg_m3 = air(opening).density;
  flow.speed_m_s = deployed, flow.speed_basis = SpeedBasis::nominal;
  opening.origins.erase("flow.speed_m_s");
}

}  // namespace

DeploymentSpeed opening_speed(const Settings& opening) {
  const double speed = opening.flow().speed_m_s;
  if (const std::string option = speed_option(opening.written()); !option.empty())
    return {speed, "flow.speed_m_s, given by " + option};
  return deployment_speed(opening.payload()).value_or(DeploymentSpeed{speed, "flow.speed_m_s of the case"});
}

Case opening_case(const Case& given) {
  Case opening = foldable_case(given);
  take_opening_speed(opening);
  return opening;
}

Case foldable_case(const Case& given) {
  Case opening = given;
  const InflationSettings& inflation = opening.inflation;
  const auto wrinkle = [&](auto& material) {
    if (inflation.cloth_compression) {
      material.compression = *inflation.cloth_compression;
      material.buckling_strain = 1;  // at any strain
    } else if (!material.buckling_strain) {
      material.buckling_strain = wrinkling_strain;
    }
  };
  for (auto& [name, material] : opening.materials) {
    if (auto* fabric = std::get_if<Fabric>(&material)) wrinkle(*fabric);
    if (auto* tape = std::get_if<Tape>(&material)) wrinkle(*tape);
  }
  MeshSettings& mesh = opening.parachute.mesh;
  mesh.sewn_straight = false;  // chords of curved seams would strain the folded start
  mesh.line_segment_m = inflation.line_segment_m.value_or(mesh.line_segment_m);
  if (inflation.air == AirModel::coupled) {
    if (!inflation.cloth_damping_s) opening.inflation.cloth_damping_s = coupled_cloth_damping;
    if (opening.deployment) close_mouth(opening.parachute, opening.inflation);
  }
  mesh.folds = inflation.folds > 0 ? inflation.folds : opening.parachute.lines.count;
  return opening;
}

OpeningAir opening_air(const Settings& resolved, std::optional<double> height, std::optional<double> ground) {
  const FlowSettings& flow = resolved.flow();
  const Source& source = resolved.source("flow.density_kg_m3");
  OpeningAir air{flow.height_m.value_or(nearest_standard_height(flow.density_kg_m3)), flow.density_kg_m3,
                 flow.height_m  ? fmt::format("flow.height_m = {:g} m of the case", *flow.height_m)
                 : source.given ? "flow.density_kg_m3 of the case"
                                : source.from};
  const bool below = !height && ground && air.height < *ground;
  if (below) air.height = *ground;
  if (!height && !(below && flow.height_m)) return air;
  if (height) air.height = *height;
  const double own = std::exchange(air.density, standard_air(air.height).density);
  air.from = height ? "the standard atmosphere at the given height"
                    : "the standard atmosphere at the ground, which is above flow.height_m of the case";
  if (height && rounded(own) != rounded(air.density))
    air.from += fmt::format(", in place of the {} kg/m3 of the case", rounded(own));
  return air;
}

LoadSource load_source(const Settings& opening) {
  const InflationSettings& inflation = opening.inflation();
  if (inflation.air == AirModel::coupled) {
    const auto deployment = deployment_of(opening);
    if (!deployment || deployment->stopped)
      return {fmt::format("coupled flow at {:g} m/s", opening.flow().speed_m_s), {}};
    return {fmt::format("coupled flow at {:.4g} m/s, the speed after the deployment",
                        start_of_opening(*deployment, opening).payload_speed),
            {}};
  }
  if (inflation.pressure_pa.has_value() == inflation.drag_coefficient.has_value()) {
    throw Error(ExitCode::usage,
                std::string(inflation.pressure_pa ? "the pressure is given twice: give only one"
                                                  : "the pressure is missing: give one") +
                    " of inflation.pressure_pa, inflation.drag_coefficient, --pressure or --steady RUN, or "
                    "compute the flow with inflation.air = \"coupled\"");
  }
  if (inflation.pressure_pa) return {fmt::format("given: {:g} Pa", *inflation.pressure_pa), {}};
  const double speed = opening.flow().speed_m_s;
  const double q = 0.5 * opening.flow().density_kg_m3 * speed * speed;
  const double drag = *inflation.drag_coefficient * nominal_area(opening.parachute()) * q;
  return {fmt::format("C_D = {:g} at {:g} m/s: {} N", *inflation.drag_coefficient, speed, rounded(drag)),
          drag};
}

namespace {

/// Canopies that would not open within the inflation.
void check_delays(const ClusterKeys& keys, const InflationSettings& inflation) {
  for (std::size_t k = 0; k < keys.delays_s.size(); ++k)
    if (!(keys.delays_s[k] < inflation.duration_s))
      throw Error(
          ExitCode::usage,
          fmt::format("cluster.delays_s[{}] = {:g}: must be below inflation.duration_s = {:g} s, "
                      "because the canopy would not open; shorten the delay or prolong the inflation. "
                      "For a canopy that fails, see docs/guide/cluster-of-canopies.md",
                      k, keys.delays_s[k], inflation.duration_s));
}

/// Canopies of several sizes. Returns the mass beyond that of their meshes [kg].
double take_sizes(const Settings& opening, InflationProblem& problem) {
  double beyond = 0;
  for (int k = 0; k < canopy_count(opening.written()); ++k) {
    const Settings canopy = canopy_settings(opening, k);
    problem.sizes.push_back({parachute_mesh(canopy), size_ratio(opening.written(), k)});
    beyond += mass_beyond(problem.sizes.back().mesh, canopy);
  }
  return beyond;
}

/// Throws Error(usage) for settings that the opening of a cluster cannot have.
void check_cluster_opening(const Settings& opening) {
  const Case& given = opening.written();
  if (!given.cluster) return;
  const auto refuse = [](const char* text) { throw Error(ExitCode::usage, text); };
  if (opening.inflation().air != AirModel::coupled)
    refuse(
        "inflation.air = \"uniform\": the opening of a cluster needs the flow between its canopies; set "
        "inflation.air = \"coupled\", or compute one canopy (--unset cluster)");
  if (!opening.inflation().reefing.empty())
    refuse(
        "inflation.reefing: reefing lines are computed for one canopy only; remove them, or compute one "
        "canopy (--unset cluster)");
  if (given.deployment)
    refuse(
        "deployment: the opening of a cluster begins with folded canopies outside of their container; remove "
        "the table and give inflation.initial_radius_m, or compute one canopy (--unset cluster)");
  check_delays(*given.cluster, opening.inflation());
}

}  // namespace

InflationProblem opening_problem(const Settings& opening, const LoadSource& source, int threads,
                                 const std::function<void()>& alive) {
  require_axial_stream(opening.flow(), "an opening");
  check_cluster_opening(opening);
  InflationProblem problem;
  if (const auto& keys = opening.written().cluster)
    problem.cluster = layout_of(*keys), problem.delays = keys->delays_s;
  problem.mesh = parachute_mesh(opening);
  double beyond = canopy_count(opening.written()) * mass_beyond(problem.mesh, opening);
  if (!equal_canopies(opening.written())) beyond = take_sizes(opening, problem);
  problem.settings = opening.inflation();
  if (opening.inflation().air == AirModel::coupled) {
    const Cost cost = cost_of(opening);
    require_memory(cost.memory, fmt::format("a coupled inflation with {:.3g} cells", cost.cells),
                   canopy_count(opening.written()));
    problem.air = AirProblem{flow_problem(opening), opening.inflation().courant};
    // The inertia of hems and allowances counts at the payload, so that the cloth keeps that of its area.
    if (opening.inflation().mass == InflationSettings::Mass::payload)
      problem.air->payload =
          Payload{*opening.payload().mass_kg + beyond, standard_gravity, opening.inflation().flight_angle_deg,
                  opening.payload().drag_area_m2, density_below(opening.flow().height_m)};
    if (const auto deployment = deployment_of(opening)) start_from(*deployment, opening, problem);
    problem.settings.damping_n_s_m3 = problem.settings.quadratic_damping_n_s2_m4 = 0;
  } else {
    problem.pressure = pressure_of(opening, source, threads, alive);
  }
  const std::vector<ReefingStage>& stages = opening.inflation().reefing;
  for (std::size_t i = 0; i < stages.size(); ++i)
    problem.reefing.push_back(
        {stages[i].line_m, stages[i].cut_s, {opening.reefing_lines()[i].coefficients_n, 0}});
  problem.linear = opening.coupling().linear;
  problem.threads = threads;
  problem.symmetry = std::gcd(opening.parachute().gores, opening.parachute().lines.count);
  return problem;
}

}  // namespace ripstop::inline cases

#include "ripstop/case/flying.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ripstop/case/assemble.h"
#include "ripstop/case/cluster.h"
#include "ripstop/case/cost.h"
#include "ripstop/case/flight_cells.h"
#include "ripstop/case/opening.h"
#include "ripstop/case/payload.h"
#include "ripstop/case/resolve.h"
#include "ripstop/core/error.h"
#include "ripstop/core/words.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/descent.h"
#include "ripstop/parachute/fold.h"

namespace ripstop::inline cases {
namespace {

// The flight begins with the equilibrium on the axis and does not depend on its last percent.
constexpr int start_flow_iterations = 100, start_average = 30, start_iterations = 12;
constexpr double least_pressure = 2;    // dynamic pressure over the weight of the cloth an area
constexpr double least_payload = 0.25;  // over the mass of the parachute; below it the lines are hardly taut

void refuse(const std::string& text) {
  throw Error(ExitCode::usage, text);
}

void check_flight_keys(const Case& given) {
  const FlightSettings& s = given.flight;
  if (!given.payload.mass_kg)
    refuse("payload.mass_kg is not given: a flight needs a payload; set it in the case or by --mass KG");
  if (given.flow.tunnel.kind != TunnelKind::free_air)
    refuse("flow.tunnel.kind: a flight needs free air; remove [flow.tunnel]");
  if (given.flow.angle_of_attack_deg != 0)
    refuse(
        "flow.angle_of_attack_deg: the direction of the stream follows from the flight; leave it out "
        "(flight.angle_deg is the angle at the start)");
  if (std::abs(s.wind.speed_m_s) + std::abs(s.wind.gust_m_s) > fastest_stream)
    refuse(
        fmt::format("flight.wind: {:g} m/s and a gust of {:g} m/s are above Mach 0.3; at most {:g} m/s "
                    "together",
                    s.wind.speed_m_s, s.wind.gust_m_s, fastest_stream));
  if (s.velocity_m_s &&
      norm(*s.velocity_m_s) + std::abs(s.wind.speed_m_s) + std::abs(s.wind.gust_m_s) > fastest_stream)
    refuse(fmt::format(
        "flight.velocity_m_s: {:.4g} m/s and the wind are above Mach 0.3; at most {:g} m/s together",
        norm(*s.velocity_m_s), fastest_stream));
  if (s.wind.exponent > 0 && !s.height_m)
    refuse(
        "flight.wind.exponent: a profile over height needs the height of the payload at the start "
        "(flight.height_m or --height)");
  if (given.cluster && s.start == FlightSettings::Start::inflation)
    refuse(
        "flight.start = \"inflation\": the flight of a cluster starts in equilibrium at "
        "cluster.spread_angle_deg; leave out --deploy or set flight.start = \"steady\"");
  const std::vector<ReefingStage>& reefing = given.inflation.reefing;
  if (s.start == FlightSettings::Start::inflation && !reefing.empty() &&
      reefing.back().cut_s >= given.inflation.duration_s)
    refuse(
        fmt::format("inflation.reefing[{}].cut_s = {:g}: must be below inflation.duration_s = {:g} s, "
                    "because a flight continues from an open canopy; cut the line earlier, or prolong the "
                    "inflation",
                    reefing.size() - 1, reefing.back().cut_s, given.inflation.duration_s));
}

/// One case for both: the flow of the opening is that of the flight.
Case deployed_case(Case flight) {
  flight.inflation.air = AirModel::coupled;
  flight.inflation.mass = InflationSettings::Mass::payload;
  if (!flight.inflation.initial_radius_m && !flight.deployment) flight.deployment.emplace();
  flight = opening_case(flight);
  if (!flight.flow.sides) flight.flow.sides = Sides::far_field;
  take_flight_cells(flight, cells_for_folds(flight));
  return flight;
}

void refuse_other_payload(const Case& given, const Case& opening) {
  const auto differs = [](const char* key, double here, double there) {
    if (here != there)
      refuse(fmt::format("payload.{} = {:g}: the inflation has {:g}; use the payload of the inflation", key,
                         here, there));
  };
  differs("mass_kg", *given.payload.mass_kg, opening.payload.mass_kg.value_or(0));
  differs("drag_area_m2", given.payload.drag_area_m2, opening.payload.drag_area_m2);
}

/// At which the usual drag of the family carries the payload [m/s].
double usual_rate(const Settings& flight) {
  const double area = area_ratio(flight.written()) * usual_drag_coefficient(flight.parachute()) *
                          nominal_area(flight.parachute()) +
                      flight.payload().drag_area_m2;
  return terminal_speed(*flight.payload().mass_kg + mass_of_canopies(flight), area,
                        flight.flow().density_kg_m3);
}

/// Everything but the start.
FlightProblem problem_at(const Settings& flight, double rate, int threads) {
  const FlowSettings& stream = flight.flow();
  if (stream.porosity_model != PorosityModel::sheet)
    refuse("flow.porosity_model: a flight needs the \"sheet\" model; give the cloth an air permeability");
  if (stream.sides != Sides::far_field)
    refuse("flow.sides: in flight the air comes from any direction; leave it out or set it to \"far-field\"");
  const Cost cost = cost_of(flight);
  require_memory(cost.memory, fmt::format("a flight in {:.3g} cells of air", cost.cells),
                 canopy_count(flight.written()));
  const double dynamic = 0.5 * stream.density_kg_m3 * rate * rate,
               weight = flight.materials().canopy.areal_density_kg_m2 * standard_gravity;
  if (dynamic < least_pressure * weight)
    refuse(fmt::format(
        "payload.mass_kg = {:g}: at its rate of descent of {:.3g} m/s the dynamic pressure of "
        "{:.3g} Pa does not carry the weight of the cloth ({:.3g} Pa); a heavier payload or a smaller "
        "canopy is needed",
        *flight.payload().mass_kg, rate, dynamic, weight));
  FlightProblem problem;
  problem.mesh = parachute_mesh(flight);
  problem.air = {flow_problem(flight), flight.flight().courant};
  problem.settings = flight.flight();
  problem.cloth = flight.inflation();
  problem.payload_mass = *flight.payload().mass_kg;
  problem.payload_drag_area = flight.payload().drag_area_m2;
  problem.gravity = standard_gravity;
  if (stream.height_m)
    problem.density_ratio = [from = *stream.height_m](double fallen) { return density_ratio(from, fallen); };
  problem.linear = flight.coupling().linear;
  problem.threads = threads;
  return problem;
}

}  // namespace

Case flight_case(const Case& given) {
  check_flight_keys(given);
  if (given.flight.start == FlightSettings::Start::inflation) return deployed_case(given);
  Case flight = foldable_case(given);
  flight.flow.speed_m_s.reset();  // that at which drag is weight
  flight.flow.unsteady = false;
  if (!flight.flow.max_iterations) flight.flow.max_iterations = start_flow_iterations;
  if (!flight.flow.average_over)
    flight.flow.average_over = std::min(start_average, *flight.flow.max_iterations);
  if (!given.origins.contains("coupling.max_iterations"))
    flight.coupling.max_iterations = std::min(start_iterations, given.coupling.max_iterations);
  if (!flight.flow.sides) flight.flow.sides = Sides::far_field;
  take_flight_cells(flight, flight.flight.cells_across);
  return flight;
}

Case continued_case(const Case& given, const Settings& opening) {
  check_flight_keys(given);
  Case flight = opening.written();
  if (const auto& cluster = given.cluster ? given.cluster : flight.cluster)
    refuse(fmt::format(
        "cluster.canopies = {}: a flight of a cluster starts in equilibrium, not from an inflation; leave "
        "out --from, or compute one canopy (--unset cluster)",
        cluster->canopies));
  refuse_other_payload(given, flight);
  flight.title = given.title, flight.flight = given.flight;
  flight.flight.start = FlightSettings::Start::inflation;
  flight.flow.sides = Sides::far_field;
  if (!given.origins.contains("flight.cells_across")) return flight;
  FlowKeys& flow = flight.flow;  // other cells about the canopy in the same place
  flow.cells.reset(), flow.box_m.reset();
  flow.core.size_m.reset(), flow.core.start_m.reset(), flow.core.growth.reset();
  take_flight_cells(flight, given.flight.cells_across);
  return flight;
}

void require_payload(const Settings& flight) {
  const double payload = *flight.payload().mass_kg, least = least_payload * mass_of_canopies(flight);
  if (payload >= least) return;
  const auto [given, needed] = rounded_apart(payload, least);
  refuse(fmt::format(
      "payload.mass_kg = {}: must be at least {} kg, a quarter of the mass of its parachute{}, because a "
      "lighter payload does not keep the lines taut; use a heavier payload or a smaller canopy",
      given, needed, flight.written().cluster ? "s" : ""));
}

FlightProblem flight_problem(const Settings& flight, std::vector<Vec3> shape, std::vector<double> pressure,
                             int threads) {
  FlightProblem problem = problem_at(flight, flight.flow().speed_m_s, threads);
  problem.shape = std::move(shape), problem.pressure = std::move(pressure);
  if (flight.written().cluster) {
    JoinedCluster joined = join_risers(cluster_as_cut(flight).mesh());
    problem.shape = joined.joined(problem.shape);
    problem.mesh = std::move(joined.mesh);
  } else {
    problem.mesh = mesh_as_cut(std::move(problem.mesh), flight);
  }
  return problem;
}

FlightProblem flight_problem(const Settings& flight, const OpeningEnd& end, int threads) {
  const double rate = usual_rate(flight);
  FlightProblem problem = problem_at(flight, rate, threads);
  problem.payload_mass += mass_beyond(problem.mesh, flight);  // as in the opening
  FoldedStart folded;
  folded.positions = end.folded, folded.folds = end.folds;
  problem.mesh = with_creases(problem.mesh, folded);
  problem.air.flow.air.velocity = {0, 0, end.air_speed};
  problem.from = end, problem.descent_speed = rate;
  return problem;
}

}  // namespace ripstop::inline cases

#include "ripstop/case/opening.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>

#include "ripstop/case/assemble.h"
#include "ripstop/case/cost.h"
#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/fsi/pressure.h"

namespace ripstop {
namespace {

// The equilibrium that turns a drag into a pressure is found on a mesh of at most so many nodes: its area
// differs by a few parts of a thousand.
constexpr int equilibrium_nodes = 3000;

double pressure_of(const Case& opening, const LoadSource& source, int threads,
                   const std::function<void()>& alive) {
  if (!source.steady_drag) return *opening.inflation.pressure_pa;
  Case coarse = opening;
  coarse.parachute.mesh.cloth_nodes = std::min(equilibrium_nodes, opening.parachute.mesh.cloth_nodes);
  ThreadTeam team(threads);
  return pressure_for(*source.steady_drag, parachute_mesh(coarse), opening.coupling.linear, team, alive)
      .pressure;
}

/// Payload::density in the standard atmosphere, where the case says how high it begins.
std::function<double(double)> density_below(const std::optional<double>& height) {
  if (!height) return {};
  return [from = *height](double fallen) {
    return standard_air(std::max(from - fallen, lowest_height)).density / standard_air(from).density;
  };
}

}  // namespace

Case opening_case(const Case& given) {
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
  mesh.line_segment_m = *resolve(given).written.inflation.line_segment_m;
  mesh.folds = inflation.folds > 0 ? inflation.folds : opening.parachute.lines.count;
  return opening;
}

LoadSource load_source(const Case& given) {
  const InflationSettings& inflation = given.inflation;
  if (inflation.air == AirModel::coupled)
    return {fmt::format("the air at {:g} m/s, stepped with the cloth", air(given).speed), {}};
  if (inflation.pressure_pa.has_value() == inflation.drag_coefficient.has_value()) {
    throw Error(ExitCode::usage,
                "give the pressure once: inflation.pressure_pa, inflation.drag_coefficient, --pressure "
                "or --steady RUN");
  }
  if (inflation.pressure_pa) return {fmt::format("given: {:g} Pa", *inflation.pressure_pa), {}};
  const Air stream = air(given);
  const double q = 0.5 * stream.density * stream.speed * stream.speed;
  const double drag = *inflation.drag_coefficient * nominal_area(given.parachute) * q;
  return {fmt::format("C_D = {:g} at {:g} m/s: {:.4g} N", *inflation.drag_coefficient, stream.speed, drag),
          drag};
}

InflationProblem opening_problem(const Case& opening, const LoadSource& source, int threads,
                                 const std::function<void()>& alive) {
  InflationProblem problem;
  problem.mesh = parachute_mesh(opening);
  problem.settings = opening.inflation;
  if (opening.inflation.air == AirModel::coupled) {
    const Cost cost = cost_of(opening);
    require_memory(cost.memory, fmt::format("an opening in {:.3g} cells of air", cost.cells));
    problem.air = AirProblem{flow_problem(opening), opening.inflation.courant};
    if (opening.inflation.mass == InflationSettings::Mass::payload)
      problem.air->payload =
          Payload{*opening.payload.mass_kg, standard_gravity, opening.inflation.flight_angle_deg,
                  opening.payload.drag_area_m2, density_below(opening.flow.height_m)};
    problem.settings.damping_n_s_m3 = problem.settings.quadratic_damping_n_s2_m4 = 0;
  } else {
    problem.pressure = pressure_of(opening, source, threads, alive);
  }
  for (const ReefingStage& stage : opening.inflation.reefing) {
    const Line& line = reefing_line(opening, stage);
    problem.reefing.push_back({stage.line_m, stage.cut_s, {line.coefficients_n, 0}});
  }
  problem.linear = opening.coupling.linear;
  problem.threads = threads;
  problem.symmetry = std::gcd(opening.parachute.gores, opening.parachute.lines.count);
  return problem;
}

}  // namespace ripstop

#include "opening.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "case_options.h"
#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/inflation/pressure.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

// The equilibrium that turns a drag into a pressure is found on a mesh of at most so many nodes: its area
// differs by a few parts of a thousand.
constexpr int equilibrium_nodes = 3000;

double drag_of_run(const fs::path& folder) {
  const fs::path file = folder / "result.json";
  try {
    const auto result = nlohmann::json::parse(read_file(file));
    if (!result.value("converged", false)) {
      throw Error(ExitCode::bad_data, fmt::format("{}: the steady run has not converged", file.string()));
    }
    return result.at("drag_n").get<double>();
  } catch (const nlohmann::json::exception& error) {
    throw Error(ExitCode::bad_data,
                fmt::format("{}: not the result of ripstop steady ({})", file.string(), error.what()));
  }
}

double pressure_of(const Case& value, const LoadSource& source, int threads) {
  if (!source.steady_drag) return *value.inflation.pressure_pa;
  Case coarse = value;
  coarse.parachute.mesh.cloth_nodes = std::min(equilibrium_nodes, value.parachute.mesh.cloth_nodes);
  ThreadTeam team(threads);
  return pressure_for(*source.steady_drag, parachute_mesh(coarse), value.coupling.linear, team).pressure;
}

}  // namespace

void add_opening_options(CLI::App& command, OpeningOptions& options) {
  command.add_option("case", options.case_file, "Case file (TOML) with an [inflation] table")->required();
  command
      .add_option("--steady", options.steady_run, "Run folder of ripstop steady: its drag sets the pressure")
      ->check(CLI::ExistingDirectory);
  command.add_option("--pressure", options.pressure, "Pressure difference over the canopy [Pa]")
      ->check(CLI::PositiveNumber);
  command.add_option("--duration", options.duration, "Time from deployment to the end [s]")
      ->check(CLI::PositiveNumber);
  command.add_option("--cloth-nodes", options.cloth_nodes, "Nodes of the cloth aimed at")
      ->check(CLI::Range(500, 2000000));
  command.add_option("--speed", options.overrides.speed, "Nominal speed [m/s]");
  add_set_option(command, options.overrides);
  command.add_option("--threads", options.threads, "Threads (default: as in [coupling])")
      ->check(CLI::Range(1, 1024));
}

Case opening_case(const OpeningOptions& options) {
  Case value = read_case(options.case_file, options.overrides);
  InflationSettings& inflation = value.inflation;
  if (options.cloth_nodes) value.parachute.mesh.cloth_nodes = *options.cloth_nodes;
  if (options.damping) inflation.damping_n_s_m3 = *options.damping;
  if (options.duration) inflation.duration_s = *options.duration;
  if (options.pressure) inflation.pressure_pa = *options.pressure;
  if (options.pressure || !options.steady_run.empty()) inflation.drag_coefficient.reset();
  if (!options.steady_run.empty()) inflation.pressure_pa.reset();
  if (inflation.cloth_compression) {
    const auto push = [&](auto& material) {
      material.compression = *inflation.cloth_compression;
      material.buckling_strain = 1;  // at any strain
    };
    for (auto& [name, material] : value.materials) {
      if (auto* fabric = std::get_if<Fabric>(&material)) push(*fabric);
      if (auto* tape = std::get_if<Tape>(&material)) push(*tape);
    }
  }
  // Chords of curved seams would strain the folded start.
  value.parachute.mesh.sewn_straight = false;
  if (value.inflation.line_segment_m) value.parachute.mesh.line_segment_m = *value.inflation.line_segment_m;
  value.parachute.mesh.folds = inflation.folds > 0 ? inflation.folds : value.parachute.lines.count;
  return value;
}

int threads_of(const OpeningOptions& options, const Case& value) {
  return options.threads > 0 ? options.threads : value.coupling.threads;
}

LoadSource load_source(const Case& value, const fs::path& steady_run) {
  const InflationSettings& inflation = value.inflation;
  const int given =
      !steady_run.empty() + inflation.pressure_pa.has_value() + inflation.drag_coefficient.has_value();
  if (given != 1) {
    throw Error(ExitCode::usage,
                "give the pressure once: inflation.pressure_pa, inflation.drag_coefficient, --pressure "
                "or --steady RUN");
  }
  if (inflation.pressure_pa) return {fmt::format("given: {:g} Pa", *inflation.pressure_pa), {}};
  if (!steady_run.empty()) {
    const double drag = drag_of_run(steady_run);
    return {fmt::format("steady run {}: {:.4g} N", steady_run.string(), drag), drag};
  }
  const Air stream = air(value);
  const double q = 0.5 * stream.density * stream.speed * stream.speed;
  const double drag = *inflation.drag_coefficient * nominal_area(value.parachute) * q;
  return {fmt::format("C_D = {:g} at {:g} m/s: {:.4g} N", *inflation.drag_coefficient, stream.speed, drag),
          drag};
}

InflationProblem opening_problem(const Case& value, const LoadSource& source, int threads) {
  return {
      parachute_mesh(value), value.inflation, pressure_of(value, source, threads),
      value.coupling.linear, threads,         std::gcd(value.parachute.gores, value.parachute.lines.count)};
}

}  // namespace ripstop

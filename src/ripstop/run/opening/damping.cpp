#include "ripstop/run/opening/damping.h"

#include <fmt/format.h>

#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/plot.h"
#include "ripstop/run/json.h"
#include "ripstop/run/run_folder.h"

namespace ripstop::inline run {

std::string to_json(const DampingResult& result) {
  return json_text(result);
}

DampingTarget damping_target(const Settings& resolved) {
  if (!resolved.inflation().measured_peak_n)
    throw Error(ExitCode::usage, "inflation.measured_peak_n is missing; it is required for the calibration");
  return {*resolved.inflation().measured_peak_n, resolved.inflation().measured_inflation_time_s};
}

DampingResult run_damping(const Settings& resolved, const LoadSource& source, const InflationProblem& problem,
                          const DampingSearch& search, const std::function<void(const DampingTrial&)>& report,
                          const std::function<void()>& alive) {
  if (problem.air) throw Error(ExitCode::usage, "inflation.air = \"coupled\" has no damping to calibrate");
  DampingResult result;
  result.title = resolved.title();
  result.inputs_hash = inputs_hash(
      resolved, fmt::format("damping {} to {}, {} points, {} refinements; pressure {} from {}", search.from,
                            search.to, search.points, search.refinements, problem.pressure, source.text));
  result.target = damping_target(resolved);
  result.found = calibrate_damping(
      result.target, search, [&](double damping) { return open_with(damping, problem, alive); }, report);
  result.low_pass_hz = problem.settings.low_pass_hz;
  result.pressure = problem.pressure;
  result.pressure_from = source.text, result.warnings = source.warnings;
  result.nodes = problem.mesh.node_count();
  return result;
}

void write_damping(const std::filesystem::path& folder, const DampingResult& result) {
  make_results_folder(folder, "calibrate");
  CsvTable table{columns_of<DampingTrial>(), {}};
  PlotSeries misfit{"misfit", {}, {}}, peak{"error of the peak", {}, {}};
  for (const DampingTrial& t : result.found.trials) {
    table.rows.push_back(row_of(t));
    misfit.x.push_back(t.damping);
    misfit.y.push_back(100 * t.misfit);
    peak.x.push_back(t.damping);
    peak.y.push_back(100 * (t.peak / result.target.peak - 1));
  }
  write_csv(folder / "damping.csv", table);
  write_plot(folder / "misfit.png", {result.title, {"damping C_a [N s/m³]"}, {"error [%]"}, {misfit, peak}});
  write_file(folder / "result.json", to_json(result));
}

}  // namespace ripstop::inline run

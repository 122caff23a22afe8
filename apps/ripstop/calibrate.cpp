// ripstop calibrate: constants of the model from measurements on a reference parachute.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "opening.h"
#include "progress.h"
#include "ripstop/calibration/damping.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/plot.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

struct Options {
  OpeningOptions opening;
  DampingSearch search;
  fs::path out;
};

std::string trial_text(const DampingTrial& t) {
  return fmt::format(
      "C_a {:8.4f}   peak {:8.2f} N at {:6.2f} ms   every step {:8.1f} N   settled {}   misfit {:.4f}",
      t.damping, t.peak, 1000 * t.peak_time, t.every_step_peak,
      t.inflation_time ? fmt::format("{:6.1f} ms", 1000 * *t.inflation_time) : "not yet", t.misfit);
}

void write_files(const fs::path& folder, const DampingCalibration& found, const DampingTarget& target,
                 const InflationProblem& problem, const LoadSource& source, const Case& value) {
  make_folder(folder);
  CsvTable table{
      {"damping_n_s_m3", "peak_n", "peak_time_s", "every_step_peak_n", "inflation_time_s", "misfit"}, {}};
  PlotSeries misfit{"misfit", {}, {}}, peak{"error of the peak", {}, {}};
  for (const DampingTrial& t : found.trials) {
    table.rows.push_back(
        {t.damping, t.peak, t.peak_time, t.every_step_peak, t.inflation_time.value_or(NAN), t.misfit});
    misfit.x.push_back(t.damping);
    misfit.y.push_back(100 * t.misfit);
    peak.x.push_back(t.damping);
    peak.y.push_back(100 * (t.peak / target.peak - 1));
  }
  write_csv(folder / "damping.csv", table);
  write_plot(folder / "misfit.png", {value.title, {"C_a [N s/m3]"}, {"error [%]"}, {misfit, peak}});
  nlohmann::ordered_json j;
  j["title"] = value.title;
  j["damping_n_s_m3"] = found.best.damping;
  j["misfit"] = found.best.misfit;
  j["peak_load_n"] = found.best.peak;
  j["measured_peak_n"] = target.peak;
  j["every_step_peak_n"] = found.best.every_step_peak;
  j["low_pass_hz"] = problem.settings.low_pass_hz;
  if (target.inflation_time) j["measured_inflation_time_s"] = *target.inflation_time;
  if (found.best.inflation_time) j["inflation_time_s"] = *found.best.inflation_time;
  j["pressure_pa"] = problem.pressure;
  j["pressure_from"] = source.text;
  j["nodes"] = problem.mesh.node_count();
  j["best_is_at_the_edge"] = found.at_edge;
  write_file(folder / "result.json", j.dump(2) + "\n");
}

int calibrate(const Options& options) {
  const Case value = opening_case(options.opening);
  if (!value.inflation.measured_peak_n) {
    throw Error(ExitCode::usage, "inflation.measured_peak_n is not given: nothing to calibrate on");
  }
  const DampingTarget target{*value.inflation.measured_peak_n, value.inflation.measured_inflation_time_s};
  const LoadSource source = load_source(value, options.opening.steady_run);
  const InflationProblem problem = opening_problem(value, source, threads_of(options.opening, value));
  Progress progress;
  progress.line(
      fmt::format("{}: measured peak {:.1f} N{}; dp {:.2f} Pa ({}), {} nodes", value.title, target.peak,
                  target.inflation_time ? fmt::format(", inflation time {:g} s", *target.inflation_time)
                                        : ", no inflation time",
                  problem.pressure, source.text, problem.mesh.node_count()));
  const DampingCalibration found = calibrate_damping(
      target, options.search, [&](double damping) { return open_with(damping, problem); },
      [&](const DampingTrial& trial) { progress.line(trial_text(trial)); });
  const fs::path folder =
      options.out.empty()
          ? fs::path("runs") / (options.opening.case_file.parent_path().filename().string() + "-damping")
          : options.out;
  write_files(folder, found, target, problem, source, value);
  fmt::print("C_a = {:.4f} N s/m3, misfit {:.2f} %; {}\n", found.best.damping, 100 * found.best.misfit,
             (folder / "misfit.png").string());
  if (!found.at_edge) return 0;
  fmt::print(stderr, "the best C_a lies at the edge of {:g} .. {:g}: widen the range with --from and --to\n",
             options.search.from, options.search.to);
  return static_cast<int>(ExitCode::not_converged);
}

void add_damping(CLI::App& parent, int& status) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      parent.add_subcommand("damping", "C_a from the measured opening load of a reference parachute");
  command->footer("Example: ripstop calibrate damping examples/stratos-iv/case.toml --cloth-nodes 3000");
  add_opening_options(*command, options->opening);
  command->add_option("--from", options->search.from, "Smallest C_a [N s/m3]")->check(CLI::PositiveNumber);
  command->add_option("--to", options->search.to, "Largest C_a [N s/m3]")->check(CLI::PositiveNumber);
  command->add_option("--points", options->search.points, "Openings at equal ratios of C_a")
      ->check(CLI::Range(3, 1000));
  command->add_option("--refinements", options->search.refinements, "Openings about the best of them")
      ->check(CLI::Range(0, 1000));
  command->add_option("--out", options->out,
                      "Folder of the result (default: runs/<folder of the case>-damping)");
  command->callback([options, &status] { status = calibrate(*options); });
}

}  // namespace

void add_calibrate(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("calibrate", "Constants of the model from a reference parachute");
  command->require_subcommand(1);
  add_damping(*command, status);
  add_calibrate_porosity(*command, status);
}

}  // namespace ripstop

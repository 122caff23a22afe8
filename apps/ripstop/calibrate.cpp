// ripstop calibrate: constants of the model from measurements on a reference parachute.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "json_option.h"
#include "number_option.h"
#include "opening.h"
#include "progress.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/error.h"
#include "ripstop/run/opening/damping.h"
#include "ripstop/run/run_folder.h"
#include "warnings.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct CalibrateArguments {
  OpeningOptions opening;
  DampingSearch search;
  fs::path out;
  bool json = false;
};

std::string trial_text(const DampingTrial& t) {
  return fmt::format(
      "C_a {:8.4f} N s/m3, peak {:8.2f} N at {:6.2f} ms, unfiltered {:8.1f} N, inflation time {}, misfit "
      "{:.2f} %",
      t.damping, t.peak, 1000 * t.peak_time, t.every_step_peak,
      t.inflation_time ? fmt::format("{:6.1f} ms", 1000 * *t.inflation_time) : "not reached", 100 * t.misfit);
}

int calibrate(const CalibrateArguments& options) {
  check_search(options.search);
  const Settings resolved = opening_settings(options.opening);
  const DampingTarget target = damping_target(resolved);
  const LoadSource source = load_source(resolved, options.opening.steady_run);
  const InflationProblem problem = opening_problem(resolved, source, threads_of(options.opening, resolved));
  const fs::path folder =
      options.out.empty() ? default_run_folder(options.opening.case_file, "damping") : options.out;
  make_results_folder(folder, "calibrate");
  Progress progress;
  progress.line(fmt::format(
      "{}: measured peak {:.1f} N{}; pressure {:.2f} Pa ({}), {} nodes", resolved.title(), target.peak,
      target.inflation_time ? fmt::format(", inflation time {:g} s", *target.inflation_time)
                            : ", no measured inflation time",
      problem.pressure, source.text, problem.mesh.node_count()));
  const DampingResult result =
      run_damping(resolved, source, problem, options.search,
                  [&](const DampingTrial& trial) { progress.line(trial_text(trial)); });
  const DampingCalibration& found = result.found;
  write_damping(folder, result);
  if (options.json)
    fmt::print("{}", to_json(result));
  else
    fmt::print("C_a = {:.4f} N s/m3, misfit {:.2f} %; {}\n", found.best.damping, 100 * found.best.misfit,
               (folder / "misfit.png").string());
  print_warnings(result.warnings);
  if (!found.at_edge) return 0;
  fmt::print(stderr,
             "the best C_a is a limit of the searched range {:g} to {:g}: widen it with --from and --to\n",
             options.search.from, options.search.to);
  return static_cast<int>(ExitCode::not_converged);
}

void add_damping(CLI::App& parent, int& status) {
  auto options = std::make_shared<CalibrateArguments>();
  CLI::App* command = parent.add_subcommand(
      "damping", "Determine the damping C_a from the measured opening load of a reference parachute");
  command->footer("Example: ripstop calibrate damping examples/stratos-iv/case.toml --cloth-nodes 3000");
  add_opening_options(*command, options->opening);
  const Range damping = above(0).up_to(key_range("inflation.damping_n_s_m3").high);
  add_number(*command, "--from", options->search.from, damping, "Smallest C_a [N s/m3]");
  add_number(*command, "--to", options->search.to, damping, "Largest C_a [N s/m3]");
  add_number(*command, "--points", options->search.points, from(3).up_to(1000),
             "Number of openings at logarithmically spaced C_a");
  add_number(*command, "--refinements", options->search.refinements, from(0).up_to(1000),
             "Number of further openings around the best C_a");
  command->add_option("--out", options->out, "Folder of the result")
      ->default_str("runs/<name of the case>-damping");
  add_json_option(*command, options->json);
  command->callback([options, &status] { status = calibrate(*options); });
}

}  // namespace

void add_calibrate(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("calibrate", "Calibrate model constants with a reference parachute");
  command->require_subcommand(1);
  add_damping(*command, status);
  add_calibrate_porosity(*command, status);
}

}  // namespace ripstop::cli

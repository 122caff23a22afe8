// ripstop stability: coefficients over the angle of attack, and trim angles.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#include "batch_option.h"
#include "case_options.h"
#include "commands.h"
#include "json_option.h"
#include "number_option.h"
#include "progress.h"
#include "ripstop/core/error.h"
#include "ripstop/run/stability/stability_folder.h"
#include "steady_terminal.h"
#include "stopping.h"
#include "warnings.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct StabilityArguments {
  fs::path case_file;
  Overrides overrides;
  std::string angles = "0:40:5";
  StabilitySettings settings;
  BatchOptions batch;
  std::string only;  // one part, by its folder
  bool cold = false, gather = false, dry_run = false, json = false;
};

std::string with_error(double value, const std::optional<double>& error) {
  return error ? fmt::format("{:+.4f} +- {:.4f}", value, *error) : fmt::format("{:+.4f}", value);
}

std::string row_text(const StabilityRow& row) {
  return fmt::format("{:>9.4g} {:>18} {:>18} {:>18}", row.angle, with_error(row.c_t, row.c_t_error),
                     with_error(row.c_n, row.c_n_error), with_error(row.c_m, row.c_m_error));
}

std::string heading() {
  return fmt::format("{:>9} {:>18} {:>18} {:>18}", "angle deg", "C_T", "C_N", "C_m");
}

/// Rows and progress on standard error.
class StabilityTerminal : public StabilityObserver {
 public:
  StabilityTerminal(const fs::path& folder, std::size_t angles)
      : axis_(folder), folder_(folder), angles_(angles) {}

  SteadyObserver& axis() override { return axis_; }
  void begin(const StabilityResult& so_far, const std::string& engine) override {
    progress_.line(fmt::format("{}: {}, {} cells, {} across the projected diameter of {:.3f} m, {}",
                               so_far.title, engine, so_far.cells, so_far.cells_across,
                               so_far.projected_diameter, folder_.string()));
    progress_.line(heading());
    begin_ = Clock::now();
  }
  void warned(const std::string& text) override { progress_.line("warning: " + text); }
  void progress(std::size_t angle, const std::string& text, double share) override {
    // Angles that an earlier call computed give no estimate of the remaining time.
    const double behind = double(computed_) + std::min(0.99, share), spent = elapsed();
    const double remaining =
        behind > 0 ? spent / behind * (double(angles_ - ended_) - std::min(0.99, share)) : 0;
    progress_.show(
        fmt::format("{}/{} | {} | {:.0f} % | elapsed {}{}", angle + 1, angles_, text,
                    std::min(99.0, 100 * share), duration_text(spent),
                    remaining > 0 ? fmt::format(", remaining about {}", duration_text(remaining)) : ""));
  }
  void ended(std::size_t, const StabilityRow& row, bool earlier) override {
    ++ended_;
    if (!earlier) ++computed_;
    progress_.line(row_text(row));
  }

 private:
  using Clock = std::chrono::steady_clock;
  double elapsed() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

  SteadyTerminal axis_;
  Progress progress_;
  fs::path folder_;
  std::size_t angles_, ended_ = 0, computed_ = 0;
  Clock::time_point begin_ = Clock::now();
};

void print_result(const StabilityResult& r, const fs::path& folder) {
  fmt::print("\n{}\n", r.title);
  fmt::print(
      "  {:.4g} m/s, {:.4g} kg/m3; coefficients on S0 = {:.4f} m2, D0 = {:.4f} m, C_m about the confluence\n",
      r.speed, r.density, r.reference_area, r.reference_length);
  fmt::print(
      "  C_T: force along the axis of the canopy. C_N: force normal to it; positive: it reduces the angle of "
      "attack.\n"
      "  C_m: moment; positive: it increases the angle of attack. +- is one standard error.\n");
  fmt::print("{}\n", heading());
  for (const StabilityRow& row : r.rows) fmt::print("{}\n", row_text(row));
  if (r.trims.empty()) fmt::print("  no trim angle within these angles\n");
  for (const Trim& trim : r.trims)
    fmt::print(
        "  trim at {:.1f}{} deg: {}{}\n", trim.angle,
        trim.standard_error ? fmt::format(" +- {:.1f}", *trim.standard_error) : "",
        trim.stable ? "stable, C_m falls with the angle" : "unstable, C_m rises with the angle",
        trim.certain ? "" : " (not certain: C_m of a neighbouring angle is within two standard errors of 0)");
  fmt::print("  files: {} (stability.csv, six_dof.csv, stability.svg, report.html, result.json)\n",
             folder.string());
}

int write_scripts(const StabilityArguments& options, const Case& given, const std::vector<double>& angles) {
  StabilitySettings settings = options.settings;
  settings.elsewhere = true;
  BatchNeeds needs = steady_needs(in_full_domain(resolve(given)), options.batch.cores.value_or(0));
  const BatchSweep parts{batch_job(options.batch, settings.run.folder, needs),
                         stability_waves(given, angles, settings), 0};
  const std::vector<BatchFile> files = slurm_files(parts);
  prepare_stability(given, angles, settings);
  write_and_tell(settings.run.folder, files, "bash", "submit");
  fmt::print(
      "{} jobs, one after another if each starts from its neighbour; --cold runs all angles at the same "
      "time\n",
      parts.waves.size());
  return 0;
}

/// Prints a result; an angle that is missing is an error.
int finish(const StabilityArguments& options, const StabilityResult& result,
           const std::vector<std::string>& missing) {
  if (options.json)
    fmt::print("{}", to_json(result));
  else
    print_result(result, options.settings.run.folder);
  const int status = print_result_warnings(result.warnings, result.usable);
  if (!missing.empty())
    throw Error(ExitCode::io,
                fmt::format("{}: not computed yet; submit again, or repeat ripstop stability without "
                            "--gather",
                            fmt::join(missing, ", ")));
  return status;
}

int stability(StabilityArguments& options) {
  const std::vector<double> angles = angles_of_text(options.angles);
  StabilitySettings& settings = options.settings;
  settings.warm = !options.cold;
  const fs::path& folder = settings.run.folder;
  if (folder.empty()) settings.run.folder = default_run_folder(options.case_file, "stability");
  const Case given = read_given(options.case_file, options.overrides);
  if (options.batch.wanted()) return write_scripts(options, given, angles);
  if (options.dry_run) {
    check_stability(given, angles, settings);
    for (const auto& wave : stability_waves(given, angles, settings))
      for (const std::string& name : wave) fmt::print("{}\n", (folder / name).string());
    return 0;
  }
  StabilityTerminal terminal(folder, options.only.empty() ? angles.size() : 1);
  if (options.gather) {
    std::vector<std::string> missing;
    const StabilityResult result = gather_stability(given, angles, settings, missing, terminal);
    return finish(options, result, missing);
  }
  goes_on_when_repeated();
  if (!options.only.empty()) {
    run_stability_part(given, angles, settings, options.only, terminal);
    return 0;
  }
  return finish(options, run_stability(given, angles, settings, terminal), {});
}

}  // namespace

void add_stability(CLI::App& app, int& status) {
  auto options = std::make_shared<StabilityArguments>();
  options->settings.run.fields = false;
  CLI::App* command = app.add_subcommand(
      "stability", "Compute force and moment coefficients over the angle of attack, and trim angles");
  command->footer(
      "The canopy keeps the shape of a steady run on the axis; the stream arrives at the angle, and its "
      "force is averaged in time.\n"
      "C_T is along the canopy's axis, C_N normal to it (positive: reduces the angle), C_m about the "
      "confluence\n"
      "(positive: increases the angle); +- is one standard error. A trim angle has C_m = 0, and is stable "
      "where\n"
      "C_m falls with the angle. An interrupted run resumes when the command is repeated.\n"
      "Example: ripstop stability examples/flat-circular/case.toml --angles 0:40:5 --out runs/curve\n"
      "         ripstop stability examples/cross/case.toml --angles 0:30:10 --steady runs/cross\n"
      "         ripstop stability examples/cross/case.toml --flow openfoam --ranks 16 --batch slurm");
  command->add_option("case", options->case_file, "Case file (TOML)")->required();
  command->add_option("--angles", options->angles, "Angles of attack FROM:TO:STEP, or one angle [deg]");
  add_number(*command, "--cells-across", options->settings.across, from(8).up_to(100),
             "Number of flow cells across the projected diameter (ripstop fly: across the nominal one)");
  command
      ->add_option(
          "--steady", options->settings.steady,
          "Folder of a finished steady run of the same parachute, speed and density, which provides the "
          "shape")
      ->default_str("a run computed in OUT/axis");
  command->add_flag(
      "--equilibrium", options->settings.equilibrium,
      "The canopy deforms under the mean load of each angle, restrained at vent and confluence; "
      "without this option it is rigid, with the shape of the steady run on the axis");
  add_case_options(*command, options->overrides);
  add_flow_options(*command, options->overrides);
  command->add_flag("--cold", options->cold, "Start the flow of every angle from the uniform stream");
  command->add_option("--out", options->settings.run.folder, "Folder")
      ->default_str("runs/<name of the case>-stability");
  command->add_flag("--fresh", options->settings.run.fresh,
                    "Replace finished angles; without this option they are kept");
  CLI::Option* dry_run =
      command->add_flag("--dry-run", options->dry_run, "Print the folders of all parts, and stop");
  add_json_option(*command, options->json);
  CLI::Option* only =
      command
          ->add_option(
              "--only", options->only,
              "Compute one part of the curve, given by the name of its folder, as a job of --batch does")
          ->excludes(dry_run);
  CLI::Option* gather = command
                            ->add_flag("--gather", options->gather,
                                       "Write tables and plots of the finished angles and compute nothing")
                            ->excludes(dry_run)
                            ->excludes(only);
  for (CLI::Option* one : {only, gather}) one->excludes(command->get_option("--fresh"));
  add_batch_options(*command, options->batch);
  command->get_option("--batch")->excludes(only)->excludes(gather);
  command->callback([options, &status] { status = stability(*options); });
}

}  // namespace ripstop::cli

// ripstop sweep: one case over the values of any of its keys.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "batch_option.h"
#include "commands.h"
#include "margins.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/run/report/report.h"
#include "ripstop/run/sweep/sweep_files.h"
#include "steady_terminal.h"
#include "stopping.h"
#include "sweep_progress.h"
#include "warnings.h"

namespace ripstop::cli {
namespace {

struct SweepArguments : SweepOptions {
  std::vector<std::string> speeds, vary, rows;
  BatchOptions batch;
  std::string only;  // folder of one run
  bool dry_run = false, gather = false;
};

/// "a=1,2" is an axis of two values; "--row a=1 b=2" one row of a table, all rows together one axis.
std::vector<SweepAxis> axes_of(const SweepArguments& options) {
  std::vector<SweepAxis> axes;
  if (!options.speeds.empty()) axes.push_back(sweep_axis("flow.speed_m_s", options.speeds, "--speeds"));
  for (const std::string& text : options.vary) {
    const Setting all = parse_setting(text, "--vary");
    axes.push_back(sweep_axis(all.key, split_values(all.value), "--vary"));
  }
  if (!options.rows.empty()) {
    SweepAxis table{"row", {}, {}};
    for (const std::string& text : options.rows) {
      std::vector<Setting> settings;
      for (const std::string& part : split_values(text)) settings.push_back(parse_setting(part, "--row"));
      table.values.push_back(text);
      table.settings.push_back(settings);
    }
    axes.push_back(table);
  }
  if (axes.empty())
    throw Error(ExitCode::usage,
                "nothing to vary: give --speeds 10,20,30, or --vary KEY=V1,V2, or --row KEY=V,KEY=V");
  for (std::size_t i = 0; i < axes.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (axes[i].name == axes[k].name)
        throw Error(ExitCode::usage, fmt::format("{} is varied twice; give each key once", axes[i].name));
  return axes;
}

int write_scripts(const SweepArguments& options, const std::vector<SweepPoint>& points) {
  SweepSettings settings = options.settings;
  settings.elsewhere = true;
  BatchNeeds needs;
  for (const SweepPoint& point : points) {  // each job could hold the largest
    const BatchNeeds one = steady_needs(point.resolved, options.batch.cores.value_or(0));
    if (one.hours >= needs.hours) needs.hours = one.hours, needs.limited = one.limited;
    needs.ranks = std::max(needs.ranks, one.ranks);
    needs.cores = std::max(needs.cores, one.cores);
    needs.memory = std::max(needs.memory, one.memory);
  }
  BatchSweep sweep{batch_job(options.batch, settings.folder, needs), {}, settings.jobs};
  const auto waves = sweep_waves(points, settings.warm);
  for (const std::vector<std::size_t>& wave : waves) {
    sweep.waves.emplace_back();
    for (const std::size_t i : wave) sweep.waves.back().push_back(points[i].folder);
  }
  const std::vector<BatchFile> files = slurm_files(sweep);
  prepare_sweep(points, settings);
  write_and_tell(settings.folder, files, "bash", "submit");
  if (waves.size() == 1)
    fmt::print("{} runs in one array\n", points.size());
  else
    fmt::print(
        "{} runs in {} arrays, one after another, because runs start from neighbouring runs; with --cold one "
        "array is enough\n",
        points.size(), waves.size());
  return 0;
}

int run_only(const SweepArguments& options, const std::vector<SweepPoint>& points) {
  const auto point = std::find_if(points.begin(), points.end(),
                                  [&](const SweepPoint& one) { return one.folder == options.only; });
  if (point == points.end()) {
    std::vector<std::string> names;
    for (const SweepPoint& one : points) names.push_back(one.folder);
    const std::string near = nearest(options.only, names);
    throw Error(ExitCode::usage, fmt::format("--only {}: is not a run of this sweep{}", options.only,
                                             near.empty() ? "" : "; did you mean " + near + "?"));
  }
  goes_on_when_repeated();
  SteadyTerminal terminal(options.settings.folder / point->folder);
  const SteadyResult result =
      run_sweep_point(points, options.settings, static_cast<std::size_t>(point - points.begin()), terminal);
  if (options.json)
    fmt::print("{}", to_json(result));
  else
    fmt::print("{}: {:.4g} m/s, drag {:.2f} N, drag area {:.4f} m2{}, {} iterations{}\n", point->folder,
               result.speed, result.drag, result.drag_area, weakest_text(result.margins), result.iterations,
               result.converged ? "" : ", NOT converged");
  const int quality = print_result_warnings(result.warnings, result.usable);
  return result.converged ? quality : static_cast<int>(ExitCode::not_converged);
}

int sweep(SweepArguments& options) {
  finish(options, "sweep");
  const std::vector<SweepAxis> axes = axes_of(options);
  const std::vector<SweepPoint> points = sweep_points(options.case_file, options.overrides, axes);
  print_deprecations(points.front().resolved.deprecations());
  const std::filesystem::path& folder = options.settings.folder;
  if (options.batch.wanted()) return write_scripts(options, points);
  if (!options.only.empty()) return run_only(options, points);
  if (options.dry_run) {
    check_sweep(points, options.settings);
    for (const SweepPoint& point : points)
      fmt::print("{}{}\n", (folder / point.folder).string(),
                 options.cold || point.start < 0 ? "" : ", starts from " + points[point.start].folder);
    fmt::print("{} runs, {} at the same time\n", points.size(),
               options.settings.jobs ? options.settings.jobs : fitting_jobs(points));
    return 0;
  }
  const std::vector<SweepRow> rows =
      options.gather ? gather_sweep(points, options.settings) : run_and_tell(axes, points, options.settings);
  const std::string json = finish_sweep(folder, axes, points, rows);
  if (options.json) {
    fmt::print("{}", json);
  } else {
    fmt::print(
        "{} (also result.json; plots of drag, drag_area, drag_coefficient, diameters, iterations and "
        "wall_time as .svg and .png)\n",
        (folder / "sweep.csv").string());
    if (std::filesystem::exists(folder / report_name)) fmt::print("{}\n", (folder / report_name).string());
  }
  print_warnings(sweep_warnings(points, rows));
  require_all(points, rows);
  return 0;
}

}  // namespace

void add_sweep(CLI::App& app, int& status) {
  auto options = std::make_shared<SweepArguments>();
  CLI::App* command =
      app.add_subcommand("sweep", "Run one case over several speeds, or over any of its keys");
  command->footer(
      "Several --vary options run every combination of their values. Each --row is one run with its "
      "settings.\n"
      "An interrupted sweep resumes when the same command is repeated.\n"
      "Example: ripstop sweep examples/stratos-iv/case.toml --speeds 10,15,20,25,30\n"
      "         ripstop sweep examples/stratos-iv/case.toml --vary parachute.vent_diameter_m=0.07,0.09,0.11 "
      "\\\n"
      "           --vary parachute.gap_height_m=0.05,0.07\n"
      "         ripstop sweep examples/stratos-iv/case.toml --speeds 10,15,20,25,30 --batch slurm");
  add_sweep_options(*command, *options);
  command
      ->add_option("--speeds", options->speeds,
                   "Airspeeds [m/s], in a wind tunnel the nominal speeds, for example 10,15,20")
      ->delimiter(',');
  command->add_option("--vary", options->vary, "KEY=V1,V2,...: values of any key of the case; repeatable")
      ->expected(1)
      ->take_all();
  command->add_option("--row", options->rows, "KEY=V,KEY=V: settings of one run; repeatable")
      ->expected(1)
      ->take_all();
  command->add_flag("--linear", options->overrides.linear,
                    "Linear material model: only the stiffness coefficient K_1 of every material");
  command->add_option("--out", options->settings.folder, "Folder")
      ->default_str("runs/<name of the case>-sweep");
  CLI::Option* dry_run =
      command->add_flag("--dry-run", options->dry_run, "Print the runs that would be computed, and stop");
  CLI::Option* only =
      command
          ->add_option(
              "--only", options->only,
              "Compute one run of the sweep, given by the name of its folder, as a job of --batch does")
          ->excludes(dry_run);
  CLI::Option* gather = command
                            ->add_flag("--gather", options->gather,
                                       "Write table and plots of the finished runs and compute nothing")
                            ->excludes(dry_run)
                            ->excludes(only);
  for (CLI::Option* one : {only, gather}) one->excludes(command->get_option("--fresh"));
  add_batch_options(*command, options->batch);
  command->get_option("--batch")->excludes(only)->excludes(gather);
  command->callback([options, &status] { status = sweep(*options); });
}

}  // namespace ripstop::cli

// ripstop sweep: one case over the values of any of its keys.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "commands.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/run/report.h"
#include "ripstop/run/sweep_files.h"
#include "sweep_progress.h"

namespace ripstop {
namespace {

struct SweepArguments : SweepOptions {
  std::vector<std::string> speeds, vary, rows;
  bool dry_run = false;
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
        throw Error(ExitCode::usage, fmt::format("{} is varied twice", axes[i].name));
  return axes;
}

int sweep(SweepArguments& options) {
  finish(options, "sweep");
  const std::vector<SweepAxis> axes = axes_of(options);
  const std::vector<SweepPoint> points = sweep_points(options.case_file, options.overrides, axes);
  const std::filesystem::path& folder = options.settings.folder;
  if (options.dry_run) {
    check_sweep(points, options.settings);
    for (const SweepPoint& point : points)
      fmt::print("{}{}\n", (folder / point.folder).string(),
                 options.cold || point.start < 0 ? "" : ", from " + points[point.start].folder);
    fmt::print("{} runs, {} side by side\n", points.size(),
               options.settings.jobs ? options.settings.jobs : fitting_jobs(points));
    return 0;
  }
  const std::vector<SweepRow> rows = run_and_tell(axes, points, options.settings);
  const std::string& title = points.front().given.title;
  const std::string json = sweep_json(title, axes, points, rows);
  write_csv(folder / "sweep.csv", sweep_table(axes, points, rows));
  write_file(folder / "result.json", json);
  write_sweep_plots(folder, title, axes, points, rows);
  seal_sweep(folder);
  const bool any = std::any_of(rows.begin(), rows.end(), [](const SweepRow& row) { return row.done; });
  const std::string report = any ? write_report({folder}).string() : "";
  if (options.json) {
    fmt::print("{}", json);
  } else {
    fmt::print(
        "{} (and result.json, drag, drag_area, drag_coefficient, diameters, iterations, wall_time as .svg "
        "and .png)\n",
        (folder / "sweep.csv").string());
    if (any) fmt::print("{}\n", report);
  }
  std::fflush(stdout);
  require_all(points, rows);
  return 0;
}

}  // namespace

void add_sweep(CLI::App& app, int& status) {
  auto options = std::make_shared<SweepArguments>();
  CLI::App* command = app.add_subcommand("sweep", "One case over several speeds, or over any of its keys");
  command->footer(
      "Several --vary make every combination; --row gives single rows, each a list of settings.\n"
      "A sweep that was killed goes on when the same command is given again.\n"
      "Example: ripstop sweep examples/stratos-iv/case.toml --speeds 10,15,20,25,30\n"
      "         ripstop sweep examples/stratos-iv/case.toml --vary parachute.vent_diameter_m=0.07,0.09,0.11 "
      "\\\n"
      "           --vary flow.cells=[50,50,75],[80,80,120]");
  add_sweep_options(*command, *options);
  command->add_option("--speeds", options->speeds, "Nominal speeds [m/s], as in 10,15,20")->delimiter(',');
  command->add_option("--vary", options->vary, "KEY=V1,V2,...: values of any key of the case; repeatable")
      ->expected(1)
      ->take_all();
  command->add_option("--row", options->rows, "KEY=V,KEY=V: settings of one run of a table; repeatable")
      ->expected(1)
      ->take_all();
  command->add_flag("--linear", options->overrides.linear, "Keep only K_1 of every material");
  command->add_option("--out", options->settings.folder, "Folder (default: runs/<name of the case>-sweep)");
  command->add_flag("--dry-run", options->dry_run, "Say what would be run, and stop");
  command->callback([options, &status] { status = sweep(*options); });
}

}  // namespace ripstop

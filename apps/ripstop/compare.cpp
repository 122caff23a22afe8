// ripstop compare: finished runs, a measured and a computed load, or the linear and the nonlinear material model.

#include "ripstop/run/steady/compare.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "case_options.h"
#include "commands.h"
#include "json_option.h"
#include "margins.h"
#include "number_option.h"
#include "option.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/file.h"
#include "ripstop/core/words.h"
#include "ripstop/run/opening/measured_load.h"
#include "ripstop/run/report/compare_runs.h"
#include "ripstop/run/report/report.h"
#include "ripstop/run/steady/steady_folder.h"
#include "ripstop/run/sweep/sweep_files.h"
#include "sweep_progress.h"
#include "table_options.h"
#include "units_option.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct CompareArguments : SweepOptions {
  bool linear = false;
  std::vector<fs::path> others;  // runs after the first, which is in case_file
  fs::path measured;
  std::optional<double> shift;
  std::string columns, decimal = "auto";
};

void print(const RunComparison& c) {
  std::size_t width = 0;
  for (const ComparedNumber& n : c.numbers) width = std::max(width, in_words(n.key).with_unit().size());
  fmt::print("{:<{}}", "", width);
  for (std::size_t i = 0; i < c.runs.size(); ++i) fmt::print(" {:>12}", fmt::format("run {}", i + 1));
  fmt::print(" {:>10}\n", "change");
  for (const ComparedNumber& n : c.numbers) {
    fmt::print("{:<{}}", in_words(n.key).with_unit(), width);
    for (const double value : n.values)
      fmt::print(" {:>12}", std::isnan(value) ? "-" : fmt::format("{:.5g}", value));
    fmt::print(" {:>10}\n", n.difference ? fmt::format("{:+.2f} %", 100 * *n.difference) : "-");
  }
  for (std::size_t i = 0; i < c.runs.size(); ++i)
    fmt::print("run {}: {} ({})\n", i + 1, c.runs[i], c.titles[i]);
}

void print(const MeasuredLoad& m) {
  const auto row = print_row;
  fmt::print("{}: {} and {}\n", m.title, m.run, m.file);
  row("time shift", fmt::format("{:+.4g} s added to the measured time: {}", m.shift, m.shift_from));
  row("peak",
      fmt::format("computed {:.1f} N at {:.4g} s, measured {:.1f} N at {:.4g} s ({:+.1f} %)", m.computed_peak,
                  m.computed_peak_time, m.measured_peak, m.measured_peak_time, 100 * m.peak_difference));
  row("rms difference", fmt::format("{:.1f} N over {:.4g} s, {:.1f} % of the measured peak", m.rms_difference,
                                    m.overlap, 100 * m.rms_difference / m.measured_peak));
  row("impulse",
      fmt::format("computed {:.4g} N s, measured {:.4g} N s", m.computed_impulse, m.measured_impulse));
}

int compare_measured(const CompareArguments& options) {
  const MeasuredLoad result =
      compare_load({options.case_file, options.measured, table::parse_columns(options.columns),
                    table::parse_decimal(options.decimal), options.shift});
  const fs::path& folder = options.settings.folder;
  if (!folder.empty()) write_measured_load(folder, result);
  return show(result, options.json, [&] {
    print(result);
    if (!folder.empty()) fmt::print("{} (load.svg, load.png, result.json)\n", folder.string());
  });
}

int compare_finished(const CompareArguments& options) {
  std::vector<fs::path> runs{options.case_file};
  runs.insert(runs.end(), options.others.begin(), options.others.end());
  const RunComparison result = compare_runs(runs);
  const fs::path& folder = options.settings.folder;
  if (!folder.empty()) {
    make_results_folder(folder, "compare");
    write_file(folder / "result.json", to_json(result));
    write_report(runs, folder / report_name);
  }
  return show(result, options.json, [&] { print(result); });
}

void print(const Comparison& comparison) {
  const std::vector<ComparedModel>& models = comparison.models;
  fmt::print("{}, {:.4g} m/s\n", comparison.title, comparison.speed);
  fmt::print("{:<14} {:>9} {:>9} {:>10} {:>9} {:>10} {:>10} {:>10}\n", "", "drag N", "change", "diameter m",
             "shape mm", "lines", "tape", "cloth");
  for (const ComparedModel& m : models) {
    const auto strain = [&](const char* part) {
      const auto found = m.strain.find(part);
      return found == m.strain.end() ? std::string("-") : fmt::format("{:.4f} %", 100 * found->second.mean);
    };
    fmt::print("{:<14} {:>9.3f} {:>7.3f} % {:>10.4f} {:>9.3f} {:>10} {:>10} {:>10}\n", m.model, m.drag,
               100 * m.drag_difference, m.projected_diameter, 1000 * m.profile_change, strain("lines"),
               strain("tape"), strain("cloth"));
  }
  const ComparedModel &a = models[0], &b = models[1];
  std::string alone;
  for (std::size_t i = 2; i < models.size(); ++i) {
    alone += fmt::format("{}{} {:+.3f}", alone.empty() ? "" : ", ", models[i].model.substr(7),
                         models[i].drag - a.drag);
  }
  fmt::print("\nlinear - nonlinear: {:+.3f} N ({:+.3f} %)\n", b.drag - a.drag, 100 * b.drag_difference);
  fmt::print("  contribution of each material alone: {} N; interaction {:+.3f} N\n", alone,
             comparison.beyond_sum);
  fmt::print("  change of projected area {:+.3f} %, of drag per projected area {:+.3f} %\n",
             100 * comparison.by_projected_area, 100 * comparison.by_drag_per_area);
  fmt::print("  shape: change of the profile; lines, tape, cloth: mean strain of the springs of each part\n");
}

int compare(CompareArguments& options) {
  if (!options.measured.empty()) return compare_measured(options);
  if (!options.linear) return compare_finished(options);
  finish(options, "compare");
  // The neighbour's flow field would hide a difference smaller than the residual: every run starts cold.
  options.settings.warm = false;
  const SweepAxis axis = linear_models(read_settings(options.case_file, options.overrides));
  const std::vector<SweepPoint> points = sweep_points(options.case_file, options.overrides, {axis});
  const fs::path& folder = options.settings.folder;
  const std::vector<SweepRow> rows = run_and_tell({axis}, points, options.settings);
  require_all(points, rows);
  const Comparison comparison =
      compare_models(points, rows, [&](std::size_t i) { return final_state(folder / points[i].folder); });
  write_comparison(folder, comparison);
  seal_sweep(folder);
  return show(comparison, options.json, [&] {
    print(comparison);
    fmt::print("{} (profile.svg, profile.png, profile.csv, sweep.csv)\n", (folder / "result.json").string());
  });
}

}  // namespace

void add_compare(CLI::App& app, int& status) {
  auto options = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand(
      "compare",
      "Compare finished runs, an opening with a measured load, or a case with its linear material model");
  command->footer(
      "With run folders it prints the numbers of their results; --out adds a report with their shapes and "
      "plots.\n"
      "With --measured it compares the load of an opening over time with a record (docs/guide/tables.md).\n"
      "With --linear it runs the case with the complete material laws, with only K_1 of every material, and "
      "with\nonly K_1 of the cloth, the lines and the tape separately.\n"
      "Example: ripstop compare runs/first runs/second --out both\n"
      "         ripstop compare runs/opening --measured load-cell.csv\n"
      "         ripstop compare examples/stratos-iv/case.toml --linear --speed 30");
  add_sweep_options(*command, *options);
  command->get_option("case")->description("Folder of a finished run, or with --linear a case file (TOML)");
  add_run_folders(*command, "others", options->others, "Folders of further finished runs");
  add_key_number(*command, "--speed", "flow.speed_m_s", options->overrides.speed,
                 "Airspeed [m/s]; in a wind tunnel the nominal speed");
  CLI::Option* linear =
      command->add_flag("--linear", options->linear, "Compare with the linear model, which uses only K_1");
  add_existing_file(*command, "--measured", options->measured,
                    "Table of a measured load over time, compared with that of the opening")
      ->excludes(linear);
  add_number(*command, "--time-shift", options->shift, from(-1e6).up_to(1e6),
             "Shift added to the measured time [s]")
      ->default_str("least mean square difference of the loads");
  add_table_options(*command, options->columns, options->decimal, "force=Kraft [kN],time=Zeit [ms]");
  const auto only_with = [&](const std::string& mode, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      CLI::Option* option = command->get_option(name);
      option->description(fmt::format("With {}: {}", mode, option->get_description()));
    }
  };
  only_with("--linear", {"--flow", "--ranks", "--grid", "--set", "--unset", "--jobs", "--cold", "--fields",
                         "--fresh", "--speed"});
  only_with("--measured", {"--time-shift", "--columns", "--decimal"});
  command->add_option("--out", options->settings.folder, "Folder")
      ->default_str("with --linear runs/<name of the case>-compare, else none");
  command->callback([options, &status] { status = compare(*options); });
}

}  // namespace ripstop::cli

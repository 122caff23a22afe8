// ripstop compare: the nonlinear model beside the linear one, and where their difference comes from.

#include "ripstop/run/steady/compare.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "json_option.h"
#include "number_option.h"
#include "ripstop/run/steady/steady_folder.h"
#include "ripstop/run/sweep/sweep_files.h"
#include "sweep_progress.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

struct CompareArguments : SweepOptions {
  bool linear = false;
};

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
  fmt::print("  strain: mean over the springs of each part\n");
}

int compare(CompareArguments& options) {
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
  if (options.json) {
    fmt::print("{}", to_json(comparison));
    return 0;
  }
  print(comparison);
  fmt::print("{} (profile.svg, profile.png, profile.csv, sweep.csv)\n", (folder / "result.json").string());
  return 0;
}

}  // namespace

void add_compare(CLI::App& app, int& status) {
  auto options = std::make_shared<CompareArguments>();
  CLI::App* command =
      app.add_subcommand("compare", "Compare the nonlinear with the linear material model for one case");
  command->footer(
      "Runs the case with the complete material laws, with only K_1 of every material, and with only K_1 of "
      "the\ncloth, the lines and the tape separately.\n"
      "Example: ripstop compare examples/stratos-iv/case.toml --linear --speed 30");
  add_sweep_options(*command, *options);
  add_key_number(*command, "--speed", "flow.speed_m_s", options->overrides.speed, "Nominal speed [m/s]");
  command->add_flag("--linear", options->linear, "Compare with the linear model, which uses only K_1")
      ->required();
  command->add_option("--out", options->settings.folder, "Folder (default: runs/<name of the case>-compare)");
  command->callback([options, &status] { status = compare(*options); });
}

}  // namespace ripstop

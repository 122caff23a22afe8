// ripstop fabric: the cloth under a given pressure, without a flow.

#include "ripstop/run/sizing/fabric.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>

#include "case_options.h"
#include "commands.h"
#include "json_option.h"
#include "margins.h"
#include "number_option.h"
#include "progress.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/error.h"
#include "units_option.h"
#include "warnings.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct FabricArguments {
  fs::path case_file;
  Overrides overrides;
  std::optional<double> pressure;
  fs::path out;
  bool json = false;
};

void print_result(const FabricResult& r, const fs::path& folder) {
  const auto row = print_row;
  print_text("{}\n", r.title);
  row("pressure difference", fmt::format("{:.4g} Pa", r.pressure));
  row("pressure load", fmt::format("{:.2f} N", r.pressure_load));
  row("line load", fmt::format("{:.2f} N", r.line_tension));
  row("projected diameter", fmt::format("{:.3f} m", r.size.projected_diameter));
  std::string ratio = fmt::format("{:.3f}", r.projected_ratio);
  if (r.known_projected_ratio) {
    const auto [low, high] = *r.known_projected_ratio;
    ratio += low < high ? fmt::format(" (Knacke, in flight: {:.2f} to {:.2f})", low, high)
                        : fmt::format(" (Knacke, in flight: {:.2f})", low);
  }
  row("projected / nominal", ratio);
  row("skirt diameter", fmt::format("{:.3f} m", r.size.skirt_diameter));
  print_stresses(r.max_line_tension, r.stress);
  print_margins(r.margins);
  if (!folder.empty()) row("files", folder.string() + " (canopy.png, canopy.vtp, lines.vtp, result.json)");
}

int run(const FabricArguments& options) {
  const Settings resolved = read_settings(options.case_file, options.overrides);
  if (!options.out.empty()) make_results_folder(options.out, "fabric");
  Progress progress;
  const FabricSolution solution = run_fabric(resolved, options.pressure, [&](const RelaxProgress& p) {
    progress.show(fmt::format("cloth: step {}, residual {:.1e} (tolerance {:.0e})", p.steps, p.residual,
                              resolved.coupling().cloth_tolerance));
  });
  const FabricResult& r = solution.result;
  progress.line(fmt::format("{} nodes, {} steps in {:.2f} s, residual {:.1e}", r.nodes, r.steps, r.wall_time,
                            r.residual));
  if (!options.out.empty()) write_fabric(options.out, solution);
  if (options.json)
    fmt::print("{}", to_json(r));
  else
    print_result(r, options.out);
  print_warnings(r.warnings);
  if (!r.converged) {
    throw Error(ExitCode::not_converged,
                fmt::format("no equilibrium within {} steps: residual {:.1e}, tolerance {:.0e}", r.steps,
                            r.residual, r.tolerance));
  }
  return 0;
}

}  // namespace

void add_fabric(CLI::App& app, int& status) {
  auto options = std::make_shared<FabricArguments>();
  CLI::App* command = app.add_subcommand(
      "fabric", "Compute the shape under a uniform pressure, without a flow, as a quick check");
  command->footer("Example: ripstop fabric examples/stratos-iv/case.toml --pressure 500 --out look");
  command->add_option("case", options->case_file, "Case file (TOML)")->required();
  add_number(*command, "--pressure", options->pressure, key_range("inflation.pressure_pa"),
             "Uniform pressure difference over the canopy [Pa]")
      ->default_str("the dynamic pressure");
  add_case_options(*command, options->overrides);
  command->add_option("--out", options->out, "Folder for result.json, a picture and files for ParaView");
  add_units_option(*command);
  add_json_option(*command, options->json);
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop::cli

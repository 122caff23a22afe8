// ripstop check: properties of a case that need no solver.

#include "ripstop/run/sizing/check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "case_options.h"
#include "commands.h"
#include "progress.h"
#include "ripstop/case/cluster.h"
#include "ripstop/core/error.h"
#include "ripstop/run/json.h"

namespace ripstop::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CheckArguments {
  std::filesystem::path case_file;
  Overrides overrides;
  bool json = false;
  bool resolved = false;
};

std::string text_of(const Json& value) {
  if (value.is_number_integer()) return fmt::format("{}", value.get<long long>());
  if (value.is_number()) return fmt::format("{:.5g}", value.get<double>());
  if (value.is_string()) return value.get<std::string>();
  std::vector<std::string> parts;
  for (const Json& part : value) parts.push_back(text_of(part));
  return fmt::format("{}", fmt::join(parts, " x "));
}

/// Every key with a derived default: its value and origin.
void print_sources(const CheckResult& result) {
  const Json written = Json::parse(case_json(result.resolved));
  std::vector<std::string> values;
  std::size_t key = 28, value = 19;  // widths of the columns
  for (const Source& source : result.sources) {
    values.push_back(text_of(written.at(pointer_of(source.key))));
    key = std::max(key, source.key.size());
    value = std::max(value, values.back().size());
  }
  fmt::print("\n");
  for (std::size_t i = 0; i < values.size(); ++i)
    fmt::print("  {:<{}} {:<{}} {}\n", result.sources[i].key, key, values[i], value, result.sources[i].from);
}

void print(const Settings& resolved, const CaseSummary& s, std::size_t warnings) {
  const auto row = [](const char* name, const std::string& text) { fmt::print("  {:<18} {}\n", name, text); };
  const bool given = resolved.source("parachute.nominal_area_m2").given;
  fmt::print("{}\n", resolved.title().empty() ? resolved.file().string() : resolved.title());
  row("nominal area",
      fmt::format("{:.4f} m2{}", s.nominal_area, given ? " (given)" : " (definition of the canopy family)"));
  row("cloth", fmt::format("{:.4f} m2 finished (without allowances), {:.4f} m2 as meshed", s.computed_area,
                           s.cloth_area));
  row("open area", fmt::format("{:.2f} % geometric porosity: vent {:.4f} m2, slots and gaps {:.4f} m2",
                               100 * s.geometric_porosity, s.vent_area, s.slot_area));
  row("mass",
      fmt::format("{:.4f} kg: cloth {:.4f}, tape {:.4f} ({:.0f} %), lines {:.4f}, riser {:.4f}", s.mass.total,
                  s.mass.cloth, s.mass.tape, 100 * s.mass.tape / s.mass.total, s.mass.lines, s.mass.riser));
  row("nodes",
      fmt::format("{}, of these {} of cloth ({} requested, at least {} for a diameter within 1 %)", s.nodes,
                  s.cloth_nodes, resolved.parachute().mesh.cloth_nodes, s.resolved_cloth_nodes));
  row("springs",
      fmt::format("{}, the shortest {:.3g} mm ({})", s.springs, 1000 * s.smallest_spring, s.smallest_part));
  if (const auto& cluster = resolved.written().cluster)
    row("cluster",
        fmt::format(
            "{} canopies at {:g} deg to its axis{}{}; area, mass, mesh, stable step and reefing are of one "
            "{}; flow domain, memory and time are of the cluster",
            cluster->canopies, cluster->spread_angle_deg,
            cluster->size_ratios.empty()
                ? std::string()
                : fmt::format(" in the sizes {:g}", fmt::join(cluster->size_ratios, ", ")),
            cluster->equilibrium ? ", the first angle of the search for the equilibrium" : "",
            equal_canopies(resolved.written()) ? "canopy" : "canopy of size 1"));
  if (const auto& cluster = resolved.written().cluster; cluster && !cluster->delays_s.empty())
    row("", fmt::format("canopies open after {:g} s in a coupled inflation; other runs do not use the delays",
                        fmt::join(cluster->delays_s, ", ")));
  row("stable step", fmt::format("{:.3g} s, limited by {}; the estimate of [NFM] is {:.3g} s",
                                 s.step.stable_step, s.step.part, s.step.printed_step));
  row("flow domain",
      fmt::format(
          "{} cells, {:.3g} x {:.3g} x {:.3g} mm at the canopy, blockage of the undeformed {} {:.1f} %{}",
          s.flow_cells, 1000 * s.flow_spacing.x, 1000 * s.flow_spacing.y, 1000 * s.flow_spacing.z,
          resolved.written().cluster ? "canopies" : "canopy", 100 * s.blockage,
          s.of_jet ? " of the nozzle" : ""));
  row("memory", fmt::format("about {:.2g} GB for a steady run", 1e-9 * s.memory));
  row("time", fmt::format("about {} on one core for a steady run with the built-in engine; typically 0.5 to "
                          "2 times this estimate",
                          rough_duration(s.core_time)));
  if (resolved.flow().unsteady)
    row("",
        "flow.unsteady adds an averaging window, whose time is not known in advance: usually several "
        "times this estimate");
  row("", "time of an opening: ripstop inflate --check; time of a flight: shown while it runs");
  for (std::size_t i = 0; i < resolved.inflation().reefing.size(); ++i) {
    const ReefingStage& stage = resolved.inflation().reefing[i];
    row(i == 0 ? "reefing" : "",
        fmt::format("line of {:g} m, {:.1f} % of the skirt circumference {:.4g} m, reefing ratio {:.3f}, cut "
                    "at {:g} s",
                    stage.line_m, 100 * stage.line_m / skirt_circumference(resolved.parachute()),
                    skirt_circumference(resolved.parachute()),
                    stage.line_m / std::numbers::pi / nominal_diameter(resolved.parachute()), stage.cut_s));
  }
  row("air",
      fmt::format("{:.4g} m/s, {:.4g} kg/m3 ({}){}", s.air.speed, s.air.density, s.air_source,
                  resolved.payload().mass_kg ? "; initial speed of a steady run with the payload" : ""));
  row("deployment", fmt::format("{:.4g} m/s ({}): tape without parachute.tape.material, and margins",
                                s.deployment.speed, s.deployment.from));
  row("problems", warnings == 0
                      ? "none"
                      : fmt::format("no error, {} warning{} below", warnings, warnings == 1 ? "" : "s"));
}

int run(const CheckArguments& options) {
  try {
    require_one_option(options.overrides);
    const Settings resolved = resolve(read_case(options.case_file, options.overrides));
    if (options.resolved) {
      fmt::print("{}", case_toml(resolved));
      return 0;
    }
    const CheckResult result = run_check(resolved);
    if (options.json) {
      fmt::print("{}", to_json(result));
      return 0;
    }
    print(resolved, result.summary, result.warnings.size());
    print_sources(result);
    std::fflush(stdout);
    for (const std::string& text : result.warnings) fmt::print(stderr, "warning: {}\n", text);
    return 0;
  } catch (const InputError& error) {
    if (!options.json) throw;
    fmt::print("{}", to_json(error.problems()));
    return static_cast<int>(error.code());
  }
}

}  // namespace

void add_check(CLI::App& app, int& status) {
  auto options = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand(
      "check", "Check a case without running a solver: problems, areas, masses, time step");
  command->footer("Example: ripstop check examples/stratos-iv/case.toml --speed 25 --json");
  command->add_option("case", options->case_file, "Case file (TOML)")->required();
  add_case_options(*command, options->overrides);
  add_flow_options(*command, options->overrides);
  CLI::Option* json =
      command->add_flag("--json", options->json, "Print the report, or the problems found, as JSON");
  command->add_flag("--resolved", options->resolved, "Print the case with all defaults filled in (TOML)")
      ->excludes(json);
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop::cli

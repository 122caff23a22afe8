// ripstop check: everything about a case that can be said without a solver.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "case_options.h"
#include "commands.h"
#include "ripstop/case/summary.h"
#include "ripstop/core/error.h"
#include "warnings.h"

namespace ripstop {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::filesystem::path case_file;
  Overrides overrides;
  bool json = false;
  bool resolved = false;
};

Json to_json(const Problem& problem) {
  return {{"file", problem.origin.file},     {"line", problem.origin.line}, {"column", problem.origin.column},
          {"option", problem.origin.option}, {"key", problem.key},          {"value", problem.value},
          {"allowed", problem.allowed},      {"message", problem.message},  {"text", to_text(problem)}};
}

Json to_json(const Case& value, const CaseSummary& s) {
  return {{"valid", true},
          {"problems", Json::array()},
          {"nominal_area_m2", s.nominal_area},
          {"computed_area_m2", s.computed_area},
          {"meshed_area_m2", s.cloth_area},
          {"vent_area_m2", s.vent_area},
          {"slot_area_m2", s.slot_area},
          {"geometric_porosity", s.geometric_porosity},
          {"mass_kg",
           {{"cloth", s.cloth_mass},
            {"tape", s.tape_mass},
            {"lines", s.line_mass},
            {"riser", s.riser_mass},
            {"total", s.total_mass}}},
          {"nodes", s.nodes},
          {"cloth_nodes", s.cloth_nodes},
          {"resolved_cloth_nodes", s.resolved_cloth_nodes},
          {"springs", s.springs},
          {"smallest_spring_m", s.smallest_spring},
          {"smallest_spring_part", s.smallest_part},
          {"stable_step_s", s.step.stable_step},
          {"stable_step_part", s.step.part},
          {"printed_step_s", s.step.printed_step},
          {"flow_cells", s.flow_cells},
          {"flow_spacing_m", {s.flow_spacing.x, s.flow_spacing.y, s.flow_spacing.z}},
          {"blockage", s.blockage},
          {"speed_m_s", s.air.speed},
          {"density_kg_m3", s.air.density},
          {"case", Json::parse(case_json(value))}};
}

void print(const Case& value, const CaseSummary& s) {
  const auto row = [](const char* name, const std::string& text) { fmt::print("  {:<18} {}\n", name, text); };
  fmt::print("{}\n", value.title.empty() ? value.file.string() : value.title);
  row("nominal area",
      fmt::format("{:.4f} m2{}", s.nominal_area,
                  value.parachute.nominal_area_m2 ? " (given)" : " (by the type's definition)"));
  row("cloth", fmt::format("{:.4f} m2 as cut, {:.4f} m2 as meshed", s.computed_area, s.cloth_area));
  row("open", fmt::format("{:.2f} % geometric porosity: vent {:.4f} m2, slots and gaps {:.4f} m2",
                          100 * s.geometric_porosity, s.vent_area, s.slot_area));
  row("mass",
      fmt::format("{:.4f} kg: cloth {:.4f}, tape {:.4f} ({:.0f} %), lines {:.4f}, riser {:.4f}", s.total_mass,
                  s.cloth_mass, s.tape_mass, 100 * s.tape_mass / s.total_mass, s.line_mass, s.riser_mass));
  row("nodes", fmt::format("{}, of these {} of cloth ({} asked for, {} resolve its size)", s.nodes,
                           s.cloth_nodes, value.parachute.mesh.cloth_nodes, s.resolved_cloth_nodes));
  row("springs",
      fmt::format("{}, the smallest {:.3g} mm ({})", s.springs, 1000 * s.smallest_spring, s.smallest_part));
  row("stable step", fmt::format("{:.3g} s, set by {}; the paper's bound gives {:.3g} s", s.step.stable_step,
                                 s.step.part, s.step.printed_step));
  row("flow box", fmt::format("{} cells of {:.3g} x {:.3g} x {:.3g} mm, canopy blocks {:.1f} %", s.flow_cells,
                              1000 * s.flow_spacing.x, 1000 * s.flow_spacing.y, 1000 * s.flow_spacing.z,
                              100 * s.blockage));
  row("air", fmt::format("{:.4g} m/s, {:.4g} kg/m3", s.air.speed, s.air.density));
  row("problems", "none");
}

int run(const Options& options) {
  try {
    const Case value = read_case(options.case_file, options.overrides);
    if (options.resolved) {
      fmt::print("{}", case_toml(value));
      return 0;
    }
    const CaseSummary summary = summarize(value);
    if (options.json)
      fmt::print("{}\n", to_json(value, summary).dump(2));
    else
      print(value, summary);
    if (!options.json) {
      print_mesh_warning(value);
      print_porosity_warning(value);
    }
    return 0;
  } catch (const InputError& error) {
    if (!options.json) throw;
    Json report = {{"valid", false}, {"problems", Json::array()}};
    for (const Problem& problem : error.problems()) report["problems"].push_back(to_json(problem));
    fmt::print("{}\n", report.dump(2));
    return static_cast<int>(error.code());
  }
}

}  // namespace

void add_check(CLI::App& app, int& status) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "check", "Everything about a case without a solver: problems, areas, masses, time step");
  command->footer("Example: ripstop check examples/stratos-iv/case.toml --speed 25 --json");
  command->add_option("case", options->case_file, "Case file (TOML)")->required();
  add_case_options(*command, options->overrides);
  add_flow_options(*command, options->overrides);
  CLI::Option* json = command->add_flag("--json", options->json, "The report, or the problems, as JSON");
  command->add_flag("--resolved", options->resolved, "Print the case with every default written out (TOML)")
      ->excludes(json);
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop

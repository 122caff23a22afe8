// ripstop check: everything about a case that can be said without a solver.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "case_options.h"
#include "commands.h"
#include "ripstop/case/resolve.h"
#include "ripstop/case/summary.h"
#include "ripstop/core/error.h"
#include "ripstop/run/warnings.h"
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

/// What stands in the written case under a full name such as "flow.core.size_m".
const Json& value_of(const Json& written, const std::string& key) {
  std::string pointer = "/" + key;
  std::replace(pointer.begin(), pointer.end(), '.', '/');
  return written.at(Json::json_pointer(pointer));
}

Json to_json(const std::vector<Source>& sources, const Json& written) {
  Json list = Json::array();
  for (const Source& source : sources)
    list.push_back({{"key", source.key},
                    {"value", value_of(written, source.key)},
                    {"given", source.given},
                    {"from", source.from}});
  return list;
}

Json to_json(const Case& given, const CaseSummary& s) {
  const Json written = Json::parse(case_json(given));
  return {{"valid", true},
          {"problems", Json::array()},
          {"warnings", case_warnings(given)},
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
          {"memory_bytes", s.memory},
          {"blockage", s.blockage},
          {"speed_m_s", s.air.speed},
          {"density_kg_m3", s.air.density},
          {"sources", to_json(resolve(given).sources, written)},
          {"case", written}};
}

std::string text_of(const Json& value) {
  if (value.is_number_integer()) return fmt::format("{}", value.get<long long>());
  if (value.is_number()) return fmt::format("{:.5g}", value.get<double>());
  if (value.is_string()) return value.get<std::string>();
  std::vector<std::string> parts;
  for (const Json& part : value) parts.push_back(text_of(part));
  return fmt::format("{}", fmt::join(parts, " x "));
}

/// Every key that follows from others where it is not given: what stands, and why.
void print_sources(const Case& given) {
  const Json written = Json::parse(case_json(given));
  const std::vector<Source> sources = resolve(given).sources;
  fmt::print("\n");
  for (const Source& source : sources)
    fmt::print("  {:<28} {:<19} {}\n", source.key, text_of(value_of(written, source.key)), source.from);
}

void print(const Case& given, const CaseSummary& s) {
  const auto row = [](const char* name, const std::string& text) { fmt::print("  {:<18} {}\n", name, text); };
  fmt::print("{}\n", given.title.empty() ? given.file.string() : given.title);
  row("nominal area",
      fmt::format("{:.4f} m2{}", s.nominal_area,
                  given.parachute.nominal_area_m2 ? " (given)" : " (by the type's definition)"));
  row("cloth", fmt::format("{:.4f} m2 as cut, {:.4f} m2 as meshed", s.computed_area, s.cloth_area));
  row("open", fmt::format("{:.2f} % geometric porosity: vent {:.4f} m2, slots and gaps {:.4f} m2",
                          100 * s.geometric_porosity, s.vent_area, s.slot_area));
  row("mass", fmt::format("{:.4f} kg: cloth {:.4f}, tape {:.4f}, lines {:.4f}, riser {:.4f}", s.total_mass,
                          s.cloth_mass, s.tape_mass, s.line_mass, s.riser_mass));
  row("nodes", fmt::format("{}, of these {} of cloth ({} asked for, {} resolve its size)", s.nodes,
                           s.cloth_nodes, given.parachute.mesh.cloth_nodes, s.resolved_cloth_nodes));
  row("springs",
      fmt::format("{}, the smallest {:.3g} mm ({})", s.springs, 1000 * s.smallest_spring, s.smallest_part));
  row("stable step", fmt::format("{:.3g} s, set by {}; the paper's bound gives {:.3g} s", s.step.stable_step,
                                 s.step.part, s.step.printed_step));
  row("flow box", fmt::format("{} cells of {:.3g} x {:.3g} x {:.3g} mm, canopy blocks {:.1f} %{}",
                              s.flow_cells, 1000 * s.flow_spacing.x, 1000 * s.flow_spacing.y,
                              1000 * s.flow_spacing.z, 100 * s.blockage, s.of_jet ? " of the nozzle" : ""));
  row("memory", fmt::format("about {:.2g} GB for a steady run", 1e-9 * s.memory));
  row("air", fmt::format("{:.4g} m/s, {:.4g} kg/m3", s.air.speed, s.air.density));
  const std::size_t warnings = case_warnings(given).size();
  row("problems", warnings == 0 ? "none"
                                : fmt::format("none that stops a run, {} warning{} below", warnings,
                                              warnings == 1 ? "" : "s"));
}

int run(const Options& options) {
  try {
    const Case given = read_case(options.case_file, options.overrides);
    if (options.resolved) {
      fmt::print("{}", case_toml(given));
      return 0;
    }
    const CaseSummary summary = summarize(given);
    if (options.json)
      fmt::print("{}\n", to_json(given, summary).dump(2));
    else
      print(given, summary);
    if (!options.json) {
      print_sources(given);
      std::fflush(stdout);
      print_case_warnings(given);
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

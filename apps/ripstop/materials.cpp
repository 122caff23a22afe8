// ripstop materials: the material library, and one material with its load curve and permeability.

#include "ripstop/run/material/materials.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "option.h"
#include "ripstop/core/file.h"
#include "ripstop/core/words.h"
#include "ripstop/core/wrap.h"
#include "units_option.h"

namespace ripstop::cli {
namespace {

struct MaterialsArguments {
  std::string name;
  std::string kind = "all";
  bool json = false;
};

/// Keys of a case that take a material of each kind.
struct KindText {
  const char *kind, *title;
};
constexpr KindText kinds[] = {
    {"fabric", "cloth, for parachute.canopy_material"},
    {"line", "lines, for parachute.lines.material, parachute.riser.material and reefing lines"},
    {"tape", "tapes, for parachute.tape.material"},
};

std::string title_of(const std::string& kind) {
  return std::find_if(std::begin(kinds), std::end(kinds), [&](const KindText& k) { return kind == k.kind; })
      ->title;
}

std::string mass_of(const MaterialEntry& m) {
  if (m.areal_density) return fmt::format("{} kg/m2", rounded(*m.areal_density, 3));
  if (m.linear_density) return fmt::format("{} g/m", rounded(1000 * *m.linear_density, 3));
  return "not known";
}

std::string strength_of(const MaterialEntry& m) {
  if (m.strength_per_width) return fmt::format("{} N/m", rounded(*m.strength_per_width, 4));
  if (m.strength) return fmt::format("{} N", rounded(*m.strength, 4));
  return "not known";
}

std::string air_of(const MaterialEntry& m) {
  if (m.permeability)
    return fmt::format("{} m/s ({} CFM/ft2)", rounded(*m.permeability, 3), rounded(*m.permeability_cfm, 3));
  return m.kind == "fabric" ? "porous cells" : "";
}

void print_table(const std::vector<MaterialEntry>& all, const std::string& kind) {
  std::vector<std::vector<std::string>> rows = {{"name", "mass", "strength"}};
  if (kind == "fabric") rows[0].push_back("air at 124.5 Pa");
  rows[0].push_back("source");
  for (const MaterialEntry& m : all) {
    if (m.kind != kind) continue;
    rows.push_back({m.name, in_units(mass_of(m)), in_units(strength_of(m))});
    if (kind == "fabric") rows.back().push_back(in_units(air_of(m)));
    rows.back().push_back(m.source);
  }
  std::vector<std::size_t> widths(rows[0].size());
  for (const auto& row : rows)
    for (std::size_t i = 0; i + 1 < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  fmt::print("{}\n", title_of(kind));
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += fmt::format("  {:<{}}", row[i], widths[i]);
    fmt::print("{}\n", wrapped(line, wrap_width(STDOUT_FILENO)));
  }
}

void print_list(const MaterialList& list, const std::string& wanted) {
  for (const KindText& kind : kinds) {
    if (wanted != "all" && wanted != kind.kind) continue;
    print_table(list.materials, kind.kind);
    fmt::print("\n");
  }
  fmt::print(
      "strength: breaking load of new material, without the factors of [margins]; ripstop materials NAME "
      "prints one material with its load curve\n");
}

void print_curve(const MaterialEntry& m) {
  const bool cloth = m.kind == "fabric";
  fmt::print("\n  {:>8}  {}\n", "strain", cloth ? "load along warp          load along weft" : "tension");
  for (const MaterialLoad& p : m.curve) {
    const auto cell = [](double load, const char* unit) {
      return in_units(fmt::format("{} {}", rounded(load, 4), unit));
    };
    fmt::print(
        "  {:>8.4f}  {}\n", p.strain,
        cloth ? fmt::format("{:<24} {}", cell(*p.warp, "N/m"), cell(*p.weft, "N/m")) : cell(*p.tension, "N"));
  }
  if (m.air.empty()) return;
  fmt::print("\n  {:<24} air through the cloth\n", "pressure difference");
  for (const MaterialFlow& p : m.air)
    fmt::print("  {:<24} {}\n", in_units(fmt::format("{:g} Pa", p.pressure)),
               in_units(fmt::format("{} m/s", rounded(p.velocity, 3))));
}

void print_material(const MaterialEntry& m) {
  print_text("{}: {}\n", m.name, title_of(m.kind));
  print_row("mass", mass_of(m));
  if (m.width) print_row("width", length_text(*m.width));
  if (m.thickness) print_row("thickness", length_text(*m.thickness));
  print_row("strength", fmt::format("{} ({})", strength_of(m), m.strength_from));
  print_row("tested strain", m.tested_strain ? fmt::format("{:g}", *m.tested_strain) : "not known");
  if (m.kind == "fabric")
    print_row("permeability",
              m.permeability ? air_of(m) + " at 124.5 Pa"
                             : "given for porous cells (flow.porosity_model = \"paper\"), not as a flow");
  print_row("source", m.source);
  if (!m.warning.empty()) print_row("warning", m.warning);
  print_curve(m);
  fmt::print("\n{}, with the source of each number:\n\n{}", m.file, read_file(m.file));
}

int run(const MaterialsArguments& options) {
  if (!options.name.empty()) {
    const MaterialEntry entry = material_entry(options.name);
    if (options.json)
      fmt::print("{}", to_json(MaterialList{{entry}}));
    else
      print_material(entry);
    return 0;
  }
  MaterialList list = library_materials();
  const std::string kind = options.kind == "cloth" ? "fabric" : options.kind;
  if (kind != "all") std::erase_if(list.materials, [&](const MaterialEntry& m) { return m.kind != kind; });
  if (options.json)
    fmt::print("{}", to_json(list));
  else
    print_list(list, kind);
  return 0;
}

}  // namespace

void add_materials(CLI::App& app, int& status) {
  auto options = std::make_shared<MaterialsArguments>();
  CLI::App* command = app.add_subcommand(
      "materials", "List the materials of the library, or print one with its load curve and sources");
  command->footer(
      "The names are the values of parachute.canopy_material, lines.material and tape.material in a case.\n"
      "Example: ripstop materials --kind fabric --units us\n"
      "         ripstop materials spectra-line");
  CLI::Option* name = command
                          ->add_option("material", options->name,
                                       "Name of a material of the library, or a material file (.toml)")
                          ->default_str("all of the library");
  add_choice(*command, "--kind", options->kind, {"all", "cloth", "fabric", "line", "tape"},
             "Kind of the listed materials")
      ->excludes(name);
  add_units_option(*command);
  command->add_flag("--json", options->json, "Print only the materials, as JSON");
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop::cli

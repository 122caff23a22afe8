// Reads a case file and applies the changes of a command line.

#include "ripstop/core/toml/read.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ripstop/case/case.h"
#include "ripstop/case/material_files.h"

namespace ripstop::inline cases {
namespace {

/// Returns the keys that were set.
std::vector<std::string> set_values(const Overrides& overrides, Case& given) {
  std::vector<std::string> keys;
  const auto note = [&](const std::string& key, const std::string& option) {
    given.origins[key] = Origin{"", 0, 0, option};
    keys.push_back(key);
  };
  if (overrides.speed) {
    given.flow.speed_m_s = *overrides.speed;
    note("flow.speed_m_s", "--speed");
  }
  if (overrides.grid) {
    given.flow.cells = *overrides.grid;
    note("flow.cells", "--grid");
    for (int i = 0; i < 3; ++i) note(fmt::format("flow.cells[{}]", i), "--grid");
  }
  if (overrides.engine) {
    given.flow.engine = *overrides.engine;
    note("flow.engine", "--flow");
  }
  if (overrides.ranks) {
    given.flow.ranks = *overrides.ranks;
    note("flow.ranks", "--ranks");
  }
  if (overrides.pressure) {
    given.inflation.pressure_pa = *overrides.pressure;
    given.inflation.drag_coefficient.reset();
    note("inflation.pressure_pa", "--pressure");
  }
  if (overrides.linear) {
    given.coupling.linear = true;
    note("coupling.linear", "--linear");
  }
  return keys;
}

/// materials.<name>.<key> of a material that only the library has starts from the library's.
void import_material(Document& document, const Setting& setting) {
  const std::string prefix = "materials.";
  if (setting.remove) return;
  if (!setting.key.starts_with(prefix)) return;
  const std::string name =
      setting.key.substr(prefix.size(), setting.key.find('.', prefix.size()) - prefix.size());
  std::vector<std::string> known = library_names();
  if (const Node* own = document.root.find("materials")) {
    if (own->find(name)) return;
    for (const Node& material : own->items) known.push_back(material.key);
  }
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    const std::string near = nearest(name, known);
    throw InputError(
        ExitCode::usage,
        {{{"", 0, 0, setting.option},
          setting.key,
          setting.value,
          fmt::format("{}", fmt::join(known, ", ")),
          near.empty() ? fmt::format("no such material; available: {}", fmt::join(known, ", "))
                       : fmt::format("no such material; did you mean {}?", quoted(prefix + near))}});
  }
  set_value(document, {prefix + name + ".base", quoted(name), setting.option});
}

/// The origin of a value from a setting is its option, not a place in the file.
void mark_origin(const Setting& setting, Origins& origins, std::vector<Problem>& problems) {
  const Origin given{"", 0, 0, setting.option};
  const auto below = [&](const std::string& key) {
    return key == setting.key || key.starts_with(setting.key + "[") || key.starts_with(setting.key + ".");
  };
  for (auto& [key, origin] : origins)
    if (below(key)) origin = given;
  for (Problem& problem : problems) {
    const bool above = setting.key.starts_with(problem.key + ".") && problem.origin.line == 0;
    if (below(problem.key) || above) problem.origin = given;
  }
}

/// Gives old keys their names of today, in the settings too.
void rename_old_keys(Document& document, std::vector<Setting>& settings, Case& given) {
  const auto materials = std::find_if(document.root.items.begin(), document.root.items.end(),
                                      [](const Node& table) { return table.key == "materials"; });
  if (materials == document.root.items.end()) return;
  for (Node& material : materials->items) {
    const std::string table = "materials." + material.key + ".";
    for (const auto& [old, now] : ripstop::rename_old_keys(material)) {
      given.deprecations.push_back(
          now.empty() ? fmt::format("{}{} is an old key and no longer needed, because the keys of the "
                                    "permeability determine the porosity model; remove it",
                                    table, old)
                      : fmt::format("{}{} is a deprecated key: write {}{}", table, old, table, now));
      for (Setting& setting : settings)
        if (setting.key == table + old && !now.empty()) setting.key = table + now;
    }
  }
}

}  // namespace

Case parse_case(const std::string& text, const std::string& name, const Overrides& overrides) {
  Case given;
  std::vector<Problem> problems;
  Document document = parse_toml(text, name);
  std::vector<Setting> settings = overrides.set;
  for (const Setting& setting : settings) {
    import_material(document, setting);
    set_value(document, setting);
  }
  rename_old_keys(document, settings, given);
  std::map<std::string, Material> from_files = take_material_files(document, settings);
  Fields fields;
  describe(fields, given);
  read_table(fields, document, given.origins, problems);
  given.materials.merge(from_files);
  for (const Setting& setting : settings) mark_origin(setting, given.origins, problems);
  const std::vector<std::string> replaced = set_values(overrides, given);
  std::erase_if(problems, [&](const Problem& problem) {
    return std::find(replaced.begin(), replaced.end(), problem.key) != replaced.end();
  });
  return checked(std::move(given), std::move(problems));
}

Case read_case(const std::filesystem::path& file, const Overrides& overrides) {
  Case given = parse_case(read_text_file(file), file.string(), overrides);
  given.file = file;
  return given;
}

void apply(const Overrides& overrides, Case& given) {
  Case changed = given;
  set_values(overrides, changed);
  given = checked(std::move(changed));
}

}  // namespace ripstop::inline cases

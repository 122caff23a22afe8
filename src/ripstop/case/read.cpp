// Reading a case, and every check that looks at more than one key.

#include "ripstop/core/toml/read.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ripstop/case/case.h"

namespace ripstop {
namespace {

constexpr double most_cells = 2e8;         // about 200 GB in the flow solver
constexpr double fewest_cells_across = 4;  // of the canopy's diameter

/// Brings the named material into the case from the library, unless the case has it, and checks its kind.
template <class Kind>
void resolve_material(Case& value, const std::string& key, const std::string& name, Findings& findings) {
  if (!findings.sound({key, "materials." + name})) return;
  auto found = value.materials.find(name);
  if (found == value.materials.end()) {
    try {
      found = value.materials.emplace(name, library_material(name)).first;
    } catch (const InputError&) {
      throw;  // the file is there and broken
    } catch (const Error& error) {
      if (error.code() != ExitCode::usage) throw;
      findings.add(key, quoted(name), "",
                   std::string(error.what()) + " (or write it into the case as [materials." + name + "])");
      return;
    }
  }
  const std::string needed = kind_of(Material(Kind{}));
  if (!std::holds_alternative<Kind>(found->second))
    findings.add(key, quoted(name), "a material of kind " + quoted(needed),
                 fmt::format("is a {}; a {} is needed here", kind_of(found->second), needed));
}

void check_materials(Case& value, Findings& findings) {
  for (auto& [name, material] : value.materials) {
    set_name(material, name);
    if (findings.sound({"materials." + name})) check_material(material, "materials." + name, findings);
  }
  const Design& parachute = value.parachute;
  resolve_material<Fabric>(value, "parachute.canopy_material", parachute.canopy_material, findings);
  resolve_material<Line>(value, "parachute.lines.material", parachute.lines.material, findings);
  resolve_material<Line>(value, "parachute.riser.material", parachute.riser.material, findings);
  resolve_material<Tape>(value, "parachute.tape.material", parachute.tape.material, findings);
}

void check_measured(const Case& value, Findings& findings) {
  if (!findings.sound({"measured", "flow.speed_m_s"})) return;
  std::vector<double> speeds;
  for (std::size_t i = 0; i < value.measured.size(); ++i) {
    const double speed = value.measured[i].nominal_speed_m_s;
    if (std::find(speeds.begin(), speeds.end(), speed) != speeds.end())
      findings.add(fmt::format("measured[{}].nominal_speed_m_s", i), speed, "",
                   "there is already a row of [[measured]] with this nominal speed");
    speeds.push_back(speed);
  }
  if (measured_row(value)) return;
  const std::string rows = speeds.empty()
                               ? "there are no rows of [[measured]]"
                               : fmt::format("[[measured]] has rows for {}", fmt::join(speeds, ", "));
  if (value.flow.speed_basis == SpeedBasis::measured)
    findings.add("flow.speed_m_s", value.flow.speed_m_s, fmt::format("{}", fmt::join(speeds, ", ")),
                 "speed_basis = \"measured\" needs a row of [[measured]] with this nominal speed; " + rows);
  else if (!value.flow.density_kg_m3 && findings.sound({"flow.density_kg_m3"}))
    findings.add(
        "flow.density_kg_m3", "", "above 0 and at most 20",
        fmt::format("is missing, and no row of [[measured]] has the nominal speed {} to take it from; {}",
                    value.flow.speed_m_s, rows));
}

/// The start shape, and the inflated shape that it may turn into, have to lie inside the box.
void check_box(const Case& value, Findings& findings) {
  if (!findings.sound(shape_keys(value.parachute)) ||
      !findings.sound({"flow.box_m", "flow.canopy_position_m"}))
    return;
  const Vec3 box = value.flow.box_m;
  const double diameter = start_diameter(value.parachute);
  const std::string canopy = fmt::format("a canopy of {:.6g} m diameter", diameter);
  for (const auto& [index, side] : {std::pair{0, box.x}, std::pair{1, box.y}})
    if (side <= diameter)
      findings.add(fmt::format("flow.box_m[{}]", index), side, fmt::format("above {:.6g}", diameter),
                   fmt::format("{} does not fit into the box", canopy));
  // Downstream of the skirt no point of a canopy is farther than its meridian is long.
  const double skirt = canopy_position(value);
  const double end = skirt + start_depth(value.parachute) + diameter / 2;
  if (end >= box.z) {
    const bool given = value.flow.canopy_position_m.has_value();
    findings.add(
        given ? "flow.canopy_position_m" : "flow.box_m[2]", given ? skirt : box.z,
        given ? fmt::format("below {:.6g}", box.z - (end - skirt)) : "",
        fmt::format(
            "{} with its skirt at {:.6g} m may reach to {:.6g} m, past the end of the box at {:.6g} m",
            canopy, skirt, end, box.z));
  }
  if (!findings.sound({"flow.cells"})) return;
  const std::array<int, 3>& cells = value.flow.cells;
  const double all = double(cells[0]) * cells[1] * cells[2];
  if (all > most_cells)
    findings.add(
        "flow.cells", fmt::format("[{}]", fmt::join(cells, ", ")),
        fmt::format("at most {:.0e} together", most_cells),
        fmt::format("{:.3g} cells are more than {:.0e}, more than the solver can hold", all, most_cells));
  if (!findings.sound({"flow.core.size_m", "flow.core.start_m", "flow.core.growth"})) return;
  const Vec3 core = value.flow.core.size_m;
  for (const auto& [index, side] : {std::pair{0, core.x}, std::pair{1, core.y}})
    if (side > 0 && side < diameter)
      findings.add(fmt::format("flow.core.size_m[{}]", index), side, fmt::format("at least {:.6g}", diameter),
                   fmt::format("{} does not fit into the fine core", canopy));
  if (core.z > 0 && value.flow.core.start_m.value_or(0) > skirt)
    findings.add("flow.core.start_m", *value.flow.core.start_m, fmt::format("at most {:.6g}", skirt),
                 fmt::format("the skirt, at {:.6g} m, lies before the fine core", skirt));
  if (!findings.sound({"flow.core.size_m", "flow.core.start_m"})) return;
  FlowGrid grid;
  try {
    grid = flow_grid(value);
  } catch (const Error& error) {
    return findings.add("flow.core", "", "", error.what());
  }
  const Vec3 width = grid.spacing();
  const double widths[] = {width.x, width.y, width.z};
  for (std::size_t i = 0; i < 3; ++i) {
    const double across = diameter / widths[i];
    if (across < fewest_cells_across)
      findings.add(
          fmt::format("flow.cells[{}]", i), cells[i],
          fmt::format("at least {:.0f}", std::ceil(cells[i] * fewest_cells_across / across)),
          fmt::format("only {:.2g} cells lie across the canopy's diameter; {} are the fewest that show a "
                      "canopy at all",
                      across, fewest_cells_across));
  }
}

/// What the engine has not is refused here, before the cloth has been relaxed for it.
void check_engine(const Case& value, Findings& findings) {
  const FlowSettings& flow = value.flow;
  if (!findings.sound({"flow"})) return;
  Abilities wanted;
  wanted.sheets = flow.porosity_model == PorosityModel::sheet;
  wanted.entraining_sides = flow.sides == Sides::entraining;
  wanted.still_air_outlet = flow.outlet == Outlet::still_air;
  wanted.averages = flow.average_over > 0;
  wanted.ranks = flow.ranks > 1;
  for (const Lack& lack : lacks(engine_of(flow.engine), wanted)) {
    if (lack.key == "flow.porosity_model")  // all that follows from it is lacking too
      return findings.add(
          "flow.engine", quoted(flow.engine), quoted(engines().front().word),
          fmt::format("the cloth {} is a sheet (flow.porosity_model), which this engine has not; it "
                      "needs cloth with coefficients of the \"paper\" model, such as \"f-111\"",
                      quoted(value.parachute.canopy_material)));
    findings.add(lack.key, lack.value, lack.instead,
                 fmt::format("the flow engine {} (flow.engine) has not that", quoted(flow.engine)));
  }
}

void check_load(const Case& value, Findings& findings) {
  if (value.coupling.load != CanopyLoad::of_flow || value.flow.porosity_model == PorosityModel::sheet) return;
  if (findings.sound({"coupling.load", "flow.porosity_model"}))
    findings.add("coupling.load", quoted("of-flow"), quoted("uniform"),
                 "what the air loses on every piece of cloth is known of a sheet only (flow.porosity_model)");
}

void check_average(const Case& value, Findings& findings) {
  const FlowSettings& flow = value.flow;
  if (findings.sound({"flow.average_over", "flow.max_iterations"}) && flow.average_over > flow.max_iterations)
    findings.add("flow.average_over", flow.average_over,
                 fmt::format("at most {}, flow.max_iterations", flow.max_iterations),
                 "a flow solution has no more iterations than that");
}

std::vector<Problem> problems_of(Case& value, std::vector<Problem> problems) {
  Fields fields;
  describe(fields, value);
  check_values(fields, value.origins, problems);
  Findings findings(value.origins, problems);
  check_design(value.parachute, findings);
  check_materials(value, findings);
  const std::string& cloth = value.parachute.canopy_material;
  if (findings.sound(shape_keys(value.parachute)) &&
      findings.sound({"parachute.canopy_material", "materials." + cloth}))
    settle_flow(value);
  check_measured(value, findings);
  check_box(value, findings);
  check_average(value, findings);
  check_engine(value, findings);
  check_load(value, findings);
  return problems;
}

/// Returns the keys that were set.
std::vector<std::string> set_values(const Overrides& overrides, Case& value) {
  std::vector<std::string> keys;
  const auto note = [&](const std::string& key, const std::string& option) {
    value.origins[key] = Origin{"", 0, 0, option};
    keys.push_back(key);
  };
  if (overrides.speed) {
    value.flow.speed_m_s = *overrides.speed;
    note("flow.speed_m_s", "--speed");
  }
  if (overrides.grid) {
    value.flow.cells = *overrides.grid;
    note("flow.cells", "--grid");
    for (int i = 0; i < 3; ++i) note(fmt::format("flow.cells[{}]", i), "--grid");
  }
  if (overrides.engine) {
    value.flow.engine = *overrides.engine;
    note("flow.engine", "--flow");
  }
  if (overrides.ranks) {
    value.flow.ranks = *overrides.ranks;
    note("flow.ranks", "--ranks");
  }
  if (overrides.linear) {
    value.coupling.linear = true;
    note("coupling.linear", "--linear");
  }
  return keys;
}

/// materials.<name>.<key> of a material that only the library has starts from the library's.
void import_material(Document& document, const Setting& setting) {
  const std::string prefix = "materials.";
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
          near.empty() ? fmt::format("no such material; there are {}", fmt::join(known, ", "))
                       : fmt::format("no such material; did you mean {}?", quoted(prefix + near))}});
  }
  set_value(document, {prefix + name + ".base", quoted(name), setting.option});
}

/// What a setting gave is told by its option, not by a place in the file.
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

}  // namespace

Case parse_case(const std::string& text, const std::string& name, const Overrides& overrides) {
  Case value;
  std::vector<Problem> problems;
  Document document = parse_toml(text, name);
  for (const Setting& setting : overrides.set) {
    import_material(document, setting);
    set_value(document, setting);
  }
  Fields fields;
  describe(fields, value);
  read_table(fields, document, value.origins, problems);
  for (const Setting& setting : overrides.set) mark_origin(setting, value.origins, problems);
  const std::vector<std::string> replaced = set_values(overrides, value);
  std::erase_if(problems, [&](const Problem& problem) {
    return std::find(replaced.begin(), replaced.end(), problem.key) != replaced.end();
  });
  problems = problems_of(value, problems);
  if (!problems.empty()) throw InputError(ExitCode::usage, problems);
  return value;
}

Case read_case(const std::filesystem::path& file, const Overrides& overrides) {
  Case value = parse_case(read_text_file(file), file.string(), overrides);
  value.file = file;
  return value;
}

void apply(const Overrides& overrides, Case& value) {
  Case changed = value;
  set_values(overrides, changed);
  const std::vector<Problem> problems = problems_of(changed, {});
  if (!problems.empty()) throw InputError(ExitCode::usage, problems);
  value = std::move(changed);
}

}  // namespace ripstop

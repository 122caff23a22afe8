// Every check of a case that looks at more than one key.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ripstop/case/cluster.h"
#include "ripstop/case/quantity_keys.h"
#include "ripstop/case/resolve.h"
#include "ripstop/core/toml/read.h"
#include "ripstop/core/words.h"
#include "ripstop/flight/atmosphere.h"

namespace ripstop::inline cases {
namespace {

constexpr double most_cells = 2e8;         // about 200 GB in the flow solver
constexpr double fewest_cells_across = 4;  // of the canopy's diameter

/// Brings the named material into the case from the library, unless the case has it, and checks its kind.
template <class Kind>
void find_material(Case& given, const std::string& key, const std::string& name, Findings& findings) {
  if (!findings.sound({key, "materials." + name})) return;
  auto found = given.materials.find(name);
  if (found == given.materials.end()) {
    try {
      found = given.materials.emplace(name, library_material(name)).first;
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

/// Tapes that a parachute without a given tape may use.
void add_library_tapes(Case& given) {
  for (const std::string& name : library_names()) {
    if (given.materials.contains(name)) continue;
    const Material material = library_material(name);
    if (std::holds_alternative<Tape>(material)) given.materials.emplace(name, material);
  }
}

void check_materials(Case& given, Findings& findings) {
  for (auto& [name, material] : given.materials) {
    set_name(material, name);
    const std::string table = "materials." + name;
    if (findings.sound({table})) check_material(material, table, findings);
    if (auto* fabric = std::get_if<Fabric>(&material); fabric && findings.sound({table}))
      settle_resistance(
          fabric->resistance,
          [&](const std::string& key) { return given.origins.contains(table + "." + key); },
          [&](const std::string& key, const std::string& message) {
            findings.add(table + "." + key, "", "", message);
          });
  }
  const Design& parachute = given.parachute;
  find_material<Fabric>(given, "parachute.canopy_material", parachute.canopy_material, findings);
  find_material<Line>(given, "parachute.lines.material", parachute.lines.material, findings);
  find_material<Line>(given, "parachute.riser.material", parachute.riser.material, findings);
  for (std::size_t i = 0; i < given.inflation.reefing.size(); ++i)
    if (const auto& name = given.inflation.reefing[i].material)
      find_material<Line>(given, fmt::format("inflation.reefing[{}].material", i), *name, findings);
  if (!parachute.tape.material)
    add_library_tapes(given);
  else if (*parachute.tape.material != no_tape)
    find_material<Tape>(given, "parachute.tape.material", *parachute.tape.material, findings);
}

void check_measured(const Case& given, Findings& findings) {
  if (!findings.sound({"measured", "flow.speed_m_s"})) return;
  std::vector<double> speeds;
  for (std::size_t i = 0; i < given.measured.size(); ++i) {
    const double speed = given.measured[i].nominal_speed_m_s;
    if (std::find(speeds.begin(), speeds.end(), speed) != speeds.end())
      findings.add(fmt::format("measured[{}].nominal_speed_m_s", i), speed, "",
                   "there is already a row of [[measured]] with this nominal speed");
    speeds.push_back(speed);
  }
  if (measured_row(given) || !given.flow.speed_m_s) return;
  const std::string rows = speeds.empty()
                               ? "there are no rows of [[measured]]"
                               : fmt::format("[[measured]] has rows for {}", fmt::join(speeds, ", "));
  if (given.flow.speed_basis == SpeedBasis::measured)
    findings.add("flow.speed_m_s", *given.flow.speed_m_s, fmt::format("{}", fmt::join(speeds, ", ")),
                 "speed_basis = \"measured\" needs a row of [[measured]] with this nominal speed; " + rows);
  else if (!given.flow.density_kg_m3 && !given.flow.height_m &&
           findings.sound({"flow.density_kg_m3", "flow.height_m"}))
    findings.add(
        "flow.density_kg_m3", "", "above 0 and at most 20",
        fmt::format("is missing, and no row of [[measured]] has the nominal speed {} to take it from; {}",
                    *given.flow.speed_m_s, rows));
}

/// The speed comes from itself or from the payload, the air from its own keys or from a height.
void check_flight(const Case& given, Findings& findings) {
  const FlowKeys& flow = given.flow;
  const bool payload = given.payload.mass_kg.has_value();
  if (!flow.speed_m_s && !payload && findings.sound({"flow.speed_m_s", "payload.mass_kg"}))
    findings.add(
        "flow.speed_m_s", "", "above 0 and at most 100",
        "is missing; write it, or [payload] with mass_kg, for which the steady run computes the speed");
  if (payload && flow.speed_basis == SpeedBasis::measured && findings.sound({"flow.speed_basis"}))
    findings.add("flow.speed_basis", quoted("measured"), quoted("nominal"),
                 "a measured speed cannot be combined with payload.mass_kg, for which the speed is computed");
  if (payload && !flow.speed_m_s && !flow.density_kg_m3 && !flow.height_m &&
      findings.sound({"flow.density_kg_m3", "flow.height_m"}))
    findings.add("flow.height_m", "", "",
                 "is missing: the descent of a payload needs flow.height_m or flow.density_kg_m3; write one");
  if (!flow.height_m || !findings.sound({"flow.height_m"})) return;
  const StandardAir air = standard_air(*flow.height_m);
  const std::string instead = fmt::format("remove it, or remove flow.height_m = {:g}", *flow.height_m);
  const auto agree = [&](const char* key, const std::optional<double>& value, double standard,
                         const char* unit) {
    if (!value || std::abs(*value / standard - 1) <= 1e-6 || !findings.sound({key})) return;
    findings.add(key, *value, fmt::format("{:.6g}", standard),
                 fmt::format("differs from the standard atmosphere at flow.height_m, {:.6g} {}: {}", standard,
                             unit, instead));
  };
  agree("flow.density_kg_m3", flow.density_kg_m3, air.density, "kg/m3");
  agree("flow.temperature_k", flow.temperature_k, air.temperature, "K");
}

/// Keys that the kind of tunnel has no use for, and the width that it needs.
void check_tunnel_keys(const TunnelKeys& tunnel, Findings& findings) {
  const bool jet = tunnel.kind == TunnelKind::open_jet, closed = tunnel.kind == TunnelKind::closed;
  const struct {
    const char* key;
    bool given, fits;
    const char* belongs_to;
  } keys[] = {{"shape", tunnel.shape.has_value(), jet || closed, "a tunnel"},
              {"width_m", tunnel.width_m.has_value(), jet || closed, "a tunnel"},
              {"height_m", tunnel.height_m.has_value(),
               closed || (jet && tunnel.shape == NozzleShape::rectangle), "a rectangle"},
              {"nozzle_distance_m", tunnel.nozzle_distance_m.has_value(), jet, "an open jet"},
              {"collector_distance_m", tunnel.collector_distance_m.has_value(), jet, "an open jet"},
              {"outside_speed", tunnel.outside_speed.has_value(), jet, "an open jet"},
              {"shear_layer_m", tunnel.shear_layer_m.has_value(), jet, "an open jet"},
              {"displacement_thickness_m", tunnel.displacement_thickness_m.has_value(), closed,
               "a closed test section"}};
  for (const auto& one : keys)
    if (one.given && !one.fits)
      findings.add(
          std::string("flow.tunnel.") + one.key, "", "",
          fmt::format(
              "is a key of {}, which flow.tunnel.kind and shape do not select (remove the key, or set them)",
              one.belongs_to));
  if ((jet || closed) && !tunnel.width_m && findings.sound({"flow.tunnel.width_m"}))
    findings.add("flow.tunnel.width_m", "", "above 0 and at most 200",
                 "is missing: the width of the nozzle, or of the test section");
  const double width = tunnel.width_m.value_or(0), least = std::min(width, tunnel.height_m.value_or(width));
  if (closed && width > 0 && tunnel.displacement_thickness_m.value_or(0) >= least / 2)
    findings.add("flow.tunnel.displacement_thickness_m", *tunnel.displacement_thickness_m,
                 fmt::format("below {:.6g}", least / 2), "the boundary layers fill the test section");
  if (closed && tunnel.shape.value_or(NozzleShape::rectangle) != NozzleShape::rectangle)
    findings.add("flow.tunnel.shape", "", quoted("rectangle"),
                 "the sides of the domain are the walls of a closed test section, which must be a rectangle");
}

/// Whether the box is the tunnel's.
void check_tunnel(const Case& given, const FlowSettings& flow, Findings& findings) {
  const TunnelKeys& keys = given.flow.tunnel;
  const TunnelSettings& tunnel = flow.tunnel;
  const double width = tunnel.nozzle.width, height = nozzle_height(tunnel.nozzle);
  const double sides[] = {width, height}, box[] = {flow.box_m.x, flow.box_m.y};
  if (tunnel.kind == TunnelKind::closed) {
    for (int i = 0; i < 2; ++i) {
      const double open = sides[i] - 2 * tunnel.displacement_thickness_m;
      if (std::abs(box[i] - open) > 1e-9 * open)
        findings.add(fmt::format("flow.box_m[{}]", i), box[i], fmt::format("{:.9g}", open),
                     "the sides of the domain are the walls of the closed test section (flow.tunnel)");
    }
    if (flow.sides != Sides::slip)
      findings.add("flow.sides", "", quoted("slip"), "a closed test section (flow.tunnel.kind) has walls");
  }
  if (tunnel.kind != TunnelKind::open_jet) return;
  for (int i = 0; i < 2; ++i)
    if (box[i] < narrowest_jet_box * sides[i])
      findings.add(fmt::format("flow.box_m[{}]", i), box[i],
                   fmt::format("at least {:.6g}", narrowest_jet_box * sides[i]),
                   "the domain is too narrow for the still air around the nozzle (flow.tunnel)");
  if (flow.sides == Sides::zero_gradient)
    findings.add("flow.sides", quoted("zero-gradient"), "entraining or slip",
                 "an open jet (flow.tunnel.kind) entrains ambient air through the sides");
  const auto [key, value] = keys.nozzle_distance_m
                                ? std::pair{"flow.tunnel.nozzle_distance_m", *keys.nozzle_distance_m}
                                : std::pair{"flow.canopy_position_m", flow.canopy_position_m};
  if (std::abs(flow.canopy_position_m - tunnel.nozzle_distance_m) > 1e-9 * tunnel.nozzle_distance_m)
    findings.add(key, value, fmt::format("{:.9g}", flow.canopy_position_m),
                 "the domain begins at the nozzle; flow.canopy_position_m is the same distance (remove one "
                 "of the two)");
  if (keys.collector_distance_m && std::abs(*keys.collector_distance_m - flow.box_m.z) > 1e-9 * flow.box_m.z)
    findings.add(
        "flow.tunnel.collector_distance_m", *keys.collector_distance_m, fmt::format("{:.9g}", flow.box_m.z),
        "the domain ends at the collector; flow.box_m contains the same length (remove one of the two)");
}

/// The start shape, and the inflated shape that it may turn into, have to lie inside the box.
void check_box(const Case& given, const FlowSettings& flow, Findings& findings) {
  const Vec3 box = flow.box_m;
  const double diameter = start_diameter(given.parachute);
  const std::string canopy = fmt::format("a canopy of {:.6g} m diameter", diameter);
  for (const auto& [index, side] : {std::pair{0, box.x}, std::pair{1, box.y}})
    if (side <= diameter)
      findings.add(fmt::format("flow.box_m[{}]", index), side, fmt::format("above {:.6g}", diameter),
                   fmt::format("{} does not fit into the flow domain", canopy));
  // Downstream of the skirt no point of a canopy is farther than its meridian is long.
  const double skirt = flow.canopy_position_m;
  const double end = skirt + start_depth(given.parachute) + diameter / 2;
  if (end >= box.z) {
    const bool placed = given.flow.canopy_position_m.has_value();
    findings.add(placed ? "flow.canopy_position_m" : "flow.box_m[2]", placed ? skirt : box.z,
                 placed ? fmt::format("below {:.6g}", box.z - (end - skirt)) : "",
                 fmt::format("{} with its skirt at {:.6g} m can extend to {:.6g} m, beyond the end of the "
                             "flow domain at {:.6g} m",
                             canopy, skirt, end, box.z));
  }
}

/// The core has to hold the canopy, and the cells have to show it.
void check_cells(const Case& given, const FlowSettings& flow, Findings& findings) {
  const double diameter = start_diameter(given.parachute), skirt = flow.canopy_position_m;
  const std::array<int, 3>& cells = flow.cells;
  const double all = double(cells[0]) * cells[1] * cells[2];
  if (all > most_cells)
    findings.add("flow.cells", fmt::format("[{}]", fmt::join(cells, ", ")),
                 fmt::format("at most {:.0e} together", most_cells),
                 fmt::format("{:.3g} cells exceed {:.0e}, the limit of the solver", all, most_cells));
  if (!findings.sound({"flow.core.size_m", "flow.core.start_m", "flow.core.growth"})) return;
  const Vec3 core = flow.core.size_m;
  for (const auto& [index, side] : {std::pair{0, core.x}, std::pair{1, core.y}})
    if (side > 0 && side < (1 - 1e-12) * diameter)  // the default is equal, except for rounding
      findings.add(fmt::format("flow.core.size_m[{}]", index), side, fmt::format("at least {:.6g}", diameter),
                   fmt::format("a canopy of {:.6g} m diameter does not fit into the fine core", diameter));
  if (core.z > 0 && flow.core.start_m > skirt)
    findings.add("flow.core.start_m", flow.core.start_m, fmt::format("at most {:.6g}", skirt),
                 fmt::format("the skirt, at {:.6g} m, is upstream of the fine core", skirt));
  if (flow.core.off_axis > 0 && !(core.x > 0 && core.y > 0))
    findings.add("flow.core.off_axis", flow.core.off_axis, "0",
                 "cells that are uniform over the width (flow.core.size_m = 0) are centred on the axis");
  if (!findings.sound({"flow.core.size_m", "flow.core.start_m"})) return;
  FlowGrid grid;
  try {
    grid = flow_grid(flow);
  } catch (const Error& error) {
    return findings.add("flow.core", "", "", message_of(error));
  }
  const Vec3 width = grid.spacing();
  const double widths[] = {width.x, width.y, width.z};
  for (std::size_t i = 0; i < 3; ++i) {
    const double across = diameter / widths[i];
    if (across < fewest_cells_across)
      findings.add(fmt::format("flow.cells[{}]", i), cells[i],
                   fmt::format("at least {:.0f}", std::ceil(cells[i] * fewest_cells_across / across)),
                   fmt::format("only {} cells across the diameter of the canopy; at least {} are required to "
                               "represent a canopy",
                               rounded_apart(across, fewest_cells_across).first, fewest_cells_across));
  }
}

/// Features that the engine does not support are refused here, before the cloth is relaxed.
void check_engine(const Case& given, const FlowSettings& flow, Findings& findings) {
  if (!findings.sound({"flow"})) return;
  std::vector<std::string> words;
  for (const EngineRecord& engine : engines()) words.push_back(engine.word);
  if (std::find(words.begin(), words.end(), flow.engine) == words.end())  // of a case made in code
    return findings.add("flow.engine", quoted(flow.engine), fmt::format("{}", fmt::join(words, ", ")),
                        "there is no such flow engine");
  Abilities wanted;
  wanted.sheets = flow.porosity_model == PorosityModel::sheet;
  wanted.boundaries = {std::string(flow.sides.word), std::string(flow.outlet.word)};
  wanted.jets = flow.tunnel.kind == TunnelKind::open_jet;
  wanted.averages = flow.average_over > 0;
  wanted.ranks = flow.ranks > 1;
  wanted.fitted_meshes = flow.mesh == FlowMesh::fitted;
  wanted.time = flow.unsteady;
  wanted.quarters = flow.symmetry == FlowSymmetry::quarter;
  for (const Lack& lack : lacks(engine_of(flow.engine), wanted)) {
    if (lack.quantity == "porosity model")  // all that follows from it is lacking too
      return findings.add(
          "flow.engine", quoted(flow.engine), quoted(engines().front().word),
          fmt::format(
              "the selected flow engine does not support the sheet model (flow.porosity_model) of the cloth "
              "{}; it needs cloth with coefficients of the \"paper\" model, such as \"f-111\"",
              quoted(given.parachute.canopy_material)));
    findings.add(key_of_quantity(lack.quantity), lack.value, lack.instead,
                 fmt::format("the flow engine {} (flow.engine) does not support it", quoted(flow.engine)));
  }
  if (wanted.fitted_meshes && !wanted.sheets && findings.sound({"flow.porosity_model"}))
    findings.add("flow.mesh", quoted("fitted"), quoted("grid"),
                 "cells can be fitted only to cloth of the sheet model (flow.porosity_model)");
  if (flow.cloth_levels > 0 && !wanted.fitted_meshes)
    findings.add("flow.cloth_levels", flow.cloth_levels, "0",
                 "cells are halved at the cloth only in a fitted mesh (flow.mesh)");
}

void check_load(const SettingsValues& values, Findings& findings) {
  if (values.coupling.load != CanopyLoad::of_flow || values.flow.porosity_model == PorosityModel::sheet)
    return;
  if (findings.sound({"coupling.load", "flow.porosity_model"}))
    findings.add(
        "coupling.load", quoted("of-flow"), quoted("uniform"),
        "the load of every piece of cloth is computed only in the sheet model (flow.porosity_model)");
}

void check_watch(const Case& given, const FlowSettings& flow, Findings& findings) {
  if (flow.unsteady && given.payload.mass_kg)
    findings.add("flow.unsteady", "true", "false",
                 "the speed at which drag equals weight (payload.mass_kg) needs a steady flow, because a "
                 "mean over time is too uncertain; compute the speed first, then write it into a second case "
                 "without the payload");
  const WatchKeys& watch = flow.watch;
  if (findings.sound({"flow.watch"}) && watch.longest < 2 * watch.shortest)
    findings.add(
        "flow.watch.longest", watch.longest, fmt::format("at least {:g}", 2 * watch.shortest),
        "the longest record must be at least twice the shortest averaging window (flow.watch.shortest)");
}

/// Coupled inflation steps a sheet and the built-in engine together.
void check_opening_air(const Case& given, const FlowSettings& flow, Findings& findings) {
  const bool flies = given.inflation.mass == InflationSettings::Mass::payload;
  const auto refuse = [&](const char* why) {
    findings.add("inflation.mass", quoted("payload"), quoted("infinite"), why);
  };
  if (flies && given.inflation.air != AirModel::coupled)
    refuse("a free payload needs coupled inflation (inflation.air = \"coupled\")");
  else if (flies && !given.payload.mass_kg)
    refuse("the payload has no mass (payload.mass_kg)");
  else if (flies && flow.tunnel.kind != TunnelKind::free_air)
    refuse("a payload cannot move in a wind tunnel (flow.tunnel)");
  if (given.inflation.air != AirModel::coupled) return;
  if (!findings.sound({"flow.porosity_model", "flow.engine"})) return;
  if (flow.porosity_model != PorosityModel::sheet)
    findings.add(
        "inflation.air", quoted("coupled"), quoted("uniform"),
        "coupled inflation needs the sheet model: set flow.porosity_model = \"sheet\" and a cloth with "
        "an air permeability");
  else if (!engine_of(given.flow.engine).can.time)
    findings.add("inflation.air", quoted("coupled"), quoted("uniform"),
                 fmt::format("the flow engine {} (flow.engine) does not support unsteady flow",
                             quoted(given.flow.engine)));
}

void check_average(const FlowSettings& flow, Findings& findings) {
  if (findings.sound({"flow.average_over", "flow.max_iterations"}) && flow.average_over > flow.max_iterations)
    findings.add("flow.average_over", flow.average_over,
                 fmt::format("at most {}, flow.max_iterations", flow.max_iterations),
                 "a flow solution has at most that number of iterations");
}

/// Lines get longer from cut to cut, and one longer than the skirt is round would hold nothing.
void check_reefing(const Case& given, Findings& findings) {
  const std::vector<ReefingStage>& stages = given.inflation.reefing;
  const auto rises = [&](std::size_t i, const char* name, double before, double value, const char* why) {
    const std::string key = fmt::format("inflation.reefing[{}].{}", i, name);
    if (value <= before && findings.sound({key, fmt::format("inflation.reefing[{}].{}", i - 1, name)}))
      findings.add(key, value, fmt::format("above {:g}", before), why);
  };
  for (std::size_t i = 1; i < stages.size(); ++i) {
    rises(i, "cut_s", stages[i - 1].cut_s, stages[i].cut_s,
          "the line of a stage must be cut after that of the previous stage");
    rises(i, "line_m", stages[i - 1].line_m, stages[i].line_m,
          "the line must be longer than that of the previous stage, else the canopy does not open when that "
          "is cut");
  }
  if (!findings.sound(shape_keys(given.parachute))) return;
  const double round = skirt_circumference(given.parachute);
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const std::string key = fmt::format("inflation.reefing[{}].line_m", i);
    if (stages[i].line_m >= round && findings.sound({key}))
      findings.add(
          key, stages[i].line_m, fmt::format("below {:.4g}", round),
          fmt::format(
              "the circumference of the skirt is {:.4g} m: this line does not reef it (remove the stage)",
              round));
  }
}

/// How much an opening writes and how fine its lines are.
void check_inflation(const Case& given, Findings& findings) {
  constexpr double most_rows = 1e7;  // 400 MB of history
  const InflationSettings& inflation = given.inflation;
  const double rows = inflation.history_hz * inflation.duration_s;
  if (findings.sound({"inflation.history_hz", "inflation.duration_s"}) && rows > most_rows)
    findings.add("inflation.history_hz", inflation.history_hz,
                 fmt::format("at most {:.4g}", most_rows / inflation.duration_s),
                 fmt::format("{:.3g} rows over inflation.duration_s = {:g} s exceed the limit of {:.0e}",
                             rows, inflation.duration_s, most_rows));
  if (inflation.line_segment_m && findings.sound({"parachute.mesh.line_segment_m"}))
    check_line_nodes(given.parachute, "inflation.line_segment_m", *inflation.line_segment_m, findings);
}

void check_hardware(const Case& given, Findings& findings) {
  for (const auto& [name, part] : given.hardware) {
    const std::string table = "hardware." + name;
    if (!findings.sound({table})) continue;
    if (part.breaking_load_n && part.rated_load_n)
      findings.add(
          table, "", "",
          "has breaking_load_n and rated_load_n: give only one of them; rated_load_n is the load that "
          "the maker allows");
    if (!part.breaking_load_n && !part.rated_load_n)
      findings.add(table, "", "",
                   "needs its strength: give either breaking_load_n or rated_load_n (the load that the maker "
                   "allows)");
    if (part.length_m.has_value() != part.stiffness_n.has_value())
      findings.add(
          table, "", "",
          "has one of length_m and stiffness_n: give both for its stretch in the snatch, or neither");
    // A cord without its kind would be metal, without the factors of a line.
    if (!part.kind && (part.length_m || part.stiffness_n))
      findings.add(
          table, "", "",
          "stretches, and its material is missing: give kind = \"textile\" (cord, webbing) or \"metal\"");
  }
}

void check_deployment(const Case& given, Findings& findings) {
  if (!given.deployment) return;
  if (given.deployment->relative_speed_m_s && given.deployment->ejection_impulse_n_s &&
      findings.sound({"deployment.relative_speed_m_s", "deployment.ejection_impulse_n_s"}))
    findings.add("deployment.ejection_impulse_n_s", *given.deployment->ejection_impulse_n_s, "",
                 "deployment.relative_speed_m_s determines the same speed; remove one of the two keys");
}

/// Settings that need values of parachute and cloth.
void check_settings(Case given, Findings& findings) {
  const std::string& cloth = given.parachute.canopy_material;
  if (!findings.sound(shape_keys(given.parachute)) ||
      !findings.sound({"parachute.canopy_material", "materials." + cloth}))
    return;
  if (!measured_row(given)) {  // reported by check_measured(); the domain does not depend on the air
    given.flow.speed_basis = SpeedBasis::nominal;
    if (!given.flow.density_kg_m3) given.flow.density_kg_m3 = 1;
  }
  check_tunnel_keys(given.flow.tunnel, findings);
  if (!findings.sound({"flow.tunnel"})) return;
  if (!given.flow.speed_m_s) given.flow.speed_m_s = 1;  // reported by check_flight()
  if (!findings.sound({"flow.height_m"})) given.flow.height_m.reset();
  const SettingsValues values = settings_values(given);
  const FlowSettings& flow = values.flow;
  if (findings.sound({"flow.box_m", "flow.canopy_position_m", "flow.sides"}))
    check_tunnel(given, flow, findings);
  if (findings.sound({"flow.box_m", "flow.canopy_position_m"})) {
    check_box(given, flow, findings);
    if (findings.sound({"flow.cells"})) check_cells(given, flow, findings);
  }
  check_bodies(given, flow.porosity_model, findings);
  check_cluster(given, flow, findings);
  check_average(flow, findings);
  check_opening_air(given, flow, findings);
  check_watch(given, flow, findings);
  check_engine(given, flow, findings);
  check_load(values, findings);
}

/// Adds its findings to `problems`, and the library materials of the parachute to the case.
void check(Case& given, std::vector<Problem>& problems) {
  Fields fields;
  describe(fields, given);
  check_values(fields, given.origins, problems);
  Findings findings(given.origins, problems);
  check_design(given.parachute, findings);
  check_materials(given, findings);
  check_measured(given, findings);
  check_flight(given, findings);
  check_inflation(given, findings);
  check_reefing(given, findings);
  check_deployment(given, findings);
  check_hardware(given, findings);
  check_settings(given, findings);
}

}  // namespace

std::vector<Problem> validate(const Case& given) {
  Case complete = given;
  std::vector<Problem> problems;
  check(complete, problems);
  return problems;
}

Case checked(Case given, std::vector<Problem> known) {
  check(given, known);
  if (!known.empty()) throw InputError(ExitCode::usage, std::move(known));
  return given;
}

}  // namespace ripstop::inline cases

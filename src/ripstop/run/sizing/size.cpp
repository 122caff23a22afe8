#include "ripstop/run/sizing/size.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/case/payload.h"
#include "ripstop/case/summary.h"
#include "ripstop/case/tape.h"
#include "ripstop/core/build_info.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/positive.h"
#include "ripstop/core/toml/fields.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/descent.h"
#include "ripstop/run/json.h"
#include "ripstop/run/sizing/pattern.h"
#include "ripstop/run/sizing/size_case.h"

namespace ripstop {
namespace {

FamilyDrag drag_of(const std::string& family) {
  const std::vector<FamilyDrag> all = family_drags();
  std::vector<std::string> names;
  for (const FamilyDrag& row : all) {
    if (row.family == family) return row;
    names.push_back(row.family);
  }
  const std::string near = nearest(family, names);
  throw Error(ExitCode::usage,
              fmt::format("--family {}: no such family in examples/families.json; {}there are {}", family,
                          near.empty() ? "" : "did you mean " + near + "? ", fmt::join(names, ", ")));
}

/// The design scaled so that payload and parachute come down at the wanted rate; the parachute's mass follows its size.
void find_size(const SizeRequest& request, SizeResult& r) {
  Case& given = r.given;
  const double first = nominal_diameter(given.parachute);
  const Design example = given.parachute;
  double mass = request.payload_mass, factor = 1;
  for (int i = 0; i < 12; ++i) {
    const double area = drag_area_for(mass, request.descent_rate, r.density) / r.drag_coefficient;
    const double next = std::sqrt(4 / std::numbers::pi * area) / first;
    const bool done = std::abs(next / factor - 1) < 1e-5;
    factor = next;
    given.parachute = example;
    scale_lengths(given.parachute, factor);
    mass = request.payload_mass + parachute_mass(resolve(given));
    if (done) return;
  }
}

void find_opening(const SizeRequest& request, SizeResult& r) {
  LoadRequest asked;
  asked.payload_mass = request.payload_mass;
  asked.speed = r.deployment_speed;
  asked.height = std::max(r.height, 100.0);
  asked.drag_coefficient = r.drag_coefficient;
  LoadResult load = run_load(resolve(r.given), asked);
  r.opening_load_low = load.stages.front().lowest, r.opening_load = load.stages.front().highest;
  r.opening = std::move(load.stages), r.flight = std::move(load.flight);
}

/// Safety factor times the load of one line over what is left of its strength.
double used_of(const Case& given, const Line& line, double load) {
  MemberLoads loads;
  loads.lines = {load / given.parachute.lines.count};
  const Margins margins = margins_of(loads, given.margins, canopy_fabric(given), nullptr, line, line);
  const Margin* of_line = nullptr;
  for (const Margin& m : margins.members)
    if (m.member == "line 1") of_line = &m;
  return of_line && of_line->used ? *of_line->used : 0;
}

/// The lightest line of the library that holds the opening load.
void choose_line(const SizeRequest& request, SizeResult& r) {
  std::optional<Line> best;
  for (const std::string& name : library_names()) {
    const Material material = library_material(name);
    const Line* line = std::get_if<Line>(&material);
    if (!line || (request.line_material && name != *request.line_material)) continue;
    const double used = used_of(r.given, *line, r.opening_load);
    const bool known = used > 0;
    if (!request.line_material && (!known || used > 1)) continue;
    if (!best || line->linear_density_kg_m < best->linear_density_kg_m) best = *line;
  }
  if (request.line_material && !best)
    throw Error(ExitCode::usage,
                fmt::format("--line-material {}: the library has no such line", *request.line_material));
  if (!best) {
    r.warnings.push_back(
        fmt::format("no line of the library holds {:.0f} N on {} lines with the default margins: take "
                    "more lines, reefing or another line",
                    r.opening_load, r.given.parachute.lines.count));
    return;
  }
  Design& design = r.given.parachute;
  design.lines.material = best->name;
  if (design.riser.length_m == 0) design.riser.material = best->name;
  r.given.materials.insert_or_assign(best->name, *best);
}

void choose_tape(SizeResult& r) {
  TapeMaterial tape = tape_for(r.given, r.opening_load / r.given.parachute.lines.count);
  r.given.parachute.tape.material = tape.name;
  r.tape_material = std::move(tape.name), r.tape_source = std::move(tape.from);
}

void describe_parachute(const SizeRequest& request, SizeResult& r) {
  find_opening(request, r);
  r.line_used = used_of(r.given, suspension_line(r.given), r.opening_load);
  const Design& design = r.given.parachute;
  r.nominal_area = nominal_area(design);
  r.nominal_diameter = nominal_diameter(design);
  r.vent_area = facts(design).vent_area;
  r.gores = design.gores, r.line_count = design.lines.count, r.line_length = design.lines.length_m;
  r.line_material = design.lines.material, r.canopy_material = design.canopy_material;
  const Settings resolved = resolve(r.given);
  const PatternResult pattern = run_pattern(resolved, {}, request.packing_density);
  r.packed_volume = pattern.bill.packed_volume;
  const CaseSummary summary = summarize(resolved);
  r.cloth_mass = summary.mass.cloth, r.tape_mass = summary.mass.tape;
  r.line_mass = summary.mass.lines + summary.mass.riser;
  r.parachute_mass = parachute_mass(resolved);
  if (r.handbook_drag_coefficient) {
    const double scale = r.nominal_diameter * std::sqrt(r.drag_coefficient);
    r.handbook_diameter = {scale / std::sqrt(r.handbook_drag_coefficient->at(0)),
                           scale / std::sqrt(r.handbook_drag_coefficient->at(1))};
  }
  r.case_text = size_case_text(request, r);
}

Case example_case(const SizeRequest& request, const SizeResult& r) {
  Case given = read_case(data_directory() / "examples" / request.family / "case.toml");
  given.parachute.nominal_area_m2.reset();
  const std::vector<std::string> library = library_names();
  if (std::find(library.begin(), library.end(), given.parachute.canopy_material) == library.end())
    given.parachute.canopy_material = Design().canopy_material;  // the example's own is not for others
  Case fresh;
  fresh.title =
      fmt::format("{} for {:g} kg at {:g} m/s", request.family, request.payload_mass, request.descent_rate);
  fresh.parachute = given.parachute;
  fresh.parachute.tape.material.reset();  // follows from size and load
  fresh.origins = given.origins;
  fresh.origins.erase("parachute.tape.material");
  fresh.payload.mass_kg = request.payload_mass;
  if (request.density)
    fresh.flow.density_kg_m3 = r.density;
  else
    fresh.flow.height_m = request.height;
  return checked(std::move(fresh));
}

}  // namespace

std::vector<FamilyDrag> family_drags() {
  const std::filesystem::path file = data_directory() / "examples/families.json";
  try {
    const auto data = nlohmann::json::parse(read_file(file));
    std::vector<FamilyDrag> all;
    for (const auto& row : data.at("families")) {
      FamilyDrag drag{row.at("family"),
                      row.at("type"),
                      row.at("drag_coefficient"),
                      {},
                      row.at("speed_m_s"),
                      row.at("density_kg_m3"),
                      fmt::format("{}, {}", data.at("made_by").get<std::string>(),
                                  data.at("made_on").get<std::string>())};
      const auto& handbook = row.at("handbook_drag_coefficient");
      if (!handbook.is_null()) drag.handbook = {handbook.at(0).get<double>(), handbook.at(1).get<double>()};
      all.push_back(std::move(drag));
    }
    return all;
  } catch (const nlohmann::json::exception& error) {
    throw Error(ExitCode::bad_data,
                fmt::format("{}: not the table of families: {}", file.string(), error.what()));
  }
}

std::string to_json(const SizeResult& result) {
  return json_text(result);
}

SizeResult run_size(const SizeRequest& request) {
  require_positive("payload mass (kg)", request.payload_mass);
  require_positive("descent rate (m/s)", request.descent_rate);
  if (request.density) require_positive("density (kg/m3)", *request.density);
  require_positive("packing density (kg/m3)", request.packing_density);
  SizeResult r;
  const FamilyDrag drag = drag_of(request.family);
  r.family = request.family, r.type = drag.type;
  r.payload_mass = request.payload_mass, r.descent_rate = request.descent_rate;
  r.height = request.height;
  r.density = request.density ? *request.density : standard_air(request.height).density;
  r.drag_coefficient = request.drag_coefficient.value_or(drag.drag_coefficient);
  require_positive("drag coefficient", r.drag_coefficient);
  r.drag_source =
      request.drag_coefficient ? "given" : fmt::format("computed at {:g} m/s: {}", drag.speed, drag.made);
  r.handbook_drag_coefficient = drag.handbook;
  r.deployment_speed = request.deployment_speed.value_or(usual_deployment_speed(request.descent_rate));
  require_positive("deployment speed (m/s)", r.deployment_speed);
  if (r.deployment_speed <= request.descent_rate)
    throw Error(ExitCode::usage,
                fmt::format("a descent rate of {:g} m/s is not below the deployment speed of {:g} m/s",
                            request.descent_rate, r.deployment_speed));
  r.given = example_case(request, r);
  find_size(request, r);
  find_opening(request, r);
  choose_line(request, r);
  choose_tape(r);
  find_size(request, r);
  describe_parachute(request, r);
  return r;
}

void verify_size(const SizeRequest& request, SizeResult& r,
                 const std::function<SteadyResult(const Settings&, int run)>& fly, double tolerance) {
  constexpr int most = 4;
  for (int run = 1; run <= most; ++run) {
    const SteadyResult flown = fly(resolve(parse_case(r.case_text, "the sized case")), run);
    if (!flown.converged)
      throw Error(ExitCode::not_converged,
                  fmt::format("--verify: run {} has not converged, so that its descent rate "
                              "says nothing",
                              run));
    r.checks.push_back({r.nominal_diameter, flown.speed, flown.drag_coefficient});
    if (std::abs(flown.speed / request.descent_rate - 1) <= tolerance) return;
    scale_lengths(r.given.parachute, flown.speed / request.descent_rate);
    r.drag_coefficient = flown.drag_coefficient, r.drag_source = "computed by --verify at the descent rate";
    describe_parachute(request, r);
  }
  throw Error(ExitCode::not_converged,
              fmt::format("--verify: after {} runs the descent rate is {:.3g} m/s instead of {:g}", most,
                          r.checks.back().descent_rate, request.descent_rate));
}

}  // namespace ripstop

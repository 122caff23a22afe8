#include "ripstop/run/sizing/size.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/case/payload.h"
#include "ripstop/case/tape.h"
#include "ripstop/core/build_info.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/positive.h"
#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/core/words.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/validity.h"
#include "ripstop/parachute/scale.h"
#include "ripstop/run/json.h"
#include "ripstop/run/opening/handbook.h"
#include "ripstop/run/sizing/line_choice.h"
#include "ripstop/run/sizing/size_case.h"
#include "ripstop/run/used_run.h"

namespace ripstop::inline run {
namespace {

// Relative difference of drag and weight that remains from rounding the lengths of the case file.
constexpr double size_tolerance = 2e-3;

FamilyDrag drag_of(const std::string& family) {
  const std::vector<FamilyDrag> all = family_drags();
  std::vector<std::string> names;
  for (const FamilyDrag& row : all) {
    if (row.family == family) return row;
    names.push_back(row.family);
  }
  const bool exists = std::ranges::any_of(
      families(), [&](const CanopyFamily* each) { return each->type == std::string_view(family); });
  if (exists)
    throw Error(
        ExitCode::usage,
        fmt::format("--family {}: no computed drag coefficient is shipped for this family; use one of {}, "
                    "or write a case of this family and use ripstop load",
                    family, fmt::join(names, ", ")));
  const std::string near = nearest(family, names);
  throw Error(ExitCode::usage,
              fmt::format("--family {}: there is no such family; {}available: {}", family,
                          near.empty() ? "" : "did you mean " + near + "? ", fmt::join(names, ", ")));
}

/// Drag and weight at `factor` times the size of the example.
struct Balance {
  double drag = 0, weight = 0;  // [N]
  double parachute_mass = 0;    // [kg]
};
Balance balance_of(const SizeRequest& request, const SizeResult& r, const Case& sized,
                   const PartMaterials& materials) {
  const double q = 0.5 * r.density * request.descent_rate * request.descent_rate;
  Balance b;
  b.parachute_mass = parachute_mass(sized.parachute, materials);
  b.drag = q * r.drag_coefficient * nominal_area(sized.parachute);
  b.weight = (request.payload_mass + b.parachute_mass) * standard_gravity;
  return b;
}

/// Why the largest size that a case file takes still descends faster than wanted.
[[noreturn]] void refuse_size(const SizeRequest& request, const SizeResult& r, const Balance& largest,
                              const ScaleLimits& limits) {
  const double alone =
      request.descent_rate * std::sqrt(largest.parachute_mass * standard_gravity / largest.drag);
  if (alone >= request.descent_rate)
    throw Error(
        ExitCode::usage,
        fmt::format("this cloth ({}, with lines and seams) descends at {:.3g} m/s without a payload in air "
                    "of {:.3g} kg/m3: no size reaches {:g} m/s; use a higher descent rate or a lighter cloth",
                    r.given.parachute.canopy_material, alone, r.density, request.descent_rate));
  throw Error(
      ExitCode::usage,
      fmt::format("{:g} kg at {:g} m/s in air of {:.3g} kg/m3 requires a larger parachute than a case file "
                  "can describe: parachute.{} is at most {:g} m; use a smaller mass or a higher descent rate",
                  request.payload_mass, request.descent_rate, r.density, limits.high_key, limits.high_value));
}

/// An interval with a root of a rising function, and the function at its ends.
struct Bracket {
  double low = 0, high = 0, below = 0, above = 0;
};

/// The root by the Illinois method: linear interpolation, where an end that remains twice counts with half its value.
template <class Function>
double root_in(Bracket b, const Function& function) {
  int last = 0;  // the end that moved: -1 low, 1 high
  while (b.high - b.low > 1e-7) {
    const double x = b.low - b.below * (b.high - b.low) / (b.above - b.below), value = function(x);
    if (std::abs(value) < 1e-8) return x;
    const int end = value > 0 ? 1 : -1;
    (end > 0 ? b.high : b.low) = x, (end > 0 ? b.above : b.below) = value;
    if (end == last) (end > 0 ? b.below : b.above) *= 0.5;
    last = end;
  }
  return 0.5 * (b.low + b.high);
}

/// The example scaled so that payload and parachute descend at the wanted rate. The mass of the parachute is at most of
/// second order in its size, as the drag is, and there is mass without size: drag over weight rises from 0 towards the
/// limit of the cloth alone, and is 1 at one size at most.
void find_size(const SizeRequest& request, const Design& example, SizeResult& r) {
  const ScaleLimits limits = scale_limits(example);
  Case sized = r.given;
  const PartMaterials materials = resolve(sized).materials();  // the example's, whatever its size
  const auto excess = [&](double log_factor) {                 // ln(drag / weight)
    sized.parachute = example;
    scale_lengths(sized.parachute, std::exp(log_factor), Rounded::no);
    const Balance b = balance_of(request, r, sized, materials);
    return std::log(b.drag / b.weight);
  };
  Bracket bracket;
  bracket.high = std::log(limits.high), bracket.above = excess(bracket.high);
  if (!(bracket.above > 0)) refuse_size(request, r, balance_of(request, r, sized, materials), limits);
  bracket.low = std::log(limits.low), bracket.below = excess(bracket.low);
  if (bracket.below > 0)
    throw Error(
        ExitCode::usage,
        fmt::format(
            "{:g} kg at {:g} m/s in air of {:.3g} kg/m3 requires a smaller parachute than a case file can "
            "describe: parachute.{} is at least {:g} m; use a larger mass or a lower descent rate",
            request.payload_mass, request.descent_rate, r.density, limits.low_key, limits.low_value));
  r.given.parachute = example;
  scale_lengths(r.given.parachute, std::exp(root_in(bracket, excess)));
  const Balance found = balance_of(request, r, r.given, materials);
  if (!(std::abs(found.drag / found.weight - 1) <= size_tolerance))
    throw Error(
        ExitCode::not_converged,
        fmt::format("no size was found: at a nominal diameter of {:.4g} m the drag is {:.2f} % of the "
                    "weight",
                    nominal_diameter(r.given.parachute), 100 * found.drag / found.weight));
}

void find_opening(const SizeRequest& request, SizeResult& r) {
  LoadRequest asked;
  asked.payload_mass = request.payload_mass;
  asked.speed = r.deployment_speed;
  asked.drag_coefficient = r.drag_coefficient;
  asked.descent = false;  // only the opening is used
  LoadResult load = run_load(resolve(r.given), asked);
  r.opening_load_low = load.stages.front().lowest, r.opening_load = load.stages.front().highest;
  r.lowest_finite_mass_load.reset(), r.highest_finite_mass_load.reset();
  if (const auto range = finite_mass_range(load.stages.front().methods))
    r.lowest_finite_mass_load = range->lowest, r.highest_finite_mass_load = range->highest;
  r.air_source = std::move(load.air_source);
  r.design_load = load.design_load, r.design_load_from = std::move(load.design_load_from);
  r.design_load_caution = std::move(load.design_load_caution);
  r.load_uncertainty = load.load_uncertainty;
  r.load_uncertainty_from = load_uncertainty({r.drag_coefficient, r.drag_basis + " coefficient",
                                              load.drag_uncertainty, r.drag_basis})
                                .from;
  r.highest_design_load = load.highest_design_load;
  r.smallest_margin = load.smallest_margin, r.smallest_margin_member = std::move(load.smallest_margin_member);
  r.line_load_factor = load.line_load_factor;
  r.margins = std::move(load.margins), r.highest_margins = std::move(load.highest_margins);
  r.load_warnings = std::move(load.warnings);
  r.opening = std::move(load.stages), r.flight = std::move(load.flight);
}

/// Lines and tape for the highest design load of the present size. They never become lighter from one call to the next, so that
/// the choice ends. Returns whether something changed.
bool choose_materials(const std::vector<Line>& lines, SizeResult& r, double& least_line,
                      double& least_riser) {
  Design& design = r.given.parachute;
  const Design before = design;
  const Line& line = line_for(r.given, r.highest_design_load, lines, LineMember::line, least_line);
  least_line = line.linear_density_kg_m;
  design.lines.material = design.riser.material = line.name;
  r.given.materials.insert_or_assign(line.name, line);
  if (design.riser.length_m > 0) {
    const Line& riser = line_for(r.given, r.highest_design_load, lines, LineMember::riser, least_riser);
    least_riser = riser.linear_density_kg_m;
    design.riser.material = riser.name;
    r.given.materials.insert_or_assign(riser.name, riser);
  }
  TapeMaterial tape = tape_for(r.given, r.line_load_factor * r.highest_design_load / design.lines.count);
  design.tape.material = tape.name;
  r.tape_material = std::move(tape.name), r.tape_used = tape.used;
  r.tape_source = std::move(tape.from) + " under the highest design load";
  return before.lines.material != design.lines.material || before.riser.material != design.riser.material ||
         before.tape.material != design.tape.material;
}

/// Size, opening load, lines and tape follow from each other: repeated until lines and tape stay.
void find_materials(const SizeRequest& request, const std::vector<Line>& lines, const Design& example,
                    SizeResult& r) {
  constexpr int most = 12;
  double least_line = 0, least_riser = 0;
  for (int i = 0; i < most; ++i) {
    Design scaled = example;
    if (i > 0) {
      scaled.lines.material = r.given.parachute.lines.material;
      scaled.riser.material = r.given.parachute.riser.material;
      scaled.tape.material = r.given.parachute.tape.material;
    }
    find_size(request, scaled, r);
    find_opening(request, r);
    if (!choose_materials(lines, r, least_line, least_riser) && i > 0) return;
  }
  throw Error(
      ExitCode::not_converged,
      fmt::format("the choice of lines and tape does not converge within {} iterations: give --line-material",
                  most));
}

bool is_sound(const Design& design) {
  std::vector<Problem> problems;
  Findings findings({}, problems);
  check_design(design, findings);
  return problems.empty();
}

/// Gives `example` at least `times` as many lines, and gores in proportion where the family allows that (a cross keeps
/// its arms). False: there are no more than most_lines.
bool add_lines(Design& example, double times) {
  constexpr int most_lines = 120;  // as many as the largest cargo parachutes have
  const int gores = example.gores, count = example.lines.count;
  const int wanted = static_cast<int>(std::min<double>(most_lines, std::ceil(count * times)));
  for (const bool in_proportion : {true, false})
    for (int more = std::max(count + 1, wanted); more <= most_lines; ++more) {
      if (in_proportion && gores * more % count != 0) continue;
      Design trial = example;
      trial.lines.count = more, trial.gores = in_proportion ? gores * more / count : gores;
      if (!is_sound(trial)) continue;
      example = trial;
      return true;
    }
  return false;
}

double largest_line_used(const SizeResult& r) {
  return used_of(r.given, r.highest_design_load, suspension_line(r.given), LineMember::line);
}

/// Lines and tape of the library that hold; where none does, more gores and lines share the load.
void find_parachute(const SizeRequest& request, SizeResult& r) {
  const std::vector<Line> lines = library_lines(request.line_material);
  Design example = r.given.parachute;
  find_materials(request, lines, example, r);
  const int count = example.lines.count;
  const auto used = [&r] { return std::max(largest_line_used(r), r.tape_used); };
  while (!request.line_material && used() > 1 && add_lines(example, used())) {
    find_materials(request, lines, example, r);
    r.gores_source = fmt::format(
        "{} lines of the example are too few for the strongest line and tape of the library", count);
  }
}

void warn(const SizeRequest& request, SizeResult& r) {
  r.warnings = r.load_warnings;
  const StandardAir air = standard_air(r.height);
  const double reynolds = r.density * request.descent_rate * r.nominal_diameter / air.viscosity;
  for (const std::string& text : outside_range(
           flow_model,
           {{"Mach number", request.descent_rate / air.sound_speed}, {"Reynolds number", reynolds}}))
    r.warnings.push_back("drag coefficient: " + text);
  if (r.parachute_mass > request.payload_mass)
    r.warnings.push_back(
        fmt::format("the parachute of {:.3g} kg is heavier than its payload of {:g} kg: the descent rate is "
                    "close to that of the canopy alone",
                    r.parachute_mass, request.payload_mass));
}

void describe_parachute(const SizeRequest& request, SizeResult& r) {
  r.given.inflation.drag_coefficient = r.drag_coefficient;
  r.given.inflation.drag_coefficient_basis =
      r.drag_basis == "descent" ? InflationSettings::Basis::descent : InflationSettings::Basis::axial;
  find_opening(request, r);
  r.line_used = largest_line_used(r);
  const Design& design = r.given.parachute;
  r.nominal_area = nominal_area(design);
  r.nominal_diameter = nominal_diameter(design);
  r.vent_area = facts(design).vent_area;
  r.gores = design.gores, r.line_count = design.lines.count, r.line_length = design.lines.length_m;
  r.line_material = design.lines.material, r.canopy_material = design.canopy_material;
  const Settings resolved = resolve(r.given);
  r.packed_volume = parachute_bill(resolved, {}, request.packing_density).packed_volume;
  const PartMasses masses = parachute_masses(resolved);
  r.cloth_mass = masses.cloth, r.tape_mass = masses.tape, r.line_mass = masses.lines + masses.riser;
  r.parachute_mass = masses.total;
  if (r.handbook_drag_coefficient) {
    const double scale = r.nominal_diameter * std::sqrt(r.drag_coefficient);
    r.handbook_diameter = {scale / std::sqrt(r.handbook_drag_coefficient->at(0)),
                           scale / std::sqrt(r.handbook_drag_coefficient->at(1))};
  }
  warn(request, r);
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
  fresh.payload.deployment_speed_m_s = r.deployment_speed;
  if (request.density)
    fresh.flow.density_kg_m3 = r.density;
  else
    fresh.flow.height_m = request.height;
  return checked(std::move(fresh));
}

}  // namespace

namespace {

std::optional<FlownDrag> flown_drag(const std::string& family, const std::string& cloth) {
  for (const FlownDrag& row : flown_drags())
    if (row.family == family && row.cloth == cloth) return row;
  return {};
}

/// A coefficient and the words that name it.
void take_coefficient(const SizeRequest& request, const FamilyDrag& drag, SizeResult& r) {
  constexpr double sure = 2;  // standard errors
  r.axial_coefficient = drag.drag_coefficient;
  if (drag.flown)
    r.flown_coefficient = drag.flown->drag_coefficient, r.flown_error = drag.flown->standard_error;
  const double flown = drag.flown ? drag.flown->drag_coefficient : 0,
               lower = drag.flown ? flown - sure * drag.flown->standard_error : 0;
  const auto of_flight = [&](double value, const char* how) {
    r.drag_basis = "descent", r.drag_coefficient = value;
    r.drag_source =
        fmt::format("in descent: {:.3f} +- {:.3f} over {} half-swings of a computed free flight{} ({})",
                    flown, drag.flown->standard_error, drag.flown->half_swings, how, drag.flown->made);
  };
  if (request.drag_coefficient_on == DragReference::projected && !request.drag_coefficient)
    throw Error(ExitCode::usage, "--drag-coefficient-on projected needs --drag-coefficient");
  if (request.drag_coefficient && request.drag_coefficient_on == DragReference::projected) {
    const double ratio = drag.projected_ratio;
    r.drag_basis = "given", r.drag_coefficient = *request.drag_coefficient * ratio * ratio;
    r.drag_source =
        fmt::format("given as {:g} on the projected area; projected / nominal diameter {:.3f}, {}",
                    *request.drag_coefficient, ratio, drag.made);
  } else if (request.drag_coefficient) {
    r.drag_basis = "given", r.drag_source = "given", r.drag_coefficient = *request.drag_coefficient;
  } else if (request.basis == DragBasis::descent && !drag.flown) {
    throw Error(ExitCode::usage,
                fmt::format("--coefficient descent: examples/flown.json has no flight of the family {}; use "
                            "safe or axial, or --verify --fly",
                            drag.family));
  } else if (request.basis == DragBasis::descent) {
    of_flight(flown, "");
  } else if (request.basis == DragBasis::safe && drag.flown && lower < drag.drag_coefficient) {
    of_flight(lower, ", less two standard errors; it is below the axial one");
  } else {
    r.drag_basis = "axial", r.drag_coefficient = drag.drag_coefficient;
    r.drag_source = fmt::format("axial, computed at {:g} m/s ({})", drag.speed, drag.made);
  }
  require_positive("drag coefficient", r.drag_coefficient);
}

}  // namespace

VerifiedDescent::VerifiedDescent(const FlightResult& flight)
    : speed(flight.descent.value_or(0)),
      coefficient(flight.coefficient.value_or(0)),
      speed_error(flight.descent_error),
      usable(flight.usable && flight.coefficient),
      flown(true),
      warnings(flight.warnings) {}

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
                                  row.value("made_on", data.at("made_on").get<std::string>()))};
      drag.projected_ratio = row.at("projected_over_nominal_diameter");
      const auto& handbook = row.at("handbook_drag_coefficient");
      if (!handbook.is_null()) drag.handbook = {handbook.at(0).get<double>(), handbook.at(1).get<double>()};
      drag.flown = flown_drag(drag.family, row.value("canopy_material", ""));
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
  r.height = request.density ? nearest_standard_height(*request.density) : request.height;
  r.density = request.density ? *request.density : standard_air(request.height).density;
  take_coefficient(request, drag, r);
  r.handbook_drag_coefficient = drag.handbook;
  r.deployment_speed = request.deployment_speed.value_or(usual_deployment_speed(request.descent_rate));
  require_positive("deployment speed (m/s)", r.deployment_speed);
  if (r.deployment_speed <= request.descent_rate)
    throw Error(ExitCode::usage,
                fmt::format("a descent rate of {:g} m/s is not below the deployment speed of {:g} m/s",
                            request.descent_rate, r.deployment_speed));
  r.given = example_case(request, r);
  find_parachute(request, r);
  describe_parachute(request, r);
  return r;
}

Settings sized_flight(const Settings& sized, double duration_s) {
  Case given = sized.written();
  given.flight.duration_s = duration_s;
  given.flow.cells.reset(), given.flow.box_m.reset(), given.flow.core = {};
  given.flow.sides.reset(), given.flow.max_iterations.reset(), given.flow.average_over.reset();
  return flight_settings(given);
}

void verify_size(const SizeRequest& request, SizeResult& r,
                 const std::function<VerifiedDescent(const Settings&, int run)>& fly, double tolerance) {
  constexpr int most = 4;
  const std::vector<Line> lines = library_lines(request.line_material);
  for (int run = 1; run <= most; ++run) {
    const VerifiedDescent flown = fly(resolve(parse_case(r.case_text, "the sized case")), run);
    const char* basis = flown.flown ? "descent" : "axial";
    if (!flown.usable)
      throw Error(
          ExitCode::not_converged,
          fmt::format("--verify: run {} has not converged or is beyond a limit of quality; its descent "
                      "rate cannot be used{}",
                      run, flown.warnings.empty() ? "" : ": " + flown.warnings.front()));
    r.checks.push_back({r.nominal_diameter, flown.speed, flown.coefficient, basis, flown.speed_error});
    const double known = std::max(tolerance, flown.speed_error.value_or(0) / request.descent_rate);
    if (std::abs(flown.speed / request.descent_rate - 1) <= known) {
      add_warnings_of({fmt::format("run {} of --verify", run), flown.warnings}, r.warnings);
      return;
    }
    scale_lengths(r.given.parachute, flown.speed / request.descent_rate);
    r.drag_coefficient = flown.coefficient, r.drag_basis = basis;
    r.drag_source = flown.flown ? "in descent, flown by --verify --fly"
                                : "axial, computed by --verify at the descent rate";
    find_opening(request, r);
    double line = suspension_line(r.given).linear_density_kg_m,
           riser = riser_line(r.given).linear_density_kg_m;
    choose_materials(lines, r, line, riser);
    describe_parachute(request, r);
  }
  const auto [last, wanted] = rounded_apart(r.checks.back().descent_rate, request.descent_rate);
  throw Error(
      ExitCode::not_converged,
      fmt::format("--verify: after {} runs the descent rate is {} m/s instead of {}", most, last, wanted));
}

}  // namespace ripstop::inline run

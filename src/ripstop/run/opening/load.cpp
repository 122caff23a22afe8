#include "ripstop/run/opening/load.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ripstop/case/cluster.h"
#include "ripstop/case/opening.h"
#include "ripstop/case/payload.h"
#include "ripstop/core/error.h"
#include "ripstop/core/positive.h"
#include "ripstop/core/words.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/descent.h"
#include "ripstop/flight/validity.h"
#include "ripstop/fsi/opening_estimate.h"
#include "ripstop/run/descent/descent.h"
#include "ripstop/run/json.h"
#include "ripstop/run/opening/filling.h"
#include "ripstop/run/opening/handbook.h"
#include "ripstop/run/steady/warnings.h"
#include "ripstop/run/used_run.h"

namespace ripstop::inline run {
namespace {

// How many steps a filling takes on the trajectory, and how long one is flown at most [s].
constexpr double steps_a_filling = 400, longest_flight = 600;
// Steps of the slow rest of a flight while the speed falls by half, where these are longer than ten of the filling's.
constexpr double steps_a_slowing = 1000;
// The share of the load at infinite mass from which that estimate represents the opening.
constexpr double hardly_slowed = 0.9;
// Where gravity adds more to the speed during the filling than this share, formulas without gravity do not hold.
constexpr double most_gravity = 0.3;

void check_request(const LoadRequest& request) {
  require_positive("payload mass (kg)", request.payload_mass);
  require_positive("speed at line stretch (m/s)", request.speed);
  if (request.measured_load) require_positive("measured opening load (N)", *request.measured_load);
  if (request.height && !(*request.height > request.ground.value_or(0)))
    throw Error(ExitCode::usage,
                fmt::format("an opening at {:g} m above sea level: must be above the ground at {:g} m",
                            *request.height, request.ground.value_or(0)));
  if (!(std::abs(request.path_angle) <= 90))
    throw Error(ExitCode::usage, fmt::format("a flight path {:g} degrees below the horizon: must be from -90 "
                                             "(vertically up) to 90 (vertically down)",
                                             request.path_angle));
  double before = 0;
  for (const ReefedStage& stage : request.reefing) {
    if (!(stage.share > before && stage.share < 1))
      throw Error(
          ExitCode::usage,
          fmt::format("a reefed stage at {0:g} of the drag area: must be above {1:g} ({2}) and below 1",
                      stage.share, before, before > 0 ? "the stage before" : "closed"));
    require_positive("duration of a reefed stage (s)", stage.duration);
    before = stage.share;
  }
}

/// Where the flight ends [m]. An opening at the ground itself continues below it.
double end_of_flight(const LoadRequest& request, double height) {
  const double ground = request.ground.value_or(request.height ? 0 : lowest_height);
  return height > ground ? ground : lowest_height;
}

/// The density over that of the standard atmosphere.
double ratio_to_standard(const LoadResult& r) {
  return r.density / standard_air(r.height).density;
}

/// Opening and filling coefficients: as asked, else the handbook's of the family.
void choose_coefficients(const Settings& resolved, const LoadRequest& request, const LoadInputs& inputs,
                         LoadResult& r) {
  const Experience known = experience(resolved.parachute());
  r.reference_area = nominal_area(resolved.parachute());
  r.nominal_diameter = nominal_diameter(resolved.parachute());
  const DragCoefficient& drag = inputs.drag;
  r.drag_coefficient = drag.value, r.drag_source = drag.from;
  r.drag_uncertainty = drag.uncertainty;
  r.design_drag_coefficient = request.opening_coefficient
                                  ? drag.value  // its C_x belongs to it
                                  : design_drag_coefficient(resolved.parachute(), drag.value);
  r.opening_coefficient = request.opening_coefficient.value_or(known.opening_coefficient);
  r.opening_source = request.opening_coefficient ? "given" : known.opening_source;
  require_positive("opening coefficient C_x", r.opening_coefficient);
  const KnownFilling filling = known_filling(resolved.parachute().canopy.family().type);
  r.filling_constant = request.filling_constant.value_or(filling.constant);
  r.filling_exponent = request.filling_exponent.value_or(filling.exponent);
  r.ludtke_exponent = request.filling_exponent.value_or(filling.ludtke_exponent);
  r.filling_source = request.filling_constant && request.filling_exponent ? "given" : filling.source;
  if (const auto& computed = inputs.filling) {
    if (!request.filling_constant) r.filling_constant = computed->constant;
    if (!request.filling_exponent) r.filling_exponent = r.ludtke_exponent = computed->exponent;
    r.filling_source = "of the computed opening " + request.filling_from.string();
  }
  require_positive("filling constant n", r.filling_constant);
  require_positive("exponent of the drag area", r.filling_exponent);
}

/// Whether the filling constant is the handbook's, with its ranges of size and speed.
bool of_handbook(const LoadRequest& request) {
  return !request.filling_constant && request.filling_from.empty();
}

std::string joined(const std::vector<std::string>& texts) {
  return fmt::format("{}", fmt::join(texts, "; "));
}

/// Why the finite-mass methods do not apply in these conditions; empty: they do. A filling constant that the user
/// gives, or that is fitted to a computed opening, replaces the handbook's, with its range of sizes and speeds.
std::string outside_of_methods(const OpeningConditions& c, const LoadRequest& request, double mach) {
  std::vector<ModelValue> values = {{"Mach number", mach}, {"ballistic parameter A", ballistic_parameter(c)}};
  if (of_handbook(request)) values.push_back({"speed at line stretch", c.speed});
  return joined(outside_range(finite_mass_model, values));
}

/// The handbook's filling distances were measured on large canopies. The methods apply to a smaller one, whose
/// deployment determines the distance.
std::string caution_on_filling(const LoadRequest& request, double nominal_diameter) {
  if (!of_handbook(request)) return "";
  const std::string text = joined(outside_range(filling_model, {{"nominal diameter", nominal_diameter}}));
  return text.empty() ? ""
                      : text +
                            "; a small canopy fills within 1 to 20 D0, depending on its deployment (set it "
                            "with --filling-constant); the load of a canopy that fills faster is larger";
}

/// `r`: coefficients that are known already.
void add_methods(const OpeningConditions& c, const LoadResult& r, double integral, StageLoads& stage) {
  const double a = ballistic_parameter(c);
  const ForceFactor x = force_factor(a, c.exponent);
  const double gravity =
      standard_gravity * std::abs(std::sin(c.path_angle * std::numbers::pi / 180)) * c.filling_time / c.speed;
  const bool from_none = stage.drag_area_before == 0;
  const MomentumImpulse impulse = momentum_impulse_load(c, integral);
  const bool light = gravity < most_gravity;
  const std::string held =
      !from_none ? "assumes filling from zero drag area, unlike this stage"
      : !light   ? fmt::format("neglects gravity, which adds {:.0f} % to the speed", 100 * gravity)
                 : stage.outside;
  stage.methods.push_back(
      {infinite_mass_method, r.design_drag_coefficient / r.drag_coefficient * infinite_mass_load(c).load, 0,
       x.factor > hardly_slowed,
       impulse.speed_ratio > 1 ? "constant speed is assumed; on this path the speed increases during filling"
       : x.factor > hardly_slowed
           ? "the speed decreases little during filling"
           : "constant speed is assumed; with this payload the speed decreases during filling"});
  OpeningConditions by_ludtke = c;
  by_ludtke.exponent = r.ludtke_exponent;
  const OpeningLoad pflanz = pflanz_load(c), ludtke = ludtke_load(by_ludtke);
  stage.methods.push_back({"Pflanz", pflanz.load, pflanz.time, held.empty(), held});
  stage.methods.push_back({"Ludtke", ludtke.load, ludtke.time, held.empty(), held});
  const std::string left =
      fmt::format("the speed after filling is {:.0f} % of the initial speed", 100 * impulse.speed_ratio);
  stage.methods.push_back({"momentum-impulse", impulse.load.load, 0, from_none && stage.outside.empty(),
                           !from_none               ? "assumes filling from zero drag area; " + left
                           : !stage.outside.empty() ? stage.outside
                                                    : left});
}

/// Range and spread of the methods that apply.
void compare_methods(StageLoads& stage) {
  double sum = 0;
  int count = 0;
  for (const MethodLoad& m : stage.methods) {
    if (!m.applies) continue;
    stage.highest = count == 0 ? m.load : std::max(stage.highest, m.load);
    stage.lowest = count == 0 ? m.load : std::min(stage.lowest, m.load);
    sum += m.load, ++count;
  }
  if (count > 0)
    stage.spread = (stage.highest - stage.lowest) / (sum / count);
  else
    stage.highest = stage.lowest = stage.methods.front().load, stage.spread = 0;
}

/// Appends the rows of one leg without repeating the first; returns the highest force among them.
const FlightRow& append(std::vector<FlightRow>& all, std::vector<FlightRow> leg) {
  const std::size_t begin = all.size();
  all.insert(all.end(), leg.begin() + (all.empty() ? 0 : 1), leg.end());
  return *std::max_element(all.begin() + static_cast<std::ptrdiff_t>(begin), all.end(),
                           [](const FlightRow& a, const FlightRow& b) { return a.force < b.force; });
}

/// One stage, from the drag area that the canopy has at its begin.
StageLoads begin_stage(const LoadRequest& request, const LoadResult& r, const FlightState& state,
                       double drag_area, double before, double before_held) {
  const double open = r.drag_coefficient * r.reference_area;
  StageLoads stage;
  stage.begin = state.time, stage.speed = state.speed, stage.height = state.height;
  const StandardAir air = standard_air(state.height);
  stage.density = ratio_to_standard(r) * air.density, stage.path_angle = state.path_angle;
  stage.drag_area_before = before, stage.drag_area = drag_area;
  // A stage that was cut while it overshot has no less to fill than the drag area that it would have held.
  const double added = drag_area - std::min(before, before_held);
  stage.filling_constant =
      of_handbook(request) ? filling_constant_at(r.filling_constant, state.speed) : r.filling_constant;
  stage.filling_time = stage.filling_constant * r.nominal_diameter / state.speed * std::sqrt(added / open);
  const OpeningConditions c{r.payload_mass + r.parachute_mass,
                            state.speed,
                            stage.density,
                            stage.drag_area,
                            stage.filling_time,
                            r.filling_exponent,
                            r.opening_coefficient,
                            std::clamp(state.path_angle, -90.0, 90.0)};
  stage.ballistic_parameter = ballistic_parameter(c);
  stage.mass_ratio = mass_ratio(c);
  stage.outside = outside_of_methods(c, request, state.speed / air.sound_speed);
  stage.caution = caution_on_filling(request, r.nominal_diameter);
  add_methods(c, r, request.impulse_integral, stage);
  return stage;
}

/// Filling distances of stages, Knacke: t_f1 = n D_0 / v ((C_D S)_1 / (C_D S)_0)^(1/2), and for the area added later
/// the same with the difference of both areas. A stage that is cut before it has filled leaves its drag area to the
/// next one.
void fly_stages(const LoadRequest& request, LoadResult& r) {
  FlightState state{0, 0, 0, r.height, request.speed, request.path_angle};
  const double open = r.drag_coefficient * r.reference_area, mass = r.payload_mass + r.parachute_mass;
  const double ground = end_of_flight(request, r.height);
  std::vector<ReefedStage> stages = request.reefing;
  stages.push_back({1, longest_flight});
  double before = 0, before_held = 0;
  for (const ReefedStage& reefed : stages) {
    StageLoads stage = begin_stage(request, r, state, reefed.share * open, before, before_held);
    Leg leg;
    leg.drag_area =
        filling(before, stage.drag_area, stage.filling_time, r.filling_exponent, r.opening_coefficient);
    // The rest of the flight is slow and long: steps of the filling first, larger ones after it.
    const double settled = stage.filling_time * (2 + std::pow(r.opening_coefficient, 1 / r.filling_exponent));
    leg.duration = std::min(reefed.duration, settled);
    leg.step = stage.filling_time / steps_a_filling;
    leg.ground = ground, leg.density_ratio = ratio_to_standard(r);
    const FlightRow peak = append(r.flight, fly(state, mass, leg));
    if (reefed.duration < stage.filling_time)
      for (MethodLoad& m : stage.methods)
        m.applies = false, m.note = "assumes a filled canopy; this reefing line is cut before";
    stage.methods.push_back(
        {"trajectory", peak.force, peak.state.time - stage.begin, stage.outside.empty(),
         stage.outside.empty() ? "with gravity and the standard atmosphere" : stage.outside});
    compare_methods(stage);
    r.stages.push_back(stage);
    if (peak.force > r.peak_load) r.peak_load = peak.force, r.peak_time = peak.state.time;
    before = r.flight.back().drag_area;
    if (reefed.duration > settled && state.height > ground && (request.descent || reefed.share < 1)) {
      const double area = before = stage.drag_area;
      leg.drag_area = [area](double, double) { return area; };
      leg.duration = reefed.duration - settled;
      // A tiny canopy fills much faster than it decelerates, in 2 m / (rho C_D S v).
      const double slowing = 2 * mass / (stage.density * area * state.speed);
      leg.step = std::min(0.02, std::max(10 * leg.step, slowing / steps_a_slowing));
      leg.until_steady = reefed.share == 1;
      append(r.flight, fly(state, mass, leg));
    }
    before_held = stage.drag_area;
  }
  r.steady_time = state.time, r.steady_drop = r.height - state.height, r.steady_speed = state.speed;
  const double terminal =
      terminal_speed(mass, open, ratio_to_standard(r) * standard_air(state.height).density);
  r.steady_reached = std::abs(state.speed / terminal - 1) < 2e-3;
}

void fly_record(const OpeningRecord& record, const LoadRequest& request, LoadResult& r) {
  const double mass = r.payload_mass + r.parachute_mass;
  FlightState state{0, 0, 0, r.height, request.speed, request.path_angle};
  Leg leg;
  leg.drag_area = from_record(record.distance, record.drag_area, record.steady_drag_area);
  leg.duration = 3 * record.distance.back() / request.speed;
  leg.step = leg.duration / 6000;
  leg.ground = end_of_flight(request, r.height), leg.density_ratio = ratio_to_standard(r);
  const FlightRow peak = append(r.record_flight, fly(state, mass, leg));
  r.record_peak_load = peak.force;
  if (!request.reefing.empty()) return;
  StageLoads& stage = r.stages.front();
  r.record_limit = record.limit, r.shares = record.shares;
  const std::string from = "C_D S of " + request.opening.string() + " over the distance through the air";
  if (!record.limit.empty()) {
    stage.methods.push_back(
        {computed_method, peak.force, peak.state.time, false,
         fmt::format("{}; used for design only if it has the largest load ({})", from, record.limit)});
    return;
  }
  if (const auto text =
          handbook_disagreement(peak.force, peak.state.distance / r.nominal_diameter, stage.methods))
    r.opening_warnings.push_back(*text);
  stage.methods.push_back({computed_method, peak.force, peak.state.time, true, from});
  compare_methods(stage);
}

std::string scatter_text() {
  return fmt::format("scatter of repeated openings {:.0f} %", 100 * opening_scatter);
}

/// Of a measured load that no stage can have by the applicable methods.
void warn_of_small_measurement(LoadResult& r) {
  double least = 0;
  for (const StageLoads& stage : r.stages) least = std::max(least, stage.lowest);
  if (r.design_load >= least) return;
  const auto [measured, estimate] = rounded_apart(r.design_load, least, 4);
  r.opening_warnings.push_back(
      fmt::format("the measured load of {} N is below every applicable estimate (at least {} N): check unit, "
                  "speed and mass of the measurement",
                  measured, estimate));
}

/// The infinite-mass load of the stage with the highest, or that of a method that applies and has more (a payload that is
/// accelerated on its path), unless a measurement or a computed opening replaces it. A computed opening with a limit
/// replaces only a smaller load.
void choose_design_load(const Settings& resolved, const LoadRequest& request, const DragCoefficient& drag,
                        LoadResult& r) {
  for (const StageLoads& stage : r.stages)
    r.design_load = std::max(r.design_load, stage.methods.front().load);
  r.design_load_from = "infinite mass, C_x C_D S0 q", r.design_method = infinite_mass_method;
  if (r.design_drag_coefficient > r.drag_coefficient)
    r.design_load_from += fmt::format(" with C_D {:.2f} (handbook, in descent)", r.design_drag_coefficient);
  for (const StageLoads& stage : r.stages)
    for (const MethodLoad& m : stage.methods)
      if (m.applies && m.load > r.design_load)
        r.design_load = m.load, r.design_method = m.method,
        r.design_load_from = m.method + ", more than infinite mass";
  const bool recorded = r.record_peak_load && request.reefing.empty();
  const bool usable = recorded && r.record_limit.empty();
  if (request.measured_load) {
    r.design_load = *request.measured_load, r.design_load_from = "measured, as given";
    r.design_method.clear();
  } else if (usable || (recorded && *r.record_peak_load > r.design_load)) {
    r.design_load = *r.record_peak_load, r.design_load_from = "computed opening " + request.opening.string();
    r.design_method = computed_method;
  }
  if (r.design_method != computed_method && !(request.measured_load && usable)) r.shares = {};
  r.line_load_factor = std::max(experience(resolved.parachute()).line_load_factor,
                                r.shares.line * resolved.parachute().lines.count);
  LoadUncertainty uncertainty =
      request.measured_load ? LoadUncertainty{opening_scatter, scatter_text()} : load_uncertainty(drag);
  r.load_uncertainty = uncertainty.value, r.load_uncertainty_from = std::move(uncertainty.from);
  r.highest_design_load = (1 + r.load_uncertainty) * r.design_load;
  if (!r.design_method.empty() && r.design_method != computed_method && !request.opening_coefficient)
    r.heavy_payload = heavy_payload(resolved, r);
  if (!r.heavy_payload.empty()) {
    r.design_load_caution = r.heavy_payload + ". " + heavy_payload_advice();
    r.warnings.push_back(r.design_load_caution);
  }
  if (request.measured_load) warn_of_small_measurement(r);
  r.warnings.insert(r.warnings.end(), r.opening_warnings.begin(), r.opening_warnings.end());
  const double mach = request.speed / standard_air(r.height).sound_speed;
  for (const std::string& text : outside_range(infinite_mass_model, {{"Mach number", mach}}))
    r.warnings.push_back(text);
}

/// Margins and required strengths, of the opening or of the snatch before it.
void take_required_load(const Settings& resolved, LoadResult& r) {
  const double largest_snatch = r.snatch ? r.snatch->largest() : 0;
  r.required_load = std::max(r.highest_design_load, largest_snatch);
  r.margins = load_margins(resolved, r.design_load, largest_snatch, r.shares);
  r.hardware = hardware_need(r.required_load, resolved.margins());
  r.highest_margins = load_margins(resolved, r.highest_design_load, largest_snatch, r.shares);
  if (const Margin* least = weakest(*r.highest_margins))
    r.smallest_margin = least->margin, r.smallest_margin_member = least->member;
  for (const std::string& text : margin_warnings(r.highest_margins))
    r.warnings.push_back(text + ". The load is that under the highest design load" +
                         (largest_snatch > r.highest_design_load
                              ? " or the snatch load"
                              : fmt::format(" of {} N, which contains the uncertainty of {:.0f} %",
                                            rounded(r.highest_design_load), 100 * r.load_uncertainty)));
  if (!r.snatch) return;
  for (const auto& [part, ratio] :
       {std::pair("a line", r.snatch->line_margin), std::pair("the riser", r.snatch->riser_margin)})
    if (ratio && *ratio < 1)
      r.warnings.push_back(
          fmt::format("the snatch load breaks {}: breaking load / snatch load {:.2f}; use a stronger "
                      "material, or a longer or softer part",
                      part, *ratio));
  if (r.snatch->other_load) r.warnings.push_back(two_snatch_loads(*r.snatch));
  if (largest_snatch <= r.design_load) return;
  const auto [snatch, design] = rounded_apart(largest_snatch, r.design_load, 4);
  r.warnings.push_back(
      fmt::format("the snatch load of {} N exceeds the design load of {} N of the opening: it determines the "
                  "margins of lines, riser and hardware, and the required hardware",
                  snatch, design));
}

}  // namespace

std::string to_json(const LoadResult& result) {
  return json_text(result);
}

DragCoefficient opening_drag_coefficient(const Settings& resolved, const LoadRequest& request) {
  if (request.drag_coefficient) {
    require_positive("drag coefficient", *request.drag_coefficient);
    return {*request.drag_coefficient, "given", usual_drag_uncertainty, "given"};
  }
  if (!request.steady.empty()) {
    const CarryingRun run = carrying_run(request.steady);
    return {run.drag_area / nominal_area(resolved.parachute()),
            fmt::format("{} {}, drag area {:.4g} m2", run.basis == "axial" ? "steady run" : "flight",
                        request.steady.string(), run.drag_area),
            std::max(usual_drag_uncertainty, run.uncertainty), run.basis};
  }
  if (resolved.inflation().drag_coefficient)
    return {
        *resolved.inflation().drag_coefficient, "inflation.drag_coefficient of the case",
        usual_drag_uncertainty,
        resolved.inflation().drag_coefficient_basis == InflationSettings::Basis::axial ? "axial" : "descent"};
  const KnownRange known = experience(resolved.parachute()).drag_coefficient;
  if (known.high > 0)
    return {0.5 * (known.low + known.high),
            fmt::format("middle of {:.2f} to {:.2f} (Knacke)", known.low, known.high),
            std::max(usual_drag_uncertainty, (known.high - known.low) / (known.high + known.low)), "descent"};
  throw Error(ExitCode::usage,
              "no drag coefficient of this family is known: give --drag-coefficient, --steady RUN or "
              "inflation.drag_coefficient in the case");
}

double slowest_opening(double mass, double drag_area, double density, double path_angle) {
  const double along = std::sin(path_angle * std::numbers::pi / 180);
  return along > 0 ? std::sqrt(along) * terminal_speed(mass, drag_area, density) : 0;
}

LoadUncertainty load_uncertainty(const DragCoefficient& drag) {
  return {std::hypot(drag.uncertainty, opening_scatter),
          fmt::format("drag area {:.0f} % ({}), {}", 100 * drag.uncertainty, drag.from, scatter_text())};
}

LoadInputs load_inputs(const Settings& resolved, const LoadRequest& request) {
  LoadInputs inputs{opening_drag_coefficient(resolved, request), {}, {}, {}};
  if (!request.filling_from.empty()) inputs.filling = computed_filling(request.filling_from, resolved);
  inputs.warnings = warnings_of_used({request.steady, request.opening, request.filling_from});
  if (!request.opening.empty()) inputs.opening = opening_record(request.opening, resolved);
  return inputs;
}

LoadResult run_load(const Settings& resolved, const LoadRequest& request) {
  require_one_canopy(resolved, "an opening load");
  check_request(request);
  return run_load(resolved, request, load_inputs(resolved, request));
}

LoadResult run_load(const Settings& resolved, const LoadRequest& request, const LoadInputs& inputs) {
  require_one_canopy(resolved, "an opening load");
  check_request(request);
  LoadResult r;
  r.title = resolved.title();
  r.payload_mass = request.payload_mass;
  r.parachute_mass = parachute_mass(resolved);
  OpeningAir air = opening_air(resolved, request.height, request.ground);
  r.height = air.height, r.density = air.density, r.air_source = std::move(air.from);
  r.speed = request.speed, r.speed_source = request.speed_source, r.path_angle = request.path_angle;
  choose_coefficients(resolved, request, inputs, r);
  r.warnings = inputs.warnings;
  for (std::string& text : strain_warnings(resolved, 0)) r.warnings.push_back(std::move(text));
  for (std::string& text : hardware_warnings(resolved)) r.warnings.push_back(std::move(text));
  const double mass = r.payload_mass + r.parachute_mass, area = r.drag_coefficient * r.reference_area;
  if (request.speed <= slowest_opening(mass, area, r.density, request.path_angle)) {
    const auto [rate, speed] = rounded_apart(terminal_speed(mass, area, r.density), request.speed);
    throw Error(
        ExitCode::usage,
        fmt::format(
            "a descent rate of {} m/s is above the {} m/s of the deployment: the payload still "
            "accelerates under the open canopy on a path {:g} deg below the horizon; give --angle 0 for an "
            "opening at apogee, a higher speed, a smaller mass or a larger canopy",
            rate, speed, request.path_angle));
  }
  fly_stages(request, r);
  if (inputs.opening) fly_record(*inputs.opening, request, r);
  choose_design_load(resolved, request, inputs.drag, r);
  if (request.descent) r.snatch = snatch_of(resolved, request, r);
  take_required_load(resolved, r);
  return r;
}

}  // namespace ripstop::inline run

#include "ripstop/run/descent/recovery.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "ripstop/case/cluster.h"
#include "ripstop/case/payload.h"
#include "ripstop/core/error.h"
#include "ripstop/core/positive.h"
#include "ripstop/core/words.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/validity.h"
#include "ripstop/flight/wind.h"
#include "ripstop/fsi/opening_estimate.h"
#include "ripstop/run/descent/recovery_flight.h"
#include "ripstop/run/opening/handbook.h"
#include "ripstop/run/opening/snatch.h"
#include "ripstop/run/steady/warnings.h"

namespace ripstop::inline run {
namespace {

// A fall at which the drag of a rocket body is no longer small against its weight (assumed) [m/s].
constexpr double fast_fall = 30;

void check_recovery(const RecoveryRequest& q, bool two_stages) {
  require_positive("mass that descends (kg)", q.mass);
  require_positive("apogee above the ground (m)", q.apogee);
  require_positive("airspeed at apogee (m/s)", q.speed);
  if (!(q.delay >= 0))
    throw Error(ExitCode::usage, fmt::format("a delay of {:g} s: must be 0 or above", q.delay));
  if (q.separation_speed) {
    require_positive("speed at which sections separate (m/s)", *q.separation_speed);
    if (q.sections.size() < 2)
      throw Error(ExitCode::usage, "a separation needs the masses of the sections: give --section KG,KG");
  }
  if (two_stages && !(q.main_height > 0 && q.main_height < q.apogee))
    throw Error(ExitCode::usage,
                fmt::format("the main opens {:g} m above the ground: must be above 0 and below the apogee of "
                            "{:g} m",
                            q.main_height, q.apogee));
}

template <class Of3>
Ranged ranged(const std::vector<Flown>& flights, Of3&& of) {
  const double a = of(flights[0]), b = of(flights[1]), c = of(flights[2]);
  return {a, std::min({a, b, c}), std::max({a, b, c})};
}

/// The opening of a stage at the lowest or the highest speed of all flights, with the usual drag coefficient.
struct EndOpening {
  LoadRequest asked;
  LoadResult load;
  LoadUncertainty uncertainty;  // of the load: range of C_D in descent and scatter of openings
  double least_load = 0;        // of the trajectories with their ranges [N]

  double design_load() const { return std::max(load.design_load, least_load); }
};

/// Relative to the load of the usual coefficient, and at least the uncertainty that run_fastest() takes.
LoadUncertainty uncertainty_at(DragEnd end, const RecoveryCanopy& canopy) {
  const Design& design = canopy.resolved.parachute();
  const double ratio = design_drag_coefficient(design, drag_at(end, canopy)) /
                       design_drag_coefficient(design, canopy.drag.value);
  DragCoefficient drag = canopy.drag;
  if (std::abs(ratio - 1) > drag.uncertainty + 1e-9) {
    drag.from =
        fmt::format("range of C_D in descent; ripstop load --fastest uses {:.0f} %, without that range",
                    100 * drag.uncertainty);
    drag.uncertainty = std::abs(ratio - 1);
  }
  return load_uncertainty(drag);
}

/// The `peak` force of a trajectory contains the range of C_D already, and not the scatter of openings. With the
/// uncertainty it is the end of a range.
double least_load(DragEnd end, double peak, const LoadUncertainty& uncertainty) {
  const double sign = end == DragEnd::high ? 1 : -1;
  return peak * (1 + sign * opening_scatter) / (1 + sign * uncertainty.value);
}

EndOpening opening_at(DragEnd end, const RecoveryCanopy& canopy, std::size_t i,
                      const std::vector<Flown>& flights, const RecoveryRequest& request) {
  const bool high = end == DragEnd::high;
  const auto faster = [&](const Flown& a, const Flown& b) {
    return a.stages[i].opening.speed < b.stages[i].opening.speed;
  };
  const auto [slowest, fastest] = std::minmax_element(flights.begin(), flights.end(), faster);
  const FlownStage& stage = (high ? *fastest : *slowest).stages[i];
  EndOpening opening;
  opening.asked =
      opening_of(canopy, canopy.drag.value, stage.opening, stage.load.payload_mass + canopy.mass, request);
  if (canopy.measured_load)
    opening.asked.measured_load =
        *canopy.measured_load * std::pow(stage.opening.speed / flights[0].stages[i].opening.speed, 2);
  opening.load = load_of(canopy, opening.asked);
  opening.uncertainty = canopy.measured_load ? LoadUncertainty{opening.load.load_uncertainty,
                                                               opening.load.load_uncertainty_from}
                                             : uncertainty_at(end, canopy);
  double peak = stage.peak_force;
  for (const Flown& flown : flights)
    peak = high ? std::max(peak, flown.stages[i].peak_force) : std::min(peak, flown.stages[i].peak_force);
  opening.least_load = least_load(end, peak, opening.uncertainty);
  return opening;
}

/// The largest force of the trajectories depends on the speed of the opening. At the highest speed of the flights it is
/// that of `high`; at others the speeds of the flights keep their ratios.
SafeSpeed safe_speed_of(const RecoveryCanopy& canopy, std::size_t i, const std::vector<Flown>& flights,
                        const EndOpening& high, const RecoveryRequest& request) {
  const auto least = [&](double speed) {
    double peak = 0;
    for (const Flown& flown : flights) {
      const FlownStage& stage = flown.stages[i];
      peak = std::max(peak,
                      peak_force_at(speed * stage.opening.speed / high.asked.speed, canopy, stage, request));
    }
    return least_load(DragEnd::high, peak, high.uncertainty);
  };
  return run_fastest(canopy.resolved, high.asked, 0, high.uncertainty, least).design();
}

/// A landing before the descent is steady in one of the flights. Nothing for a canopy that is not filled: that has
/// another warning.
std::vector<std::string> landing_warnings(const std::string& name, const std::vector<Flown>& flights) {
  const FlownStage& stage = flights[0].stages.back();
  const bool steady = std::all_of(flights.begin(), flights.end(),
                                  [](const Flown& flown) { return flown.stages.back().steady; });
  if (steady || !stage.filled) return {};
  return {fmt::format(
      "{}: it opens too low for a steady descent: it lands {} s after line stretch at {} m/s. A "
      "steady descent begins after {} s ({:g} filling times, for a slow filling) and within {:g} % "
      "of {} m/s. Landing speed and energy are not reliable; open it higher",
      name, rounded(stage.duration, 3), rounded(stage.end_speed, 3),
      rounded(steady_fillings * stage.load.stages.front().filling_time, 3), steady_fillings,
      100 * steady_share, rounded(stage.terminal, 3))};
}

/// Hardware carries the separation load where it exceeds the others.
void add_separation(const Settings& resolved, double separation, Margins& margins) {
  const Margins separated = load_margins(resolved, separation);
  for (std::size_t i = 0; i < margins.members.size(); ++i)
    if (Margin& m = margins.members[i]; resolved.hardware().contains(m.member) && m.load < separation)
      m = *std::find_if(separated.members.begin(), separated.members.end(),
                        [&](const Margin& each) { return each.member == m.member; });
  take_weakest(margins);
}

RecoveryStage stage_of(const RecoveryCanopy& canopy, std::size_t i, const std::vector<Flown>& flights,
                       const RecoveryRequest& request, std::vector<std::string>& warnings) {
  const FlownStage& flown = flights[0].stages[i];
  const LoadResult& load = flown.load;
  RecoveryStage s;
  s.name = canopy.name, s.title = canopy.resolved.title();
  s.drag_coefficient = canopy.drag.value, s.drag_uncertainty = canopy.drag.uncertainty;
  s.drag_source = canopy.drag.from, s.drag_basis = canopy.drag.basis, s.reference_area = canopy.area;
  s.descent_drag = canopy.range;
  s.time = flown.opening.time, s.height = flown.opening.height - request.ground;
  s.path_angle = flown.opening.path_angle, s.density = load.density;
  s.speed = ranged(flights, [&](const Flown& f) { return f.stages[i].opening.speed; });
  s.filling_time = load.stages.front().filling_time;
  s.lowest_load = load.stages.front().lowest, s.highest_load = load.stages.front().highest;
  if (const auto range = finite_mass_range(load.stages.front().methods))
    s.lowest_finite_mass_load = range->lowest, s.highest_finite_mass_load = range->highest;
  s.design_load = load.design_load, s.design_load_from = load.design_load_from;
  if (flown.peak_force > s.design_load)
    s.design_load = flown.peak_force, s.design_load_from = "largest force of the trajectory";
  const EndOpening low = opening_at(DragEnd::low, canopy, i, flights, request),
                   high = opening_at(DragEnd::high, canopy, i, flights, request);
  const std::array<const EndOpening*, 2> ends = {&low, &high};
  // A canopy that opens slower than it descends accelerates while it fills: its load can be largest at the lowest speed.
  s.lowest_design_load = std::min({s.design_load, (1 - low.uncertainty.value) * low.design_load(),
                                   (1 - high.uncertainty.value) * high.design_load()});
  s.highest_design_load = std::max({s.design_load, (1 + low.uncertainty.value) * low.design_load(),
                                    (1 + high.uncertainty.value) * high.design_load()});
  s.load_uncertainty = high.uncertainty.value, s.load_uncertainty_from = high.uncertainty.from;
  s.of_trajectory = std::all_of(ends.begin(), ends.end(), [&](const EndOpening* end) {
    return (1 + end->uncertainty.value) * end->load.design_load < s.highest_design_load;
  });
  if (s.of_trajectory) {
    s.load_uncertainty = s.highest_design_load / s.design_load - 1;
    s.load_uncertainty_from = fmt::format(
        "largest force of the trajectories with the range of C_D in descent, scatter of repeated "
        "openings {:.0f} %",
        100 * opening_scatter);
  }
  const auto snatch = snatch_of(canopy.resolved, high.asked, high.load);
  if (snatch) s.snatch_load = snatch->largest();
  if (request.separation_speed)
    s.separation_load = separation_load(canopy.resolved, request.sections, *request.separation_speed);
  const double largest_snatch = s.snatch_load.value_or(0);
  s.margins = load_margins(canopy.resolved, s.highest_design_load, largest_snatch, high.load.shares);
  if (s.separation_load) add_separation(canopy.resolved, *s.separation_load, *s.margins);
  s.hardware = hardware_need(std::max({s.highest_design_load, largest_snatch, s.separation_load.value_or(0)}),
                             canopy.resolved.margins());
  s.design_load_caution = load.design_load_caution;
  if (!canopy.measured_load) s.safe = safe_speed_of(canopy, i, flights, high, request);
  s.descent_rate = ranged(flights, [&](const Flown& f) { return f.stages[i].end_speed; });
  s.duration = ranged(flights, [&](const Flown& f) { return f.stages[i].duration; });
  s.drift = ranged(flights, [&](const Flown& f) { return f.stages[i].drift; });
  s.mass = canopy.mass;
  s.packed_volume = parachute_bill(canopy.resolved, {}, request.packing_density).packed_volume;
  if (request.bay_diameter)
    s.bay_length = s.packed_volume / (std::numbers::pi / 4 * *request.bay_diameter * *request.bay_diameter);
  const auto warn = [&](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) warnings.push_back(fmt::format("{}: {}", canopy.name, text));
  };
  warn(strain_warnings(canopy.resolved, 0)), warn(hardware_warnings(canopy.resolved)),
      warn(margin_warnings(s.margins)), warn(load.opening_warnings);
  warn(outside_range(infinite_mass_model,
                     {{"Mach number", s.speed.high / standard_air(flown.opening.height).sound_speed}}));
  if (!flown.filled)
    warnings.push_back(fmt::format("{}: it opens too low: it is not filled after {:.3g} s, when {}",
                                   canopy.name, flown.duration,
                                   i + 1 < flights[0].stages.size() ? "the main opens" : "the rocket lands"));
  if (s.safe && s.safe->lowest && s.speed.high > *s.safe->lowest) {
    const auto [speed, safe] = rounded_apart(s.speed.high, *s.safe->lowest);
    warnings.push_back(fmt::format("{}: it opens at up to {} m/s; the fastest safe deployment is {} m/s ({})",
                                   canopy.name, speed, safe, s.safe->method));
  } else if (s.safe && s.safe->unsafe_at) {
    warnings.push_back(fmt::format(
        "{}: it opens at up to {} m/s; no speed is safe ({}): the {} does not keep its margin at {} m/s "
        "either",
        canopy.name, rounded(s.speed.high, 3), s.safe->method, s.safe->member,
        rounded(*s.safe->unsafe_at, 3)));
  }
  return s;
}

RecoveryCanopy canopy_of(const char* name, const Settings& resolved, const std::filesystem::path& steady,
                         const std::filesystem::path& opening, std::optional<double> measured_load) {
  LoadRequest asked;
  asked.steady = steady, asked.opening = opening;
  LoadInputs inputs = load_inputs(resolved, asked);
  const DragCoefficient drag = inputs.drag;
  return {name,
          resolved,
          drag,
          descent_drag(resolved, drag),
          nominal_area(resolved.parachute()),
          parachute_mass(resolved),
          opening,
          measured_load,
          std::move(inputs)};
}

/// A canopy that accelerates after its opening has its largest load later. A measured load of less is not used. Returns
/// the warnings.
std::vector<std::string> omit_small_measurements(const Flown& flown, std::vector<RecoveryCanopy>& canopies) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < canopies.size(); ++i) {
    std::optional<double>& load = canopies[i].measured_load;
    if (!load || *load >= flown.stages[i].peak_force) continue;
    const auto [measured, largest] = rounded_apart(*load, flown.stages[i].peak_force);
    warnings.push_back(fmt::format(
        "{}: the measured load of {} N is below the largest force of the trajectory, {} N after the opening: "
        "the loads are computed without it; check unit, speed and mass of the measurement",
        canopies[i].name, measured, largest));
    load.reset();
  }
  return warnings;
}

/// Of a fall without parachute and body drag that is fast.
std::vector<std::string> fall_warnings(const std::string& name, double body_area, const Flown& flown,
                                       const RecoveryRequest& request) {
  const double speed = flown.stages.front().opening.speed;
  if (body_area > 0 || !(request.delay > 0) || speed <= fast_fall) return {};
  return {fmt::format(
      "{}: it opens at {} m/s after {:g} s of free fall without the drag of the rocket: speed and loads are "
      "upper bounds; give the drag area of the body with --body-area M2 (payload.drag_area_m2)",
      name, rounded(speed), request.delay)};
}

}  // namespace

RecoveryResult run_recovery(const Settings& main, const std::optional<Settings>& drogue,
                            const RecoveryRequest& request) {
  require_one_canopy(main, "a recovery");
  if (drogue) require_one_canopy(*drogue, "a recovery");
  check_recovery(request, drogue.has_value());
  std::vector<RecoveryCanopy> canopies;
  if (drogue)
    canopies.push_back(canopy_of("drogue", *drogue, request.drogue_steady, request.drogue_opening,
                                 request.drogue_measured_load));
  canopies.push_back(
      canopy_of("main", main, request.main_steady, request.main_opening, request.main_measured_load));
  const Wind& wind = main.flight().wind;
  const double body = request.body_drag_area.value_or(main.payload().drag_area_m2);
  const auto fly = [&] {
    std::vector<Flown> flights;
    for (const DragEnd end : {DragEnd::nominal, DragEnd::low, DragEnd::high})
      flights.push_back(fly_down(canopies, request, wind, body, end));
    return flights;
  };
  RecoveryResult r;
  std::vector<Flown> flights = fly();
  r.warnings = omit_small_measurements(flights[0], canopies);
  if (!r.warnings.empty()) flights = fly();
  for (const RecoveryCanopy& canopy : canopies)
    r.warnings.insert(r.warnings.end(), canopy.inputs.warnings.begin(), canopy.inputs.warnings.end());
  r.title = main.title(), r.mass = r.total_mass = request.mass;
  for (const RecoveryCanopy& canopy : canopies) r.total_mass += canopy.mass;
  if (const double all = std::accumulate(request.sections.begin(), request.sections.end(), 0.0);
      all > 1.001 * r.total_mass)
    throw Error(
        ExitCode::usage,
        fmt::format("sections of {} kg in all: must not exceed the mass that descends, {} kg with the "
                    "parachutes",
                    rounded(all), rounded(r.total_mass)));
  r.apogee = request.apogee, r.ground = request.ground, r.wind = wind;
  r.apogee_wind = norm(wind_velocity(wind, request.apogee, std::numeric_limits<double>::infinity()));
  std::vector<std::string> heavy;
  for (std::size_t i = 0; i < canopies.size(); ++i) {
    r.stages.push_back(stage_of(canopies[i], i, flights, request, r.warnings));
    const std::string& text = flights[0].stages[i].load.heavy_payload;
    if (!text.empty()) heavy.push_back(canopies[i].name + ": " + text);
  }
  if (!heavy.empty())
    r.warnings.push_back(fmt::format("{}. {}", fmt::join(heavy, "; "), heavy_payload_advice()));
  if (request.separation_speed && std::none_of(r.stages.begin(), r.stages.end(), [](const RecoveryStage& s) {
        return s.separation_load.has_value();
      }))
    throw Error(
        ExitCode::usage,
        "a separation needs the shock cord: give [hardware.NAME] with length_m and stiffness_n in the case "
        "of the parachute that opens then");
  r.time = ranged(flights, [](const Flown& f) { return f.rows.back().flight.state.time; });
  r.drift = ranged(flights, [](const Flown& f) { return f.rows.back().drift; });
  r.range = flights[0].rows.back().flight.state.range;
  // While a canopy opens, its drag area exceeds that of the open canopy; a landing is not planned with it.
  r.landing_speed = ranged(
      flights, [](const Flown& f) { return std::max(f.stages.back().end_speed, f.stages.back().terminal); });
  for (std::string& text : fall_warnings(canopies.front().name, body, flights[0], request))
    r.warnings.push_back(std::move(text));
  for (std::string& text : landing_warnings(canopies.back().name, flights))
    r.warnings.push_back(std::move(text));
  if (canopies.size() == 2)
    for (std::string& text : exchanged_parachutes(canopies[0].drag.value * canopies[0].area,
                                                  canopies[1].drag.value * canopies[1].area))
      r.warnings.push_back(std::move(text));
  const auto energy = [&](double mass) {
    const auto of = [&](double speed) { return 0.5 * mass * speed * speed; };
    return Ranged{of(r.landing_speed.value), of(r.landing_speed.low), of(r.landing_speed.high)};
  };
  r.energy = energy(r.total_mass);
  for (const double mass : request.sections) r.sections.push_back({mass, energy(mass)});
  r.rows = std::move(flights[0].rows);
  return r;
}

}  // namespace ripstop::inline run

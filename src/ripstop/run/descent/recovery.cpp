#include "ripstop/run/descent/recovery.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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
#include "ripstop/flight/descent.h"
#include "ripstop/flight/validity.h"
#include "ripstop/flight/wind.h"
#include "ripstop/fsi/opening_estimate.h"
#include "ripstop/run/opening/filling.h"
#include "ripstop/run/opening/handbook.h"
#include "ripstop/run/opening/snatch.h"
#include "ripstop/run/steady/warnings.h"

namespace ripstop::inline run {
namespace {

constexpr double longest_descent = 1e5, slow_step = 0.05, steps_of_filling = 400;  // [s], [s], -

// A descent is steady within 5 % of the terminal speed of the open canopy, and not before three filling times. Until
// then the drag area exceeds that of the open canopy. The filling time is the longest within two standard deviations.
constexpr double steady_share = 0.05, steady_fillings = 3 * (1 + 2 * filling_time_scatter);

struct RecoveryCanopy {
  std::string name;
  const Settings& resolved;
  DragCoefficient drag;
  DescentDrag range;
  double area = 0, mass = 0;  // S0 [m2], [kg]
  std::filesystem::path opening;
  std::optional<double> measured_load;  // [N]
  LoadInputs inputs;
};

/// Which coefficient of each parachute a flight has.
enum class DragEnd { nominal, low, high };
double drag_at(DragEnd end, const RecoveryCanopy& canopy) {
  return end == DragEnd::low    ? canopy.range.low
         : end == DragEnd::high ? canopy.range.high
                                : canopy.drag.value;
}

/// One stage of one flight.
struct FlownStage {
  FlightState opening;
  LoadResult load;                                              // of run_load() there
  double others = 0, end_height = 0;                            // drag area of body and drogue [m2], [m]
  bool filled = true;                                           // before the next opening or the ground
  bool steady = true;                                           // at its end
  double peak_force = 0;                                        // on its canopy along the trajectory [N]
  double end_speed = 0, terminal = 0, duration = 0, drift = 0;  // terminal: of the open canopy at the end
};
struct Flown {
  std::vector<FlownStage> stages;
  std::vector<RecoveryRow> rows;
};

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

/// Opening of a canopy at a state of the flight, of the whole mass [kg].
LoadRequest opening_of(const RecoveryCanopy& canopy, double drag_coefficient, const FlightState& state,
                       double mass, const RecoveryRequest& request) {
  LoadRequest asked;
  asked.payload_mass = mass - canopy.mass;
  asked.speed = state.speed, asked.height = state.height, asked.ground = request.ground;
  asked.path_angle = std::clamp(state.path_angle, -90.0, 90.0);
  asked.drag_coefficient = drag_coefficient;
  asked.opening = canopy.opening, asked.measured_load = canopy.measured_load;
  asked.descent = false;
  // Slower than it will descend, as soon after apogee: methods without gravity; the trajectory has the weight.
  if (state.speed <= 1.001 * slowest_opening(mass, drag_coefficient * canopy.area,
                                             standard_air(state.height).density, asked.path_angle))
    asked.path_angle = 0;
  return asked;
}

LoadResult load_of(const RecoveryCanopy& canopy, const LoadRequest& asked) {
  LoadInputs inputs = canopy.inputs;
  inputs.drag = opening_drag_coefficient(canopy.resolved, asked);
  return run_load(canopy.resolved, asked, inputs);
}

/// A measured load or a computed opening replaces the filling of the handbook.
bool replaces_filling(const LoadResult& load) {
  return load.design_method.empty() || load.design_method == computed_method;
}

/// A canopy fills, and is then open until the next opening or the ground.
struct StageLegs {
  Leg filling, open;
};
StageLegs legs_of(const LoadResult& load, double others, double end_height) {
  const StageLoads& opening = load.stages.front();
  const double cx = load.opening_coefficient, j = load.filling_exponent, area = opening.drag_area;
  const DragArea own = filling(0, area, opening.filling_time, j, cx);
  const double settled = opening.filling_time * (2 + std::pow(cx, 1 / j));
  return {{[=](double t, double s) { return others + own(t, s); }, settled,
           opening.filling_time / steps_of_filling, end_height},
          {[=](double, double) { return others + area; }, longest_descent, slow_step, end_height}};
}

/// On the canopy itself, without the drag of the others [N].
double force_on_canopy(const FlightRow& row, double others) {
  return row.drag_area > others ? row.force * (1 - others / row.drag_area) : 0;
}

/// Largest force on the canopy if the stage begins at `speed` [m/s], else as in its flight [N].
double peak_force_at(double speed, const RecoveryCanopy& canopy, const FlownStage& stage,
                     const RecoveryRequest& request) {
  FlightState state = stage.opening;
  state.speed = speed;
  const double mass = stage.load.payload_mass + canopy.mass;
  const LoadResult load =
      load_of(canopy, opening_of(canopy, stage.load.drag_coefficient, state, mass, request));
  const StageLegs legs = legs_of(load, stage.others, stage.end_height);
  double peak = 0;
  const auto fly_leg = [&](const Leg& leg) {
    double highest = 0;
    for (const FlightRow& row : fly(state, mass, leg))
      highest = std::max(highest, force_on_canopy(row, stage.others));
    return highest;
  };
  const double filling_peak = fly_leg(legs.filling);
  if (!replaces_filling(load)) peak = filling_peak;
  if (state.height > stage.end_height) peak = std::max(peak, fly_leg(legs.open));
  return peak;
}

class RecoveryFlight {
 public:
  RecoveryFlight(const std::vector<RecoveryCanopy>& canopies, const RecoveryRequest& request,
                 const Wind& wind, double body_area, DragEnd end)
      : canopies_(canopies), request_(request), wind_(wind), body_area_(body_area), end_(end) {
    mass_ = request.mass;
    for (const RecoveryCanopy& canopy : canopies) mass_ += canopy.mass;
  }

  Flown fly_down() {
    state_ = {0, 0, 0, request_.ground + request_.apogee, request_.speed, 0};
    if (request_.delay > 0)
      append({[this](double, double) { return body_area_; }, request_.delay, 0.01, request_.ground});
    for (std::size_t i = 0; i < canopies_.size(); ++i) {
      if (state_.height <= request_.ground)
        throw Error(ExitCode::usage,
                    fmt::format("the rocket is on the ground before the {} opens; use a shorter delay or a "
                                "higher apogee",
                                canopies_[i].name));
      fly_stage(i);
    }
    return std::move(flown_);
  }

 private:
  void fly_stage(std::size_t i) {
    const RecoveryCanopy& canopy = canopies_[i];
    FlownStage stage{state_,
                     load_of(canopy, opening_of(canopy, drag_at(end_, canopy), state_, mass_, request_))};
    ++open_;
    const StageLoads& opening = stage.load.stages.front();
    stage.others = body_area_ + (request_.drogue_released ? 0 : before_);
    stage.end_height = request_.ground + (i + 1 < canopies_.size() ? request_.main_height : 0.0);
    const StageLegs legs = legs_of(stage.load, stage.others, stage.end_height);
    const double begin = state_.time, drift = drift_;
    std::size_t first = flown_.rows.size();
    append(legs.filling);
    stage.filled = state_.time - begin >= opening.filling_time;
    if (replaces_filling(stage.load)) first = flown_.rows.size();
    if (state_.height > stage.end_height) append(legs.open);
    for (std::size_t k = first; k < flown_.rows.size(); ++k)
      stage.peak_force = std::max(stage.peak_force, force_on_canopy(flown_.rows[k].flight, stage.others));
    before_ = opening.drag_area;
    stage.duration = state_.time - begin, stage.end_speed = state_.speed, stage.drift = drift_ - drift;
    stage.terminal =
        terminal_speed(mass_, stage.others + opening.drag_area, standard_air(state_.height).density);
    stage.steady = std::abs(stage.end_speed / stage.terminal - 1) <= steady_share &&
                   stage.duration >= steady_fillings * opening.filling_time;
    flown_.stages.push_back(std::move(stage));
  }

  /// Adds the rows of a leg, without repeating the state in which it begins, and the drift meanwhile.
  void append(const Leg& leg) {
    const std::vector<FlightRow> rows = fly(state_, mass_, leg);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (k > 0) {
        const FlightState &a = rows[k - 1].state, &b = rows[k].state;
        const Vec3 air =
            wind_velocity(wind_, 0.5 * (a.height + b.height) - request_.ground, 0.5 * (a.time + b.time));
        const double towards = wind_.direction_deg * std::numbers::pi / 180;
        drift_ += (air.x * std::cos(towards) + air.y * std::sin(towards)) * (b.time - a.time);
      }
      if (k > 0 || flown_.rows.empty()) flown_.rows.push_back({rows[k], drift_, open_});
    }
  }

  const std::vector<RecoveryCanopy>& canopies_;
  const RecoveryRequest& request_;
  const Wind& wind_;
  double body_area_;
  DragEnd end_;
  double mass_ = 0;                // of all [kg]
  int open_ = 0;                   // parachutes
  double before_ = 0, drift_ = 0;  // drag area of the parachute before [m2], with the wind [m]
  FlightState state_;
  Flown flown_;
};

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
      m = separated.members.at(i);
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
  // A canopy that opens slower than it descends accelerates while it fills: its load can be largest at the lowest speed.
  s.lowest_design_load = std::min({s.design_load, (1 - low.uncertainty.value) * low.design_load(),
                                   (1 - high.uncertainty.value) * high.design_load()});
  s.highest_design_load = std::max({s.design_load, (1 + low.uncertainty.value) * low.design_load(),
                                    (1 + high.uncertainty.value) * high.design_load()});
  s.load_uncertainty = high.uncertainty.value, s.load_uncertainty_from = high.uncertainty.from;
  const auto snatch = snatch_of(canopy.resolved, high.asked, high.load);
  if (snatch) s.snatch_load = snatch->largest();
  if (request.separation_speed)
    s.separation_load = separation_load(canopy.resolved, request.sections, *request.separation_speed);
  const double largest_snatch = s.snatch_load.value_or(0);
  s.margins = load_margins(canopy.resolved, s.highest_design_load, largest_snatch);
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
  std::vector<Flown> flights;
  for (const DragEnd end : {DragEnd::nominal, DragEnd::low, DragEnd::high})
    flights.push_back(RecoveryFlight(canopies, request, wind, body, end).fly_down());
  RecoveryResult r;
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

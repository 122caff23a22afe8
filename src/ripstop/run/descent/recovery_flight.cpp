#include "ripstop/run/descent/recovery_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/descent.h"
#include "ripstop/fsi/opening_estimate.h"
#include "ripstop/run/opening/filling.h"

namespace ripstop::inline run {
namespace {

constexpr double longest_descent = 1e5, slow_step = 0.05, steps_of_filling = 400;  // [s], [s], -

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

}  // namespace

double drag_at(DragEnd end, const RecoveryCanopy& canopy) {
  return end == DragEnd::low    ? canopy.range.low
         : end == DragEnd::high ? canopy.range.high
                                : canopy.drag.value;
}

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

Flown fly_down(const std::vector<RecoveryCanopy>& canopies, const RecoveryRequest& request, const Wind& wind,
               double body_area, DragEnd end) {
  return RecoveryFlight(canopies, request, wind, body_area, end).fly_down();
}

}  // namespace ripstop::inline run

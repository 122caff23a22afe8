#include "ripstop/flight/trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "ripstop/core/angle.h"
#include "ripstop/core/error.h"
#include "ripstop/core/positive.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/point_mass.h"

namespace ripstop::inline flight {
namespace {

struct Motion {
  double x = 0, h = 0, s = 0;  // over ground, height, way through the air [m]
  double u = 0, w = 0;         // level and downward speed [m/s]
};

Motion moved(const Motion& a, const Motion& rate, double dt) {
  return {a.x + dt * rate.x, a.h + dt * rate.h, a.s + dt * rate.s, a.u + dt * rate.u, a.w + dt * rate.w};
}

class Flight {
 public:
  Flight(const FlightState& start, double mass, const Leg& leg)
      : mass_(mass), leg_(leg), before_(start.distance) {}

  FlightRow row(const Motion& m, double time, double begin) const {
    FlightRow row;
    const double speed = std::hypot(m.u, m.w);
    row.state = {time, m.s, m.x, m.h, speed, std::atan2(m.w, m.u) / degree};
    row.density = density_at(m.h);
    row.drag_area = leg_.drag_area(time - begin, m.s - before_);
    row.force = 0.5 * row.density * speed * speed * row.drag_area;
    return row;
  }

  Motion rate(const Motion& m, double time) const {
    const double speed = std::hypot(m.u, m.w);
    const double area = leg_.drag_area(time, m.s - before_);
    const InPlane a = acceleration({mass_, standard_gravity}, {m.u, m.w}, density_at(m.h), area);
    return {m.u, -m.w, speed, a.level, a.down};
  }

  Motion stepped(const Motion& m, double time, double dt) const {
    const Motion k1 = rate(m, time), k2 = rate(moved(m, k1, dt / 2), time + dt / 2);
    const Motion k3 = rate(moved(m, k2, dt / 2), time + dt / 2), k4 = rate(moved(m, k3, dt), time + dt);
    return moved(moved(moved(moved(m, k1, dt / 6), k2, dt / 3), k3, dt / 3), k4, dt / 6);
  }

  bool steady(const FlightRow& row) const {
    const double terminal = std::sqrt(2 * mass_ * standard_gravity / (row.density * row.drag_area));
    return std::abs(row.state.speed / terminal - 1) < 1e-3 && std::abs(row.state.path_angle - 90) < 0.1;
  }

 private:
  /// The last step may end below the ground before it is shortened.
  double density_at(double height) const {
    return leg_.density_ratio * standard_air(std::max(height, leg_.ground)).density;
  }

  double mass_;
  const Leg& leg_;
  double before_;
};

}  // namespace

std::vector<FlightRow> fly(FlightState& state, double mass, const Leg& leg) {
  const std::pair<const char*, double> all[] = {{"mass (kg)", mass},
                                                {"speed (m/s)", state.speed},
                                                {"step (s)", leg.step},
                                                {"duration (s)", leg.duration}};
  for (const auto& [name, value] : all) require_positive(std::string("flight with a ") + name, value);
  const Flight flight(state, mass, leg);
  const double begin = state.time, angle = state.path_angle * degree;
  Motion m{state.range, state.height, state.distance, state.speed * std::cos(angle),
           state.speed * std::sin(angle)};
  constexpr double most_steps = 1e12;
  if (!(leg.duration / leg.step < most_steps))
    throw Error(ExitCode::usage, fmt::format("a flight of {:g} s in steps of {:g} s has too many steps; the "
                                             "canopy fills too fast for its speed and size",
                                             leg.duration, leg.step));
  const long long steps = static_cast<long long>(std::ceil(leg.duration / leg.step * (1 - 1e-12)));
  const double dt = leg.duration / double(steps);
  std::vector<FlightRow> rows = {flight.row(m, begin, begin)};
  for (long long i = 0; i < steps && m.h > leg.ground; ++i) {
    const double t = double(i) * dt;
    Motion next = flight.stepped(m, t, dt);
    double last = dt;
    if (next.h < leg.ground) {  // a shorter step to the ground
      last = dt * (m.h - leg.ground) / (m.h - next.h);
      next = flight.stepped(m, t, last);
      next.h = leg.ground;
    }
    m = next;
    rows.push_back(flight.row(m, begin + t + last, begin));
    if (leg.until_steady && flight.steady(rows.back())) break;
  }
  state = rows.back().state;
  return rows;
}

DragArea filling(double from, double to, double filling_time, double exponent, double over) {
  const double top = std::max(over, 1.0);
  const double end = filling_time * std::pow(top, 1 / exponent);
  return [=](double t, double) {
    const double grown = std::pow(std::clamp(t, 0.0, end) / filling_time, exponent);
    double area = from + (to - from) * std::min(grown, 1.0) + to * std::max(grown - 1, 0.0);
    if (t > end) area = to * (top - (top - 1) * std::min(1.0, (t - end) / filling_time));
    return area;
  };
}

DragArea from_record(std::vector<double> distance, std::vector<double> drag_area, double to) {
  if (distance.size() != drag_area.size() || distance.empty())
    throw Error(ExitCode::usage, "a record of the drag area needs as many distances as areas");
  return [distance = std::move(distance), drag_area = std::move(drag_area), to](double, double s) {
    const auto above = std::lower_bound(distance.begin(), distance.end(), s);
    if (above == distance.end()) return to;
    const auto i = static_cast<std::size_t>(above - distance.begin());
    if (i == 0) return drag_area.front() * (distance.front() > 0 ? std::max(s, 0.0) / distance.front() : 1);
    const double share = (s - distance[i - 1]) / (distance[i] - distance[i - 1]);
    return drag_area[i - 1] + share * (drag_area[i] - drag_area[i - 1]);
  };
}

}  // namespace ripstop::inline flight

#include "ripstop/flight/flight_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"

namespace ripstop::inline flight {
namespace {

constexpr double shortest_descent = 10;    // [s]
constexpr double event_window = 2;         // on either side of a deployment [s]
constexpr double slowed = 0.8;             // speed after over speed before
constexpr double significant = 5;          // standard errors
constexpr std::size_t fewest_samples = 8;  // of a line
constexpr double settling = 3.5;           // times v/g, until the speed is within 1 % of the terminal one
constexpr double shortest_phase = 3;       // [s]
constexpr double same_slope = 0.02;        // of the halves of a phase
constexpr double largest_uncertainty = 0.05;
constexpr int parts_of_phase = 12;

/// y of every height, from a table of the integral of sqrt(rho / rho_0) in steps of one metre.
std::vector<double> reduced_heights(const std::vector<double>& heights, double ground) {
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  const double first = std::floor(*low) - 1, rho = standard_air(ground).density;
  const auto root = [&](double h) {
    return std::sqrt(standard_air(std::clamp(ground + h, lowest_height, highest_height)).density / rho);
  };
  std::vector<double> table{0};
  for (double h = first; h < *high + 1; h += 1) table.push_back(table.back() + root(h + 0.5));
  std::vector<double> reduced;
  for (const double h : heights) {
    const double place = h - first;
    const auto i = std::min(static_cast<std::size_t>(place), table.size() - 2);
    reduced.push_back(table[i] + (place - double(i)) * (table[i + 1] - table[i]));
  }
  return reduced;
}

struct FittedLine {
  double slope = 0, error = 0;  // of -y [m/s]
  std::size_t count = 0;
};

class FlightAnalysis {
 public:
  FlightAnalysis(const FlightRecords& records, const FlightLogSetup& setup)
      : records_(records), setup_(setup), t_(records.height.time), h_(records.height.value) {
    rho_ = standard_air(setup.ground).density;
  }

  FlightLog run() {
    drop_outliers();
    y_ = reduced_heights(h_, setup_.ground);
    find_descent();
    find_deployments();
    std::vector<double> borders{log_.highest_time};
    for (const LoggedDeployment& d : log_.deployments) borders.push_back(d.time);
    borders.push_back(landing_);
    for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
      log_.phases.push_back(phase_of(borders[i], borders[i + 1]));
      add_parts(log_.phases.back());
    }
    for (std::size_t i = 0; i < log_.deployments.size(); ++i)
      measure_opening(log_.deployments[i], log_.phases[i + 1]);
    return std::move(log_);
  }

 private:
  void drop_outliers();
  void find_descent();
  void find_deployments();
  DescentPhase phase_of(double from, double to) const;
  void add_parts(const DescentPhase& phase);
  void measure_opening(LoggedDeployment& d, const DescentPhase& after) const;
  void fill(LoggedDeployment& d, const SensorRecord& load, std::size_t start, double drag_area) const;

  std::size_t index_at(double time) const {
    return static_cast<std::size_t>(std::lower_bound(t_.begin(), t_.end(), time) - t_.begin());
  }
  double height_at(double time) const { return h_[std::min(index_at(time), h_.size() - 1)]; }
  FittedLine line(double from, double to) const;
  double drag_area_of(double slope) const {
    return 2 * setup_.mass * standard_gravity / (rho_ * slope * slope);
  }
  /// Of a drag area, from the slope and the mass.
  double relative_error(const FittedLine& l) const {
    return std::hypot(2 * l.error / l.slope, setup_.mass_uncertainty / setup_.mass);
  }

  const FlightRecords& records_;
  const FlightLogSetup& setup_;
  std::vector<double> t_, h_, y_;
  double rho_ = 0, landing_ = 0;
  FlightLog log_;
};

/// Least squares over the samples from `from` to `to`. The residuals of neighbours are correlated, as those of a
/// filtered sensor are: n samples count as n (1 - r) / (1 + r), r the correlation of neighbours.
FittedLine FlightAnalysis::line(double from, double to) const {
  const std::size_t a = index_at(from), b = index_at(to);
  FittedLine l;
  l.count = b > a ? b - a : 0;
  if (l.count < fewest_samples) return l;
  const double n = double(l.count);
  double tm = 0, ym = 0, tt = 0, ty = 0;
  for (std::size_t i = a; i < b; ++i) tm += t_[i] / n, ym += y_[i] / n;
  for (std::size_t i = a; i < b; ++i) tt += (t_[i] - tm) * (t_[i] - tm), ty += (t_[i] - tm) * (y_[i] - ym);
  const double slope = ty / tt;
  double squares = 0, products = 0, last = 0;
  for (std::size_t i = a; i < b; ++i) {
    const double residual = y_[i] - ym - slope * (t_[i] - tm);
    squares += residual * residual;
    if (i > a) products += residual * last;
    last = residual;
  }
  const double correlation = squares > 0 ? std::clamp(products / squares, 0.0, 0.98) : 0;
  l.slope = -slope;
  l.error = std::sqrt(squares / (n - 2) / tt * (1 + correlation) / (1 - correlation));
  return l;
}

/// Samples far from the median of their neighbours are those of a disturbed sensor. The rest gives the noise.
void FlightAnalysis::drop_outliers() {
  const std::size_t n = t_.size();
  std::vector<double> off(n, 0.0);
  for (std::size_t i = 3; i + 3 < n; ++i) {
    std::vector<double> near(h_.begin() + static_cast<std::ptrdiff_t>(i) - 3,
                             h_.begin() + static_cast<std::ptrdiff_t>(i) + 4);
    std::nth_element(near.begin(), near.begin() + 3, near.end());
    off[i] = std::abs(h_[i] - near[3]);
  }
  std::vector<double> sorted = off;
  std::sort(sorted.begin(), sorted.end());
  const double limit = std::max(5.0, 12 * sorted[n / 2]);
  std::vector<double> times, heights;
  for (std::size_t i = 0; i < n; ++i)
    if (off[i] <= limit) times.push_back(t_[i]), heights.push_back(h_[i]);
  if (times.size() < n)
    log_.notes.push_back(
        fmt::format("{} samples of the height lie more than {:.3g} m from their neighbours and are left out",
                    n - times.size(), limit));
  t_ = std::move(times), h_ = std::move(heights);
}

/// From the highest sample to the place where the height no longer falls.
void FlightAnalysis::find_descent() {
  const auto top = std::max_element(h_.begin(), h_.end()) - h_.begin();
  log_.highest_time = t_[static_cast<std::size_t>(top)], log_.highest = h_[static_cast<std::size_t>(top)];
  // The noise: second differences of neighbours, whose variance is six times that of one sample.
  double squares = 0;
  for (std::size_t i = 1; i + 1 < h_.size(); ++i) squares += std::pow(h_[i + 1] - 2 * h_[i] + h_[i - 1], 2);
  log_.height_noise = std::sqrt(squares / 6 / double(h_.size() - 2));
  landing_ = t_.back();
  const FittedLine last = line(t_.back() - event_window, t_.back() + 1e-9);
  if (last.count >= fewest_samples && last.slope < std::max(0.3, significant * last.error)) {
    const double end = h_.back() + std::max(1.0, 3 * log_.height_noise);
    std::size_t i = static_cast<std::size_t>(top);
    while (i + 1 < h_.size() && h_[i] > end) ++i;
    landing_ = t_[i];
  }
  if (landing_ - log_.highest_time < shortest_descent)
    throw Error(
        ExitCode::bad_data,
        fmt::format("the heights fall for {:.3g} s after the highest one only; a descent of at least {:g} s "
                    "is needed",
                    landing_ - log_.highest_time, shortest_descent));
}

void FlightAnalysis::find_deployments() {
  struct Candidate {
    double time, ratio, before, after;
  };
  std::vector<Candidate> all;
  for (double t = log_.highest_time + event_window; t < landing_ - event_window; t += 0.05 * event_window) {
    const FittedLine before = line(t - event_window, t), after = line(t, t + event_window);
    if (before.count < fewest_samples || after.count < fewest_samples || !(before.slope > 0)) continue;
    const bool clear = before.slope - after.slope > significant * std::hypot(before.error, after.error);
    if (clear && after.slope < slowed * before.slope)
      all.push_back({t, after.slope / before.slope, before.slope, after.slope});
  }
  for (const Candidate& c : all) {
    const bool least = std::none_of(all.begin(), all.end(), [&](const Candidate& other) {
      return std::abs(other.time - c.time) < 2 * event_window &&
             (other.ratio < c.ratio || (other.ratio == c.ratio && other.time < c.time));
    });
    if (!least) continue;
    LoggedDeployment d;
    d.time = c.time, d.height = height_at(c.time);
    const double per_slope = std::sqrt(rho_ / standard_air(setup_.ground + d.height).density);
    d.speed_before = c.before * per_slope, d.speed_after = c.after * per_slope;
    log_.deployments.push_back(d);
  }
}

/// The part of a phase at its terminal speed: after the settling time of that speed, and later while the slopes of its
/// halves differ.
DescentPhase FlightAnalysis::phase_of(double from, double to) const {
  DescentPhase p;
  p.begin = from, p.end = to - 0.5 * (to < landing_ ? event_window : 1.0);
  const FittedLine tail = line(from + 0.6 * (p.end - from), p.end);
  if (tail.count >= fewest_samples && tail.slope > 0)
    p.begin += settling * tail.slope / standard_gravity + 0.5 * event_window;
  FittedLine whole;
  while (true) {
    whole = line(p.begin, p.end);
    p.from_height = height_at(p.begin), p.to_height = height_at(p.end);
    if (p.end - p.begin < shortest_phase || whole.count < 2 * fewest_samples) {
      p.problem =
          fmt::format("no {:g} s with {} samples at a steady speed", shortest_phase, 2 * fewest_samples);
      return p;
    }
    p.speed = (p.from_height - p.to_height) / (p.end - p.begin);
    const double middle = 0.5 * (p.begin + p.end);
    const FittedLine first = line(p.begin, middle), second = line(middle, p.end);
    const double apart = std::abs(first.slope - second.slope);
    if (whole.slope > 0 && apart <= same_slope * whole.slope + 3 * std::hypot(first.error, second.error))
      break;
    p.begin += 0.1 * (p.end - p.begin);
  }
  const double error = relative_error(whole);
  if (error > largest_uncertainty) {
    p.problem = fmt::format("the standard error of the drag area would be {:.2g} %", 100 * error);
    return p;
  }
  const double all = drag_area_of(whole.slope);
  p.drag_area = all - setup_.body_drag_area, p.drag_area_uncertainty = error * all;
  if (*p.drag_area <= 0) {
    p.problem = fmt::format("the drag area, {:.3g} m2, is below that of the body", all);
    p.drag_area.reset(), p.drag_area_uncertainty.reset();
  }
  return p;
}

void FlightAnalysis::add_parts(const DescentPhase& phase) {
  if (!phase.drag_area) return;
  const double step = std::max(1.0, (phase.end - phase.begin) / parts_of_phase);
  for (double t = phase.begin; t + 0.99 * step < phase.end; t += step) {
    const FittedLine part = line(t, t + step);
    if (part.count < fewest_samples || !(part.slope > 0)) continue;
    const double all = drag_area_of(part.slope);
    log_.drag_areas.push_back(
        {height_at(t + 0.5 * step), all - setup_.body_drag_area, relative_error(part) * all});
  }
}

/// Whether three samples in a row have the largest value of a whole record: the sensor's limit.
bool is_clipped(const SensorRecord& record) {
  const double top = *std::max_element(record.value.begin(), record.value.end());
  int run = 0;
  for (const double value : record.value) {
    run = value >= top ? run + 1 : 0;
    if (run == 3) return true;
  }
  return false;
}

/// The force of the riser, from a load cell or as mass times specific force.
void FlightAnalysis::measure_opening(LoggedDeployment& d, const DescentPhase& after) const {
  if (!records_.force && !records_.acceleration) {
    d.problem = "no load cell and no accelerometer";
    return;
  }
  SensorRecord load = records_.force ? *records_.force : *records_.acceleration;
  const bool clipped = is_clipped(load);
  if (!records_.force)
    for (double& value : load.value) value *= setup_.mass;
  const auto at = [&](double time) {
    return static_cast<std::size_t>(std::lower_bound(load.time.begin(), load.time.end(), time) -
                                    load.time.begin());
  };
  const std::size_t from = at(d.time - 1.5 * event_window), to = at(d.time + 1.5 * event_window);
  if (to < from + fewest_samples) {
    d.problem = "no load was recorded at this time";
    return;
  }
  const auto begin = load.value.begin();
  const std::size_t peak = static_cast<std::size_t>(
      std::max_element(begin + static_cast<std::ptrdiff_t>(from), begin + static_cast<std::ptrdiff_t>(to)) -
      begin);
  const double top = *std::max_element(load.value.begin(), load.value.end());
  if (clipped && load.value[peak] >= top) {
    d.problem = fmt::format("the sensor is clipped: the peak is at least {:.4g} N", load.value[peak]);
    return;
  }
  d.peak_load = load.value[peak];
  std::vector<double> before(begin + static_cast<std::ptrdiff_t>(from),
                             begin + static_cast<std::ptrdiff_t>(from + (peak - from) / 2 + 1));
  std::nth_element(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(before.size() / 2),
                   before.end());
  const double level = before[before.size() / 2], rise = level + 0.1 * (*d.peak_load - level);
  std::size_t start = peak;
  while (start > from && load.value[start - 1] > rise) --start;
  if (!after.drag_area) {
    d.problem = "no filling time: the drag area after it is not known";
    return;
  }
  fill(d, load, start, *after.drag_area + setup_.body_drag_area);
}

/// From the first rise of the load until 2 F / (rho v^2) is the drag area of the steady descent, with the speed from
/// dv/dt = g - F / m.
void FlightAnalysis::fill(LoggedDeployment& d, const SensorRecord& load, std::size_t start,
                          double drag_area) const {
  const double rho = standard_air(setup_.ground + d.height).density;
  const FittedLine before = line(load.time[start] - event_window, load.time[start]);
  if (before.count < fewest_samples) {
    d.problem = "no filling time: the speed before the opening is not known";
    return;
  }
  double speed = before.slope * std::sqrt(rho_ / rho), way = 0;
  for (std::size_t i = start; i + 1 < load.time.size(); ++i) {
    const double step = load.time[i + 1] - load.time[i];
    if (load.time[i] - load.time[start] > 4 * event_window) break;
    if (2 * load.value[i] >= drag_area * rho * speed * speed) {
      const double time = load.time[i] - load.time[start];
      if (time < 4 * step) break;
      d.filling_time = time;
      if (setup_.nominal_diameter) d.filling_distance = way / *setup_.nominal_diameter;
      return;
    }
    const double force = 0.5 * (load.value[i] + load.value[i + 1]);
    way += step * speed;
    speed = std::max(0.1, speed + step * (standard_gravity - force / setup_.mass));
  }
  d.problem =
      "no filling time: the samples are too far apart, or the load never reaches that of the open canopy";
}

}  // namespace

FlightLog analyse_flight(const FlightRecords& records, const FlightLogSetup& setup) {
  if (records.height.time.size() < 4 * fewest_samples)
    throw Error(ExitCode::bad_data, fmt::format("{} heights are too few; at least {} are needed",
                                                records.height.time.size(), 4 * fewest_samples));
  return FlightAnalysis(records, setup).run();
}

}  // namespace ripstop::inline flight

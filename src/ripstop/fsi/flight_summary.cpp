#include "ripstop/fsi/flight_summary.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "ripstop/core/error.h"
#include "ripstop/flow/statistics.h"

namespace ripstop::inline fsi {
namespace {

/// A swing counts where the tilt has passed its mean by this share of its standard deviation on either side.
constexpr double hysteresis = 0.5;

Record record_of(const std::vector<FreeFlightRow>& rows,
                 const std::function<double(const FreeFlightRow&)>& value) {
  Record record;
  record.begin = rows.front().time - rows.front().step;
  for (const FreeFlightRow& row : rows) record.until.push_back(row.time), record.values.push_back(value(row));
  return record;
}

/// The standard error is at least the change of the mean if the start-up had ended in half the time: a canopy that
/// changes from swinging to gliding may do so within that part of the record which counts as start-up.
MeanWithError estimate_of(const Record& record, double from) {
  const MeanOverTime mean = mean_over_time(record, from);
  MeanWithError estimate{mean.mean, {}};
  if (!std::isfinite(mean.standard_error)) return estimate;
  const double earlier = means_over_parts(record, 0.5 * (record.begin + from), 1).front();
  estimate.standard_error = std::max(mean.standard_error, std::abs(earlier - mean.mean));
  return estimate;
}

MeanWithError estimate_of(const std::vector<double>& values) {
  MeanWithError estimate;
  const double n = double(values.size());
  for (const double v : values) estimate.mean += v / n;
  double squares = 0;
  for (const double v : values) squares += (v - estimate.mean) * (v - estimate.mean);
  if (n > 1) estimate.standard_error = std::sqrt(squares / (n * (n - 1)));
  return estimate;
}

/// The tilt in its principal axes: components about the mean along the larger axis, and the ratio of the axes.
struct Principal {
  std::vector<double> along;  // [deg]
  double deviation = 0;       // of them [deg]
  double roundness = 0;
};
Principal principal_of(const std::vector<FreeFlightRow>& rows, double from) {
  double n = 0, mx = 0, my = 0, xx = 0, yy = 0, xy = 0;
  for (const FreeFlightRow& r : rows)
    if (r.time > from) n += r.step, mx += r.step * r.tilt_x, my += r.step * r.tilt_y;
  mx /= n, my /= n;
  for (const FreeFlightRow& r : rows) {
    if (r.time <= from) continue;
    const double x = r.tilt_x - mx, y = r.tilt_y - my;
    xx += r.step * x * x / n, yy += r.step * y * y / n, xy += r.step * x * y / n;
  }
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy), half = std::hypot(0.5 * (xx - yy), xy),
               middle = 0.5 * (xx + yy);
  Principal p;
  for (const FreeFlightRow& r : rows)
    if (r.time > from)
      p.along.push_back((r.tilt_x - mx) * std::cos(angle) + (r.tilt_y - my) * std::sin(angle));
  p.deviation = std::sqrt(middle + half);
  p.roundness = middle + half > 0 ? std::sqrt(std::max(middle - half, 0.0) / (middle + half)) : 0;
  return p;
}

struct Swings {
  std::vector<double> peaks, periods;  // [deg], [s]

  void take_periods(const std::vector<double>& times) {  // of events, two of them a period
    for (std::size_t i = 2; i < times.size(); ++i) periods.push_back(times[i] - times[i - 2]);
  }
};

/// Between two passages of the mean lies one half-swing; its peak is the largest angle from the vertical in it.
Swings swings_about_mean(const std::vector<FreeFlightRow>& rows, double from, const Principal& p) {
  Swings swings;
  const double threshold = hysteresis * p.deviation;
  std::vector<double> passed;  // times
  double peak = 0;
  int side = 0;
  std::size_t k = 0;
  for (const FreeFlightRow& r : rows) {
    if (r.time <= from) continue;
    const double value = p.along[k++];
    const int now = value > threshold ? 1 : value < -threshold ? -1 : side;
    if (now != side && side != 0) {
      if (!passed.empty()) swings.peaks.push_back(peak);
      passed.push_back(r.time);
      peak = 0;
    }
    side = now;
    peak = std::max(peak, r.angle);
  }
  swings.take_periods(passed);
  return swings;
}

/// Each maximum of the angle from the vertical is one half-swing, in whatever plane, if the angle rises to it and falls
/// from it by the threshold.
Swings swings_of_angle(const std::vector<FreeFlightRow>& rows, double from, const Principal& p) {
  Swings swings;
  const double threshold = hysteresis * p.deviation;
  std::vector<double> times;
  bool rising = false;
  double extreme = 0, when = 0;
  bool first = true;
  for (const FreeFlightRow& r : rows) {
    if (r.time <= from) continue;
    if (first || (rising ? r.angle > extreme : r.angle < extreme)) extreme = r.angle, when = r.time;
    first = false;
    if (std::abs(r.angle - extreme) <= threshold) continue;
    if (rising) swings.peaks.push_back(extreme), times.push_back(when);
    rising = !rising, extreme = r.angle, when = r.time;
  }
  swings.take_periods(times);
  return swings;
}

/// The plane of a swing may change, and a cone has no maxima: the count that sees more of them.
Swings swings_of(const std::vector<FreeFlightRow>& rows, double from, const Principal& p) {
  const Swings about_mean = swings_about_mean(rows, from, p), of_angle = swings_of_angle(rows, from, p);
  return of_angle.peaks.size() > about_mean.peaks.size() ? of_angle : about_mean;
}

}  // namespace

FlightSummary summarise_flight(const std::vector<FreeFlightRow>& rows) {
  if (rows.size() < 2) throw Error(ExitCode::usage, "a flight of fewer than two steps has no mean");
  FlightSummary s;
  const Record down = record_of(rows, [](const FreeFlightRow& r) { return -r.velocity.z; });
  const double from = s.start_up = end_of_start_up(down);
  s.descent = estimate_of(down, from);
  // Relative to the air: the stream in the box and the velocity of the box add up to the wind.
  const auto drift = [&](const auto& component) { return estimate_of(record_of(rows, component), from); };
  const MeanWithError x = drift([](const FreeFlightRow&r) { return r.velocity.x - r.wind.x; }),
                      y = drift([](const FreeFlightRow&r) { return r.velocity.y - r.wind.y; });
  const double across = std::hypot(x.mean, y.mean);
  s.glide.mean = across / s.descent.mean;
  if (x.standard_error && y.standard_error && s.descent.standard_error)
    s.glide.standard_error = std::hypot(std::hypot(*x.standard_error, *y.standard_error),
                                        s.glide.mean * *s.descent.standard_error) /
                             std::abs(s.descent.mean);
  s.mean_angle = estimate_of(record_of(rows, [](const FreeFlightRow& r) { return r.angle; }), from).mean;
  s.mean_attack = estimate_of(record_of(rows, [](const FreeFlightRow& r) { return r.attack; }), from).mean;
  for (const FreeFlightRow& r : rows) {
    s.largest_load = std::max(s.largest_load, norm(r.line_force));
    if (r.time > from) s.largest_attack = std::max(s.largest_attack, r.attack);
  }
  const Principal principal = principal_of(rows, from);
  const Swings swings = swings_of(rows, from, principal);
  s.peaks = static_cast<int>(swings.peaks.size());
  if (s.peaks > 0) {
    s.oscillation = estimate_of(swings.peaks);
    const double n = s.peaks;
    s.largest_oscillation = MeanWithError{*std::max_element(swings.peaks.begin(), swings.peaks.end()), {}};
    if (s.oscillation->standard_error)
      s.largest_oscillation->standard_error = *s.oscillation->standard_error * std::sqrt(n);
    s.roundness = principal.roundness;
  }
  if (!swings.periods.empty()) {
    s.period = estimate_of(swings.periods);
    // Neighbours overlap by half a period.
    if (s.period->standard_error) *s.period->standard_error *= std::numbers::sqrt2;
  }
  return s;
}

}  // namespace ripstop::inline fsi

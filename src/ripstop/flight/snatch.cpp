#include "ripstop/flight/snatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "ripstop/core/error.h"
#include "ripstop/core/positive.h"

namespace ripstop::inline flight {
namespace {

double tension(const SnatchPart& part, double strain) {  // of one strand [N]
  double sum = 0;
  for (std::size_t k = part.coefficients.size(); k-- > 0;) sum = (sum + part.coefficients[k]) * strain;
  return sum;
}

double energy(const SnatchPart& part, double strain) {  // of all strands [J]
  double sum = 0, power = strain;
  for (std::size_t k = 0; k < part.coefficients.size(); ++k) {
    power *= strain;
    sum += part.coefficients[k] * power / double(k + 2);
  }
  return part.strands * part.length * sum;
}

/// Where the curve stops to rise; infinite where it does not.
double last_rising(const SnatchPart& part) {
  constexpr double step = 1e-3, most = 2;
  for (double strain = step; strain <= most; strain += step)
    if (tension(part, strain) <= tension(part, strain - step)) return strain - step;
  return most;
}

double strain_under(const SnatchPart& part, double strand_load, double highest) {
  double low = 0, high = highest;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (tension(part, middle) < strand_load ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The parts in a row under one tension.
class Row {
 public:
  explicit Row(const std::vector<SnatchPart>& parts) : parts_(parts) {
    for (const SnatchPart& part : parts) {
      highest_.push_back(last_rising(part));
      limit_ = std::min(limit_, part.strands * tension(part, highest_.back()));
    }
  }
  double limit() const { return limit_; }  // the largest load that every part bears on its rising curve [N]
  std::vector<double> strains(double load) const {
    std::vector<double> all;
    for (std::size_t i = 0; i < parts_.size(); ++i)
      all.push_back(strain_under(parts_[i], load / parts_[i].strands, highest_[i]));
    return all;
  }
  double stretch(double load) const {
    double sum = 0;
    const std::vector<double> strain = strains(load);
    for (std::size_t i = 0; i < parts_.size(); ++i) sum += strain[i] * parts_[i].length;
    return sum;
  }
  double energy_at(double load) const {
    double sum = 0;
    const std::vector<double> strain = strains(load);
    for (std::size_t i = 0; i < parts_.size(); ++i) sum += energy(parts_[i], strain[i]);
    return sum;
  }
  /// The load between 0 and `limit()` at which `of` is `wanted`; `of` rises with the load.
  template <class Of>
  double load_where(Of&& of, double wanted) const {
    double low = 0, high = limit_;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (of(middle) < wanted ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

 private:
  const std::vector<SnatchPart>& parts_;
  std::vector<double> highest_;
  double limit_ = std::numeric_limits<double>::infinity();
};

void check(double value, const std::string& what) {
  require_positive("snatch with a " + what, value);
}

}  // namespace

// The masses swing once from slack to the largest tension; with x = x_max sin(theta) the integral of dx / x' has no
// end that runs away, and the middle rule takes 200 values of it.
SnatchLoad snatch_load(double payload_mass, double canopy_mass, double speed_difference,
                       const std::vector<SnatchPart>& parts) {
  check(payload_mass, "payload mass (kg)");
  check(canopy_mass, "canopy mass (kg)");
  check(speed_difference, "speed difference (m/s)");
  if (parts.empty())
    throw Error(ExitCode::usage, "the snatch load requires lines or a riser between the masses");
  for (const SnatchPart& part : parts) check(part.length, "length (m) of " + part.name);
  const double reduced = payload_mass * canopy_mass / (payload_mass + canopy_mass);
  const double wanted = 0.5 * reduced * speed_difference * speed_difference;
  const Row row(parts);
  const auto energy_at = [&](double load) { return row.energy_at(load); };
  const double most = energy_at(row.limit());
  if (most < wanted)
    throw Error(ExitCode::usage, fmt::format("a snatch energy of {:.3g} J: lines and riser absorb {:.3g} J "
                                             "up to the end of their curves at {:.3g} N and would break",
                                             wanted, most, row.limit()));
  SnatchLoad result;
  result.load = row.load_where(energy_at, wanted);
  result.strain = row.strains(result.load);
  result.stretch = row.stretch(result.load);
  for (const SnatchPart& part : parts) result.strand_load.push_back(result.load / part.strands);
  constexpr int values = 200;
  constexpr double d = std::numbers::pi / 2 / values;
  for (int i = 0; i < values; ++i) {
    const double theta = (i + 0.5) * d, x = result.stretch * std::sin(theta);
    const double load = row.load_where([&](double force) { return row.stretch(force); }, x);
    const double left = 1 - energy_at(load) / wanted;
    result.time += result.stretch * std::cos(theta) * d / (speed_difference * std::sqrt(left));
  }
  return result;
}

double TensionCurve::at(double stretch_m) const {
  if (!(stretch_m > 0)) return 0;
  if (stretch_m > stretch.back())
    throw Error(
        ExitCode::usage,
        fmt::format(
            "lines and riser break in the snatch: they are stretched by {:.3g} m and bear {:.3g} N at "
            "{:.3g} m; a lower relative speed, a lighter canopy or stronger lines are needed",
            stretch_m, tension.back(), stretch.back()));
  const auto next = std::upper_bound(stretch.begin(), stretch.end() - 1, stretch_m) - stretch.begin();
  const auto i = static_cast<std::size_t>(next);
  const double share = (stretch_m - stretch[i - 1]) / (stretch[i] - stretch[i - 1]);
  return tension[i - 1] + share * (tension[i] - tension[i - 1]);
}

double TensionCurve::steepest() const {
  double most = 0;
  for (std::size_t i = 1; i < stretch.size(); ++i)
    most = std::max(most, (tension[i] - tension[i - 1]) / (stretch[i] - stretch[i - 1]));
  return most;
}

TensionCurve tension_curve(const std::vector<SnatchPart>& parts) {
  if (parts.empty()) throw Error(ExitCode::usage, "a snatch needs lines or a riser between the masses");
  for (const SnatchPart& part : parts) check(part.length, "length (m) of " + part.name);
  constexpr int rows = 2000;
  const Row row(parts);
  TensionCurve curve;
  for (int i = 0; i <= rows; ++i) {
    curve.tension.push_back(row.limit() * std::pow(double(i) / rows, 3));  // dense where snatch loads are
    curve.stretch.push_back(i == 0 ? 0 : row.stretch(curve.tension.back()));
  }
  return curve;
}

// v(t) = v / (1 + b v t) and s(t) = ln(1 + b v t) / b with b = rho C_D A / (2 m).
double speed_difference_at_stretch(const Coasting& payload, const Coasting& canopy, double speed,
                                   double density, double length) {
  check(payload.mass, "payload mass (kg)");
  check(canopy.mass, "canopy mass (kg)");
  check(speed, "speed (m/s)");
  check(density, "density (kg/m3)");
  check(length, "length (m) of lines and riser");
  check(canopy.drag_area, "drag area (m2) of the packed canopy");
  if (!(payload.drag_area >= 0))
    throw Error(ExitCode::usage,
                fmt::format("a snatch with a drag area (m2) of the payload of {:g}: must be 0 or above",
                            payload.drag_area));
  const double bp = 0.5 * density * payload.drag_area / payload.mass;
  const double bc = 0.5 * density * canopy.drag_area / canopy.mass;
  if (!(bc > bp))
    throw Error(ExitCode::usage,
                "the lines are stretched only if the packed canopy decelerates more than the payload: its "
                "ratio of drag area to mass must be above that of the payload");
  const auto way = [&](double b, double t) { return b > 0 ? std::log1p(b * speed * t) / b : speed * t; };
  const auto apart = [&](double t) { return way(bp, t) - way(bc, t); };
  double low = 0, high = length / speed;
  for (int i = 0; apart(high) < length; ++i) {
    high *= 2;
    if (i > 60) throw Error(ExitCode::usage, "payload and canopy do not separate by the length of the lines");
  }
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (apart(middle) < length ? low : high) = middle;
  }
  return speed / (1 + bp * speed * high) - speed / (1 + bc * speed * high);
}

}  // namespace ripstop::inline flight

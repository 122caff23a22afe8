#include "ripstop/material/curve_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "ripstop/core/error.h"
#include "ripstop/core/least_squares.h"

namespace ripstop::inline material {
namespace {

constexpr int grid_points = 200;
constexpr double most_ratio = 10;   // between two samples of the same cloth
constexpr int degrees_of_bias = 2;  // above the fit, to show its error
constexpr double as_good = 1.01;    // times the least prediction error

/// Averages of the points within half a step of each grid strain, interpolated where there are none.
std::vector<double> resampled(const CleanRecord& record, const std::vector<double>& grid) {
  const double half = 0.5 * (grid[1] - grid[0]);
  std::vector<double> result;
  const std::vector<double>&x = record.strain, &y = record.load;
  for (double e : grid) {
    const auto from = std::lower_bound(x.begin(), x.end(), e - half);
    const auto to = std::lower_bound(x.begin(), x.end(), e + half);
    if (from != to) {
      const auto first = static_cast<std::size_t>(from - x.begin()),
                 last = static_cast<std::size_t>(to - x.begin());
      // The points' mean strain is not quite the grid's: carry the average over with the slope about it.
      const double mean_x = mean(std::span(x).subspan(first, last - first));
      const double mean_y = mean(std::span(y).subspan(first, last - first));
      const std::size_t a = first > 0 ? first - 1 : first, b = std::min(last, x.size() - 1);
      const double slope = x[b] > x[a] ? (y[b] - y[a]) / (x[b] - x[a]) : 0.0;
      result.push_back(mean_y + slope * (e - mean_x));
      continue;
    }
    const auto above = static_cast<std::size_t>(from - x.begin());
    const std::size_t b = std::clamp<std::size_t>(above, 1, x.size() - 1), a = b - 1;
    const double part = x[b] > x[a] ? (e - x[a]) / (x[b] - x[a]) : 0.0;
    result.push_back(y[a] + part * (y[b] - y[a]));
  }
  return result;
}

std::vector<double> weights(const MeanCurve& curve, const FitOptions& options) {
  std::vector<double> result;
  for (double strain : curve.strain) result.push_back(strain_weight(strain, options));
  return result;
}

int first_power(const FitOptions& options) {
  return options.zero_offset ? 1 : 0;
}

/// Coefficients of every sample.
std::vector<std::vector<double>> fit_samples(const MeanCurve& curve, int degree, const FitOptions& options) {
  const std::vector<double> weight = weights(curve, options);
  std::vector<std::vector<double>> c;
  for (const auto& sample : curve.samples)
    c.push_back(fit_polynomial(curve.strain, sample, first_power(options), degree, weight));
  return c;
}

/// `reach` in standard errors.
Estimate estimate(const std::vector<double>& values, double reach) {
  Estimate result;
  result.value = mean(values);
  const double none = std::numeric_limits<double>::quiet_NaN();
  result.standard_error =
      values.size() < 2 ? none : standard_deviation(values) / std::sqrt(static_cast<double>(values.size()));
  result.low = result.value - reach * result.standard_error;
  result.high = result.value + reach * result.standard_error;
  return result;
}

}  // namespace

std::vector<double> CurveFit::coefficients() const {
  std::vector<double> result;
  for (const Estimate& e : k) result.push_back(e.value);
  return result;
}

MeanCurve mean_curve(const std::vector<CleanRecord>& samples) {
  MeanCurve curve;
  curve.orientation = samples.front().orientation;
  curve.tested_strain = std::numeric_limits<double>::infinity();
  for (const CleanRecord& sample : samples) {
    curve.names.push_back(sample.name);
    curve.failure_strain.push_back(sample.failure_strain);
    curve.failure_load.push_back(sample.failure_load);
    curve.tested_strain = std::min(curve.tested_strain, sample.failure_strain);
  }
  for (int i = 0; i < grid_points; ++i) curve.strain.push_back(curve.tested_strain * (i + 0.5) / grid_points);
  for (const CleanRecord& sample : samples) curve.samples.push_back(resampled(sample, curve.strain));

  const std::size_t at = grid_points / 2;
  std::size_t least = 0, most = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (curve.samples[i][at] < curve.samples[least][at]) least = i;
    if (curve.samples[i][at] > curve.samples[most][at]) most = i;
  }
  if (curve.samples[most][at] > most_ratio * std::max(0.0, curve.samples[least][at]))
    throw Error(ExitCode::bad_data,
                fmt::format("{} and {} cannot be the same material: {:.4g} and {:.4g} at strain {:.3g}; "
                            "check for mixed units, wrong width or orientation",
                            curve.names[most], curve.names[least], curve.samples[most][at],
                            curve.samples[least][at], curve.strain[at]));
  for (int i = 0; i < grid_points; ++i) {
    std::vector<double> values;
    for (const auto& sample : curve.samples) values.push_back(sample[i]);
    curve.load.push_back(mean(values));
    curve.spread.push_back(standard_deviation(values));
  }
  return curve;
}

CurveFit fit_curve(const MeanCurve& curve, int degree, const FitOptions& options) {
  const int first = first_power(options);
  CurveFit result;
  result.degree = degree;
  result.tested_strain = curve.tested_strain;

  const std::vector<std::vector<double>> own = fit_samples(curve, degree, options);
  const std::vector<std::vector<double>> higher = fit_samples(curve, degree + degrees_of_bias, options);
  const double reach = student_t(options.confidence, std::max(1, static_cast<int>(curve.samples.size()) - 1));
  const auto over = [&](const std::vector<std::vector<double>>& samples, auto&& value) {
    std::vector<double> values;
    for (const std::vector<double>& c : samples) values.push_back(value(c));
    return estimate(values, reach);
  };
  /// The fit's own value, with the interval of the higher degree.
  const auto with_bias = [&](auto&& value) {
    Estimate e = over(own, value);
    const Estimate unbiased = over(higher, value);
    e.low = std::min(e.value, unbiased.low);
    e.high = std::max(e.value, unbiased.high);
    if (curve.samples.size() < 2) e.low = e.high = std::numeric_limits<double>::quiet_NaN();
    return e;
  };
  for (int k = first; k <= degree; ++k) {
    const auto coefficient = [&](const std::vector<double>& c) { return c[k - first]; };
    const Estimate e = k == 1 ? with_bias(coefficient) : over(own, coefficient);
    if (k == 0)
      result.offset = e;
    else
      result.k.push_back(e);
  }
  for (double strain : curve.strain) {
    const Estimate e = with_bias([&](const std::vector<double>& c) { return polynomial(c, first, strain); });
    result.fit.push_back(e.value);
    result.band_low.push_back(e.low);
    result.band_high.push_back(e.high);
  }
  result.r2 = r_squared(curve.load, result.fit);
  std::vector<double> all, all_fit;
  for (const auto& sample : curve.samples) {
    all.insert(all.end(), sample.begin(), sample.end());
    all_fit.insert(all_fit.end(), result.fit.begin(), result.fit.end());
  }
  result.r2_all = r_squared(all, all_fit);

  result.rising_until = curve.tested_strain;
  constexpr int looks = 2000;
  const std::vector<double> law = result.coefficients();
  for (int i = 0; i < looks; ++i) {
    const double a = curve.tested_strain * i / looks, b = curve.tested_strain * (i + 1) / looks;
    if (polynomial(law, 1, b) > polynomial(law, 1, a)) continue;
    result.rising_until = a;
    break;
  }
  return result;
}

double strain_weight(double strain, const FitOptions& options) {
  if (options.rule == DegreeRule::nfm || strain <= options.working_strain) return 1;
  return std::pow(options.working_strain / strain, 2);
}

double prediction_error(const std::vector<MeanCurve>& curves, int degree, const FitOptions& options) {
  const int first = first_power(options);
  std::vector<double> errors;
  for (const MeanCurve& curve : curves) {
    if (curve.samples.size() < 2) continue;
    const auto n = static_cast<double>(curve.samples.size());
    const std::vector<std::vector<double>> c = fit_samples(curve, degree, options);
    std::vector<double> sum(c.front().size());
    for (const std::vector<double>& one : c)
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += one[k];
    const std::vector<double> weight = weights(curve, options);
    double error = 0, load = 0;
    for (std::size_t i = 0; i < c.size(); ++i) {
      std::vector<double> others = sum;  // the fit is linear: the others' mean is their fit
      for (std::size_t k = 0; k < sum.size(); ++k) others[k] = (sum[k] - c[i][k]) / (n - 1);
      for (std::size_t j = 0; j < weight.size(); ++j) {
        error += weight[j] * std::pow(curve.samples[i][j] - polynomial(others, first, curve.strain[j]), 2);
        load += weight[j] * std::pow(curve.load[j], 2);
      }
    }
    errors.push_back(error / load);
  }
  return errors.empty() ? std::numeric_limits<double>::quiet_NaN() : mean(errors);
}

namespace {

/// The rule of [NFM].
int lowest_with_r2(const std::vector<MeanCurve>& curves, const FitOptions& options) {
  const MeanCurve* worst = nullptr;
  double worst_r2 = 1;
  for (int degree = 1; degree <= options.highest_degree; ++degree) {
    worst = nullptr;
    worst_r2 = std::numeric_limits<double>::infinity();
    for (const MeanCurve& curve : curves) {
      const double r2 = fit_curve(curve, degree, options).r2;
      if (r2 < worst_r2) worst_r2 = r2, worst = &curve;
    }
    if (worst_r2 > options.wanted_r2) return degree;
  }
  throw Error(ExitCode::bad_data,
              fmt::format("no polynomial up to degree {} follows the {:.0f} deg curve with R2 above {} (best "
                          "{:.3f}); check its records, or choose a degree",
                          options.highest_degree, worst->orientation, options.wanted_r2, worst_r2));
}

}  // namespace

int choose_degree(const std::vector<MeanCurve>& curves, const FitOptions& options) {
  if (options.degree) return *options.degree;
  if (options.rule == DegreeRule::nfm || std::isnan(prediction_error(curves, 1, options)))
    return lowest_with_r2(curves, options);
  const auto pulls_back = [&](int degree) {
    return std::all_of(curves.begin(), curves.end(), [&](const MeanCurve& curve) {
      const int first = first_power(options);
      return fit_polynomial(curve.strain, curve.load, first, degree, weights(curve, options))[1 - first] > 0;
    });
  };
  std::vector<int> degrees(static_cast<std::size_t>(options.highest_degree));
  std::iota(degrees.begin(), degrees.end(), 1);
  if (std::any_of(degrees.begin(), degrees.end(), pulls_back))
    std::erase_if(degrees, [&](int degree) { return !pulls_back(degree); });
  std::vector<double> errors;
  for (int degree : degrees) errors.push_back(prediction_error(curves, degree, options));
  const double enough = as_good * *std::min_element(errors.begin(), errors.end());
  std::size_t i = 0;
  while (errors[i] > enough) ++i;
  return degrees[i];
}

}  // namespace ripstop::inline material

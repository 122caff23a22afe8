// Polynomials through measured points, and their statistical uncertainty.
#pragma once

#include <span>
#include <vector>

namespace ripstop {

/// sum_k c_k x^k, k from `first`.
double polynomial(std::span<const double> c, int first, double x);

/// Least squares for y = sum_k c_k x^k with k = first .. degree (first 0 or 1); `weight` of the squared misfit at every
/// point, empty: alike. The columns are scaled, so strains of 1e-3 and degree 10 are harmless. Throws
/// Error(bad_data) with fewer points than coefficients.
std::vector<double> fit_polynomial(std::span<const double> x, std::span<const double> y, int first,
                                   int degree, std::span<const double> weight = {});

/// 1 - sum (y - fit)^2 / sum (y - mean y)^2; 1 for a constant y that is met, else minus infinity.
double r_squared(std::span<const double> y, std::span<const double> fit);

/// The straight line of least squares, and how well points allow it to be known.
struct LineFit {
  double slope = 0, intercept = 0;
  double r2 = 1;
  double slope_error = 0, intercept_error = 0;  // standard errors; 0 for two points
  double scatter = 0;                           // standard deviation of the points about the line
  int points = 0;
  double mean_x = 0, spread_x = 0;  // mean and sum of squared deviations of x

  double at(double x) const { return intercept + slope * x; }
  /// Standard error of the line itself at x.
  double error_at(double x) const;
  /// Half width of the confidence band of the line at x; 0 for two points.
  double band(double x, double confidence = 0.95) const;
};
/// Throws Error(bad_data) with fewer than two different x.
LineFit fit_line(std::span<const double> x, std::span<const double> y);

double mean(std::span<const double> values);
/// With n - 1 in the denominator; 0 for one value.
double standard_deviation(std::span<const double> values);

/// t such that a Student t variable lies in [-t, t] with this probability, 0 < confidence < 1, degrees >= 1.
double student_t(double confidence, int degrees);

}  // namespace ripstop

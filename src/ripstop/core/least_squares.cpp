#include "ripstop/core/least_squares.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numeric>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

/// Regularised incomplete beta function I_x(a, b): continued fraction by Lentz's method (Abramowitz and
/// Stegun 26.5.8), for x below (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
  constexpr double tiny = 1e-300;
  double c = 1, d = 1 - (a + b) * x / (a + 1);
  d = 1 / (std::abs(d) < tiny ? tiny : d);
  double h = d;
  for (int m = 1; m < 500; ++m) {
    const auto turn = [&](double term) {
      d = 1 + term * d;
      d = 1 / (std::abs(d) < tiny ? tiny : d);
      c = 1 + term / c;
      if (std::abs(c) < tiny) c = tiny;
      h *= d * c;
    };
    turn(m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)));
    turn(-(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1)));
    if (std::abs(d * c - 1) < 1e-15) break;
  }
  const double log_front =
      std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x);
  return std::exp(log_front) * h / a;
}

double incomplete_beta(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  return x < (a + 1) / (a + b + 2) ? beta_fraction(a, b, x) : 1 - beta_fraction(b, a, 1 - x);
}

}  // namespace

double polynomial(std::span<const double> c, int first, double x) {
  double sum = 0;
  for (auto k = c.rbegin(); k != c.rend(); ++k) sum = sum * x + *k;
  return first == 1 ? sum * x : sum;
}

std::vector<double> fit_polynomial(std::span<const double> x, std::span<const double> y, int first,
                                   int degree, std::span<const double> weight) {
  const auto count = static_cast<Eigen::Index>(x.size());
  const Eigen::Index n = degree - first + 1;
  if (count < n || x.size() != y.size())
    throw Error(ExitCode::bad_data,
                fmt::format("{} points are too few for a polynomial of degree {}", x.size(), degree));
  double range = 0;
  for (double v : x) range = std::max(range, std::abs(v));
  if (!(range > 0)) throw Error(ExitCode::bad_data, "all points lie at zero: no curve can be fitted");
  Eigen::MatrixXd a(count, n);
  Eigen::VectorXd b(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double scale = weight.empty() ? 1.0 : std::sqrt(weight[i]);
    b[i] = scale * y[i];
    for (Eigen::Index j = 0; j < n; ++j)
      a(i, j) = scale * std::pow(x[i] / range, static_cast<double>(j + first));
  }
  const Eigen::VectorXd solution = a.colPivHouseholderQr().solve(b);
  std::vector<double> c(n);
  for (Eigen::Index j = 0; j < n; ++j) c[j] = solution[j] / std::pow(range, static_cast<double>(j + first));
  return c;
}

double r_squared(std::span<const double> y, std::span<const double> fit) {
  const double centre = mean(y);
  double left = 0, total = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    left += (y[i] - fit[i]) * (y[i] - fit[i]);
    total += (y[i] - centre) * (y[i] - centre);
  }
  if (total == 0) return left == 0 ? 1 : -std::numeric_limits<double>::infinity();
  return 1 - left / total;
}

double LineFit::error_at(double x) const {
  return scatter * std::sqrt(1.0 / points + (x - mean_x) * (x - mean_x) / spread_x);
}

double LineFit::band(double x, double confidence) const {
  return points > 2 ? student_t(confidence, points - 2) * error_at(x) : 0;
}

LineFit fit_line(std::span<const double> x, std::span<const double> y) {
  LineFit line;
  line.points = static_cast<int>(x.size());
  if (x.size() < 2 || x.size() != y.size()) throw Error(ExitCode::bad_data, "a line needs two points");
  line.mean_x = mean(x);
  const double mean_y = mean(y);
  double xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    line.spread_x += (x[i] - line.mean_x) * (x[i] - line.mean_x);
    xy += (x[i] - line.mean_x) * (y[i] - mean_y);
  }
  if (!(line.spread_x > 0)) throw Error(ExitCode::bad_data, "a line needs points at two different x");
  line.slope = xy / line.spread_x;
  line.intercept = mean_y - line.slope * line.mean_x;
  std::vector<double> on_line;
  double squares = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    on_line.push_back(line.at(x[i]));
    squares += (y[i] - on_line[i]) * (y[i] - on_line[i]);
  }
  line.r2 = r_squared(y, on_line);
  if (line.points > 2) {
    line.scatter = std::sqrt(squares / (line.points - 2));
    line.slope_error = line.scatter / std::sqrt(line.spread_x);
    line.intercept_error = line.error_at(0);
  }
  return line;
}

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double standard_deviation(std::span<const double> values) {
  if (values.size() < 2) return 0;
  const double centre = mean(values);
  double sum = 0;
  for (double v : values) sum += (v - centre) * (v - centre);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

// P(|T| > t) = I_x(n / 2, 1 / 2) with x = n / (n + t^2) (Abramowitz and Stegun 26.7.1); bisection in log t.
double student_t(double confidence, int degrees) {
  const double tail = 1 - confidence;
  double low = -20, high = 40;  // of log2 t
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    const double t = std::exp2(middle);
    (incomplete_beta(0.5 * degrees, 0.5, degrees / (degrees + t * t)) > tail ? low : high) = middle;
  }
  return std::exp2(0.5 * (low + high));
}

}  // namespace ripstop

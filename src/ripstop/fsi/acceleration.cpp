#include "ripstop/fsi/acceleration.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace ripstop::inline fsi {
namespace {

double weighted_dot(const std::vector<double>& a, const std::vector<double>& b,
                    const std::vector<double>& w) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += w[i] * a[i] * b[i];
  return sum;
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> d(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) d[i] = a[i] - b[i];
  return d;
}

// w_k = -w_{k-1} r_{k-1}.(r_k - r_{k-1}) / |r_k - r_{k-1}|^2, kept within 0.1 .. 1.5.
double aitken(const Accelerator& a, const std::vector<double>& residual, const std::vector<double>& weight) {
  if (a.residuals.empty()) return a.relaxation;
  const std::vector<double> change = difference(residual, a.residuals.back());
  const double denominator = weighted_dot(change, change, weight);
  if (denominator <= 0) return a.aitken_factor;
  return std::clamp(-a.aitken_factor * weighted_dot(a.residuals.back(), change, weight) / denominator, 0.1,
                    1.5);
}

// Minimise |r - dR c|, then x' = (x - dX c) + relaxation (r - dR c): this subtracts the terms with c. A small
// ridge keeps nearly parallel differences from giving large c. It is the same for all: under a uniform load
// every difference is parallel, and then each counts with its length, so that a short one, where the flow was
// still settling, does not set the slope.
void subtract_anderson(std::vector<double>& next, const Accelerator& a, const std::vector<double>& x,
                       const std::vector<double>& residual, const std::vector<double>& weight) {
  const int m = static_cast<int>(a.residuals.size());
  std::vector<std::vector<double>> dx, dr;
  for (int k = 0; k < m; ++k) {
    dx.push_back(difference(k + 1 < m ? a.guesses[k + 1] : x, a.guesses[k]));
    dr.push_back(difference(k + 1 < m ? a.residuals[k + 1] : residual, a.residuals[k]));
  }
  if (m == 0) return;
  Eigen::MatrixXd matrix(m, m);
  Eigen::VectorXd right(m);
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < m; ++j) matrix(i, j) = weighted_dot(dr[i], dr[j], weight);
    right(i) = weighted_dot(dr[i], residual, weight);
  }
  matrix.diagonal().array() += 1e-6 * matrix.diagonal().maxCoeff();
  const Eigen::VectorXd c = matrix.ldlt().solve(right);
  if (!c.allFinite()) return;  // identical residuals: nothing to learn from them
  for (int k = 0; k < m; ++k) {
    for (std::size_t i = 0; i < x.size(); ++i) next[i] -= c(k) * (dx[k][i] + a.relaxation * dr[k][i]);
  }
}

}  // namespace

void Accelerator::average(double whole) {
  update = Acceleration::none;
  relaxation /= 1 + relaxation / whole;
}

std::vector<double> Accelerator::next(const std::vector<double>& x, const std::vector<double>& g,
                                      const std::vector<double>& weight) {
  const std::vector<double> residual = difference(g, x);
  if (update == Acceleration::aitken) aitken_factor = aitken(*this, residual, weight);
  const double factor = update == Acceleration::aitken ? aitken_factor : relaxation;
  std::vector<double> result(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) result[i] = x[i] + factor * residual[i];
  if (update == Acceleration::anderson) subtract_anderson(result, *this, x, residual, weight);

  guesses.push_back(x);
  residuals.push_back(residual);
  if (guesses.size() > static_cast<std::size_t>(update == Acceleration::anderson ? memory : 1)) {
    guesses.erase(guesses.begin());
    residuals.erase(residuals.begin());
  }
  return result;
}

}  // namespace ripstop::inline fsi

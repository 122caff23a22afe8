#include "ripstop/material/lattice.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

constexpr double tolerance = 1e-3;      // of the returned curve, relative
constexpr double unknown_strain = 0.1;  // range of the fit when the material does not say
constexpr int samples = 80;
constexpr int added_degrees = 2;

LatticeLaws split(const std::vector<double>& k, double xi, double eps, double compression) {
  const SpringLaw whole{k, compression};
  return {whole.scaled(1 - xi - eps), whole.scaled(xi / 2), whole.scaled(eps / 2)};
}

double value(const std::vector<double>& k, double e) {
  return SpringLaw{k, 1}.tension(e);
}

double largest_error(const LatticeLaws& laws, const std::vector<double>& curve, double range) {
  double worst = 0;
  for (int i = 1; i <= samples; ++i) {
    const double e = range * i / samples;
    worst = std::max(worst, std::abs(uniaxial_load(laws, e) / value(curve, e) - 1));
  }
  return worst;
}

}  // namespace

// Energy of the square lattice per undeformed area, E the integral of a family's law:
//   W = E_ax(e_x) + E_ax(e_y) + 2 E_b(e_x) + 2 E_b(e_y) + 2 sqrt2 E_sh(e_s),
//   1 + e_s = sqrt(((1 + e_x)^2 + (1 + e_y)^2) / 2),    N = dW/de.
Resultants lattice_resultants(const LatticeLaws& laws, double strain_along, double strain_across) {
  const double a = 1 + strain_along, b = 1 + strain_across;
  const double s = std::sqrt(0.5 * (a * a + b * b));
  const double shear = std::numbers::sqrt2 * laws.shear.tension(s - 1) / s;
  const auto straight = [&](double e) { return laws.axial.tension(e) + 2 * laws.bending.tension(e); };
  return {straight(strain_along) + shear * a, straight(strain_across) + shear * b};
}

double uniaxial_load(const LatticeLaws& laws, double strain) {
  // N across grows with the strain across, is positive at 0 and negative once the diagonals are slack too.
  double low = -0.9, high = std::max(0.0, strain);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (lattice_resultants(laws, strain, middle).across > 0 ? high : low) = middle;
  }
  return lattice_resultants(laws, strain, high).along;
}

LatticeLaws lattice_laws(const std::vector<double>& coefficients, double xi, double eps, double compression,
                         double tested_strain) {
  if (!(xi >= 0) || !(eps >= 0) || !(xi + eps < 1))
    throw Error(
        ExitCode::bad_data,
        fmt::format("shear fraction {} and bending fraction {} must be >= 0 and add up to less than 1", xi,
                    eps));
  const double range = tested_strain > 0 ? tested_strain : unknown_strain;
  for (int i = 1; i <= samples; ++i)
    if (!(value(coefficients, range * i / samples) > 0))
      throw Error(
          ExitCode::bad_data,
          fmt::format("the cloth's curve is not positive at strain {:.3g}, inside the tested range of "
                      "{:.3g}; check its coefficients",
                      range * i / samples, range));

  // Gauss-Newton on the relative misfit; the load is nearly linear in the coefficients, so few rounds do.
  double best = 0;
  for (int added = 0; added <= added_degrees; ++added) {
    std::vector<double> k = coefficients;
    k.resize(coefficients.size() + added, 0.0);
    const int n = static_cast<int>(k.size());
    for (int round = 0; round < 12; ++round) {
      Eigen::MatrixXd jacobian(samples, n);
      Eigen::VectorXd misfit(samples);
      const LatticeLaws laws = split(k, xi, eps, compression);
      for (int i = 0; i < samples; ++i) misfit[i] = uniaxial_load(laws, range * (i + 1) / samples);
      for (int j = 0; j < n; ++j) {
        std::vector<double> moved = k;
        const double change = 1e-5 * coefficients[0] / std::pow(range, j);
        moved[j] += change;
        const LatticeLaws other = split(moved, xi, eps, compression);
        for (int i = 0; i < samples; ++i) {
          const double e = range * (i + 1) / samples;
          jacobian(i, j) = (uniaxial_load(other, e) - misfit[i]) / change / value(coefficients, e);
        }
      }
      for (int i = 0; i < samples; ++i)
        misfit[i] = misfit[i] / value(coefficients, range * (i + 1) / samples) - 1;
      // Columns differ by powers of the strain: scale them before the solve.
      const Eigen::VectorXd scale = jacobian.colwise().norm();
      for (int j = 0; j < n; ++j) jacobian.col(j) /= scale[j];
      const Eigen::VectorXd change = jacobian.colPivHouseholderQr().solve(misfit);
      for (int j = 0; j < n; ++j) k[j] -= change[j] / scale[j];
    }
    const LatticeLaws laws = split(k, xi, eps, compression);
    const double error = largest_error(laws, coefficients, range);
    if (error <= tolerance) return laws;
    best = added == 0 ? error : std::min(best, error);
  }
  throw Error(
      ExitCode::bad_data,
      fmt::format("no lattice returns the cloth's curve up to strain {:.3g}: {:.2g} % off at best; lower "
                  "the tested strain or the shear fraction",
                  range, 100 * best));
}

// A small strain of the cell, diagonals of stiffness k = K xi/2 and width w, L^2 = a^2 + b^2:
//   C_xx = (1 - xi) K f_x + 2 w k a^3 / (b L^3),   C_xy = C_gg = 2 w k a b / L^3
// The square lattice has C_xy = B K with B = xi / (2 sqrt2) and C_xx = (1 - xi + B) K. Hence w, and the axial
// factor f_x = 1 + B (1 - s a^2/b^2) / (1 - xi - eps), where s <= 1 keeps it positive in slivers.
CellWidths cell_widths(double h_row, double h_column, double xi, double eps) {
  constexpr double least = 0.1;  // of the axial width
  const double a = h_row, b = h_column;
  const double coupling = xi / (2 * std::numbers::sqrt2) / (1 - xi - eps);
  const double aspect = std::max(a / b, b / a);
  const double cut = coupling > 0 ? std::min(1.0, (1 + (1 - least) / coupling) / (aspect * aspect)) : 1.0;
  const auto factor = [&](double ratio) { return 1 + coupling * (1 - cut * ratio * ratio); };
  const double diagonal = std::hypot(a, b);
  CellWidths widths;
  widths.along_row = 0.5 * b * factor(a / b);
  widths.along_column = 0.5 * a * factor(b / a);
  widths.shear = cut * diagonal * diagonal * diagonal / (2 * std::numbers::sqrt2 * a * b);
  widths.bend_row = 0.25 * b;
  widths.bend_column = 0.25 * a;
  return widths;
}

}  // namespace ripstop

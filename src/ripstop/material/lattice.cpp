#include "ripstop/material/lattice.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/core/error.h"

namespace ripstop::inline material {
namespace {

constexpr double tolerance = 1e-3;      // of the returned curve, relative
constexpr double unknown_strain = 0.1;  // range of the fit if the material does not give it
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
      throw Error(ExitCode::bad_data, fmt::format("the curve of the cloth is not positive at strain {:.3g}, "
                                                  "within the tested range of {:.3g}; check its coefficients",
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
      fmt::format(
          "no lattice reproduces the curve of the cloth up to strain {:.3g}: smallest error {:.2g} %; lower "
          "the tested strain or the shear fraction",
          range, 100 * best));
}

// As lattice_resultants(), with a law for each yarn.
Resultants woven_resultants(const WovenLaws& laws, double strain_warp, double strain_weft) {
  const double a = 1 + strain_warp, b = 1 + strain_weft;
  const double s = std::sqrt(0.5 * (a * a + b * b));
  const double shear = std::numbers::sqrt2 * laws.shear.tension(s - 1) / s;
  return {laws.warp.tension(strain_warp) + 2 * laws.warp_bending.tension(strain_warp) + shear * a,
          laws.weft.tension(strain_weft) + 2 * laws.weft_bending.tension(strain_weft) + shear * b};
}

namespace {

/// Strain of the other yarns that leaves them without load.
double strain_across(const WovenLaws& laws, double strain, bool along_weft) {
  double low = -0.9, high = std::max(0.0, strain);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const double across = along_weft ? woven_resultants(laws, middle, strain).along
                                     : woven_resultants(laws, strain, middle).across;
    (across > 0 ? high : low) = middle;
  }
  return high;
}

/// Coefficients whose law takes `wanted` at `strains`, relative errors weighed alike.
std::vector<double> relative_fit(const std::vector<double>& strains, const std::vector<double>& wanted,
                                 const std::vector<double>& scale, int degree) {
  const auto rows = static_cast<Eigen::Index>(strains.size());
  Eigen::MatrixXd a(rows, degree);
  Eigen::VectorXd b(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    b[i] = wanted[i] / scale[i];
    for (Eigen::Index j = 0; j < degree; ++j)
      a(i, j) = std::pow(strains[i] / strains.back(), static_cast<double>(j + 1)) / scale[i];
  }
  const Eigen::VectorXd c = a.colPivHouseholderQr().solve(b);
  std::vector<double> k(degree);
  for (int j = 0; j < degree; ++j) k[j] = c[j] / std::pow(strains.back(), j + 1);
  return k;
}

}  // namespace

double woven_uniaxial_load(const WovenLaws& laws, double strain, bool along_weft) {
  const double other = strain_across(laws, strain, along_weft);
  return along_weft ? woven_resultants(laws, other, strain).across
                    : woven_resultants(laws, strain, other).along;
}

namespace {

/// From K' of warp and weft; the diagonals carry the mean of both.
WovenLaws laws_of_yarns(const std::vector<double> (&k)[2], const Fabric& fabric) {
  const double xi = fabric.shear_fraction, eps = fabric.bending_fraction;
  const SpringLaw warp{k[0], fabric.compression}, weft{k[1], fabric.compression};
  SpringLaw shear = warp;
  for (std::size_t j = 0; j < shear.coefficients.size(); ++j)
    shear.coefficients[j] = 0.5 * (k[0][j] + k[1][j]);
  return {warp.scaled(1 - xi - eps), weft.scaled(1 - xi - eps), shear.scaled(xi / 2), warp.scaled(eps / 2),
          weft.scaled(eps / 2)};
}

/// K' of a yarn: the load of the diagonals under the present laws is subtracted from the measured curve, and
/// the law of the yarn is fitted to the rest, (1 - xi) K'.
std::vector<double> refitted_yarn(const std::vector<double>& k, const std::vector<double>& curve,
                                  const WovenLaws& laws, bool along_weft, const std::vector<double>& strains,
                                  const Fabric& fabric) {
  const double axial = 1 - fabric.shear_fraction;
  std::vector<double> wanted, scale;
  for (double e : strains) {
    const double load = value(curve, e);
    const double diagonals =
        woven_uniaxial_load(laws, e, along_weft) - axial * SpringLaw{k, fabric.compression}.tension(e);
    wanted.push_back((load - diagonals) / axial);
    scale.push_back(load);
  }
  return relative_fit(strains, wanted, scale, static_cast<int>(k.size()));
}

// Alternates between the laws of the yarns and the load of the diagonals. The diagonals carry a tenth, so a
// few iterations suffice.
WovenLaws taut_laws(const Fabric& fabric) {
  const double xi = fabric.shear_fraction, eps = fabric.bending_fraction;
  if (fabric.weft_coefficients_n_m.empty()) {
    const LatticeLaws laws =
        lattice_laws(fabric.coefficients_n_m, xi, eps, fabric.compression, fabric.tested_strain);
    return {laws.axial, laws.axial, laws.shear, laws.bending, laws.bending};
  }
  const std::vector<double>* curves[2] = {&fabric.coefficients_n_m, &fabric.weft_coefficients_n_m};
  std::vector<double> k[2];
  // Also checks xi, eps and both curves; the start of the rounds.
  for (int yarn : {0, 1})
    k[yarn] =
        lattice_laws(*curves[yarn], 0, eps, fabric.compression, fabric.tested_strain).axial.coefficients;
  for (int yarn : {0, 1})
    for (double& c : k[yarn]) c /= 1 - eps;
  const double range = fabric.tested_strain > 0 ? fabric.tested_strain : unknown_strain;
  std::vector<double> strains;
  for (int i = 1; i <= samples; ++i) strains.push_back(range * i / samples);

  const std::size_t measured = std::max(curves[0]->size(), curves[1]->size());
  double best = 0;
  for (int added = 0; added <= added_degrees; ++added) {
    const std::size_t degree = std::max({measured + added, k[0].size(), k[1].size()});
    for (auto& c : k) c.resize(degree, 0.0);
    for (int round = 0; round < 40; ++round) {
      const WovenLaws laws = laws_of_yarns(k, fabric);
      for (int yarn : {0, 1})
        k[yarn] = refitted_yarn(k[yarn], *curves[yarn], laws, yarn == 1, strains, fabric);
    }
    const WovenLaws laws = laws_of_yarns(k, fabric);
    double error = 0;
    for (double e : strains)
      for (int yarn : {0, 1})
        error =
            std::max(error, std::abs(woven_uniaxial_load(laws, e, yarn == 1) / value(*curves[yarn], e) - 1));
    if (error <= tolerance) return laws;
    best = added == 0 ? error : std::min(best, error);
  }
  throw Error(ExitCode::bad_data,
              fmt::format("no lattice reproduces the warp and weft curves of the cloth up to strain {:.3g}: "
                          "smallest error {:.2g} %; lower the tested strain or the shear fraction",
                          range, 100 * best));
}

}  // namespace

// A pull along a yarn presses the yarns across by a Poisson's ratio's part of its strain, and a coupon is not
// wrinkled by that: the laws are fitted as if nothing buckled.
WovenLaws woven_laws(const Fabric& fabric) {
  WovenLaws laws = taut_laws(fabric);
  if (!fabric.buckling_strain) return laws;
  for (SpringLaw* law : {&laws.warp, &laws.weft, &laws.shear, &laws.warp_bending, &laws.weft_bending})
    law->buckling_strain = *fabric.buckling_strain;
  return laws;
}

// A small strain of the cell, diagonals of stiffness k = K xi/2 and width w, L^2 = a^2 + b^2:
//   C_xx = (1 - xi) K f_x + 2 w k a^3 / (b L^3),   C_xy = C_gg = 2 w k a b / L^3
// The square lattice has C_xy = B K with B = xi / (2 sqrt2) and C_xx = (1 - xi + B) K. Hence w, and the axial
// factor f_x = 1 + B (1 - s a^2/b^2) / (1 - xi - eps), where s <= 1 keeps it positive in slivers.
CellWidths cell_widths(double h_row, double h_column, const WovenLaws& laws) {
  constexpr double least = 0.1;  // of the axial width
  const double a = h_row, b = h_column;
  const auto coupling = [&](const SpringLaw& axial) {
    return laws.shear.tangent(0) / (std::numbers::sqrt2 * axial.tangent(0));
  };
  const double along_row = coupling(laws.weft), along_column = coupling(laws.warp);
  // The longer side's axial springs lose most.
  const double aspect = std::max(a / b, b / a), strained = a > b ? along_row : along_column;
  const double s = strained > 0 ? std::min(1.0, (1 + (1 - least) / strained) / (aspect * aspect)) : 1.0;
  const auto factor = [&](double share, double ratio) { return 1 + share * (1 - s * ratio * ratio); };
  const double diagonal = std::hypot(a, b);
  CellWidths widths;
  widths.along_row = 0.5 * b * factor(along_row, a / b);
  widths.along_column = 0.5 * a * factor(along_column, b / a);
  widths.shear = s * diagonal * diagonal * diagonal / (2 * std::numbers::sqrt2 * a * b);
  widths.bend_row = 0.25 * b;
  widths.bend_column = 0.25 * a;
  return widths;
}

WovenLaws exchanged(const WovenLaws& laws) {
  return {laws.weft, laws.warp, laws.shear, laws.weft_bending, laws.warp_bending};
}

SpringLaw whole_yarn(const SpringLaw& axial, const SpringLaw& bending) {
  SpringLaw whole = axial;
  whole.coefficients.resize(std::max(axial.coefficients.size(), bending.coefficients.size()), 0.0);
  for (std::size_t k = 0; k < bending.coefficients.size(); ++k)
    whole.coefficients[k] += 2 * bending.coefficients[k];
  return whole;
}

// With Y the mean stiffness of the yarns, S = sqrt2 K_sh that of the shear springs and L^2 = a^2 + b^2, the
// cloth turned by 45 deg has C_xy = C_gg = Y/2, C_xx = C_yy = S + Y/2. Diagonals of width w give w Y 2 a
// b/L^3 and, along the row, a^2/b^2 times that. Hence w = L^3/(4 a b) and S_x = S + Y/2 (1 - s a^2/b^2),
// where s <= 1 (a factor of w too) keeps it positive.
CellWidths bias_widths(double h_row, double h_column, const WovenLaws& laws) {
  constexpr double least = 0.1;  // of the shear springs' width
  const double a = h_row, b = h_column;
  const double yarn = 0.5 * (whole_yarn(laws.warp, laws.warp_bending).tangent(0) +
                             whole_yarn(laws.weft, laws.weft_bending).tangent(0));
  const double shear = std::numbers::sqrt2 * laws.shear.tangent(0);
  const double aspect = std::max(a / b, b / a), share = shear > 0 ? 0.5 * yarn / shear : 0;
  const double s = std::min(1.0, (1 + (share > 0 ? (1 - least) / share : 0)) / (aspect * aspect));
  const auto factor = [&](double ratio) { return 1 + share * (1 - s * ratio * ratio); };
  const double diagonal = std::hypot(a, b);
  CellWidths widths;
  widths.along_row = b / std::numbers::sqrt2 * factor(a / b);
  widths.along_column = a / std::numbers::sqrt2 * factor(b / a);
  widths.shear = s * diagonal * diagonal * diagonal / (4 * a * b);
  return widths;
}

// xi/2 over sqrt2 (1 - xi - eps) is the result of the coupling of the laws for any K.
CellWidths cell_widths(double h_row, double h_column, double xi, double eps) {
  const SpringLaw axial{{1 - xi - eps}, 1}, shear{{xi / 2}, 1};
  return cell_widths(h_row, h_column, WovenLaws{axial, axial, shear, {}, {}});
}

}  // namespace ripstop::inline material

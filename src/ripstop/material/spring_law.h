// The tension of one spring family as a function of its strain, [NFM] Eq. 2.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

namespace ripstop::inline material {

/// T(e) = sum_k K_k e^k for e >= 0 and T(e) = compression * K_1 max(e, -buckling_strain) for e < 0, with k = 1..n.
/// The printed polynomial is fitted to tensile tests only; its higher terms are not known for e < 0 and are omitted
/// there. Cloth compressed beyond its buckling strain wrinkles and carries no more load in that direction; the load
/// acts along the wrinkles, a tension field (docs/theory/cloth.md). Units are those of the coefficients: N/m for
/// cloth and tape (times a width gives N), N for lines.
struct SpringLaw {
  std::vector<double> coefficients;  // K_1 .. K_n
  double compression = 1;            // 0: tension only, 1: as stiff as the first pull
  double buckling_strain = std::numeric_limits<double>::infinity();  // >= 0; infinite: never

  inline double tension(double strain) const;
  inline double tangent(double strain) const;  // dT/de
  double energy(double strain) const;          // integral of T from 0 to e
  SpringLaw scaled(double factor) const;
  SpringLaw linearised() const;  // keeps K_1 only: the paper's "linear model"
};

double SpringLaw::tension(double strain) const {
  if (coefficients.empty()) return 0;
  if (strain < 0) return compression * coefficients[0] * std::max(strain, -buckling_strain);
  double sum = 0;
  for (auto k = coefficients.rbegin(); k != coefficients.rend(); ++k) sum = (sum + *k) * strain;
  return sum;
}

double SpringLaw::tangent(double strain) const {
  if (coefficients.empty()) return 0;
  if (strain < -buckling_strain) return 0;
  if (strain < 0) return compression * coefficients[0];
  double sum = 0;
  for (auto k = coefficients.size(); k > 0; --k)
    sum = sum * strain + static_cast<double>(k) * coefficients[k - 1];
  return sum;
}

}  // namespace ripstop::inline material

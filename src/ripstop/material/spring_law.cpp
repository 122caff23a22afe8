#include "ripstop/material/spring_law.h"

#include <algorithm>

namespace ripstop::inline material {

double SpringLaw::energy(double strain) const {
  if (coefficients.empty()) return 0;
  if (strain < 0) {
    const double elastic = std::max(strain, -buckling_strain);
    return compression * coefficients[0] * elastic * (strain - 0.5 * elastic);
  }
  double sum = 0;
  for (auto k = coefficients.size(); k > 0; --k)
    sum = (sum + coefficients[k - 1] / static_cast<double>(k + 1)) * strain;
  return sum * strain;
}

SpringLaw SpringLaw::scaled(double factor) const {
  SpringLaw law = *this;
  for (double& k : law.coefficients) k *= factor;
  return law;
}

SpringLaw SpringLaw::linearised() const {
  SpringLaw law = *this;
  if (!law.coefficients.empty()) law.coefficients = {law.coefficients.front()};
  return law;
}

}  // namespace ripstop::inline material

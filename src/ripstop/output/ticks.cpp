#include "ripstop/output/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ripstop::inline output {

std::vector<double> ticks(double low, double high, int count) {
  const double rough = (high - low) / count, power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (double factor : {1., 2., 5.}) {
    if (factor * power >= rough * (1 - 1e-9)) {
      step = factor * power;
      break;
    }
  }
  std::vector<double> values;
  // Multiples of the step, with room for rounding at the ends. + 0.0 turns -0 into 0.
  for (double i = std::ceil(low / step - 1e-9); i <= high / step + 1e-9; ++i)
    values.push_back(i * step + 0.0);
  return values;
}

std::vector<double> logarithmic_ticks(double low, double high, int count) {
  const double first = std::ceil(std::log10(low) - 1e-9), last = std::floor(std::log10(high) + 1e-9);
  const double stride = std::max(1.0, std::ceil((last - first + 1) / count));
  std::vector<double> values;
  for (double exponent = first; exponent <= last; exponent += stride)
    values.push_back(std::pow(10, exponent));
  return values;
}

std::string tick_label(double value, double step) {
  const double size = std::max(std::abs(value), std::abs(step));
  if (size != 0 && (size >= 1e6 || size < 1e-3)) return fmt::format("{:.4g}", value);
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  return fmt::format("{:.{}f}", value, decimals);
}

}  // namespace ripstop::inline output

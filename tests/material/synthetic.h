// Synthetic bench records from a known curve: slack, load cell noise, sample scatter, a drop at failure.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace ripstop {

struct SyntheticRecord {
  std::function<double(double strain)> load;  // true mean curve [N/m], or [N] with width 0
  double length = 0.2, width = 0.05;          // [m]
  int orientation = 0;
  double failure_strain = 0.33;
  double scatter = 0.03;          // standard deviation of a sample's stiffness, relative
  double failure_scatter = 0.05;  // of its failure strain, relative
  double noise = 0.003;           // of the force, part of its peak; correlated over a few points
  double slack = 0.002;           // [m], give or take a half
  double offset = 0;              // of the load cell [N]
  int points = 400;
};

/// CSV text of one sample. The noise is an AR(1) process: neighbours err together, as on a bench.
inline std::string synthetic_csv(const SyntheticRecord& wanted, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.5, 1.5);
  const double factor = 1 + wanted.scatter * normal(random);
  const double failure = wanted.failure_strain * (1 + wanted.failure_scatter * normal(random));
  const double slack = wanted.slack * uniform(random);
  const double per = wanted.width > 0 ? wanted.width : 1;
  const double peak = factor * wanted.load(failure) * per;
  const int points = static_cast<int>(wanted.points * uniform(random));
  const double travel = (slack + 1.05 * failure * wanted.length) * 1e3;  // [mm]
  std::string text = fmt::format(
      "# synthetic record: not a measurement\n# length: {} mm\n{}# orientation: {} deg\n"
      "extension [mm],force [N]\n",
      1e3 * wanted.length, wanted.width > 0 ? fmt::format("# width: {} mm\n", 1e3 * wanted.width) : "",
      wanted.orientation);
  constexpr double memory = 0.8;
  double error = normal(random);
  for (int i = 0; i <= points; ++i) {
    const double x = travel * i / points;
    const double strain = (1e-3 * x - slack) / wanted.length;
    double force = strain <= 0 ? 0 : factor * wanted.load(strain) * per;
    if (strain > failure) force = 0.2 * peak;
    error = memory * error + std::sqrt(1 - memory * memory) * normal(random);
    text += fmt::format("{:.6f},{:.6f}\n", x, force + wanted.offset + wanted.noise * peak * error);
  }
  return text;
}

}  // namespace ripstop

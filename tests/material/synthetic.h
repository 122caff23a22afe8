// Synthetic bench records from a known curve: slack, load cell noise, sample scatter, a drop at failure.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "ripstop/material/record.h"

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

/// One sample as a reader gives it. The noise is an AR(1) process: neighbours err together, as on a bench. Values have the
/// six decimals of synthetic_csv().
inline TensileRecord synthetic_record(const SyntheticRecord& wanted, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.5, 1.5);
  const double factor = 1 + wanted.scatter * normal(random);
  const double failure = wanted.failure_strain * (1 + wanted.failure_scatter * normal(random));
  const double slack = wanted.slack * uniform(random);
  const double per = wanted.width > 0 ? wanted.width : 1;
  const double peak = factor * wanted.load(failure) * per;
  const int points = static_cast<int>(wanted.points * uniform(random));
  const double travel = (slack + 1.05 * failure * wanted.length) * 1e3;  // [mm]
  const auto six_decimals = [](double value) { return std::round(1e6 * value) / 1e6; };
  TensileRecord record;
  record.file = "s.csv";
  record.coupon = {wanted.length, wanted.width, static_cast<double>(wanted.orientation)};
  constexpr double memory = 0.8;
  double error = normal(random);
  for (int i = 0; i <= points; ++i) {
    const double x = travel * i / points;
    const double strain = (1e-3 * x - slack) / wanted.length;
    double force = strain <= 0 ? 0 : factor * wanted.load(strain) * per;
    if (strain > failure) force = 0.2 * peak;
    error = memory * error + std::sqrt(1 - memory * memory) * normal(random);
    record.displacement.push_back(1e-3 * six_decimals(x));
    record.force.push_back(six_decimals(force + wanted.offset + wanted.noise * peak * error));
    record.line.push_back(i + (wanted.width > 0 ? 6 : 5));  // below the heading of synthetic_csv()
  }
  return record;
}

/// The same sample as CSV text.
inline std::string synthetic_csv(const SyntheticRecord& wanted, std::mt19937& random) {
  const TensileRecord record = synthetic_record(wanted, random);
  std::string text = fmt::format(
      "# synthetic record: not a measurement\n# length: {} mm\n{}# orientation: {} deg\n"
      "extension [mm],force [N]\n",
      1e3 * wanted.length, wanted.width > 0 ? fmt::format("# width: {} mm\n", 1e3 * wanted.width) : "",
      wanted.orientation);
  for (std::size_t i = 0; i < record.force.size(); ++i)
    text += fmt::format("{:.6f},{:.6f}\n", 1e3 * record.displacement[i], record.force[i]);
  return text;
}

}  // namespace ripstop

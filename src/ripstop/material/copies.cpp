#include "ripstop/material/copies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace ripstop::inline material {
namespace {

constexpr std::size_t fewest = 48;  // points in common
constexpr std::size_t most = 240;
constexpr double likely_copied = 0.3;
constexpr double least_noise = 1e-9;  // of the highest load: rounding
constexpr double same_steps = 0.1;    // of coarsely rounded records; pulls without any noise have 0.2

/// A record over the displacement of its clamp from its first row [m].
struct Trace {
  std::vector<double> x;
  std::span<const double> f;
  double start = 0;     // of the pull
  bool coarse = false;  // its loads are rounded to steps that hide the noise

  explicit Trace(const CleanRecord& record);
  double spacing() const { return (x.back() - x.front()) / static_cast<double>(x.size() - 1); }
};

/// Median size of the fourth differences; 0 of fewer than five values.
double roughness(std::span<const double> f) {
  std::vector<double> fourth;
  for (std::size_t i = 2; i + 2 < f.size(); ++i)
    fourth.push_back(std::abs(f[i - 2] - 4 * f[i - 1] + 6 * f[i] - 4 * f[i + 1] + f[i + 2]));
  if (fourth.empty()) return 0;
  const auto middle = fourth.begin() + static_cast<std::ptrdiff_t>(fourth.size() / 2);
  std::nth_element(fourth.begin(), middle, fourth.end());
  return *middle;
}

/// The step to which loads are rounded; 0: none is seen. Nine tenths of the differences between neighbouring levels
/// must
/// be whole multiples of it.
double resolution(std::span<const double> f) {
  std::vector<double> levels(f.begin(), f.end()), gaps;
  std::sort(levels.begin(), levels.end());
  for (std::size_t i = 1; i < levels.size(); ++i)
    if (const double gap = levels[i] - levels[i - 1]; gap > 1e-7 * std::abs(levels.back()))
      gaps.push_back(gap);
  if (gaps.empty()) return 0;
  const auto low = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 20);
  std::nth_element(gaps.begin(), low, gaps.end());
  const double step = *low;
  const auto whole = std::count_if(gaps.begin(), gaps.end(), [&](double gap) {
    return std::abs(gap / step - std::round(gap / step)) < 0.02;
  });
  return 10 * whole >= 9 * static_cast<std::ptrdiff_t>(gaps.size()) ? step : 0;
}

/// Mean size of the fourth differences. Unlike the median, it is not 0 for values that are rounded to coarse
/// steps.
double mean_roughness(std::span<const double> f) {
  double sum = 0;
  for (std::size_t i = 2; i + 2 < f.size(); ++i)
    sum += std::abs(f[i - 2] - 4 * f[i - 1] + 6 * f[i] - 4 * f[i + 1] + f[i + 2]);
  return f.size() > 4 ? sum / static_cast<double>(f.size() - 4) : 0.0;
}

Trace::Trace(const CleanRecord& record) : f(record.load), start(record.slack) {
  for (double strain : record.strain) x.push_back(record.slack + strain * record.length);
  // Fourth differences of white noise s have the standard deviation sqrt(70) s, and half of them are within 0.6745
  // of it.
  coarse = roughness(f) / (0.6745 * std::sqrt(70.0)) < resolution(f);
}

/// Roughness of b minus its best multiple of a, which is read where b has points: at x of a = scale x of b + shift.
/// The result is relative to the roughness of b there, or to that of a scaled to the same size, whichever is less.
double ratio(const Trace& a, const Trace& b, double scale, double shift) {
  const std::size_t skip = b.x.size() > most ? (b.x.size() - most) / 2 : 0;
  std::vector<double> of_a, of_b;
  std::size_t k = 0;
  for (std::size_t i = skip; i < std::min(b.x.size(), skip + most); ++i) {
    const double x = scale * b.x[i] + shift;
    if (x < a.x.front() || x > a.x.back()) continue;
    while (k + 2 < a.x.size() && a.x[k + 1] < x) ++k;
    const double part = a.x[k + 1] > a.x[k] ? (x - a.x[k]) / (a.x[k + 1] - a.x[k]) : 0.0;
    of_a.push_back(a.f[k] + part * (a.f[k + 1] - a.f[k]));
    of_b.push_back(b.f[i]);
  }
  if (of_b.size() < fewest) return 1;
  double ab = 0, aa = 0;
  for (std::size_t i = 0; i < of_b.size(); ++i) ab += of_a[i] * of_b[i], aa += of_a[i] * of_a[i];
  const double factor = aa > 0 ? ab / aa : 0;
  std::vector<double> left = of_b;
  for (std::size_t i = 0; i < left.size(); ++i) left[i] -= factor * of_a[i];
  const auto rough = a.coarse || b.coarse ? mean_roughness : roughness;
  const double noise = rough(of_b);
  if (!(noise > least_noise * b.f.back())) return 1;
  return rough(left) / noise;
}

/// Least ratio over shifts about `shift` by a few points either way.
double best_ratio(const Trace& a, const Trace& b, double scale, double shift) {
  double step = 0.125 * std::min(a.spacing(), b.spacing());
  double best = shift, least = ratio(a, b, scale, shift);
  constexpr int reach = 48, refinements = 4;
  for (int round = 0; round <= refinements; ++round, step *= 0.25) {
    const double centre = best;
    const int steps = round == 0 ? reach : 4;
    for (int i = -steps; i <= steps; ++i) {
      const double found = ratio(a, b, scale, centre + i * step);
      if (found < least) least = found, best = centre + i * step;
    }
  }
  return least;
}

}  // namespace

double own_noise(const CleanRecord& a, const CleanRecord& b) {
  if (a.strain.size() < fewest || b.strain.size() < fewest) return 1;
  const Trace one(a), other(b);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : {std::pair{&one, &other}, std::pair{&other, &one}}) {
    const double stretch = (from->x.back() - from->start) / (to->x.back() - to->start);
    least = std::min({least, best_ratio(*from, *to, 1, 0), best_ratio(*from, *to, 1, from->start - to->start),
                      best_ratio(*from, *to, stretch, from->start - stretch * to->start)});
  }
  // The steps of rounding are alike in all pulls of a cloth: only records that are the same step by step are copies.
  if (one.coarse || other.coarse) return least < same_steps ? least : 1.0;
  return least;
}

std::vector<Copy> find_copies(const std::vector<CleanRecord>& records) {
  std::vector<Copy> copies;
  for (std::size_t i = 0; i < records.size(); ++i)
    for (std::size_t j = i + 1; j < records.size(); ++j)
      if (const double own = own_noise(records[i], records[j]); own < likely_copied)
        copies.push_back({i, j, own});
  return copies;
}

}  // namespace ripstop::inline material

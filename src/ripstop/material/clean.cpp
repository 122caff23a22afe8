#include "ripstop/material/clean.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <queue>
#include <span>

#include "ripstop/core/error.h"
#include "ripstop/core/least_squares.h"

namespace ripstop::inline material {
namespace {

constexpr std::size_t fewest_points = 12;
constexpr double most_out_of_order = 0.05;  // share of the points
constexpr double toe_part = 0.3;            // of the peak force
constexpr std::size_t fewest_toe_points = 12;
constexpr int most_toe_terms = 4;  // of the curve that finds the start
constexpr int points_per_toe_term = 4;
constexpr double clear_of_noise = 8;     // standard deviations; the range of a thousand points is 7
constexpr double least_slip = 0.02;      // of the peak force
constexpr double least_strain = 0.0025;  // at failure; stiff aramid fails at 2 %
constexpr double most_strain = 3.5;      // at failure; a bias pull of loose cloth reaches 1

struct Pull {
  const TensileRecord& record;
  std::vector<double> x{}, f{};
  std::vector<int> line{};
  CleanRecord clean{};

  [[noreturn]] void refuse(int at_line, const std::string& reason) const {
    throw Error(ExitCode::bad_data, fmt::format("{}:{}: {}", record.file.string(), at_line, reason));
  }
  void say(std::string text) { clean.trimmed.push_back(std::move(text)); }

  void keep(std::size_t begin, std::size_t end) {
    x.assign(x.begin() + static_cast<std::ptrdiff_t>(begin), x.begin() + static_cast<std::ptrdiff_t>(end));
    f.assign(f.begin() + static_cast<std::ptrdiff_t>(begin), f.begin() + static_cast<std::ptrdiff_t>(end));
    line.assign(line.begin() + static_cast<std::ptrdiff_t>(begin),
                line.begin() + static_cast<std::ptrdiff_t>(end));
  }
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Running median of five, so that single spikes set neither the peak nor the start.
std::vector<double> smoothed(const std::vector<double>& f) {
  std::vector<double> result = f;
  for (std::size_t i = 2; i + 2 < f.size(); ++i) {
    std::array<double, 5> window{f[i - 2], f[i - 1], f[i], f[i + 1], f[i + 2]};
    std::nth_element(window.begin(), window.begin() + 2, window.end());
    result[i] = window[2];
  }
  return result;
}

/// From second differences, which a smooth curve hardly has: the median of |N(0, s)| is 0.6745 s.
double noise_of(const std::vector<double>& f) {
  std::vector<double> second;
  for (std::size_t i = 1; i + 1 < f.size(); ++i) second.push_back(std::abs(f[i - 1] - 2 * f[i] + f[i + 1]));
  return median(second) / (0.6745 * std::sqrt(6.0));
}

/// Points that must move to bring the rest in order: all but the longest rising run of points.
std::vector<std::size_t> out_of_order(const std::vector<double>& key) {
  std::vector<std::size_t> last, before(key.size());  // end of the best run of each length, and its chain
  for (std::size_t i = 0; i < key.size(); ++i) {
    const auto place = std::upper_bound(last.begin(), last.end(), key[i],
                                        [&](double value, std::size_t j) { return value < key[j]; });
    before[i] = place == last.begin() ? i : *(place - 1);
    if (place == last.end())
      last.push_back(i);
    else
      *place = i;
  }
  std::vector<char> stays(key.size(), 0);
  std::size_t i = last.back();
  for (std::size_t left = last.size(); left > 0; --left) stays[i] = 1, i = before[i];
  std::vector<std::size_t> moved;
  for (std::size_t j = 0; j < key.size(); ++j)
    if (!stays[j]) moved.push_back(j);
  return moved;
}

void sort_by_order(Pull& pull) {
  const TensileRecord& r = pull.record;
  const std::vector<double>& key = r.time.empty() ? r.displacement : r.time;
  // The furthest displacement so far, but for as many points as may be astray; a noisy transducer is forgiven
  // half a percent of the range.
  const auto [low, high] = std::minmax_element(key.begin(), key.end());
  const double clearly = 0.005 * (*high - *low);
  const auto allowed = static_cast<std::size_t>(most_out_of_order * static_cast<double>(key.size()));
  std::priority_queue<double, std::vector<double>, std::greater<>> furthest;
  std::size_t behind = 0, first_behind = 0;
  for (std::size_t i = 0; i < key.size(); ++i) {
    if (furthest.size() > allowed && key[i] < furthest.top() - clearly && behind++ == 0) first_behind = i;
    furthest.push(key[i]);
    if (furthest.size() > allowed + 1) furthest.pop();
  }
  if (behind > allowed)
    pull.refuse(r.line[first_behind],
                fmt::format("from here {} of {} points decrease in {}: not a single test to failure (a "
                            "cycle?); reduce the record to one test",
                            behind, key.size(), r.time.empty() ? "displacement" : "time"));
  std::vector<std::size_t> order(r.force.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key[a] < key[b]; });
  for (std::size_t i : order) {
    pull.x.push_back(r.displacement[i]);
    pull.f.push_back(r.force[i]);
    pull.line.push_back(r.line[i]);
  }
  const std::vector<std::size_t> moved = out_of_order(key);
  if (!moved.empty())
    pull.say(fmt::format("{} points sorted (first in line {})", moved.size(), r.line[moved.front()]));
}

/// A steady increase that continues a hundred times higher from one point to the next is not physical.
void check_jumps(const Pull& pull, double peak) {
  constexpr std::size_t before = 5;
  for (std::size_t i = before; i + 2 < pull.f.size(); ++i) {
    bool rises = pull.f[i - before] > 0;
    for (std::size_t k = i - before; k + 1 < i; ++k) rises = rises && pull.f[k + 1] > pull.f[k];
    const double after = std::min(pull.f[i], pull.f[i + 1]);
    if (rises && after > 0.02 * peak && after > 100 * pull.f[i - 1])
      pull.refuse(
          pull.line[i],
          fmt::format(
              "the force jumps permanently from {:.4g} N to {:.4g} N: check for mixed units in one column",
              pull.f[i - 1], pull.f[i]));
  }
}

/// A fall of the force that is taken back.
struct Fall {
  std::size_t trough = 0;
  double from = 0, to = 0;
};

/// Standard deviation of the force about its neighbours a fortieth of the points away, so that errors which neighbours
/// share count too.
double wide_noise_of(const std::vector<double>& f) {
  const std::size_t reach = std::clamp<std::size_t>(f.size() / 40, 1, 10);
  std::vector<double> second;
  for (std::size_t i = reach; i + reach < f.size(); ++i)
    second.push_back(std::abs(f[i - reach] - 2 * f[i] + f[i + reach]));
  return median(second) / (0.6745 * std::sqrt(6.0));
}

/// Drops of the force that exceed the noise, each followed by a recovery of at least half of it: broken yarns
/// do not carry their load again, a slipped grip does.
std::vector<Fall> falls_of(const std::vector<double>& smooth, double clear) {
  std::vector<Fall> falls;
  double top = smooth.front();
  std::size_t trough = 0;
  for (std::size_t i = 0; i < smooth.size(); ++i) {
    if (smooth[i] < smooth[trough]) trough = i;
    const double fall = top - smooth[trough];
    const bool taken_back = fall >= clear && smooth[i] - smooth[trough] >= std::max(clear, 0.5 * fall);
    if (taken_back) falls.push_back({trough, top, smooth[trough]});
    if (taken_back || smooth[i] > top) top = smooth[i], trough = i;
  }
  return falls;
}

/// Plateau of the force between two intervals of the same length in which it clearly rises. Index of the
/// middle of the flattest such interval.
std::optional<std::size_t> plateau_of(const Pull& pull, std::size_t peak, double clear) {
  constexpr double still = 0.15;  // of the smaller of both rises; the knee of a nylon has a third
  std::optional<std::size_t> found;
  double flattest = still;
  for (std::size_t window = std::max<std::size_t>(6, peak / 48); 3 * window <= peak; window += window / 2) {
    const std::size_t half = std::max<std::size_t>(1, window / 6);
    const auto level = [&](std::size_t i) { return mean(std::span(pull.f).subspan(i - half, 2 * half + 1)); };
    for (std::size_t i = half; i + 3 * window + half <= peak; i += half) {
      const double a = level(i), b = level(i + window), c = level(i + 2 * window), d = level(i + 3 * window);
      const double least = std::min(b - a, d - c);
      if (least < clear || c - b >= flattest * least) continue;
      flattest = (c - b) / least;
      found = i + window + window / 2;
    }
  }
  return found;
}

/// Description of the traces of grip slip in the force; empty: none. `strain_of` an index.
std::string slip_of(const Pull& pull, const std::function<double(std::size_t)>& strain_of) {
  const std::vector<double> smooth = smoothed(pull.f);
  const auto peak = static_cast<std::size_t>(std::max_element(smooth.begin(), smooth.end()) - smooth.begin());
  const double clear = std::max(clear_of_noise * wide_noise_of(pull.f), least_slip * smooth[peak]);
  const std::vector<Fall> falls = falls_of(smooth, clear);
  if (!falls.empty()) {
    const Fall& worst = *std::max_element(falls.begin(), falls.end(), [](const Fall& a, const Fall& b) {
      return a.from - a.to < b.from - b.to;
    });
    return fmt::format(
        "the force falls from {:.4g} N to {:.4g} N by strain {:.3g} (line {}) and rises again{}: check for "
        "slip of a grip or broken yarns",
        worst.from, worst.to, strain_of(worst.trough), pull.line[worst.trough],
        falls.size() > 1 ? fmt::format(", the largest of {} drops", falls.size()) : "");
  }
  if (const std::optional<std::size_t> flat = plateau_of(pull, peak, clear))
    return fmt::format(
        "the force remains about {:.4g} N at strain {:.3g} (line {}) and then continues to rise: check for "
        "slip of a grip",
        smooth[*flat], strain_of(*flat), pull.line[*flat]);
  return "";
}

/// Removes the points after the maximum force.
double cut_failure(Pull& pull) {
  const std::vector<double> smooth = smoothed(pull.f);
  const auto top = std::max_element(smooth.begin(), smooth.end());
  const auto peak = static_cast<std::size_t>(top - smooth.begin());
  if (!(*top > 0))
    pull.refuse(pull.line.front(),
                "no force is above 0: tension must be positive; change the sign of the column");
  const double lowest = *std::min_element(smooth.begin(), smooth.end());
  if (-lowest > *top)
    pull.refuse(
        pull.line.front(),
        fmt::format("forces reach {:.4g} N, but only {:.4g} N in tension: change the sign of the column",
                    lowest, *top));
  const std::size_t count = pull.f.size();
  if (peak < fewest_points / 2 || pull.x[peak] - pull.x.front() < 0.05 * (pull.x.back() - pull.x.front()))
    pull.refuse(pull.line[peak],
                fmt::format("the force only decreases from here ({:.4g} N to {:.4g} N): this is not a test "
                            "to failure; check column and direction of the displacement",
                            *top, smooth.back()));
  // A bench that stops by itself still writes some points of the fall.
  constexpr double fallen = 0.9;
  pull.clean.breaks =
      *std::min_element(pull.f.begin() + static_cast<std::ptrdiff_t>(peak), pull.f.end()) < fallen * *top;
  if (peak + 1 < count)
    pull.say(fmt::format("{} points after the peak of {:.4g} N ignored (from line {})", count - peak - 1,
                         *top, pull.line[peak + 1]));
  constexpr double many = 1.0 / 3;  // of the points; a machine that continues after the break writes fewer
  const double after = static_cast<double>(count - peak - 1) / static_cast<double>(count);
  if (after > many)
    pull.clean.late = fmt::format(
        "{:.0f} % of the points follow the highest force ({:.4g} N, line {}): check for several tests in one "
        "record, and for thousands read as decimal numbers",
        100 * after, *top, pull.line[peak]);
  pull.keep(0, peak + 1);
  return *top;
}

/// Squared misfit of a pull that begins at `zero`: nothing before it, sum_k c_k u^k with k = 1 .. terms and c_1 >= 0
/// after it.
double toe_misfit(std::span<const double> x, std::span<const double> f, double zero, int terms) {
  // Plain loops over the lower triangle: this is most of the time of reading a record.
  Eigen::Matrix<double, most_toe_terms, most_toe_terms> sums = decltype(sums)::Zero();
  Eigen::Vector<double, most_toe_terms> of_forces = decltype(of_forces)::Zero(), powers;
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += f[i] * f[i];
    if (x[i] <= zero) continue;
    powers[0] = (x[i] - zero) / (x.back() - zero);
    for (int k = 1; k < terms; ++k) powers[k] = powers[k - 1] * powers[0];
    for (int l = 0; l < terms; ++l) {
      for (int k = l; k < terms; ++k) sums(k, l) += powers[k] * powers[l];
      of_forces[l] += f[i] * powers[l];
    }
  }
  const auto products = sums.topLeftCorner(terms, terms);
  const auto right = of_forces.head(terms);
  const auto solved = [&](int from) {  // c_k from this k on, and their residual
    const int n = terms - from;
    const Eigen::MatrixXd left = products.bottomRightCorner(n, n);
    const Eigen::VectorXd of_right = right.tail(n),
                          c = left.selfadjointView<Eigen::Lower>().ldlt().solve(of_right);
    return std::pair(c[0], sum - c.dot(of_right));
  };
  const auto [c1, misfit] = solved(0);
  return c1 > 0 ? misfit : solved(1).second;
}

/// Displacement where the pull begins; takes the load cell's offset off the forces.
double find_start(Pull& pull, double peak) {
  const double noise = noise_of(pull.f);
  const std::vector<double> smooth = smoothed(pull.f);
  // The offset is read where nothing pulls: before the force leaves the level it starts from.
  const double level =
      median({smooth.begin(),
              smooth.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(smooth.size(), 9))});
  const double threshold = std::max(4 * noise, 0.005 * peak);
  std::size_t start = 0;
  for (std::size_t i = 0; i < smooth.size(); ++i)
    if (smooth[i] < level + threshold) start = i + 1;
  std::size_t idle = 0;  // points that surely lie before the pull
  const double run_up = start < pull.x.size() ? 0.25 * (pull.x[start] - pull.x.front()) : 0.0;
  while (idle < start && pull.x[idle] < pull.x[start] - run_up) ++idle;
  const bool flat = idle >= 10 && std::abs(smooth[idle - 1] - smooth[0]) < 0.5 * threshold;
  double offset = 0;
  if (flat) {
    offset = mean(std::span(pull.f).first(idle));
    if (std::abs(offset) > 3 * noise / std::sqrt(static_cast<double>(idle)))
      pull.say(fmt::format("load cell offset of {:.3g} N subtracted", offset));
    else
      offset = 0;
  }
  for (double& f : pull.f) f -= offset;
  pull.clean.force_offset = offset;

  if (start + fewest_points / 2 > pull.x.size())
    pull.refuse(pull.line.back(), "the force rises only at the very end: no curve can be fitted");
  std::size_t end = start;
  while (end < pull.x.size() && (end < start + fewest_toe_points || smooth[end] - offset < toe_part * peak))
    ++end;
  if (end < start + 3) return pull.x[start];
  const std::span<const double> x(pull.x.data(), end), f(pull.f.data(), end);
  // Slack ends before the first loaded point; a record that starts under load is extrapolated to zero, but no
  // farther than twice the displacement of its initial slope.
  const double slope = (f[end - 1] - f[start]) / (x[end - 1] - x[start]);
  const double reach = slope > 0 ? 2 * std::max(0.0, f[0]) / slope : 0.0;
  const int terms = std::clamp(static_cast<int>(end - start) / points_per_toe_term, 2, most_toe_terms);
  double low = x[0] - reach, high = x[start] + 0.1 * (x[end - 1] - x[start]);
  for (int round = 0; round < 4; ++round) {
    constexpr int tries = 60;
    const double step = (high - low) / tries;
    double best = low, least = toe_misfit(x, f, low, terms);
    for (int i = 1; i <= tries; ++i) {
      const double misfit = toe_misfit(x, f, low + i * step, terms);
      if (misfit < least) least = misfit, best = low + i * step;
    }
    low = best - step, high = best + step;
  }
  return 0.5 * (low + high);
}

}  // namespace

CleanRecord clean_record(const TensileRecord& record, LoadKind kind) {
  Pull pull{record};
  CleanRecord& clean = pull.clean;
  clean.name = record.name();
  clean.orientation = record.coupon.orientation;
  clean.length = record.coupon.length;
  clean.width = record.coupon.width;
  if (kind == LoadKind::per_width && !(clean.width > 0))
    throw Error(
        ExitCode::bad_data,
        fmt::format("{}: no coupon width: write \"# width: 50 mm\" in it or width_m in the campaign file",
                    record.file.string()));
  if (record.force.size() < fewest_points)
    pull.refuse(record.line.back(),
                fmt::format("{} measurements; a curve needs {}", record.force.size(), fewest_points));

  sort_by_order(pull);
  const Pull whole = pull;
  const double peak = cut_failure(pull);
  check_jumps(pull, peak);
  const double start = find_start(pull, peak);
  clean.slack = start - pull.x.front();
  std::size_t slack_points = 0;
  while (slack_points < pull.x.size() && pull.x[slack_points] < start) ++slack_points;
  if (slack_points > 1)
    pull.say(fmt::format("slack of {:.3g} mm subtracted ({} points, up to line {})", 1e3 * clean.slack,
                         slack_points, pull.line[slack_points - 1]));
  pull.keep(slack_points, pull.x.size());
  const double per = kind == LoadKind::per_width ? clean.width : 1.0;
  for (std::size_t i = 0; i < pull.x.size(); ++i) {
    clean.strain.push_back((pull.x[i] - start) / clean.length);
    clean.load.push_back(pull.f[i] / per);
  }
  if (clean.strain.size() < fewest_points / 2)
    pull.refuse(pull.line.empty() ? record.line.back() : pull.line.back(),
                fmt::format("only {} measurements between slack and failure", clean.strain.size()));
  clean.slip = slip_of(whole, [&](std::size_t i) { return (whole.x[i] - start) / clean.length; });
  clean.noise = noise_of(clean.load);
  clean.failure_strain = clean.strain.back();
  clean.failure_load = (peak - clean.force_offset) / per;
  if (clean.failure_strain < least_strain || clean.failure_strain > most_strain)
    pull.refuse(pull.line.back(),
                fmt::format("strain {:.3g} at failure ({:.4g} mm on {:.4g} mm): cloth and line fail between "
                            "{} and {}; check displacement and length for a factor of 1000 (m for mm)",
                            clean.failure_strain, 1e3 * clean.failure_strain * clean.length,
                            1e3 * clean.length, least_strain, most_strain));
  return clean;
}

}  // namespace ripstop::inline material

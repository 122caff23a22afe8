#include "ripstop/calibration/coupon_fit.h"

#include <fmt/format.h>
#include <nlopt.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

#include "ripstop/core/error.h"
#include "ripstop/core/least_squares.h"

namespace ripstop::inline calibration {
namespace {

constexpr double lowest_shear = 0.01;  // without diagonals a bias coupon is a mechanism
constexpr double highest_shear = 0.6, highest_bending = 0.2;
constexpr double prior_weight = 1e-4;  // in units of 1 - R2
constexpr double prior_width = 0.1;    // of eps
constexpr double cannot = 10;          // misfit of a lattice that cannot be made

double value_at(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto above = static_cast<std::size_t>(std::lower_bound(x.begin(), x.end(), at) - x.begin());
  const std::size_t b = std::clamp<std::size_t>(above, 1, x.size() - 1), a = b - 1;
  return y[a] + (at - x[a]) / (x[b] - x[a]) * (y[b] - y[a]);
}

/// One direction's coupon, and the strains where it is compared.
struct Target {
  const DirectionFit* direction;
  CouponShape shape;
  std::vector<double> strain, measured;
  std::vector<std::vector<Vec3>> guess;
};

std::vector<Target> targets_of(const MaterialFit& fit, double usable_strain, int cells, int points) {
  std::vector<Target> targets;
  for (const DirectionFit& d : fit.directions) {
    Target target{&d, {}, {}, {}, {}};
    target.shape.length = d.samples.front().length;
    target.shape.width = d.samples.front().width;
    target.shape.orientation = static_cast<int>(d.orientation);
    target.shape.cells = cells;
    // Along the yarns not beyond the range of the law; on the bias the yarns stretch less than the coupon.
    const double end =
        d.name == "bias" ? d.curve.tested_strain : std::min(usable_strain, d.curve.tested_strain);
    for (int i = 1; i <= points; ++i) {
      const double strain = end * i / points;
      target.strain.push_back(strain);
      // The polynomial is the mean curve without its noise; K_0 is not carried by springs.
      target.measured.push_back(polynomial(d.fit.coefficients(), 1, strain));
      if (d.name == "bias") target.measured.back() = value_at(d.curve.strain, d.curve.load, strain);
    }
    targets.push_back(std::move(target));
  }
  return targets;
}

std::vector<double> loads(const CouponPull& pull) {
  std::vector<double> result;
  for (const CouponPoint& point : pull.points) result.push_back(point.load);
  return result;
}

std::vector<double> pulled(Target& target, const Fabric& fabric, ThreadTeam& team) {
  PullOptions options;
  options.tolerance = 1e-4;
  options.stress = false;
  return loads(pull_coupon(coupon_mesh(fabric, target.shape), target.strain, options, team, &target.guess));
}

struct Search {
  Fabric fabric;
  std::vector<Target> targets;
  ThreadTeam* team;
  const CouponFitOptions* options;
  const std::function<void(int, double, double, double)>* report;
  int evaluations = 0;
  bool find_bending = false;
  std::string failure{};
  bool converged = true;

  double misfit(double shear, double bending) {
    Fabric trial = fabric;
    trial.shear_fraction = shear;
    trial.bending_fraction = bending;
    const double off = (bending - options->start_bending) / prior_width;
    double sum = prior_weight * off * off;
    ++evaluations;
    try {
      for (Target& target : targets) sum += 1 - r_squared(target.measured, pulled(target, trial, *team));
    } catch (const Error& error) {
      failure = error.what();
      for (Target& target : targets) target.guess.clear();
      return cannot + shear;
    }
    if (*report) (*report)(evaluations, shear, bending, sum);
    return sum;
  }
};

double objective(unsigned count, const double* x, double*, void* data) {
  Search& search = *static_cast<Search*>(data);
  const bool shear = search.options->find_shear;
  return search.misfit(shear ? x[0] : search.fabric.shear_fraction,
                       search.find_bending ? x[count - 1] : search.fabric.bending_fraction);
}

void minimise(Search& search, double shear_step) {
  std::vector<double> x, low, high, step;
  const auto add = [&](double start, double lowest, double highest, double first_step) {
    x.push_back(std::clamp(start, lowest, highest)), low.push_back(lowest), high.push_back(highest);
    step.push_back(first_step);
  };
  if (search.options->find_shear) add(search.fabric.shear_fraction, lowest_shear, highest_shear, shear_step);
  if (search.find_bending) add(search.fabric.bending_fraction, 0, highest_bending, 0.02);
  const auto count = static_cast<unsigned>(x.size());
  // BOBYQA interpolates a quadratic and needs two unknowns; one is searched by COBYLA.
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> optimiser(
      nlopt_create(count > 1 ? NLOPT_LN_BOBYQA : NLOPT_LN_COBYLA, count), nlopt_destroy);
  nlopt_set_min_objective(optimiser.get(), objective, &search);
  nlopt_set_lower_bounds(optimiser.get(), low.data());
  nlopt_set_upper_bounds(optimiser.get(), high.data());
  nlopt_set_initial_step(optimiser.get(), step.data());
  const std::vector<double> close(count, 2e-5);
  nlopt_set_xtol_abs(optimiser.get(), close.data());
  nlopt_set_maxeval(optimiser.get(), search.options->most_evaluations);
  double best = 0;
  const nlopt_result result = nlopt_optimize(optimiser.get(), x.data(), &best);
  if (best >= cannot)
    throw Error(ExitCode::not_converged,
                "the virtual coupons failed for every shear fraction: " + search.failure);
  // Round-off near the optimum is as good as an end.
  if (result < 0 && result != NLOPT_ROUNDOFF_LIMITED)
    throw Error(
        ExitCode::not_converged,
        fmt::format("the optimisation of xi and eps failed with code {} of NLopt", static_cast<int>(result)));
  search.converged = search.converged && result != NLOPT_MAXEVAL_REACHED;
  if (search.options->find_shear) search.fabric.shear_fraction = x[0];
  if (search.find_bending) search.fabric.bending_fraction = x[count - 1];
}

/// xi's interval: each bias sample moves xi by its projection on dF/dxi, each yarn sample by its mean
/// relative load, since the coupon's load goes with K.
void shear_interval(Search& search, const MaterialFit& fit, double confidence, CouponFit& result) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  result.shear_low = result.shear_high = none;
  const auto bias = std::find_if(search.targets.begin(), search.targets.end(),
                                 [](const Target& t) { return t.direction->name == "bias"; });
  if (bias == search.targets.end()) return;
  constexpr double change = 0.01;
  Fabric moved = search.fabric;
  moved.shear_fraction += change;
  const std::vector<double> here = pulled(*bias, search.fabric, *search.team);
  const std::vector<double> there = pulled(*bias, moved, *search.team);
  double jj = 0, jf = 0;
  std::vector<double> j;
  for (std::size_t i = 0; i < here.size(); ++i) {
    j.push_back((there[i] - here[i]) / change);
    jj += j[i] * j[i], jf += j[i] * here[i];
  }
  double variance = 0;
  int degrees = std::numeric_limits<int>::max();
  const auto take = [&](const std::vector<double>& shifts) {
    variance += std::pow(standard_deviation(shifts), 2) / static_cast<double>(shifts.size());
    degrees = std::min(degrees, static_cast<int>(shifts.size()) - 1);
  };
  std::vector<double> shifts;
  for (const auto& sample : bias->direction->curve.samples) {
    double sum = 0;
    for (std::size_t i = 0; i < j.size(); ++i)
      sum += j[i] * value_at(bias->direction->curve.strain, sample, bias->strain[i]);
    shifts.push_back(sum / jj);
  }
  take(shifts);
  for (const DirectionFit& d : fit.directions) {
    if (d.name == "bias") continue;
    shifts.clear();
    const double share = fit.weft_differs ? 0.5 : 1.0;
    for (const auto& sample : d.curve.samples)
      shifts.push_back(share * jf / jj * mean(sample) / mean(d.curve.load));
    take(shifts);
  }
  if (degrees < 1) return;
  const double reach = student_t(confidence, degrees) * std::sqrt(variance);
  result.shear_low = search.fabric.shear_fraction - reach;
  result.shear_high = search.fabric.shear_fraction + reach;
}

double effect_of_bending(Search& search) {
  double largest = 0;
  for (Target& target : search.targets) {
    Fabric none = search.fabric, much = search.fabric;
    none.bending_fraction = 0;
    much.bending_fraction = 0.1;
    const std::vector<double> a = pulled(target, none, *search.team), b = pulled(target, much, *search.team);
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(b[i] / a[i] - 1));
  }
  return largest;
}

void find_fractions(Search& search, const MaterialFit& fit, const Bench& bench, CouponFit& result) {
  const CouponFitOptions& options = *search.options;
  if (options.find_shear) search.fabric.shear_fraction = options.start_shear;
  result.bending_effect = effect_of_bending(search);
  const bool both = options.find_bending && result.bending_effect >= options.bending_threshold;
  if (options.find_shear) minimise(search, 0.08);  // xi alone from afar, then both near by
  search.find_bending = both;
  if (both) minimise(search, 0.01);
  if (options.find_shear) shear_interval(search, fit, bench.confidence, result);
  if (options.find_bending)
    result.notes.push_back(fmt::format(
        "eps from 0 to 0.1 changes a coupon's load by {:.2g} % at most{}", 100 * result.bending_effect,
        search.find_bending ? ""
                            : fmt::format(": these tests do not determine eps, which remains {:.3g}",
                                          search.fabric.bending_fraction)));
  if (!search.converged)
    result.warnings.push_back(fmt::format(
        "the search for xi and eps was not converged after {} coupons: xi = {:.3g}, eps = {:.3g} are "
        "uncertain",
        search.evaluations, search.fabric.shear_fraction, search.fabric.bending_fraction));
  if (search.fabric.shear_fraction > highest_shear - 1e-3 ||
      search.fabric.shear_fraction < lowest_shear + 1e-3)
    result.warnings.push_back(fmt::format(
        "xi = {:.3g} is at the limit of its range: a lattice of springs does not represent the 45 deg test",
        search.fabric.shear_fraction));
}

/// The clamps hold the width and so stiffen the coupon a little: the factor takes that back, warp and weft alike.
double factor_of_clamps(Search& search) {
  double ms = 0, ss = 0;
  for (Target& target : search.targets) {
    if (target.direction->name == "bias") continue;
    const std::vector<double> simulated = pulled(target, search.fabric, *search.team);
    for (std::size_t i = 0; i < simulated.size(); ++i)
      ms += target.measured[i] * simulated[i], ss += simulated[i] * simulated[i];
  }
  return ms / ss;
}

void warn_of(const CouponComparison& c, CouponFit& result) {
  if (!c.pull.converged)
    result.warnings.push_back(
        fmt::format("the {} coupon did not reach a residual of {}; the last digits of its load are uncertain",
                    c.name, PullOptions{}.tolerance));
  if (c.r2 < 0.95)
    result.warnings.push_back(
        fmt::format("the simulated {} coupon follows its record with R2 = {:.3f} only: the lattice does not "
                    "represent this cloth in that direction",
                    c.name, c.r2));
}

}  // namespace

std::vector<CouponComparison> compare_coupons(const MaterialFit& fit, const Fabric& fabric, int cells,
                                              int points, ThreadTeam& team) {
  std::vector<CouponComparison> list;
  for (Target& target : targets_of(fit, fabric.tested_strain, cells, points)) {
    CouponComparison c;
    c.name = target.direction->name;
    c.shape = target.shape;
    c.strain = target.strain;
    c.measured.clear();
    for (double strain : c.strain)
      c.measured.push_back(value_at(target.direction->curve.strain, target.direction->curve.load, strain));
    c.coupon = coupon_mesh(fabric, c.shape);
    c.pull = pull_coupon(c.coupon, c.strain, {}, team);
    c.simulated = loads(c.pull);
    c.r2 = r_squared(c.measured, c.simulated);
    list.push_back(std::move(c));
  }
  return list;
}

CouponFit fit_coupons(const MaterialFit& fit, const Bench& bench, const CouponFitOptions& options,
                      ThreadTeam& team, const std::function<void(int, double, double, double)>& report) {
  const auto begin = std::chrono::steady_clock::now();
  CouponFit result;
  result.shear_low = result.shear_high = std::numeric_limits<double>::quiet_NaN();
  Search search{std::get<Fabric>(fit.material), {}, &team, &options, &report, 0, false, {}};
  search.targets = targets_of(fit, search.fabric.tested_strain, options.cells, options.points);
  result.searched = fit.direction("bias") && (options.find_shear || options.find_bending);
  if (options.find_bending) search.fabric.bending_fraction = options.start_bending;
  if (result.searched) {
    find_fractions(search, fit, bench, result);
  } else if (!fit.direction("bias")) {
    result.notes.push_back(fmt::format("no 45 deg test: xi = {:.3g} and eps = {:.3g} are not measured",
                                       search.fabric.shear_fraction, search.fabric.bending_fraction));
  }

  result.rescale = factor_of_clamps(search);
  result.fabric = search.fabric;
  for (double& k : result.fabric.coefficients_n_m) k *= result.rescale;
  for (double& k : result.fabric.weft_coefficients_n_m) k *= result.rescale;

  result.coupons = compare_coupons(fit, result.fabric, options.final_cells, options.final_points, team);
  for (const CouponComparison& c : result.coupons) warn_of(c, result);
  result.evaluations = search.evaluations;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace ripstop::inline calibration

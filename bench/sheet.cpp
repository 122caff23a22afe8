// Drag of a rigid disk-gap-band as a sheet, or of a canopy from a file, shifted by parts of a cell, on finer
// and finer grids: slip sides, second-order convection. What the shift does, and the order at which the mean
// over the shifts converges.
//   bench_sheet [cells across the canopy on the finest grid [grids [canopy.stl]]]
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "far_box.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/output/stl.h"

using namespace ripstop;

namespace {

constexpr double box = 12;  // wide, in diameters
constexpr int iterations = 400, averaged = 100;
constexpr double lowest_order = 0.25;  // below, the limit is anyone's guess
constexpr Vec3 shifts[] = {{0, 0, 0},           {0.25, 0.175, 0.25}, {0.5, 0.35, 0.5},
                           {0.75, 0.525, 0.75}, {0.5, 0, 0},         {0, 0, 0.5}};  // cells

struct Canopy {
  std::vector<Triangle> surface;  // about its middle, the disk-gap-band about its skirt [m]
  double diameter = 0;            // [m]
  double place() const { return 0.45 * 1.5 * box * diameter; }
};

std::vector<Triangle> moved(std::vector<Triangle> surface, Vec3 by) {
  for (Triangle& t : surface) t = {t.a + by, t.b + by, t.c + by};
  return surface;
}

Canopy canopy_from(const char* file) {
  if (!file) return {rigid_disk_gap_band({}), 0.65};
  Canopy canopy{read_stl(file), 0};
  Vec3 low = canopy.surface.front().a, high = low;
  for (const Triangle& t : canopy.surface) {
    for (const Vec3 p : {t.a, t.b, t.c}) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  }
  canopy.diameter = high.x - low.x;
  canopy.surface = moved(canopy.surface, -0.5 * (low + high));
  return canopy;
}

double drag(const Canopy& canopy, const FlowGrid& grid, Vec3 shift, double a, double b) {
  FlowProblem problem;
  problem.grid = grid;
  problem.air.speed = 30;
  problem.sides = Sides::slip;
  problem.max_iterations = iterations;
  problem.average_over = averaged;
  const Vec3 h = grid.spacing();
  problem.sheets = {
      {moved(canopy.surface, {shift.x * h.x, shift.y * h.y, canopy.place() + shift.z * h.z}), a, b}};
  CartesianSettings settings;
  settings.second_order = true;
  return make_cartesian(settings)->solve(problem, {}).porous_force.z;
}

struct Fit {
  double limit = 0, slope = 0, order = 0, residual = 0;
};

/// Least squares of limit + slope h^order.
Fit fitted(const std::vector<double>& h, const std::vector<double>& drags) {
  const auto count = static_cast<double>(h.size());
  Fit best;
  best.residual = 1e300;
  for (double order = lowest_order; order <= 4; order += 0.01) {
    double x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t n = 0; n < h.size(); ++n) {
      const double q = std::pow(h[n], order);
      x += q / count, y += drags[n] / count, xx += q * q / count, xy += q * drags[n] / count;
    }
    Fit fit{0, (xy - x * y) / (xx - x * x), order, 0};
    fit.limit = y - fit.slope * x;
    for (std::size_t n = 0; n < h.size(); ++n) {
      const double off = drags[n] - fit.limit - fit.slope * std::pow(h[n], order);
      fit.residual += off * off / count;
    }
    fit.residual = std::sqrt(fit.residual);
    if (fit.residual < best.residual) best = fit;
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  const int finest = argc > 1 ? std::atoi(argv[1]) : 40, grids = argc > 2 ? std::atoi(argv[2]) : 4;
  if (finest < 10 || grids < 1) {
    fmt::print(stderr, "usage: bench_sheet [finest >= 10 [grids >= 1 [canopy.stl]]]\n");
    return 2;
  }
  const Canopy canopy = canopy_from(argc > 3 ? argv[3] : nullptr);
  fmt::print("{}, d = {:.3f} m, 30 m/s, box {} d wide, mean drag of the last {} of {} iterations [N]\n",
             argc > 3 ? argv[3] : "Rigid disk-gap-band", canopy.diameter, box, averaged, iterations);
  fmt::print("{:>5} {:>9} {:>9}", "h/d", "cells", "a Pa s/m");
  for (const Vec3& s : shifts) fmt::print(" {:>13}", fmt::format("{:g},{:g},{:g}", s.x, s.y, s.z));
  fmt::print(" {:>9} {:>9}\n", "mean", "spread");
  for (const auto& [a, b] : {std::pair{66.0, 37.45}, std::pair{8169.3, 0.0}}) {
    std::vector<double> widths, means;
    for (int g = grids - 1; g >= 0; --g) {
      const int across = static_cast<int>(std::lround(finest * std::pow(2, -0.5 * g)));
      const FlowGrid grid = far_box(canopy.diameter, box, across, canopy.place());
      fmt::print("{:>5} {:>9} {:>9}", fmt::format("1/{}", across), grid.cells(), a);
      std::vector<double> drags;
      for (const Vec3& shift : shifts) {
        drags.push_back(drag(canopy, grid, shift, a, b));
        fmt::print(" {:>13.2f}", drags.back());
        std::fflush(stdout);
      }
      const auto [low, high] = std::minmax_element(drags.begin(), drags.end());
      double mean = 0;
      for (const double one : drags) mean += one / static_cast<double>(drags.size());
      fmt::print(" {:>9.2f} {:>7.2f} %\n", mean, 100 * (*high - *low) / mean);
      widths.push_back(1.0 / across), means.push_back(mean);
    }
    if (grids < 3) continue;
    const Fit fit = fitted(widths, means);
    if (fit.order <= lowest_order) {
      fmt::print("a = {}: the mean has no order on these grids\n", a);
      continue;
    }
    fmt::print("a = {}: mean = {:.2f} {:+.3g} (h/d)^{:.2f} N, off by {:.2f} N rms\n", a, fit.limit, fit.slope,
               fit.order, fit.residual);
  }
}

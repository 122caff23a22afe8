#include "ripstop/fsi/added_mass.h"

#include <algorithm>
#include <cmath>

namespace ripstop::inline fsi {
namespace {

constexpr int across = 64, along = 88;    // cells of the box
constexpr double box = 3;                 // from the middle to its sides, in the surface's larger extent
constexpr double margin = 0.2;            // of the fine cells about the surface
constexpr double growth = 1.25;           // of cells outside of it
constexpr double tight = 1e6;             // [Pa s/m]
constexpr double drift = 0.05;            // [m/s] of surface and air together, because a flow needs a stream
constexpr double gain = 50, step = 2e-4;  // [m/s2], [s]: it moves by no part of a cell that matters
constexpr int steps = 3;                  // after which the pressure has come to rest

FlowProblem still_air_about(const std::vector<Triangle>& surface, double density) {
  Vec3 low = surface.front().a, high = low;
  for (const Triangle& t : surface)
    for (const Vec3& p : {t.a, t.b, t.c}) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  const Vec3 size = high - low, middle = 0.5 * (low + high);
  const double width = std::max(size.x, size.y), half = box * std::max(width, size.z), more = margin * width;
  const Vec3 spare{more, more, more}, corner{half, half, half};
  FlowProblem problem;
  problem.grid =
      graded({middle - corner, 2 * corner, across, across, along}, low - spare, high + spare, growth);
  problem.air.velocity = {0, 0, drift};
  problem.air.density = density;
  problem.sides = Sides::entraining;
  problem.outlet = Outlet::still_air;
  problem.bodies = {sheet_body(surface, {tight, 0})};
  return problem;
}

}  // namespace

double added_mass(FlowEngine& engine, const std::vector<Triangle>& surface, double density) {
  const auto flow = engine.start(still_air_about(surface, density));
  double force = 0;
  for (int n = 1; n <= steps; ++n) {
    SheetMotion motion;
    motion.velocity.assign(surface.size(), {0, 0, drift + gain * n * step});
    flow->place(0, surface, motion);
    force = flow->step(step).force.z;
  }
  return -force / gain;
}

}  // namespace ripstop::inline fsi

#include "ripstop/flow/flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/flow/average.h"

namespace ripstop::inline flow {
namespace {

template <class T>
T trilinear(const FlowGrid& grid, const std::vector<T>& field, Vec3 point) {
  const Bracket x = bracket(grid, 0, point.x), y = bracket(grid, 1, point.y), z = bracket(grid, 2, point.z);
  const auto along_x = [&](int j, int k) {
    return field[grid.index(x.low, j, k)] * (1 - x.weight) + field[grid.index(x.high, j, k)] * x.weight;
  };
  const auto along_y = [&](int k) {
    return along_x(y.low, k) * (1 - y.weight) + along_x(y.high, k) * y.weight;
  };
  return along_y(z.low) * (1 - z.weight) + along_y(z.high) * z.weight;
}

struct Box {
  Vec3 low, high;
};

/// Whether the projections of triangle and box on `axis` lie apart. Coordinates are relative to the box's
/// centre, `half` its half size.
bool apart(Vec3 axis, const std::array<Vec3, 3>& corner, Vec3 half) {
  const double a = dot(axis, corner[0]), b = dot(axis, corner[1]), c = dot(axis, corner[2]);
  const double reach = half.x * std::abs(axis.x) + half.y * std::abs(axis.y) + half.z * std::abs(axis.z);
  return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
}

/// Separating axes of a triangle and a closed box: the triangle's normal and the nine products of an edge and
/// a box axis (T. Akenine-Moeller, Fast 3D triangle-box overlap testing, 2001). The three box axes, which
/// must be compared without rounding, are done by the caller.
bool meets(const std::array<Vec3, 3>& triangle, const Box& box) {
  const Vec3 centre = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
  const std::array<Vec3, 3> p = {triangle[0] - centre, triangle[1] - centre, triangle[2] - centre};
  const std::array<Vec3, 3> edge = {p[1] - p[0], p[2] - p[1], p[0] - p[2]};
  if (apart(cross(edge[0], edge[1]), p, half)) return false;
  for (const Vec3 e : edge) {
    if (apart({0, -e.z, e.y}, p, half) || apart({e.z, 0, -e.x}, p, half) || apart({-e.y, e.x, 0}, p, half)) {
      return false;
    }
  }
  return true;
}

struct Interval {
  int first, last;  // inclusive
};

/// Cells between `edges` whose closed extent touches [low, high].
Interval touched(double low, double high, const std::vector<double>& edges) {
  const auto first = std::lower_bound(edges.begin(), edges.end(), low) - edges.begin();
  const auto beyond = std::upper_bound(edges.begin(), edges.end(), high) - edges.begin();
  return {std::max(static_cast<int>(first) - 1, 0),
          std::min(static_cast<int>(beyond), static_cast<int>(edges.size()) - 1) - 1};
}

}  // namespace

void check_stream(const Freestream& air) {
  constexpr double most_mach = 0.3, ratio_of_heats = 1.4;
  const double sound = std::sqrt(ratio_of_heats * gas_constant_of_air * air.temperature), speed = air.speed();
  if (speed > 0 && !(speed > most_mach * sound)) return;
  throw QuantityError(
      ExitCode::usage,
      fmt::format(
          "speed of the free stream = {:g} m/s: must be above 0 and at most {:.4g} m/s, Mach {} at {:g} K; "
          "change it or the temperature of the air",
          speed, most_mach * sound, most_mach, air.temperature),
      {"speed of the free stream", "the temperature of the air"});
}

FlowBody sheet_body(std::vector<Triangle> surface, PressureDrop law, std::string name) {
  return {std::move(name), std::move(surface), law};
}

FlowBody porous_body(PorousCells cells, std::string name) {
  return {std::move(name), {}, std::move(cells)};
}

bool FlowProblem::has_sheets() const {
  return std::any_of(bodies.begin(), bodies.end(), [](const FlowBody& body) { return body.is_sheet(); });
}

Vec3 force_on_others(const std::vector<BodyLoad>& bodies) {
  Vec3 sum;
  for (std::size_t n = 1; n < bodies.size(); ++n) sum += bodies[n].force;
  return sum;
}

std::vector<SheetLoad> loads_on(std::size_t body, std::vector<SheetLoad> loads) {
  std::erase_if(loads, [body](const SheetLoad& load) { return static_cast<std::size_t>(load.body) != body; });
  return loads;
}

double largest_residual(const FlowProgress& p) {
  return std::max({p.residual_u, p.residual_p, p.residual_k, p.residual_omega, p.residual_e});
}

namespace {
Error no_time() {
  return {ExitCode::usage, "this flow engine does not support unsteady flow"};
}
}  // namespace

void Flow::add_to(FieldMean& mean) const {
  mean.add(field());
}

void Flow::place_all(const std::vector<Placement>& bodies) {
  for (const Placement& placed : bodies) place(placed.body, placed.surface, placed.motion);
}

FlowStep Flow::march(int, double, const StepReport&) {
  throw no_time();
}
double Flow::longest_step(double) {
  throw no_time();
}
FlowStep Flow::step(double) {
  throw no_time();
}
void Flow::stream(Vec3, Vec3) {
  throw no_time();
}
void Flow::continue_from(const std::filesystem::path&) {
  throw Error(ExitCode::usage, "this flow engine does not interpolate a saved flow to other cells");
}

double sample(const FlowGrid& grid, const std::vector<double>& field, Vec3 point) {
  return trilinear(grid, field, point);
}

Vec3 sample(const FlowGrid& grid, const std::vector<Vec3>& field, Vec3 point) {
  return trilinear(grid, field, point);
}

std::vector<int> cut_cells(const FlowGrid& grid, const std::vector<Triangle>& surface) {
  const std::vector<double> x = grid.edges(0), y = grid.edges(1), z = grid.edges(2);
  std::vector<char> cut(static_cast<std::size_t>(grid.cells()), 0);
  for (const Triangle& t : surface) {
    const Vec3 low{std::min({t.a.x, t.b.x, t.c.x}), std::min({t.a.y, t.b.y, t.c.y}),
                   std::min({t.a.z, t.b.z, t.c.z})};
    const Vec3 high{std::max({t.a.x, t.b.x, t.c.x}), std::max({t.a.y, t.b.y, t.c.y}),
                    std::max({t.a.z, t.b.z, t.c.z})};
    const Interval is = touched(low.x, high.x, x), js = touched(low.y, high.y, y),
                   ks = touched(low.z, high.z, z);
    for (int k = ks.first; k <= ks.last; ++k) {
      for (int j = js.first; j <= js.last; ++j) {
        for (int i = is.first; i <= is.last; ++i) {
          char& mark = cut[grid.index(i, j, k)];
          if (mark) continue;
          if (meets({t.a, t.b, t.c}, {{x[i], y[j], z[k]}, {x[i + 1], y[j + 1], z[k + 1]}})) mark = 1;
        }
      }
    }
  }
  std::vector<int> cells;
  for (int c = 0; c < grid.cells(); ++c) {
    if (cut[c]) cells.push_back(c);
  }
  return cells;
}

}  // namespace ripstop::inline flow

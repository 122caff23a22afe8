#include "ripstop/flow/flow.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ripstop {
namespace {

/// Lower of the two cells around x along one axis, and the weight of the upper one; constant at the ends.
struct Bracket {
  int low, high;
  double weight;
};

Bracket bracket(double x, double origin, double spacing, int n) {
  const double centred = (x - origin) / spacing - 0.5;
  const double clamped = std::clamp(centred, 0.0, static_cast<double>(n - 1));
  const int low = std::min(static_cast<int>(clamped), std::max(n - 2, 0));
  return {low, std::min(low + 1, n - 1), clamped - low};
}

template <class T>
T trilinear(const FlowGrid& grid, const std::vector<T>& field, Vec3 point) {
  const Vec3 h = grid.spacing();
  const Bracket x = bracket(point.x, grid.origin.x, h.x, grid.nx);
  const Bracket y = bracket(point.y, grid.origin.y, h.y, grid.ny);
  const Bracket z = bracket(point.z, grid.origin.z, h.z, grid.nz);
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

/// Cells along one axis whose closed extent can touch [low, high]. The margin only admits candidates: the
/// comparison with the cell's own faces decides.
Interval candidates(double low, double high, double origin, double spacing, int n) {
  constexpr double margin = 1e-6;  // of a cell
  const double first = std::ceil((low - origin) / spacing - margin) - 1;
  const double last = std::floor((high - origin) / spacing + margin);
  return {static_cast<int>(std::clamp(first, 0.0, static_cast<double>(n))),
          static_cast<int>(std::clamp(last, -1.0, static_cast<double>(n - 1)))};
}

}  // namespace

double sample(const FlowGrid& grid, const std::vector<double>& field, Vec3 point) {
  return trilinear(grid, field, point);
}

Vec3 sample(const FlowGrid& grid, const std::vector<Vec3>& field, Vec3 point) {
  return trilinear(grid, field, point);
}

std::vector<int> cut_cells(const FlowGrid& grid, const std::vector<Triangle>& surface) {
  const Vec3 h = grid.spacing(), o = grid.origin;
  std::vector<char> cut(static_cast<std::size_t>(grid.cells()), 0);
  for (const Triangle& t : surface) {
    const Vec3 low{std::min({t.a.x, t.b.x, t.c.x}), std::min({t.a.y, t.b.y, t.c.y}),
                   std::min({t.a.z, t.b.z, t.c.z})};
    const Vec3 high{std::max({t.a.x, t.b.x, t.c.x}), std::max({t.a.y, t.b.y, t.c.y}),
                    std::max({t.a.z, t.b.z, t.c.z})};
    const Interval is = candidates(low.x, high.x, o.x, h.x, grid.nx);
    const Interval js = candidates(low.y, high.y, o.y, h.y, grid.ny);
    const Interval ks = candidates(low.z, high.z, o.z, h.z, grid.nz);
    for (int k = ks.first; k <= ks.last; ++k) {
      for (int j = js.first; j <= js.last; ++j) {
        for (int i = is.first; i <= is.last; ++i) {
          char& mark = cut[grid.index(i, j, k)];
          if (mark) continue;
          const Box box{{o.x + i * h.x, o.y + j * h.y, o.z + k * h.z},
                        {o.x + (i + 1) * h.x, o.y + (j + 1) * h.y, o.z + (k + 1) * h.z}};
          if (low.x > box.high.x || high.x < box.low.x || low.y > box.high.y || high.y < box.low.y ||
              low.z > box.high.z || high.z < box.low.z) {
            continue;
          }
          if (meets({t.a, t.b, t.c}, box)) mark = 1;
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

}  // namespace ripstop

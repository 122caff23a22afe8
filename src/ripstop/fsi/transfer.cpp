#include "ripstop/fsi/transfer.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ripstop::inline fsi {
namespace {

Vec3 area_of(const Cell& cell, const std::vector<Vec3>& x) {
  return area_vector(x[cell.corner[0]], x[cell.corner[1]], x[cell.corner[2]], x[cell.corner[3]]);
}

// Trilinear interpolation of the pressure at `point`, only over cells that no cloth cuts and whose centres
// lie on the side of the plane (centre, direction) that the direction points to.
std::optional<double> one_sided(const FlowField& field, const std::vector<char>& cut, Vec3 point, Vec3 centre,
                                Vec3 direction) {
  const FlowGrid& grid = field.grid;
  const Bracket x = bracket(grid, 0, point.x), y = bracket(grid, 1, point.y), z = bracket(grid, 2, point.z);
  double sum = 0, weights = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const bool di = corner & 1, dj = corner >> 1 & 1, dk = corner >> 2;
    const int i = di ? x.high : x.low, j = dj ? y.high : y.low, k = dk ? z.high : z.low;
    const int cell = grid.index(i, j, k);
    if (cut[cell] || dot(grid.centre(i, j, k) - centre, direction) <= 0) continue;
    const double weight =
        (di ? x.weight : 1 - x.weight) * (dj ? y.weight : 1 - y.weight) * (dk ? z.weight : 1 - z.weight);
    sum += weight * field.pressure[cell];
    weights += weight;
  }
  if (weights < 0.05) return std::nullopt;  // too far from every clean cell to speak for them
  return sum / weights;
}

}  // namespace

std::vector<Triangle> surface_of(const std::vector<Cell>& cells, const std::vector<Vec3>& x) {
  std::vector<Triangle> triangles;
  triangles.reserve(2 * cells.size());
  for (const Cell& cell : cells) {
    if (cell.corner[0] < 0) continue;
    const auto [a, b, c, d] = cell.corner;
    triangles.push_back({x[a], x[b], x[c]});
    triangles.push_back({x[a], x[c], x[d]});
  }
  return triangles;
}

std::vector<double> SidePressures::difference() const {
  std::vector<double> dp(inside.size());
  for (std::size_t i = 0; i < dp.size(); ++i) dp[i] = inside[i] - outside[i];
  return dp;
}

SidePressures sample_sides(const FlowField& field, const std::vector<int>& porous_cells,
                           const std::vector<Cell>& cells, const std::vector<Vec3>& x) {
  std::vector<char> cut(field.grid.cells(), 0);
  for (const int cell : porous_cells) cut[cell] = 1;

  SidePressures sides{std::vector<double>(cells.size(), 0.0), std::vector<double>(cells.size(), 0.0)};
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].corner[0] < 0) continue;
    const Vec3 area = area_of(cells[c], x);
    if (norm(area) <= 0) continue;
    const Vec3 n = area / norm(area);
    Vec3 centre{};
    for (const int node : cells[c].corner) centre += 0.25 * x[node];
    const Vec3 h = field.grid.spacing(centre);
    // A plane with normal n cuts cells whose centres are up to half of this away from it.
    const double thickness = std::abs(n.x) * h.x + std::abs(n.y) * h.y + std::abs(n.z) * h.z;
    const auto side = [&](double sign) {
      for (double distance = 0.75; distance <= 4.0; distance += 0.25) {
        const Vec3 direction = sign * n;
        const auto p = one_sided(field, cut, centre + distance * thickness * direction, centre, direction);
        if (p) return *p;
      }
      return 0.0;
    };
    sides.outside[c] = side(+1);
    sides.inside[c] = side(-1);
  }
  return sides;
}

Vec3 pressure_force(const std::vector<Cell>& cells, const std::vector<Vec3>& x,
                    const std::vector<double>& difference) {
  Vec3 force{};
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].corner[0] >= 0) force += difference[c] * area_of(cells[c], x);
  }
  return force;
}

}  // namespace ripstop::inline fsi

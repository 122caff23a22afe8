#include "ripstop/coupling/transfer.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ripstop {
namespace {

Vec3 area_of(const Cell& cell, const std::vector<Vec3>& x) {
  return area_vector(x[cell.corner[0]], x[cell.corner[1]], x[cell.corner[2]], x[cell.corner[3]]);
}

// Trilinear interpolation of the pressure at `point`, only over cells that no cloth cuts and whose centres
// lie on the side of the plane (centre, direction) that the direction points to.
std::optional<double> one_sided(const FlowField& field, const std::vector<char>& cut, Vec3 point, Vec3 centre,
                                Vec3 direction) {
  const FlowGrid& grid = field.grid;
  const Vec3 h = grid.spacing();
  const Vec3 s{(point.x - grid.origin.x) / h.x - 0.5, (point.y - grid.origin.y) / h.y - 0.5,
               (point.z - grid.origin.z) / h.z - 0.5};
  const int i0 = static_cast<int>(std::floor(s.x)), j0 = static_cast<int>(std::floor(s.y)),
            k0 = static_cast<int>(std::floor(s.z));
  double sum = 0, weights = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int di = corner & 1, dj = corner >> 1 & 1, dk = corner >> 2;
    const int i = i0 + di, j = j0 + dj, k = k0 + dk;
    if (i < 0 || j < 0 || k < 0 || i >= grid.nx || j >= grid.ny || k >= grid.nz) continue;
    const int cell = grid.index(i, j, k);
    const Vec3 middle{grid.origin.x + (i + 0.5) * h.x, grid.origin.y + (j + 0.5) * h.y,
                      grid.origin.z + (k + 0.5) * h.z};
    if (cut[cell] || dot(middle - centre, direction) <= 0) continue;
    const double weight = (di ? s.x - i0 : 1 - (s.x - i0)) * (dj ? s.y - j0 : 1 - (s.y - j0)) *
                          (dk ? s.z - k0 : 1 - (s.z - k0));
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
  const Vec3 h = field.grid.spacing();

  SidePressures sides{std::vector<double>(cells.size(), 0.0), std::vector<double>(cells.size(), 0.0)};
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].corner[0] < 0) continue;
    const Vec3 area = area_of(cells[c], x);
    if (norm(area) <= 0) continue;
    const Vec3 n = area / norm(area);
    Vec3 centre{};
    for (const int node : cells[c].corner) centre += 0.25 * x[node];
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

}  // namespace ripstop

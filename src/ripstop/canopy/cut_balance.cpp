#include "ripstop/canopy/cut_balance.h"

#include <array>
#include <cmath>

namespace ripstop {
namespace {

double about_axis(Vec3 point, Vec3 force) {
  return point.x * force.y - point.y * force.x;
}

/// Where z = height crosses the way from a to b, which lie on either side of it.
Vec3 crossing(Vec3 a, Vec3 b, double height) {
  return a + ((height - a.z) / (b.z - a.z)) * (b - a);
}

// N m ds over the straight cut of one triangle; m lies in the cell's plane, across the cut, and points up.
void add_triangle(CutBalance& cut, const std::array<Vec3, 3>& corner, Vec3 normal, const CellStress& stress) {
  Vec3 end[2];
  int ends = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 a = corner[i], b = corner[(i + 1) % 3];
    if ((a.z > cut.height) != (b.z > cut.height) && ends < 2) end[ends++] = crossing(a, b, cut.height);
  }
  if (ends < 2) return;
  Vec3 across = cross(normal, end[1] - end[0]);  // as long as the cut
  if (across.z < 0) across = -1.0 * across;
  const Vec3 first = stress.direction, second = cross(normal, first);
  const Vec3 force =
      stress.principal_max * dot(first, across) * first + stress.principal_min * dot(second, across) * second;
  cut.cloth_force += force.z;
  cut.moment += about_axis(0.5 * (end[0] + end[1]), force);
}

}  // namespace

CutBalance cut_balance(const Mesh& mesh, const std::vector<Vec3>& x, const std::vector<CellStress>& stress,
                       const std::vector<double>& tensions, const std::vector<Vec3>& load, double height) {
  CutBalance cut;
  cut.height = height;
  const std::vector<Cell> cells = cells_of(mesh);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].corner[0] < 0) continue;
    const auto [i, j, k, l] = cells[c].corner;
    const Vec3 area = area_vector(x[i], x[j], x[k], x[l]);
    if (!(norm(area) > 0)) continue;
    const Vec3 normal = area / norm(area);
    add_triangle(cut, {x[i], x[j], x[k]}, normal, stress[c]);
    add_triangle(cut, {x[i], x[k], x[l]}, normal, stress[c]);
  }
  for (std::size_t s = 0; s < mesh.springs.size(); ++s) {
    const Vec3 a = x[mesh.springs[s].a], b = x[mesh.springs[s].b];
    if ((a.z > height) == (b.z > height)) continue;
    const Vec3 up = b.z > a.z ? b - a : a - b;
    const Vec3 force = (tensions[s] / norm(up)) * up;
    cut.cord_force += force.z;
    cut.moment += about_axis(crossing(a, b, height), force);
  }
  for (std::size_t node = 0; node < x.size(); ++node) {
    if (!(x[node].z > height)) continue;
    cut.air_force += load[node].z;
    cut.air_moment += about_axis(x[node], load[node]);
  }
  return cut;
}

}  // namespace ripstop

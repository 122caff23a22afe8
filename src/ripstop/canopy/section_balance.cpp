#include "ripstop/canopy/section_balance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ripstop::inline canopy {
namespace {

using std::numbers::pi;

double about_axis(Vec3 point, Vec3 force) {
  return point.x * force.y - point.y * force.x;
}

/// How much sections at z count, and the share of them that lie below z.
struct Sections {
  double height, reach;

  double weight(double z) const {
    const double s = (z - height) / reach;
    return std::abs(s) < 1 ? (1 + std::cos(pi * s)) / (2 * reach) : 0;
  }
  double below(double z) const {
    const double s = std::clamp((z - height) / reach, -1.0, 1.0);
    return 0.5 * (1 + s + std::sin(pi * s) / pi);
  }
};

/// The row of the stress tensor that meets the z axis [N/m].
Vec3 axial_traction(const CellStress& stress, Vec3 normal) {
  const Vec3 first = stress.direction, second = cross(normal, first);
  return stress.principal_max * first.z * first + stress.principal_min * second.z * second;
}

/// Data of a state, the same for every section.
struct Carried {
  std::vector<Cell> cells;
  std::vector<Vec3> x, on_ties;
  std::vector<CellStress> stress;
  std::vector<double> tensions;

  Carried(const Mesh& mesh, const Cloth& cloth, const ClothState& state)
      : cells(cells_of(mesh)),
        x(positions(state, cloth)),
        on_ties(tie_forces(cloth, state)),
        stress(cell_stress(cloth, state)),
        tensions(spring_tensions(cloth, state)) {}
};

// The integral over z of the force through a section is that of the stress's z row over the cloth.
SectionBalance balance_of(const Mesh& mesh, const Carried& carried, const std::vector<Vec3>& load,
                          const Sections& sections) {
  const auto& [cells, x, on_ties, stress, tensions] = carried;
  SectionBalance sum;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].corner[0] < 0) continue;
    const auto [i, j, k, l] = cells[c].corner;
    const Vec3 area = area_vector(x[i], x[j], x[k], x[l]), centre = 0.25 * (x[i] + x[j] + x[k] + x[l]);
    if (!(norm(area) > 0)) continue;
    const Vec3 force = norm(area) * sections.weight(centre.z) * axial_traction(stress[c], area / norm(area));
    sum.cloth_force += force.z;
    sum.moment += about_axis(centre, force);
  }
  for (std::size_t s = 0; s < mesh.springs.size(); ++s) {
    const Vec3 a = x[mesh.springs[s].a], b = x[mesh.springs[s].b];
    const Vec3 force = tensions[s] * (sections.below(b.z) - sections.below(a.z)) / norm(b - a) * (b - a);
    sum.cord_force += force.z;
    sum.moment += about_axis(0.5 * (a + b), force);
  }
  for (std::size_t t = 0; t < mesh.ties.size(); ++t) {
    const Tie& tie = mesh.ties[t];
    const Vec3 force = on_ties[t] + load[tie.node];
    for (const Tie::Master& master : tie.masters) {
      const double share = master.weight * (sections.below(x[tie.node].z) - sections.below(x[master.node].z));
      sum.seam_force += share * force.z;
      sum.moment += share * about_axis(x[tie.node], force);
    }
  }
  for (std::size_t node = 0; node < x.size(); ++node) {
    sum.air_force += sections.below(x[node].z) * load[node].z;
    sum.air_moment += sections.below(x[node].z) * about_axis(x[node], load[node]);
  }
  return sum;
}

}  // namespace

SectionBalance section_balance(const Mesh& mesh, const Cloth& cloth, const ClothState& state,
                               const std::vector<Vec3>& load, double height, double reach) {
  return balance_of(mesh, {mesh, cloth, state}, load, {height, reach});
}

double largest_section_gap(const Mesh& mesh, const Cloth& cloth, const ClothState& state,
                           const std::vector<Vec3>& load) {
  const Carried carried(mesh, cloth, state);
  const std::vector<Vec3>& x = carried.x;
  double low = 1e300, high = -1e300;
  for (const Cell& cell : carried.cells) {
    if (cell.corner[0] < 0) continue;
    for (const int node : cell.corner) low = std::min(low, x[node].z), high = std::max(high, x[node].z);
  }
  double largest = 0;
  for (const double share : {0.2, 0.35, 0.5, 0.65, 0.8}) {
    const SectionBalance balance =
        balance_of(mesh, carried, load, {low + share * (high - low), 0.2 * (high - low)});
    largest = std::max(largest, std::abs(balance.gap() / balance.air_force));
  }
  return largest;
}

}  // namespace ripstop::inline canopy

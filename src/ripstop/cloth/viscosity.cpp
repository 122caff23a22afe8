// How strong the cloth's dampers may be without costing the step.
#include <algorithm>

#include "ripstop/cloth/stability_limit.h"

namespace ripstop::inline cloth {
namespace {

// lambda_max of the blocks of the dampers over the mass, tied nodes' handed on and taken back. [1/s]
std::vector<double> over_mass(const Cloth& cloth, const std::vector<double>& block) {
  std::vector<double> rate(block.size(), 0.0);
  for (std::size_t i = 0; i < block.size(); ++i)
    if (!cloth.is_tied[i] && !cloth.is_fixed[i]) rate[i] = block[i] / cloth.total_mass[i];
  return rate;
}

}  // namespace

// A step dt is stable where rho_i dt^2 + 2 c_i dt <= 2 at every node: both ends of a spring then add up to the
// 4 of stability_limit(). The part of the 2 that springs and other dampers do not use is available for the viscosity.
// (The absolute damping is a thousandth of that.)
ViscosityLimit limit_viscosity(Mesh& mesh, const ClothOptions& options, const std::vector<Vec3>& positions,
                               double step_share) {
  Mesh without = mesh, alone = mesh;
  for (Patch& patch : without.patches) {
    std::fill(std::begin(patch.viscosity), std::end(patch.viscosity), 0.0);
    patch.viscosity_share.clear();
  }
  for (Patch& patch : alone.patches) std::fill(std::begin(patch.damping), std::end(patch.damping), 0.0);
  for (Spring& spring : alone.springs) spring.damping = 0;

  const ClothPtr cloth = make_cloth(without, options), viscous = make_cloth(alone, options);
  ClothState state = start_state(*cloth);
  set_positions(state, *cloth, positions);
  const NodeStiffness others = node_stiffness(*cloth, state);
  const double step = step_share * stability_limit(*cloth, state, others).stable_step;
  const std::vector<double> rho = over_mass(*cloth, others.stiffness),
                            rate = over_mass(*cloth, others.damping);
  ClothState same = start_state(*viscous);
  set_positions(same, *viscous, positions);
  const std::vector<double> wanted = over_mass(*cloth, node_stiffness(*viscous, same).damping);

  std::vector<double> share(mesh.node_count(), 1.0);
  for (int i = 0; i < mesh.node_count(); ++i) {
    if (wanted[i] == 0) continue;
    const double left = 2 - step * (rho[i] * step + 2 * rate[i]);
    share[i] = std::clamp(left / (2 * step * wanted[i]), 0.0, 1.0);
  }
  for (const Tie& tie : mesh.ties)
    for (const auto& master : tie.masters) share[tie.node] = std::min(share[tie.node], share[master.node]);

  ViscosityLimit limit;
  std::size_t cells = 0, reduced = 0;
  for (Patch& patch : mesh.patches) {
    if (std::all_of(std::begin(patch.viscosity), std::end(patch.viscosity), [](double v) { return v == 0; }))
      continue;
    std::vector<double> of_cell(static_cast<std::size_t>(patch.rows) * patch.columns, 1.0);
    for (int d = 0; d < direction_count; ++d)
      for (int row = 0; row < patch.rows; ++row)
        for (int column = 0; column < patch.columns; ++column) {
          if (patch.width[d][static_cast<std::size_t>(row) * patch.columns + column] == 0) continue;
          const int to = (column + direction_offset[d].column + patch.columns) % patch.columns;
          double& least = of_cell[patch.share_index(d, row, column)];
          least = std::min(
              {least, share[patch.node(row, column)], share[patch.node(row + direction_offset[d].row, to)]});
        }
    cells += of_cell.size();
    reduced += std::count_if(of_cell.begin(), of_cell.end(), [](double s) { return s < 1; });
    limit.least_share = std::min(limit.least_share, *std::min_element(of_cell.begin(), of_cell.end()));
    if (patch.viscosity_share.empty())
      patch.viscosity_share = std::move(of_cell);
    else
      std::transform(of_cell.begin(), of_cell.end(), patch.viscosity_share.begin(),
                     patch.viscosity_share.begin(), [](double a, double b) { return a * b; });
  }
  if (cells > 0) limit.reduced_cells = static_cast<double>(reduced) / static_cast<double>(cells);
  return limit;
}

}  // namespace ripstop::inline cloth

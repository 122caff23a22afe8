#include "ripstop/fsi/approach.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/canopy/shape.h"

namespace ripstop::inline fsi {

double mean_speed_over_disk(const FlowField& field, Vec3 centre, double diameter) {
  constexpr int rings = 16, spokes = 24;
  double sum = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const double radius = 0.5 * diameter * std::sqrt((ring + 0.5) / rings);
    for (int spoke = 0; spoke < spokes; ++spoke) {
      const double angle = 2 * std::numbers::pi * (spoke + 0.5) / spokes;
      const Vec3 point = centre + radius * Vec3{std::cos(angle), std::sin(angle), 0};
      sum += sample(field.grid, field.velocity, point).z;
    }
  }
  return sum / (rings * spokes);
}

double approach_speed(const FlowField& field, const CanopyMesh& mesh, const std::vector<Vec3>& shape) {
  double front = field.grid.origin.z + field.grid.size.z;  // of the cloth
  for (const Patch& patch : mesh.patches)
    for (int node = 0; node < patch.rows * patch.columns; ++node)
      front = std::min(front, shape[patch.first_node + node].z);
  const double diameter = canopy_size(mesh, shape).projected_diameter;
  return mean_speed_over_disk(field, {0, 0, std::max(field.grid.origin.z, front - diameter)}, diameter);
}

}  // namespace ripstop::inline fsi

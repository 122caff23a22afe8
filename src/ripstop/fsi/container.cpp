#include "ripstop/fsi/container.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ripstop/flight/deployment.h"

namespace ripstop::inline fsi {
namespace {

constexpr double lightest = 1e-9;  // a container without mass that is almost empty [kg]

}  // namespace

// m v' = F - c |v| v + m g, implicit in time, so that a light container follows the balance of force and drag.
double move_container(ContainerMotion& motion, const Container& container, double cloth_speed, double length,
                      double density, double gravity) {
  const double inside = container.canopy_mass -
                        emerged_mass(container.canopy_mass, container.canopy_length, motion.farthest, true);
  const double mass = std::max(container.mass + inside, lightest);
  const double c = 0.5 * density * container.drag_area;
  const double momentum = mass * (motion.speed + length * gravity);
  const auto speed_under = [&](double force) {
    const double driven = momentum + length * force;
    return 2 * driven / (mass + std::sqrt(mass * mass + 4 * length * c * std::abs(driven)));
  };
  const bool taut = motion.apart >= motion.farthest;
  const double alone = speed_under(0);
  motion.speed = taut ? std::clamp(cloth_speed, alone, speed_under(container.strip_force)) : alone;
  motion.apart += length * (cloth_speed - motion.speed);
  motion.farthest = std::clamp(motion.apart, motion.farthest, container.canopy_length);
  return (mass * motion.speed - momentum) / length + c * std::abs(motion.speed) * motion.speed;
}

ContainedCloth::ContainedCloth(const Mesh& mesh, const std::vector<Vec3>& folded) {
  double skirt = std::numeric_limits<double>::infinity(), vent = -skirt;
  for (const Patch& patch : mesh.patches) {
    for (int node = patch.first_node; node < patch.first_node + patch.rows * patch.columns; ++node) {
      skirt = std::min(skirt, folded[node].z);
      vent = std::max(vent, folded[node].z);
    }
  }
  for (const Vec3& x : folded) from_skirt_.push_back((x.z - skirt) / (vent - skirt));
}

std::vector<int> ContainedCloth::beyond(double share) const {
  std::vector<int> inside;
  for (std::size_t node = 0; node < from_skirt_.size(); ++node)
    if (from_skirt_[node] > share) inside.push_back(static_cast<int>(node));
  return inside;
}

}  // namespace ripstop::inline fsi

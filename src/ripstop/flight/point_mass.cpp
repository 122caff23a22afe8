#include "ripstop/flight/point_mass.h"

#include <cmath>

namespace ripstop::inline flight {

InPlane acceleration(const PointMass& body, InPlane velocity, double density, double drag_area, double pull) {
  const double speed = std::hypot(velocity.level, velocity.down);
  const double pull_over_speed = pull == 0 ? 0 : pull / speed;
  const double retardation = (0.5 * density * speed * drag_area + pull_over_speed) / body.mass;  // [1/s]
  return {-retardation * velocity.level, body.gravity - retardation * velocity.down};
}

Vec3 drag_force(Vec3 relative_velocity, double density, double drag_area) {
  return -0.5 * density * drag_area * norm(relative_velocity) * relative_velocity;
}

}  // namespace ripstop::inline flight

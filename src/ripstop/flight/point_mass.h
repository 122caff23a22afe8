// The equation of motion of a point mass in the vertical plane of its path, and its drag in space.
#pragma once

#include "ripstop/core/vec3.h"

namespace ripstop::inline flight {

/// A velocity [m/s] or an acceleration [m/s2]: along the ground, and downward.
struct InPlane {
  double level = 0, down = 0;
};

struct PointMass {
  double mass = 0;     // [kg]
  double gravity = 0;  // [m/s2]
};

/// m dv/dt = m g - (D + T) v/|v|,  D = rho |v|^2 (C_D S) / 2: weight, the drag of a drag area [m2] in air of `density`
/// [kg/m3], and a `pull` T [N] against the velocity, such as that of a riser.
InPlane acceleration(const PointMass& body, InPlane velocity, double density, double drag_area,
                     double pull = 0);

/// -rho |v| v (C_D S) / 2 for a velocity v relative to the air [m/s] -> [N]
Vec3 drag_force(Vec3 relative_velocity, double density, double drag_area);

}  // namespace ripstop::inline flight

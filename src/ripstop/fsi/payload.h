// The payload of a coupled opening: a point mass at the riser's end, along whose path the box of the flow flies.
#pragma once

#include <functional>

namespace ripstop::inline fsi {

struct Payload {
  double mass = 0;       // [kg]
  double gravity = 0;    // [m/s2]
  double angle = 90;     // of its path below the horizon at deployment [deg]
  double drag_area = 0;  // its own [m2]
  /// Density so many metres below the place of deployment over that there; empty: 1.
  std::function<double(double)> density_ratio = {};
};

/// Its motion; without a payload the speed is that of the stream and stays the same.
struct PayloadMotion {
  double speed = 0, acceleration = 0, path = 0;  // along the path [m/s], [m/s2], [m]
  double angle = 0, fallen = 0;                  // of the path below the horizon [rad], height lost [m]
};

double density_ratio(const Payload& payload, double fallen);

/// Part of its acceleration of gravity along the path [m/s2].
double gravity_along_path(const Payload& payload, const PayloadMotion& motion);

/// At deployment with `speed` in air of `density`, without pull of the riser; motion.fallen is kept.
void deploy(PayloadMotion& motion, const Payload& payload, double speed, double density);

/// Over one step of `length` [s]: the speed changes by the acceleration of the step before, and weight turns the path. The
/// mean pull of the riser [N] in that step then sets the acceleration of the next one, in air of
/// `density_at_deployment` times the density ratio.
void move_payload(PayloadMotion& motion, const Payload& payload, double pull, double length,
                  double density_at_deployment);

}  // namespace ripstop::inline fsi

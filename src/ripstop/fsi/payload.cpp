#include "ripstop/fsi/payload.h"

#include <cmath>

#include "ripstop/core/angle.h"
#include "ripstop/flight/point_mass.h"

namespace ripstop::inline fsi {
namespace {

/// The acceleration that the equation of motion gives, along the path and across it.
struct AlongPath {
  double along = 0, across = 0;  // [m/s2]
};

AlongPath acceleration_of(const PayloadMotion& motion, const Payload& payload, double pull, double density) {
  const double level = std::cos(motion.angle), down = std::sin(motion.angle);
  const InPlane a = acceleration({payload.mass, payload.gravity}, {motion.speed * level, motion.speed * down},
                                 density, payload.drag_area, pull);
  return {a.level * level + a.down * down, a.down * level - a.level * down};
}

}  // namespace

double density_ratio(const Payload& payload, double fallen) {
  return payload.density_ratio ? payload.density_ratio(fallen) : 1;
}

double gravity_along_path(const Payload& payload, const PayloadMotion& motion) {
  return payload.gravity * std::sin(motion.angle);
}

void deploy(PayloadMotion& motion, const Payload& payload, double speed, double density) {
  motion.speed = speed;
  motion.angle = payload.angle * degree;
  motion.acceleration = acceleration_of(motion, payload, 0, density).along;
}

void move_payload(PayloadMotion& motion, const Payload& payload, double pull, double length,
                  double density_at_deployment) {
  // Only weight acts across the path.
  const double across = acceleration_of(motion, payload, 0, 0).across;
  const double way = length * (motion.speed + 0.5 * length * motion.acceleration);
  const double turn = std::atan2(length * across, motion.speed);
  motion.path += way;
  motion.fallen += way * std::sin(motion.angle + 0.5 * turn);
  motion.speed += length * motion.acceleration;
  motion.angle += turn;
  const double density = density_at_deployment * density_ratio(payload, motion.fallen);
  motion.acceleration = acceleration_of(motion, payload, pull, density).along;
}

}  // namespace ripstop::inline fsi

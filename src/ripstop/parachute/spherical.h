// Hemispherical, quarter-spherical and other caps of a sphere, of flat gores.
#pragma once

#include "ripstop/parachute/family.h"
#include "ripstop/parachute/gore.h"

namespace ripstop::inline parachute {

/// [parachute] with type = "spherical"
struct Spherical {
  static const CanopyFamily family;

  double nominal_diameter_m = 0;
  double vent_diameter_m = 0;
  double half_angle_deg = 90;  // seen from the sphere's middle: 90 a hemisphere, 60 a quarter of the sphere
  bool vent_lines = true;
};

/// A cap of half angle A and area pi/4 D0^2 belongs to a sphere of radius D0 / (2 sqrt(2 (1 - cos A))) [m].
double sphere_radius(double nominal_diameter, double half_angle);

void describe(Fields& fields, Spherical& canopy);
void check_shape(const Spherical& canopy, const Design& design, Findings& findings);
Experience experience(const Spherical& canopy);
/// S0 = pi/4 nominal_diameter^2, the area of the cap with its vent.
GorePattern gore_pattern(const Spherical& canopy, int gores);

}  // namespace ripstop::inline parachute

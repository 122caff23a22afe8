// Projections of a body's force and moment: along and across the wind, and along and across the body's own axis. The
// one place where they are made; definitions as in T. W. Knacke, Parachute Recovery Systems Design Manual (NWC TP
// 6575).
#pragma once

#include "ripstop/core/vec3.h"
#include "ripstop/flow/flow.h"

namespace ripstop::inline flow {

/// Unit vector of a wind that makes `angle` with the z axis, in the plane through z that makes `azimuth` with the x
/// axis [degrees]: (sin a cos b, sin a sin b, cos a).
Vec3 wind_direction(double angle_deg, double azimuth_deg = 0);

/// A vector turned by the shortest way from the z axis to the unit vector `axis`.
Vec3 turned(Vec3 v, Vec3 axis);

/// How a body lies in the wind.
struct Attitude {
  Vec3 axis;  // of a canopy: unit vector from the confluence towards the centroid of the vent
  Vec3 wind;  // velocity of the air relative to the body [m/s]
};

/// Angle of attack: between the axis and the wind [degrees].
double angle_of_attack(const Attitude& attitude);

/// Normal to the axis in the plane of axis and wind, towards the wind: a force along it on the canopy turns the axis
/// into the wind. With the wind along the axis: in the plane of the axis and x (of the axis and y, where the axis is
/// along x).
Vec3 normal_direction(const Attitude& attitude);

/// Of a force on a body [N].
struct ForceComponents {
  double drag = 0;  // along the wind
  double lift = 0;  // normal to the wind in the plane of axis and wind, on the axis' side of it
  double side = 0;  // along wind x lift
  double tangential = 0, normal = 0;  // along the axis; along normal_direction()
};
ForceComponents components(Vec3 force, const Attitude& attitude);

/// Reference quantities of the coefficients of a body.
struct Reference {
  double density = 0;   // [kg/m3]
  double area = 0;      // S0 [m2]
  double diameter = 0;  // D0 [m]
};

struct Coefficients {
  double drag = 0, lift = 0, side = 0;  // C_D, C_L, C_Y
  double tangential = 0;                // C_T = F . e_c / (q S0)
  double normal = 0;  // C_N = F . e_n / (q S0), positive where it reduces the angle of attack
  double moment = 0;  // C_m = M / (q S0 D0), positive where it increases the angle of attack
};
/// The moment is about the point that BodyLoad has it about: for C_m the confluence.
Coefficients coefficients(const BodyLoad& load, const Attitude& attitude, const Reference& reference);

}  // namespace ripstop::inline flow

#include "ripstop/flow/projections.h"

#include <cmath>

#include "ripstop/core/angle.h"

namespace ripstop::inline flow {
namespace {

constexpr double aligned = 1e-9;  // sine of the angle below which axis and wind have no plane

Vec3 unit(Vec3 v) {
  return v / norm(v);
}

/// Part of v normal to a unit vector.
Vec3 across(Vec3 v, Vec3 axis) {
  return v - dot(v, axis) * axis;
}

}  // namespace

Vec3 wind_direction(double angle_deg, double azimuth_deg) {
  if (angle_deg == 0) return {0, 0, 1};
  const double a = angle_deg * degree, b = azimuth_deg * degree;
  return {std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)};
}

// Rodrigues' rotation about z x axis; about x where the axis is -z.
Vec3 turned(Vec3 v, Vec3 axis) {
  if (!(axis.z > -1)) return {v.x, -v.y, -v.z};
  const Vec3 about{-axis.y, axis.x, 0};
  return axis.z * v + cross(about, v) + dot(about, v) / (1 + axis.z) * about;
}

double angle_of_attack(const Attitude& attitude) {
  const Vec3 axis = unit(attitude.axis), wind = unit(attitude.wind);
  return std::atan2(norm(cross(axis, wind)), dot(axis, wind)) / degree;
}

Vec3 normal_direction(const Attitude& attitude) {
  const Vec3 axis = unit(attitude.axis), towards = across(unit(attitude.wind), axis);
  if (norm(towards) > aligned) return unit(towards);
  const Vec3 x = across({1, 0, 0}, axis);
  return unit(norm(x) > aligned ? x : across({0, 1, 0}, axis));
}

ForceComponents components(Vec3 force, const Attitude& attitude) {
  const Vec3 axis = unit(attitude.axis), wind = unit(attitude.wind), normal = normal_direction(attitude);
  // wind = cos(a) axis + sin(a) normal, so that this unit vector is normal to the wind, on the axis' side of it.
  const Vec3 lift = dot(wind, normal) * axis - dot(wind, axis) * normal;
  return {dot(force, wind), dot(force, lift), dot(force, cross(wind, lift)), dot(force, axis),
          dot(force, normal)};
}

Coefficients coefficients(const BodyLoad& load, const Attitude& attitude, const Reference& reference) {
  const double unit_force = 0.5 * reference.density * dot(attitude.wind, attitude.wind) * reference.area;
  const ForceComponents f = components(load.force, attitude);
  const Vec3 away = cross(normal_direction(attitude), unit(attitude.axis));  // turns the axis out of the wind
  return {f.drag / unit_force,   f.lift / unit_force,
          f.side / unit_force,   f.tangential / unit_force,
          f.normal / unit_force, dot(load.moment, away) / (unit_force * reference.diameter)};
}

}  // namespace ripstop::inline flow

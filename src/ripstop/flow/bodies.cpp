#include "ripstop/flow/bodies.h"

#include <cmath>
#include <numbers>

#include "ripstop/flow/projections.h"

namespace ripstop {
namespace {

constexpr int segments = 240;  // of a circle: chords leave it by less than 1e-4 of the radius
constexpr double pi = std::numbers::pi;

void append(std::vector<Triangle>& to, const std::vector<Triangle>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

}  // namespace

std::vector<Triangle> revolve(const std::vector<OutlinePoint>& outline, Vec3 centre, int parts) {
  std::vector<Triangle> surface;
  const auto point = [&](OutlinePoint p, int s) {
    const double angle = 2 * pi * (s % parts) / parts;
    return centre + Vec3{p.radius * std::cos(angle), p.radius * std::sin(angle), p.z};
  };
  for (std::size_t n = 0; n + 1 < outline.size(); ++n) {
    for (int s = 0; s < parts; ++s) {
      const Vec3 a = point(outline[n], s), b = point(outline[n], s + 1);
      const Vec3 c = point(outline[n + 1], s), d = point(outline[n + 1], s + 1);
      if (outline[n].radius > 0) surface.push_back({a, b, d});
      if (outline[n + 1].radius > 0) surface.push_back({a, d, c});
    }
  }
  return surface;
}

std::vector<Triangle> disk(double diameter, Vec3 centre) {
  return revolve({{0, 0}, {diameter / 2, 0}}, centre, segments);
}

std::vector<Triangle> square_plate(double side, Vec3 centre) {
  const double h = side / 2;
  const Vec3 a = centre + Vec3{-h, -h, 0}, b = centre + Vec3{h, -h, 0}, c = centre + Vec3{h, h, 0},
             d = centre + Vec3{-h, h, 0};
  return {{a, b, c}, {a, c, d}};
}

std::vector<Triangle> hemispherical_cup(double diameter, Vec3 centre) {
  std::vector<OutlinePoint> outline;
  constexpr int arcs = segments / 4;
  for (int n = 0; n <= arcs; ++n) {
    const double angle = pi / 2 * n / arcs;
    outline.push_back({n == arcs ? 0 : diameter / 2 * std::cos(angle), diameter / 2 * std::sin(angle)});
  }
  return revolve(outline, centre, segments);
}

std::vector<Triangle> turned(std::vector<Triangle> surface, Vec3 axis) {
  for (Triangle& t : surface)
    for (Vec3* p : {&t.a, &t.b, &t.c}) *p = turned(*p, axis);
  return surface;
}

std::vector<Triangle> rigid_disk_gap_band(Vec3 centre) {
  constexpr double band_radius = 0.32, band_height = 0.28, band_top = 0.09, gap = 0.06;
  constexpr double dome_radius = 0.325, dome_height = 0.18, vent_radius = 0.045;
  std::vector<Triangle> surface =
      revolve({{band_radius, band_top - band_height}, {band_radius, band_top}}, centre, segments);
  std::vector<OutlinePoint> dome;
  const double last = std::acos(vent_radius / dome_radius);
  for (int n = 0; n <= 40; ++n) {
    const double angle = last * n / 40;
    dome.push_back({dome_radius * std::cos(angle), band_top + gap + dome_height * std::sin(angle)});
  }
  append(surface, revolve(dome, centre, segments));
  return surface;
}

}  // namespace ripstop

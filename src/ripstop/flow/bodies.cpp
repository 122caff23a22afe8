#include "ripstop/flow/bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/flow/projections.h"

namespace ripstop::inline flow {
namespace {

constexpr int segments = 240;  // of a circle: chords leave it by less than 1e-4 of the radius
constexpr double pi = std::numbers::pi;

void append(std::vector<Triangle>& to, const std::vector<Triangle>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

constexpr int quarter = segments / 4;

/// A nose in the form of half an ellipsoid of this radius and length, and the points that `rest` adds from there to the aft end at
/// z = 0.
template <class Rest>
std::vector<Triangle> nosed_half(double radius, double nose_length, double length, Vec3 centre, Rest&& rest) {
  std::vector<OutlinePoint> outline = {{0, -length}};
  for (int n = 1; nose_length > 0 && n < quarter; ++n) {
    const double angle = pi / 2 * n / quarter;
    outline.push_back({radius * std::sin(angle), nose_length * (1 - std::cos(angle)) - length});
  }
  outline.push_back({radius, nose_length - length});
  rest(outline);
  return revolve(outline, centre, segments);
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

std::vector<Triangle> sphere(double diameter, Vec3 centre) {
  return nosed_half(diameter / 2, diameter / 2, diameter, centre, [&](std::vector<OutlinePoint>& outline) {
    for (int n = quarter - 1; n >= 0; --n) {
      const double angle = pi / 2 * n / quarter;
      outline.push_back({n == 0 ? 0 : diameter / 2 * std::sin(angle), -diameter / 2 * (1 - std::cos(angle))});
    }
  });
}

std::vector<Triangle> nosed_cylinder(double diameter, double length, double nose_length, Vec3 centre) {
  return nosed_half(diameter / 2, nose_length, length, centre, [&](std::vector<OutlinePoint>& outline) {
    if (length > nose_length) outline.push_back({diameter / 2, 0});
    outline.push_back({0, 0});
  });
}

std::vector<Triangle> capsule(double diameter, double length, double nose_radius, double base, Vec3 centre) {
  const double half = std::asin(std::min(1.0, 0.5 * diameter / nose_radius));
  std::vector<OutlinePoint> outline;
  for (int n = 0; n <= quarter; ++n) {
    const double angle = half * n / quarter;
    outline.push_back(
        {n == 0 ? 0 : nose_radius * std::sin(angle), nose_radius * (1 - std::cos(angle)) - length});
  }
  outline.push_back({base / 2, 0});
  outline.push_back({0, 0});
  return revolve(outline, centre, segments);
}

std::vector<Triangle> block(Vec3 size, Vec3 centre) {
  const auto corner = [&](int n) {
    return centre + Vec3{(n & 1 ? 0.5 : -0.5) * size.x, (n & 2 ? 0.5 : -0.5) * size.y, n & 4 ? 0 : -size.z};
  };
  std::vector<Triangle> surface;
  // Corners of each side, against the clock as seen from outside.
  constexpr int sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                               {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& s : sides) {
    surface.push_back({corner(s[0]), corner(s[1]), corner(s[2])});
    surface.push_back({corner(s[0]), corner(s[2]), corner(s[3])});
  }
  return surface;
}

void check_closed(const std::vector<Triangle>& surface, const std::string& name) {
  // Every edge has two triangles, which pass along it in opposite directions.
  std::map<std::pair<std::array<double, 3>, std::array<double, 3>>, int> edges;
  const auto key = [](Vec3 p) { return std::array<double, 3>{p.x, p.y, p.z}; };
  for (const Triangle& t : surface) {
    for (const auto& [p, q] : {std::pair{t.a, t.b}, std::pair{t.b, t.c}, std::pair{t.c, t.a}}) {
      const auto from = key(p), to = key(q);
      if (from < to) ++edges[{from, to}];
      if (to < from) --edges[{to, from}];
    }
  }
  const double volume = enclosed_by(surface).volume;
  std::size_t open = 0;
  Vec3 at;
  for (const auto& [edge, balance] : edges) {
    if (balance == 0) continue;
    if (open++ == 0)
      at = 0.5 * Vec3{edge.first[0] + edge.second[0], edge.first[1] + edge.second[1],
                      edge.first[2] + edge.second[2]};
  }
  if (surface.empty() || open > 0) {
    throw Error(
        ExitCode::bad_data,
        fmt::format("body \"{}\": its surface is not closed: {} of {} edges do not join two triangles of the "
                    "same orientation, the first at ({:.4g}, {:.4g}, {:.4g}) m; repair the surface",
                    name, open, edges.size(), at.x, at.y, at.z));
  }
  if (!(volume > 0)) {
    throw Error(
        ExitCode::bad_data,
        fmt::format("body \"{}\": the normals of its surface point inward (volume {:.3g} m3); reverse its "
                    "triangles",
                    name, volume));
  }
}

Enclosed enclosed_by(const std::vector<Triangle>& surface) {
  Enclosed sum;
  for (const Triangle& t : surface) {
    const double volume = dot(t.a, cross(t.b, t.c)) / 6;  // of the tetrahedron with the origin
    sum.volume += volume, sum.centre += 0.25 * volume * (t.a + t.b + t.c);
  }
  if (sum.volume != 0) sum.centre = sum.centre / sum.volume;
  return sum;
}

BodyLoad without_displaced_air(BodyLoad load, const FlowBody& body, Vec3 force_on_air) {
  const auto [volume, centre] = enclosed_by(body.surface);
  const Vec3 force = volume * force_on_air;
  load.force -= force, load.moment -= cross(centre - body.moment_about, force);
  return load;
}

double frontal_area(const std::vector<Triangle>& surface) {
  double area = 0;
  for (const Triangle& t : surface) area += 0.25 * std::abs(cross(t.b - t.a, t.c - t.a).z);
  return area;
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

}  // namespace ripstop::inline flow

#include "ripstop/case/bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ripstop/case/case.h"
#include "ripstop/case/settings.h"
#include "ripstop/core/error.h"
#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/extent.h"
#include "ripstop/flow/stl.h"

namespace ripstop::inline cases {
namespace {

constexpr double largest = 100;  // [m]

std::vector<Triangle> surface(const SphereKeys& keys, const Settings&) {
  return sphere(keys.diameter_m, {});
}
std::vector<Triangle> surface(const CylinderKeys& keys, const Settings&) {
  return nosed_cylinder(keys.diameter_m, keys.length_m, keys.nose_length_m, {});
}
std::vector<Triangle> surface(const CapsuleKeys& keys, const Settings&) {
  return capsule(keys.diameter_m, keys.length_m, keys.nose_radius_m, keys.base_diameter_m, {});
}
std::vector<Triangle> surface(const BoxKeys& keys, const Settings&) {
  return block(keys.size_m, {});
}
std::vector<Triangle> surface(const StlKeys& keys, const Settings& resolved) {
  std::vector<Triangle> triangles = read_stl(resolved.file().parent_path() / keys.file);
  const Extent extent = extent_of(triangles);
  const Vec3 aft = {0.5 * (extent.low[0] + extent.high[0]), 0.5 * (extent.low[1] + extent.high[1]),
                    extent.high[2]};
  for (Triangle& t : triangles)
    for (Vec3* p : {&t.a, &t.b, &t.c}) *p = keys.scale * (*p - aft);
  return triangles;
}

}  // namespace

void describe(Fields& fields, SphereKeys& keys) {
  fields.number("diameter_m", keys.diameter_m, above(0).up_to(largest), "Diameter.").required();
}

void describe(Fields& fields, CylinderKeys& keys) {
  fields.number("diameter_m", keys.diameter_m, above(0).up_to(largest), "Diameter.").required();
  fields.number("length_m", keys.length_m, above(0).up_to(largest), "Length with the nose.").required();
  fields.number("nose_length_m", keys.nose_length_m, from(0).up_to(largest),
                "Length of the nose, half an ellipsoid; 0: flat front.");
}

void describe(Fields& fields, CapsuleKeys& keys) {
  fields.number("diameter_m", keys.diameter_m, above(0).up_to(largest), "Largest diameter.").required();
  fields.number("length_m", keys.length_m, above(0).up_to(largest), "Length.").required();
  fields
      .number("nose_radius_m", keys.nose_radius_m, above(0).up_to(largest),
              "Radius of the spherical front, at least half the diameter.")
      .required();
  fields.number("base_diameter_m", keys.base_diameter_m, from(0).up_to(largest), "Diameter of the flat base.")
      .required();
}

void describe(Fields& fields, BoxKeys& keys) {
  fields.vector("size_m", keys.size_m, above(0).up_to(largest), "Width, height, length along the flow.")
      .required();
}

void describe(Fields& fields, StlKeys& keys) {
  fields
      .text("file", keys.file, 1000,
            "Closed surface as STL, relative to the case file. Its z axis lies along the stream, its nose at "
            "the smallest z.")
      .required();
  fields.number("scale", keys.scale, above(0).up_to(1000),
                "Length of one unit of the file in metres: 0.001 for millimetres.");
}

void describe(Fields& fields, BodyKeys& keys) {
  fields
      .number("trailing_distance_m", keys.trailing_distance_m, above(0).up_to(1000),
              "Distance from the aft end of the body to the skirt of the undeformed start shape.")
      .absent("approximately the distance from the skirt to the end of the riser");
  fields.number("x_m", keys.x_m, from(-largest).up_to(largest),
                "Position of the axis of the body relative to that of the canopy, along x.");
  fields.number("y_m", keys.y_m, from(-largest).up_to(largest), "The same along y.");
  fields
      .number("reference_area_m2", keys.reference_area_m2, above(0).up_to(1e4),
              "Reference area of the drag coefficient of the body.")
      .absent("frontal area");
  fields.kind("shape", keys.shape, {"sphere", "cylinder", "capsule", "box", "stl"},
              "Shape of the rigid body, which is impermeable.");
}

void check_bodies(const Case& given, PorosityModel model, Findings& findings) {
  for (const auto& [name, keys] : given.bodies) {
    const std::string table = "body." + name;
    if (!findings.sound({table})) continue;
    if (name == "canopy")
      findings.add(table, "", "", "the canopy itself has this name; choose another one for the body");
    if (model != PorosityModel::sheet)
      findings.add("flow.porosity_model", "\"paper\"", "\"sheet\"",
                   fmt::format("the body \"{}\" needs the sheet model", name));
    const auto at_most = [&](const char* key, double value, double limit, const char* why) {
      if (value > limit) findings.add(table + "." + key, value, fmt::format("at most {:g}", limit), why);
    };
    if (const auto* c = std::get_if<CylinderKeys>(&keys.shape))
      at_most("nose_length_m", c->nose_length_m, c->length_m, "the length includes the nose");
    if (const auto* s = std::get_if<CapsuleKeys>(&keys.shape)) {
      at_most("base_diameter_m", s->base_diameter_m, s->diameter_m,
              "the base must not be wider than the capsule");
      if (s->nose_radius_m < 0.5 * s->diameter_m) {
        findings.add(table + ".nose_radius_m", s->nose_radius_m,
                     fmt::format("at least {:g}", 0.5 * s->diameter_m),
                     "a smaller sphere does not reach the edge of the capsule");
      } else {
        const double r = s->nose_radius_m, half = 0.5 * s->diameter_m,
                     front = r - std::sqrt(r * r - half * half);
        if (s->length_m <= front)
          findings.add(table + ".length_m", s->length_m, fmt::format("above {:.4g}", front),
                       "the spherical front alone has this length");
      }
    }
  }
}

BodySize size_of(const BodyKeys& keys) {
  struct {
    BodySize operator()(const SphereKeys& s) const { return {s.diameter_m, s.diameter_m}; }
    BodySize operator()(const CylinderKeys& c) const { return {c.length_m, c.diameter_m}; }
    BodySize operator()(const CapsuleKeys& c) const { return {c.length_m, c.diameter_m}; }
    BodySize operator()(const BoxKeys& b) const { return {b.size_m.z, std::max(b.size_m.x, b.size_m.y)}; }
    BodySize operator()(const StlKeys&) const { return {}; }
  } size;
  return std::visit(size, keys.shape);
}

double usual_trailing_distance(const Design& parachute) {
  const double length = parachute.lines.length_m, radius = 0.5 * inflated_diameter(parachute);
  return std::sqrt(std::max(0.0, length * length - radius * radius)) + parachute.riser.length_m;
}

BodiesAhead bodies_ahead(const Case& given) {
  BodiesAhead ahead;
  const double usual = usual_trailing_distance(given.parachute);
  for (const auto& [name, body] : given.bodies) {
    const BodySize size = size_of(body);
    ahead.front = std::max(ahead.front, body.trailing_distance_m.value_or(usual) + size.length);
    ahead.width = std::max(ahead.width, size.width);
  }
  return ahead;
}

std::vector<FlowBody> rigid_bodies(const Settings& resolved) {
  std::vector<FlowBody> rigid;
  for (const auto& [name, keys] : resolved.written().bodies) {
    std::vector<Triangle> triangles =
        std::visit([&](const auto& shape) { return surface(shape, resolved); }, keys.shape);
    check_closed(triangles, name);
    const Vec3 aft = {keys.x_m, keys.y_m,
                      resolved.flow().canopy_position_m - keys.trailing_distance_m.value()};
    for (Triangle& t : triangles)
      for (Vec3* p : {&t.a, &t.b, &t.c}) *p += aft;
    rigid.push_back(sheet_body(std::move(triangles), impermeable, name));
    rigid.back().moment_about = aft;
  }
  return rigid;
}

double reference_area(const Settings& resolved, const FlowBody& body) {
  return resolved.written().bodies.at(body.name).reference_area_m2.value_or(frontal_area(body.surface));
}

}  // namespace ripstop::inline cases

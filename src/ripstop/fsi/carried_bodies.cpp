#include "ripstop/fsi/carried_bodies.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "ripstop/flow/bodies.h"

namespace ripstop::inline fsi {
namespace {

/// The rotation of one unit vector to another by the shortest way (Rodrigues).
struct Turn {
  Vec3 axis;  // times the sine of the angle
  double cosine;

  Turn(Vec3 from, Vec3 to) : axis(cross(from, to)), cosine(dot(from, to)) {}
  Vec3 operator()(Vec3 v) const {
    return cosine * v + cross(axis, v) + (dot(axis, v) / std::max(1 + cosine, 1e-9)) * axis;
  }
  Vec3 back(Vec3 v) const {
    return cosine * v - cross(axis, v) + (dot(axis, v) / std::max(1 + cosine, 1e-9)) * axis;
  }
};

/// Angular velocity of a body that turns from one attitude to the next within `length` [s], by a small angle [rad/s].
Vec3 spin_between(const Turn& now, const Turn& next, double length) {
  const auto moved = [&](Vec3 v) { return next(now.back(v)); };
  const Vec3 x = moved({1, 0, 0}), y = moved({0, 1, 0}), z = moved({0, 0, 1});
  return Vec3{y.z - z.y, z.x - x.z, x.y - y.x} / (2 * length);
}

void shift(std::vector<Triangle>& surface, Vec3 by) {
  for (Triangle& t : surface)
    for (Vec3* p : {&t.a, &t.b, &t.c}) *p += by;
}

bool within(const Extent& inner, const Extent& outer) {
  for (std::size_t a = 0; a < 3; ++a)
    if (inner.low[a] < outer.low[a] || inner.high[a] > outer.high[a]) return false;
  return true;
}

}  // namespace

CarriedBodies::CarriedBodies(const std::vector<FlowBody>& bodies, Pose start)
    : first_line_(start.line), bodies_(bodies.begin() + 1, bodies.end()) {
  for (FlowBody& body : bodies_) {
    first_about_.push_back(body.moment_about);
    shift(body.surface, -start.payload);
    body.moment_about -= start.payload;
  }
}

std::vector<Placement> CarriedBodies::placed(const Pose& now, const Pose& next, double length) const {
  const Turn turned(first_line_, now.line), turning(first_line_, next.line);
  const RigidMotion motion{(next.payload - now.payload) / length, spin_between(turned, turning, length),
                           now.payload};
  std::vector<Placement> placed;
  for (const FlowBody& body : bodies_) {
    Placement& one = placed.emplace_back(Placement{placed.size() + 1, body.surface, {}});
    for (Triangle& t : one.surface)
      for (Vec3* p : {&t.a, &t.b, &t.c}) *p = now.payload + turned(*p);
    one.motion.rigid = motion;
  }
  return placed;
}

std::vector<FlightBodyRow> CarriedBodies::rows(const Pose& now, const std::vector<Placement>& placed,
                                               const BodiesInStep& step) const {
  const Turn turned(first_line_, now.line);
  const double speed = norm(step.stream);
  const Vec3 along = step.stream / speed;
  std::vector<FlightBodyRow> rows;
  for (std::size_t n = 0; n < bodies_.size(); ++n) {
    FlightBodyRow row;
    row.body = static_cast<double>(n + 1);
    row.aft = now.payload + turned(bodies_[n].moment_about);
    FlowBody body = sheet_body(placed[n].surface, impermeable);
    body.moment_about = row.aft;
    BodyLoad load = step.loads.at(n + 1);
    load.moment += cross(first_about_[n] - row.aft, load.force);
    load = without_displaced_air(load, body, step.density * (step.stream_gains - step.payload_gains));
    row.force = load.force, row.moment = load.moment;
    row.drag = dot(load.force, along), row.side = norm(load.force - row.drag * along);
    row.drag_area = row.drag / (0.5 * step.density * speed * speed);
    const double cosine = dot(turned({0, 0, 1}), along);
    row.incidence = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
    row.resolved = within(extent_of(placed[n].surface), step.fine);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace ripstop::inline fsi

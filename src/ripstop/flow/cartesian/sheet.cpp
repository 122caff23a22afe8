#include "ripstop/flow/cartesian/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/flow/cartesian/solid_faces.h"
#include "ripstop/flow/cartesian/state.h"
#include "ripstop/flow/cartesian/wall_distance.h"

namespace ripstop::inline flow::cartesian {
namespace {

double along(int axis, Vec3 v) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// Of a face and the sheet that it represents, for a compliance as it is: 45 degrees between them. The load of a
/// steeper face is distributed over cloth nearby, which responds to it more than the sheet of this face would. A larger
/// compliance keeps the coupling stable and does not change the drop once it is steady.
constexpr double widest_spread = 1.41421356;

/// Common part of two velocities: their harmonic mean, zero for opposite signs.
double shared(double a, double b) {
  return a * b > 0 ? 2 * a * b / (a + b) : 0;
}

/// From a cell to the next one along an axis.
std::ptrdiff_t next_along(int axis, const Layout& layout) {
  return axis == 0 ? 1 : axis == 1 ? layout.stride_y : layout.stride_z;
}

Vec3 centre_of(const SheetFace& face, const std::array<const Axis*, 3>& axes) {
  const std::array<int, 3> cell{face.i, face.j, face.k};
  std::array<double, 3> at{};
  for (std::size_t a = 0; a < 3; ++a)
    at[a] = axes[a]->edge[cell[a]] + (static_cast<int>(a) == face.axis ? 0 : 0.5 * axes[a]->width[cell[a]]);
  return {at[0], at[1], at[2]};
}

/// The cells on either side of a face.
std::pair<std::ptrdiff_t, std::ptrdiff_t> cells(const SheetFace& g, const Layout& layout) {
  const std::ptrdiff_t high = layout.at(g.i, g.j, g.k);
  return {high - next_along(g.axis, layout), high};
}

/// From a cell to the next one on the side that the sheet's normal looks to, along the axis that is nearest to it.
std::ptrdiff_t off_the_sheet(Vec3 normal, const Layout& layout) {
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  return (along(axis, normal) < 0 ? -1 : 1) * next_along(axis, layout);
}

/// Of the steps of a staircase of faces, whose axis lies within 30 degrees of the cloth: below this.
constexpr double step_normal = 0.5;

/// Share of the change of slope of the air velocity at a moving sheet, chosen for the drag of a drifting disk: 0 and
/// 0.5 give larger oscillations as the disk moves from face to face.
constexpr double kinked = 0.25;

constexpr double least_jet = 0.25;  // of U, in the slope only: the answer does not depend on it

struct Cover {
  double share = 1, steep = 1;
};

// At a free edge a sheet covers only the part c of a face. Air that passes through the rest at v / (1 - c) loses its
// jet, rho / 2 (v / (1 - c) - v)^2 (Borda and Carnot); that resistance, over v, is in parallel to c times that of the
// cloth. `share` is the remaining part of the drop of the cloth; `steep` is the slope of the drop over v, divided by
// its ratio to v.
Cover cover_of(double c, double resistance, double density, double speed) {
  if (c >= 1) return {};
  const double ratio = c / (1 - c), jet = 0.5 * density * speed * ratio * ratio;
  const double cloth = c * resistance, both = jet + cloth;
  if (both <= 0) return {c, 1};
  return {c * jet / both, (jet + 2 * cloth) / both};
}

/// A resistance in series with cloth of the compliance `yields` per unit of drop.
double giving_way(double resistance, double yields) {
  return resistance / (1 + yields * resistance);
}

/// v of v + `yields` (a + b |v|) v = given velocity.
double passing(double asked, double yields, const PressureDrop& law) {
  const double linear = 1 + yields * law.linear;
  return 2 * asked / (linear + std::sqrt(linear * linear + 4 * yields * law.quadratic * std::abs(asked)));
}

}  // namespace

SheetRows::SheetRows(const Axis& x, const Axis& y, const Axis& z, const std::vector<FlowBody>& bodies,
                     bool quarter, ThreadTeam* team)
    : nx_(x.n), ny_(y.n), nz_(z.n), quarter_(quarter) {
  add_faces(x, y, z, bodies, team);
  if (faces_.empty()) return;
  double across = 0;
  for (const Face& face : faces_)
    across += face.geometry.axis == 2 && !face.geometry.enclosed ? face.area : 0;
  shut_ = across > 0.9 * (x.edge.back() - x.edge.front()) * (y.edge.back() - y.edge.front());
  lay_out();
}

void SheetRows::add_faces(const Axis& x, const Axis& y, const Axis& z, const std::vector<FlowBody>& bodies,
                          ThreadTeam* team) {
  for (int s = 0; s < static_cast<int>(bodies.size()); ++s) {
    const FlowBody& sheet = bodies[s];
    if (!sheet.is_sheet()) continue;
    const PressureDrop& law = sheet.drop();
    const auto fits = [](double value) { return std::isfinite(value) && value >= 0; };
    if (!fits(law.linear) || !fits(law.quadratic)) {
      throw Error(ExitCode::bad_data,
                  fmt::format("sheet: a = {} Pa s/m and b = {} Pa s2/m2 must be finite and not negative",
                              law.linear, law.quadratic));
    }
    const SheetMotion& motion = sheet.motion;
    for (const std::size_t count : {motion.velocity.size(), motion.yields.size(), motion.pressure.size()}) {
      if (count != 0 && count != sheet.surface.size())
        throw Error(ExitCode::bad_data,
                    fmt::format("sheet: the motion of {} triangles for {}", count, sheet.surface.size()));
    }
    if (!quarter_) {
      for (const SheetFace& geometry : faces_of(x, y, z, sheet, team))
        faces_.push_back(face_of(geometry, s, sheet, {&x, &y, &z}));
      continue;
    }
    std::vector<SheetFace> found = faces_of(whole_of(x), whole_of(y), z, sheet, team);
    const std::vector<std::array<int, images>> triangles = take_quarter(found, nx_, ny_);
    for (std::size_t n = 0; n < found.size(); ++n) {
      const SheetFace& g = found[n];
      Face& face = faces_.emplace_back(face_of(g, s, sheet, {&x, &y, &z}));
      face.triangle = triangles[n];
      face.in_plane = (g.axis == 0 && g.i == 0) || (g.axis == 1 && g.j == 0);
    }
  }
}

SheetRows::Face SheetRows::face_of(const SheetFace& geometry, int body, const FlowBody& sheet,
                                   const std::array<const Axis*, 3>& axes) const {
  const auto& [x, y, z] = axes;
  const SheetMotion& motion = sheet.motion;
  Face face;
  face.geometry = geometry;
  face.body = body;
  face.law = sheet.drop();
  const SheetFace& g = face.geometry;
  const Axis& axis = *axes[static_cast<std::size_t>(g.axis)];
  const int c = g.axis == 0 ? g.i : g.axis == 1 ? g.j : g.k;
  if (motion.rigid) {
    face.moves = true, face.velocity = motion.rigid->at(centre_of(g, axes));
  } else if (!motion.velocity.empty()) {
    face.geometry.normal = geometry.across;
    face.moves = true, face.velocity = motion.velocity[g.triangle];
    const double off = along(g.axis, g.point) - axis.edge[c];
    face.beyond = off * axis.inverse_width[off > 0 ? c : c - 1];
    if (c < 3 || c + 3 > axis.n) face.beyond = 0;
  }
  if (face.moves) face.apart = 1 / axis.inverse_distance[c];
  if (!motion.yields.empty()) face.yields = motion.yields[g.triangle];
  if (!motion.pressure.empty()) face.known = (g.against ? -1 : 1) * motion.pressure[g.triangle];
  face.area = (g.axis == 0 ? 1 : x->width[g.i]) * (g.axis == 1 ? 1 : y->width[g.j]) *
              (g.axis == 2 ? 1 : z->width[g.k]);
  face.cover = g.cover;
  face.spread = (face.moves ? face.cover : 1) * face.area / std::max(g.area, 1e-2 * face.area);
  face.yields *= std::max(1.0, face.spread / widest_spread);
  return face;
}

void SheetRows::lay_out() {
  const std::size_t rows = static_cast<std::size_t>(ny_ + 1) * (nz_ + 1),
                    width = static_cast<std::size_t>(nx_) + 1;
  offset_.assign(3, std::vector<std::size_t>(rows, 0));
  touched_.assign(rows, 0);
  std::size_t size = width;  // the row of zeros
  for (Face& face : faces_) {
    const SheetFace& g = face.geometry;
    std::size_t& at = offset_[g.axis][row(g.j, g.k)];
    if (at == 0) at = size, size += width;
    face.at = at + g.i;
    touched_[row(g.j, g.k)] = 1;
    if (g.axis == 1 && g.j > 0) touched_[row(g.j - 1, g.k)] = 1;
    if (g.axis == 2) touched_[row(g.j, g.k - 1)] = 1;
  }
  law_.assign(size, 0);
  excess_.assign(size, 0);
  stiffness_.assign(size, 0);
  std::vector<double> covered(size, 0);
  for (const Face& face : faces_) covered[face.at] += face.cover;
  for (Face& face : faces_) {
    face.layer = face.cover / covered[face.at];
    // Between two layers the air's velocity is not that beyond both of them.
    const SheetFace& g = face.geometry;
    const int next = face.beyond > 0 ? 1 : -1;
    const std::size_t row_at =
        offset_[g.axis][row(g.j + (g.axis == 1 ? next : 0), g.k + (g.axis == 2 ? next : 0))];
    if (face.beyond != 0 && row_at != 0 && covered[row_at + g.i + (g.axis == 0 ? next : 0)] > 0)
      face.beyond = 0;
  }
  std::vector<std::pair<Face*, Face*>> outermost(size);  // of the layers that part the same two centres
  for (Face& face : faces_) {
    auto& [low, high] = outermost[face.at];
    const auto place = [](const Face* f) { return along(f->geometry.axis, f->geometry.point); };
    if (!low || place(&face) < place(low)) low = &face;
    if (!high || place(&face) > place(high)) high = &face;
  }
  for (const auto& [low, high] : outermost)
    if (low) low->lowest = high->highest = true;
}

void SheetRows::begin(State& state, const Layout& layout) const {
  state.held.assign(law_.size(), 0);
  state.change.assign(law_.size(), 0);
  state.drop.assign(faces_.size(), 0);
  for (const Face& face : faces_) {
    const auto [low, high] = cells(face.geometry, layout);
    state.held[face.at] = face.in_plane ? 0 : state.f.p[low] - state.f.p[high];
  }
}

void SheetRows::begin(State& state, const Layout& layout, const SheetRows& before) const {
  const std::vector<double> held = std::move(state.held), change = std::move(state.change);
  begin(state, layout);
  std::vector<char> parted(before.law_.size(), 0);
  for (const Face& face : before.faces_) parted[face.at] = 1;
  for (const Face& face : faces_) {
    const SheetFace& g = face.geometry;
    const std::size_t row_at = before.offset(g.axis, g.j, g.k), old = row_at + g.i;
    if (row_at > 0 && parted[old] != 0) state.held[face.at] = held[old] + change[old];
  }
}

void SheetRows::update(State& state, const Layout& layout, double momentum, double step) {
  const Fields& fields = state.f;
  for (const Face& face : faces_) {
    state.held[face.at] += std::exchange(state.change[face.at], 0.0);
    excess_[face.at] = stiffness_[face.at] = 0;
  }
  for (Face& face : faces_) {
    const SheetFace& g = face.geometry;
    const std::pair sides = cells(g, layout);
    const std::ptrdiff_t low = sides.first, high = sides.second;  // a lambda of clang 14 takes no binding
    const Array<double>& flux = g.axis == 0 ? fields.fx : g.axis == 1 ? fields.fy : fields.fz;
    const double density = 0.5 * (fields.rho[low] + fields.rho[high]);
    // The law applies to the velocity normal to the sheet. The velocity of a cell along the sheet crosses the face
    // freely: the faces of slanted cloth are stepped, and flow along the cloth must not be obstructed by the steps.
    const auto sliding = [&](std::ptrdiff_t cell) {
      const Vec3 velocity = Vec3{fields.u[cell], fields.v[cell], fields.w[cell]} - face.velocity;
      return along(g.axis, velocity) - dot(g.normal, velocity) / face.spread;
    };
    // Not for a solid body, along which nothing slides into its inside, nor for a moving sheet: its tangential velocity
    // is that of the last step, in cells through which it moves. At a step of the staircase the flux through the face
    // determines the velocity of the adjacent cells, which would feed back into its own tangential-velocity estimate:
    // the next cells are used instead.
    const bool at_step = face.cover == 1 && along(g.axis, g.normal) < step_normal;
    const std::ptrdiff_t off = at_step ? off_the_sheet(g.normal, layout) : 0;
    const double slides = face.moves || g.solid ? 0 : shared(sliding(low - off), sliding(high + off));
    const double goes = along(g.axis, face.velocity);
    double through = face.spread * (flux[high] / density - goes - slides);
    // A moving sheet is not at its face but between it and the next one. The velocity in the law is interpolated to
    // its position, else the air would receive an impulse whenever the sheet enters another cell.
    if (face.beyond != 0) {
      // Of faces that no sheet parts, so many further along the axis.
      const auto at_face = [&](int n) {
        const std::ptrdiff_t above = high + n * (high - low);
        return face.spread *
               (flux[above] / density - goes - 0.5 * (sliding(above) + sliding(above - (high - low))));
      };
      const int way = face.beyond > 0 ? 1 : -1;
      const double share = std::abs(face.beyond), next = at_face(way);
      const double kink = at_face(-way) - through - next + at_face(2 * way);
      through += share * (next - through) - kinked * share * (1 - share) * kink;
    }
    const double yields = face.yields, asked = through + yields * face.known;
    const double speed = std::abs(yields > 0 ? passing(asked, yields, face.law) : through);
    const double resistance = giving_way(face.law.linear + face.law.quadratic * speed, yields),
                 steepness = giving_way(face.law.linear + 2 * face.law.quadratic * speed, yields);
    const Cover beside = cover_of(face.cover, resistance, density, std::abs(through));
    // A jet that has yet to start, or that turns back, would offer no slope at all.
    const Cover brisk = cover_of(face.cover, resistance, density,
                                 std::max(std::abs(through), least_jet * momentum / density));
    face.drop = beside.share * resistance * asked;
    face.slope = brisk.share * brisk.steep * steepness * face.spread;
    excess_[face.at] += face.drop;
    stiffness_[face.at] += face.slope;
  }
  for (const Face& face : faces_) law_[face.at] = face.in_plane ? 0 : excess_[face.at];
  for (const Face& face : faces_) excess_[face.at] = law_[face.at] - state.held[face.at];
  if (step > 0) hold_in_the_middle(state, layout, step);
}

// The drop acts during the whole step, so for second order in time it is that of the velocity in the middle of the
// step, the mean of old and new. With s = step slope / (rho h), h between the centres, a flux that is off by 1 is off
// by (1 - (1 - share) s) / (1 + share s) at the next step; beyond s = 2 the share is such that this is 0.
void SheetRows::hold_in_the_middle(const State& state, const Layout& layout, double step) {
  std::vector<double>& share = middle_;
  share.assign(stiffness_.size(), 0);
  for (const Face& face : faces_) {
    if (!face.moves || share[face.at] > 0) continue;
    const auto [low, high] = cells(face.geometry, layout);
    const double density = 0.5 * (state.f.rho[low] + state.f.rho[high]);
    share[face.at] = std::max(0.5, 1 - density * face.apart / (step * stiffness_[face.at]));
    stiffness_[face.at] *= share[face.at];
  }
  for (Face& face : faces_)
    if (face.moves) face.slope *= share[face.at];
}

// Layers between the same two centres, as in a fold, have the same flux: they share the drop of the face in
// proportion to their covered parts, and move with their own compliance.
void SheetRows::settle(State& state) const {
  for (std::size_t n = 0; n < faces_.size(); ++n) {
    const Face& face = faces_[n];
    const double whole = state.held[face.at] + state.change[face.at];
    state.drop[n] = face.yields > 0 && stiffness_[face.at] > 0
                        ? face.drop + face.slope / stiffness_[face.at] * (whole - law_[face.at])
                        : face.layer * whole;
  }
}

Array<double> SheetRows::distance(const Axis& x, const Axis& y, const Axis& z, const Layout& layout,
                                  ThreadTeam* team) const {
  std::vector<Vec3> points;
  points.reserve(faces_.size());
  for (const Face& face : faces_) points.push_back(face.geometry.point);
  WallDistance wall(x, y, z, std::move(points));
  for (int f = 0; f < static_cast<int>(faces_.size()); ++f) {
    const SheetFace& g = faces_[f].geometry;
    wall.offer(g.i, g.j, g.k, f);
    if (!faces_[f].in_plane) wall.offer(g.i - (g.axis == 0), g.j - (g.axis == 1), g.k - (g.axis == 2), f);
  }
  wall.sweep(team);
  const auto least = [](const Axis& axis) { return *std::min_element(axis.width.begin(), axis.width.end()); };
  const double floor = 0.5 * std::min({least(x), least(y), least(z)});
  Array<double> result(layout.values(), floor);
  for (int k = 0; k < nz_; ++k) {
    for (int j = 0; j < ny_; ++j) {
      for (int i = 0; i < nx_; ++i)
        result[layout.at(i, j, k)] = std::max(floor, std::sqrt(wall.square(i, j, k)));
    }
  }
  return result;
}

SheetLoad SheetRows::load_on(const Face& face, double drop, const State& state, const Layout& layout) const {
  const SheetFace& g = face.geometry;
  SheetLoad load;
  load.body = face.body;
  load.triangle = g.triangle;
  load.point = g.point;
  load.outward = g.outward;
  load.drop = g.against ? -drop : drop;
  load.cover = face.cover;
  const double force = drop * face.area;
  load.force = {g.axis == 0 ? force : 0, g.axis == 1 ? force : 0, g.axis == 2 ? force : 0};
  if (g.enclosed) return load;
  load.area = face.cover * face.area * along(g.axis, g.normal);
  const auto [below, above] = cells(g, layout);
  const double mean = 0.5 * (state.f.p[below] + state.f.p[above]),
               half = 0.5 * (state.held[face.at] + state.change[face.at]);
  if (face.lowest) (g.against ? load.outside : load.inside) = mean + half;
  if (face.highest) (g.against ? load.inside : load.outside) = mean - half;
  return load;
}

std::vector<SheetLoad> SheetRows::loads(const State& state, const Layout& layout) const {
  std::vector<SheetLoad> result;
  result.reserve((quarter_ ? images : 1) * faces_.size());
  for (std::size_t n = 0; n < faces_.size(); ++n) {
    const Face& face = faces_[n];
    const SheetLoad load = load_on(face, state.drop[n], state, layout);
    if (quarter_)
      add_images(load, face.triangle, face.in_plane ? 1 << face.geometry.axis : 0, result);
    else
      result.push_back(load);
  }
  return result;
}

}  // namespace ripstop::inline flow::cartesian

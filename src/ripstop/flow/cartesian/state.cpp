#include "ripstop/flow/cartesian/state.h"

#include <algorithm>

#include "ripstop/core/thread_team.h"
#include "ripstop/flow/cartesian/discretisation.h"

namespace ripstop::inline flow::cartesian {
namespace {

/// Weights of two values of an axis (ghosts included) around a point of another one.
struct Pair {
  int low;
  double high_weight;
};

/// Where the centres or faces of `to` lie among those of `from`; ghost centres are as far beyond the ends as
/// the outermost centres lie inside.
std::vector<Pair> pairs(const Axis& to, const Axis& from, bool faces) {
  const auto place = [faces](const Axis& axis, int c) {
    if (faces) return axis.edge[c];
    if (c < 0) return axis.edge[0] - 0.5 * axis.width[0];
    if (c >= axis.n) return axis.edge[axis.n] + 0.5 * axis.width[axis.n - 1];
    return 0.5 * (axis.edge[c] + axis.edge[c + 1]);
  };
  std::vector<Pair> result(to.n + 1);
  const int least = faces ? 0 : -1;
  int low = least;
  for (int c = 0; c < to.n + (faces ? 1 : 0); ++c) {
    const double x = place(to, c);
    while (low + 1 < from.n && place(from, low + 1) <= x) ++low;
    const double a = place(from, low), b = place(from, low + 1);
    result[c] = {low, std::clamp((x - a) / (b - a), 0.0, 1.0)};
  }
  return result;
}

/// Along one axis: the pairs, and how many values there are to fill.
struct Along {
  const std::vector<Pair>& pair;
  int count;
};

void interpolate_field(const Array<double>& from, const Layout& of, Array<double>& to, const Layout& on,
                       Along x, Along y, IndexRange planes, const std::vector<Pair>& z) {
  for (int k = planes.begin; k < planes.end; ++k) {
    for (int j = 0; j < y.count; ++j) {
      for (int i = 0; i < x.count; ++i) {
        double value = 0;
        for (int corner = 0; corner < 8; ++corner) {
          const int a = corner & 1, b = corner >> 1 & 1, c = corner >> 2;
          const double weight = (a ? x.pair[i].high_weight : 1 - x.pair[i].high_weight) *
                                (b ? y.pair[j].high_weight : 1 - y.pair[j].high_weight) *
                                (c ? z[k].high_weight : 1 - z[k].high_weight);
          if (weight != 0) value += weight * from[of.at(x.pair[i].low + a, y.pair[j].low + b, z[k].low + c)];
        }
        to[on.at(i, j, k)] = value;
      }
    }
  }
}

}  // namespace

State::State(const Layout& layout) {
  for (Array<double>* field : {&f.u, &f.v, &f.w, &f.p, &f.rho, &f.k, &f.omega, &f.fx, &f.fy, &f.fz, &limit})
    *field = Array<double>(layout.values());
  std::fill(limit.begin(), limit.end(), 1.0);
  outlet_p = Array<double>(static_cast<std::size_t>(layout.stride_z));
}

void stop_the_clock(State& s) {
  s.rate_u = s.rate_v = s.rate_w = {};
  s.correction = {};
  s.clock = {};
}

bool fits(const State& a, const State& b) {
  std::vector<std::size_t> sizes[2];
  int which = 0;
  const auto note = [&](const auto& value) {
    if constexpr (requires { value.data(); }) sizes[which].push_back(value.size());
  };
  each_carried(a, note);
  which = 1;
  each_carried(b, note);
  return sizes[0] == sizes[1];
}

void interpolate(const State& from, const Discretisation& of, State& to, const Discretisation& on, int rank,
                 int ranks) {
  const auto cx = pairs(on.x, of.x, false), cy = pairs(on.y, of.y, false), cz = pairs(on.z, of.z, false);
  const auto ex = pairs(on.x, of.x, true), ey = pairs(on.y, of.y, true), ez = pairs(on.z, of.z, true);
  const FlowGrid& g = on.grid;
  const IndexRange planes = part_of(g.nz, rank, ranks), faces = part_of(g.nz + 1, rank, ranks);
  const Along x{cx, g.nx}, y{cy, g.ny};
  const Fields& a = from.f;
  Fields& b = to.f;
  const auto centres = [&](const Array<double>& q, Array<double>& result) {
    interpolate_field(q, of.layout, result, on.layout, x, y, planes, cz);
  };
  centres(a.u, b.u), centres(a.v, b.v), centres(a.w, b.w), centres(a.p, b.p);
  // A constant density remains constant: no iteration would correct the error of the interpolation where two
  // sides of the box meet.
  if (on.settings.compressible) centres(a.rho, b.rho);
  centres(a.k, b.k), centres(a.omega, b.omega);
  interpolate_field(a.fx, of.layout, b.fx, on.layout, {ex, g.nx + 1}, y, planes, cz);
  interpolate_field(a.fy, of.layout, b.fy, on.layout, x, {ey, g.ny + 1}, planes, cz);
  interpolate_field(a.fz, of.layout, b.fz, on.layout, x, y, faces, ez);
}

// The same flow at another speed and density, except for effects of Reynolds and Mach number.
void scale(State& s, const Freestream& from, const Freestream& to) {
  const double speed = to.speed() / from.speed(), density = to.density / from.density;
  const double pressure = density * speed * speed, flux = density * speed;
  const auto by = [](auto& values, double factor) {
    for (double& value : values) value *= factor;
  };
  Fields& f = s.f;
  by(f.u, speed), by(f.v, speed), by(f.w, speed), by(f.p, pressure), by(f.rho, density);
  by(f.k, speed * speed), by(f.omega, speed), by(f.fx, flux), by(f.fy, flux), by(f.fz, flux);
  stop_the_clock(s);
  by(s.outlet_p, pressure), by(s.face_p, pressure), by(s.held, pressure), by(s.change, pressure),
      by(s.drop, pressure);
  s.force = pressure * s.force;
  Means& m = s.mean;
  m.u *= speed, m.v *= speed, m.w *= speed, m.p *= pressure, m.k *= speed * speed, m.omega *= speed;
}

}  // namespace ripstop::inline flow::cartesian

#include "ripstop/flow/cartesian/boundary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "ripstop/core/error.h"
#include "ripstop/flow/boundaries.h"

namespace ripstop::inline flow {
namespace {

std::vector<std::unique_ptr<BoundaryRecord>> standard_boundaries() {
  std::vector<std::unique_ptr<BoundaryRecord>> rows;
  const auto add = [&](BoundaryRecord record) {
    rows.push_back(std::make_unique<BoundaryRecord>(std::move(record)));
  };
  add({"zero-gradient", "open, as in [NFM]", cartesian::open_sides, {}});
  add({"slip", "walls without friction", cartesian::slip_sides, {}});
  add({"entraining",
       "air can enter with the total pressure of the stream (built-in engine only)",
       cartesian::entraining_sides,
       {}});
  add({"far-field",
       "the same condition on all six faces of the domain, for a stream of any direction; there is no other "
       "outlet",
       cartesian::far_field,
       {}});
  add({"fixed-pressure",
       "fixed pressure; air that flows back has no momentum, as in [NFM]",
       {},
       cartesian::fixed_pressure_outlet});
  add({"still-air",
       "air that flows back has the total pressure of air at rest (built-in engine only)",
       {},
       cartesian::still_air_outlet});
  return rows;
}

std::vector<std::unique_ptr<BoundaryRecord>>& table() {
  static std::vector<std::unique_ptr<BoundaryRecord>> rows = standard_boundaries();
  return rows;
}

}  // namespace

const std::vector<std::unique_ptr<BoundaryRecord>>& boundaries() {
  return table();
}

void add_boundary(BoundaryRecord record) {
  table().push_back(std::make_unique<BoundaryRecord>(std::move(record)));
}

Sides sides_of(const FlowProblem& problem) {
  return problem.air.along_z() ? problem.sides : Sides::far_field;
}

}  // namespace ripstop::inline flow

namespace ripstop::inline flow::cartesian {
namespace {

/// Beyond the inlet 2 q_inlet - q; beyond the outlet q where air leaves,
/// 2 q_back - q where it would come back.
void end_ghosts(const Discretisation& d, const Boundaries& b, const Fields& f, int k, const double* inlet,
                double back, Array<double>& q) {
  const Layout& layout = d.layout;
  const std::ptrdiff_t sz = layout.stride_z;
  const bool free = b.outlet->carries_back();
  for (int j = 0; j < layout.ny; ++j) {
    const std::ptrdiff_t at = layout.at(0, j, k), plane = layout.in_plane(0, j);
    double* row = &q[at];
    const double* fz = &f.fz[at + sz];
    for (int i = 0; k == 0 && i < layout.nx; ++i) row[i - sz] = 2 * (inlet ? inlet[plane + i] : 0) - row[i];
    for (int i = 0; k == layout.nz - 1 && i < layout.nx; ++i)
      row[i + sz] = fz[i] >= 0 || free ? row[i] : 2 * back - row[i];
  }
}

/// Ghosts outside a box with open boundaries, except at the inlet: the values of the outermost cells.
void copy_into_ends(const Discretisation& d, int k, Array<double>& q) {
  const Layout& layout = d.layout;
  const std::ptrdiff_t sz = layout.stride_z;
  for (int j = 0; j < layout.ny; ++j) {
    double* row = &q[layout.at(0, j, k)];
    if (k == 0) std::copy_n(row, layout.nx, row - sz);
    if (k == layout.nz - 1) std::copy_n(row, layout.nx, row + sz);
  }
}

double area_of(const Discretisation& d, const BoxFace& face, int k) {
  const auto at = static_cast<int>(face.cell - d.layout.at(0, 0, k));
  const int i = at % d.layout.stride_y, j = at / d.layout.stride_y;
  if (face.axis == 2) return d.x.width[i] * d.y.width[j];
  return (face.axis == 0 ? d.y.width[j] : d.x.width[i]) * d.z.width[k];
}

Vec3 velocity_at(const Fields& f, std::ptrdiff_t at) {
  return {f.u[at], f.v[at], f.w[at]};
}

template <class Visit>
void each_face(const Discretisation& d, const Fields& f, const Visit& visit) {
  for (int k = 0; k < d.layout.nz; ++k) {
    const auto in_plane = [&](const BoxFace& face) { visit(face, k); };
    each_side_face(d, f, k, in_plane), each_end_face(d, f, k, in_plane);
  }
}

Vec3 momentum_through_sides(const Discretisation& d, const State& s) {
  const Fields& f = s.f;
  Vec3 force;
  for (int k = 0; k < d.layout.nz; ++k) {  // ghosts contain the values of air that enters
    each_side_face(d, f, k, [&](const BoxFace& face) {
      force += (area_of(d, face, k) * face.inflow) * velocity_at(f, face.inflow > 0 ? face.ghost : face.cell);
    });
  }
  return force;
}

/// Momentum that the stress of the outermost cells, mu (grad u)^T, brings through faces that are open everywhere [N].
Vec3 stressed_in(const Discretisation& d, const State& s) {
  const Fields& f = s.f;
  Vec3 force;
  each_face(d, f, [&](const BoxFace& face, int k) {
    const std::ptrdiff_t at = face.cell;
    const RowMetrics m = d.metrics(static_cast<int>(at - d.layout.at(0, 0, k)) / d.layout.stride_y, k);
    const int i = static_cast<int>(at - d.layout.at(0, 0, k)) % d.layout.stride_y;
    const Array<double>& q = face.axis == 0 ? f.u : face.axis == 1 ? f.v : f.w;
    const auto slope = [&](std::ptrdiff_t step, double low, double high) {
      return high * (q[at + step] - q[at]) + low * (q[at] - q[at - step]);
    };
    const double mu = d.air.viscosity + f.rho[at] * f.k[at] / f.omega[at] * s.limit[at];
    const Vec3 gradient{slope(1, m.x_slope_low[i], m.x_slope_high[i]),
                        slope(m.sy, m.y.slope_low, m.y.slope_high),
                        slope(m.sz, m.z.slope_low, m.z.slope_high)};
    force += ((face.low ? -1 : 1) * area_of(d, face, k) * mu) * gradient;
  });
  return force;
}

double through_inlet_and_outlet(const Discretisation& d, const Boundaries& b, const State& s) {
  const Fields& f = s.f;
  const Layout& layout = d.layout;
  const std::ptrdiff_t sz = layout.stride_z;
  const bool free = b.outlet->carries_back();
  double force = 0;
  for (int j = 0; j < layout.ny; ++j) {
    for (int i = 0; i < layout.nx; ++i) {
      const double area = d.x.width[i] * d.y.width[j];
      const std::ptrdiff_t in = layout.at(i, j, 0), out = layout.at(i, j, layout.nz - 1),
                           plane = layout.in_plane(i, j);
      const double speed = b.inlet.w[plane];
      const double mu_in = d.air.viscosity + f.rho[in] * b.inlet.k[plane] / b.inlet.omega[plane];
      force += area * (f.fz[in] * speed + f.p[in] - mu_in * d.z.inverse_distance[0] * (f.w[in] - speed));
      // The explicit stress at the outlet is that of the last cell.
      const double leaving = f.fz[out + sz] >= 0 || free ? f.w[out] : 0;
      const double mu_out = d.air.viscosity + f.rho[out] * f.k[out] / f.omega[out] * s.limit[out];
      const double slope = (f.w[out] - f.w[out - sz]) * d.z.inverse_distance[layout.nz - 1];
      force += area * (mu_out * slope / 2 - s.outlet_p[plane] - f.fz[out + sz] * leaving);
    }
  }
  return force;
}

}  // namespace

std::unique_ptr<SideBoundary> open_sides() {
  return std::make_unique<SideBoundary>();
}

std::unique_ptr<OutletBoundary> fixed_pressure_outlet() {
  return std::make_unique<OutletBoundary>();
}

Inlet make_inlet(const Discretisation& d, const std::optional<Jet>& jet) {
  return jet ? jet_inlet(d, *jet) : uniform_inlet(d);
}

namespace {
/// `maker` is the member of a row that makes the part.
template <class Maker>
auto make_part(std::string_view word, const char* what, Maker BoundaryRecord::*maker) {
  std::string known;
  for (const auto& row : boundaries()) {
    if (!((*row).*maker)) continue;
    if (row->word == word) return ((*row).*maker)();
    known += (known.empty() ? "" : ", ") + row->word;
  }
  throw Error(ExitCode::usage,
              fmt::format("flow: the {} cannot be \"{}\"; choose one of {}", what, word, known));
}
}  // namespace

std::unique_ptr<SideBoundary> make_sides(Sides kind) {
  return make_part(kind.word, "sides", &BoundaryRecord::sides);
}

std::unique_ptr<OutletBoundary> make_outlet(Outlet kind) {
  return make_part(kind.word, "outlet", &BoundaryRecord::outlet);
}

void side_ghosts(const Discretisation& d, Array<double>& q, int k, int normal, double mirror) {
  const Layout& layout = d.layout;
  const auto across = [&](int axis) { return axis == normal ? mirror : 1; };
  const auto low_end = [&](int axis) { return d.quarter ? (axis == normal ? -1 : 1) : across(axis); };
  const double low_x = low_end(0), high_x = across(0), low_y = low_end(1), high_y = across(1);
  const int nx = layout.nx, ny = layout.ny;
  for (int j = 0; j < ny; ++j) {
    double* row = &q[layout.at(0, j, k)];
    row[-1] = low_x * row[0];
    row[nx] = high_x * row[nx - 1];
  }
  const double *low = &q[layout.at(-1, 0, k)], *high = &q[layout.at(-1, ny - 1, k)];
  double *below = &q[layout.at(-1, -1, k)], *above = &q[layout.at(-1, ny, k)];
  for (int i = 0; i < nx + 2; ++i) below[i] = low_y * low[i];
  for (int i = 0; i < nx + 2; ++i) above[i] = high_y * high[i];
}

void velocity_ghosts(const Discretisation& d, const Boundaries& b, State& s, int k) {
  Fields& f = s.f;
  const double mirror = b.sides->mirror();
  const auto ends = [&](const double* inlet, Array<double>& q) {
    b.open() ? copy_into_ends(d, k, q) : end_ghosts(d, b, f, k, inlet, 0, q);
  };
  side_ghosts(d, f.u, k, 0, mirror), ends(nullptr, f.u);
  side_ghosts(d, f.v, k, 1, mirror), ends(nullptr, f.v);
  side_ghosts(d, f.w, k), ends(b.inlet.w.data(), f.w);
  side_ghosts(d, f.rho, k), copy_into_ends(d, k, f.rho);
  const Vec3 stream = b.inlet.stream.velocity;
  b.sides->transported(d, f, k, 0, stream.x, f.u), b.sides->transported(d, f, k, 1, stream.y, f.v);
  b.sides->transported(d, f, k, 2, stream.z, f.w);
}

void turbulence_ghosts(const Discretisation& d, const Boundaries& b, State& s, int k) {
  Fields& f = s.f;
  const auto ghosts = [&](const Array<double>& inlet, double stream, Array<double>& q) {
    side_ghosts(d, q, k);
    b.open() ? copy_into_ends(d, k, q) : end_ghosts(d, b, f, k, inlet.data(), stream, q);
    b.sides->transported(d, f, k, no_axis, stream, q);
  };
  ghosts(b.inlet.k, b.inlet.stream.k, f.k), ghosts(b.inlet.omega, b.inlet.stream.omega, f.omega);
}

void pressure_ghosts(const Discretisation& d, const Boundaries& b, State& s, int k) {
  Fields& f = s.f;
  const Layout& layout = d.layout;
  const std::ptrdiff_t sz = layout.stride_z;
  side_ghosts(d, f.p, k);
  b.sides->pressure(d, b.inlet.stream, s, k);
  for (int j = 0; j < layout.ny && !b.open(); ++j) {
    const std::ptrdiff_t at = layout.at(0, j, k);
    double* p = &f.p[at];
    if (k == 0) std::copy_n(p, layout.nx, p - sz);
    if (k < layout.nz - 1) continue;
    double* outlet = &s.outlet_p[layout.in_plane(0, j)];
    b.outlet->pressure(layout.nx, &f.fz[at + sz], &f.rho[at], outlet);
    for (int i = 0; i < layout.nx; ++i) p[i + sz] = 2 * outlet[i] - p[i];
  }
}

void correction_ghosts(const Discretisation& d, const Boundaries& b, Array<float>& e, int k) {
  const Layout& layout = d.layout;
  const std::ptrdiff_t sy = layout.stride_y, sz = layout.stride_z;
  const int nx = layout.nx, ny = layout.ny;
  const float across = b.sides->correction_mirror(), low = d.quarter ? 1 : across;
  for (int j = 0; j < ny; ++j) {
    float* q = &e[layout.at(0, j, k)];
    q[-1] = low * q[0];
    q[nx] = across * q[nx - 1];
    for (int i = 0; j == 0 && i < nx; ++i) q[i - sy] = low * q[i];
    for (int i = 0; j == ny - 1 && i < nx; ++i) q[i + sy] = across * q[i];
    for (int i = 0; k == 0 && i < nx; ++i) q[i - sz] = b.open() ? -q[i] : q[i];
    for (int i = 0; k == layout.nz - 1 && i < nx; ++i) q[i + sz] = -q[i];
  }
}

Vec3 momentum_carried_in(const Discretisation& d, const Boundaries& b, const State& s) {
  const Fields& f = s.f;
  const Layout& layout = d.layout;
  Vec3 force;
  for (int j = 0; j < layout.ny; ++j) {
    for (int i = 0; i < layout.nx; ++i) {
      const std::ptrdiff_t in = layout.at(i, j, 0), out = layout.at(i, j, layout.nz);
      const Vec3 enters = b.open() ? velocity_at(f, f.fz[in] > 0 ? in - layout.stride_z : in)
                                   : Vec3{0, 0, b.inlet.speed(j)[i]},
                 leaves = velocity_at(f, f.fz[out] > 0 ? out - layout.stride_z : out);
      force += d.x.width[i] * d.y.width[j] * (f.fz[in] * enters - f.fz[out] * leaves);
    }
  }
  return force + momentum_through_sides(d, s);
}

Vec3 pressed_in(const Discretisation& d, const Boundaries& b, const State& s, bool where_held) {
  std::array<double, 3> force = {0, 0, 0};
  for (int k = 0; k < d.layout.nz; ++k) {
    const auto press = [&](const BoxFace& face, double p) {
      const double pushes = area_of(d, face, k) * p;
      force[face.axis] += face.low ? pushes : -pushes;
    };
    const auto between = [&](const BoxFace& face) { return 0.5 * (s.f.p[face.ghost] + s.f.p[face.cell]); };
    if ((b.sides->pressure_end() == End::fixed_value) == where_held)
      each_side_face(d, s.f, k, [&](const BoxFace& face) {
        press(face, where_held ? between(face) : s.f.p[face.cell]);
      });
    each_end_face(d, s.f, k, [&](const BoxFace& face) {
      if ((!face.low || b.open()) != where_held) return;
      press(face, !where_held ? s.f.p[face.cell]
                  : face.low  ? between(face)
                              : s.outlet_p[face.cell - d.layout.at(0, 0, k) + d.layout.in_plane(0, 0)]);
    });
  }
  return {force[0], force[1], force[2]};
}

Vec3 momentum_deficit(const Discretisation& d, const Boundaries& b, const State& s) {
  if (b.open()) return momentum_carried_in(d, b, s) + pressed_in(d, b, s, true) + stressed_in(d, s);
  const Vec3 sides = momentum_through_sides(d, s),
             across = momentum_carried_in(d, b, s) + pressed_in(d, b, s, true) + pressed_in(d, b, s, false);
  return {across.x, across.y, through_inlet_and_outlet(d, b, s) + sides.z};
}

}  // namespace ripstop::inline flow::cartesian

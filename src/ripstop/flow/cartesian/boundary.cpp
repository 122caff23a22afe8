#include "ripstop/flow/cartesian/boundary.h"

#include <algorithm>

namespace ripstop::cartesian {
namespace {

constexpr int none = -1;  // no axis

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

std::unique_ptr<SideBoundary> make_sides(Sides kind) {
  switch (kind) {
    case Sides::zero_gradient:
      return open_sides();
    case Sides::slip:
      return slip_sides();
    case Sides::entraining:
      return entraining_sides();
  }
  return nullptr;
}

std::unique_ptr<OutletBoundary> make_outlet(Outlet kind) {
  return kind == Outlet::still_air ? still_air_outlet() : fixed_pressure_outlet();
}

void side_ghosts(const Discretisation& d, Array<double>& q, int k, double across_x, double across_y) {
  const Layout& layout = d.layout;
  const int nx = layout.nx, ny = layout.ny;
  for (int j = 0; j < ny; ++j) {
    double* row = &q[layout.at(0, j, k)];
    row[-1] = across_x * row[0];
    row[nx] = across_x * row[nx - 1];
  }
  const double *low = &q[layout.at(-1, 0, k)], *high = &q[layout.at(-1, ny - 1, k)];
  double *below = &q[layout.at(-1, -1, k)], *above = &q[layout.at(-1, ny, k)];
  for (int i = 0; i < nx + 2; ++i) below[i] = across_y * low[i];
  for (int i = 0; i < nx + 2; ++i) above[i] = across_y * high[i];
}

void velocity_ghosts(const Discretisation& d, const Boundaries& b, State& s, int k) {
  Fields& f = s.f;
  const double mirror = b.sides->mirror();
  side_ghosts(d, f.u, k, mirror, 1), end_ghosts(d, b, f, k, nullptr, 0, f.u);
  side_ghosts(d, f.v, k, 1, mirror), end_ghosts(d, b, f, k, nullptr, 0, f.v);
  side_ghosts(d, f.w, k, 1, 1), end_ghosts(d, b, f, k, b.inlet.w.data(), 0, f.w);
  side_ghosts(d, f.rho, k, 1, 1);
  b.sides->transported(d, f, k, 0, 0, f.u), b.sides->transported(d, f, k, 1, 0, f.v);
  b.sides->transported(d, f, k, none, b.inlet.stream_speed, f.w);
  const Layout& layout = d.layout;
  const std::ptrdiff_t sz = layout.stride_z;
  for (int j = 0; j < layout.ny; ++j) {
    double* rho = &f.rho[layout.at(0, j, k)];
    if (k == 0) std::copy_n(rho, layout.nx, rho - sz);
    if (k == layout.nz - 1) std::copy_n(rho, layout.nx, rho + sz);
  }
}

void turbulence_ghosts(const Discretisation& d, const Boundaries& b, State& s, int k) {
  Fields& f = s.f;
  const Inlet& in = b.inlet;
  side_ghosts(d, f.k, k, 1, 1), end_ghosts(d, b, f, k, in.k.data(), in.stream_k, f.k);
  side_ghosts(d, f.omega, k, 1, 1), end_ghosts(d, b, f, k, in.omega.data(), in.stream_omega, f.omega);
  b.sides->transported(d, f, k, none, in.stream_k, f.k);
  b.sides->transported(d, f, k, none, in.stream_omega, f.omega);
}

void pressure_ghosts(const Discretisation& d, const Boundaries& b, State& s, int k) {
  Fields& f = s.f;
  const Layout& layout = d.layout;
  const std::ptrdiff_t sz = layout.stride_z;
  side_ghosts(d, f.p, k, 1, 1);
  b.sides->pressure(d, f, k);
  for (int j = 0; j < layout.ny; ++j) {
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
  const float across = b.sides->correction_mirror();
  for (int j = 0; j < ny; ++j) {
    float* q = &e[layout.at(0, j, k)];
    q[-1] = across * q[0];
    q[nx] = across * q[nx - 1];
    for (int i = 0; j == 0 && i < nx; ++i) q[i - sy] = across * q[i];
    for (int i = 0; j == ny - 1 && i < nx; ++i) q[i + sy] = across * q[i];
    if (k == 0) std::copy_n(q, nx, q - sz);
    for (int i = 0; k == layout.nz - 1 && i < nx; ++i) q[i + sz] = -q[i];
  }
}

double momentum_through_sides(const Discretisation& d, const State& s) {
  const Fields& f = s.f;
  double force = 0;
  for (int k = 0; k < d.layout.nz; ++k) {  // ghosts hold what air brings in
    each_side_face(d, f, k, [&](const SideFace& face) {
      const int i = static_cast<int>(face.cell - d.layout.at(0, 0, k)) % d.layout.stride_y;
      const int j = static_cast<int>(face.cell - d.layout.at(0, 0, k)) / d.layout.stride_y;
      const double area = (face.axis == 0 ? d.y.width[j] : d.x.width[i]) * d.z.width[k];
      force += area * face.inflow * f.w[face.inflow > 0 ? face.ghost : face.cell];
    });
  }
  return force;
}

double momentum_deficit(const Discretisation& d, const Boundaries& b, const State& s) {
  return through_inlet_and_outlet(d, b, s) + momentum_through_sides(d, s);
}

}  // namespace ripstop::cartesian

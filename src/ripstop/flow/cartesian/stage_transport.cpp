// First half of an iteration: turbulence and momentum.
//
// The box is divided along y into blocks of fixed size, and each block is marched plane by plane from the inlet to
// the outlet: a plane sees the new values of the plane before it, so a change travels with the stream through the
// whole box in one iteration. In a plane the rows are walked up in one iteration and down in the next, each seeing
// the new values of the row before it. All other neighbours are old values, read from arrays that are not written, so
// neither the order of the blocks nor the number of threads matters. Momentum runs one plane behind the turbulence;
// their common data are in a ring of a few planes, in cache. The rows on either side of a block are computed twice,
// for the stress in its own rows.
#include <algorithm>
#include <cmath>

#include "ripstop/flow/cartesian/solver.h"

namespace ripstop::cartesian {
namespace {

constexpr int mod(int k, int n) {
  return (k + n) % n;
}

/// Across the march most neighbours of a cell are old values. Their share of the convection grows with the angle of the
/// stream to the march, and with it the number of iterations after which full steps oscillate: at 45 degrees they do not
/// settle, 0.6 of a step does.
double share_of_step(Vec3 stream) {
  const double across = std::max(std::abs(stream.x), std::abs(stream.y));
  return 1 - 0.4 * std::min(across / std::max(stream.z, across), 1.0);
}

}  // namespace

// A block's rings and the planes of the fields should fit a second-level cache of 1-2 MB. An even number of
// blocks keeps two threads busy.
int block_count(const FlowGrid& grid) {
  const int rows = std::clamp(2500 / grid.nx, 6, 32);
  const int blocks = std::max(1, (grid.ny + rows / 2) / rows);
  return grid.ny < 8 ? 1 : (blocks + 1) / 2 * 2;
}

MarchRings::MarchRings(std::size_t plane_) : plane(plane_) {
  for (Array<double>& a : mut) a = Array<double>(plane);
  for (Array<double>& a : mu) a = Array<double>(plane);
  for (Array<double>& a : tx) a = Array<double>(3 * plane);
  for (Array<double>& a : ty) a = Array<double>(3 * plane);
  for (Array<double>& a : tz) a = Array<double>(3 * plane);
  for (Array<double>& a : predicted) a = Array<double>(3 * plane);
  scratch = Array<double>(plane);
}

void Solver::march(int rank, IndexRange rows) {
  MarchRings& rings = t_.rings[rank];
  eddy_viscosity(rings, 0, rows);
  for (int s = 0; s <= d_.grid.nz; ++s) {
    if (s + 1 < d_.grid.nz) eddy_viscosity(rings, s + 1, rows);
    if (s < d_.grid.nz) turbulence(rings, s, rows);
    if (s >= 1) momentum(rings, s - 1, rows);
  }
}

// Two rows beyond the block, as far as the grid goes; the kernel never needs more.
void Solver::eddy_viscosity(MarchRings& rings, int k, IndexRange rows) const {
  for (int j = std::max(rows.begin - 2, 0); j < std::min(rows.end + 2, d_.grid.ny); ++j) {
    const std::ptrdiff_t at = d_.layout.at(0, j, k);
    double* mut = &rings.mut[mod(k, 3)][rings.at(d_.layout, j, rows.begin)];
    eddy_viscosity_row(d_.grid.nx, density_of_row(j, k), &s_.f.k[at], &s_.f.omega[at], mut);
    if (!in_the_way_.wall.empty()) limit_row(d_.grid.nx, &s_.limit[at], mut);
  }
}

// Input of the kernel for row j of plane k.
TurbulenceRow Solver::turbulence_of(MarchRings& rings, int j, int k, IndexRange rows) {
  const bool inlet = k == 0 && !b_.open(), outlet = k == d_.grid.nz - 1 && !b_.open();
  const bool first = k == 0, last = k == d_.grid.nz - 1;
  const std::ptrdiff_t at = d_.layout.at(0, j, k), in = rings.at(d_.layout, j, rows.begin);
  const std::ptrdiff_t sy = d_.layout.stride_y, sz = d_.layout.stride_z;
  const std::ptrdiff_t component = static_cast<std::ptrdiff_t>(rings.plane);
  const bool own = j >= rows.begin && j < rows.end;
  const bool sees_new = own && !t_.in_time, new_below = sees_new && !first;
  TurbulenceRow r;
  r.m = d_.metrics(j, k);
  r.viscosity = d_.air.viscosity;
  if (t_.in_time)
    r.inverse_step = 1 / s_.clock.step, r.inverse_across = 1 / std::max(d_.y.width[j], d_.z.width[k]);
  r.relaxation = d_.settings.relax_turbulence;
  r.mean_k = s_.mean.k;
  r.mean_omega = s_.mean.omega;
  r.u = &s_.f.u[at], r.v = &s_.f.v[at], r.w = &s_.f.w[at];
  r.k = &s_.f.k[at], r.omega = &s_.f.omega[at], r.rho = density_of_row(j, k);
  const double *inlet_k = b_.inlet.turbulence(j), *inlet_omega = b_.inlet.frequency(j);
  r.k_below = inlet ? inlet_k : new_below ? &t_.new_k[at - sz] : r.k - sz;
  r.k_above = outlet ? inlet_k : r.k + sz;
  r.omega_below = inlet ? inlet_omega : new_below ? &t_.new_omega[at - sz] : r.omega - sz;
  r.omega_above = outlet ? inlet_omega : r.omega + sz;
  const bool new_south = sees_new && northward() && j > rows.begin,
             new_north = sees_new && !northward() && j + 1 < rows.end;
  r.k_south = new_south ? &t_.new_k[at - sy] : r.k - sy;
  r.k_north = new_north ? &t_.new_k[at + sy] : r.k + sy;
  r.omega_south = new_south ? &t_.new_omega[at - sy] : r.omega - sy;
  r.omega_north = new_north ? &t_.new_omega[at + sy] : r.omega + sy;
  r.fx = &s_.f.fx[at], r.fy = &s_.f.fy[at], r.fz = &s_.f.fz[at];
  r.mut = &rings.mut[mod(k, 3)][in];
  r.mut_above = &rings.mut[mod(last ? k : k + 1, 3)][in];
  double* below = &rings.mut[mod(k - 1, 3)][in];
  if (first && !inlet) std::copy_n(r.mut, d_.grid.nx, below);
  if (inlet) {  // such that the face takes the inlet's value
    for (int i = 0; i < d_.grid.nx; ++i) below[i] = 2 * r.rho[i] * inlet_k[i] / inlet_omega[i] - r.mut[i];
  }
  r.mut_below = below;
  r.k_new = own ? &t_.new_k[at] : &rings.scratch[Layout::lead];
  r.omega_new = own ? &t_.new_omega[at] : &rings.scratch[Layout::lead + d_.layout.stride_y];
  if (!in_the_way_.wall.empty()) {
    r.wall = &in_the_way_.wall[at];
    r.limit_new = own ? &t_.new_limit[at] : &rings.scratch[Layout::lead + 2 * d_.layout.stride_y];
  }
  r.mu_new = &rings.mu[mod(k, 3)][in];
  r.tx = &rings.tx[mod(k, 2)][in];
  r.ty = &rings.ty[mod(k, 2)][in];
  r.tz = &rings.tz[mod(k, 3)][in];
  r.component = component;
  return r;
}

void Solver::turbulence(MarchRings& rings, int k, IndexRange rows) {
  const int low = std::max(rows.begin - 1, 0), high = std::min(rows.end + 1, d_.grid.ny);
  for (int step = low; step < high; ++step) {
    const int j = northward() ? step : high - 1 - (step - low);
    TurbulenceRow r = turbulence_of(rings, j, k, rows);
    turbulence_row(r);
    // Beyond the sides the explicit stress is that of the last cell.
    for (int c = 0; c < 3; ++c) {
      double *tx = r.tx + c * r.component, *ty = r.ty + c * r.component;
      tx[-1] = tx[0];
      tx[d_.grid.nx] = tx[d_.grid.nx - 1];
      if (j == 0) std::copy_n(ty, d_.grid.nx, ty - d_.layout.stride_y);
      if (j == d_.grid.ny - 1) std::copy_n(ty, d_.grid.nx, ty + d_.layout.stride_y);
    }
    if (j < rows.begin || j >= rows.end) continue;
    double* sums = t_.sums.row(j, k);
    sums[Sums::k_residual] = r.k_sum.residual, sums[Sums::k_scale] = r.k_sum.scale;
    sums[Sums::omega_residual] = r.omega_sum.residual, sums[Sums::omega_scale] = r.omega_sum.scale;
    sums[Sums::k_mean] = r.total_k * d_.y.width[j] * d_.z.width[k];
    sums[Sums::omega_mean] = r.total_omega * d_.y.width[j] * d_.z.width[k];
  }
}

// In time: viscosity and stress of plane k at the beginning of the step, k and omega at its end.
void Solver::model_eddies(MarchRings& rings, int k, IndexRange rows) {
  if (k == 0) eddy_viscosity(rings, 0, rows);
  if (k + 1 < d_.grid.nz) eddy_viscosity(rings, k + 1, rows);
  for (int j = std::max(rows.begin - 1, 0); j < std::min(rows.end + 1, d_.grid.ny); ++j) {
    TurbulenceRow r = turbulence_of(rings, j, k, rows);
    turbulence_row(r);
  }
}

// The velocity of row j of plane k and of the rows around it, new where the march has been.
void Solver::velocities_around(MarchRings& rings, int j, int k, IndexRange rows, MomentumRow& r) const {
  const bool first = k == 0, last = k == d_.grid.nz - 1 && !b_.open();
  const std::ptrdiff_t at = d_.layout.at(0, j, k), in = rings.at(d_.layout, j, rows.begin);
  const std::ptrdiff_t sy = d_.layout.stride_y, sz = d_.layout.stride_z;
  const std::ptrdiff_t component = static_cast<std::ptrdiff_t>(rings.plane);
  const double* zeros = &t_.zeros[Layout::lead];
  r.u = &s_.f.u[at], r.v = &s_.f.v[at], r.w = &s_.f.w[at];
  const double* before = &rings.predicted[mod(k - 1, 2)][in];
  r.u_below = first ? zeros : before;
  r.v_below = first ? zeros : before + component;
  r.w_below = first ? b_.inlet.speed(j) : before + 2 * component;
  if (first && b_.open()) r.u_below = r.u - sz, r.v_below = r.v - sz, r.w_below = r.w - sz;
  r.u_above = last ? zeros : r.u + sz;
  r.v_above = last ? zeros : r.v + sz;
  r.w_above = last ? (b_.outlet->carries_back() ? r.w : zeros) : r.w + sz;
  const double *south = &rings.predicted[mod(k, 2)][in - sy], *north = &rings.predicted[mod(k, 2)][in + sy];
  const bool new_south = northward() && j > rows.begin, new_north = !northward() && j + 1 < rows.end;
  r.u_south = new_south ? south : r.u - sy;
  r.v_south = new_south ? south + component : r.v - sy;
  r.w_south = new_south ? south + 2 * component : r.w - sy;
  r.u_north = new_north ? north : r.u + sy;
  r.v_north = new_north ? north + component : r.v + sy;
  r.w_north = new_north ? north + 2 * component : r.w + sy;
}

// Input of the kernel for row j of plane k.
MomentumRow Solver::momentum_of(MarchRings& rings, int j, int k, IndexRange rows) {
  const bool first = k == 0, last = k == d_.grid.nz - 1;
  const std::ptrdiff_t at = d_.layout.at(0, j, k), in = rings.at(d_.layout, j, rows.begin);
  const std::ptrdiff_t component = static_cast<std::ptrdiff_t>(rings.plane);
  const double* zeros = &t_.zeros[Layout::lead];
  MomentumRow r;
  r.m = d_.metrics(j, k);
  r.relaxation = d_.settings.relax_velocity;
  r.march_relaxation = (s_.eased > 0 ? 0.5 : share_of_step(d_.air.velocity)) * d_.settings.relax_march;
  r.mean_u = s_.mean.u;
  r.mean_v = s_.mean.v;
  r.mean_w = s_.mean.w;
  r.p = &s_.f.p[at], r.rho = &s_.f.rho[at];
  velocities_around(rings, j, k, rows, r);
  r.fx = &s_.f.fx[at], r.fy = &s_.f.fy[at], r.fz = &s_.f.fz[at];
  r.mu = &rings.mu[mod(k, 3)][in];
  r.mu_above = &rings.mu[mod(last ? k : k + 1, 3)][in];
  double* below = &rings.mu[mod(k - 1, 3)][in];
  if (first && b_.open()) std::copy_n(r.mu, d_.grid.nx, below);
  if (first && !b_.open()) {
    const double *inlet_k = b_.inlet.turbulence(j), *inlet_omega = b_.inlet.frequency(j);
    for (int i = 0; i < d_.grid.nx; ++i) {
      below[i] = 2 * (d_.air.viscosity + r.rho[i] * inlet_k[i] / inlet_omega[i]) - r.mu[i];
    }
  }
  r.mu_below = below;
  r.tx = &rings.tx[mod(k, 2)][in];
  r.ty = &rings.ty[mod(k, 2)][in];
  r.tz = &rings.tz[mod(k, 3)][in];
  r.tz_below = first ? r.tz : &rings.tz[mod(k - 1, 3)][in];
  r.tz_above = last ? r.tz : &rings.tz[mod(k + 1, 3)][in];
  r.component = component;
  r.linear = in_the_way_.porous.linear(j, k);
  r.quadratic = in_the_way_.porous.quadratic(j, k);
  const auto extra = [&](const Array<double>& both, const Array<double>& body) {
    return d_.settings.second_order ? &both[at] : body.empty() ? zeros : &body[at];
  };
  r.extra_u = extra(t_.extra_u, in_the_way_.body_u), r.extra_v = extra(t_.extra_v, in_the_way_.body_v),
  r.extra_w = extra(t_.extra_w, in_the_way_.body_w);
  r.sheet = jumps(j, k, s_.held);
  r.stiffness = jumps(j, k, in_the_way_.sheets.stiffness());
  r.inertia = d_.air.density * d_.air.speed();
  r.hu = &t_.hu[at], r.hv = &t_.hv[at], r.hw = &t_.hw[at], r.ra = &t_.ra[at], r.rc = &t_.rc[at];
  double* next = &rings.predicted[mod(k, 2)][in];
  r.u_new = next, r.v_new = next + component, r.w_new = next + 2 * component;
  return r;
}

void Solver::momentum(MarchRings& rings, int k, IndexRange rows) {
  for (int step = rows.begin; step < rows.end; ++step) {
    const int j = northward() ? step : rows.end - 1 - (step - rows.begin);
    MomentumRow r = momentum_of(rings, j, k, rows);
    momentum_row(r);
    double* sums = t_.sums.row(j, k);
    sums[Sums::u_residual] = r.u_sum.residual, sums[Sums::u_scale] = r.u_sum.scale;
    sums[Sums::v_residual] = r.v_sum.residual, sums[Sums::v_scale] = r.v_sum.scale;
    sums[Sums::w_residual] = r.w_sum.residual, sums[Sums::w_scale] = r.w_sum.scale;
  }
}

}  // namespace ripstop::cartesian

// First half of an iteration: turbulence and momentum.
//
// The box is cut along y into blocks of fixed size, and each block is marched plane by plane from the inlet
// to the outlet: a plane sees the new values of the plane before it, so a change travels with the stream
// through the whole box in one iteration. In a plane the rows are walked up in one iteration and down in the
// next, each seeing the new values of the row before it. All other neighbours are old values, read from
// arrays that nobody writes, so neither the order of the blocks nor the number of threads matters. Momentum
// runs one plane behind the turbulence; what passes between them stays in a ring of a few planes, in cache.
// The rows on either side of a block are computed twice, for the stress that its own rows see.
#include <algorithm>

#include "ripstop/flow/cartesian/solver.h"

namespace ripstop::cartesian {
namespace {

constexpr int eased_iterations = 30;  // of a start beside a sheet

constexpr int mod(int k, int n) {
  return (k + n) % n;
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
  MarchRings& rings = rings_[rank];
  eddy_viscosity(rings, 0, rows);
  for (int s = 0; s <= grid_.nz; ++s) {
    if (s + 1 < grid_.nz) eddy_viscosity(rings, s + 1, rows);
    if (s < grid_.nz) turbulence(rings, s, rows);
    if (s >= 1) momentum(rings, s - 1, rows);
  }
}

// Two rows beyond the block, as far as the grid goes; the kernel never needs more.
void Solver::eddy_viscosity(MarchRings& rings, int k, IndexRange rows) const {
  for (int j = std::max(rows.begin - 2, 0); j < std::min(rows.end + 2, grid_.ny); ++j) {
    const std::ptrdiff_t at = layout_.at(0, j, k);
    double* mut = &rings.mut[mod(k, 3)][rings.at(layout_, j, rows.begin)];
    eddy_viscosity_row(grid_.nx, &f_.rho[at], &f_.k[at], &f_.omega[at], mut);
    if (!limit_.empty()) limit_row(grid_.nx, &limit_[at], mut);
  }
}

void Solver::turbulence(MarchRings& rings, int k, IndexRange rows) {
  const bool first = k == 0, last = k == grid_.nz - 1;
  const std::ptrdiff_t sz = layout_.stride_z, component = static_cast<std::ptrdiff_t>(rings.plane);
  const bool northward = iteration_ % 2 == 0;  // the way the rows are walked
  const int low = std::max(rows.begin - 1, 0), high = std::min(rows.end + 1, grid_.ny);
  for (int step = low; step < high; ++step) {
    const int j = northward ? step : high - 1 - (step - low);
    const bool own = j >= rows.begin && j < rows.end;
    const std::ptrdiff_t at = layout_.at(0, j, k), in = rings.at(layout_, j, rows.begin);
    TurbulenceRow r;
    r.m = metrics(j, k);
    r.viscosity = air_.viscosity;
    r.relaxation = settings_.relax_turbulence;
    r.mean_k = total_.value[Sums::k_mean];
    r.mean_omega = total_.value[Sums::omega_mean];
    r.u = &f_.u[at], r.v = &f_.v[at], r.w = &f_.w[at];
    r.k = &f_.k[at], r.omega = &f_.omega[at], r.rho = &f_.rho[at];
    const double *inlet_k = &constant_.inlet_k[Layout::lead],
                 *inlet_omega = &constant_.inlet_omega[Layout::lead];
    r.k_below = first ? inlet_k : own ? &new_k_[at - sz] : r.k - sz;
    r.k_above = last ? inlet_k : r.k + sz;
    r.omega_below = first ? inlet_omega : own ? &new_omega_[at - sz] : r.omega - sz;
    r.omega_above = last ? inlet_omega : r.omega + sz;
    const std::ptrdiff_t sy = layout_.stride_y;
    const bool new_south = own && northward && j > rows.begin,
               new_north = own && !northward && j + 1 < rows.end;
    r.k_south = new_south ? &new_k_[at - sy] : r.k - sy;
    r.k_north = new_north ? &new_k_[at + sy] : r.k + sy;
    r.omega_south = new_south ? &new_omega_[at - sy] : r.omega - sy;
    r.omega_north = new_north ? &new_omega_[at + sy] : r.omega + sy;
    r.fx = &f_.fx[at], r.fy = &f_.fy[at], r.fz = &f_.fz[at];
    r.mut = &rings.mut[mod(k, 3)][in];
    r.mut_above = &rings.mut[mod(last ? k : k + 1, 3)][in];
    double* below = &rings.mut[mod(k - 1, 3)][in];
    if (first) {  // such that the face takes the inlet's value
      for (int i = 0; i < grid_.nx; ++i) below[i] = 2 * r.rho[i] * inlet_k_ / inlet_omega_ - r.mut[i];
    }
    r.mut_below = below;
    r.k_new = own ? &new_k_[at] : &rings.scratch[Layout::lead];
    r.omega_new = own ? &new_omega_[at] : &rings.scratch[Layout::lead + layout_.stride_y];
    if (!wall_.empty()) {
      r.wall = &wall_[at];
      r.limit_new = own ? &new_limit_[at] : &rings.scratch[Layout::lead + 2 * layout_.stride_y];
    }
    r.mu_new = &rings.mu[mod(k, 3)][in];
    r.tx = &rings.tx[mod(k, 2)][in];
    r.ty = &rings.ty[mod(k, 2)][in];
    r.tz = &rings.tz[mod(k, 3)][in];
    r.component = component;
    turbulence_row(r);
    // Beyond the sides the explicit stress is that of the last cell.
    for (int c = 0; c < 3; ++c) {
      double *tx = r.tx + c * component, *ty = r.ty + c * component;
      tx[-1] = tx[0];
      tx[grid_.nx] = tx[grid_.nx - 1];
      if (j == 0) std::copy_n(ty, grid_.nx, ty - layout_.stride_y);
      if (j == grid_.ny - 1) std::copy_n(ty, grid_.nx, ty + layout_.stride_y);
    }
    if (!own) continue;
    double* sums = row_sums(j, k).value;
    sums[Sums::k_residual] = r.k_sum.residual, sums[Sums::k_scale] = r.k_sum.scale;
    sums[Sums::omega_residual] = r.omega_sum.residual, sums[Sums::omega_scale] = r.omega_sum.scale;
    sums[Sums::k_mean] = r.total_k * y_.width[j] * z_.width[k];
    sums[Sums::omega_mean] = r.total_omega * y_.width[j] * z_.width[k];
  }
}

void Solver::momentum(MarchRings& rings, int k, IndexRange rows) {
  const bool first = k == 0, last = k == grid_.nz - 1;
  const std::ptrdiff_t sz = layout_.stride_z, component = static_cast<std::ptrdiff_t>(rings.plane);
  const double *zeros = &constant_.zeros[Layout::lead], *inlet_w = &constant_.inlet_w[Layout::lead];
  const bool northward = iteration_ % 2 == 0;
  // A pressure from elsewhere does not yet stand against the cloth, and would throw the air about.
  const bool eased = !sheets_.empty() && iteration_ < eased_iterations;
  for (int step = rows.begin; step < rows.end; ++step) {
    const int j = northward ? step : rows.end - 1 - (step - rows.begin);
    const std::ptrdiff_t at = layout_.at(0, j, k), in = rings.at(layout_, j, rows.begin);
    MomentumRow r;
    r.m = metrics(j, k);
    r.relaxation = settings_.relax_velocity;
    r.march_relaxation = (eased ? 0.5 : 1.0) * settings_.relax_march;
    r.mean_u = total_.value[Sums::u_mean];
    r.mean_v = total_.value[Sums::v_mean];
    r.mean_w = total_.value[Sums::w_mean];
    r.u = &f_.u[at], r.v = &f_.v[at], r.w = &f_.w[at];
    r.p = &f_.p[at], r.rho = &f_.rho[at];
    const double* before = &rings.predicted[mod(k - 1, 2)][in];
    r.u_below = first ? zeros : before;
    r.v_below = first ? zeros : before + component;
    r.w_below = first ? inlet_w : before + 2 * component;
    r.u_above = last ? zeros : r.u + sz;
    r.v_above = last ? zeros : r.v + sz;
    r.w_above = last ? (outlet_p_.empty() ? zeros : r.w) : r.w + sz;
    const std::ptrdiff_t sy = layout_.stride_y;
    const double *south = &rings.predicted[mod(k, 2)][in - sy], *north = &rings.predicted[mod(k, 2)][in + sy];
    const bool new_south = northward && j > rows.begin, new_north = !northward && j + 1 < rows.end;
    r.u_south = new_south ? south : r.u - sy;
    r.v_south = new_south ? south + component : r.v - sy;
    r.w_south = new_south ? south + 2 * component : r.w - sy;
    r.u_north = new_north ? north : r.u + sy;
    r.v_north = new_north ? north + component : r.v + sy;
    r.w_north = new_north ? north + 2 * component : r.w + sy;
    r.fx = &f_.fx[at], r.fy = &f_.fy[at], r.fz = &f_.fz[at];
    r.mu = &rings.mu[mod(k, 3)][in];
    r.mu_above = &rings.mu[mod(last ? k : k + 1, 3)][in];
    double* below = &rings.mu[mod(k - 1, 3)][in];
    if (first) {
      for (int i = 0; i < grid_.nx; ++i) {
        below[i] = 2 * (air_.viscosity + r.rho[i] * inlet_k_ / inlet_omega_) - r.mu[i];
      }
    }
    r.mu_below = below;
    r.tx = &rings.tx[mod(k, 2)][in];
    r.ty = &rings.ty[mod(k, 2)][in];
    r.tz = &rings.tz[mod(k, 3)][in];
    r.tz_below = first ? r.tz : &rings.tz[mod(k - 1, 3)][in];
    r.tz_above = last ? r.tz : &rings.tz[mod(k + 1, 3)][in];
    r.component = component;
    r.linear = porous_.linear(j, k);
    r.quadratic = porous_.quadratic(j, k);
    const auto extra = [&](const Array<double>& both, const Array<double>& body) {
      return settings_.second_order ? &both[at] : body.empty() ? zeros : &body[at];
    };
    r.extra_u = extra(extra_u_, body_u_), r.extra_v = extra(extra_v_, body_v_),
    r.extra_w = extra(extra_w_, body_w_);
    r.sheet = jumps(j, k, &SheetRows::held);
    r.stiffness = jumps(j, k, &SheetRows::stiffness);
    r.inertia = air_.density * air_.speed;
    r.hu = &hu_[at], r.hv = &hv_[at], r.hw = &hw_[at], r.ra = &ra_[at], r.rc = &rc_[at];
    double* next = &rings.predicted[mod(k, 2)][in];
    r.u_new = next, r.v_new = next + component, r.w_new = next + 2 * component;
    momentum_row(r);
    double* sums = row_sums(j, k).value;
    sums[Sums::u_residual] = r.u_sum.residual, sums[Sums::u_scale] = r.u_sum.scale;
    sums[Sums::v_residual] = r.v_sum.residual, sums[Sums::v_scale] = r.v_sum.scale;
    sums[Sums::w_residual] = r.w_sum.residual, sums[Sums::w_scale] = r.w_sum.scale;
  }
}

}  // namespace ripstop::cartesian

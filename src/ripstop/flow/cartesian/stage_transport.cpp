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

namespace ripstop::inline flow::cartesian {
namespace {

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

MarchRings::MarchRings(std::size_t plane) : component(static_cast<std::ptrdiff_t>(plane)), scratch(plane) {
  const auto allocate = [](auto& ring, std::size_t values) {
    for (Array<double>& of : ring.plane) of = Array<double>(values);
  };
  allocate(mut, plane), allocate(mu, plane);
  allocate(tx, 3 * plane), allocate(ty, 3 * plane), allocate(tz, 3 * plane), allocate(vector, 3 * plane);
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
    double* mut = rings.mut.row(k, rings.at(d_.layout, j, rows.begin));
    eddy_viscosity_row(d_.grid.nx, density_of_row(j, k), &s_.f.k[at], &s_.f.omega[at], mut);
    if (!in_the_way_.wall.empty()) limit_row(d_.grid.nx, &s_.limit[at], mut);
    mirror_viscosity(mut, j);
  }
}

// The value beyond the planes of symmetry, from row j of a ring.
void Solver::mirror_viscosity(double* row, int j) const {
  if (!d_.quarter) return;
  row[-1] = row[0];
  if (j == 0) std::copy_n(row, d_.grid.nx, row - d_.layout.stride_y);
}

TurbulenceRow Solver::turbulence_of(MarchRings& rings, int j, int k, IndexRange rows) {
  const bool inlet = k == 0 && !b_.open(), outlet = k == d_.grid.nz - 1 && !b_.open();
  const bool first = k == 0, last = k == d_.grid.nz - 1;
  const std::ptrdiff_t at = d_.layout.at(0, j, k), in = rings.at(d_.layout, j, rows.begin);
  const std::ptrdiff_t sy = d_.layout.stride_y, sz = d_.layout.stride_z;
  const bool own = j >= rows.begin && j < rows.end;
  const bool sees_new = own && !t_.in_time;
  TurbulenceRow r;
  r.m = d_.metrics(j, k);
  r.viscosity = d_.air.viscosity;
  if (t_.in_time)
    r.inverse_step = 1 / s_.clock.step, r.inverse_across = 1 / std::max(d_.y.width[j], d_.z.width[k]);
  r.relaxation = d_.settings.relax_turbulence;
  r.mean_k = s_.mean.k;
  r.mean_omega = s_.mean.omega;
  r.velocity = s_.f.velocity(at);
  // New where the march has been.
  const auto around = [&](const Array<double>& old, const Array<double>& fresh, const double* of_inlet) {
    Stencil q = stencil(&old[at], sy, sz);
    if (sees_new && !first) q.below = &fresh[at - sz];
    if (sees_new && northward() && j > rows.begin) q.south = &fresh[at - sy];
    if (sees_new && !northward() && j + 1 < rows.end) q.north = &fresh[at + sy];
    if (inlet) q.below = of_inlet;
    if (outlet) q.above = of_inlet;
    return q;
  };
  const double *inlet_k = b_.inlet.turbulence(j), *inlet_omega = b_.inlet.frequency(j);
  r.k = around(s_.f.k, t_.new_k, inlet_k), r.omega = around(s_.f.omega, t_.new_omega, inlet_omega);
  r.rho = density_of_row(j, k);
  r.flux = s_.f.flux(at);
  double* below = rings.mut.row(k - 1, in);
  r.mut = {rings.mut.row(k, in), below, rings.mut.row(last ? k : k + 1, in)};
  if (first && !inlet) std::copy_n(r.mut.here, d_.grid.nx, below);
  if (inlet) {  // such that the face takes the inlet's value
    for (int i = 0; i < d_.grid.nx; ++i)
      below[i] = 2 * r.rho[i] * inlet_k[i] / inlet_omega[i] - r.mut.here[i];
  }
  double* scratch = &rings.scratch[Layout::lead];
  r.k_new = own ? &t_.new_k[at] : scratch;
  r.omega_new = own ? &t_.new_omega[at] : scratch + sy;
  if (!in_the_way_.wall.empty()) {
    r.wall = &in_the_way_.wall[at];
    r.limit_new = own ? &t_.new_limit[at] : scratch + 2 * sy;
  }
  r.mu_new = rings.mu.row(k, in);
  r.stress = rings.stress(k, in);
  return r;
}

void Solver::turbulence(MarchRings& rings, int k, IndexRange rows) {
  const IndexRange and_around{std::max(rows.begin - 1, 0), std::min(rows.end + 1, d_.grid.ny)};
  for_rows({and_around, northward()}, [&](int j) {
    const TurbulenceRow r = turbulence_of(rings, j, k, rows);
    const TurbulenceSums sum = turbulence_row(r);
    mirror_viscosity(r.mu_new, j);
    // Beyond the sides the explicit stress is that of the last cell; in a plane of symmetry its tangential components
    // change their sign.
    for (int c = 0; c < 3; ++c) {
      double *tx = r.stress.x + c * rings.component, *ty = r.stress.y + c * rings.component;
      tx[-1] = d_.quarter && c != 0 ? -tx[0] : tx[0];
      tx[d_.grid.nx] = tx[d_.grid.nx - 1];
      const double sign = d_.quarter && c != 1 ? -1 : 1;
      for (int i = 0; j == 0 && i < d_.grid.nx; ++i) ty[i - d_.layout.stride_y] = sign * ty[i];
      if (j == d_.grid.ny - 1) std::copy_n(ty, d_.grid.nx, ty + d_.layout.stride_y);
    }
    if (j < rows.begin || j >= rows.end) return;
    double* sums = t_.sums.row(j, k);
    sums[Sums::k_residual] = sum.k.residual, sums[Sums::k_scale] = sum.k.scale;
    sums[Sums::omega_residual] = sum.omega.residual, sums[Sums::omega_scale] = sum.omega.scale;
    sums[Sums::k_mean] = sum.total_k * d_.y.width[j] * d_.z.width[k];
    sums[Sums::omega_mean] = sum.total_omega * d_.y.width[j] * d_.z.width[k];
  });
}

// In time: viscosity and stress of plane k at the beginning of the step, k and omega at its end.
void Solver::model_eddies(MarchRings& rings, int k, IndexRange rows) {
  if (k == 0) eddy_viscosity(rings, 0, rows);
  if (k + 1 < d_.grid.nz) eddy_viscosity(rings, k + 1, rows);
  for (int j = std::max(rows.begin - 1, 0); j < std::min(rows.end + 1, d_.grid.ny); ++j) {
    turbulence_row(turbulence_of(rings, j, k, rows));
  }
}

// The velocity of row j of plane k and of the rows around it, new where the march has been.
VectorStencil Solver::velocity_around(MarchRings& rings, int j, int k, IndexRange rows) const {
  const bool first = k == 0, last = k == d_.grid.nz - 1 && !b_.open();
  const std::ptrdiff_t at = d_.layout.at(0, j, k), in = rings.at(d_.layout, j, rows.begin);
  const std::ptrdiff_t sy = d_.layout.stride_y, sz = d_.layout.stride_z;
  const double* zeros = &t_.zeros[Layout::lead];
  const VectorView<double> south = rings.predicted(k, in - sy), north = rings.predicted(k, in + sy),
                           below = rings.predicted(k - 1, in);
  const auto around = [&](const Array<double>& old, double* VectorView<double>::*component,
                          const double* of_inlet) {
    Stencil q = stencil(&old[at], sy, sz);
    if (northward() && j > rows.begin) q.south = south.*component;
    if (!northward() && j + 1 < rows.end) q.north = north.*component;
    if (!first) q.below = below.*component;
    if (first && !b_.open()) q.below = of_inlet;
    if (last) q.above = zeros;
    return q;
  };
  VectorStencil velocity{around(s_.f.u, &VectorView<double>::x, zeros),
                         around(s_.f.v, &VectorView<double>::y, zeros),
                         around(s_.f.w, &VectorView<double>::z, b_.inlet.speed(j))};
  if (last && b_.outlet->carries_back()) velocity.z.above = velocity.z.here;
  return velocity;
}

MomentumRow Solver::momentum_of(MarchRings& rings, int j, int k, IndexRange rows) {
  const bool first = k == 0, last = k == d_.grid.nz - 1;
  const std::ptrdiff_t at = d_.layout.at(0, j, k), in = rings.at(d_.layout, j, rows.begin);
  MomentumRow r;
  r.m = d_.metrics(j, k);
  r.relaxation = d_.settings.relax_velocity;
  r.march_relaxation = (s_.eased > 0 ? 0.5 : share_of_step(d_.air.velocity)) * d_.settings.relax_march;
  r.inertia = d_.air.density * d_.air.speed();
  r.mean = {s_.mean.u, s_.mean.v, s_.mean.w};
  r.velocity = velocity_around(rings, j, k, rows);
  r.p = &s_.f.p[at], r.rho = &s_.f.rho[at];
  r.flux = s_.f.flux(at);
  double* below = rings.mu.row(k - 1, in);
  r.mu = {rings.mu.row(k, in), below, rings.mu.row(last ? k : k + 1, in)};
  if (first && b_.open()) std::copy_n(r.mu.here, d_.grid.nx, below);
  if (first && !b_.open()) {
    const double *inlet_k = b_.inlet.turbulence(j), *inlet_omega = b_.inlet.frequency(j);
    for (int i = 0; i < d_.grid.nx; ++i) {
      below[i] = 2 * (d_.air.viscosity + r.rho[i] * inlet_k[i] / inlet_omega[i]) - r.mu.here[i];
    }
  }
  r.stress = rings.stress(k, in);
  r.stress_below = first ? r.stress.z : rings.tz.row(k - 1, in);
  r.stress_above = last ? r.stress.z : rings.tz.row(k + 1, in);
  r.resistance = in_the_way_.porous.at(j, k);
  r.force = force_on(at);
  r.sheet = sheet(j, k);
  r.matrix = t_.matrix(at);
  r.predicted = rings.predicted(k, in);
  return r;
}

// Force on the air in an iteration, and second-order convection.
VectorView<const double> Solver::force_on(std::ptrdiff_t at) const {
  if (d_.settings.second_order) return row_of(t_.extra_u, t_.extra_v, t_.extra_w, at);
  const Obstacles& o = in_the_way_;
  const double* zeros = &t_.zeros[Layout::lead];
  return o.body_u.empty() ? VectorView{zeros, zeros, zeros} : row_of(o.body_u, o.body_v, o.body_w, at);
}

void Solver::momentum(MarchRings& rings, int k, IndexRange rows) {
  for_rows({rows, northward()}, [&](int j) {
    const MomentumSums sum = momentum_row(momentum_of(rings, j, k, rows));
    double* sums = t_.sums.row(j, k);
    sums[Sums::u_residual] = sum.u.residual, sums[Sums::u_scale] = sum.u.scale;
    sums[Sums::v_residual] = sum.v.residual, sums[Sums::v_scale] = sum.v.scale;
    sums[Sums::w_residual] = sum.w.residual, sums[Sums::w_scale] = sum.w.scale;
  });
}

}  // namespace ripstop::inline flow::cartesian

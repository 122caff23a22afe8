#include "ripstop/flow/cartesian/multigrid.h"

#include <algorithm>
#include <cmath>

#include "ripstop/flow/cartesian/multigrid_rows.h"

namespace ripstop::inline flow::cartesian {
namespace {

constexpr int coarsest_cells = 32;   // below that, smoothing alone
constexpr int coarsest_sweeps = 12;  // red-black sweeps there
constexpr int serial_cells = 6000;   // a level this small is cheaper on one thread than its barriers

// Joins cells in pairs and determines the interpolation back.
Axis join(const Axis& fine, MultigridLevel::Joint& joint) {
  const bool halve = fine.n > 3;
  std::vector<double> edges;
  for (int c = 0; c < fine.n; c += halve ? 2 : 1) {
    joint.first.push_back(c);
    edges.push_back(fine.edge[c]);
  }
  joint.first.push_back(fine.n);
  edges.push_back(fine.edge[fine.n]);
  const auto end = [](double inverse_distance) {
    return inverse_distance > 0 ? End::fixed_value : End::zero_gradient;
  };
  Axis coarse = make_axis(edges, end(fine.inverse_distance.front()), end(fine.inverse_distance.back()));

  const auto centre = [](const Axis& a, int c) { return (a.edge[c] + a.edge[c + 1]) / 2; };
  for (int parent = 0; parent < coarse.n; ++parent) {
    for (int c = joint.first[parent]; c < joint.first[parent + 1]; ++c) {
      const double offset = centre(fine, c) - centre(coarse, parent);
      const int other = offset < 0 ? parent - 1 : parent + 1;
      double far = 0, near = 1;
      if (offset != 0 && other >= 0 && other < coarse.n) {
        far = offset / (centre(coarse, other) - centre(coarse, parent));
        near = 1 - far;
      } else if (other == -1 && fine.inverse_distance.front() > 0 && offset < 0) {
        near = 1 + offset / (centre(coarse, parent) - coarse.edge.front());
      } else if (other == coarse.n && fine.inverse_distance.back() > 0 && offset > 0) {
        near = 1 - offset / (coarse.edge.back() - centre(coarse, parent));
      }
      joint.near.push_back(parent);
      joint.far.push_back(std::clamp(other, 0, coarse.n - 1));
      joint.near_weight.push_back(static_cast<float>(near));
      joint.far_weight.push_back(static_cast<float>(far));
    }
  }
  return coarse;
}

MultigridRow row_of(MultigridLevel& level, int j, int k) {
  const Layout& lay = level.layout;
  const std::ptrdiff_t at = lay.at(0, j, k);
  return {lay.nx,
          lay.stride_y,
          lay.stride_z,
          level.e.data() + at,
          level.rhs.data() + at,
          level.cx.data() + at,
          level.cy.data() + at,
          level.cz.data() + at};
}

void smooth_plane(MultigridLevel& level, int colour, int k, bool from_zero) {
  for (int j = 0; j < level.layout.ny; ++j) {
    const MultigridRow row = row_of(level, j, k);
    const int parity = (colour + j + k) & 1;
    from_zero ? first_smooth_row(row, parity) : smooth_row(row, parity);
  }
}

// rhs of the coarse level = sum of the fine residuals in each coarse cell.
void restrict_planes(MultigridLevel& fine, MultigridLevel& coarse, IndexRange planes) {
  const Layout& lay = coarse.layout;
  Array<float> sum(fine.layout.nx + 1);
  for (int k = planes.begin; k < planes.end; ++k) {
    for (int j = 0; j < lay.ny; ++j) {
      std::fill(sum.begin(), sum.end(), 0.0f);
      for (int kf = coarse.z.first[k]; kf < coarse.z.first[k + 1]; ++kf) {
        for (int jf = coarse.y.first[j]; jf < coarse.y.first[j + 1]; ++jf) {
          residual_row(row_of(fine, jf, kf), sum.data());
        }
      }
      float* rhs = coarse.rhs.data() + lay.at(0, j, k);
      if (lay.nx == fine.layout.nx) {
        std::copy_n(sum.data(), lay.nx, rhs);
      } else {  // the value behind an odd row's end is zero
        for (int i = 0; i < lay.nx; ++i) rhs[i] = sum[2 * i] + sum[2 * i + 1];
      }
    }
  }
}

void prolong_planes(MultigridLevel& fine, MultigridLevel& coarse, IndexRange planes) {
  const Layout& lay = coarse.layout;
  Array<float> mixed(lay.nx);
  for (int k = planes.begin; k < planes.end; ++k) {
    const int kn = coarse.z.near[k], kf = coarse.z.far[k];
    const float zn = coarse.z.near_weight[k], zf = coarse.z.far_weight[k];
    for (int j = 0; j < fine.layout.ny; ++j) {
      const int jn = coarse.y.near[j], jf = coarse.y.far[j];
      const float yn = coarse.y.near_weight[j], yf = coarse.y.far_weight[j];
      const float* q = coarse.e.data();
      mix_rows(lay.nx, q + lay.at(0, jn, kn), q + lay.at(0, jf, kn), q + lay.at(0, jn, kf),
               q + lay.at(0, jf, kf), yn * zn, yf * zn, yn * zf, yf * zf, mixed.data());
      spread_row(fine.layout.nx, mixed.data(), coarse.x.near.data(), coarse.x.far.data(),
                 coarse.x.near_weight.data(), coarse.x.far_weight.data(),
                 fine.e.data() + fine.layout.at(0, j, k));
    }
  }
}

// Conductance of a coarse face. Along each fine line through it the path from centre to centre crosses the face
// itself and half of the faces inside either coarse cell, in series; the lines are in parallel. A thin wall is thus
// preserved at any position between the coarse faces.
void coarsen_planes(const MultigridLevel& fine, MultigridLevel& coarse, IndexRange planes) {
  const Layout &lay = coarse.layout, &from = fine.layout;
  const MultigridLevel::Joint &y = coarse.y, &z = coarse.z;
  const int n = from.nx;
  const bool halved = lay.nx != n;
  Array<float> open(n + 1, 1e12f), sum(n + 2);
  // The face inside coarse cell c, or one without resistance if the cell is a single fine one or a ghost.
  const auto inside = [&](const std::vector<int>& first, int c, int count, const float* row_of_first,
                          std::ptrdiff_t stride) {
    return c >= 0 && c < count && first[c + 1] - first[c] == 2 ? row_of_first + stride : open.data();
  };
  const auto gather = [&](float* out) {
    for (int i = 0; i < lay.nx; ++i) out[i] = halved ? sum[2 * i] + sum[2 * i + 1] : sum[i];
  };
  for (int k = planes.begin; k < planes.end; ++k) {
    for (int j = 0; j <= lay.ny; ++j) {
      std::fill(sum.begin(), sum.end(), 0.0f);
      for (int jf = y.first[j]; j < lay.ny && jf < y.first[j + 1]; ++jf) {
        const float* face = &fine.cz[from.at(0, jf, z.first[k])];
        const float* below = k > 0 ? &fine.cz[from.at(0, jf, z.first[k - 1])] : nullptr;
        add_series_row(n, face, inside(z.first, k - 1, lay.nz, below, from.stride_z),
                       inside(z.first, k, lay.nz, face, from.stride_z), sum.data());
      }
      gather(&coarse.cz[lay.at(0, j, k)]);
      if (k == lay.nz) continue;  // the outlet's faces

      std::fill(sum.begin(), sum.end(), 0.0f);
      for (int kf = z.first[k]; kf < z.first[k + 1]; ++kf) {
        const float* face = &fine.cy[from.at(0, y.first[j], kf)];
        const float* below = j > 0 ? &fine.cy[from.at(0, y.first[j - 1], kf)] : nullptr;
        add_series_row(n, face, inside(y.first, j - 1, lay.ny, below, from.stride_y),
                       inside(y.first, j, lay.ny, face, from.stride_y), sum.data());
      }
      gather(&coarse.cy[lay.at(0, j, k)]);
      if (j == lay.ny) continue;  // the far side's faces

      std::fill(sum.begin(), sum.end(), 0.0f);
      float first = 0, last = 0, end = 0;
      for (int kf = z.first[k]; kf < z.first[k + 1]; ++kf) {
        for (int jf = y.first[j]; jf < y.first[j + 1]; ++jf) {
          const float* face = &fine.cx[from.at(0, jf, kf)];
          add_series_row(n, face, halved ? face - 1 : open.data(), halved ? face + 1 : open.data(),
                         sum.data());
          // Beyond the sides there is nothing; the last cell of an odd row
          // is a coarse cell alone: nothing inside it.
          add_series_row(1, face, open.data(), halved ? face + 1 : open.data(), &first);
          if (n % 2 == 1 && halved) add_series_row(1, face + n - 1, face + n - 2, open.data(), &last);
          add_series_row(1, face + n, n % 2 == 0 && halved ? face + n - 1 : open.data(), open.data(), &end);
        }
      }
      float* cx = &coarse.cx[lay.at(0, j, k)];
      for (int i = 0; i < lay.nx; ++i) cx[i] = sum[halved ? 2 * i : i];
      if (n % 2 == 1 && halved) cx[lay.nx - 1] = last;
      cx[0] = first;
      cx[lay.nx] = end;
    }
  }
}

}  // namespace

Multigrid::Multigrid(const Axis& x, const Axis& y, const Axis& z) {
  Axis ax = x, ay = y, az = z;
  MultigridLevel::Joint jx, jy, jz;
  for (;;) {
    MultigridLevel level;
    level.layout = Layout(ax.n, ay.n, az.n);
    const std::size_t values = level.layout.values();
    level.e = Array<float>(values);
    level.rhs = Array<float>(values);
    level.cx = Array<float>(values);
    level.cy = Array<float>(values);
    level.cz = Array<float>(values);
    level.x = std::move(jx);
    level.y = std::move(jy);
    level.z = std::move(jz);
    levels_.push_back(std::move(level));
    if (ax.n * ay.n * az.n <= coarsest_cells || (ax.n <= 3 && ay.n <= 3 && az.n <= 3)) break;
    jx = {}, jy = {}, jz = {};
    ax = join(ax, jx);
    ay = join(ay, jy);
    az = join(az, jz);
  }
}

void Multigrid::coarsen(ThreadTeam& team, int rank) {
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    const int planes = levels_[l].layout.nz + 1;
    coarsen_planes(levels_[l - 1], levels_[l], part_of(planes, rank, team.size()));
    team.barrier();
  }
}

void Multigrid::cycle(std::size_t l, bool from_zero, ThreadTeam* team, int rank) {
  MultigridLevel& level = levels_[l];
  const int parts = team ? team->size() : 1;
  const auto barrier = [&] {
    if (team) team->barrier();
  };
  const IndexRange planes = part_of(level.layout.nz, rank, parts);
  // Both colours in one walk: the second runs a plane behind the first, while its neighbours are still in
  // cache. At the ends of a thread's planes it waits until the other threads have done their first colour.
  const auto sweep = [&](int first, bool fresh) {
    const int second = 1 - first;
    for (int k = planes.begin; k < planes.end; ++k) {
      smooth_plane(level, first, k, fresh);
      if (k - 1 > planes.begin) smooth_plane(level, second, k - 1, false);
    }
    barrier();
    if (planes.end > planes.begin) smooth_plane(level, second, planes.begin, false);
    if (planes.end - 1 > planes.begin) smooth_plane(level, second, planes.end - 1, false);
    barrier();
  };
  sweep(0, from_zero);
  if (l + 1 == levels_.size()) {
    for (int s = 1; s < coarsest_sweeps; ++s) sweep(0, false);
    return;
  }
  MultigridLevel& coarse = levels_[l + 1];
  restrict_planes(level, coarse, part_of(coarse.layout.nz, rank, parts));
  barrier();
  if (team && coarse.layout.nx * coarse.layout.ny * coarse.layout.nz < serial_cells) {
    if (rank == 0) cycle(l + 1, true, nullptr, 0);
    barrier();
  } else {
    cycle(l + 1, true, team, rank);
  }
  prolong_planes(level, coarse, planes);
  barrier();
  sweep(1, false);
}

// `planes` are counted with the ghosts.
void Multigrid::clear(Array<float>& a, IndexRange planes) const {
  const std::ptrdiff_t plane = finest().layout.stride_z;
  std::fill(a.begin() + planes.begin * plane, a.begin() + planes.end * plane, 0.0f);
}

void Multigrid::solve(ThreadTeam& team, int rank, int cycles) {
  coarsen(team, rank);
  MultigridLevel& top = finest();
  clear(top.e, part_of(top.layout.nz + 2, rank, team.size()));
  team.barrier();
  for (int c = 0; c < cycles; ++c) cycle(0, c == 0, &team, rank);
}

template <class Row>
Multigrid::Sums Multigrid::sum_of_rows(ThreadTeam& team, int rank, const Row& of_row) {
  const Layout& lay = finest().layout;
  const auto add = [](Sums& to, const Sums& more) {
    for (std::size_t c = 0; c < to.size(); ++c) to[c] += more[c];
  };
  const IndexRange planes = part_of(lay.nz, rank, team.size());
  for (int k = planes.begin; k < planes.end; ++k) {
    planes_[k] = {};
    for (int j = 0; j < lay.ny; ++j) add(planes_[k], of_row(j, k, lay.at(0, j, k)));
  }
  team.barrier();
  Sums total{};
  for (const Sums& plane : planes_) add(total, plane);
  team.barrier();
  return total;
}

template <class Row>
void Multigrid::each_row(ThreadTeam& team, int rank, const Row& work) {
  const Layout& lay = finest().layout;
  const IndexRange planes = part_of(lay.nz, rank, team.size());
  for (int k = planes.begin; k < planes.end; ++k) {
    for (int j = 0; j < lay.ny; ++j) work(lay.at(0, j, k));
  }
  team.barrier();
}

int Multigrid::solve_conjugate(ThreadTeam& team, int rank, double reduction, int most, Array<float>* last) {
  MultigridLevel& top = finest();
  const Layout& lay = top.layout;
  if (rank == 0 && planes_.empty()) {
    planes_.resize(lay.nz);
    solution_ = direction_ = image_ = Array<float>(lay.values());
  }
  coarsen(team, rank);
  team.barrier();
  Array<float>& solution = last ? *last : solution_;
  const IndexRange planes = part_of(lay.nz + 2, rank, team.size());
  clear(top.e, planes);
  if (!last) clear(solution, planes), clear(direction_, planes);
  team.barrier();
  double start = 0, curvature = 0;
  int cycles = 0;
  const int first = last ? 0 : 1;
  for (int n = first; n <= most; ++n) {
    if (n > 0) {
      cycle(0, true, &team, rank), ++cycles;
      // The new direction is made conjugate to the last one, whatever the cycle has become in between.
      double beta = 0;
      if (curvature > 0) {
        const double along_image = sum_of_rows(team, rank, [&](int, int, std::ptrdiff_t at) {
          return Sums{dot_row(lay.nx, &top.e[at], &image_[at])};
        })[0];
        beta = -along_image / curvature;
      }
      each_row(team, rank, [&](std::ptrdiff_t at) {
        turn_row(lay.nx, static_cast<float>(beta), &top.e[at], &direction_[at]);
      });
    }
    // The first direction is the last solution, which lies where this one will.
    Array<float>& direction = n == 0 ? solution : direction_;
    const Sums along = sum_of_rows(team, rank, [&](int j, int k, std::ptrdiff_t at) {
      MultigridRow row = row_of(top, j, k);
      row.e = &direction[at];
      const ImageSums sums = image_row(row, &image_[at]);
      return Sums{sums.curvature, sums.descent, sums.square};
    });
    if (n == first) start = along[2];
    curvature = along[0];
    if (!(curvature > 0)) {
      if (n > 0) break;
      clear(solution, planes), clear(direction_, planes);  // nothing was solved before
      team.barrier();
      continue;
    }
    const float alpha = static_cast<float>(along[1] / curvature);
    const double left = sum_of_rows(team, rank, [&](int, int, std::ptrdiff_t at) {
      if (n == 0) {
        std::copy_n(&solution[at], lay.nx, &direction_[at]);
        std::fill_n(&solution[at], lay.nx, 0.0f);
      }
      return Sums{advance_row(lay.nx, alpha, &direction_[at], &image_[at], &solution[at], &top.rhs[at])};
    })[0];
    if (left <= reduction * reduction * start) break;
  }
  each_row(team, rank, [&](std::ptrdiff_t at) { std::copy_n(&solution[at], lay.nx, &top.e[at]); });
  return cycles;
}

double Multigrid::residual() const {
  MultigridLevel copy = levels_.front();
  Array<float> sum(copy.layout.nx);
  double total = 0;
  for (int k = 0; k < copy.layout.nz; ++k) {
    for (int j = 0; j < copy.layout.ny; ++j) {
      std::fill(sum.begin(), sum.end(), 0.0f);
      residual_row(row_of(copy, j, k), sum.data());
      for (int i = 0; i < copy.layout.nx; ++i) total += std::fabs(static_cast<double>(sum[i]));
    }
  }
  return total;
}

}  // namespace ripstop::inline flow::cartesian

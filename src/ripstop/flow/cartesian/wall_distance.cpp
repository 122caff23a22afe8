#include "ripstop/flow/cartesian/wall_distance.h"

#include <utility>

namespace ripstop::inline flow::cartesian {

WallDistance::WallDistance(const Axis& x, const Axis& y, const Axis& z, std::vector<Vec3> points)
    : n_{x.n, y.n, z.n}, stride_{1, x.n, std::ptrdiff_t{x.n} * y.n}, points_(std::move(points)) {
  const std::array<const Axis*, 3> axes = {&x, &y, &z};
  for (std::size_t a = 0; a < 3; ++a)
    for (int c = 0; c < axes[a]->n; ++c)
      centre_[a].push_back(0.5 * (axes[a]->edge[c] + axes[a]->edge[c + 1]));
  nearest_.assign(static_cast<std::size_t>(x.n) * y.n * z.n, -1);
  square_.assign(nearest_.size(), 1e300);
}

void WallDistance::pass_on(int axis, int from, int i, int j, int k) {
  const std::size_t c = cell(i, j, k);
  const int point = nearest_[c + from * stride_[axis]];
  if (point >= 0 && point != nearest_[c]) compare(c, {centre_[0][i], centre_[1][j], centre_[2][k]}, point);
}

void WallDistance::sweep_plane(int k) {
  const auto [nx, ny, nz] = n_;
  for (int j = 0; j < ny; ++j) {
    for (int i = 1; i < nx; ++i) pass_on(0, -1, i, j, k);
    for (int i = nx - 2; i >= 0; --i) pass_on(0, 1, i, j, k);
  }
  for (int j = 1; j < ny; ++j)
    for (int i = 0; i < nx; ++i) pass_on(1, -1, i, j, k);
  for (int j = ny - 2; j >= 0; --j)
    for (int i = 0; i < nx; ++i) pass_on(1, 1, i, j, k);
}

/// Of the columns along z.
void WallDistance::sweep_row_of_columns(int j) {
  const auto [nx, ny, nz] = n_;
  for (int k = 1; k < nz; ++k)
    for (int i = 0; i < nx; ++i) pass_on(2, -1, i, j, k);
  for (int k = nz - 2; k >= 0; --k)
    for (int i = 0; i < nx; ++i) pass_on(2, 1, i, j, k);
}

void WallDistance::sweep(ThreadTeam* team) {
  const int ranks = team ? team->size() : 1;
  const auto work = [&](int rank) {
    const IndexRange planes = part_of(n_[2], rank, ranks), rows = part_of(n_[1], rank, ranks);
    for (int pass = 0; pass < 2; ++pass) {
      for (int k = planes.begin; k < planes.end; ++k) sweep_plane(k);
      if (team) team->barrier();
      for (int j = rows.begin; j < rows.end; ++j) sweep_row_of_columns(j);
      if (team) team->barrier();
    }
  };
  team ? team->run(work) : work(0);
}

}  // namespace ripstop::inline flow::cartesian

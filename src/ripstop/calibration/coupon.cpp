#include "ripstop/calibration/coupon.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "ripstop/core/error.h"
#include "ripstop/material/lattice.h"
#include "ripstop/mesh/builder.h"

namespace ripstop::inline calibration {
namespace {

constexpr int most_cells = 400;
constexpr double most_nodes = 4e5, most_of_square = 2e6;

CouponMesh straight_coupon(const Fabric& fabric, const CouponShape& shape) {
  const double across = shape.width / shape.cells;
  const int rows = std::max(2, static_cast<int>(std::lround(shape.length / (across * shape.aspect))));
  const double along = shape.length / rows;
  CouponMesh coupon{{}, shape.length, shape.width, across, {}, {}, {}, {}};
  MeshBuilder builder;
  PatchShape patch;
  const bool warp = shape.orientation != 90;  // warp lies along the columns
  patch.rows = (warp ? rows : shape.cells) + 1;
  patch.columns = (warp ? shape.cells : rows) + 1;
  patch.start = [&](int row, int column) {
    return warp ? Vec3{column * across, row * along, 0} : Vec3{row * across, column * along, 0};
  };
  if (shape.orientation == 45) patch.grain = FabricCut::bias;
  builder.add_patch("coupon", patch, fabric);
  coupon.mesh = std::move(builder.mesh);
  const Patch& made = coupon.mesh.patches.front();
  const auto node = [&](int up, int side) { return warp ? made.node(up, side) : made.node(side, up); };
  for (int side = 0; side <= shape.cells; ++side) {
    coupon.lower_clamp.push_back(node(0, side));
    coupon.upper_clamp.push_back(node(rows, side));
  }
  coupon.middle_left = {node(rows / 2, 0)};
  coupon.middle_right = {node(rows / 2, shape.cells)};
  return coupon;
}

// With u = column + row along the pull and v = column - row across it, in half-diagonals h / sqrt2, the
// coupon is m <= u <= m + n, |v| <= m.
struct Diagonal {
  int m = 0, n = 0;

  int side() const {
    return m + n / 2 + 1;
  }  // nodes along either yarn of the square that contains the coupon
  bool has(int row, int column) const {
    const int u = column + row, v = column - row;
    return u >= m && u <= m + n && std::abs(v) <= m;
  }
};

/// How many half-diagonals fit best: n even, n / (2 m) = length / width, m from `least` up.
Diagonal best_fit(double length, double width, int least) {
  Diagonal best{least, 0};
  double smallest = 1e300;
  for (int m = least; m <= least + std::max(2, least / 4); ++m) {
    const double wanted = 2 * m * length / width;
    const int n = std::max(2, 2 * static_cast<int>(std::lround(wanted / 2)));
    const double miss = std::abs(n / wanted - 1);
    if (miss < smallest - 1e-9) smallest = miss, best = {m, n};
  }
  return best;
}

class DiagonalBuilder {
 public:
  DiagonalBuilder(const Fabric& fabric, const CouponShape& shape)
      : fabric_(fabric), grid_(best_fit(shape.length, shape.width, shape.cells)) {
    step_ = shape.width / (2 * grid_.m);
    const double h = step_ * std::numbers::sqrt2;
    coupon_.spacing = h;
    coupon_.width = shape.width;
    coupon_.length = grid_.n * step_;
    PatchShape patch;
    patch.rows = patch.columns = grid_.side();
    patch.start = [&](int row, int column) {
      return Vec3{step_ * (column - row + grid_.m), step_ * (column + row - grid_.m), 0};
    };
    builder_.add_patch("coupon", patch, fabric);
    widths_ = cell_widths(h, h, woven_laws(fabric));
  }

  CouponMesh build() {
    Patch& patch = this->patch();
    for (int d = 0; d < direction_count; ++d) std::fill(patch.width[d].begin(), patch.width[d].end(), 0.0);
    std::fill(patch.cell_area.begin(), patch.cell_area.end(), 0.0);
    std::fill(builder_.mesh.mass.begin(), builder_.mesh.mass.end(), 0.0);
    placed_.assign(builder_.mesh.mass.size(), 0);
    for (int row = 0; row + 1 < patch.rows; ++row)
      for (int column = 0; column + 1 < patch.columns; ++column) add_cell(row, column);
    for (int row = 0; row < patch.rows; ++row)
      for (int column = 0; column < patch.columns; ++column) sort_node(row, column);
    for (int d = 0; d < direction_count; ++d)
      for (std::size_t i = 0; i < patch.width[d].size(); ++i)
        if (patch.width[d][i] == 0) patch.rest_length[d][i] = 0;
    coupon_.mesh = std::move(builder_.mesh);
    return std::move(coupon_);
  }

 private:
  struct At {
    int row, column;
  };

  Patch& patch() { return builder_.mesh.patches.front(); }
  int node(At p) { return patch().node(p.row, p.column); }
  bool has(At p) const { return grid_.has(p.row, p.column); }

  void add_width(Direction d, int row, int column, double width) {
    patch().width[d][row * patch().columns + column] += width;
  }

  void bend(Direction d, int row, int column, double width) {
    const auto [dr, dc] = direction_offset[d];
    if (row < 0 || column < 0 || row + dr >= patch().rows || column + dc >= patch().columns) return;
    if (has({row, column}) && has({row + dr / 2, column + dc / 2}) && has({row + dr, column + dc}))
      add_width(d, row, column, width);
  }

  /// One cell's side of a yarn piece, and of the bending springs that span it.
  void add_edge(Direction d, int row, int column) {
    const bool along = d == along_row;
    add_width(d, row, column, along ? widths_.along_row : widths_.along_column);
    const Direction bending = along ? bend_row : bend_column;
    const double width = along ? widths_.bend_row : widths_.bend_column;
    bend(bending, row, column, width);
    bend(bending, along ? row : row - 1, along ? column - 1 : column, width);
  }

  void add_cell(int row, int column) {
    const At corner[4] = {{row, column}, {row, column + 1}, {row + 1, column + 1}, {row + 1, column}};
    int outside = -1, inside = 0;
    for (int i = 0; i < 4; ++i) {
      if (has(corner[i]))
        ++inside;
      else
        outside = i;
    }
    if (inside < 3) return;
    // The four yarn pieces with their ends; those that reach outside are not cloth.
    const struct {
      Direction direction;
      int row, column, from, to;
    } edges[4] = {{along_row, row, column, 0, 1},
                  {along_row, row + 1, column, 3, 2},
                  {along_column, row, column, 0, 3},
                  {along_column, row, column + 1, 1, 2}};
    for (const auto& e : edges)
      if (e.from != outside && e.to != outside) add_edge(e.direction, e.row, e.column);
    // shear_up joins corners 0 and 2, shear_down corners 1 and 3 (kept at corner 1).
    const bool up_is_cut = outside == 0 || outside == 2, whole = outside < 0;
    add_width(shear_up, row, column, widths_.shear * (whole || up_is_cut ? 1 : 0.5));
    add_width(shear_down, row, column + 1, widths_.shear * (whole || !up_is_cut ? 1 : 0.5));
    const double area = coupon_.spacing * coupon_.spacing * (whole ? 1 : 0.5);
    patch().cell_area[row * patch().columns + column] = area;
    for (int i = 0; i < 4; ++i)
      if (i != outside) builder_.mesh.mass[node(corner[i])] += area / inside * fabric_.areal_density_kg_m2;
    if (whole) return;
    double& half = up_is_cut ? patch().rest_length[shear_up][row * patch().columns + column]
                             : patch().rest_length[shear_down][row * patch().columns + column + 1];
    half *= 0.5;
    place_outside(corner[outside], corner[(outside + 1) % 4], corner[(outside + 3) % 4]);
  }

  /// The outer corner of a half cell goes to the middle of the cut between a and b.
  void place_outside(At outer, At a, At b) {
    std::vector<Vec3>& x = builder_.mesh.start;
    x[node(outer)] = 0.5 * (x[node(a)] + x[node(b)]);
    placed_[node(outer)] = 1;
    const int u = outer.row + outer.column;
    if (u < grid_.m)
      coupon_.lower_clamp.push_back(node(outer));
    else if (u > grid_.m + grid_.n)
      coupon_.upper_clamp.push_back(node(outer));
    else
      builder_.tie(node(outer), {{node(a), 0.5}, {node(b), 0.5}});
  }

  void sort_node(int row, int column) {
    const int here = node({row, column}), u = row + column, v = column - row;
    if (!grid_.has(row, column)) {
      if (placed_[here]) return;
      builder_.mesh.start[here] = {0.5 * coupon_.width, 0.5 * coupon_.length, 0};
      builder_.mesh.fixed.push_back(here);  // no cloth, no spring: it only fills the lattice
      return;
    }
    if (u == grid_.m) coupon_.lower_clamp.push_back(here);
    if (u == grid_.m + grid_.n) coupon_.upper_clamp.push_back(here);
    if (std::abs(u - grid_.m - grid_.n / 2) > 1) return;
    if (v == -grid_.m) coupon_.middle_left.push_back(here);
    if (v == grid_.m) coupon_.middle_right.push_back(here);
  }

  const Fabric& fabric_;
  Diagonal grid_;
  double step_ = 0;  // half a diagonal [m]
  CellWidths widths_;
  MeshBuilder builder_;
  CouponMesh coupon_;
  std::vector<char> placed_;
};

double mean_x(const std::vector<Vec3>& x, const std::vector<int>& nodes) {
  double sum = 0;
  for (int node : nodes) sum += x[node].x;
  return sum / static_cast<double>(nodes.size());
}

/// Highest stress within a tenth of the width of a clamp corner, over the mean of the middle third.
double corner_peak(const CouponMesh& coupon, const std::vector<double>& stress) {
  const std::vector<Cell> cells = cells_of(coupon.mesh);
  double peak = 0, sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].corner[0] < 0) continue;
    Vec3 centre;
    for (int corner : cells[i].corner) centre += 0.25 * coupon.mesh.start[corner];
    const double side = std::min(centre.x, coupon.width - centre.x);
    const double end = std::min(centre.y, coupon.length - centre.y);
    if (std::hypot(side, end) < 0.15 * coupon.width) peak = std::max(peak, stress[i]);
    if (end > coupon.length / 3) sum += stress[i], ++count;
  }
  return sum > 0 ? peak / (sum / count) : 0;
}

/// Before anything is allocated: a lattice along the yarns of a coupon at 45 deg lies in a square about all of it.
void check_size(const CouponShape& shape) {
  const double slender = shape.length / (shape.width * shape.aspect), cells = shape.cells;
  const bool diagonal = shape.orientation == 45 && !shape.bias_lattice;
  const double nodes = (diagonal ? 2 : 1) * slender * cells * (cells + 1);
  const double square = diagonal ? std::pow(cells * (slender + 1) + 1, 2) : 0;
  if (nodes <= most_nodes && square <= most_of_square) return;
  throw Error(
      ExitCode::usage,
      fmt::format("a coupon of {:g} m x {:g} m with {} cells across has about {:.3g} nodes, more than "
                  "{:.0e}: make it shorter or wider, or use fewer cells",
                  shape.length, shape.width, shape.cells, std::max(nodes, square),
                  square > most_of_square ? most_of_square : most_nodes));
}

}  // namespace

CouponMesh coupon_mesh(const Fabric& fabric, const CouponShape& shape) {
  if (shape.cells < 2 || shape.cells > most_cells || !(shape.length > 0) || !(shape.width > 0) ||
      !(shape.aspect > 0) || (shape.orientation != 0 && shape.orientation != 45 && shape.orientation != 90))
    throw Error(
        ExitCode::usage,
        fmt::format("a coupon of {} m x {} m at {} deg with {} cells across cannot be built: 2 to {} cells, "
                    "0, 45 or 90 deg",
                    shape.length, shape.width, shape.orientation, shape.cells, most_cells));
  check_size(shape);
  CouponMesh coupon = shape.orientation == 45 && !shape.bias_lattice ? DiagonalBuilder(fabric, shape).build()
                                                                     : straight_coupon(fabric, shape);
  for (const auto* clamp : {&coupon.lower_clamp, &coupon.upper_clamp})
    coupon.mesh.fixed.insert(coupon.mesh.fixed.end(), clamp->begin(), clamp->end());
  return coupon;
}

CouponPull pull_coupon(const CouponMesh& coupon, const std::vector<double>& strains,
                       const PullOptions& options, ThreadTeam& team, std::vector<std::vector<Vec3>>* guess) {
  const ClothPtr cloth = make_cloth(coupon.mesh);
  ClothState state = start_state(*cloth);
  CouponPull pull;
  std::vector<Vec3> before = coupon.mesh.start, now = coupon.mesh.start;
  double strain_before = 0, strain_now = 0, load = 0;
  const Patch& patch = coupon.mesh.patches.front();
  const bool known = guess && guess->size() == strains.size();
  if (guess && !known) guess->clear();
  for (std::size_t k = 0; k < strains.size(); ++k) {
    const double strain = strains[k];
    std::vector<Vec3> x = now;
    if (known) {
      x = (*guess)[k];
    } else if (strain_now > strain_before) {  // continue as in the last step
      const double part = (strain - strain_now) / (strain_now - strain_before);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += part * (now[i] - before[i]);
    } else {
      for (std::size_t i = 0; i < x.size(); ++i) x[i].y = coupon.mesh.start[i].y * (1 + strain);
    }
    for (int node : coupon.lower_clamp) x[node] = coupon.mesh.start[node];
    for (int node : coupon.upper_clamp)
      x[node] = coupon.mesh.start[node] + Vec3{0, strain * coupon.length, 0};
    set_positions(state, *cloth, x);
    RelaxOptions relaxation;
    relaxation.tolerance = options.tolerance;
    relaxation.max_steps = 30000;
    // A coupon pulls at least like its shear springs alone.
    const double shear = std::min(patch.law[shear_up].tangent(0), patch.law[along_row].tangent(0));
    relaxation.least_load = std::max(load, shear * strain * coupon.width);
    const RelaxResult result = relax(state, *cloth, {}, relaxation, team);
    pull.steps += result.steps;
    pull.converged = pull.converged && result.converged;

    before = std::move(now), strain_before = strain_now;
    now = positions(state, *cloth), strain_now = strain;
    if (guess) known ? void((*guess)[k] = now) : guess->push_back(now);
    const double up = -force_on(*cloth, state, coupon.upper_clamp).y;
    const double down = force_on(*cloth, state, coupon.lower_clamp).y;
    load = 0.5 * (up + down);
    CouponPoint point{strain, load / coupon.width, 1, 1, result.residual};
    point.waist = (mean_x(now, coupon.middle_right) - mean_x(now, coupon.middle_left)) / coupon.width;
    if (options.stress) {
      pull.von_mises.clear();
      for (const CellStress& s : cell_stress(*cloth, state)) {
        pull.von_mises.push_back(s.von_mises);
        pull.largest_strain = std::max(pull.largest_strain, s.max_strain);
      }
      point.corner_peak = corner_peak(coupon, pull.von_mises);
    }
    pull.points.push_back(point);
  }
  pull.positions = now;
  return pull;
}

}  // namespace ripstop::inline calibration

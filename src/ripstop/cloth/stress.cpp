// Membrane stress resultants of every cell in virial form.
#include <algorithm>
#include <cmath>

#include "ripstop/cloth/layout.h"
#include "ripstop/mesh/each_spring.h"

namespace ripstop::inline cloth {
namespace {

// Cells of one patch with cloth, and the springs that touch them.
struct CellMap {
  const Patch& patch;

  bool has_cloth(int row, int column) const {
    if (row < 0 || row + 1 >= patch.rows) return false;
    if (patch.periodic)
      column = (column + patch.columns) % patch.columns;
    else if (column < 0 || column + 1 >= patch.columns)
      return false;
    return patch.cell_area[row * patch.columns + column] > 0;
  }
  int index(int row, int column) const {
    return row * patch.columns + (column + patch.columns) % patch.columns;
  }
};

struct Touched {
  int row[4], column[4];
  int count = 0;
  void add(const CellMap& map, int r, int c) {
    if (!map.has_cloth(r, c)) return;
    row[count] = r, column[count] = c, ++count;
  }
};

// The cells that share a spring: either side of an edge, the one cell of a diagonal, both sides of both edges
// that a bending spring spans.
Touched cells_touched(const CellMap& map, const SpringView& s) {
  Touched touched;
  const int r = s.row, c = s.column;
  switch (s.direction) {
    case along_row:
      touched.add(map, r - 1, c), touched.add(map, r, c);
      break;
    case along_column:
      touched.add(map, r, c - 1), touched.add(map, r, c);
      break;
    case shear_up:
      touched.add(map, r, c);
      break;
    case shear_down:
      touched.add(map, r, c - 1);
      break;
    case bend_row:
      for (int dc : {0, 1}) touched.add(map, r - 1, c + dc), touched.add(map, r, c + dc);
      break;
    case bend_column:
      for (int dr : {0, 1}) touched.add(map, r + dr, c - 1), touched.add(map, r + dr, c);
      break;
    default:
      break;
  }
  return touched;
}

struct Frame {
  Vec3 u, v;  // orthonormal, in the quad's mean plane
  double area;
};

/// N in a frame [N/m].
struct Resultant {
  double uu = 0, vv = 0, uv = 0;

  double along(const Frame& frame, Vec3 line) const {
    const double u = dot(line, frame.u), v = dot(line, frame.v), square = u * u + v * v;
    return square > 0 ? (uu * u * u + vv * v * v + 2 * uv * u * v) / square : 0;
  }
};

Frame frame_of(const Cell& cell, const std::vector<Vec3>& x) {
  const Vec3 a = x[cell.corner[0]], b = x[cell.corner[1]], c = x[cell.corner[2]], d = x[cell.corner[3]];
  const Vec3 area = area_vector(a, b, c, d);
  const double size = norm(area);
  if (!(size > 0)) return {{}, {}, 0};
  const Vec3 n = area / size;
  Vec3 u = (b - a) + (c - d);
  u -= dot(u, n) * n;
  const double length = norm(u);
  if (!(length > 0)) return {{}, {}, 0};
  u = u / length;
  return {u, cross(n, u), size};
}

/// Along a yarn in the middle of the cell.
Vec3 yarn(Direction direction, const Cell& cell, const std::vector<Vec3>& x) {
  const Vec3 a = x[cell.corner[0]], b = x[cell.corner[1]], c = x[cell.corner[2]], d = x[cell.corner[3]];
  switch (direction) {
    case along_row:
      return (b - a) + (c - d);
    case along_column:
      return (d - a) + (c - b);
    case shear_up:
      return c - a;
    default:
      return d - b;
  }
}

constexpr double slack_strain = 1e-5, wrinkled_share = 0.02;

void read_off(CellStress& stress, const Resultant& n, const Frame& frame) {
  const double mean = 0.5 * (n.uu + n.vv), radius = std::hypot(0.5 * (n.uu - n.vv), n.uv);
  stress.principal_max = mean + radius;
  stress.principal_min = mean - radius;
  const double angle = 0.5 * std::atan2(2 * n.uv, n.uu - n.vv);
  stress.direction = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
  stress.von_mises = std::sqrt(std::max(0.0, n.uu * n.uu - n.uu * n.vv + n.vv * n.vv + 3 * n.uv * n.uv));
}

Tautness tautness_of(const CellStress& stress, const Patch& patch) {
  if (!(stress.principal_max > slack_strain * patch.law[patch.warp].tangent(0))) return Tautness::slack;
  return stress.principal_min > wrinkled_share * stress.principal_max ? Tautness::taut : Tautness::wrinkled;
}

}  // namespace

// N = 1/A sum over the cell's share of springs T l n (x) n, in the present quad's plane: force per present
// length (Cauchy), so a pressurised cylinder shows p R and a sphere p R / 2 at the present radius.
std::vector<CellStress> cell_stress(const Cloth& cloth, const ClothState& state) {
  const Mesh& mesh = cloth.mesh;
  const std::vector<Vec3> x = positions(state, cloth);
  const std::vector<Cell>& cells = cloth.cells;
  std::vector<Frame> frames(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i].corner[0] >= 0) frames[i] = frame_of(cells[i], x);
  std::vector<int> first_cell;
  int next = 0;
  for (const Patch& patch : mesh.patches)
    first_cell.push_back(next), next += (patch.rows - 1) * patch.columns;

  std::vector<Resultant> sums(cells.size());
  std::vector<CellStress> stress(cells.size());
  each_spring(mesh, [&](const SpringView& s) {
    if (s.patch < 0) return;
    const CellMap map{mesh.patches[s.patch]};
    const Touched touched = cells_touched(map, s);
    if (touched.count == 0) return;
    const Vec3 d = x[s.b] - x[s.a];
    const double length = norm(d);
    if (!(length > 0)) return;
    const double strain = length / s.rest_length - 1;
    const double share = s.scale * s.law->tension(strain) / length / touched.count;
    for (int i = 0; i < touched.count; ++i) {
      const int cell = first_cell[s.patch] + map.index(touched.row[i], touched.column[i]);
      const Frame& frame = frames[cell];
      const double u = dot(d, frame.u), v = dot(d, frame.v);
      sums[cell].uu += share * u * u;
      sums[cell].vv += share * v * v;
      sums[cell].uv += share * u * v;
      stress[cell].max_strain = std::max(stress[cell].max_strain, strain);
    }
  });
  std::size_t cell = 0;
  for (const Patch& patch : mesh.patches)
    for (int i = 0; i < (patch.rows - 1) * patch.columns; ++i, ++cell) {
      const Frame& frame = frames[cell];
      if (!(frame.area > 0)) continue;
      const Resultant n{sums[cell].uu / frame.area, sums[cell].vv / frame.area, sums[cell].uv / frame.area};
      read_off(stress[cell], n, frame);
      stress[cell].warp = n.along(frame, yarn(patch.warp, cells[cell], x));
      stress[cell].weft = n.along(frame, yarn(patch.weft, cells[cell], x));
      stress[cell].tautness = tautness_of(stress[cell], patch);
    }
  return stress;
}

}  // namespace ripstop::inline cloth

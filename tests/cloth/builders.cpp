#include "builders.h"

#include <algorithm>
#include <cmath>

namespace ripstop::testing {

namespace {

/// The node that a column beyond the seam of a periodic patch represents.
int wrapped(const PatchSpec& spec, int column) {
  return (column + spec.columns) % spec.columns;
}
int index_in(const PatchSpec& spec, int row, int column) {
  return row * spec.columns + wrapped(spec, column);
}
Vec3 rest_position(const PatchSpec& spec, int row, int column) {
  return (spec.rest ? spec.rest : spec.position)(row, wrapped(spec, column));
}

/// The cell's share of the widths of the springs round it, and of its corners' masses.
void add_cell(Mesh& mesh, Patch& patch, const PatchSpec& spec, const FabricSpec& fabric, int row,
              int column) {
  const Vec3 a = rest_position(spec, row, column), b = rest_position(spec, row, column + 1),
             c = rest_position(spec, row + 1, column + 1), d = rest_position(spec, row + 1, column);
  const auto at = [&](int r, int q) { return index_in(spec, r, q); };
  const double area = norm(area_vector(a, b, c, d));
  const double h_row = 0.5 * (norm(b - a) + norm(c - d)), h_column = 0.5 * (norm(d - a) + norm(c - b));
  const CellWidths widths = cell_widths(h_row, h_column, fabric.xi, fabric.eps);
  patch.cell_area[at(row, column)] = area;
  for (int r : {row, row + 1}) {
    patch.width[along_row][at(r, column)] += widths.along_row;
    for (int first : {column - 1, column})
      if (spec.periodic || (first >= 0 && first + 2 < spec.columns))
        patch.width[bend_row][at(r, first)] += widths.bend_row;
    for (int q : {column, column + 1})
      mesh.mass[patch.node(r, wrapped(spec, q))] += 0.25 * area * fabric.areal_density;
  }
  for (int q : {column, column + 1}) {
    patch.width[along_column][at(row, q)] += widths.along_column;
    for (int first : {row - 1, row})
      if (first >= 0 && first + 2 < spec.rows) patch.width[bend_column][at(first, q)] += widths.bend_column;
  }
  patch.width[shear_up][at(row, column)] += widths.shear;
  patch.width[shear_down][at(row, column + 1)] += widths.shear;
}

/// The inner rim of a patch follows the outer rim of one with half as many columns.
void tie_to_coarser(Mesh& mesh, const Patch& fine, const Patch& coarse) {
  for (int j = 0; j < fine.columns; ++j) {
    Tie tie{fine.node(0, j), {{coarse.node(coarse.rows - 1, j / 2), j % 2 ? 0.5 : 1.0}}};
    if (j % 2) tie.masters.push_back({coarse.node(coarse.rows - 1, (j / 2 + 1) % coarse.columns), 0.5});
    mesh.ties.push_back(tie);
  }
}

}  // namespace

int add_patch(Mesh& mesh, const PatchSpec& spec, const FabricSpec& fabric) {
  Patch patch;
  patch.name = spec.name;
  patch.rows = spec.rows;
  patch.columns = spec.columns;
  patch.periodic = spec.periodic;
  patch.first_node = mesh.node_count();
  const SpringLaw whole{fabric.coefficients, fabric.compression, fabric.buckling_strain};
  patch.law[along_row] = patch.law[along_column] = whole.scaled(1 - fabric.xi - fabric.eps);
  patch.law[shear_up] = patch.law[shear_down] = whole.scaled(fabric.xi / 2);
  patch.law[bend_row] = patch.law[bend_column] = whole.scaled(fabric.eps / 2);
  std::fill(std::begin(patch.damping), std::end(patch.damping), fabric.damping);

  const int rows = spec.rows, columns = spec.columns;
  for (int d = 0; d < direction_count; ++d) {
    patch.rest_length[d].assign(rows * columns, 0.0);
    patch.width[d].assign(rows * columns, 0.0);
  }
  patch.cell_area.assign((rows - 1) * columns, 0.0);
  mesh.start.resize(patch.first_node + rows * columns);
  mesh.mass.resize(mesh.start.size(), 0.0);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      mesh.start[patch.node(row, column)] = spec.position(row, column);

  for (int row = 0; row + 1 < rows; ++row)
    for (int column = 0; column + (spec.periodic ? 0 : 1) < columns; ++column)
      if (spec.has_cell(row, column)) add_cell(mesh, patch, spec, fabric, row, column);
  for (int d = 0; d < direction_count; ++d)
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        if (patch.width[d][index_in(spec, row, column)] > 0)
          patch.rest_length[d][index_in(spec, row, column)] =
              norm(rest_position(spec, row + direction_offset[d].row, column + direction_offset[d].column) -
                   rest_position(spec, row, column));
  mesh.patches.push_back(patch);
  return static_cast<int>(mesh.patches.size()) - 1;
}

Mesh rectangle(int rows, int columns, double spacing, const FabricSpec& fabric) {
  Mesh mesh;
  PatchSpec spec;
  spec.rows = rows;
  spec.columns = columns;
  spec.position = [=](int row, int column) { return Vec3{column * spacing, row * spacing, 0}; };
  add_patch(mesh, spec, fabric);
  return mesh;
}

Mesh chain(int segments, Vec3 a, Vec3 b, double rest_length, const SpringLaw& law, double linear_density) {
  Mesh mesh;
  mesh.laws.push_back(law);
  mesh.parts.push_back("line");
  for (int i = 0; i <= segments; ++i) {
    mesh.start.push_back(a + (static_cast<double>(i) / segments) * (b - a));
    mesh.mass.push_back(linear_density * rest_length * (i == 0 || i == segments ? 0.5 : 1.0));
    if (i > 0) mesh.springs.push_back({i - 1, i, rest_length, 1, 0, 0, 0});
  }
  mesh.fixed.push_back(0);
  return mesh;
}

Mesh tied_strips(const FabricSpec& fabric) {
  Mesh mesh = rectangle(8, 9, 0.02, fabric);
  PatchSpec fine;
  fine.rows = 8, fine.columns = 17;
  fine.position = [](int row, int column) { return Vec3{0.01 * column, 0.14 + 0.01 * row, 0}; };
  add_patch(mesh, fine, fabric);
  const Patch &a = mesh.patches[0], &b = mesh.patches[1];
  tie_to_coarser(mesh, b, a);
  return mesh;
}

Mesh medley(double damping, bool fixed, int degree) {
  FabricSpec fabric;
  fabric.damping = damping;
  const std::vector<double> curve = {30006, -18936, 5000, 900};
  fabric.coefficients.assign(curve.begin(), curve.begin() + degree);
  Mesh mesh;
  // A periodic ring of 19 columns (no multiple of 8), a finer one of 38 tied to its rim, a flat flap with a
  // hole, tape along a column, and a line.
  const double pi = std::acos(-1.0);
  const auto ring = [=](int columns, double first_radius, double step) {
    return [=](int row, int column) {
      const double r = first_radius + step * row, t = 2 * pi * column / columns;
      return Vec3{r * std::cos(t), r * std::sin(t), 0.1 * row * step};
    };
  };
  PatchSpec inner;
  inner.name = "inner", inner.rows = 6, inner.columns = 19, inner.periodic = true;
  inner.position = ring(19, 0.05, 0.01);
  add_patch(mesh, inner, fabric);
  PatchSpec outer;
  outer.name = "outer", outer.rows = 5, outer.columns = 38, outer.periodic = true;
  outer.position = ring(38, 0.10, 0.012);
  FabricSpec other = fabric;
  other.compression = 0.3, other.buckling_strain = 0.05, other.damping = 0.5 * damping;
  add_patch(mesh, outer, other);
  PatchSpec flap;
  flap.name = "flap", flap.rows = 7, flap.columns = 11;
  const Vec3 along_line{0.03, -0.02, -0.04};
  const Vec3 corner = outer.position(4, 37) + 4.4 * along_line;
  flap.position = [=](int row, int column) { return corner + Vec3{0.01 * column, 0.011 * row, 0}; };
  flap.has_cell = [](int row, int column) { return !(row == 2 && column == 4) && row + column < 14; };
  add_patch(mesh, flap, fabric);

  const Patch &a = mesh.patches[0], &b = mesh.patches[1], &c = mesh.patches[2];
  tie_to_coarser(mesh, b, a);
  mesh.laws.push_back({{3064.2, 68823.4}, 1, 0.002});
  mesh.laws.push_back({{2118.95, 4896.33, 10.0}, 0});
  mesh.parts = {"tape", "line 0"};
  const auto join = [&](int p, int q, double scale, int law, int part) {
    mesh.springs.push_back(
        {p, q, 0.98 * norm(mesh.start[p] - mesh.start[q]), scale, law, damping > 0 ? 0.01 : 0.0, part});
  };
  for (int row = 0; row + 1 < 5; ++row) join(b.node(row, 7), b.node(row + 1, 7), 0.02, 0, 0);
  join(a.node(2, 0), a.node(3, 0), 0.02, 0, 0);
  int last = b.node(4, 37);
  for (int i = 0; i < 5; ++i) {
    mesh.start.push_back(mesh.start[last] + along_line);
    mesh.mass.push_back(1e-4);
    join(last, mesh.node_count() - 1, 1, 1, 1);
    last = mesh.node_count() - 1;
  }
  // The flap's corner is held on the line's last segment, and tape runs from there.
  mesh.ties.push_back({c.node(0, 0), {{last, 0.4}, {last - 1, 0.6}}});
  join(c.node(0, 0), c.node(1, 0), 0.02, 0, 0);
  for (int node = 0; node < mesh.node_count(); ++node)
    if (mesh.mass[node] == 0) mesh.mass[node] = 1e-6;  // corners without cloth
  if (fixed) mesh.fixed = {a.node(0, 0), a.node(0, 9), c.node(0, 10), last};
  return mesh;
}

std::vector<Vec3> shaken(std::vector<Vec3> positions, double amount, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> to(-amount, amount);
  for (Vec3& x : positions) x += Vec3{to(random), to(random), to(random)};
  return positions;
}

std::vector<Vec3> reference_forces(const Mesh& mesh, const ClothOptions& options, const Loads& loads,
                                   const std::vector<Vec3>& x, const std::vector<Vec3>& v) {
  std::vector<Vec3> f(x.size());
  const auto pull = [&](int p, int q, double rest, double scale, const SpringLaw& given, double damping) {
    const SpringLaw law = options.linear ? given.linearised() : given;
    const Vec3 d = x[q] - x[p];
    const double length = norm(d);
    const Vec3 n = d / length;
    const double strain = length / rest - 1;
    const double taken = strain > -law.buckling_strain ? damping : 0;  // wrinkled springs dissipate no energy
    const Vec3 force = (scale * law.tension(strain) + taken * dot(v[q] - v[p], n)) * n;
    f[p] += force;
    f[q] -= force;
  };
  for (const Patch& patch : mesh.patches)
    for (int d = 0; d < direction_count; ++d)
      for (int row = 0; row < patch.rows; ++row)
        for (int column = 0; column < patch.columns; ++column) {
          const int i = row * patch.columns + column;
          if (patch.width[d][i] > 0)
            pull(patch.node(row, column),
                 patch.node(row + direction_offset[d].row,
                            (column + direction_offset[d].column + patch.columns) % patch.columns),
                 patch.rest_length[d][i], patch.width[d][i], patch.law[d], patch.damping_of(d, row, column));
        }
  for (const Spring& s : mesh.springs) pull(s.a, s.b, s.rest_length, s.scale, mesh.laws[s.law], s.damping);
  const std::vector<Cell> cells = cells_of(mesh);
  std::size_t index = 0;
  for (const Patch& patch : mesh.patches)
    for (double area : patch.cell_area) {
      const auto& c = cells[index].corner;
      if (c[0] >= 0) {
        const double pressure = loads.cell_pressure.empty() ? 0 : loads.cell_pressure[index];
        const Vec3 push = 0.25 * pressure * area_vector(x[c[0]], x[c[1]], x[c[2]], x[c[3]]);
        for (int corner : c) {
          const double damping = options.absolute_damping + options.quadratic_damping * norm(v[corner]);
          f[corner] += push - (0.25 * area * damping) * v[corner];
        }
      }
      ++index;
    }
  for (std::size_t i = 0; i < loads.node_force.size(); ++i) f[i] += loads.node_force[i];
  for (const Tie& tie : mesh.ties) {
    for (const auto& master : tie.masters) f[master.node] += master.weight * f[tie.node];
    f[tie.node] = {};
  }
  return f;
}

std::vector<double> reference_masses(const Mesh& mesh) {
  std::vector<double> mass = mesh.mass;
  for (const Tie& tie : mesh.ties) {
    for (const auto& master : tie.masters) mass[master.node] += master.weight * mesh.mass[tie.node];
    mass[tie.node] = 0;
  }
  return mass;
}

}  // namespace ripstop::testing

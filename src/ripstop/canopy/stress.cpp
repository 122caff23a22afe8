#include "ripstop/canopy/stress.h"

#include <algorithm>
#include <cmath>

namespace ripstop::inline canopy {
namespace {

/// Mean and largest of strains with weights.
class Gathered {
 public:
  void add(double strain, double weight) {
    sum_ += strain * weight;
    weights_ += weight;
    largest_ = std::max(largest_, strain);
  }
  bool any() const { return weights_ > 0; }
  Strains strains() const { return {sum_ / weights_, largest_}; }

 private:
  double sum_ = 0, weights_ = 0, largest_ = -1;
};

double strain_of(const Spring& spring, const std::vector<Vec3>& x) {
  return norm(x[spring.b] - x[spring.a]) / spring.rest_length - 1;
}

void add_cloth(Gathered& cloth, const Patch& patch, const std::vector<Vec3>& x) {
  for (const Direction direction : {along_row, along_column}) {
    const Offset step = direction_offset[direction];
    for (int row = 0; row < patch.rows; ++row) {
      for (int column = 0; column < patch.columns; ++column) {
        const std::size_t at = std::size_t(row) * patch.columns + column;
        const double width = patch.width[direction][at], rest = patch.rest_length[direction][at];
        if (!(width > 0)) continue;
        const Vec3 d = x[patch.node(row + step.row, (column + step.column) % patch.columns)] -
                       x[patch.node(row, column)];
        cloth.add(norm(d) / rest - 1, width * rest);
      }
    }
  }
}

/// How much of the cell `away` rows or columns from its middle cell a strip covers that is `cells` wide.
double covered(double cells, int away) {
  return std::clamp(0.5 * cells + 0.5 - std::abs(away), 0.0, 1.0);
}

/// The cells' stresses in forces per width as cut, where cloth is gathered: its strength is one of its width.
std::vector<CellStress> per_cut_width(const Mesh& mesh, const std::vector<Cell>& cells,
                                      const std::vector<Vec3>& x, std::vector<CellStress> stress) {
  std::size_t cell = 0;
  for (const Patch& patch : mesh.patches) {
    for (int i = 0; i < (patch.rows - 1) * patch.columns; ++i, ++cell) {
      const auto [a, b, c, d] = cells[cell].corner;
      if (a < 0) continue;
      const double share = std::min(1.0, norm(area_vector(x[a], x[b], x[c], x[d])) / patch.cell_area[i]);
      CellStress& s = stress[cell];
      for (double* value : {&s.von_mises, &s.principal_max, &s.warp, &s.weft}) *value *= share;
    }
  }
  return stress;
}

/// With the mean forces over a square of cloth about cell (row, column), strip_width wide as cut, as far as the patch goes.
CellStress over_strip(const Patch& patch, const CellStress* stress, int row, int column) {
  const auto index = [&](int r, int c) { return r * patch.columns + c; };
  const int middle = index(row, column);
  const double columns = std::max(1.0, strip_width / patch.rest_length[along_row][middle]),
               rows = std::max(1.0, strip_width / patch.rest_length[along_column][middle]);
  int column_reach = static_cast<int>(0.5 * columns + 0.5);
  const int row_reach = static_cast<int>(0.5 * rows + 0.5);
  if (patch.periodic) column_reach = std::min(column_reach, (patch.columns - 1) / 2);
  CellStress mean = stress[middle];
  double weights = 0;
  mean.von_mises = mean.principal_max = mean.warp = mean.weft = 0;
  for (int dr = -row_reach; dr <= row_reach; ++dr) {
    if (row + dr < 0 || row + dr >= patch.rows - 1) continue;
    for (int dc = -column_reach; dc <= column_reach; ++dc) {
      int c = column + dc;
      if (patch.periodic) c = (c + patch.columns) % patch.columns;
      if (c < 0 || c >= patch.columns) continue;
      const int i = index(row + dr, c);
      const double weight = covered(rows, dr) * covered(columns, dc) * patch.cell_area[i];
      weights += weight;
      mean.von_mises += weight * stress[i].von_mises;
      mean.principal_max += weight * stress[i].principal_max;
      mean.warp += weight * stress[i].warp;
      mean.weft += weight * stress[i].weft;
    }
  }
  for (double* value : {&mean.von_mises, &mean.principal_max, &mean.warp, &mean.weft}) *value /= weights;
  return mean;
}

}  // namespace

std::vector<LineTension> line_tensions(const CanopyMesh& mesh, const std::vector<double>& spring_tensions) {
  std::vector<LineTension> tensions;
  for (const LineRun& line : mesh.rigging.lines) {
    LineTension t;
    t.number = line.radial + 1;
    t.apex = line.apex;
    for (const int spring : line.springs) {
      t.largest_tension = std::max(t.largest_tension, spring_tensions[spring] / line.axial_share);
    }
    t.free_tension = spring_tensions[line.springs[line.free_springs / 2]] / line.axial_share;
    tensions.push_back(t);
  }
  return tensions;
}

double chain_tension(double axial, double bending_fraction, std::size_t at, std::size_t count) {
  const int over = (at > 0) + (at + 1 < count);
  const double share = 1 - bending_fraction;
  return axial * (share + 0.5 * bending_fraction * over) / share;
}

std::vector<CellStress> strip_stress(const Mesh& mesh, const std::vector<Vec3>& x,
                                     const std::vector<CellStress>& of_cells) {
  const std::vector<Cell> cells = cells_of(mesh);
  const std::vector<CellStress> stress = per_cut_width(mesh, cells, x, of_cells);
  std::vector<CellStress> means = stress;
  std::size_t cell = 0;
  for (const Patch& patch : mesh.patches)
    for (int i = 0; i < (patch.rows - 1) * patch.columns; ++i, ++cell)
      if (cells[cell].corner[0] >= 0)
        means[cell] = over_strip(patch, &stress[cell - i], i / patch.columns, i % patch.columns);
  return means;
}

StressPeak stress_peak(const Mesh& mesh, const std::vector<Vec3>& x,
                       const std::vector<CellStress>& of_cells) {
  StressPeak peak;
  const std::vector<Cell> cells = cells_of(mesh);
  const std::vector<CellStress> means = strip_stress(mesh, x, of_cells);
  std::size_t cell = 0;
  double area = 0;
  for (const Patch& patch : mesh.patches) {
    for (int i = 0; i < (patch.rows - 1) * patch.columns; ++i, ++cell) {
      if (cells[cell].corner[0] < 0) continue;
      area += patch.cell_area[i];
      if (of_cells[cell].tautness == Tautness::wrinkled) peak.wrinkled += patch.cell_area[i];
      if (of_cells[cell].tautness == Tautness::slack) peak.slack += patch.cell_area[i];
      const CellStress& mean = means[cell];
      peak.warp = std::max(peak.warp, mean.warp);
      peak.weft = std::max(peak.weft, mean.weft);
      if (mean.principal_max > peak.principal) {
        peak.principal = mean.principal_max;
        peak.principal_direction = mean.direction;
      }
      peak.strain = std::max(peak.strain, mean.max_strain);
      if (mean.von_mises <= peak.von_mises) continue;
      peak.von_mises = mean.von_mises;
      peak.patch = patch.name;
      peak.place = {};
      for (const int node : cells[cell].corner) peak.place += 0.25 * x[node];
    }
  }
  if (area > 0) peak.wrinkled /= area, peak.slack /= area;
  return peak;
}

std::map<std::string, Strains> part_strains(const CanopyMesh& mesh, const std::vector<Vec3>& x) {
  Gathered lines, tape, cloth;
  for (const LineRun& line : mesh.rigging.lines) {
    for (int i = 0; i < line.free_springs; ++i) {
      const Spring& spring = mesh.springs[line.springs[i]];
      lines.add(strain_of(spring, x), spring.rest_length);
    }
  }
  for (const int index : mesh.rigging.tape_springs) {
    const Spring& spring = mesh.springs[index];
    tape.add(strain_of(spring, x), spring.rest_length * spring.scale);
  }
  for (const Patch& patch : mesh.patches) add_cloth(cloth, patch, x);
  std::map<std::string, Strains> strains;
  if (lines.any()) strains["lines"] = lines.strains();
  if (tape.any()) strains["tape"] = tape.strains();
  if (cloth.any()) strains["cloth"] = cloth.strains();
  return strains;
}

}  // namespace ripstop::inline canopy

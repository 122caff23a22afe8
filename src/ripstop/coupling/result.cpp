#include "ripstop/coupling/result.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ripstop {
namespace {

constexpr double pi = std::numbers::pi;

double circle_of(double area) {
  return std::sqrt(4 * std::abs(area) / pi);
}

// The outline seen along z: the farthest cloth in every direction from the axis. Rows are followed from node
// to node, since a coarse mesh has fewer columns than there are directions.
double outline_area(const Mesh& mesh, const std::vector<Vec3>& x) {
  constexpr int sectors = 180, steps = 8;
  std::vector<double> radius(sectors, 0.0);
  for (const Patch& patch : mesh.patches) {
    for (int row = 0; row < patch.rows; ++row) {
      for (int column = 0; column < patch.columns; ++column) {
        const bool last = column + 1 == patch.columns;
        const Vec3 a = x[patch.node(row, column)];
        const Vec3 b = last && !patch.periodic ? a : x[patch.node(row, last ? 0 : column + 1)];
        for (int k = 0; k < steps; ++k) {
          const Vec3 p = a + (double(k) / steps) * (b - a);
          const double angle = std::atan2(p.y, p.x) + pi;
          const int sector = std::min(sectors - 1, static_cast<int>(angle / (2 * pi) * sectors));
          radius[sector] = std::max(radius[sector], std::hypot(p.x, p.y));
        }
      }
    }
  }
  double area = 0;
  for (const double r : radius) area += pi * r * r / sectors;
  return area;
}

}  // namespace

CanopySize canopy_size(const Mesh& mesh, const std::vector<Vec3>& x) {
  CanopySize size;
  size.projected_area = outline_area(mesh, x);
  size.projected_diameter = circle_of(size.projected_area);
  double skirt_area = 0, skirt_z = 0;
  const std::size_t n = mesh.skirt_nodes.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 a = x[mesh.skirt_nodes[i]], b = x[mesh.skirt_nodes[(i + 1) % n]];
    skirt_area += 0.5 * (a.x * b.y - a.y * b.x);
    skirt_z += a.z / double(n);
  }
  size.skirt_diameter = circle_of(skirt_area);
  for (const Patch& patch : mesh.patches) {
    for (int node = patch.first_node; node < patch.first_node + patch.rows * patch.columns; ++node) {
      size.length = std::max(size.length, x[node].z - skirt_z);
    }
  }
  return size;
}

std::vector<LineTension> line_tensions(const Mesh& mesh, const std::vector<double>& spring_tensions) {
  std::vector<LineTension> tensions;
  for (const LineRun& line : mesh.lines) {
    LineTension t;
    t.radial = line.radial;
    for (const int spring : line.springs) {
      t.largest_tension = std::max(t.largest_tension, spring_tensions[spring] / line.axial_share);
    }
    t.free_tension = spring_tensions[line.springs[line.free_springs / 2]] / line.axial_share;
    tensions.push_back(t);
  }
  return tensions;
}

StressPeak stress_peak(const Mesh& mesh, const std::vector<Vec3>& x, const std::vector<CellStress>& stress) {
  StressPeak peak;
  const std::vector<Cell> cells = cells_of(mesh);
  std::size_t cell = 0;
  for (const Patch& patch : mesh.patches) {
    for (int i = 0; i < (patch.rows - 1) * patch.columns; ++i, ++cell) {
      if (cells[cell].corner[0] < 0) continue;
      peak.strain = std::max(peak.strain, stress[cell].max_strain);
      if (stress[cell].von_mises <= peak.von_mises) continue;
      peak.von_mises = stress[cell].von_mises;
      peak.patch = patch.name;
      peak.place = {};
      for (const int node : cells[cell].corner) peak.place += 0.25 * x[node];
    }
  }
  return peak;
}

}  // namespace ripstop

#include "ripstop/parachute/builder.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "ripstop/material/lattice.h"

namespace ripstop {
namespace {

// Adds what one cell gives to the springs that border, cross or span it.
void add_cell_widths(Patch& patch, int row, int column, const CellWidths& w) {
  const auto wrap = [&](int c) { return (c % patch.columns + patch.columns) % patch.columns; };
  const auto add = [&](Direction d, int r, int c, double width) {
    patch.width[d][r * patch.columns + wrap(c)] += width;
  };
  const bool may_span_left = patch.periodic || column > 0;
  const bool may_span_right = patch.periodic || column + 2 < patch.columns;
  for (const int r : {row, row + 1}) {
    add(along_row, r, column, w.along_row);
    if (may_span_right) add(bend_row, r, column, w.bend_row);
    if (may_span_left) add(bend_row, r, column - 1, w.bend_row);
  }
  for (const int c : {column, column + 1}) {
    add(along_column, row, c, w.along_column);
    if (row + 2 < patch.rows) add(bend_column, row, c, w.bend_column);
    if (row > 0) add(bend_column, row - 1, c, w.bend_column);
  }
  add(shear_up, row, column, w.shear);
  add(shear_down, row, column + 1, w.shear);
}

}  // namespace

int MeshBuilder::part(const std::string& name) {
  const auto found = std::find(mesh.parts.begin(), mesh.parts.end(), name);
  if (found != mesh.parts.end()) return static_cast<int>(found - mesh.parts.begin());
  mesh.parts.push_back(name);
  return static_cast<int>(mesh.parts.size()) - 1;
}

int MeshBuilder::law(SpringLaw law) {
  mesh.laws.push_back(std::move(law));
  return static_cast<int>(mesh.laws.size()) - 1;
}

int MeshBuilder::add_node(Vec3 start, double mass) {
  mesh.start.push_back(start);
  mesh.mass.push_back(mass);
  return mesh.node_count() - 1;
}

int MeshBuilder::add_patch(const std::string& name, int rows, int columns, bool periodic, bool rolled_rows,
                           const Fabric& fabric, const std::function<Vec3(int, int)>& position) {
  Patch patch;
  patch.name = name;
  patch.rows = rows;
  patch.columns = columns;
  patch.periodic = periodic;
  patch.first_node = mesh.node_count();
  const auto known = std::find(mesh.fabric_names.begin(), mesh.fabric_names.end(), fabric.name);
  patch.fabric = static_cast<int>(known - mesh.fabric_names.begin());
  if (known == mesh.fabric_names.end()) mesh.fabric_names.push_back(fabric.name);

  const LatticeLaws laws = lattice_laws(fabric.coefficients_n_m, fabric.shear_fraction,
                                        fabric.bending_fraction, fabric.compression, fabric.tested_strain);
  for (const Direction d : {along_row, along_column}) patch.law[d] = laws.axial;
  for (const Direction d : {shear_up, shear_down}) patch.law[d] = laws.shear;
  for (const Direction d : {bend_row, bend_column}) patch.law[d] = laws.bending;
  std::fill(std::begin(patch.damping), std::end(patch.damping), fabric.damping_n_s_m);

  const int nodes = rows * columns;
  for (int d = 0; d < direction_count; ++d) {
    patch.rest_length[d].assign(nodes, 0.0);
    patch.width[d].assign(nodes, 0.0);
  }
  patch.cell_area.assign(nodes, 0.0);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) add_node(position(row, column), 0.0);
  }

  const auto at = [&](int row, int column) { return mesh.start[patch.node(row, column % columns)]; };
  for (int row = 0; row + 1 < rows; ++row) {
    for (int column = 0; column < (periodic ? columns : columns - 1); ++column) {
      const Vec3 a = at(row, column), b = at(row, column + 1), c = at(row + 1, column + 1),
                 d = at(row + 1, column);
      const double h_row = 0.5 * (norm(b - a) + norm(c - d));
      const double h_column = 0.5 * (norm(d - a) + norm(c - b));
      add_cell_widths(patch, row, column,
                      cell_widths(h_row, h_column, fabric.shear_fraction, fabric.bending_fraction));
      const double area = norm(area_vector(a, b, c, d));
      patch.cell_area[row * columns + column] = area;
      const int next = (column + 1) % columns;
      for (const int node : {patch.node(row, column), patch.node(row, next), patch.node(row + 1, next),
                             patch.node(row + 1, column)}) {
        mesh.mass[node] += 0.25 * area * fabric.areal_density_kg_m2;
      }
    }
  }
  for (int d = 0; d < direction_count; ++d) {
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const int i = row * columns + column;
        if (patch.width[d][i] <= 0) continue;
        const int other = (column + direction_offset[d].column + columns) % columns;
        patch.rest_length[d][i] = d == bend_row && rolled_rows
                                      ? norm(at(row, column + 1) - at(row, column)) +
                                            norm(at(row, column + 2) - at(row, column + 1))
                                      : norm(at(row + direction_offset[d].row, other) - at(row, column));
      }
    }
  }
  mesh.patches.push_back(std::move(patch));
  return static_cast<int>(mesh.patches.size()) - 1;
}

void MeshBuilder::add_tape(const std::vector<int>& nodes, bool closed, const Tape& tape, int tape_law,
                           int tape_part) {
  const std::size_t segments = closed ? nodes.size() : nodes.size() - 1;
  for (std::size_t i = 0; i < segments; ++i) {
    const int a = nodes[i], b = nodes[(i + 1) % nodes.size()];
    const double length = norm(mesh.start[b] - mesh.start[a]);
    mesh.springs.push_back({a, b, length, tape.width_m, tape_law, tape.damping_n_s_m, tape_part});
    mesh.mass[a] += 0.5 * length * tape.linear_density_kg_m;
    mesh.mass[b] += 0.5 * length * tape.linear_density_kg_m;
  }
}

std::vector<int> MeshBuilder::add_chain(const std::vector<int>& nodes, const Line& line, int axial_law,
                                        int bending_law, int line_part) {
  std::vector<int> axial;
  std::vector<double> length(nodes.size() - 1);
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const int a = nodes[i], b = nodes[i + 1];
    length[i] = norm(mesh.start[b] - mesh.start[a]);
    axial.push_back(static_cast<int>(mesh.springs.size()));
    mesh.springs.push_back({a, b, length[i], 1.0, axial_law, line.damping_n_s_m, line_part});
    mesh.mass[a] += 0.5 * length[i] * line.linear_density_kg_m;
    mesh.mass[b] += 0.5 * length[i] * line.linear_density_kg_m;
  }
  for (std::size_t i = 0; i + 2 < nodes.size(); ++i) {
    mesh.springs.push_back(
        {nodes[i], nodes[i + 2], length[i] + length[i + 1], 1.0, bending_law, line.damping_n_s_m, line_part});
  }
  return axial;
}

void MeshBuilder::tie(int node, std::vector<Tie::Master> masters) {
  mesh.ties.push_back({node, std::move(masters)});
}

void MeshBuilder::flatten_ties() {
  std::map<int, const Tie*> tied;
  for (const Tie& tie : mesh.ties) tied[tie.node] = &tie;
  std::vector<Tie> flat;
  for (const Tie& tie : mesh.ties) {
    std::map<int, double> weights;
    std::function<void(const Tie&, double)> collect = [&](const Tie& t, double factor) {
      for (const Tie::Master& master : t.masters) {
        const auto found = tied.find(master.node);
        if (found == tied.end()) {
          weights[master.node] += factor * master.weight;
        } else {
          collect(*found->second, factor * master.weight);
        }
      }
    };
    collect(tie, 1.0);
    Tie result{tie.node, {}};
    for (const auto& [node, weight] : weights) result.masters.push_back({node, weight});
    flat.push_back(std::move(result));
  }
  mesh.ties = std::move(flat);
}

}  // namespace ripstop

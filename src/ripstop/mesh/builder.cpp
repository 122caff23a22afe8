#include "ripstop/mesh/builder.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ripstop::inline mesh {
namespace {

// Index of a name, added where it is new.
int index_of(const std::string& name, std::vector<std::string>& names) {
  const auto known = std::find(names.begin(), names.end(), name);
  if (known != names.end()) return static_cast<int>(known - names.begin());
  names.push_back(name);
  return static_cast<int>(names.size()) - 1;
}

// Adds the contribution of one cell to the springs that border, cross or span it.
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

// A cell of cloth with the corners `corners` as cut: its area, its share of the springs around it, and how long
// those are that border and cross it.
void add_cell(Patch& patch, int row, int column, const std::array<Vec3, 4>& corners, const WovenLaws& laws,
              FabricCut grain) {
  const auto [a, b, c, d] = corners;
  const double h_row = 0.5 * (norm(b - a) + norm(c - d));
  const double h_column = 0.5 * (norm(d - a) + norm(c - b));
  const bool bias = grain == FabricCut::bias;
  add_cell_widths(patch, row, column,
                  bias ? bias_widths(h_row, h_column, laws) : cell_widths(h_row, h_column, laws));
  const int cell = row * patch.columns + column, next = row * patch.columns + (column + 1) % patch.columns;
  patch.rest_length[along_row][cell] = norm(b - a);
  patch.rest_length[along_row][cell + patch.columns] = norm(c - d);
  patch.rest_length[along_column][cell] = norm(d - a);
  patch.rest_length[along_column][next] = norm(c - b);
  patch.rest_length[shear_up][cell] = norm(c - a);
  patch.rest_length[shear_down][next] = norm(d - b);
  patch.cell_area[cell] = norm(area_vector(a, b, c, d));
}

// Springs over two cells are as long as both, or along a row of a curved start shape as long as it has them.
void set_bending_lengths(Patch& patch, const PatchShape& shape, const std::vector<Vec3>& start) {
  const auto at = [&](int row, int column) { return start[patch.node(row, column % patch.columns)]; };
  for (int row = 0; row < patch.rows; ++row) {
    for (int column = 0; column < patch.columns; ++column) {
      const int i = row * patch.columns + column;
      const int next = row * patch.columns + (column + 1) % patch.columns;
      if (patch.width[bend_row][i] > 0) {
        patch.rest_length[bend_row][i] =
            shape.cut || shape.rolled_rows
                ? patch.rest_length[along_row][i] + patch.rest_length[along_row][next]
                : norm(at(row, column + 2) - at(row, column));
      }
      if (patch.width[bend_column][i] > 0) {
        patch.rest_length[bend_column][i] =
            patch.rest_length[along_column][i] + patch.rest_length[along_column][i + patch.columns];
      }
    }
  }
}

}  // namespace

double Path::length() const {
  return std::accumulate(lengths.begin(), lengths.end(), 0.0);
}

void Path::append(const Path& next, double gap) {
  if (!nodes.empty()) lengths.push_back(gap);
  nodes.insert(nodes.end(), next.nodes.begin(), next.nodes.end());
  lengths.insert(lengths.end(), next.lengths.begin(), next.lengths.end());
}

void Path::extend(const Path& next) {
  if (!nodes.empty()) nodes.pop_back();
  nodes.insert(nodes.end(), next.nodes.begin(), next.nodes.end());
  lengths.insert(lengths.end(), next.lengths.begin(), next.lengths.end());
}

int MeshBuilder::part(const std::string& name) {
  return index_of(name, mesh.parts);
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

const WovenLaws& MeshBuilder::laws_of(const Fabric& fabric) {
  const auto known = laws_.find(fabric.name);
  return known != laws_.end() ? known->second : laws_.emplace(fabric.name, woven_laws(fabric)).first->second;
}

void MeshBuilder::set_laws(Patch& patch, const WovenLaws& laws, FabricCut grain) {
  if (grain == FabricCut::bias) {
    patch.law[shear_up] = whole_yarn(laws.warp, laws.warp_bending);
    patch.law[shear_down] = whole_yarn(laws.weft, laws.weft_bending);
    patch.law[along_row] = patch.law[along_column] = laws.shear;
    patch.warp = shear_up, patch.weft = shear_down;
    return;
  }
  patch.law[along_column] = laws.warp;
  patch.law[along_row] = laws.weft;
  patch.law[shear_up] = patch.law[shear_down] = laws.shear;
  patch.law[bend_column] = laws.warp_bending;
  patch.law[bend_row] = laws.weft_bending;
  if (grain == FabricCut::across) std::swap(patch.warp, patch.weft);
}

int MeshBuilder::add_patch(const std::string& name, const PatchShape& shape, const Fabric& fabric) {
  Patch patch;
  patch.name = name;
  patch.rows = shape.rows;
  patch.columns = shape.columns;
  patch.periodic = shape.periodic;
  patch.first_node = mesh.node_count();
  patch.fabric = index_of(fabric.name, mesh.fabric_names);
  const WovenLaws laws = shape.grain == FabricCut::across ? exchanged(laws_of(fabric)) : laws_of(fabric);
  set_laws(patch, laws, shape.grain);
  std::fill(std::begin(patch.damping), std::end(patch.damping), fabric.damping_n_s_m);

  const int nodes = patch.rows * patch.columns;
  for (int d = 0; d < direction_count; ++d) {
    patch.rest_length[d].assign(nodes, 0.0);
    patch.width[d].assign(nodes, 0.0);
  }
  patch.cell_area.assign((patch.rows - 1) * patch.columns, 0.0);
  for (int row = 0; row < patch.rows; ++row) {
    for (int column = 0; column < patch.columns; ++column) add_node(shape.start(row, column), 0.0);
  }
  const auto at = [&](int row, int column) { return mesh.start[patch.node(row, column % patch.columns)]; };
  for (int row = 0; row + 1 < patch.rows; ++row) {
    for (int column = 0; column < (patch.periodic ? patch.columns : patch.columns - 1); ++column) {
      const auto corners = shape.cut ? shape.cut(row, column)
                                     : std::array{at(row, column), at(row, column + 1),
                                                  at(row + 1, column + 1), at(row + 1, column)};
      add_cell(patch, row, column, corners, laws, shape.grain);
      const int next = (column + 1) % patch.columns;
      for (const int node : {patch.node(row, column), patch.node(row, next), patch.node(row + 1, next),
                             patch.node(row + 1, column)}) {
        mesh.mass[node] += 0.25 * patch.cell_area[row * patch.columns + column] * fabric.areal_density_kg_m2;
      }
    }
  }
  set_bending_lengths(patch, shape, mesh.start);
  mesh.patches.push_back(std::move(patch));
  return static_cast<int>(mesh.patches.size()) - 1;
}

Path MeshBuilder::row(int index, int row) const {
  const Patch& patch = mesh.patches[index];
  Path path;
  const int cells = patch.periodic ? patch.columns : patch.columns - 1;
  for (int column = 0; column <= cells; ++column)
    path.nodes.push_back(patch.node(row, column % patch.columns));
  for (int column = 0; column < cells; ++column)
    path.lengths.push_back(patch.rest_length[along_row][row * patch.columns + column]);
  return path;
}

Path MeshBuilder::column(int index, int column, int first_row, int last_row) const {
  const Patch& patch = mesh.patches[index];
  Path path;
  for (int row = first_row; row <= last_row; ++row) path.nodes.push_back(patch.node(row, column));
  for (int row = first_row; row < last_row; ++row)
    path.lengths.push_back(patch.rest_length[along_column][row * patch.columns + column]);
  return path;
}

void MeshBuilder::tie_rows(int lower, int upper) {
  const Patch& below = mesh.patches[lower];
  const Patch& above = mesh.patches[upper];
  const int ratio = below.columns / above.columns;  // 1 or 2
  for (int column = 0; column < below.columns; ++column) {
    const int node = below.node(below.rows - 1, column), left = above.node(0, column / ratio);
    if (column % ratio == 0) {
      tie(node, {{left, 1.0}});
    } else {
      tie(node, {{left, 0.5}, {above.node(0, (column / ratio + 1) % above.columns), 0.5}});
    }
  }
}

std::vector<int> MeshBuilder::add_springs(const Path& path, const Strand& strand) {
  std::vector<int> springs;
  for (std::size_t i = 0; i + 1 < path.nodes.size(); ++i) {
    const int a = path.nodes[i], b = path.nodes[i + 1];
    const double length = path.lengths[i];
    springs.push_back(static_cast<int>(mesh.springs.size()));
    mesh.springs.push_back({a, b, length, strand.scale, strand.law, strand.damping, strand.part});
    mesh.mass[a] += 0.5 * length * strand.linear_density;
    mesh.mass[b] += 0.5 * length * strand.linear_density;
  }
  return springs;
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
  for (const Tie& tie : mesh.ties) {
    Vec3 place{};
    for (const Tie::Master& master : tie.masters) place += master.weight * mesh.start[master.node];
    mesh.start[tie.node] = place;
  }
}

}  // namespace ripstop::inline mesh

#include "ripstop/parachute/own_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "ripstop/core/error.h"

namespace ripstop::inline parachute {
namespace {

constexpr double farthest = 1e4;     // of a node from the origin [m]; longer than any key of a design allows
constexpr int most_nodes = 5000000;  // of one lattice

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ExitCode::usage, "mesh: " + message);
}

void require_points(const std::vector<Vec3>& points, const std::string& where) {
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const double value : {points[i].x, points[i].y, points[i].z})
      if (!(std::abs(value) <= farthest))
        refuse(fmt::format("{}, point {}: {} m; coordinates are within {:g} m of the origin", where, i, value,
                           farthest));
}

void require_lattice(const std::string& name, const ClothLattice& lattice) {
  const int fewest = lattice.closed ? 3 : 2;
  if (name.empty()) refuse("cloth needs a name, which results use for its place");
  if (lattice.rows < 2 || lattice.columns < fewest)
    refuse(fmt::format("cloth \"{}\" has {} rows and {} columns; at least 2 rows and {} columns are needed",
                       name, lattice.rows, lattice.columns, fewest));
  const auto count = static_cast<std::size_t>(lattice.rows) * static_cast<std::size_t>(lattice.columns);
  if (count > most_nodes)
    refuse(fmt::format("cloth \"{}\" has {} nodes, at most {}", name, count, most_nodes));
  if (lattice.points.size() != count)
    refuse(fmt::format("cloth \"{}\" has {} points for {} rows of {}", name, lattice.points.size(),
                       lattice.rows, lattice.columns));
  const std::size_t flat = count + static_cast<std::size_t>(lattice.closed ? lattice.rows : 0);
  if (!lattice.flat.empty() && lattice.flat.size() != flat)
    refuse(fmt::format(
        "cloth \"{}\" has {} points as cut; {} rows of {} are needed{}", name, lattice.flat.size(),
        lattice.rows, lattice.columns + (lattice.closed ? 1 : 0),
        lattice.closed ? ", since a closed lattice repeats its first column when it is flat" : ""));
  require_points(lattice.points, fmt::format("cloth \"{}\"", name));
  require_points(lattice.flat, fmt::format("cloth \"{}\" as cut", name));
}

/// Every spring of a new lattice has a length.
void require_lengths(const Patch& patch) {
  for (int d = 0; d < direction_count; ++d)
    for (std::size_t i = 0; i < patch.width[d].size(); ++i)
      if (patch.width[d][i] != 0 && !(patch.rest_length[d][i] > 0 && patch.width[d][i] > 0))
        refuse(fmt::format("cloth \"{}\", row {}, column {}: two neighbouring points coincide", patch.name,
                           static_cast<int>(i) / patch.columns, static_cast<int>(i) % patch.columns));
}

}  // namespace

OwnMesh::OwnMesh(CanopyMesh mesh, PartMaterials materials) : materials_(std::move(materials)) {
  builder_.rigging = std::move(mesh.rigging);
  builder_.mesh = std::move(mesh);
}

void OwnMesh::require_nodes(const std::vector<int>& nodes) const {
  const int count = builder_.mesh.node_count();
  for (const int node : nodes)
    if (node < 0 || node >= count)
      refuse(fmt::format("there is no node {}; {}", node,
                         count > 0 ? fmt::format("nodes are numbered from 0 to {}", count - 1)
                                   : "add cloth or nodes first"));
}

int OwnMesh::add_cloth(const std::string& name, const ClothLattice& lattice) {
  require_lattice(name, lattice);
  for (const Patch& patch : builder_.mesh.patches)
    if (patch.name == name) refuse(fmt::format("there is a cloth \"{}\" already", name));
  const auto at = [](int row, int column, int columns) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  };
  PatchShape shape{lattice.rows, lattice.columns, lattice.closed,
                   [&](int row, int column) { return lattice.points[at(row, column, lattice.columns)]; }};
  if (!lattice.flat.empty())
    shape.cut = [&](int row, int column) {
      const int columns = lattice.columns + (lattice.closed ? 1 : 0);
      const auto flat = [&](int r, int c) { return lattice.flat[at(r, c, columns)]; };
      return std::array{flat(row, column), flat(row, column + 1), flat(row + 1, column + 1),
                        flat(row + 1, column)};
    };
  CanopyBuilder larger = builder_;  // remains without this cloth if it is refused
  const int index = larger.add_patch(name, shape, materials_.canopy);
  const Patch& patch = larger.mesh.patches[static_cast<std::size_t>(index)];
  require_lengths(patch);
  builder_ = std::move(larger);
  return builder_.mesh.patches.back().first_node;
}

int OwnMesh::add_nodes(const std::vector<Vec3>& points) {
  if (points.empty()) refuse("no point is given");
  require_points(points, "nodes");
  const int first = builder_.mesh.node_count();
  for (const Vec3 point : points) builder_.add_node(point, 0);
  return first;
}

Path OwnMesh::path(const std::vector<int>& nodes, std::vector<double> lengths) const {
  require_nodes(nodes);
  if (nodes.size() < 2) refuse("a line or tape needs at least two nodes");
  const bool at_start = lengths.empty();
  if (!at_start && lengths.size() + 1 != nodes.size())
    refuse(fmt::format("{} lengths for {} nodes; one between every two is needed", lengths.size(),
                       nodes.size()));
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const auto place = [&](int node) { return builder_.mesh.start[static_cast<std::size_t>(node)]; };
    if (at_start) lengths.push_back(norm(place(nodes[i + 1]) - place(nodes[i])));
    if (!(lengths[i] > 0 && lengths[i] <= farthest) || nodes[i] == nodes[i + 1])
      refuse(fmt::format("the length between nodes {} and {} is {} m; above 0 and up to {:g} m is allowed",
                         nodes[i], nodes[i + 1], lengths[i], farthest));
  }
  return {nodes, std::move(lengths)};
}

void OwnMesh::add_line(const std::vector<int>& nodes, const std::vector<double>& lengths) {
  builder_.add_line_along(path(nodes, lengths), materials_.line);
}

void OwnMesh::add_tape(const std::vector<int>& nodes, const std::vector<double>& lengths) {
  if (!materials_.tape) refuse("the case has no tape; name one in the case");
  builder_.add_tape(path(nodes, lengths), *materials_.tape, builder_.add_tape_law(*materials_.tape),
                    builder_.part("tape"));
}

void OwnMesh::tie(int node, const std::vector<int>& masters, const std::vector<double>& weights) {
  require_nodes({node});
  require_nodes(masters);
  if (masters.empty()) refuse(fmt::format("node {} is tied to no node", node));
  if (!weights.empty() && weights.size() != masters.size())
    refuse(fmt::format("{} weights for {} nodes", weights.size(), masters.size()));
  const auto tied = [&](int other) {
    return std::any_of(builder_.mesh.ties.begin(), builder_.mesh.ties.end(),
                       [&](const Tie& tie) { return tie.node == other; });
  };
  const std::vector<int>& fixed = builder_.mesh.fixed;
  if (tied(node)) refuse(fmt::format("node {} is tied already", node));
  if (std::find(fixed.begin(), fixed.end(), node) != fixed.end())
    refuse(fmt::format("node {} is fixed and cannot be tied", node));
  std::vector<Tie::Master> all;
  for (std::size_t i = 0; i < masters.size(); ++i) {
    if (masters[i] == node || tied(masters[i]))
      refuse(fmt::format("node {} cannot follow node {}, which is {}; name nodes that are not tied", node,
                         masters[i], masters[i] == node ? "itself" : "tied"));
    all.push_back({masters[i], weights.empty() ? 1.0 / static_cast<double>(masters.size()) : weights[i]});
    if (!(all.back().weight >= 0)) refuse(fmt::format("weight {} is below 0", all.back().weight));
  }
  const double sum = std::accumulate(all.begin(), all.end(), 0.0,
                                     [](double s, const Tie::Master& m) { return s + m.weight; });
  if (!(std::abs(sum - 1) < 1e-9))
    refuse(fmt::format("the weights of node {} add up to {}, not 1", node, sum));
  builder_.tie(node, std::move(all));
}

void OwnMesh::fix(const std::vector<int>& nodes) {
  require_nodes(nodes);
  std::vector<int>& fixed = builder_.mesh.fixed;
  for (const int node : nodes) {
    if (std::any_of(builder_.mesh.ties.begin(), builder_.mesh.ties.end(),
                    [&](const Tie& tie) { return tie.node == node; }))
      refuse(fmt::format("node {} is tied and cannot be fixed; fix the nodes that it follows", node));
    if (std::find(fixed.begin(), fixed.end(), node) == fixed.end()) fixed.push_back(node);
  }
}

void OwnMesh::set_skirt(const std::vector<int>& nodes) {
  require_nodes(nodes);
  if (nodes.size() < 3) refuse(fmt::format("a skirt of {} nodes; at least 3 are needed", nodes.size()));
  builder_.rigging.skirt_nodes = nodes;
}

CanopyMesh OwnMesh::mesh() const {
  CanopyMesh made = CanopyBuilder(builder_).finish();
  if (made.patches.empty()) refuse("there is no cloth; add some");
  if (made.fixed.empty()) refuse("no node is fixed; fix the end of the lines, or an edge of the cloth");
  std::vector<double> mass = made.mass;
  for (const int node : made.fixed) mass[static_cast<std::size_t>(node)] = 1;
  for (const Tie& tie : made.ties) {
    const double own = std::exchange(mass[static_cast<std::size_t>(tie.node)], 1.0);
    for (const Tie::Master& m : tie.masters) mass[static_cast<std::size_t>(m.node)] += m.weight * own;
  }
  const auto light = std::find_if(mass.begin(), mass.end(), [](double m) { return !(m > 0); });
  if (light != mass.end())
    refuse(fmt::format("node {} has no mass; join it with cloth, a line or tape, or fix it",
                       light - mass.begin()));
  return made;
}

double cloth_area(const Mesh& mesh) {
  double area = 0;
  for (const Patch& patch : mesh.patches)
    area += std::accumulate(patch.cell_area.begin(), patch.cell_area.end(), 0.0);
  return area;
}

}  // namespace ripstop::inline parachute

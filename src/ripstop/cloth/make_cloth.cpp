// Compiles a mesh for the kernels: see layout.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ripstop/cloth/contact.h"
#include "ripstop/cloth/layout.h"
#include "ripstop/core/error.h"

namespace ripstop::inline cloth {
namespace {

void refuse(const std::string& message) {
  throw Error(ExitCode::bad_data, "cloth mesh: " + message);
}

int index_of(const Patch& patch, int row, int column) {
  return row * patch.columns + column;
}

void check_nodes(const Mesh& mesh) {
  const int count = mesh.node_count();
  if (static_cast<int>(mesh.mass.size()) != count)
    refuse(fmt::format("{} masses for {} nodes", mesh.mass.size(), count));
  for (int node = 0; node < count; ++node) {
    if (!is_finite(mesh.start[node])) refuse(fmt::format("node {} has no finite position", node));
    if (!(mesh.mass[node] >= 0)) refuse(fmt::format("node {} has mass {} kg", node, mesh.mass[node]));
  }
}

void check_law(const SpringLaw& law, const std::string& place) {
  if (static_cast<int>(law.coefficients.size()) > max_degree)
    refuse(
        fmt::format("{}a spring law of degree {}, at most {}", place, law.coefficients.size(), max_degree));
  if (!(law.buckling_strain >= 0))
    refuse(fmt::format("{}a spring law with buckling strain {}", place, law.buckling_strain));
}

void check_springs_along(const Patch& patch, int direction) {
  const auto [dr, dc] = direction_offset[direction];
  for (int row = 0; row < patch.rows; ++row) {
    for (int column = 0; column < patch.columns; ++column) {
      const int i = index_of(patch, row, column);
      const double width = patch.width[direction][i], rest_length = patch.rest_length[direction][i];
      if (width == 0) continue;
      const bool outside =
          row + dr >= patch.rows || (!patch.periodic && (column + dc < 0 || column + dc >= patch.columns));
      if (!(width > 0) || !(rest_length > 0) || outside)
        refuse(fmt::format("patch {}, row {}, column {}: spring {} has width {} m, rest length {} m{}",
                           patch.name, row, column, direction, width, rest_length,
                           outside ? " and leaves the patch" : ""));
    }
  }
}

void check_patch(const Patch& patch, int node_count) {
  const auto cells = static_cast<std::size_t>(patch.rows) * patch.columns;
  if (patch.rows < 1 || patch.columns < (patch.periodic ? 3 : 1))
    refuse(fmt::format("patch {} has {} rows and {} columns", patch.name, patch.rows, patch.columns));
  if (patch.first_node < 0 || patch.first_node + static_cast<int>(cells) > node_count)
    refuse(fmt::format("patch {} extends beyond the last node", patch.name));
  if (patch.cell_area.size() < cells - patch.columns)
    refuse(fmt::format("patch {} has {} cell areas, needs {}", patch.name, patch.cell_area.size(),
                       cells - patch.columns));
  for (int d = 0; d < direction_count; ++d) {
    if (patch.width[d].size() != cells || patch.rest_length[d].size() != cells)
      refuse(fmt::format("patch {}: widths and rest lengths must be rows x columns", patch.name));
    check_law(patch.law[d], fmt::format("patch {}: ", patch.name));
    check_springs_along(patch, d);
  }
}

void check_ties(const Mesh& mesh) {
  const int count = mesh.node_count();
  const auto node_exists = [&](int node) { return node >= 0 && node < count; };
  std::vector<char> tied(count, 0);
  for (const Tie& tie : mesh.ties) {
    if (!node_exists(tie.node) || tied[tie.node]) refuse(fmt::format("node {} is tied twice", tie.node));
    tied[tie.node] = 1;
  }
  for (const Tie& tie : mesh.ties) {
    double sum = 0;
    for (const auto& master : tie.masters) {
      if (!node_exists(master.node) || tied[master.node])
        refuse(fmt::format("node {} is tied to node {}, which is itself tied", tie.node, master.node));
      if (!(master.weight >= 0))
        refuse(fmt::format("node {} is tied with the negative weight {}", tie.node, master.weight));
      sum += master.weight;
    }
    if (!(std::abs(sum - 1) < 1e-9))
      refuse(fmt::format("the weights of tied node {} add up to {}, not 1", tie.node, sum));
  }
  for (int node : mesh.fixed)
    if (!node_exists(node) || tied[node]) refuse(fmt::format("fixed node {} is tied or absent", node));
}

void check_drawstring(const Drawstring& string, int node_count) {
  check_law(string.law, "");
  if (string.rings.size() < 2 || !(string.rest_length > 0))
    refuse(
        fmt::format("a drawstring with {} rings, rest length {} m", string.rings.size(), string.rest_length));
  for (const int node : string.rings)
    if (node < 0 || node >= node_count) refuse(fmt::format("a drawstring runs through node {}", node));
}

void check(const Mesh& mesh) {
  check_nodes(mesh);
  const int count = mesh.node_count();
  for (const Patch& patch : mesh.patches) check_patch(patch, count);
  const auto node_exists = [&](int node) { return node >= 0 && node < count; };
  for (const Spring& s : mesh.springs) {
    if (!node_exists(s.a) || !node_exists(s.b) || s.a == s.b || !(s.rest_length > 0) || !(s.scale >= 0) ||
        s.law < 0 || s.law >= static_cast<int>(mesh.laws.size()))
      refuse(fmt::format("spring {} - {} has rest length {} m, scale {}, law {}", s.a, s.b, s.rest_length,
                         s.scale, s.law));
  }
  for (const SpringLaw& law : mesh.laws) check_law(law, "");
  check_ties(mesh);
  if (mesh.drawstring) check_drawstring(*mesh.drawstring, count);
}

FamilyLaw compile_law(const SpringLaw& law) {
  FamilyLaw compiled;
  if (law.coefficients.empty()) return compiled;
  compiled.both = law.compression * law.coefficients[0];
  compiled.buckled = -law.buckling_strain;
  std::copy(law.coefficients.begin(), law.coefficients.end(), compiled.positive_part.begin());
  compiled.positive_part[0] -= compiled.both;
  return compiled;
}

int degree_of(const SpringLaw& law) {
  return std::max<int>(1, static_cast<int>(law.coefficients.size()));
}

// Ghost vectors M, M + 1, lane l: column l M + m. Columns C and C + 1 of a periodic row are its first two;
// where C is no multiple of 8 they lie in the last strips' padding.
std::vector<PatchLayout::Copy> copies_of(const Patch& patch, int vectors) {
  std::vector<PatchLayout::Copy> copies;
  const auto slot = [&](int column) { return lanes * (column % vectors) + column / vectors; };
  const auto add = [&](int ghost, int column) {
    if (column >= patch.columns) {
      column -= patch.columns;
      if (!patch.periodic || column >= ghosts) return;
    }
    copies.push_back({ghost, slot(column)});
  };
  for (int m = vectors; m < vectors + ghosts; ++m)
    for (int lane = 0; lane < lanes; ++lane) add(lanes * m + lane, vectors * lane + m);
  for (int column = patch.columns; column < std::min(patch.columns + ghosts, lanes * vectors); ++column)
    add(slot(column), column);
  return copies;
}

void lay_out_patches(Cloth& cloth) {
  const Mesh& mesh = cloth.mesh;
  cloth.slot.assign(mesh.node_count(), -1);
  for (const Patch& patch : mesh.patches) {
    PatchLayout layout;
    layout.rows = patch.rows;
    layout.columns = patch.columns;
    layout.vectors = (patch.columns + lanes - 1) / lanes;
    layout.first = cloth.slots;
    layout.first_row = cloth.row_count;
    layout.copies = copies_of(patch, layout.vectors);
    for (int d = 0; d < direction_count; ++d) {
      layout.law[d] = compile_law(patch.law[d]);
      layout.damping[d] = patch.damping[d];
      layout.degree = std::max(layout.degree, degree_of(patch.law[d]));
      layout.viscosity[d] = patch.viscosity[d];
      layout.damped = layout.damped || patch.damping[d] != 0 || patch.viscosity[d] != 0;
    }
    for (int row = 0; row < patch.rows; ++row)
      for (int column = 0; column < patch.columns; ++column) {
        int& slot = cloth.slot[patch.node(row, column)];
        if (slot >= 0) refuse(fmt::format("node {} is in two patches", patch.node(row, column)));
        slot = layout.slot(row, column);
      }
    layout.first_spring = cloth.lattice.size();
    cloth.lattice.resize(cloth.lattice.size() + static_cast<std::size_t>(patch.rows) * layout.vectors *
                                                    PatchLayout::springs_per_vector);
    cloth.slots += layout.row_slots() * (patch.rows + ghosts);
    cloth.row_count += patch.rows;
    cloth.row_patch.insert(cloth.row_patch.end(), patch.rows, static_cast<int>(cloth.patches.size()));
    cloth.patches.push_back(std::move(layout));
  }
  for (int& slot : cloth.slot)
    if (slot < 0) slot = cloth.slots++;
  cloth.slots = (cloth.slots + lanes - 1) / lanes * lanes;
}

void fill_lattice(Cloth& cloth) {
  for (std::size_t p = 0; p < cloth.patches.size(); ++p) {
    const Patch& patch = cloth.mesh.patches[p];
    const PatchLayout& layout = cloth.patches[p];
    for (int d = 0; d < direction_count; ++d)
      for (int row = 0; row < patch.rows; ++row)
        for (int column = 0; column < patch.columns; ++column) {
          const int i = index_of(patch, row, column);
          if (patch.width[d][i] == 0) continue;
          int stored_at = column;
          if (d == shear_down) stored_at = column > 0 ? column - 1 : patch.columns - 1;
          double* springs = cloth.lattice.data() + layout.first_spring +
                            (static_cast<std::size_t>(row) * layout.vectors + stored_at % layout.vectors) *
                                PatchLayout::springs_per_vector +
                            2 * d * lanes + stored_at / layout.vectors;
          springs[0] = 1 / patch.rest_length[d][i];
          springs[lanes] = patch.width[d][i];
        }
  }
}

void fill_damper_shares(Cloth& cloth) {
  for (std::size_t p = 0; p < cloth.patches.size(); ++p) {
    PatchLayout& layout = cloth.patches[p];
    if (!layout.damped) continue;
    const std::vector<double>& share = cloth.mesh.patches[p].viscosity_share;
    layout.first_share = cloth.damper_shares.size();
    cloth.damper_shares.resize(
        layout.first_share + static_cast<std::size_t>(layout.rows) * layout.vectors * lanes, 1.0);
    if (share.empty()) continue;
    for (int row = 0; row < layout.rows; ++row)
      for (int column = 0; column < layout.columns; ++column)
        cloth.damper_shares[layout.first_share +
                            (static_cast<std::size_t>(row) * layout.vectors + column % layout.vectors) *
                                lanes +
                            column / layout.vectors] = share[row * layout.columns + column];
  }
}

void share_mass_and_area(Cloth& cloth) {
  const Mesh& mesh = cloth.mesh;
  cloth.total_mass = mesh.mass;
  cloth.area.assign(mesh.node_count(), 0.0);
  std::size_t cell = 0;
  cloth.cells = cells_of(mesh);
  for (const Patch& patch : mesh.patches)
    for (int i = 0; i < (patch.rows - 1) * patch.columns; ++i) {
      const Cell& c = cloth.cells[cell++];
      if (c.corner[0] < 0) continue;
      for (int corner : c.corner) cloth.area[corner] += 0.25 * patch.cell_area[i];
    }
  for (const Tie& tie : mesh.ties) {
    for (const auto& master : tie.masters)
      cloth.total_mass[master.node] += master.weight * mesh.mass[tie.node];
    cloth.total_mass[tie.node] = 0;
  }
  for (int node = 0; node < mesh.node_count(); ++node)
    if (!cloth.is_tied[node] && !cloth.is_fixed[node] && !(cloth.total_mass[node] > 0))
      refuse(fmt::format("node {} ({}) has no mass", node, place_of(mesh, node)));
}

void lay_out_springs(Cloth& cloth) {
  const Mesh& mesh = cloth.mesh;
  IrregularSprings& springs = cloth.springs;
  for (const Spring& spring : mesh.springs)
    springs.degree = std::max(springs.degree, degree_of(mesh.laws[spring.law]));
  springs.blocks = (static_cast<int>(mesh.springs.size()) + lanes - 1) / lanes;
  const std::size_t padded = static_cast<std::size_t>(springs.blocks) * lanes;
  springs.a.assign(padded, 0);
  springs.b.assign(padded, 0);
  for (AlignedDoubles* values : {&springs.inverse_rest, &springs.damping, &springs.both, &springs.buckled})
    values->assign(padded, 0.0);
  springs.positive_part.assign(padded * springs.degree, 0.0);
  for (std::size_t s = 0; s < mesh.springs.size(); ++s) {
    const Spring& spring = mesh.springs[s];
    const FamilyLaw law = compile_law(mesh.laws[spring.law]);
    springs.a[s] = at(cloth.slot[spring.a]);
    springs.b[s] = at(cloth.slot[spring.b]);
    springs.inverse_rest[s] = 1 / spring.rest_length;
    springs.damping[s] = spring.damping;
    springs.both[s] = spring.scale * law.both;
    springs.buckled[s] = law.buckled;
    for (int k = 0; k < springs.degree; ++k)
      springs.positive_part[(s / lanes * springs.degree + k) * lanes + s % lanes] =
          spring.scale * law.positive_part[k];
  }
}

/// Nodes with forces from outside the lattice; the index of each in the list, -1 for all others.
std::vector<int> keep_nodes(Cloth& cloth) {
  const Mesh& mesh = cloth.mesh;
  std::vector<char> special(mesh.node_count(), 1);
  for (const Patch& patch : mesh.patches)
    std::fill_n(special.begin() + patch.first_node, patch.rows * patch.columns, char{0});
  for (const Spring& s : mesh.springs) special[s.a] = special[s.b] = 1;
  if (mesh.drawstring)
    for (const int ring : mesh.drawstring->rings) special[ring] = 1;
  for (int node : mesh.fixed) special[node] = 1;  // whose force is recorded
  for (const Tie& tie : mesh.ties) {
    special[tie.node] = 1;
    for (const auto& master : tie.masters) special[master.node] = 1;
  }
  for (int node = 0; node < mesh.node_count(); ++node)
    if (special[node]) cloth.irregular.push_back({cloth.slot[node], node, 0, 0});
  std::sort(cloth.irregular.begin(), cloth.irregular.end(), [](auto& a, auto& b) { return a.slot < b.slot; });
  std::vector<int> irregular_index(mesh.node_count(), -1);
  for (std::size_t k = 0; k < cloth.irregular.size(); ++k)
    irregular_index[cloth.irregular[k].node] = static_cast<int>(k);
  return irregular_index;
}

// Forces added to those of the lattice on every irregular node: its springs, in the mesh's order, its parts of the
// drawstring, then its tied nodes with theirs.
void share_spring_forces(Cloth& cloth, const std::vector<int>& irregular_index) {
  const Mesh& mesh = cloth.mesh;
  const int irregular_count = static_cast<int>(cloth.irregular.size());
  cloth.first_spring_force = (irregular_count + lanes - 1) / lanes * lanes;
  std::vector<std::vector<Cloth::Share>> own(irregular_count);
  for (std::size_t s = 0; s < mesh.springs.size(); ++s) {
    const Spring& spring = mesh.springs[s];
    const int source = cloth.first_spring_force + static_cast<int>(s);
    own[irregular_index[spring.a]].push_back({source, 1});
    own[irregular_index[spring.b]].push_back({source, -1});
  }
  cloth.first_string_force = cloth.first_spring_force + cloth.springs.blocks * lanes;
  if (mesh.drawstring) {
    const std::vector<int>& rings = mesh.drawstring->rings;
    for (std::size_t i = 0; i < rings.size(); ++i) {
      const int source = cloth.first_string_force + static_cast<int>(i);
      own[irregular_index[rings[i]]].push_back({source, 1});
      own[irregular_index[rings[(i + 1) % rings.size()]]].push_back({source, -1});
      cloth.rings.push_back(cloth.slot[rings[i]]);
    }
    cloth.rings.push_back(cloth.rings.front());
  }
  std::vector<std::vector<Cloth::Share>> all = own;
  for (const Tie& tie : mesh.ties) {
    const int tied = irregular_index[tie.node];
    for (const auto& master : tie.masters) {
      auto& shares = all[irregular_index[master.node]];
      shares.push_back({tied, master.weight});
      for (const Cloth::Share& share : own[tied])
        shares.push_back({share.source, share.weight * master.weight});
    }
  }
  for (int k = 0; k < irregular_count; ++k) {
    cloth.irregular[k].first_share = static_cast<int>(cloth.shares.size());
    if (!cloth.is_tied[cloth.irregular[k].node])
      cloth.shares.insert(cloth.shares.end(), all[k].begin(), all[k].end());
    cloth.irregular[k].end_share = static_cast<int>(cloth.shares.size());
  }
}

void follow_masters(Cloth& cloth) {
  for (const Tie& tie : cloth.mesh.ties) {
    const int first = static_cast<int>(cloth.masters.size());
    for (const auto& master : tie.masters) cloth.masters.push_back({cloth.slot[master.node], master.weight});
    cloth.followers.push_back({cloth.slot[tie.node], first, static_cast<int>(cloth.masters.size())});
  }
  std::sort(cloth.followers.begin(), cloth.followers.end(), [](auto& a, auto& b) { return a.slot < b.slot; });
}

/// Where each row's part of a list in the order of slots begins.
template <class List>
std::vector<int> edges_of_rows(const Cloth& cloth, const List& list) {
  std::vector<int> edge(cloth.row_count + 1, 0);
  std::size_t i = 0;
  for (int row = 0; row < cloth.row_count; ++row) {
    edge[row] = static_cast<int>(i);
    const int end = cloth.row_slot(row) + cloth.patches[cloth.row_patch[row]].row_slots();
    while (i < list.size() && list[i].slot < end) ++i;
  }
  edge[cloth.row_count] = static_cast<int>(i);
  return edge;
}

}  // namespace

void ClothDeleter::operator()(Cloth* cloth) const {
  delete cloth;
}

ClothPtr make_cloth(const Mesh& mesh, const ClothOptions& options) {
  check(mesh);
  ClothPtr cloth(new Cloth);
  cloth->mesh = mesh;
  cloth->options = options;
  if (options.linear) {
    for (Patch& patch : cloth->mesh.patches)
      for (SpringLaw& law : patch.law) law = law.linearised();
    for (SpringLaw& law : cloth->mesh.laws) law = law.linearised();
    if (cloth->mesh.drawstring) cloth->mesh.drawstring->law = cloth->mesh.drawstring->law.linearised();
  }
  cloth->is_tied.assign(mesh.node_count(), 0);
  cloth->is_fixed.assign(mesh.node_count(), 0);
  for (const Tie& tie : mesh.ties) cloth->is_tied[tie.node] = 1;
  for (int node : mesh.fixed) cloth->is_fixed[node] = 1;
  share_mass_and_area(*cloth);
  lay_out_patches(*cloth);
  fill_lattice(*cloth);
  fill_damper_shares(*cloth);
  lay_out_springs(*cloth);
  share_spring_forces(*cloth, keep_nodes(*cloth));
  follow_masters(*cloth);
  cloth->irregular_of_row = edges_of_rows(*cloth, cloth->irregular);
  cloth->followers_of_row = edges_of_rows(*cloth, cloth->followers);
  if (options.contact) cloth->contact = std::make_shared<ContactLayout>(contact_layout(mesh, *cloth));
  return cloth;
}

std::string place_of(const Mesh& mesh, int node) {
  for (const Patch& patch : mesh.patches) {
    const int i = node - patch.first_node;
    if (i >= 0 && i < patch.rows * patch.columns)
      return fmt::format("{}, row {}, column {}", patch.name, i / patch.columns, i % patch.columns);
  }
  for (const Spring& s : mesh.springs)
    if ((s.a == node || s.b == node) && s.part >= 0 && s.part < static_cast<int>(mesh.parts.size()))
      return mesh.parts[s.part];
  return "outside all patches";
}

}  // namespace ripstop::inline cloth

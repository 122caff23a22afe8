// Every spring of a mesh, one after the other, in plain scalar code: for bounds, energies and stresses, which
// are looked at now and then.
#pragma once

#include "ripstop/mesh/mesh.h"

namespace ripstop::inline mesh {

struct SpringView {
  int a, b;  // nodes
  double rest_length;
  double scale;  // width [m], or 1 for a law in N
  const SpringLaw* law;
  double damping;
  int patch, row, column, direction;  // patch -1: irregular
  int index;                          // into Mesh::springs, -1: of the lattice
};

/// Those of a patch's lattice that begin in rows [begin, end).
template <class Visit>
void each_spring_of_rows(const Mesh& mesh, int p, int begin, int end, Visit&& visit) {
  const Patch& patch = mesh.patches[p];
  for (int row = begin; row < end; ++row)
    for (int column = 0; column < patch.columns; ++column)
      for (int d = 0; d < direction_count; ++d) {
        const std::size_t i = static_cast<std::size_t>(row) * patch.columns + column;
        if (patch.width[d][i] == 0) continue;
        int to = column + direction_offset[d].column;
        if (to < 0) to += patch.columns;
        if (to >= patch.columns) to -= patch.columns;
        visit(SpringView{patch.node(row, column), patch.node(row + direction_offset[d].row, to),
                         patch.rest_length[d][i], patch.width[d][i], &patch.law[d],
                         patch.damping_of(d, row, column), p, row, column, d, -1});
      }
}

template <class Visit>
void each_irregular_spring(const Mesh& mesh, Visit&& visit) {
  for (std::size_t s = 0; s < mesh.springs.size(); ++s) {
    const Spring& spring = mesh.springs[s];
    visit(SpringView{spring.a, spring.b, spring.rest_length, spring.scale, &mesh.laws[spring.law],
                     spring.damping, -1, 0, 0, 0, static_cast<int>(s)});
  }
}
template <class Visit>
void each_spring(const Mesh& mesh, Visit&& visit) {
  for (int p = 0; p < static_cast<int>(mesh.patches.size()); ++p)
    each_spring_of_rows(mesh, p, 0, mesh.patches[p].rows, visit);
  each_irregular_spring(mesh, visit);
}

}  // namespace ripstop::inline mesh

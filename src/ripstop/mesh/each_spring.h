// Every spring of a mesh, one after the other, in plain scalar code: for bounds, energies and stresses, which
// are looked at now and then.
#pragma once

#include "ripstop/core/thread_team.h"
#include "ripstop/mesh/mesh.h"

namespace ripstop {

struct SpringView {
  int a, b;  // nodes
  double rest_length;
  double scale;  // width [m], or 1 for a law in N
  const SpringLaw* law;
  double damping;
  int patch, row, column, direction;  // patch -1: irregular
  int index;                          // into Mesh::springs, -1: of the lattice
};

/// Part `part` of `parts`: some rows of every patch, some of the springs outside them.
template <class Visit>
void each_spring(const Mesh& mesh, int part, int parts, Visit&& visit) {
  for (std::size_t p = 0; p < mesh.patches.size(); ++p) {
    const Patch& patch = mesh.patches[p];
    const IndexRange rows = part_of(patch.rows, part, parts);
    for (int row = rows.begin; row < rows.end; ++row)
      for (int column = 0; column < patch.columns; ++column)
        for (int d = 0; d < direction_count; ++d) {
          const std::size_t i = static_cast<std::size_t>(row) * patch.columns + column;
          if (patch.width[d][i] == 0) continue;
          const int to = (column + direction_offset[d].column + patch.columns) % patch.columns;
          visit(SpringView{patch.node(row, column), patch.node(row + direction_offset[d].row, to),
                           patch.rest_length[d][i], patch.width[d][i], &patch.law[d],
                           patch.damping_of(d, row, column), static_cast<int>(p), row, column, d, -1});
        }
  }
  const IndexRange springs = part_of(static_cast<int>(mesh.springs.size()), part, parts);
  for (int s = springs.begin; s < springs.end; ++s) {
    const Spring& spring = mesh.springs[s];
    visit(SpringView{spring.a, spring.b, spring.rest_length, spring.scale, &mesh.laws[spring.law],
                     spring.damping, -1, 0, 0, 0, s});
  }
}

template <class Visit>
void each_spring(const Mesh& mesh, Visit&& visit) {
  each_spring(mesh, 0, 1, visit);
}

}  // namespace ripstop

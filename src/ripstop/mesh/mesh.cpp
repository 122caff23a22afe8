#include "ripstop/mesh/mesh.h"

namespace ripstop::inline mesh {

int Mesh::cell_count() const {
  int count = 0;
  for (const Patch& patch : patches) count += (patch.rows - 1) * patch.columns;
  return count;
}

std::vector<Cell> cells_of(const Mesh& mesh) {
  std::vector<Cell> cells;
  cells.reserve(mesh.cell_count());
  for (const Patch& patch : mesh.patches) {
    for (int row = 0; row + 1 < patch.rows; ++row) {
      for (int column = 0; column < patch.columns; ++column) {
        const bool last = column + 1 == patch.columns;
        if (patch.cell_area[row * patch.columns + column] <= 0 || (last && !patch.periodic)) {
          cells.push_back({{-1, -1, -1, -1}});
          continue;
        }
        const int next = last ? 0 : column + 1;
        cells.push_back({{patch.node(row, column), patch.node(row, next), patch.node(row + 1, next),
                          patch.node(row + 1, column)}});
      }
    }
  }
  return cells;
}

}  // namespace ripstop::inline mesh

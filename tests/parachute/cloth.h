// How much cloth a mesh has.
#pragma once

#include "ripstop/mesh/mesh.h"

namespace ripstop {

/// Nodes that lie on a patch.
inline int cloth_nodes(const Mesh& mesh) {
  int count = 0;
  for (const Patch& patch : mesh.patches) count += patch.rows * patch.columns;
  return count;
}

}  // namespace ripstop

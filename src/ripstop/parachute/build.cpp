#include "ripstop/parachute/build.h"

namespace ripstop {

CanopyMesh build_mesh(const Design& design, const PartMaterials& materials) {
  return design.canopy.family().build(design.canopy, design, materials);
}

}  // namespace ripstop

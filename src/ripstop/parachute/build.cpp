#include "ripstop/parachute/build.h"

namespace ripstop::inline parachute {

CanopyMesh build_mesh(const Design& design, const PartMaterials& materials) {
  return design.canopy.family().build(design.canopy, design, materials);
}

}  // namespace ripstop::inline parachute

#include "ripstop/parachute/build.h"

#include "ripstop/parachute/disk_gap_band.h"

namespace ripstop {

CanopyMesh build_mesh(const Design& design, const PartMaterials& materials) {
  return std::visit([&](const auto& canopy) { return build_canopy(canopy, design, materials); },
                    design.canopy);
}

}  // namespace ripstop

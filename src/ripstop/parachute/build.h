// From a design to the mesh of lumped masses: one line of dispatch for every canopy family.
#pragma once

#include <optional>

#include "ripstop/material/material.h"
#include "ripstop/parachute/canopy_mesh.h"
#include "ripstop/parachute/design.h"

namespace ripstop::inline parachute {

struct PartMaterials {
  Fabric canopy;
  Line line;
  Line riser;
  std::optional<Tape> tape;  // none: seams and hems of the cloth alone
};

/// The start shape has its skirt in the plane z = 0 and its mouth toward -z; see the family's own header.
/// Throws Error(usage) for a design that no lattice of the wanted size can represent.
CanopyMesh build_mesh(const Design& design, const PartMaterials& materials);

}  // namespace ripstop::inline parachute

// Stratos IV of [NFM] section 2 with the materials of its Table 3, for tests and benchmarks that build a mesh
// without case and material library.
#pragma once

#include "f111_curve.h"
#include "ripstop/parachute/build.h"
#include "ripstop/parachute/disk_gap_band.h"

namespace ripstop {

inline PartMaterials printed_materials() {
  PartMaterials m;
  m.canopy.name = "f-111";
  m.canopy.coefficients_n_m = f111_curve;
  m.canopy.tested_strain = 0.33;
  m.canopy.areal_density_kg_m2 = 0.0407;
  m.line.coefficients_n = {211895, 489633};
  m.line.linear_density_kg_m = 2e-3;
  m.riser = m.line;
  m.tape.emplace();
  m.tape->coefficients_n_m = {3064.2, 68823.4};
  m.tape->width_m = 0.02;
  m.tape->linear_density_kg_m = 6e-3;
  return m;
}

inline Design printed_stratos(int cloth_nodes) {
  Design design;
  design.canopy = DiskGapBand{1.0, 0.09, 0.07, 0.3};
  design.gores = 6;
  design.lines.count = 18;
  design.lines.length_m = 1.5;
  design.mesh.cloth_nodes = cloth_nodes;
  return design;
}

}  // namespace ripstop

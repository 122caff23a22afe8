// What the materials of a case have to say about a run.
#pragma once

#include "ripstop/case/case.h"

namespace ripstop {

/// Says on standard error when the mesh is too coarse for the size of the inflated canopy.
void print_mesh_warning(const Case& given);

/// Says on standard error when the flow's cells are too coarse for the load that the case asks for.
void print_grid_warning(const Case& given);

/// Says on standard error when the cloth's coefficients are for another porosity model than the case's.
void print_porosity_warning(const Case& given);

/// Repeats on standard error what the fits of the case's materials found doubtful, and says when the canopy's
/// cloth was strained beyond its tests.
void print_material_warnings(const Case& given, double largest_cloth_strain);

}  // namespace ripstop

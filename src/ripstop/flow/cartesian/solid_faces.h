// Solid bodies: closed, impermeable, at rest or in rigid motion.
//
// Air inside such a body would be a part of the flow that nothing but the smallest of leaks joins to the rest. The
// pressure equation would be nearly singular, and its iterations would not converge. All faces between the cells inside
// therefore have the drop of the surface: the pressure inside is a smooth continuation of that outside, no air passes,
// and the drops of a row of faces add up to the difference of pressure between the two sides of the body. In rigid
// motion each face has the velocity of the body at its centre. The fluxes into a cell inside then add up to zero, also
// where the body turns.
#pragma once

#include <vector>

#include "ripstop/flow/cartesian/sheet_faces.h"

namespace ripstop::inline flow::cartesian {

/// Whether a sheet is the surface of a solid body.
bool is_solid(const FlowBody& sheet);
/// The faces that a sheet parts and, if it is solid, those inside.
std::vector<SheetFace> faces_of(const Axis& x, const Axis& y, const Axis& z, const FlowBody& sheet,
                                ThreadTeam* team = nullptr);

}  // namespace ripstop::inline flow::cartesian

// A flow that is its own mirror image in the planes x = 0 and y = 0, in the quarter of its box with x > 0 and y > 0.
#pragma once

#include <array>
#include <vector>

#include "ripstop/flow/cartesian/grid.h"
#include "ripstop/flow/cartesian/sheet_faces.h"
#include "ripstop/flow/flow.h"

namespace ripstop::inline flow::cartesian {

/// Of a vector in the mirrors: bit 0 of `image` is that of x, bit 1 that of y.
inline constexpr int images = 4;  // of a point, itself included
Vec3 mirrored(Vec3 v, int image);

/// Cells and porous cells of the quarter. The surfaces remain whole: sheets are found on the cells of the whole box.
FlowGrid quarter_of(const FlowGrid& whole);
FlowProblem quarter_of(FlowProblem whole);

/// The axis of the whole box from that of the quarter.
Axis whole_of(const Axis& half);
/// Pressure and velocity of the whole box; all other members are those of the whole box already.
FlowField whole_of(FlowField quarter, const FlowGrid& whole);

/// Leaves the faces of the quarter, with its own cell numbers: `nx` and `ny` are its cells. Faces in the planes belong to
/// it. Returns the triangle of each image of every face that is left.
std::vector<std::array<int, images>> take_quarter(std::vector<SheetFace>& faces, int nx, int ny);

}  // namespace ripstop::inline flow::cartesian

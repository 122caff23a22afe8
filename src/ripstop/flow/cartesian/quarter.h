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

/// Sums over the quarter, as those over the whole box: components across the axis cancel.
Vec3 of_whole_box(Vec3 sum);
BodyLoad of_whole_box(const BodyLoad& load, Vec3 moment_about);

/// The axis of the whole box from that of the quarter.
Axis whole_of(const Axis& half);
/// Pressure and velocity of the whole box; all other members are those of the whole box already.
FlowField whole_of(FlowField quarter, const FlowGrid& whole);

/// Leaves the faces of the quarter, with its own cell numbers: `nx` and `ny` are its cells. Faces in the planes belong to
/// it. Returns the triangle of each image of every face that is left.
std::vector<std::array<int, images>> take_quarter(std::vector<SheetFace>& faces, int nx, int ny);

/// Appends the load of a face of the quarter and those of its mirror images on `triangle`. `in_plane`: bits of the
/// mirrors in whose plane the face lies, so that it is its own image.
void add_images(const SheetLoad& load, const std::array<int, images>& triangle, int in_plane,
                std::vector<SheetLoad>& loads);

}  // namespace ripstop::inline flow::cartesian

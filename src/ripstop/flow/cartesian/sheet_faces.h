// Where a thin sheet parts the cells of a rectilinear grid.
#pragma once

#include <vector>

#include "ripstop/core/thread_team.h"
#include "ripstop/flow/cartesian/grid.h"
#include "ripstop/flow/flow.h"

namespace ripstop::inline flow::cartesian {

/// A face whose two cell centres lie on either side of the sheet.
struct SheetFace {
  int axis = 0;             // 0, 1, 2: the face is normal to x, y, z
  int i = 0, j = 0, k = 0;  // the cell whose low face it is
  int triangle = 0;         // of the surface
  Vec3 point;               // where the line between the two centres meets the sheet [m]
  Vec3
      outward;  // mean normal of the sheet that it represents, unit, by the order of the corners of the triangles
  Vec3 normal;           // the same or its opposite: its component along the axis is not negative
  bool against = false;  // the sheet's outer side is the low one where the line between the centres meets it
  bool hem = false;      // within two cells of an edge of the sheet
  double area =
      0;        // of the sheet that the face represents [m2]; the sum over the faces is the area of the sheet
  Vec3 across;  // mean of the normals with all layers turned so that they look along the axis, unit
  double cover = 1;       // the part of the face that is not open; less than 1 only at a free edge
  bool solid = false;     // of a solid body (solid_faces.h)
  bool enclosed = false;  // between two cells inside it, where its surface is not
};

/// Every face between neighbouring cell centres with a triangle between them, in a fixed order. The faces of a closed
/// surface are watertight: a line through a shared edge or corner meets exactly one of the triangles. At a free edge
/// a face is included if the sheet covers any of 5 x 5 lines through the column of cells; the uncovered part is open
/// where the sheet has ended, but not where it has bent out of the column.
///
/// An element dA of the sheet with normal n is assigned to the faces across x, y and z in the shares n_x^2, n_y^2
/// and n_z^2, sampled on those lines: flow along the normal crosses the faces in these shares. `team` shares the work;
/// the faces do not depend on it.
std::vector<SheetFace> sheet_faces(const Axis& x, const Axis& y, const Axis& z,
                                   const std::vector<Triangle>& surface, ThreadTeam* team = nullptr);

}  // namespace ripstop::inline flow::cartesian

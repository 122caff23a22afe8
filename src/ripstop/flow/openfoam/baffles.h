// Sheets among the cells of a grid as OpenFOAM has them: faces with a patch on either side.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/flow/cartesian/sheet_faces.h"
#include "ripstop/flow/flow.h"

namespace ripstop::openfoam {

/// Of a sheet, what stands for it in one face of the grid.
struct Layer {
  cartesian::SheetFace face;
  int sheet = 0;
  double slant = 1;  // what passes through the face is the sheet's own velocity times this
};

/// A face of the grid that cloth parts: its low side is a face of cell `low`, its high side one of cell `high`.
struct Baffle {
  int axis = 0;
  int low = 0, high = 0;  // cells
  double area = 0;        // [m2]
  std::vector<Layer> layers;
};

/// Baffles with the same law, in two patches, NAME_low and NAME_high.
struct BafflePatch {
  std::string name;
  /// Loose cloth: the two patches are one another's other side, and the pressure jumps by linear v + quadratic v |v|
  /// with v through the face. Tight cloth: walls, with what passes through given on both.
  bool loose = false;
  double linear = 0, quadratic = 0;  // [Pa s/m], [Pa s2/m2]; of loose cloth
  std::vector<Baffle> baffles;       // in the order of the patches' faces
};

/// The faces whose larger part a sheet covers. Cloth is loose where the slope of the pressure over what passes is less
/// than half of rho U: OpenFOAM's jump follows the flow of the iteration before, and across denser cloth it does not come
/// to rest. There what passes follows the pressure. Across a sheet that shuts the whole box the flow is given, and all of
/// it is loose.
std::vector<BafflePatch> baffles_of(const FlowProblem& problem);

/// The part of the way that what passes a face may go at once towards what the pressure asks for: the pressure before
/// cloth falls by some 2 rho U for every m/s that passes.
double pace(const Baffle& baffle, const FlowProblem& problem);

/// Velocity through the face at which the pressure drops by `drop` along the axis [Pa], [m/s].
double passing(const Baffle& baffle, const std::vector<Sheet>& sheets, double drop);

/// constant/polyMesh of the grid, with the patches inlet, outlet, sides and those of the baffles. Throws Error(io).
void write_mesh(const std::filesystem::path& folder, const FlowGrid& grid,
                const std::vector<BafflePatch>& patches);

}  // namespace ripstop::openfoam

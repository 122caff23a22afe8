// Sheets among cells as OpenFOAM has them: faces with a patch on either side.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/flow/cartesian/quarter.h"
#include "ripstop/flow/flow.h"

namespace ripstop::inline flow::openfoam {

/// Representation of a sheet in one face of the mesh.
struct Layer {
  int body = 0, triangle = 0;  // of FlowProblem::bodies
  Vec3 point;                  // on the triangle [m]
  Vec3 outward;                // normal of the sheet there, unit
  bool against = false;        // the sheet's outer side is the low one
  double area = 0;             // of the sheet that the face represents, for its load [m2]
  double slant = 1;            // the flux through the face is the velocity of the sheet times this
  std::array<int, cartesian::images> mirrored{};  // triangle of each mirror image, in a quarter
};

/// A face of the mesh that cloth parts: its low side is a face of cell `low`, its high side one of cell `high`.
struct Baffle {
  int low = 0, high = 0;  // cells
  Vec3 area;              // times the normal from low to high [m2]
  std::vector<Layer> layers;
};

/// Baffles with the same law, in two patches, NAME_low and NAME_high.
struct BafflePatch {
  std::string name;
  /// Loose cloth: the two patches are one another's other side, and the pressure jumps by linear v + quadratic v |v|
  /// with v through the face. Tight cloth: walls, with a given velocity through them on both.
  bool loose = false;
  double linear = 0, quadratic = 0;  // [Pa s/m], [Pa s2/m2]; of loose cloth
  std::vector<Baffle> baffles;       // in the order of the patches' faces
};

/// The faces of the grid whose larger part a sheet covers. Cloth is loose where the slope of the pressure over the
/// velocity is less than half of rho U: OpenFOAM's jump follows the flow of the previous iteration and does not
/// converge across denser cloth. There the velocity follows the pressure. Across a sheet that closes the whole box
/// the flow is given, and all of it is loose. Faces in planes of symmetry have no drop, and are none of them.
std::vector<BafflePatch> baffles_of(const FlowProblem& problem);

/// Whether a law is that of loose cloth, in a box that the cloth does not shut.
bool is_loose(double linear, double quadratic, const Freestream& air);
/// `across`: the cloth's area across the stream [m2].
bool shuts(double across, const FlowGrid& grid);

/// Under-relaxation of the velocity through a face towards the value required by the pressure: the pressure
/// upstream of cloth decreases by some 2 rho U for every m/s through it.
double pace(const Baffle& baffle, const FlowProblem& problem);

/// Velocity from low to high at which the pressure drops by `drop` that way [Pa], [m/s].
double passing(const Baffle& baffle, const std::vector<FlowBody>& bodies, double drop);

/// constant/polyMesh of the problem's grid, with the patches inlet, outlet, sides, in a quarter the planes of symmetry,
/// and those of the baffles. Throws Error(io).
void write_mesh(const std::filesystem::path& folder, const FlowProblem& problem,
                const std::vector<BafflePatch>& patches);

}  // namespace ripstop::inline flow::openfoam

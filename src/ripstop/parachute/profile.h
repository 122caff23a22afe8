// Any canopy of revolution, given by the points of its meridian and cut into flat gores.
#pragma once

#include <vector>

#include "ripstop/parachute/family.h"
#include "ripstop/parachute/gore.h"

namespace ripstop::inline parachute {

/// [[parachute.pieces]]: one piece of every gore, from the skirt up. Points run toward the vent.
struct ProfilePiece {
  std::vector<double> radius_m;  // N gores are together as wide as a circle of this radius is long
  std::vector<double> height_m;  // toward the vent's side; only differences count
  double leading_fullness = 0;   // of the lower edge
  double trailing_fullness = 0;  // of the upper edge
  bool sewn = false;             // to the piece before, along the whole edge; else at the radials only
};

/// [parachute] with type = "profile"
struct ProfileCanopy {
  static const CanopyFamily family;

  std::vector<ProfilePiece> pieces;
  bool vent_lines = true;
};

void describe(Fields& fields, ProfilePiece& piece);
void describe(Fields& fields, ProfileCanopy& canopy);
void check_shape(const ProfileCanopy& canopy, const Design& design, Findings& findings);
Experience experience(const ProfileCanopy& canopy);
/// A gore is 2 pi r / N wide where the meridian's radius is r, and as long as the meridian of the polygon's
/// flat sides: r cos(pi/N) (pi/N) / sin(pi/N) from the axis. S0 is the cloth without its fullness, with gaps
/// and the vent as a flat polygon.
GorePattern gore_pattern(const ProfileCanopy& canopy, int gores);
/// See gored.h. A piece that is widest between its edges is meshed as two, sewn together there.
CanopyMesh build_canopy(const ProfileCanopy& canopy, const Design& design, const PartMaterials& materials);

}  // namespace ripstop::inline parachute

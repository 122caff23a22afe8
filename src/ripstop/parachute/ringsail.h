// The ringsail canopy: rows of sails, fuller at their lower edges, on a quarter sphere.
#pragma once

#include "ripstop/parachute/family.h"
#include "ripstop/parachute/gore.h"

namespace ripstop::inline parachute {

/// [[parachute.rows]]: one row of sails, from the skirt up.
struct SailRow {
  double height = 1;             // share of the gore without slots and vent
  double slot_deg = 0;           // open arc above the row
  double leading_fullness = 0;   // of the lower edge
  double trailing_fullness = 0;  // of the upper edge
};

/// [parachute] with type = "ringsail"
struct Ringsail {
  static const CanopyFamily family;

  double nominal_diameter_m = 0;
  double vent_diameter_m = 0;
  double half_angle_deg = 60;  // of the cap: 60 a quarter of the sphere
  int sails = 9;               // a gore; the classic layout is used when there is no table of rows
  std::vector<SailRow> rows;
  bool vent_lines = true;
};

/// The rows as given, else the classic layout (K1, Ewing; as a table in degrees): 3-degree slots below the
/// two top rows, the top one half as high; leading-edge fullness 0 at the skirt, then from 11 % in equal
/// steps to 5 %, and 0 for the two top rows.
std::vector<SailRow> sail_rows(const Ringsail& canopy);

void describe(Fields& fields, Ringsail& canopy);
void check_shape(const Ringsail& canopy, const Design& design, Findings& findings);
Experience experience(const Ringsail& canopy);
/// S0 = pi/4 nominal_diameter^2, the area of the cap with slots and vent and without fullness.
GorePattern gore_pattern(const Ringsail& canopy, int gores);

}  // namespace ripstop::inline parachute

// Data of a canopy that a case needs before it is meshed.
#pragma once

namespace ripstop::inline parachute {

struct CanopyFacts {
  double cloth_area = 0;    // as cut, without vent, gaps and slots [m2]
  double nominal_area = 0;  // S0 by the definition of the type [m2]
  double vent_area = 0;     // flat [m2]
  double slot_area = 0;     // of slots and gaps as constructed, between the radials [m2]
  int vertical_tapes = 0;   // in every gore between its seams, across the slots
  double covered_area = 0;  // the cloth without its fullness [m2]
  double line_run =
      0;  // largest length of the lines on the canopy, from the place that the family defines [m]
  double skirt_radius = 0;    // of the points where the lines leave the canopy, start shape [m]
  double start_diameter = 0;  // largest, of the start shape [m]
  double start_depth = 0;     // of the start shape, from the skirt downstream [m]
  double circumference = 0;   // largest, as cut: the mesh's columns lie round it [m]

  /// Open share of the surface as constructed: vent, slots and gaps over these and the
  /// cloth without fullness.
  double geometric_porosity() const {
    const double open = vent_area + slot_area;
    return open / (open + covered_area);
  }
};

}  // namespace ripstop::inline parachute

// How the keys that a case leaves out follow from the others: from the parachute, its cloth and the values of other
// keys, never from which keys were given, so that to write a value that follows changes nothing.
#pragma once

#include "ripstop/case/settings.h"

namespace ripstop::inline cases {

/// Defaults that follow from the porosity model alone; docs/guide/case-file.md, Air through the cloth.
struct ModelDefaults {
  std::array<int, 3> cells;
  double growth;
  Convection convection;
  Sides sides;
  Outlet outlet;
  double residual;
  int max_iterations, average_over;
  CanopyLoad load;
  double drag_tolerance;
};
/// As [NFM] has it.
inline constexpr ModelDefaults paper_defaults{.cells = {100, 100, 150},
                                              .growth = 1.1,
                                              .convection = Convection::upwind,
                                              .sides = Sides::zero_gradient,
                                              .outlet = Outlet::fixed_pressure,
                                              .residual = 1e-5,
                                              .max_iterations = 1000,
                                              .average_over = 0,
                                              .load = CanopyLoad::uniform,
                                              .drag_tolerance = 1e-3};
/// Fine about the canopy, in a wide box; such a flow settles to 3e-4 only, or keeps shedding.
inline constexpr ModelDefaults sheet_defaults{.cells = {80, 80, 98},
                                              .growth = 1.125,
                                              .convection = Convection::second_order,
                                              .sides = Sides::entraining,
                                              .outlet = Outlet::still_air,
                                              .residual = 3e-4,
                                              .max_iterations = 300,
                                              .average_over = 60,
                                              .load = CanopyLoad::of_flow,
                                              .drag_tolerance = 5e-3};

/// The paper model's box [m], [NFM] section 5.
inline constexpr Vec3 paper_box{2, 2, 4};
/// The sheet's box and core and the skirt's distance from the inlet, in inflated diameters;
/// docs/theory/flow-cartesian.md, Sides of the box, and docs/validation.md give their errors.
inline constexpr Vec3 sheet_box{6, 6, 9}, sheet_core{1.8, 1.8, 2.2};
inline constexpr double sheet_skirt = 4;
/// A core that fills more of the box than half of it gains little.
inline constexpr double least_box_over_core = 2;
/// CoreSettings::off_axis in time: no two of a canopy's four sides then lie alike on the cells.
inline constexpr double in_time_off_axis = 0.25;

/// Domain of a jet in nozzle widths: width, and smallest length downstream of the skirt; cells of the sheet model in
/// so wide a domain. docs/guide/tunnel.md gives their errors.
inline constexpr double jet_box_across = 2.8, jet_box_behind = 2, narrowest_jet_box = 1.5;
inline constexpr std::array<int, 3> jet_cells{88, 88, 98};
inline constexpr double jet_outside_speed = 0.02, jet_shear_layer = 0.1;  // the latter in nozzle widths

/// resolve() without the materials of lines and riser, for the checks of a case that may lack them.
SettingsValues settings_values(const Case& given);

}  // namespace ripstop::inline cases

// From what a case gives to what the solvers take. Every key that is absent follows from the parachute,
// its cloth and the values of other keys, never from which keys were given: to write a value that
// follows changes nothing.
#pragma once

#include <string>
#include <vector>

#include "ripstop/case/case.h"

namespace ripstop {

/// What follows from the porosity model alone; docs/guide/case-file.md, Air through the cloth.
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
/// docs/theory/flow-cartesian.md, Sides of the box, and docs/validation.md say what they are worth.
inline constexpr Vec3 sheet_box{6, 6, 9}, sheet_core{1.8, 1.8, 2.2};
inline constexpr double sheet_skirt = 4;
/// CoreSettings::off_axis in time: no two of a canopy's four sides then lie alike on the cells.
inline constexpr double in_time_off_axis = 0.25;

/// A jet's box in nozzle widths: across the flow, and at least so long behind the skirt; what the sheet's cells
/// become in so wide a box. docs/guide/tunnel.md says what they are worth.
inline constexpr double jet_box_across = 2.8, jet_box_behind = 2, narrowest_jet_box = 1.5;
inline constexpr std::array<int, 3> jet_cells{88, 88, 98};
inline constexpr double jet_outside_speed = 0.02, jet_shear_layer = 0.1;  // the latter in nozzle widths

/// What the sheet's box is measured in [m].
double inflated_diameter(const Design& parachute);

struct CoreSettings {
  Vec3 size_m;         // 0: the cells are uniform along that axis
  double start_m = 0;  // from the inlet
  double growth = 0;
  double off_axis = 0;  // of its middle from the canopy's axis along x, half as much along y, in cells
};

struct TunnelSettings {
  TunnelKind kind = TunnelKind::free_air;
  Nozzle nozzle;  // or closed test section
  double nozzle_distance_m = 0;
  double outside_speed = 0;
  double shear_layer_m = 0;
  double displacement_thickness_m = 0;
};
/// Nothing where there is no nozzle.
std::optional<Jet> jet_of(const TunnelSettings& tunnel);

/// FlowKeys with every value.
struct FlowSettings : FlowOptions {
  double speed_m_s = 0;  // as given, before speed_basis; with a payload, where the search begins
  double viscosity_pa_s = 0;
  double temperature_k = 0;
  double density_kg_m3 = 0;
  PorosityModel porosity_model = PorosityModel::sheet;
  Vec3 box_m;
  std::array<int, 3> cells{};
  TunnelSettings tunnel;
  CoreSettings core;
  double canopy_position_m = 0;
  Convection convection = Convection::upwind;
  Sides sides = Sides::zero_gradient;
  Outlet outlet = Outlet::fixed_pressure;
  double residual = 0;
  int max_iterations = 0;
  int average_over = 0;
};

/// One key whose value follows from others where it is not given.
struct Source {
  std::string key;
  bool given = false;
  std::string from;  // "the sheet's default", "given in case.toml, line 12"
};

struct Resolved {
  FlowSettings flow;
  CouplingSettings coupling;
  Case written;  // the case with all of these values given
  std::vector<Source> sources;
};

/// Pure. Throws Error(usage) for a case without air or without its cloth: one that checked() would refuse.
Resolved resolve(const Case& given);

/// z of the skirt of the undeformed start shape, from the inlet [m].
double canopy_position(const Case& given);
/// Cells of the flow. Throws Error(usage) for a core that does not fit, or that the cells do not suffice for.
FlowGrid flow_grid(const FlowSettings& flow);
FlowGrid flow_grid(const Case& given);

}  // namespace ripstop

// Air through cloth: the pressure-drop law dp = a v + b v |v| ([NFM] Eq. 15) and its measurement.
#pragma once

#include <vector>

#include "ripstop/core/pressure_drop.h"

namespace ripstop::inline material {

/// One reading of a permeability tester.
struct FlowPoint {
  double pressure = 0;  // [Pa]
  double velocity = 0;  // flow per area [m/s]
};

struct PermeabilityFit {
  PressureDrop law;
  double r2 = 1;           // of the pressures
  bool one_point = false;  // b = 0 is then a choice, not a result
  bool on_bound = false;   // a or b would have been negative and was held at 0
};

/// Least squares on relative errors of the pressure, a and b not negative. Throws Error(bad_data) without
/// points, for values <= 0, or for velocities outside 1e-5 to 50 m/s (CFM per square foot typed as m/s).
PermeabilityFit fit_permeability(const std::vector<FlowPoint>& points);

/// Pressure drop at a normal velocity of either sign [Pa].
double pressure_drop(const PressureDrop& law, double velocity);
/// Normal velocity that a pressure drop >= 0 drives [m/s].
double velocity_at(const PressureDrop& law, double pressure);
/// Flow in cubic feet a minute through a square foot at half an inch of water (124.5 Pa), ASTM D737's unit.
double cfm(const PressureDrop& law);
/// The law of creeping flow, b = 0, of a cloth with so many CFM/ft2. Throws Error(bad_data) unless it is
/// above 0 and below 10,000.
PressureDrop law_of_cfm(double flow);

struct ErgunAir {
  double density = 1.225;      // [kg/m3]
  double viscosity = 1.81e-5;  // [Pa s]
};

/// Porosity and thickness that represent a law in Ergun's equation, [NFM] Eq. 16 with V/S = t.
struct ErgunCloth {
  double porosity = 0;   // gamma, 0 < gamma < 1
  double thickness = 0;  // [m]
};
/// a = 150 mu / (36 t gamma^3), b = 1.75 rho / (6 gamma^3). Throws Error(bad_data) outside the ranges.
PressureDrop ergun(const ErgunCloth& cloth, const ErgunAir& air = {});
/// The other way: both follow from a and b. Throws Error(bad_data) when a or b is not above 0 or gamma would
/// be 1 or more.
ErgunCloth ergun_cloth(const PressureDrop& law, const ErgunAir& air = {});

}  // namespace ripstop::inline material

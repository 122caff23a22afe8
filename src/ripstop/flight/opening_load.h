// Estimates of the opening load by handbook methods, from a few coefficients. Sources, equations and ranges
// of validity: docs/theory/opening-load.md.
#pragma once

namespace ripstop::inline flight {

/// Input of all methods.
struct OpeningConditions {
  double mass = 0;                 // of all that is decelerated [kg]
  double speed = 0;                // through the air when the lines are stretched [m/s]
  double density = 0;              // [kg/m3]
  double drag_area = 0;            // (C_D S)_0 of the open canopy [m2]
  double filling_time = 0;         // t_f, from line stretch to the first full drag area [s]
  double exponent = 2;             // j of the growth (t / t_f)^j of the drag area
  double opening_coefficient = 1;  // C_x: peak over steady drag at infinite mass
  double path_angle = 90;          // of the flight path, below the horizon [deg]
};

double steady_force(const OpeningConditions& c);  // (C_D S)_0 q at line stretch [N]

/// Ballistic parameter of Pflanz, A = 2 W / ((C_D S) rho g v t_f); Ludtke's mass ratio M is the same number.
double ballistic_parameter(const OpeningConditions& c);
/// Mass ratio R_m = rho (C_D S)^(3/2) / m: above about 0.1 the speed falls while the canopy fills.
double mass_ratio(const OpeningConditions& c);

/// The share that is left of a load at infinite mass, where it is highest and when.
struct ForceFactor {
  double factor = 0;  // largest of (t/t_f)^j (v/v_s)^2
  double time = 0;    // of it, over t_f
};

/// Of a drag area that grows as (t / t_f)^j up to `largest` times the open one, on a way without gravity:
/// v / v_s = 1 / (1 + tau^(j+1) / ((j+1) A)).
ForceFactor force_factor(double ballistic_parameter, double exponent, double largest = 1);

struct OpeningLoad {
  double load = 0;  // [N]
  double time = 0;  // of the peak after line stretch [s]; 0: not given by the method
};

/// F = (C_D S) q C_x: the speed does not fall while the canopy opens.
OpeningLoad infinite_mass_load(const OpeningConditions& c);
/// F = (C_D S) q C_x X_1(A, j), X_1 the factor of a drag area that ends with the open one.
OpeningLoad pflanz_load(const OpeningConditions& c);
/// F = (C_D S) q x, where the drag area continues to grow beyond the open one until it is C_x times that.
OpeningLoad ludtke_load(const OpeningConditions& c);

struct MomentumImpulse {
  OpeningLoad load;
  double speed_ratio = 0;  // at the end of filling over that at line stretch
};
/// From the momentum that is lost until t_f: F I_F t_f = m v (1 - Gamma) + W t_f sin(angle), with `integral` I_F
/// the mean over the peak of the force. Gamma closes it: at t_f the drag of the open canopy is 1 / C_x of the peak.
MomentumImpulse momentum_impulse_load(const OpeningConditions& c, double integral = 0.5);

/// Throws Error(usage) that names the quantity that is not above 0.
void check_conditions(const OpeningConditions& c);

}  // namespace ripstop::inline flight

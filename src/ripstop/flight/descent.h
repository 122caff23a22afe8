// Steady descent: drag is weight, at every height with the density that is there.
#pragma once

namespace ripstop::inline flight {

/// Speed at which the drag `drag_area` rho v^2 / 2 is the weight [m/s]. Arguments: [kg], [m2], [kg/m3].
double terminal_speed(double mass, double drag_area, double density);
/// The drag area that `mass` needs for a descent at `speed` [m2].
double drag_area_for(double mass, double speed, double density);

/// Time from one height down to another in the standard atmosphere [s], at the terminal speed of every height: the
/// integral of dh / v(h). Throws Error(usage) unless from > to and standard_air() takes both.
double descent_time(double mass, double drag_area, double from, double to);

}  // namespace ripstop::inline flight

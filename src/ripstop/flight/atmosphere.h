// The U.S. Standard Atmosphere, 1976, up to 80 km.
#pragma once

#include "ripstop/core/units.h"

namespace ripstop::inline flight {

/// Heights that standard_air() takes [m].
inline constexpr double lowest_height = -2000, highest_height = 80000;

struct StandardAir {
  double temperature = 0;  // [K]
  double pressure = 0;     // [Pa]
  double density = 0;      // [kg/m3]
  double viscosity = 0;    // dynamic [Pa s]
  double sound_speed = 0;  // [m/s]
};

/// Geometric height above mean sea level to the height that the layers are given in [m].
double geopotential_height(double height);

/// Of the day that the standard describes; `height` is geometric, above mean sea level [m]. Throws
/// Error(usage) outside [lowest_height, highest_height].
StandardAir standard_air(double height);

/// The height at which the standard atmosphere has `density` [kg/m3] -> [m]. Throws Error(usage) for a density that it
/// has nowhere between lowest_height and highest_height.
double standard_height(double density);

/// The same, at a density outside of those the nearer limit.
double nearest_standard_height(double density);

/// Density `fallen` metres below `height` over that at `height` [m]; below lowest_height that of lowest_height.
double density_ratio(double height, double fallen);

}  // namespace ripstop::inline flight

// The pressure on both sides of the cloth from vent to skirt, mean over the gores.
#pragma once

#include <vector>

#include "ripstop/fsi/transfer.h"

namespace ripstop::inline fsi {

/// Cloth at one place along the gores, means by area over all of them.
struct PressureRing {
  double arc = 0;                  // along the meridian from the ring next to the vent [m]
  double radius = 0, z = 0;        // [m]
  double inside = 0, outside = 0;  // over the outlet's pressure [Pa]
  double load = 0;                 // difference that the cloth was given [Pa]
};

/// From the vent to the skirt in `rings` steps of equal length, those without cloth left out. The meridian is
/// followed by radius less height, which grows all along a canopy whose vent and skirt are both drawn in.
std::vector<PressureRing> pressure_profile(const std::vector<Cell>& cells, const std::vector<Vec3>& positions,
                                           const SidePressures& sides, const std::vector<double>& load,
                                           int rings = 40);

}  // namespace ripstop::inline fsi

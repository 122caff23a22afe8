// The classic estimate of the opening load, to hold a computed peak against.
#pragma once

#include <string>

#include "ripstop/parachute/design.h"

namespace ripstop {

struct OpeningEstimate {
  double coefficient = 0;  // C_x: peak over steady drag at infinite mass
  double load = 0;         // C_x C_D S q [N]
  std::string source;
};

/// F_x = (C_D S) q C_x X_1 with X_1 = 1, infinite mass: the speed does not fall while the canopy opens, as in
/// a wind tunnel. `steady_drag` = (C_D S) q [N]. C_x is that of the canopy's family.
OpeningEstimate opening_estimate(const Design& design, double steady_drag);

}  // namespace ripstop

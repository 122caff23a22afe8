// The classic estimate of the opening load, to hold a computed peak against.
#pragma once

#include <optional>
#include <string>

#include "ripstop/parachute/design.h"

namespace ripstop::inline fsi {

struct OpeningEstimate {
  double coefficient = 0;      // C_x: peak over steady drag at infinite mass
  std::optional<double> drag;  // C_D S q of the open canopy at the speed of deployment [N]; absent: not known
  std::string drag_from;
  std::optional<double> load;  // C_x C_D S q [N]; absent where C_x or the drag is not known
  std::string source;          // of C_x
};

/// F_x = (C_D S) q C_x X_1 with X_1 = 1, infinite mass: the speed does not fall while the canopy opens, as in
/// a wind tunnel. `drag` = (C_D S) q [N] at the speed of deployment; of a payload that slows down, neither the last
/// load nor any other of the run. C_x is that of the canopy's family.
OpeningEstimate opening_estimate(const Design& design, std::optional<double> drag,
                                 std::string drag_from = {});

}  // namespace ripstop::inline fsi

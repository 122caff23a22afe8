// The handbook's infinite-mass load: the design load, and an estimate to compare a computed peak with.
#pragma once

#include <optional>
#include <string>

#include "ripstop/parachute/design.h"

namespace ripstop::inline fsi {

/// C_D of the infinite-mass load C_x C_D S0 q. The C_x of the handbook is the peak over the drag that its C_D in descent
/// gives. With a smaller coefficient, such as that of a canopy on the axis of the stream, the load would be too low. So
/// at least the largest C_D of the handbook is used.
double design_drag_coefficient(const Design& design, double drag_coefficient);

struct OpeningEstimate {
  double coefficient = 0;      // C_x: peak over steady drag at infinite mass
  std::optional<double> drag;  // design C_D S0 q at the speed of the opening [N]; absent: not known
  std::string drag_from;
  std::optional<double> load;  // C_x C_D S q [N]; absent where C_x or the drag is not known
  std::string source;          // of C_x
};

/// F_x = (C_D S) q C_x X_1 with X_1 = 1, infinite mass: the speed does not fall while the canopy opens, as in
/// a wind tunnel. `drag` = (C_D S) q [N] at the speed of the opening, whose dynamic pressure q is [Pa]; of a payload that
/// slows down, neither the last load nor any other of the run. C_D is at least design_drag_coefficient(), C_x is that of
/// the canopy's family.
OpeningEstimate opening_estimate(const Design& design, std::optional<double> drag, double dynamic_pressure,
                                 std::string drag_from = {});

}  // namespace ripstop::inline fsi

// The tape of a parachute without a given one: the lightest reinforcement that carries the load of one line
// at the opening.
#pragma once

#include <string>

#include "ripstop/case/case.h"

namespace ripstop::inline cases {

struct TapeMaterial {
  std::string name;  // of given.materials, or no_tape
  std::string from;  // why
  double used = 0;   // of the strength of tape or hem by a line's load; 0: given, not computed
};

/// Infinite-mass load of the opening, C_x C_D S0 q with the C_x and C_D of the family.
struct UsualOpening {
  double speed = 0, load = 0;  // [m/s], [N]
  std::string from;            // source of the speed
};
/// At payload.deployment_speed_m_s, else at the case's speed. Without the former a payload that descends at the speed of
/// the case opens its parachute at usual_deployment_speed(), unless the case is that of an opening with its payload.
/// Throws Error(usage) for a case without air.
UsualOpening usual_opening(const Case& given);

/// As the case gives it, else as tape_for() has it at the load of usual_opening(). Throws Error(usage) as that one, and
/// for a case without its materials.
TapeMaterial tape_material(const Case& given);
/// Writes `tape` into the case, and removes the library's other tapes, which were there to choose from.
void take_tape(const TapeMaterial& tape, Case& given);

/// Skirt, vent and seams are reinforced for the load of one line, with the [margins] of the case: none if a hem of the
/// cloth carries `line_load` [N] (and no slot needs tape across it), else the lightest tape of given.materials that
/// does, else the strongest.
TapeMaterial tape_for(const Case& given, double line_load);

}  // namespace ripstop::inline cases

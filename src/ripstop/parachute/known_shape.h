// What is known of the inflated size and the drag of each canopy type, to hold computed ones against.
#pragma once

#include "ripstop/parachute/design.h"

namespace ripstop {

struct KnownRange {
  double low = 0, high = 0;  // 0: not known
};

/// T. W. Knacke, Parachute Recovery Systems Design Manual, NWC TP 6575 (1991), Tables 5-1 and 5-2; not
/// checked against the print. Caps of a sphere between a hemisphere and a flat canopy, and profiles, have no
/// entry.
KnownRange known_projected_ratio(const Design& design);  // projected over nominal diameter in steady flight
/// On the nominal area, in descent: what swings and glides is in it.
KnownRange known_drag_coefficient(const Design& design);

}  // namespace ripstop

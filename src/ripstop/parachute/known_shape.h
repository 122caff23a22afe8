// What is known of the inflated size of each canopy type, to hold a computed one against.
#pragma once

#include "ripstop/parachute/design.h"

namespace ripstop {

struct KnownRatio {
  double low = 0, high = 0;  // projected over nominal diameter in steady flight; 0: not known
};

/// T. W. Knacke, Parachute Recovery Systems Design Manual, NWC TP 6575 (1991), Tables 5-1 and 5-2; not
/// checked against the print. Caps of a sphere between a hemisphere and a flat canopy, and profiles, have no
/// entry.
KnownRatio known_projected_ratio(const Design& design);

}  // namespace ripstop

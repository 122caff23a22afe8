// The list of canopy families, in the order of the reference.
#include "ripstop/parachute/annular.h"
#include "ripstop/parachute/conical.h"
#include "ripstop/parachute/cross.h"
#include "ripstop/parachute/disk_gap_band.h"
#include "ripstop/parachute/extended_skirt.h"
#include "ripstop/parachute/family.h"
#include "ripstop/parachute/flat_circular.h"
#include "ripstop/parachute/polygon.h"
#include "ripstop/parachute/profile.h"
#include "ripstop/parachute/ringsail.h"
#include "ripstop/parachute/ringslot.h"
#include "ripstop/parachute/spherical.h"

namespace ripstop::inline parachute {

const Families& families() {
  static const Families list = {
      &DiskGapBand::family,   &FlatCircular::family, &Conical::family,       &Spherical::family,
      &ExtendedSkirt::family, &Ringslot::family,     &Ringsail::family,      &Annular::family,
      &Cross::family,         &Polygon::family,      &ProfileCanopy::family,
  };
  return list;
}

Canopy::Canopy() : Canopy(families().front()->make()) {}

}  // namespace ripstop::inline parachute

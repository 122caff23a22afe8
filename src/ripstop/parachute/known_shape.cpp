#include "ripstop/parachute/known_shape.h"

namespace ripstop {
namespace {

KnownRatio ratio_of(const DiskGapBand&) {
  return {0.65, 0.65};
}
KnownRatio ratio_of(const FlatCircular&) {
  return {0.67, 0.70};
}
KnownRatio ratio_of(const Conical&) {
  return {0.70, 0.70};
}
KnownRatio ratio_of(const Spherical& canopy) {
  return canopy.half_angle_deg == 90 ? KnownRatio{0.66, 0.66} : KnownRatio{};
}
KnownRatio ratio_of(const ExtendedSkirt&) {
  return {0.66, 0.70};
}
KnownRatio ratio_of(const Ringslot&) {
  return {0.67, 0.70};
}
KnownRatio ratio_of(const Ringsail&) {
  return {0.69, 0.69};
}
KnownRatio ratio_of(const Cross&) {
  return {0.66, 0.72};
}
KnownRatio ratio_of(const ProfileCanopy&) {
  return {};
}

}  // namespace

KnownRatio known_projected_ratio(const Design& design) {
  return std::visit([](const auto& canopy) { return ratio_of(canopy); }, design.canopy);
}

}  // namespace ripstop

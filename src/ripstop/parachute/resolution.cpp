#include "ripstop/parachute/resolution.h"

namespace ripstop {
namespace {

// Of a band and of sails, which the lines keep taut, few nodes make the shape; cloth that falls into folds or
// pleats between the lines is too stiff while its wrinkles are narrower than a cell.
int nodes_of(const DiskGapBand&) {
  return 1500;
}
int nodes_of(const Ringsail&) {
  return 3000;
}
int nodes_of(const Ringslot&) {
  return 6000;
}
int nodes_of(const Spherical& canopy) {
  return canopy.half_angle_deg > 75 ? 6000 : 12000;
}
int nodes_of(const FlatCircular&) {
  return 12000;
}
int nodes_of(const Conical&) {
  return 12000;
}
int nodes_of(const ProfileCanopy&) {
  return 11000;  // half an ellipsoid; flatter ones need more
}
int nodes_of(const ExtendedSkirt&) {
  return 25000;
}
int nodes_of(const Cross&) {
  return 25000;
}

}  // namespace

int resolved_cloth_nodes(const Design& design) {
  return std::visit([](const auto& canopy) { return nodes_of(canopy); }, design.canopy);
}

}  // namespace ripstop

#include "ripstop/parachute/known_shape.h"

namespace ripstop {
namespace {

struct Known {
  KnownRange projected_ratio, drag_coefficient;
};

Known known(const DiskGapBand&) {
  return {{0.65, 0.65}, {0.52, 0.58}};
}
Known known(const FlatCircular&) {
  return {{0.67, 0.70}, {0.75, 0.80}};
}
Known known(const Conical&) {
  return {{0.70, 0.70}, {0.75, 0.90}};
}
Known known(const Spherical& canopy) {
  return canopy.half_angle_deg == 90 ? Known{{0.66, 0.66}, {0.62, 0.77}} : Known{};
}
Known known(const ExtendedSkirt&) {
  return {{0.66, 0.70}, {0.78, 0.87}};
}
Known known(const Ringslot&) {
  return {{0.67, 0.70}, {0.56, 0.65}};
}
Known known(const Ringsail&) {
  return {{0.69, 0.69}, {0.75, 0.90}};
}
Known known(const Cross&) {
  return {{0.66, 0.72}, {0.60, 0.85}};
}
Known known(const ProfileCanopy&) {
  return {};
}

Known known(const Design& design) {
  return std::visit([](const auto& canopy) { return known(canopy); }, design.canopy);
}

}  // namespace

KnownRange known_projected_ratio(const Design& design) {
  return known(design).projected_ratio;
}

KnownRange known_drag_coefficient(const Design& design) {
  return known(design).drag_coefficient;
}

}  // namespace ripstop

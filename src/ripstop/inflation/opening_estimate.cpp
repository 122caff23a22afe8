#include "ripstop/inflation/opening_estimate.h"

namespace ripstop {
namespace {

// Knacke, NWC TP 6575, Tables 5-1 (solid textile) and 5-2 (slotted canopies), column "opening force
// coefficient C_x (inf. mass)". Flat circular, conical, hemispherical, extended skirt and cross agree with a
// public transcription of the tables (parachute_design.m of the Stanford Student Space Initiative, which
// cites Knacke, 1992); flat circular and cross with a second one besides. Disk-gap-band, ringslot and
// ringsail are written down from memory: no public text with them was found, the tables are public as
// pictures only.
double coefficient_of(const DiskGapBand&) {
  return 1.3;
}
double coefficient_of(const FlatCircular&) {
  return 1.7;
}
double coefficient_of(const Conical&) {
  return 1.8;
}
double coefficient_of(const Spherical&) {
  return 1.6;
}
double coefficient_of(const ExtendedSkirt&) {
  return 1.4;
}
double coefficient_of(const Ringslot&) {
  return 1.05;
}
// 1.1 to 1.2.
double coefficient_of(const Cross&) {
  return 1.15;
}
double coefficient_of(const Ringsail&) {
  return 1.1;
}
// Not in the tables: the largest of the solid canopies, on the safe side.
double coefficient_of(const ProfileCanopy&) {
  return 1.8;
}

}  // namespace

OpeningEstimate opening_estimate(const Design& design, double steady_drag) {
  const double c = std::visit([](const auto& canopy) { return coefficient_of(canopy); }, design.canopy);
  const bool unchecked = std::holds_alternative<DiskGapBand>(design.canopy) ||
                         std::holds_alternative<Ringslot>(design.canopy) ||
                         std::holds_alternative<Ringsail>(design.canopy);
  return {c, c * steady_drag,
          std::string("Knacke, NWC TP 6575, Tables 5-1 and 5-2, infinite mass; ") +
              (unchecked ? "value not checked against the print"
                         : "value agrees with a public transcription, not checked against the print")};
}

}  // namespace ripstop

#include "ripstop/inflation/opening_estimate.h"

namespace ripstop {
namespace {

// Knacke, NWC TP 6575, Tables 5-1 (solid textile) and 5-2 (slotted canopies), column "opening force
// coefficient C_x (inf. mass)". Written down from memory and not yet checked against the print.
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

}  // namespace

OpeningEstimate opening_estimate(const Design& design, double steady_drag) {
  const double c = std::visit([](const auto& canopy) { return coefficient_of(canopy); }, design.canopy);
  return {c, c * steady_drag,
          "Knacke, NWC TP 6575, Tables 5-1 and 5-2, infinite mass; values not checked against the print"};
}

}  // namespace ripstop

// The snatch load: the payload, ahead, catches the packed canopy up through lines and riser.
#pragma once

#include <string>
#include <vector>

namespace ripstop::inline flight {

/// One of the parts that pull in a row: equal strands side by side with T(e) = sum K_k e^k each.
struct SnatchPart {
  std::string name;
  std::vector<double> coefficients;  // K_1..K_n [N]
  int strands = 1;
  double length = 0;  // unstretched [m]
};

struct SnatchLoad {
  double load = 0;                  // the largest [N]
  double time = 0;                  // from the first tension to it [s]
  double stretch = 0;               // of all parts then [m]
  std::vector<double> strain;       // of each part then
  std::vector<double> strand_load;  // of one strand of each part then [N]
};

/// Two masses that move apart at `speed_difference` when the parts come taut, without drag while they stretch:
/// the energy m_p m_c / (m_p + m_c) dv^2 / 2 is in the parts when their tension is largest. [kg], [m/s]. Throws
/// Error(usage) for values that are not above 0, and where a part's curve turns
/// over before it has taken that energy.
SnatchLoad snatch_load(double payload_mass, double canopy_mass, double speed_difference,
                       const std::vector<SnatchPart>& parts);

/// Tension of parts in a row over their stretch: rising rows from (0, 0) to where the weakest part would break.
struct TensionCurve {
  std::vector<double> stretch, tension;  // [m], [N]
  /// Between the rows in proportion; 0 for slack parts. Throws Error(usage) beyond the last row.
  double at(double stretch_m) const;
  double steepest() const;  // stiffness [N/m]
};
TensionCurve tension_curve(const std::vector<SnatchPart>& parts);

/// Difference of the speeds when payload and packed canopy, let go at `speed`, have come apart by `length`, either
/// slowed by its own drag area on a way without gravity [m/s].
struct Coasting {
  double mass = 0;       // [kg]
  double drag_area = 0;  // [m2]
};
/// Throws Error(usage) where they do not come apart: the canopy has to be slowed more than the payload.
double speed_difference_at_stretch(const Coasting& payload, const Coasting& canopy, double speed,
                                   double density, double length);

}  // namespace ripstop::inline flight

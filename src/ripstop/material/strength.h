// Strength of a material, and the bound that its mass sets.
#pragma once

#include <optional>
#include <string>

#include "ripstop/material/library.h"

namespace ripstop::inline material {

/// Strength as sold. A breaking load, where one is given, is the strength, whatever the tested strain is: the tests of
/// a curve may end below the failure. Without one it is the load at the tested strain.
struct Strength {
  std::optional<double> value;  // [N/m] of cloth, else [N]; absent: not known
  std::string from;
};
Strength strength_of(const Fabric& cloth);
Strength strength_of(const Line& line);
Strength strength_of(const Tape& tape);

/// Specific strength of the strongest fibre [N m/kg], 4.0 N/tex: Dyneema SK78 has 3.4 to 4.0 N/tex (DSM, fact sheet
/// UHMWPE fiber, CIS YA100, 2010).
inline constexpr double strongest_fibre = 4.0e6;

/// Strength over the mass that carries it [N m/kg]: of a line or tape its linear density, of a cloth half of its areal
/// density, as the other half lies across. 1e6 is 1 N/tex. Absent: the strength is not known.
std::optional<double> specific_strength(const Material& material);

}  // namespace ripstop::inline material

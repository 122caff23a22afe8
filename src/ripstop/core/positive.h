// Checks of numbers that come from no case file.
#pragma once

#include <string>

namespace ripstop {

/// Throws Error(usage), "a `name` of ...: must be above 0", for a value that is not above 0 or not finite. The
/// argument contains the unit if there is one: "payload mass (kg)".
void require_positive(const std::string& what, double value);
/// The same for a value outside [low, high], or not finite.
void require_within(const std::string& what, double value, double low, double high);

}  // namespace ripstop

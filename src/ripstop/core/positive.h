// What has to be above 0 where no case file says so.
#pragma once

#include <string>

namespace ripstop {

/// Throws Error(usage), "a `what` of ...: must be above 0", for a value that is not above 0 or not finite. `what`
/// has the unit where there is one: "payload mass (kg)".
void require_positive(const std::string& what, double value);

}  // namespace ripstop

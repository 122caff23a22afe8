// A design in another size, and the case file of a sized parachute.
#pragma once

#include <string>

#include "ripstop/run/sizing/size.h"

namespace ripstop {

/// Every length of the parachute times `factor`, to a tenth of a millimetre; the mesh's own lengths stay.
void scale_lengths(Design& design, double factor);

/// A case file with comments that reads back to `result.given`.
std::string size_case_text(const SizeRequest& request, const SizeResult& result);

}  // namespace ripstop

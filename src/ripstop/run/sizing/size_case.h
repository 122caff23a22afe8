// The case file of a sized parachute.
#pragma once

#include <string>

#include "ripstop/run/sizing/size.h"

namespace ripstop::inline run {

/// A case file with comments that reads back to `result.given`.
std::string size_case_text(const SizeRequest& request, const SizeResult& result);

}  // namespace ripstop::inline run

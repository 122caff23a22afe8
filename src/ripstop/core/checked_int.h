// From a computed number to a count, an index or a size. A cast of a value that is not finite, or that an int cannot
// represent, is undefined; a computation that has diverged makes such values.
#pragma once

#include <algorithm>
#include <limits>

#include "ripstop/core/error.h"

namespace ripstop {

/// `value`, rounded towards zero. Throws Error(code) with the text of message() unless least <= value <= most.
template <class Message>
int checked_int(double value, double least, double most, const Message& message,
                ExitCode code = ExitCode::diverged) {
  constexpr double smallest = std::numeric_limits<int>::min(), largest = std::numeric_limits<int>::max();
  if (!(value >= std::max(least, smallest) && value <= std::min(most, largest))) throw Error(code, message());
  return static_cast<int>(value);
}

}  // namespace ripstop

#include "ripstop/core/positive.h"

#include <fmt/format.h>

#include <cmath>

#include "ripstop/core/error.h"

namespace ripstop {

void require_positive(const std::string& what, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw Error(ExitCode::usage, fmt::format("a {} of {:g}: must be above 0", what, value));
}

}  // namespace ripstop

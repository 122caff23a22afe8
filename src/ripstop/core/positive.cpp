#include "ripstop/core/positive.h"

#include <fmt/format.h>

#include <cmath>

#include "ripstop/core/error.h"

namespace ripstop {

void require_positive(const std::string& what, double value) {
  if (value > 0 && std::isfinite(value)) return;
  const bool vowel = std::string("aeio").find(what.front()) != std::string::npos;
  throw Error(ExitCode::usage,
              fmt::format("{} {} of {:g}: must be above 0", vowel ? "an" : "a", what, value));
}

void require_within(const std::string& what, double value, double low, double high) {
  if (value >= low && value <= high) return;
  const bool vowel = std::string("aeio").find(what.front()) != std::string::npos;
  throw Error(ExitCode::usage, fmt::format("{} {} of {:g}: must be at least {:g} and at most {:g}",
                                           vowel ? "an" : "a", what, value, low, high));
}

}  // namespace ripstop

// Openings of inflate() and calibrate_damping().
#pragma once

#include <optional>

#include "ripstop/case/opening.h"
#include "runs.h"

namespace ripstop::python {

using OptionalSource = std::optional<SteadySource>;

struct Opening {
  Settings resolved;
  LoadSource source;
  int threads = 0;
};
/// The opening of a case under the drag of a steady run, or a pressure [Pa], or the values of the case.
/// Throws as load_source() and drag_for_opening().
Opening opening_of(const Case& given, const OptionalSource& steady, std::optional<double> pressure,
                   int threads);

}  // namespace ripstop::python

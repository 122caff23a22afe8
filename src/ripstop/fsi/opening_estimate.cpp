#include "ripstop/fsi/opening_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ripstop::inline fsi {

double design_drag_coefficient(const Design& design, double drag_coefficient) {
  return std::max(drag_coefficient, experience(design).drag_coefficient.high);
}

OpeningEstimate opening_estimate(const Design& design, std::optional<double> drag, double dynamic_pressure,
                                 std::string drag_from) {
  const Experience known = experience(design);
  OpeningEstimate estimate{known.opening_coefficient, drag, std::move(drag_from), {}, known.opening_source};
  if (!drag) return estimate;
  const double full = nominal_area(design) * dynamic_pressure, least = design_drag_coefficient(design, 0);
  if (*drag < least * full) {
    estimate.drag = least * full;
    estimate.drag_from =
        fmt::format("C_D {:.2f} (handbook, in descent); {}: {:.1f} N", least, estimate.drag_from, *drag);
  }
  if (known.opening_coefficient > 0) estimate.load = known.opening_coefficient * *estimate.drag;
  return estimate;
}

}  // namespace ripstop::inline fsi

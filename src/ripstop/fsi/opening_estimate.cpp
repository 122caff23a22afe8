#include "ripstop/fsi/opening_estimate.h"

#include <utility>

namespace ripstop::inline fsi {

OpeningEstimate opening_estimate(const Design& design, std::optional<double> drag, std::string drag_from) {
  const Experience known = experience(design);
  OpeningEstimate estimate{known.opening_coefficient, drag, std::move(drag_from), {}, known.opening_source};
  if (drag && known.opening_coefficient > 0) estimate.load = known.opening_coefficient * *drag;
  return estimate;
}

}  // namespace ripstop::inline fsi

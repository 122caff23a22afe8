#include "ripstop/fsi/opening_estimate.h"

namespace ripstop {

OpeningEstimate opening_estimate(const Design& design, double steady_drag) {
  const Experience known = experience(design);
  return {known.opening_coefficient, known.opening_coefficient * steady_drag, known.opening_source};
}

}  // namespace ripstop

// The opening under a uniform pressure difference and absolute damping, [NFM] section on inflation as corrected in
// docs/theory/inflation.md.
#pragma once

#include <vector>

#include "ripstop/fsi/opening.h"

namespace ripstop::inline fsi {

class UniformPressureOpening : public Opening {
 public:
  explicit UniformPressureOpening(InflationProblem problem);

  std::vector<HistoryRow> advance(InflationState& state, std::vector<AirRow>* air_rows = nullptr) override;

 private:
  /// In proportion to time until the end of the ramp; in its mean over one row [Pa].
  double pressure_in(long long row) const;
};

}  // namespace ripstop::inline fsi

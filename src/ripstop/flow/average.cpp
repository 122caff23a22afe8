#include "ripstop/flow/average.h"

#include <algorithm>
#include <cmath>

namespace ripstop {

// Mean and squares by Welford's updates, m += (x - m) / n, which lose nothing to the size of the mean.
void FieldMean::add(const FlowField& field) {
  const double drag = field.porous_force.z;
  if (count() == 0) {
    mean_ = field;
    mean_.average = {1, drag, 0, drag, drag};
    return;
  }
  FlowAverage& average = mean_.average;
  const double share = 1.0 / ++average.iterations;
  const auto pull = [share](auto& mean, const auto& value) { mean += share * (value - mean); };
  for (std::size_t cell = 0; cell < field.pressure.size(); ++cell) {
    pull(mean_.pressure[cell], field.pressure[cell]);
    pull(mean_.velocity[cell], field.velocity[cell]);
  }
  pull(mean_.porous_force, field.porous_force);
  pull(mean_.momentum_deficit, field.momentum_deficit);
  for (std::size_t face = 0; face < field.sheet_loads.size(); ++face) {
    pull(mean_.sheet_loads[face].drop, field.sheet_loads[face].drop);
    pull(mean_.sheet_loads[face].force, field.sheet_loads[face].force);
  }
  mean_.last = field.last;
  mean_.converged = field.converged;
  const double before = drag - average.drag;
  pull(average.drag, drag);
  squares_ += before * (drag - average.drag);
  average.drag_low = std::min(average.drag_low, drag);
  average.drag_high = std::max(average.drag_high, drag);
}

FlowField FieldMean::mean() const {
  FlowField field = mean_;
  if (count() > 1) field.average.drag_deviation = std::sqrt(squares_ / (count() - 1));
  return field;
}

}  // namespace ripstop

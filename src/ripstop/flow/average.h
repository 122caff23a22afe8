// Mean of the iterates of a flow that does not settle.
#pragma once

#include <functional>

#include "ripstop/flow/flow.h"

namespace ripstop::inline flow {

/// Running mean of fields on one grid, each weighing the same.
class FieldMean {
 public:
  /// Draws the pressures and velocities of the mean towards those of a field: m += share (x - m).
  using Cells = std::function<void(FlowField& mean, double share)>;

  void add(const FlowField& field);
  /// A field without its cells, which `cells` has: no copy of them is made.
  void add(const FlowField& field, const Cells& cells);
  /// All other data of a mean, of fields on the same grid around the same cloth.
  void add(const FieldMean& other);
  int count() const { return mean_.average.iterations; }
  /// The mean so far, with the number of fields in FlowField::average; `last` and `converged` are those of the newest
  /// field.
  const FlowField& mean() const { return mean_; }

 private:
  /// `field` is the mean of `count` fields.
  void take(const FlowField& field, const Cells& cells, int count);

  FlowField mean_;
};

}  // namespace ripstop::inline flow

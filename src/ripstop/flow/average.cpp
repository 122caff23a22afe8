#include "ripstop/flow/average.h"

namespace ripstop::inline flow {
namespace {

// m += share (x - m) for all that a field has means of; loses nothing to the size of the mean.
FieldMean::Cells cells_of(const FlowField& field) {
  return [&field](FlowField& mean, double share) {
    for (std::size_t cell = 0; cell < field.pressure.size(); ++cell) {
      mean.pressure[cell] += share * (field.pressure[cell] - mean.pressure[cell]);
      mean.velocity[cell] += share * (field.velocity[cell] - mean.velocity[cell]);
    }
  };
}

void pull(FlowField& mean, const FlowField& field, double share) {
  const auto towards = [share](auto& to, const auto& value) { to += share * (value - to); };
  towards(mean.porous_force, field.porous_force);
  towards(mean.momentum_deficit, field.momentum_deficit);
  for (std::size_t body = 0; body < field.bodies.size(); ++body) {
    towards(mean.bodies[body].force, field.bodies[body].force);
    towards(mean.bodies[body].moment, field.bodies[body].moment);
  }
  for (std::size_t face = 0; face < field.sheet_loads.size(); ++face) {
    towards(mean.sheet_loads[face].drop, field.sheet_loads[face].drop);
    towards(mean.sheet_loads[face].force, field.sheet_loads[face].force);
    if (field.sheet_loads[face].inside)
      towards(*mean.sheet_loads[face].inside, *field.sheet_loads[face].inside);
    if (field.sheet_loads[face].outside)
      towards(*mean.sheet_loads[face].outside, *field.sheet_loads[face].outside);
  }
  mean.last = field.last;
  mean.converged = field.converged;
}

}  // namespace

void FieldMean::add(const FlowField& field) {
  add(field, cells_of(field));
}

void FieldMean::add(const FlowField& field, const Cells& cells) {
  take(field, cells, 1);
}

void FieldMean::add(const FieldMean& other) {
  if (other.count() > 0) take(other.mean_, cells_of(other.mean_), other.count());
}

void FieldMean::take(const FlowField& field, const Cells& cells, int count) {
  const int before = mean_.average.iterations;
  if (before == 0) {
    mean_ = field;
    if (mean_.pressure.empty()) {
      mean_.pressure.resize(mean_.grid.cells());
      mean_.velocity.resize(mean_.grid.cells());
      cells(mean_, 1);
    }
  } else {
    const double share = double(count) / (before + count);
    pull(mean_, field, share);
    cells(mean_, share);
  }
  mean_.average = {before + count, 0};
}

}  // namespace ripstop::inline flow

// One step in time of cloth and flow together: of an opening, or of a parachute in flight.
#pragma once

#include <vector>

#include "ripstop/fsi/adaptive_stepper.h"
#include "ripstop/fsi/coupled_flow.h"

namespace ripstop::inline fsi {

struct CoupledStep {
  FlowStep flow;
  double residual_traction = 0;     // residual_traction_share() of the load
  std::vector<HistoryRow> history;  // rows of the cloth
};

/// Of a step of `length` [s] in the frame of a payload, which moves along z.
Surroundings in_flight(const PayloadMotion& flight, const Payload& payload, double length);

/// Predicts the motion of the cloth under the last load, steps the flow, transfers its load, and corrects the motion.
/// `span` has its rows under one load. The cloth has its steps from the stepper. Divergence is reported with the time.
CoupledStep take_coupled_step(CoupledFlow& air, const AdaptiveStepper& stepper, const Cloth& cloth,
                              const RowSpan& span, const Surroundings& surroundings, ThreadTeam& team,
                              InflationState& state);

/// Smallest required duration of a row of the history for any flow of this problem, inverse [1/s].
double least_rows_in(const FlowProblem& flow);

/// Longest step of the flow [s]. Throws Error(diverged) where it is a small share of `row` [s], which only a diverged
/// flow requires.
double sound_step(CoupledFlow& air, double row, double time);

}  // namespace ripstop::inline fsi

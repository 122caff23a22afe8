#include "ripstop/fsi/opening_end.h"

#include <cmath>
#include <numbers>

#include "ripstop/core/error.h"

namespace ripstop::inline fsi {

std::vector<double> distances_over_ground(const std::vector<AirRow>& air) {
  std::vector<double> distances;
  double distance = 0, path = 0;
  for (const AirRow& row : air) {
    distance += (row.path - path) * std::cos(row.angle * std::numbers::pi / 180), path = row.path;
    distances.push_back(distance);
  }
  return distances;
}

OpeningEnd end_of_opening(const Opening& opening, const InflationState& state, double load,
                          const std::vector<AirRow>& air) {
  if (!opening.air() || !opening.problem().air->payload)
    throw Error(ExitCode::usage,
                "a flight continues from a coupled inflation with a payload; this one has a fixed end");
  if (state.cuts.size() < opening.problem().reefing.size())
    throw Error(ExitCode::usage,
                "a flight continues from an open canopy; at the end of this inflation a reefing line "
                "is not yet cut");
  const Cloth& cloth = opening.cloth();
  const PayloadMotion& flight = state.air.flight;
  OpeningEnd end;
  end.time = state.cloth.time;
  end.air_speed = opening.problem().air->flow.air.velocity.z;
  end.speed = flight.speed, end.angle = flight.angle, end.fallen = flight.fallen;
  if (!air.empty()) end.distance = distances_over_ground(air).back();
  end.shape = positions(state.cloth, cloth), end.velocity = velocities(state.cloth, cloth);
  end.pressure = state.air.pressure, end.force = state.air.force;
  end.peak_tension = state.record.peak_tension;
  end.folded = opening.folded().positions, end.folds = opening.folded().folds;
  end.peak_load = state.peak_load, end.load = load, end.drag = air.empty() ? 0 : air.back().drag;
  end.highest_stress = state.highest_stress;
  end.elastic = elastic_energy(cloth, state.cloth), end.kinetic = kinetic_energy(cloth, state.cloth);
  return end;
}

}  // namespace ripstop::inline fsi

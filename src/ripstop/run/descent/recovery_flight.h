// The flight of a recovery from apogee to the ground, and the load of each of its openings.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/flight/trajectory.h"
#include "ripstop/flight/wind.h"
#include "ripstop/run/descent/flown.h"
#include "ripstop/run/descent/recovery.h"
#include "ripstop/run/opening/filling.h"
#include "ripstop/run/opening/load.h"

namespace ripstop::inline run {

// A descent is steady within 5 % of the terminal speed of the open canopy, and not before three filling times. Until
// then the drag area exceeds that of the open canopy. The filling time is the longest within two standard deviations.
inline constexpr double steady_share = 0.05, steady_fillings = 3 * (1 + 2 * filling_time_scatter);

struct RecoveryCanopy {
  std::string name;
  const Settings& resolved;
  DragCoefficient drag;
  DescentDrag range;
  double area = 0, mass = 0;  // S0 [m2], [kg]
  std::filesystem::path opening;
  std::optional<double> measured_load;  // [N]
  LoadInputs inputs;
};

/// Which coefficient of each parachute a flight has.
enum class DragEnd { nominal, low, high };

/// One stage of one flight.
struct FlownStage {
  FlightState opening;
  LoadResult load;                                              // of run_load() there
  double others = 0, end_height = 0;                            // drag area of body and drogue [m2], [m]
  bool filled = true;                                           // before the next opening or the ground
  bool steady = true;                                           // at its end
  double peak_force = 0;                                        // on its canopy along the trajectory [N]
  double end_speed = 0, terminal = 0, duration = 0, drift = 0;  // terminal: of the open canopy at the end
};
struct Flown {
  std::vector<FlownStage> stages;
  std::vector<RecoveryRow> rows;
};

double drag_at(DragEnd end, const RecoveryCanopy& canopy);

/// Opening of a canopy at a state of the flight, of the whole mass [kg].
LoadRequest opening_of(const RecoveryCanopy& canopy, double drag_coefficient, const FlightState& state,
                       double mass, const RecoveryRequest& request);
LoadResult load_of(const RecoveryCanopy& canopy, const LoadRequest& asked);

/// Largest force on the canopy if the stage begins at `speed` [m/s], else as in its flight [N].
double peak_force_at(double speed, const RecoveryCanopy& canopy, const FlownStage& stage,
                     const RecoveryRequest& request);

/// From apogee to the ground. Throws Error(usage) if the rocket lands before a parachute opens.
Flown fly_down(const std::vector<RecoveryCanopy>& canopies, const RecoveryRequest& request, const Wind& wind,
               double body_area, DragEnd end);

}  // namespace ripstop::inline run

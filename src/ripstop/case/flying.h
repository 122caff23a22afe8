// The free flight of a case: the cells of its flow, and the problem that the solver takes.
#pragma once

#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/fsi/free_flight.h"

namespace ripstop::inline cases {

/// The case on the mesh of an opening, without a given speed, in a far field and on cells as coarse as [flight] has
/// them where the case gives none. Throws Error(usage) without payload.mass_kg and for cases that cannot fly.
Case flight_case(const Case& given);

/// Of a flight that continues from the end of an inflation with the settings `opening`: everything but [flight] is that
/// of the inflation; the cells too, unless the case gives flight.cells_across. Throws Error(usage) for another payload.
Case continued_case(const Case& given, const Settings& opening);

/// Throws Error(usage) for a payload that is so light compared with its parachute that its lines are not taut.
void require_payload(const Settings& flight);

/// Of the settings of flight_case(), at the rate of descent of `shape` under `pressure` [Pa], which is flow.speed_m_s.
FlightProblem flight_problem(const Settings& flight, std::vector<Vec3> shape, std::vector<double> pressure,
                             int threads);
/// From the end of an opening.
FlightProblem flight_problem(const Settings& flight, const OpeningEnd& end, int threads);

}  // namespace ripstop::inline cases

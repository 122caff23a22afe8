// The flow domain and cells of a free flight.
#pragma once

#include "ripstop/case/case.h"

namespace ripstop::inline cases {

/// Cells across the nominal diameter with which the folded canopy is as wide as an opening requires.
double cells_for_folds(const Case& flight);

/// Gives the case `across` cells over the nominal diameter, where it has neither cells nor box nor core. A cluster also
/// gets a box and a core, which contains its canopies up to widest_in_flight() in any direction.
void take_flight_cells(Case& flight, double across);

/// Largest spread angle in flight for which the domain is made [deg].
double widest_in_flight(const ClusterKeys& keys);

}  // namespace ripstop::inline cases

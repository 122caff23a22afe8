// Rigid bodies of a flight: their mean loads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/core/members.h"
#include "ripstop/fsi/carried_bodies.h"

namespace ripstop::inline run {

/// Of one body over the time after the start-up, in result.json.
struct FlightBody {
  std::string name;
  double drag = 0;                                  // along the air relative to the payload, mean [N]
  double drag_area = 0;                             // mean [m2]
  std::optional<double> drag_area_error;            // its standard error, if the flight is long enough [m2]
  double reference_area = 0, drag_coefficient = 0;  // [m2]; mean drag area over it
  double mean_incidence = 0;                        // between the axis of the body and that air [deg]
  double resolved = 0;                              // share of the time with the whole body in the fine cells
};
template <Of<FlightBody> T, class Visit>
void each_member(T& b, Visit&& visit) {
  visit("name", b.name);
  visit("drag_n", b.drag);
  visit("drag_area_m2", b.drag_area);
  visit("drag_area_standard_error_m2", b.drag_area_error);
  visit("reference_area_m2", b.reference_area);
  visit("drag_coefficient", b.drag_coefficient);
  visit("mean_incidence_deg", b.mean_incidence);
  visit("in_fine_cells", b.resolved);
}

/// `rigid` are the bodies of the flow without the canopy, `rows` theirs, one after another in each step. `began` is the
/// start of the flight and `from` the end of its start-up [s].
std::vector<FlightBody> flight_bodies(const Settings& resolved, const std::vector<FlowBody>& rigid,
                                      const std::vector<FlightBodyRow>& rows, double began, double from);

/// Of a payload without a drag area, and of bodies that leave the fine cells.
std::vector<std::string> flight_body_warnings(const Settings& resolved,
                                              const std::vector<FlightBody>& bodies);

}  // namespace ripstop::inline run

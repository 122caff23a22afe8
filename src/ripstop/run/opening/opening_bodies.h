// Loads on the rigid bodies of a coupled inflation, which are at rest with the payload.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/core/members.h"
#include "ripstop/flow/flow.h"
#include "ripstop/fsi/coupled_flow.h"

namespace ripstop::inline run {

/// One body in one step of the flow: bodies.csv, where the bodies of a step follow each other.
struct OpeningBodyRow {
  double time = 0;                                  // end of the step [s]
  int body = 0;                                     // from 1, in the order of their names
  double drag = 0, side_x = 0, side_y = 0;          // along the stream, across it [N]
  double moment_x = 0, moment_y = 0, moment_z = 0;  // about the middle of its aft end [N m]
  double drag_area = 0;                             // drag over the stream's dynamic pressure [m2]
};
template <Of<OpeningBodyRow> T, class Visit>
void each_member(T& row, Visit&& visit) {
  visit("time_s", row.time);
  visit("body", row.body);
  visit("drag_n", row.drag);
  visit("side_force_x_n", row.side_x);
  visit("side_force_y_n", row.side_y);
  visit("moment_x_n_m", row.moment_x);
  visit("moment_y_n_m", row.moment_y);
  visit("moment_z_n_m", row.moment_z);
  visit("drag_area_m2", row.drag_area);
}

/// Of one body in the whole opening, in result.json.
struct OpeningBody {
  std::string name;
  double peak_drag = 0, peak_time = 0;              // after the start-up of the air [N], [s]
  double drag_area = 0;                             // mean over the last fifth of the opening [m2]
  double reference_area = 0, drag_coefficient = 0;  // [m2]; drag area over it
};
template <Of<OpeningBody> T, class Visit>
void each_member(T& b, Visit&& visit) {
  visit("name", b.name);
  visit("peak_drag_n", b.peak_drag);
  visit("peak_time_s", b.peak_time);
  visit("drag_area_at_end_m2", b.drag_area);
  visit("reference_area_m2", b.reference_area);
  visit("drag_coefficient_at_end", b.drag_coefficient);
}

/// Appends the rows of the steps from `first` on.
void add_body_rows(const std::vector<AirRow>& air, std::size_t first, std::vector<OpeningBodyRow>& rows);

/// `rigid` are the bodies of the flow without the canopy; nothing without any.
std::optional<std::vector<OpeningBody>> opening_bodies(const Settings& resolved,
                                                       const std::vector<FlowBody>& rigid,
                                                       const std::vector<OpeningBodyRow>& rows,
                                                       double start_up);

/// Of a payload without a drag area of its own: the drag of its bodies does not decelerate it.
std::vector<std::string> payload_drag_warnings(const Settings& resolved,
                                               const std::optional<std::vector<OpeningBody>>& bodies);

}  // namespace ripstop::inline run

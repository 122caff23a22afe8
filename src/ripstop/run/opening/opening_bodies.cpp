#include "ripstop/run/opening/opening_bodies.h"

#include <fmt/format.h>

#include "ripstop/case/bodies.h"

namespace ripstop::inline run {
namespace {

constexpr double end_share = 0.2;  // of the opening, over which the drag area is averaged

OpeningBody result_of_body(const FlowBody& body, int number, const std::vector<OpeningBodyRow>& rows,
                           double start_up) {
  OpeningBody result;
  result.name = body.name;
  const double from = rows.empty() ? 0 : (1 - end_share) * rows.back().time;
  double before = 0, sum = 0, time = 0;
  for (const OpeningBodyRow& row : rows) {
    if (row.body != number) continue;
    if (row.time > start_up && row.drag > result.peak_drag)
      result.peak_drag = row.drag, result.peak_time = row.time;
    if (row.time > from) sum += (row.time - before) * row.drag_area, time += row.time - before;
    before = row.time;
  }
  if (time > 0) result.drag_area = sum / time;
  return result;
}

}  // namespace

void add_body_rows(const std::vector<AirRow>& air, std::size_t first, std::vector<OpeningBodyRow>& rows) {
  for (std::size_t n = first; n < air.size(); ++n) {
    for (std::size_t body = 0; body < air[n].bodies.size(); ++body) {
      const auto& [force, moment] = air[n].bodies[body];
      rows.push_back({air[n].time, static_cast<int>(body) + 1, force.z, force.x, force.y, moment.x, moment.y,
                      moment.z, force.z / air[n].dynamic_pressure});
    }
  }
}

std::optional<std::vector<OpeningBody>> opening_bodies(const Settings& resolved,
                                                       const std::vector<FlowBody>& rigid,
                                                       const std::vector<OpeningBodyRow>& rows,
                                                       double start_up) {
  if (rigid.empty()) return {};
  std::vector<OpeningBody> results;
  for (const FlowBody& body : rigid) {
    OpeningBody result = result_of_body(body, static_cast<int>(results.size()) + 1, rows, start_up);
    result.reference_area = reference_area(resolved, body);
    result.drag_coefficient = result.drag_area / result.reference_area;
    results.push_back(result);
  }
  return results;
}

std::vector<std::string> payload_drag_warnings(const Settings& resolved,
                                               const std::optional<std::vector<OpeningBody>>& bodies) {
  if (!bodies || resolved.payload().drag_area_m2 > 0) return {};
  double area = 0;
  for (const OpeningBody& body : *bodies) area += body.drag_area;
  return {fmt::format(
      "payload.drag_area_m2 = 0: the computed drag of the bodies does not decelerate the payload, "
      "which moves without air drag; set the key, to {:.2g} m2 by this flow",
      area)};
}

}  // namespace ripstop::inline run

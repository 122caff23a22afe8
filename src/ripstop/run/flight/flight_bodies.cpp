#include "ripstop/run/flight/flight_bodies.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "ripstop/case/bodies.h"
#include "ripstop/flow/statistics.h"

namespace ripstop::inline run {
namespace {

constexpr double mostly_resolved = 0.95;  // share of the time, below which a warning states it

FlightBody mean_of(const FlowBody& body, double number, const std::vector<FlightBodyRow>& rows, double began,
                   double from) {
  const auto mean = [&](const std::function<double(const FlightBodyRow&)>& value) {
    Record record;
    record.begin = began;
    for (const FlightBodyRow& row : rows)
      if (row.body == number) record.until.push_back(row.time), record.values.push_back(value(row));
    return mean_over_time(record, from);
  };
  FlightBody result;
  result.name = body.name;
  result.drag = mean([](const FlightBodyRow& row) { return row.drag; }).mean;
  const MeanOverTime area = mean([](const FlightBodyRow& row) { return row.drag_area; });
  result.drag_area = area.mean;
  if (std::isfinite(area.standard_error)) result.drag_area_error = area.standard_error;
  result.mean_incidence = mean([](const FlightBodyRow& row) { return row.incidence; }).mean;
  result.resolved = mean([](const FlightBodyRow& row) { return row.resolved; }).mean;
  return result;
}

}  // namespace

std::vector<FlightBody> flight_bodies(const Settings& resolved, const std::vector<FlowBody>& rigid,
                                      const std::vector<FlightBodyRow>& rows, double began, double from) {
  std::vector<FlightBody> results;
  for (const FlowBody& body : rigid) {
    FlightBody result = mean_of(body, static_cast<double>(results.size() + 1), rows, began, from);
    result.reference_area = reference_area(resolved, body);
    result.drag_coefficient = result.drag_area / result.reference_area;
    results.push_back(result);
  }
  return results;
}

std::vector<std::string> flight_body_warnings(const Settings& resolved,
                                              const std::vector<FlightBody>& bodies) {
  std::vector<std::string> warnings;
  double area = 0;
  for (const FlightBody& body : bodies) {
    area += body.drag_area;
    if (body.resolved < mostly_resolved)
      warnings.push_back(fmt::format(
          "body.{}: a part of it is outside of the fine cells for {:.0f} % of the flight, where its drag and "
          "its wake are less accurate; increase flow.core.size_m with flow.cells",
          body.name, 100 * (1 - body.resolved)));
  }
  if (!bodies.empty() && !(resolved.payload().drag_area_m2 > 0))
    warnings.push_back(fmt::format(
        "payload.drag_area_m2 = 0: the computed drag of the bodies does not act on the payload, which moves "
        "without air drag; set the key, to {:.2g} m2 by this flow",
        area));
  return warnings;
}

}  // namespace ripstop::inline run

// A measured flight compared with computed runs: `ripstop compare-flight`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/core/members.h"
#include "ripstop/core/table/table.h"
#include "ripstop/flight/flight_log.h"

namespace ripstop::inline run {

struct MeasuredFlightRequest {
  std::vector<std::filesystem::path>
      logs;  // tables of time and height, acceleration, force; docs/guide/tables.md
  std::vector<table::ColumnChoice> columns;
  table::Decimal decimal = table::Decimal::automatic;
  std::optional<double> mass;               // that descends, parachute included [kg]; absent: of the case
  double mass_uncertainty = 0.01;           // one standard deviation, relative
  double ground = 0;                        // above sea level [m]
  double height_zero = 0;                   // height above ground where the log reads 0 [m]
  double body_drag_area = 0;                // [m2]
  std::vector<std::filesystem::path> runs;  // finished steady runs
};

/// A computed drag area and the phase that it is compared with, the one with the nearest drag area.
struct FlightComparison {
  std::string run;
  double drag_area = 0, drag_area_uncertainty = 0;  // [m2]; the uncertainty is the numerical one of the run
  int phase = 0;                                    // counted from 1; 0: no phase has a drag area
  std::optional<double> difference;                 // computed to measured, relative
};
template <Of<FlightComparison> T, class Visit>
void each_member(T& c, Visit&& visit) {
  visit("run", c.run);
  visit("drag_area_m2", c.drag_area);
  visit("drag_area_uncertainty_m2", c.drag_area_uncertainty);
  visit("phase", c.phase);
  visit("difference", c.difference);
}

/// result.json of `ripstop compare-flight`.
struct MeasuredFlight {
  std::string title;
  std::vector<std::string> logs;
  double mass = 0;  // [kg]
  std::string mass_from;
  double nominal_area = 0;                                 // of the case [m2]
  double highest = 0, highest_time = 0, height_noise = 0;  // [m], [s], [m]
  std::vector<DescentPhase> phases;
  std::vector<LoggedDeployment> deployments;
  std::vector<DragAreaAtHeight> drag_areas;
  std::vector<FlightComparison> computed;
  std::vector<std::string> notes;
  std::vector<std::string> warnings;  // of the runs
  SensorRecord height;                // not in result.json
};
template <Of<MeasuredFlight> T, class Visit>
void each_member(T& f, Visit&& visit) {
  visit("title", f.title);
  visit("logs", f.logs);
  visit("mass_kg", f.mass);
  visit("mass_from", f.mass_from);
  visit("nominal_area_m2", f.nominal_area);
  visit("highest_m", f.highest);
  visit("highest_time_s", f.highest_time);
  visit("height_noise_m", f.height_noise);
  visit("phases", f.phases);
  visit("deployments", f.deployments);
  visit("drag_areas", f.drag_areas);
  visit("computed", f.computed);
  visit("notes", f.notes);
  visit("warnings", f.warnings);
}
std::string to_json(const MeasuredFlight& flight);

/// Throws Error(usage) without a mass, Error(bad_data) for a log that cannot be read or has no height.
MeasuredFlight compare_flight(const Settings& resolved, const MeasuredFlightRequest& request);

/// result.json, drag-area.csv, drag-area.png and .svg, height.png and .svg, report.html.
void write_measured_flight(const std::filesystem::path& folder, const MeasuredFlight& flight);

}  // namespace ripstop::inline run

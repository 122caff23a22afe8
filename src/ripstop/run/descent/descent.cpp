#include "ripstop/run/descent/descent.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ripstop/case/cluster.h"
#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/descent.h"
#include "ripstop/flight/validity.h"
#include "ripstop/run/json.h"

namespace ripstop::inline run {
namespace {

// A canopy's shape and the air through its cloth follow the dynamic pressure: beyond this the run is of another flight.
constexpr double far_off = 0.25;  // of the run's own dynamic pressure

}  // namespace

std::string to_json(const Descent& descent) {
  return json_text(descent);
}

CarryingRun carrying_run(const FinishedSteady& run) {
  require_one_canopy(run.resolved, "a descent, an export or an opening load");
  return {run.folder,           run.resolved,         run.result.title, "axial",
          run.result.drag_area, run.drag_uncertainty, run.result.speed, run.result.density,
          run.parachute_mass,   run.warnings};
}

CarryingRun carrying_run(const FinishedFlight& flight) {
  const FlightResult& r = flight.result;
  return {flight.folder,
          flight.resolved,
          r.title,
          "descent",
          *r.coefficient * r.reference_area,
          r.coefficient_error.value_or(0) / *r.coefficient,
          *r.descent,
          r.density,
          r.parachute_mass,
          flight.warnings};
}

CarryingRun carrying_run(const std::filesystem::path& folder) {
  return holds_flight(folder) ? carrying_run(finished_flight(folder)) : carrying_run(finished_steady(folder));
}

Descent run_descent(const CarryingRun& run, double payload_mass, const std::vector<double>& heights,
                    double ground) {
  if (!(payload_mass > 0) || !std::isfinite(payload_mass))
    throw Error(ExitCode::usage, fmt::format("a payload of {:g} kg: must be above 0", payload_mass));
  Descent result;
  result.title = run.title, result.warnings = run.warnings;
  result.run = run.folder.string();
  result.basis = run.basis, result.drag_coefficient = run.drag_area / nominal_area(run.resolved.parachute());
  result.known_coefficient = experience(run.resolved.parachute()).drag_coefficient.if_known();
  result.payload_mass = payload_mass;
  result.parachute_mass = run.parachute_mass;
  result.drag_area = run.drag_area;
  result.drag_area_uncertainty = run.uncertainty * result.drag_area;
  result.run_speed = run.speed;
  result.ground = ground;
  const double mass = payload_mass + run.parachute_mass;
  const double reference_length = nominal_diameter(run.resolved.parachute());
  const double of_speed = 0.5 * run.uncertainty;  // v goes with the root of the drag area
  for (const double height : heights) {
    DescentRow row;
    row.height = height;
    row.density = standard_air(height).density;
    row.speed = terminal_speed(mass, result.drag_area, row.density);
    row.speed_uncertainty = of_speed * row.speed;
    const StandardAir air = standard_air(height);
    const double reynolds = row.density * row.speed * reference_length / air.viscosity;
    for (const std::string& text :
         outside_range(scaled_drag_model,
                       {{"Mach number", row.speed / air.sound_speed}, {"Reynolds number", reynolds}}))
      result.warnings.push_back(fmt::format("at a height of {:g} m: {}", height, text));
    if (height > ground) {
      row.time = descent_time(mass, result.drag_area, height, ground);
      row.time_uncertainty = of_speed * *row.time;
    }
    result.rows.push_back(row);
  }
  // At every height the dynamic pressure is the same: weight over drag area.
  const double wanted = mass * standard_gravity / result.drag_area;
  const double had = 0.5 * run.density * run.speed * run.speed;
  if (std::abs(wanted / had - 1) > far_off)
    result.warnings.push_back(fmt::format(
        "the dynamic pressure of the run was {:.3g} Pa and that of this descent is {:.3g} Pa: shape and drag "
        "area may differ; with [payload] mass_kg = {:g} in the case, ripstop steady computes the speed",
        had, wanted, payload_mass));
  return result;
}

}  // namespace ripstop::inline run

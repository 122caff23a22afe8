#include "ripstop/run/descent/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ripstop/case/payload.h"
#include "ripstop/core/positive.h"
#include "ripstop/run/descent/descent.h"
#include "ripstop/run/descent/flown.h"
#include "ripstop/run/json.h"
#include "ripstop/run/opening/filling.h"
#include "ripstop/run/sizing/pattern.h"
#include "ripstop/run/steady/steady_folder.h"

namespace ripstop::inline run {
namespace {

/// The speed of a run with a payload is its rate of descent, at which no parachute is deployed.
void take_deployment_speed(const FinishedSteady& run, const std::optional<double>& given,
                           ExportedParachute& p) {
  const PayloadKeys& payload = run.resolved.payload();
  const auto known = deployment_speed(payload, given);
  p.speed_assumed = !known && payload.mass_kg;
  p.deployment_speed = known             ? known->speed
                       : p.speed_assumed ? usual_deployment_speed(run.result.speed)
                                         : run.result.speed;
  p.deployment_speed_from = known ? known->from : "speed of the run";
  if (p.speed_assumed)
    p.deployment_speed_from = fmt::format(
        "assumed, the larger of {:g} m/s and {:g} times the rate of descent of {:.3g} m/s, as ripstop size",
        least_deployment_speed, deployment_over_descent, run.result.speed);
  require_positive("deployment speed (m/s)", p.deployment_speed);
}

/// The range of the coefficient in descent is that of `ripstop recovery`, about two standard deviations to each side.
void take_distribution(const DescentDrag& range, ExportedParachute& p) {
  p.drag_area_mean = 0.5 * (range.low + range.high) * p.nominal_area;
  p.drag_area_deviation = 0.25 * (range.high - range.low) * p.nominal_area;
}

/// The drag area of a nominal trajectory is axial.
std::string axial_warning(const DescentDrag& range, const ExportedParachute& p) {
  return fmt::format(
      "{}: the drag area of {:.4g} m2 is axial; in descent its range is {:.4g} to {:.4g} m2, C_D {:.3f} to "
      "{:.3f} on S0 ({}), as for ripstop recovery. The nominal trajectory has the axial drag area, or that "
      "of a flight with --flight. The stochastic parachutes of rocketpy have the middle of the range, {:.4g} "
      "m2, and a standard deviation of a quarter of its width",
      p.title, p.drag_area, range.low * p.nominal_area, range.high * p.nominal_area, range.low, range.high,
      range.from, p.drag_area_mean);
}

}  // namespace

std::string to_json(const ExportedParachute& parachute) {
  return json_text(parachute);
}

std::string to_json(const ExportedRecovery& recovery) {
  return json_text(recovery);
}

std::vector<std::string> warnings_of(const ExportedRecovery& recovery) {
  std::vector<std::string> all;
  for (const ExportedStage& stage : recovery.stages)
    all.insert(all.end(), stage.parachute.warnings.begin(), stage.parachute.warnings.end());
  if (recovery.stages.size() != 2) return all;
  for (std::string& text :
       exchanged_parachutes(recovery.stages[0].parachute.drag_area, recovery.stages[1].parachute.drag_area))
    all.push_back(std::move(text));
  return all;
}

ExportedParachute exported(const FinishedSteady& run, std::optional<double> deployment_speed,
                           const std::optional<FinishedFlight>& flight) {
  const Design& design = run.resolved.parachute();
  ExportedParachute p;
  take_deployment_speed(run, deployment_speed, p);
  p.title = run.result.title, p.run = run.folder.string();
  if (flight) require_same_parachute(flight->resolved, flight->folder.string(), run.resolved);
  const CarryingRun carries = flight ? carrying_run(*flight) : carrying_run(run);
  p.basis = carries.basis;
  p.drag_area = carries.drag_area, p.drag_area_uncertainty = carries.uncertainty * p.drag_area;
  p.known_coefficient = experience(design).drag_coefficient.if_known();
  p.nominal_area = run.result.reference_area;
  p.nominal_diameter = nominal_diameter(design);
  p.drag_coefficient = flight ? *flight->result.coefficient : run.result.drag_coefficient;
  p.drag_coefficient_on = "nominal_area_m2";
  p.radius = run.result.size.projected_diameter / 2, p.height = run.result.size.length;
  p.porosity = facts(design).geometric_porosity();
  const KnownFilling filling = known_filling(design.canopy.family().type);
  const double constant = filling_constant_at(filling.constant, p.deployment_speed);
  p.lag = constant * p.nominal_diameter / p.deployment_speed;
  p.lag_from = fmt::format("filling distance {:.3g} D0 at {:.3g} m/s ({}): {}", constant, p.deployment_speed,
                           p.deployment_speed_from, filling.source);
  p.lag_deviation = filling_time_scatter * p.lag;
  p.mass = run.parachute_mass;
  p.gores = design.gores, p.line_count = design.lines.count, p.line_length = design.lines.length_m;
  p.line_material = design.lines.material, p.line_density = run.resolved.materials().line.linear_density_kg_m;
  p.cloth_material = design.canopy_material,
  p.cloth_density = run.resolved.materials().canopy.areal_density_kg_m2;
  p.packed_volume = run_pattern(run.resolved, {}, packed_by_hand).bill.packed_volume;
  p.packed_diameter = std::cbrt(2 * p.packed_volume / std::numbers::pi);
  p.packed_length = 2 * p.packed_diameter;
  p.warnings = run.warnings;
  if (flight) p.warnings.insert(p.warnings.end(), flight->warnings.begin(), flight->warnings.end());
  const double own = std::max(usual_drag_uncertainty, carries.uncertainty);
  const DescentDrag range = descent_drag(run.resolved, {p.drag_coefficient, "", own, p.basis});
  take_distribution(range, p);
  if (p.basis == "axial") p.warnings.push_back(axial_warning(range, p));
  return p;
}

void pack_into_bay(double diameter, ExportedParachute& parachute) {
  require_positive("diameter of the bay (m)", diameter);
  parachute.packed_diameter = diameter;
  parachute.packed_length = parachute.packed_volume / (std::numbers::pi / 4 * diameter * diameter);
}

}  // namespace ripstop::inline run

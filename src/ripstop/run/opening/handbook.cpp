#include "ripstop/run/opening/handbook.h"

#include <fmt/format.h>

#include <algorithm>

#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/core/words.h"
#include "ripstop/run/opening/filling.h"
#include "ripstop/run/opening/load.h"

namespace ripstop::inline run {
namespace {

/// Coupled openings of solid canopies of tight cloth have up to this many times the infinite-mass load where the payload
/// hardly decelerates, and more than it below this mass ratio (docs/validation/inflation.md, Heavy payloads).
constexpr double computed_over_handbook = 2.5, heavy_mass_ratio = 1;

}  // namespace

bool has_default_damping(const InflationSettings& inflation) {
  const InflationSettings usual;
  return inflation.damping_n_s_m3 == usual.damping_n_s_m3 &&
         inflation.quadratic_damping_n_s2_m4 == usual.quadratic_damping_n_s2_m4;
}

std::string limit_of_damping(const InflationSettings& inflation) {
  return fmt::format("its peak load follows from the damping of the cloth, {}",
                     has_default_damping(inflation)
                         ? "whose default was calibrated on one disk-gap-band parachute with a disk of 1 m"
                         : "which the case gives");
}

std::vector<MethodLoad> handbook_methods(const Settings& resolved, double speed) {
  if (!resolved.payload().mass_kg) return {};
  LoadRequest request;
  request.payload_mass = *resolved.payload().mass_kg;
  request.speed = speed;
  request.path_angle = resolved.inflation().flight_angle_deg;
  request.descent = false;
  try {
    return run_load(resolved, request).stages.front().methods;
  } catch (const Error&) {  // a drop for which no method has an answer: nothing to compare with
    return {};
  }
}

std::optional<FiniteMassRange> finite_mass_range(const std::vector<MethodLoad>& methods) {
  std::optional<FiniteMassRange> range;
  for (const MethodLoad& m : methods) {
    if (!m.applies || m.method == infinite_mass_method || m.method == computed_method) continue;
    if (!range) range = {m.load, m.load};
    range->lowest = std::min(range->lowest, m.load), range->highest = std::max(range->highest, m.load);
  }
  return range;
}

std::string heavy_payload(const Settings& resolved, const LoadResult& load) {
  const bool solid = known_filling(resolved.parachute().canopy.family().type).ludtke_exponent > 2;
  if (!solid) return {};
  for (const StageLoads& stage : load.stages) {
    const double computed = computed_over_handbook * stage.methods.front().load;
    if (stage.mass_ratio >= heavy_mass_ratio || computed <= load.highest_design_load) continue;
    // The drag area is that of the stage, the mass that of payload and parachute.
    return fmt::format(
        "the payload is heavy for {} (mass ratio R_m = rho (C_D S)^1.5 / m = {:.3g})",
        load.stages.size() > 1 ? fmt::format("the stage from {:.2f} s", stage.begin) : "this canopy",
        stage.mass_ratio);
  }
  return {};
}

std::string heavy_payload_advice() {
  return fmt::format(
      "Coupled openings of solid canopies at mass ratios below {:g} have up to {:g} times the infinite-mass "
      "load of the handbook, because the canopy fills within two nominal diameters "
      "(docs/validation/inflation.md). Compute the opening: ripstop inflate CASE --air coupled --set "
      "inflation.mass=payload --out RUN. Its speed is payload.deployment_speed_m_s of the case, or --speed; "
      "--check states its time. Use it in ripstop load with --opening RUN, and in ripstop recovery with "
      "--main-opening RUN or --drogue-opening RUN. A measured load also replaces the handbook "
      "(--measured-load, --main-measured-load, --drogue-measured-load)",
      heavy_mass_ratio, computed_over_handbook);
}

std::string heavy_payload_note(const std::string& caution) {
  return caution.empty()
             ? ""
             : "; the payload is heavy: compute or measure the opening before you use this (see the warning)";
}

std::optional<std::string> handbook_disagreement(double computed, std::optional<double> distance,
                                                 const std::vector<MethodLoad>& methods) {
  const MethodLoad *lowest = nullptr, *highest = nullptr;
  for (const MethodLoad& m : methods) {
    if (m.method == infinite_mass_method || m.method == computed_method) continue;
    if (!lowest || m.load < lowest->load) lowest = &m;
    if (!highest || m.load > highest->load) highest = &m;
  }
  if (!lowest) return {};
  const bool above = computed > (1 + opening_scatter) * highest->load;
  const bool below = computed < (1 - opening_scatter) * lowest->load;
  if (!above && !below) return {};
  const MethodLoad& nearest = above ? *highest : *lowest;
  return fmt::format(
      "the computed opening load of {} N is {:.2g} times the {} finite-mass handbook load ({}: {} N). The "
      "handbook methods assume a filling distance that was measured on larger and faster canopies{}. The "
      "filling time depends on the deployment; design for at least {} N, the highest of these loads, "
      "unless the load of your parachute is measured",
      rounded(computed), computed / nearest.load, above ? "highest" : "lowest", nearest.method,
      rounded(nearest.load),
      distance
          ? fmt::format("; the computed opening reaches its peak after {:.2g} nominal diameters", *distance)
          : "",
      rounded(std::max(computed, highest->load)));
}

std::optional<std::string> above_infinite_mass(double computed, double infinite_mass, bool payload) {
  if (computed <= (1 + opening_scatter) * infinite_mass) return {};
  return fmt::format(
      "the computed opening load of {} N is {:.2g} times the infinite-mass load of {} N (the design load of "
      "ripstop load). The C_x of the handbook is a mean of measured openings with cloth of other "
      "permeability. Design for at least {} N at this speed {}, unless the load of your parachute is "
      "measured",
      rounded(computed), computed / infinite_mass, rounded(infinite_mass), rounded(computed),
      payload ? "and mass" : "with a payload that hardly decelerates");
}

}  // namespace ripstop::inline run

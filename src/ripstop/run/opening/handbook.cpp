#include "ripstop/run/opening/handbook.h"

#include <fmt/format.h>

#include <algorithm>

#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/core/words.h"
#include "ripstop/run/opening/load.h"

namespace ripstop::inline run {

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

std::vector<MethodLoad> handbook_methods(const Settings& resolved) {
  if (!resolved.payload().mass_kg) return {};
  LoadRequest request;
  request.payload_mass = *resolved.payload().mass_kg;
  request.speed = resolved.flow().speed_m_s;
  request.path_angle = resolved.inflation().flight_angle_deg;
  request.descent = false;
  try {
    return run_load(resolved, request).stages.front().methods;
  } catch (const Error&) {  // a drop for which no method has an answer: nothing to compare with
    return {};
  }
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

std::optional<std::string> above_infinite_mass(double computed, double infinite_mass) {
  if (computed <= (1 + opening_scatter) * infinite_mass) return {};
  return fmt::format(
      "the computed opening load of {} N is {:.2g} times the infinite-mass load of {} N (the design load of "
      "ripstop "
      "load). The C_x of the handbook is a mean of measured openings with cloth of other permeability. "
      "Design for at "
      "least {} N at this speed and mass, unless the load of your parachute is measured",
      rounded(computed), computed / infinite_mass, rounded(infinite_mass), rounded(computed));
}

}  // namespace ripstop::inline run

// The flow's keys that follow from the canopy and the porosity model.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/case/case.h"

namespace ripstop {
namespace {

// In diameters of the inflated canopy; docs/theory/flow-cartesian.md, Sides of the box, and
// docs/validation.md say what they are worth.
constexpr double inflated_over_nominal = 0.7;
constexpr Vec3 box{6, 6, 9}, core{1.8, 1.8, 2.2};
constexpr double skirt = 4;
constexpr std::array<int, 3> cells{80, 80, 98};
constexpr double growth = 1.125;

}  // namespace

void settle_flow(Case& value) {
  FlowSettings& flow = value.flow;
  if (flow.porosity_model == PorosityModel::of_cloth)
    flow.porosity_model = canopy_fabric(value).porosity_model;
  if (flow.porosity_model != PorosityModel::sheet) return;
  const auto given = [&](const std::string& key) {
    const auto at = value.origins.lower_bound(key);
    return at != value.origins.end() && at->first.starts_with(key);
  };
  if (!given("flow.box_m") && !given("flow.core") && !given("flow.canopy_position_m")) {
    // An arm or gore lies flat in the start shape and has to fit into the core too.
    const double nominal = std::sqrt(4 / std::numbers::pi * nominal_area(value.parachute));
    const double d = std::max(inflated_over_nominal * nominal, start_diameter(value.parachute) / core.x);
    flow.box_m = d * box;
    flow.core.size_m = d * core;
    flow.core.growth = growth;
    flow.canopy_position_m = d * skirt;
    if (!given("flow.cells")) flow.cells = cells;
  }
  if (!given("flow.sides")) flow.sides = Sides::entraining;
  if (!given("flow.outlet")) flow.outlet = Outlet::still_air;
  if (!given("flow.convection")) flow.convection = Convection::second_order;
  if (!given("flow.residual")) flow.residual = 3e-4;
  if (!given("flow.max_iterations")) flow.max_iterations = 300;
  if (!given("flow.average_over")) flow.average_over = std::min(60, flow.max_iterations);
  if (!given("coupling.load")) value.coupling.load = CanopyLoad::of_flow;
  if (!given("coupling.drag_tolerance")) value.coupling.drag_tolerance = 5e-3;
}

}  // namespace ripstop

#include "ripstop/case/flight_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ripstop/case/bodies.h"
#include "ripstop/case/resolve.h"
#include "ripstop/core/angle.h"
#include "ripstop/flow/flow_grid.h"

namespace ripstop::inline cases {
namespace {

constexpr double growth = 1.2;  // of the cells outside of the core: a coarse grid in a wide box
constexpr int multiple = 4;     // of cells along an axis, for the multigrid
// The box contains the payload with its bodies at this angle of the lines from its axis (assumed) [deg].
constexpr double widest_swing = 45;
// Without cluster.widest_spread_angle_deg: at least so wide, and so much wider than at the start (assumed) [deg].
constexpr double usual_widest = 45, wider_than_first = 15;

/// Cells of width h in the core, growing outside of it.
int cells_along(double core, double before, double after, double h) {
  const double count =
      std::ceil(core / h) + cells_outside(h, before, growth) + cells_outside(h, after, growth);
  return multiple * static_cast<int>(std::ceil(count / multiple));
}

std::array<int, 3> coarse_cells(const Case& given, double over_diameter) {
  const double d = inflated_diameter(given.parachute), h = nominal_diameter(given.parachute) / over_diameter;
  const double aside = 0.5 * d * (sheet_box.x - sheet_core.x),
               before = d * (sheet_skirt - 0.25 * sheet_core.z);
  const int across = cells_along(d * sheet_core.x, aside, aside, h);
  return {across, across,
          cells_along(d * sheet_core.z, before, d * (sheet_box.z - sheet_core.z) - before, h)};
}

// The core is that of one canopy, wider by the distance between canopies on opposite sides, because a cluster turns
// freely about its axis. It is longer by the depth of an inclined mouth, and by the difference in height of a canopy on
// the axis and one at the widest angle. The box is that of one canopy times the root of their number, and twice as wide
// as the core.
void take_cluster_cells(Case& flight, double over_diameter) {
  const double d = inflated_diameter(flight.parachute),
               h = nominal_diameter(flight.parachute) / over_diameter, arm = cluster_arm(flight),
               widest = degree * widest_in_flight(*flight.cluster),
               root = std::sqrt(double(flight.cluster->canopies));
  const double wider = 2 * arm * std::sin(widest),
               longer = d * std::sin(widest) + arm * (1 - std::cos(widest));
  FlowKeys& flow = flight.flow;
  const Vec3 core = d * sheet_core + Vec3{wider, wider, longer};
  const double side =
                   std::max({root * d * sheet_box.x, d * sheet_box.x + wider, least_box_over_core * core.x}),
               length = root * d * sheet_box.z + longer,
               before = root * d * (sheet_skirt - 0.25 * sheet_core.z), aside = 0.5 * (side - core.x);
  const int across = cells_along(core.x, aside, aside, h);
  flow.box_m = Vec3{side, side, length};
  flow.core.size_m = core, flow.core.start_m = before;
  flow.canopy_position_m = before + 0.25 * d * sheet_core.z + 0.5 * longer;
  flow.cells = {across, across, cells_along(core.z, before, length - before - core.z, h)};
}

// The core of one canopy, longer upstream by the bodies without a swing. The box contains them at the widest
// swing about the canopy.
void take_body_cells(Case& flight, double over_diameter) {
  const double d = inflated_diameter(flight.parachute),
               h = nominal_diameter(flight.parachute) / over_diameter;
  const BodiesAhead ahead = bodies_ahead(flight);
  const double ahead_of_skirt = std::max(d * sheet_skirt, ahead.domain_front()),
               core_ahead = std::max(0.25 * d * sheet_core.z, ahead.fine_front()),
               behind = 0.75 * d * sheet_core.z,
               swung = 2 * (ahead.front * std::sin(degree * widest_swing) + ahead.width);
  const Vec3 core{d * sheet_core.x, d * sheet_core.y, core_ahead + behind};
  const double side = std::max(d * sheet_box.x, swung), aside = 0.5 * (side - core.x),
               length = ahead_of_skirt + std::max(d * (sheet_box.z - sheet_skirt), core.z - ahead_of_skirt),
               before = ahead_of_skirt - core_ahead;
  FlowKeys& flow = flight.flow;
  flow.box_m = Vec3{side, side, length};
  flow.core.size_m = core, flow.core.start_m = before;
  flow.canopy_position_m = ahead_of_skirt;
  const int across = cells_along(core.x, aside, aside, h);
  flow.cells = {across, across, cells_along(core.z, before, length - before - core.z, h)};
}

}  // namespace

double widest_in_flight(const ClusterKeys& keys) {
  const double usual = std::max(usual_widest, keys.spread_angle_deg + wider_than_first);
  return keys.widest_spread_angle_deg.value_or(std::min(widest_spread, usual));
}

double cells_for_folds(const Case& flight) {
  constexpr double across_folds = 2.2;  // a coupled opening refuses fewer than 2
  const double width = 2 * flight.inflation.initial_radius_m.value_or(0);
  const double needed = width > 0 ? across_folds * nominal_diameter(flight.parachute) / width : 0;
  return std::max(needed, flight.flight.cells_across);
}

void take_flight_cells(Case& flight, double across) {
  FlowKeys& flow = flight.flow;
  if (flow.cells || flow.box_m || flow.core.size_m) return;
  if (flight.cluster)
    take_cluster_cells(flight, across);
  else if (!flight.bodies.empty())
    take_body_cells(flight, across);
  else
    flow.cells = coarse_cells(flight, across);
  if (!flow.core.growth) flow.core.growth = growth;
}

}  // namespace ripstop::inline cases

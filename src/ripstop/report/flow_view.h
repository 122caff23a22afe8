// The air about a canopy as the report shows it: a box of cells that is cut through, and streamlines.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "ripstop/core/vec3.h"

namespace ripstop::inline report {

struct FlowView {
  std::array<int, 3> cells{};            // cell (i, j, k) is number i + nx (j + ny k)
  Vec3 origin, spacing;                  // of the first cell's centre, of the cells [m]
  std::vector<double> pressure;          // over the outlet's [Pa], one a cell
  std::vector<double> speed;             // [m/s]
  std::vector<double> streamlines;       // x, y, z of all points [m]
  std::vector<int> lengths;              // points of each streamline
  std::vector<double> streamline_speed;  // at each point [m/s]
};

/// The surroundings of a canopy that lies between `low` and `high`, from a flow.vti or flow.vtr, in at most
/// `most_cells` cells. Throws Error(bad_data), Error(io).
FlowView read_flow(const std::filesystem::path& file, Vec3 low, Vec3 high, int most_cells = 160'000);

}  // namespace ripstop::inline report

#include "ripstop/flow/symmetry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ripstop/core/error.h"

namespace ripstop::inline flow {
namespace {

constexpr int fewest_cells = 8;     // across the whole box: four in a quarter, as an engine requires
constexpr double same_edge = 1e-9;  // of the width of the box

bool mirrored(const std::vector<double>& edges) {
  const double width = edges.back() - edges.front();
  for (std::size_t low = 0, high = edges.size() - 1; low < high; ++low, --high)
    if (std::abs(edges[low] + edges[high]) > same_edge * width) return false;
  return true;
}

}  // namespace

std::string why_not_mirrored(const FlowProblem& problem) {
  if (!problem.air.along_z()) return "the stream is not along the axis";
  // With these sides the velocity in a quarter differed locally by 1 %, for a reason that is not known.
  if (problem.sides == Sides::far_field) return "the sides are the far field";
  if (!problem.body_force.empty()) return "forces act on the air";
  for (const int axis : {0, 1}) {
    const int cells = problem.grid.count(axis);
    if (cells % 2 != 0) return fmt::format("the number of cells across the stream is odd ({})", cells);
    if (cells < fewest_cells)
      return fmt::format("there are {} cells across the stream, fewer than {}", cells, fewest_cells);
    if (!mirrored(problem.grid.edges(axis))) return "the cells are not symmetric about the canopy axis";
  }
  return {};
}

void check_quarter(const FlowProblem& problem) {
  if (!problem.quarter) return;
  if (const std::string reason = why_not_mirrored(problem); !reason.empty())
    throw Error(
        ExitCode::usage,
        fmt::format("flow: a quarter of the domain cannot be solved, because {}; solve the full domain",
                    reason));
}

}  // namespace ripstop::inline flow

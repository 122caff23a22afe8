#include "ripstop/case/cost.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "ripstop/case/assemble.h"
#include "ripstop/case/cluster.h"
#include "ripstop/core/error.h"
#include "ripstop/flow/openfoam/openfoam.h"

namespace ripstop::inline cases {
namespace {

// Measured with the built-in engine (time -f %M): 0.66 GB for 1.5 million cells and 26,000 nodes of the sheet, 0.35 GB for
// 0.63 million, 0.17 GB for a quarter of these. A run that continues reads its flow next to the one that it has computed.
constexpr double bytes_a_cell = 500, bytes_a_run = 1.5e8;
// Measured (time -f %M): 360 MB for 400,000 nodes of cloth (fabric), 716 MB for 900,000 of lines (check).
constexpr double bytes_a_node = 1000;
// About the means of the 22 runs of make validate-families on 627,200 cells with 8,000 to 50,300 nodes, from the flat
// canopy (iterations.csv), one core each next to other work: 21 of them took 0.5 to 2 times this estimate, a ringsail
// with 16 coupling iterations 5 times.
constexpr double flow_iterations = 1000, cell_time = 1.2e-7;  // of a cell and iteration [core s]
constexpr double cloth_steps = 15000, node_time = 1.5e-8;     // of a node and step [core s]

// Of a quarter: a quarter of the arrays, and pressure and velocity of the whole box.
constexpr double quarter_cells = 0.25, quarter_memory = 0.3;

/// The number behind `name` in a file of lines "name value", nothing where there is none.
std::optional<double> number_in(const char* file, const std::string& name) {
  std::ifstream in(file);
  std::string word;
  while (in >> word) {
    double value = 0;
    if (word == name && in >> value) return value;
  }
  return {};
}

std::optional<double> number_of(const char* file) {
  std::ifstream in(file);
  double value = 0;
  if (in >> value) return value;
  return {};
}

/// Of cloth, lines and riser.
double node_estimate(const Design& design) {
  const double line = design.lines.length_m + nominal_diameter(design);
  return design.mesh.cloth_nodes +
         (design.lines.count * line + design.riser.length_m) / design.mesh.line_segment_m;
}

}  // namespace

double flow_memory(double cells) {
  return bytes_a_run + bytes_a_cell * cells;
}

Cost cost_of(const Settings& resolved, bool quarter) {
  Cost cost;
  const Design& design = resolved.parachute();
  const FlowSettings& flow = resolved.flow();
  cost.nodes = canopy_count(resolved.written()) * node_estimate(design);
  cost.cells = double(flow.cells[0]) * flow.cells[1] * flow.cells[2];
  if (flow.cloth_levels > 0)
    cost.cells = fitted_cells(flow_grid(flow), nominal_area(design), flow.cloth_levels);
  cost.solved_cells = (quarter ? quarter_cells : 1) * cost.cells;
  cost.cloth_memory = bytes_a_node * cost.nodes;
  cost.memory = flow_memory((quarter ? quarter_memory : 1) * cost.cells) + cost.cloth_memory;
  cost.time = flow_iterations * cell_time * cost.solved_cells + cloth_steps * node_time * cost.nodes;
  return cost;
}

Cost steady_cost(const Settings& resolved) {
  return cost_of(resolved, why_full_box(resolved, steady_mesh(resolved), flow_problem(resolved)).empty());
}

double free_memory() {
  double free = 1024 * number_in("/proc/meminfo", "MemAvailable:").value_or(4e6);
  const auto most = number_of("/sys/fs/cgroup/memory.max"), used = number_of("/sys/fs/cgroup/memory.current");
  if (most && used) free = std::min(free, *most - *used);
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    const double own = 1024 * number_in("/proc/self/status", "VmSize:").value_or(0);
    free = std::min(free, double(limit.rlim_cur) - own);
  }
  return std::max(0.0, free);
}

void require_memory(double bytes, const std::string& what, int canopies) {
  const double free = free_memory();
  if (bytes <= free) return;
  throw Error(ExitCode::resources,
              fmt::format("{} needs about {:.1f} GB of memory, but {:.1f} GB are free: use fewer cells "
                          "(flow.cells){} nodes (parachute.mesh){}",
                          what, 1e-9 * bytes, 1e-9 * free, canopies > 1 ? "," : " or",
                          canopies > 1 ? fmt::format(" or canopies (cluster.canopies = {})", canopies) : ""));
}

void require_cloth_memory(const Design& design) {
  const double nodes = node_estimate(design);
  require_memory(bytes_a_node * nodes, fmt::format("a mesh of {:.3g} nodes", nodes));
}

}  // namespace ripstop::inline cases

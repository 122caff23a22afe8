// Cost of a flow solution on the printed grid: bench_openfoam_cost [cells across] [ranks] [iterations].
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <utility>

#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/flow/steady.h"

namespace {

using namespace ripstop;
namespace fs = std::filesystem;

/// A shallow cap of 1 m diameter in 51,200 triangles.
std::vector<Triangle> cap() {
  constexpr int n = 160;
  const auto point = [](int i, int j) {
    const double r = 0.05 + 0.45 * i / n, angle = 2 * std::numbers::pi * j / n;
    return Vec3{r * std::cos(angle), r * std::sin(angle), 2 + 0.5 * r * r};
  };
  std::vector<Triangle> surface;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      surface.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1)});
      surface.push_back({point(i, j), point(i + 1, j + 1), point(i, j + 1)});
    }
  }
  return surface;
}

double size_gb(const fs::path& folder) {
  double bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) bytes += static_cast<double>(entry.file_size());
  }
  return bytes / 1e9;
}

class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

int main(int argc, char** argv) {
  const int across = argc > 1 ? std::atoi(argv[1]) : 100;
  FlowProblem problem;
  problem.grid = {{-1, -1, 0}, {2, 2, 4}, across, across, across * 3 / 2};
  problem.air.velocity = {0, 0, 27.1};
  problem.stopping.max_iterations = argc > 3 ? std::atoi(argv[3]) : 5;
  const fs::path folder = fs::temp_directory_path() / fmt::format("ripstop_cost_{}", getpid());
  OpenFoamSettings settings;
  settings.folder = folder / "case";
  settings.ranks = argc > 2 ? std::atoi(argv[2]) : 1;

  const std::vector<Triangle> surface = cap();
  Stopwatch watch;
  problem.bodies = {porous_body({cut_cells(problem.grid, surface), 65.98, 37.45})};
  fmt::print("{} triangles cut {} of {} cells: {:.4f} s\n", surface.size(),
             problem.bodies[0].porous().cells.size(), problem.grid.cells(), watch.lap());
  const auto engine = make_openfoam(settings);
  const FlowReport report = [&](const FlowProgress& now) {
    fmt::print("iteration {}: {:.2f} s, drag {:.2f} N, residual of p {:.2e}\n", now.iteration, watch.lap(),
               now.drag, now.residual_p);
    return true;
  };
  const auto flow = engine->start(problem);
  for (const char* start : {"cold", "warm"}) {
    solve_to_rest(*flow, problem.stopping,
                  report);  // the time of the first iteration contains mesh and start
    fmt::print("{} start done; fields written and read: {:.2f} s\n", start, watch.lap());
  }
  flow->save(folder / "saved");
  fmt::print("saved: {:.2f} s, {:.3f} GB; case {:.3f} GB\n", watch.lap(), size_gb(folder / "saved"),
             size_gb(folder / "case"));
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  fmt::print("largest child {:.2f} GB\n", static_cast<double>(usage.ru_maxrss) / 1e6);
  fs::remove_all(folder);
}

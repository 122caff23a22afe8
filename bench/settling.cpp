// The flow about the final shape of a steady run, from the start, in the full domain and in a quarter of it: drag,
// momentum deficit and the change of drag that is left, over the iterations.
//
// bench_settling RUN [ITERATIONS [EVERY]]
//     RUN         folder of a finished steady run that may be solved in a quarter
//     ITERATIONS  in all, 800 unless given; a row is printed EVERY 100 unless given
#include <fmt/core.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "ripstop/case/assemble.h"
#include "ripstop/flow/steady.h"
#include "ripstop/fsi/transfer.h"
#include "ripstop/mesh/mesh.h"
#include "ripstop/run/engine.h"
#include "ripstop/run/steady/steady_folder.h"
#include "table.h"

namespace ripstop {
namespace {

/// One flow, and the processor time of its iterations so far.
class Settling {
 public:
  Settling(const Settings& settings, FlowProblem problem, bool quarter) {
    problem.quarter = quarter;
    EngineOptions options = engine_options(settings);
    options.threads = 1;
    engine_ = engine_of(settings).make(options);
    flow_ = engine_->start(problem);
    flow_->guess();
  }

  void advance(int iterations) {
    const std::clock_t begin = std::clock();
    flow_->advance(iterations, 1e-12, [this](const FlowProgress& progress) {
      drags_.push_back(progress.drag);
      return true;
    });
    core_seconds_ += double(std::clock() - begin) / CLOCKS_PER_SEC;
  }

  void add_to(std::vector<std::string>& row) const {
    const double drag = drags_.back();
    row.push_back(fmt::format("{:.3f}", drag));
    row.push_back(fmt::format("{:+.2f}", 100 * (flow_->field().momentum_deficit.z / drag - 1)));
    row.push_back(fmt::format("{:.2f}", 100 * drag_left(drags_)));
    row.push_back(fmt::format("{:.0f}", core_seconds_));
  }

 private:
  std::unique_ptr<FlowEngine> engine_;
  std::unique_ptr<Flow> flow_;
  std::vector<double> drags_;
  double core_seconds_ = 0;
};

void settle(const std::filesystem::path& run, int iterations, int every) {
  const Settings settings = settings_of_run(run);
  const SteadyProblem steady = steady_problem(settings);
  FlowProblem problem = steady.flow;
  problem.bodies[0].surface = surface_of(cells_of(steady.mesh), final_state(run).shape);
  Settling full(settings, problem, false), quarter(settings, problem, true);
  for (int done = every; done <= iterations; done += every) {
    std::vector<std::string> row = {fmt::format("{}", done)};
    for (Settling* flow : {&full, &quarter}) flow->advance(every), flow->add_to(row);
    print_row(row);
  }
}

}  // namespace
}  // namespace ripstop

int main(int argc, char** argv) {
  using namespace ripstop;
  if (argc < 2) {
    fmt::print("bench_settling RUN [ITERATIONS [EVERY]]\n");
    return 2;
  }
  std::vector<std::string> columns = {"iterations"};
  for (const char* part : {"full domain", "quarter"})
    for (const char* value : {"drag N", "momentum deficit over drag, %", "change of drag left, %", "core s"})
      columns.push_back(fmt::format("{}: {}", part, value));
  print_table_head("Settling of the flow about a canopy", argc, argv, columns);
  settle(argv[1], argc > 2 ? std::atoi(argv[2]) : 800, argc > 3 ? std::atoi(argv[3]) : 100);
  return 0;
}

#include "ripstop/run/steady/coarse_start.h"

#include <fmt/format.h>

#include <optional>

#include "ripstop/case/resolve.h"
#include "ripstop/core/error.h"
#include "ripstop/run/engine.h"
#include "ripstop/run/quality.h"

namespace ripstop::inline run {
namespace {

// Cells of the run across the canopy. Half of them give the shape within about a cell of the fine ones; fewer do not.
constexpr double fewest_across = 16;
// The load on coarse cells changes more from iteration to iteration, and its last percent is lost on the fine cells.
constexpr int most_iterations = 6;
constexpr double coarse_drag_tolerance = 0.02, shape_tolerance_factor = 2;

bool may_be_coarsened(const Settings& resolved) {
  return resolved.coupling().coarse_start && resolved.flow().porosity_model == PorosityModel::sheet &&
         resolved.flow().tunnel.kind != TunnelKind::open_jet && engine_of(resolved).can.other_cells &&
         cells_across(resolved) >= fewest_across;
}

/// Half as many cells along each axis, an even number across the stream: planes of symmetry remain cell faces. The flow
/// is handed over, so the same part of the box is solved.
Settings coarsened(const Settings& resolved, bool quarter) {
  Case given = resolved.written();
  const auto& [nx, ny, nz] = resolved.flow().cells;
  given.flow.cells = {2 * ((nx + 2) / 4), 2 * ((ny + 2) / 4), (nz + 1) / 2};
  given.flow.unsteady = false;
  given.flow.symmetry = quarter ? FlowSymmetry::quarter : FlowSymmetry::full;
  if (given.cluster) given.cluster->equilibrium = false;  // of a search, only the first angle
  given.coupling.coarse_start = false;
  given.coupling.max_iterations = most_iterations;
  given.coupling.drag_tolerance = coarse_drag_tolerance;
  given.coupling.shape_tolerance_m = shape_tolerance_factor * resolved.coupling().shape_tolerance_m;
  return resolve(given);
}

class CoarseObserver : public SteadyObserver {
 public:
  CoarseObserver(std::filesystem::path flow, SteadyObserver& next) : flow_(std::move(flow)), next_(next) {}

  void progress(const SteadyProgress& progress, const SteadyState& state) override {
    SteadyProgress coarse = progress;
    coarse.coarse = true;
    next_.progress(coarse, state);
  }
  void ended(const SteadyRun& run, const SteadyState&, const SteadyResult& result) override {
    run.solver.flow().save(flow_);
    next_.solved_coarse(run, result);
  }

 private:
  std::filesystem::path flow_;
  SteadyObserver& next_;
};

}  // namespace

void CoarseStart::give(SteadyState& to) const {
  to.shape = state.shape;
  to.pressure = state.pressure;
  to.residual_traction = state.residual_traction;
  to.speed = state.speed, to.speeds = state.speeds;
}

std::unique_ptr<CoarseStart> coarse_start(const Settings& resolved, const SteadySolver& solver,
                                          const SteadyState& state, SteadyObserver& observer,
                                          const SteadySettings& settings) {
  const bool cold = state.iterations.empty() && state.shape == solver.mesh().start;
  if (!cold || !may_be_coarsened(resolved)) return nullptr;
  try {
    auto start = std::make_unique<CoarseStart>();
    CoarseObserver coarse(start->flow.path, observer);
    start->state = run_steady(coarsened(resolved, solver.full_box_because().empty()), coarse, settings).state;
    return start;
  } catch (const Error& error) {
    if (error.code() != ExitCode::usage && error.code() != ExitCode::diverged &&
        error.code() != ExitCode::not_converged)
      throw;
    observer.warned(fmt::format("no start on coarser cells: {}", error.what()));
    return nullptr;
  }
}

}  // namespace ripstop::inline run

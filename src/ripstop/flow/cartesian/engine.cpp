// The flow engine: grid sequencing, warm start, stopping, divergence, save and restore.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/flow/cartesian/average.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/cartesian/solver.h"

namespace ripstop {
namespace {

using namespace cartesian;

void check(const FlowProblem& problem) {
  const FlowGrid& g = problem.grid;
  const auto usage = [](const std::string& message) { throw Error(ExitCode::usage, message); };
  if (g.nx < 4 || g.ny < 4 || g.nz < 4 || !(g.size.x > 0 && g.size.y > 0 && g.size.z > 0)) {
    usage(
        fmt::format("flow grid: needs at least 4 cells and a positive size on each axis, not {} x {} x {} "
                    "cells of {} x {} x {} m",
                    g.nx, g.ny, g.nz, g.size.x, g.size.y, g.size.z));
  }
  const Freestream& a = problem.air;
  const auto positive_value = [&](const char* name, double value) {
    if (!(value > 0) || !std::isfinite(value))
      usage(fmt::format("free stream: {} = {} must be positive", name, value));
  };
  positive_value("speed", a.speed);
  positive_value("density", a.density);
  positive_value("viscosity", a.viscosity);
  positive_value("temperature", a.temperature);
  positive_value("turbulence intensity", a.turbulence_intensity);
  positive_value("viscosity ratio", a.viscosity_ratio);
  positive_value("residual", problem.residual);
  if (!problem.body_force.empty() &&
      problem.body_force.size() != static_cast<std::size_t>(problem.grid.cells())) {
    usage(fmt::format("flow: {} forces on the air for {} cells", problem.body_force.size(),
                      problem.grid.cells()));
  }
  if (problem.average_over < 0 || problem.average_over > problem.max_iterations) {
    usage(fmt::format("flow: average_over = {} must lie in 0 to max_iterations = {}", problem.average_over,
                      problem.max_iterations));
  }
}

bool converged(const FlowProgress& p, double tolerance) {
  return p.residual_u <= tolerance && p.residual_p <= tolerance && p.residual_k <= tolerance &&
         p.residual_omega <= tolerance;
}

class CartesianEngine final : public FlowEngine {
 public:
  explicit CartesianEngine(const CartesianSettings& settings)
      : settings_(settings), team_(settings.threads) {}

  std::string name() const override { return "built-in (Cartesian, SIMPLE, k-omega SST)"; }
  FlowField solve(const FlowProblem& problem, const FlowReport& report) override;
  void save(const std::filesystem::path& folder) const override;
  void restore(const std::filesystem::path& folder) override;

 private:
  void solve_coarse(const FlowProblem& problem, const FlowGrid& grid, const PorousRows& porous, Solver& fine);
  FlowProgress run(Solver& solver, double tolerance, int iterations, const FlowReport& report, bool& done,
                   int average_over = 0, FieldMean* mean = nullptr);

  CartesianSettings settings_;
  ThreadTeam team_;
  std::unique_ptr<Solver> last_;  // the start of the next solve
};

/// `mean` takes in the last `average_over` of the `iterations`.
FlowProgress CartesianEngine::run(Solver& solver, double tolerance, int iterations, const FlowReport& report,
                                  bool& done, int average_over, FieldMean* mean) {
  FlowProgress progress;
  const auto diverged = [&](const char* when, const std::string& where) {
    const FlowGrid& grid = solver.grid();
    return Error(ExitCode::diverged,
                 fmt::format("the flow diverged {} iteration {} on {} x {} x {} cells: {}; flow.convection = "
                             "\"upwind\", a wider and longer box (flow.box_m) or a coarser grid may help",
                             when, progress.iteration, grid.nx, grid.ny, grid.nz, where));
  };
  done = false;
  for (int n = 1; n <= iterations; ++n) {
    progress = solver.iterate();
    progress.iteration = n;
    const double worst = progress.residual_u + progress.residual_p + progress.residual_k +
                         progress.residual_omega + progress.drag;
    if (!std::isfinite(worst)) throw diverged("in", solver.first_bad_value());
    done = converged(progress, tolerance);
    if (n > iterations - average_over) mean->add(solver.field());
    if (report && !report(progress)) return done = false, progress;
    if (done) break;
  }
  // Residuals are relative to the fields, and say nothing of those that grow slowly and for ever.
  if (const std::string bad = solver.first_bad_value(); !bad.empty() && !solver.shut())
    throw diverged("by", bad);
  return progress;
}

void CartesianEngine::solve_coarse(const FlowProblem& problem, const FlowGrid& grid, const PorousRows& porous,
                                   Solver& fine) {
  const FlowGrid half = coarser(grid);
  const PorousRows averaged(porous, grid, half);
  Solver solver(problem, half, averaged, settings_, team_);
  if (half.cells() > 20000) {
    solve_coarse(problem, half, averaged, solver);
  } else {
    solver.start_uniform();
  }
  bool done = false;
  // The coarse answer differs from the fine one by far more than this; but a wake that has not come to rest
  // here takes eight times as long on the finer grid.
  try {
    run(solver, 1e-3, 200, nullptr, done);
  } catch (const Error&) {  // too coarse for this canopy: the fine grid starts afresh
    return fine.start_uniform();
  }
  fine.start_from(solver);
}

FlowField CartesianEngine::solve(const FlowProblem& problem, const FlowReport& report) {
  check(problem);
  const PorousRows porous(problem.grid, problem.porous, problem.air.viscosity);
  const auto afresh = [&] {
    return std::make_unique<Solver>(problem, problem.grid, porous, settings_, team_);
  };
  auto solver = afresh();
  // A sheet across the whole box holds back pressures far beyond rho U^2, which would not survive being
  // interpolated.
  const bool shut = solver->shut();
  bool from_stream = false;
  if (last_ && last_->sides() == problem.sides && last_->grid().origin == problem.grid.origin &&
      last_->grid().size == problem.grid.size) {
    solver->start_from(*last_);
  } else if (settings_.grid_sequencing && problem.grid.cells() > 20000 && !shut &&
             problem.body_force.empty()) {
    solve_coarse(problem, problem.grid, porous, *solver);
  } else {
    solver->start_uniform();
    from_stream = true;
  }
  bool done = false;
  FieldMean mean;
  FlowProgress progress;
  const auto go = [&] {
    progress =
        run(*solver, problem.residual, problem.max_iterations, report, done, problem.average_over, &mean);
  };
  try {
    go();
  } catch (const Error& error) {
    // Another canopy's wake, or a coarser grid's, can throw a flow off: then once from the stream.
    if (from_stream || error.code() != ExitCode::diverged) throw;
    solver = afresh();
    solver->start_uniform();
    mean = {};
    try {
      go();
    } catch (const Error& again) {
      throw Error(again.code(),
                  fmt::format("{} (from an earlier field and from the uniform stream)", again.what()));
    }
  }
  // Only a whole window is a mean; a run that settled or was stopped inside it has its last field.
  const bool averaged = problem.average_over > 0 && !done && mean.count() == problem.average_over;
  FlowField field = averaged ? mean.mean() : solver->field();
  field.last = progress;
  field.converged = done;
  last_ = std::move(solver);
  return field;
}

// One sealed file: a header that says what the numbers are, then the fields as they lie in memory.
struct Header {
  char magic[8] = {'r', 'i', 'p', 'f', 'l', 'o', 'w', '2'};
  FlowGrid grid;
  Freestream air;
  Sides sides = Sides::zero_gradient;
  Sums sums;
};
static_assert(std::is_trivially_copyable_v<Header>);

constexpr const char* state_file = "cartesian.flow";

std::array<Array<double>*, 10> saved_fields(Fields& f) {
  return {&f.u, &f.v, &f.w, &f.p, &f.rho, &f.k, &f.omega, &f.fx, &f.fy, &f.fz};
}

void CartesianEngine::save(const std::filesystem::path& folder) const {
  if (!last_) throw Error(ExitCode::io, "the flow engine has no field to save yet");
  Header header;
  header.grid = last_->grid();
  header.air = last_->air();
  header.sides = last_->sides();
  header.sums = last_->sums();
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof header);
  for (const Array<double>* field : saved_fields(last_->fields())) {
    bytes.append(reinterpret_cast<const char*>(field->data()), field->size() * sizeof(double));
  }
  make_folder(folder);
  write_sealed(folder / state_file, bytes);
}

void CartesianEngine::restore(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / state_file;
  const std::string bytes = read_sealed(path);
  Header header;
  const Header expected;
  if (bytes.size() < sizeof header)
    throw Error(ExitCode::bad_data, path.string() + ": too short to be a saved flow");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (std::memcmp(header.magic, expected.magic, sizeof header.magic) != 0) {
    throw Error(ExitCode::bad_data, path.string() + ": not a flow saved by this version");
  }
  FlowProblem problem;
  problem.grid = header.grid;
  problem.air = header.air;
  problem.sides = header.sides;
  check(problem);
  auto solver =
      std::make_unique<Solver>(problem, problem.grid, PorousRows(problem.grid, {}, 0), settings_, team_);
  std::size_t at = sizeof header;
  for (Array<double>* field : saved_fields(solver->fields())) {
    const std::size_t size = field->size() * sizeof(double);
    if (at + size > bytes.size()) throw Error(ExitCode::bad_data, path.string() + ": fields are missing");
    std::memcpy(field->data(), bytes.data() + at, size);
    at += size;
  }
  solver->sums() = header.sums;
  last_ = std::move(solver);
}

}  // namespace

std::unique_ptr<FlowEngine> make_cartesian(const CartesianSettings& settings) {
  const auto fraction = [](const char* name, double value) {
    if (!(value > 0 && value <= 1)) {
      throw Error(ExitCode::usage, fmt::format("flow engine: {} = {} must lie in (0, 1]", name, value));
    }
  };
  fraction("relax_pressure", settings.relax_pressure);
  fraction("relax_velocity", settings.relax_velocity);
  fraction("relax_turbulence", settings.relax_turbulence);
  if (settings.pressure_cycles < 1 || settings.pressure_cycles > 20) {
    throw Error(ExitCode::usage, fmt::format("flow engine: pressure_cycles = {} must lie in 1 to 20",
                                             settings.pressure_cycles));
  }
  return std::make_unique<CartesianEngine>(settings);
}

}  // namespace ripstop

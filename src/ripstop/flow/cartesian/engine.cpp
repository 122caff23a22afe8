// The flow engine and its flows: a guess from coarser grids, divergence, save and restore.
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <deque>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/cartesian/march_frame.h"
#include "ripstop/flow/cartesian/quarter.h"
#include "ripstop/flow/cartesian/solver.h"
#include "ripstop/flow/symmetry.h"

namespace ripstop::inline flow {
namespace {

using namespace cartesian;

void check(const Jet& jet, const FlowGrid& grid) {
  const double width = jet.nozzle.width, height = nozzle_height(jet.nozzle);
  if (!(width > 0 && height > 0 && jet.shear_layer > 0 && jet.outside >= 0 && jet.outside < 1))
    throw Error(
        ExitCode::usage,
        fmt::format(
            "jet: a nozzle of {} x {} m, a shear layer of {} m and {} of the speed outside do not form a jet",
            width, height, jet.shear_layer, jet.outside));
  if (width >= grid.size.x || height >= grid.size.y)
    throw Error(ExitCode::usage, fmt::format("jet: a nozzle of {} x {} m does not fit into the inlet of {} x "
                                             "{} m",
                                             width, height, grid.size.x, grid.size.y));
}

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
  positive_value("density", a.density);
  positive_value("viscosity", a.viscosity);
  positive_value("temperature", a.temperature);
  positive_value("turbulence intensity", a.turbulence_intensity);
  positive_value("viscosity ratio", a.viscosity_ratio);
  check_stream(a);
  check_bodies(problem);
  check_quarter(problem);
  if (problem.jet) {
    check(*problem.jet, g);
    if (!a.along_z())
      usage(fmt::format(
          "jet: it leaves the nozzle along +z, not with ({:g}, {:g}, {:g}) m/s; turn the bodies instead",
          a.velocity.x, a.velocity.y, a.velocity.z));
    if (problem.sides == Sides::far_field)
      usage("jet: it comes through the inlet, which a far field does not have; choose entraining sides");
  }
  if (!problem.body_force.empty() &&
      problem.body_force.size() != static_cast<std::size_t>(problem.grid.cells())) {
    usage(fmt::format("flow: {} forces on the air for {} cells", problem.body_force.size(),
                      problem.grid.cells()));
  }
}

bool converged(const FlowProgress& p, double tolerance) {
  return p.residual_u <= tolerance && p.residual_p <= tolerance && p.residual_k <= tolerance &&
         p.residual_omega <= tolerance;
}

QuantityError divergence(const Solver& solver, const std::string& when, const std::string& where,
                         const std::string& remedy) {
  const FlowGrid& grid = solver.grid();
  return {ExitCode::diverged,
          fmt::format("the flow diverged {} on {} x {} x {} cells: {}; {}, a wider and longer domain or a "
                      "coarser grid may help",
                      when, grid.nx, grid.ny, grid.nz, where, remedy),
          {"upwind convection", "longer domain"}};
}

// A saved flow is one sealed file: its basis, the cloth, then all data of a State.
constexpr const char* state_file = "cartesian.flow";

struct Header {
  char magic[8] = {'r', 'i', 'p', 'f', 'l', 'o', 'w', 'B'};
  int frame = 0;  // MarchFrame::number(), or that of a quarter
  FlowGrid grid;  // in that frame, as all else
  Freestream air;
  std::string sides, outlet;  // words
  int jets = 0;               // 0 or 1
  Jet jet = {};
};
/// One number after the other: between the members of a struct lie bytes that nobody has set, and the same flow is
/// to make the same file.
template <class AnyHeader, class Visit>
void each_number(AnyHeader& h, Visit&& visit) {
  visit(h.magic), visit(h.frame);
  visit(h.grid.origin), visit(h.grid.size), visit(h.grid.nx), visit(h.grid.ny), visit(h.grid.nz);
  for (auto& g : h.grid.grading) visit(g);
  visit(h.air), visit(h.sides), visit(h.outlet), visit(h.jets);
  visit(h.jet.nozzle.shape), visit(h.jet.nozzle.width), visit(h.jet.nozzle.height);
  visit(h.jet.outside), visit(h.jet.shear_layer);
}
template <class AnyMotion, class Visit>
void each_part(AnyMotion& m, Visit&& visit) {
  visit(m.velocity), visit(m.yields), visit(m.pressure);
  int rigid = m.rigid.has_value();
  visit(rigid);
  if constexpr (!std::is_const_v<AnyMotion>)
    if (rigid != 0) m.rigid.emplace();
  if (m.rigid) visit(m.rigid->velocity), visit(m.rigid->spin), visit(m.rigid->about);
}
static_assert(sizeof(Grading) == 4 * sizeof(double) + 2 * sizeof(int) &&
              sizeof(Freestream) == 8 * sizeof(double));

/// The bytes of a file in pieces. Arrays, which are large, are not copied and must exist until they are written.
class Writer {
 public:
  template <class T>
  void operator()(const T& value) {
    if constexpr (requires { value.data(); }) {
      (*this)(value.size());
      pieces.emplace_back(reinterpret_cast<const char*>(value.data()), value.size() * sizeof *value.data());
    } else {
      static_assert(std::is_trivially_copyable_v<T>);
      pieces.push_back(copies_.emplace_back(reinterpret_cast<const char*>(&value), sizeof value));
    }
  }
  std::vector<std::string_view> pieces;

 private:
  std::deque<std::string> copies_;
};

class Reader {
 public:
  Reader(const std::filesystem::path& path) : path_(path), bytes_(read_sealed(path)) {}
  template <class T>
  void operator()(T& value) {
    if constexpr (requires { value.data(); }) {
      std::size_t size = 0;
      (*this)(size);
      if (size > bytes_.size()) fail();
      value.resize(size);
      take(value.data(), size * sizeof *value.data());
    } else {
      take(&value, sizeof value);
    }
  }
  bool at_end() const { return at_ == bytes_.size(); }
  [[noreturn]] void fail() const {
    throw Error(ExitCode::bad_data, path_.string() + ": not a flow saved by this version");
  }

 private:
  void take(void* to, std::size_t size) {
    if (at_ + size > bytes_.size()) fail();
    if (size > 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  std::filesystem::path path_;
  std::string bytes_;
  std::size_t at_ = 0;
};

class CartesianFlow final : public Flow {
 public:
  CartesianFlow(const FlowProblem& problem, const CartesianSettings& settings, ThreadTeam& team)
      : frame_(problem.air.velocity),
        given_grid_(problem.grid),
        problem_(frame_.into(problem.quarter ? quarter_of(problem) : problem)),
        settings_(settings),
        team_(team),
        solver_(problem_, problem_.grid, porous(), settings, team) {}

  void place(std::size_t which, const std::vector<Triangle>& surface, const SheetMotion& motion) override {
    place_all({{which, surface, motion}});
  }
  void place_all(const std::vector<Placement>& bodies) override {
    for (const Placement& placed : bodies) {
      FlowBody& body = problem_.bodies.at(placed.body);
      body.surface = frame_.into(placed.surface), body.motion = frame_.into(placed.motion);
      if (!body.is_sheet()) body.porous().cells = cut_cells(problem_.grid, body.surface);
    }
    solver_.place(porous(), problem_.bodies);
  }

  FlowAdvance advance(int iterations, double residual, const FlowReport& report) override;
  FlowStep march(int steps, double courant, const StepReport& report) override;
  double longest_step(double courant) override {
    require_whole();
    return solver_.longest_step(in_range(courant));
  }
  FlowStep step(double length) override;
  void stream(Vec3 velocity, Vec3 acceleration) override {
    require_whole();
    if (problem_.jet) throw Error(ExitCode::usage, "flow: the speed of a jet cannot change during a run");
    if (!solver_.open() && !(velocity.x == 0 && velocity.y == 0 && velocity.z >= 0))
      throw Error(
          ExitCode::usage,
          fmt::format("flow: a stream of ({:g}, {:g}, {:g}) m/s does not enter through the inlet along +z; "
                      "choose the sides \"{}\"",
                      velocity.x, velocity.y, velocity.z, Sides::far_field.word));
    solver_.stream(frame_.into(velocity), frame_.into(acceleration));
  }
  FlowField field() const override {
    FlowField field = solver_.field();
    field.bodies = body_loads(field.sheet_loads);
    if (problem_.quarter) return whole_of(std::move(field), given_grid_);
    return frame_.back(std::move(field), given_grid_);
  }
  void add_to(FieldMean& mean) const override {
    frame_.same() && !problem_.quarter ? solver_.add_to(mean, body_loads(solver_.sheet_loads()))
                                       : Flow::add_to(mean);
  }
  std::vector<SheetLoad> sheet_loads() const override { return frame_.back(solver_.sheet_loads()); }
  bool untouched() const override { return solver_.state().untouched; }

  void guess() override {
    // A sheet across the whole box has pressures far beyond rho U^2, which interpolation would destroy. On a coarse
    // grid omega can grow without bound where the still air around a jet meets the outlet, and it remains on the
    // finer grid; a start from the nozzle's profile needs as many iterations.
    if (settings_.grid_sequencing && !problem_.jet && problem_.grid.cells() > fewest_cells &&
        !solver_.shut() && problem_.body_force.empty())
      guess_from_coarser(problem_.grid, porous(), solver_);
  }
  void start_afresh() override { solver_.start_uniform(); }

  void save(const std::filesystem::path& folder) const override;
  void restore(const std::filesystem::path& folder) override;
  void continue_from(const std::filesystem::path& folder) override;

 private:
  static constexpr int fewest_cells = 20000;  // that justify a coarser grid

  static constexpr int quarter_frame = 4;  // which no MarchFrame::number() is
  int frame_number() const { return problem_.quarter ? quarter_frame : frame_.number(); }
  void require_whole() const {
    if (problem_.quarter)
      throw Error(ExitCode::usage,
                  "flow: a quarter of the domain has no steps in time; solve the full domain");
  }

  static double in_range(double courant) {
    if (courant > 0 && courant <= 1) return courant;
    throw Error(ExitCode::usage,
                fmt::format("flow: a Courant number of {}; must be above 0 and at most 1", courant));
  }
  /// The first bad value of a solver.
  std::string where(const Solver& solver) const;
  QuantityError diverged_by(const FlowStep& now) const;
  static PorousRows porous(const FlowProblem& problem) {
    return {problem.grid, problem.bodies, problem.air.viscosity};
  }
  PorousRows porous() const { return porous(problem_); }
  std::vector<BodyLoad> body_loads(const std::vector<SheetLoad>& sheet_loads) const;
  FlowAdvance run(Solver& solver, int iterations, double residual, const FlowReport& report) const;
  void guess_from_coarser(const FlowGrid& grid, const PorousRows& porous, Solver& fine) const;

  MarchFrame frame_;
  FlowGrid given_grid_;
  FlowProblem problem_;  // in the frame
  CartesianSettings settings_;
  ThreadTeam& team_;
  Solver solver_;
};

std::string CartesianFlow::where(const Solver& solver) const {
  const std::string bad = solver.first_bad_value();
  return frame_.same() ? bad : fmt::format("{}, with {}", bad, frame_.text());
}

FlowAdvance CartesianFlow::run(Solver& solver, int iterations, double residual,
                               const FlowReport& report) const {
  FlowAdvance now;
  const auto diverged = [&](const char* when, const std::string& where) {
    return divergence(solver, fmt::format("{} iteration {}", when, solver.state().iteration), where,
                      "upwind convection");
  };
  for (int n = 1; n <= iterations && !now.converged && !now.stopped; ++n) {
    now.last = solver.iterate();
    now.last.iteration = n;
    const double worst = now.last.residual_u + now.last.residual_p + now.last.residual_k +
                         now.last.residual_omega + now.last.drag;
    if (!std::isfinite(worst)) throw diverged("in", where(solver));
    now.converged = converged(now.last, residual);
    now.stopped = report && !report(now.last);
  }
  if (now.stopped) return now.converged = false, now;
  // Residuals are relative to the fields, and do not show fields that grow slowly without end.
  if (!solver.shut() && !solver.within_reason()) throw diverged("by", where(solver));
  return now;
}

FlowAdvance CartesianFlow::advance(int iterations, double residual, const FlowReport& report) {
  return run(solver_, iterations, residual, report);
}

FlowStep CartesianFlow::march(int steps, double courant, const StepReport& report) {
  if (steps < 1) throw Error(ExitCode::usage, fmt::format("flow: {} steps; must be at least 1", steps));
  FlowStep now;
  for (int n = 0; n < steps; ++n) {
    now = step(solver_.next_step(in_range(courant)));
    if (report && !report(now)) break;
  }
  if (!solver_.shut() && !solver_.within_reason()) throw diverged_by(now);
  return now;
}

std::vector<BodyLoad> CartesianFlow::body_loads(const std::vector<SheetLoad>& sheet_loads) const {
  std::vector<BodyLoad> loads;
  for (const FlowBody& body : problem_.bodies)
    loads.push_back(body.is_sheet() ? BodyLoad{} : solver_.load_on(body.porous(), body.moment_about));
  for (const SheetLoad& load : sheet_loads) {
    BodyLoad& body = loads[static_cast<std::size_t>(load.body)];
    body.force += load.force;
    body.moment +=
        cross(load.point - problem_.bodies[static_cast<std::size_t>(load.body)].moment_about, load.force);
  }
  return loads;
}

FlowStep CartesianFlow::step(double length) {
  require_whole();
  FlowStep now = solver_.step(length);
  now.bodies = body_loads(solver_.sheet_loads());
  if (!std::isfinite(now.force.z) || !is_finite(now.momentum_gap)) throw diverged_by(now);
  return frame_.back(std::move(now));
}

QuantityError CartesianFlow::diverged_by(const FlowStep& now) const {
  return divergence(solver_, fmt::format("by step {}", now.step), where(solver_), "a smaller Courant number");
}

void CartesianFlow::guess_from_coarser(const FlowGrid& grid, const PorousRows& porous, Solver& fine) const {
  const FlowGrid half = coarser(grid);
  const PorousRows averaged(porous, grid, half);
  Solver solver(problem_, half, averaged, settings_, team_);
  if (half.cells() > fewest_cells) guess_from_coarser(half, averaged, solver);
  // The coarse answer differs from the fine one by far more than this; but a wake that has not come to rest
  // here takes eight times as long on the finer grid.
  try {
    run(solver, 200, 1e-3, nullptr);
  } catch (const Error&) {  // too coarse for this canopy: the fine grid starts afresh
    return fine.start_uniform();
  }
  fine.start_from(solver);
}

void CartesianFlow::save(const std::filesystem::path& folder) const {
  Writer out;
  Header header;
  header.frame = frame_number();
  header.grid = problem_.grid, header.air = problem_.air;
  header.sides = problem_.sides.word, header.outlet = problem_.outlet.word;
  if (problem_.jet) header.jets = 1, header.jet = *problem_.jet;
  each_number(header, out);
  for (const FlowBody& body : problem_.bodies) {
    out(body.surface), each_part(body.motion, out);
    if (!body.is_sheet()) out(body.porous().cells);
  }
  each_carried(solver_.state(), out);
  make_folder(folder);
  write_sealed(folder / state_file, out.pieces);
}

Header header_of(Reader& in) {
  Header header;
  const Header expected;
  each_number(header, in);
  if (std::memcmp(header.magic, expected.magic, sizeof header.magic) != 0) in.fail();
  return header;
}

/// Places the saved bodies in `problem`, and reads the state of its solver, whose arrays fit then.
State state_of(Reader& in, FlowProblem& problem, Solver& solver) {
  for (FlowBody& body : problem.bodies) {
    in(body.surface), each_part(body.motion, in);
    if (!body.is_sheet()) in(body.porous().cells);
  }
  solver.place({problem.grid, problem.bodies, problem.air.viscosity}, problem.bodies);
  State state = solver.state();
  each_carried(state, in);
  if (!in.at_end()) in.fail();
  if (state.rate_u.empty())
    stop_the_clock(solver.state());
  else
    solver.begin_time();
  if (!fits(state, solver.state())) in.fail();
  return state;
}

void CartesianFlow::restore(const std::filesystem::path& folder) {
  Reader in(folder / state_file);
  const Header header = header_of(in);
  if (header.frame != frame_number() || !(header.grid == problem_.grid) ||
      header.sides != problem_.sides.word || header.outlet != problem_.outlet.word ||
      (header.jets == 1) != problem_.jet.has_value() || (problem_.jet && !(header.jet == *problem_.jet)))
    throw Error(ExitCode::usage, (folder / state_file).string() + ": was made in a different flow domain");
  State state = state_of(in, problem_, solver_);
  if (!(header.air == problem_.air)) scale(state, header.air, problem_.air);
  solver_.state() = std::move(state);
  if (solver_.state().clock.changing) solver_.let_stream_in();
}

void CartesianFlow::continue_from(const std::filesystem::path& folder) {
  Reader in(folder / state_file);
  const Header header = header_of(in);
  if (header.frame != frame_number() || !(header.air == problem_.air))
    throw Error(ExitCode::usage, (folder / state_file).string() + ": was made in different air");
  FlowProblem before = problem_;
  before.grid = header.grid, before.sides = {header.sides}, before.outlet = {header.outlet};
  before.jet = header.jets == 1 ? std::optional(header.jet) : std::nullopt;
  Solver earlier(before, before.grid, porous(before), settings_, team_);
  earlier.state() = state_of(in, before, earlier);
  problem_.bodies = before.bodies;
  solver_.place(porous(), problem_.bodies);
  solver_.continue_from(earlier);
}

class CartesianEngine final : public FlowEngine {
 public:
  explicit CartesianEngine(const CartesianSettings& settings)
      : settings_(settings), team_(settings.threads) {}

  std::string name() const override { return "built-in (Cartesian, SIMPLE, k-omega SST)"; }
  std::unique_ptr<Flow> start(const FlowProblem& problem) override {
    check(problem);
    return std::make_unique<CartesianFlow>(problem, settings_, team_);
  }

 private:
  CartesianSettings settings_;
  ThreadTeam team_;
};

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

}  // namespace ripstop::inline flow

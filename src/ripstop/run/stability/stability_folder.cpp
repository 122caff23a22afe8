#include "ripstop/run/stability/stability_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "ripstop/case/assemble.h"
#include "ripstop/case/cost.h"
#include "ripstop/case/quantity_keys.h"
#include "ripstop/core/build_info.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/thread_team.h"
#include "ripstop/flow/steady.h"
#include "ripstop/flow/stl.h"
#include "ripstop/fsi/next_load.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/engine.h"
#include "ripstop/run/json.h"
#include "ripstop/run/quality.h"
#include "ripstop/run/stability/stability_files.h"
#include "ripstop/run/stability/stability_report.h"
#include "ripstop/run/stability/window_checkpoint.h"
#include "ripstop/run/steady/checkpoint.h"
#include "ripstop/run/steady/steady_folder.h"
#include "ripstop/run/steady/warnings.h"
#include "ripstop/run/used_run.h"

namespace ripstop::inline run {
namespace {

namespace fs = std::filesystem;

constexpr const char* description = "stability.json";
constexpr const char* row_text = "the result of an angle of attack";

/// The stream turns from one angle to the next while it passes one inflated diameter.
constexpr double turning_diameters = 1;

/// A flow that does not settle has the mean of so many fields, Stopping::piece iterations apart.
constexpr int pieces_of_mean = 8;

constexpr double usual_windows = 4;  // of an angle in equilibrium, for the remaining time

std::string watch_text(const WatchProgress& p, const Freestream& air) {
  const double drag = dot(p.step.force - force_on_others(p.step.bodies), air.direction());
  return p.mean != 0 ? fmt::format("drag {:.2f} N, mean {:.2f} +- {:.2g} N", drag, p.mean, p.standard_error)
                     : fmt::format("drag {:.2f} N, start-up", drag);
}

/// One curve in its folder.
class Curve {
 public:
  Curve(const Case& given, const std::vector<double>& angles, const StabilitySettings& settings)
      : settings_(settings),
        angles_(angles),
        cases_(stability_cases(given, angles)),
        axis_(in_full_domain(resolve(given))) {  // as all angles
    if (settings.equilibrium && !in_time())
      throw Error(ExitCode::usage,
                  fmt::format("--equilibrium: the engine \"{}\" has no flow in time; leave the option out",
                              axis_.flow().engine));
    take_speed();
  }

  void check() const {
    check_series_folder(settings_.run.folder, description, "curve of ripstop stability");
    if (settings_.steady.empty())
      check_steady_in(axis_settings(), axis_);
    else {
      drag_for_opening(settings_.steady, cases_.front());
      warnings_of_used({settings_.steady});
    }
    for (std::size_t i = 0; i < cases_.size(); ++i) holds_run(run_settings(i), cases_[i], inputs(i));
  }

  StabilityResult run(StabilityObserver& observer);
  std::vector<std::vector<std::string>> waves() const;
  void prepare() const {
    check();
    open();
  }
  void run_part(const std::string& name, StabilityObserver& observer);
  StabilityResult gather(std::vector<std::string>& missing, StabilityObserver& observer);

 private:
  fs::path axis_folder() const {
    return settings_.steady.empty() ? settings_.run.folder / axis_name : settings_.steady;
  }
  RunSettings run_settings(std::size_t i) const {
    return {settings_.run.folder / angle_name(angles_[i]), settings_.run.fresh, settings_.run.fields, false};
  }
  SteadyFolderSettings axis_settings() const {
    return {{axis_folder(), settings_.run.fresh, settings_.run.fields, false},
            settings_.threads,
            {},
            {},
            settings_.elsewhere};
  }
  std::string engine_name() const { return engine_of(axis_).name(engine_options(axis_)); }
  bool in_time() const { return engine_of(axis_).can.time; }
  bool starts_from_neighbour(std::size_t i) const { return settings_.warm && in_time() && i > 0; }

  /// Inputs of a row in addition to its case: the shape, the cells, and the previous angles of its flow.
  std::string inputs(std::size_t i) const {
    const std::string shape = settings_.steady.empty() ? inputs_hash(axis_, engine_name())
                                                       : inputs_of_run(settings_.steady).value_or("");
    std::string text = fmt::format("{}\nstability\nshape {}\n{} cells across\nwidest {}\n", engine_name(),
                                   shape, settings_.across, csv_number(angles_.back()));
    for (std::size_t k = 0; k < i && starts_from_neighbour(i); ++k)
      text += "after " + csv_number(angles_[k]) + "\n";
    return text;
  }

  int threads(std::size_t i) const {
    return settings_.threads > 0 ? settings_.threads : cases_[i].coupling().threads;
  }
  FlowProblem flow_at(std::size_t i) const {
    return stability_flow(cases_[i], canopy_, settings_.across, angles_.back());
  }
  Watch window(std::size_t i) const;

  std::unique_ptr<ClaimedFolder> open() const;
  void run_axis(SteadyObserver& observer) const;
  void take_speed();
  void take_shape();
  /// Trims, and the warnings of the rows so far.
  void take_results();
  StabilityRow run_angle(std::size_t i, StabilityObserver& observer);
  std::optional<SteadyState> start_from_neighbour(std::size_t i, Flow& flow) const;
  StabilityRow rigid_in_time(std::size_t i, ClaimedFolder& folder, FlowEngine& engine,
                             StabilityObserver& observer);
  StabilityRow equilibrium_in_time(std::size_t i, ClaimedFolder& folder, FlowEngine& engine,
                                   StabilityObserver& observer);
  StabilityRow at_rest(std::size_t i, FlowEngine& engine, StabilityObserver& observer);
  void drop_flow(std::size_t i) const {
    if (!settings_.run.fields) remove_path(run_settings(i).folder / "checkpoint");
  }
  void end(ClaimedFolder& folder, StabilityObserver& observer) const {
    if (settings_.run.report)
      if (const std::string failure = write_stability_report(folder, result_, axis_folder());
          !failure.empty())
        observer.warned(failure);
    folder.seal();
  }
  void write(ClaimedFolder& folder) const { write_stability_files(folder, result_); }

  const StabilitySettings& settings_;
  std::vector<double> angles_;
  std::vector<Settings> cases_;
  Settings axis_;      // of the steady run
  SteadyState shape_;  // its end
  RigidCanopy canopy_;
  StabilityResult result_;
};

std::unique_ptr<ClaimedFolder> Curve::open() const {
  auto claimed = std::make_unique<ClaimedFolder>(settings_.run.folder);
  claimed->unseal();
  nlohmann::ordered_json j;
  j["program"] = "ripstop";
  j["version"] = version();
  j["processor"] = processor();
  j["shape_from"] = axis_folder().string();
  j["cells_across"] = settings_.across;
  j["runs"] = nlohmann::json::array();
  for (std::size_t i = 0; i < angles_.size(); ++i)
    j["runs"].push_back({{"folder", angle_name(angles_[i])},
                         {"angle_deg", angles_[i]},
                         {"starts_from", starts_from_neighbour(i) ? nlohmann::json(angle_name(angles_[i - 1]))
                                                                  : nlohmann::json()}});
  write_file(claimed->own(description), j.dump(2) + "\n");
  return claimed;
}

void Curve::run_axis(SteadyObserver& observer) const {
  if (!settings_.steady.empty()) return;
  if (!run_steady_in(axis_settings(), axis_, observer).result.converged)
    throw Error(
        ExitCode::not_converged,
        fmt::format("{}: the steady run on the axis has not converged; raise coupling.max_iterations or "
                    "loosen its tolerances",
                    axis_folder().string()));
  drop_flow_checkpoint(axis_folder());
}

/// A case with a payload has the speed that the steady run found.
void Curve::take_speed() {
  if (!axis_.payload().mass_kg || !is_sealed(axis_folder())) return;
  const double speed = steady_result_from_json(finished_result(axis_folder()).value()).speed;
  for (Settings& one : cases_) one = at_speed(one, speed);
}

void Curve::take_shape() {
  if (!is_sealed(axis_folder()))
    throw Error(ExitCode::io,
                fmt::format("{}: has not ended; every angle needs its shape: submit again, or repeat "
                            "ripstop stability without --only",
                            axis_folder().string()));
  take_speed();
  const SteadyResult steady = steady_result_from_json(finished_result(axis_folder()).value());
  const Settings shape_of = settings_of_run(axis_folder());
  shape_ = final_state(axis_folder());
  canopy_ = rigid_canopy(shape_of, shape_.shape);
  const Reference reference = stability_reference(cases_.front());
  result_.title = axis_.title();
  result_.speed = steady.speed, result_.density = reference.density;
  result_.reference_area = reference.area, result_.reference_length = reference.diameter;
  result_.projected_diameter = canopy_.width;
  result_.cells_across = settings_.across;
  result_.cells = flow_at(0).grid.cells();
  if (!settings_.elsewhere)
    require_memory(flow_memory(result_.cells),
                   fmt::format("an angle of attack on {:.3g} cells (--cells-across {})",
                               double(result_.cells), settings_.across));
}

Watch Curve::window(std::size_t i) const {
  const WatchKeys& keys = cases_[i].flow().watch;
  return {keys.courant, keys.standard_error, keys.shortest, keys.longest,
          inflated_diameter(cases_[i].parachute())};
}

/// The flow as the angle before left it, turned to this angle.
std::optional<SteadyState> Curve::start_from_neighbour(std::size_t i, Flow& flow) const {
  if (!starts_from_neighbour(i)) return std::nullopt;
  const fs::path neighbour = run_settings(i - 1).folder / "checkpoint";
  auto loaded = load_checkpoint(neighbour, flow);
  if (!loaded || !loaded->damage.empty())
    throw Error(ExitCode::bad_data, fmt::format("{}: {}; this angle starts from it: compute that one again",
                                                neighbour.string(), loaded ? loaded->damage : "is lost"));
  const auto stream = [&](std::size_t k) { return flow_problem(cases_[k]).air.velocity; };
  turn_stream(flow, stream(i - 1), stream(i), turning_diameters * window(i).length, window(i).courant);
  return std::move(loaded->state);
}

StabilityRow Curve::rigid_in_time(std::size_t i, ClaimedFolder& folder, FlowEngine& engine,
                                  StabilityObserver& observer) {
  const FlowProblem problem = flow_at(i);
  const auto flow = engine.start(problem);
  WindowCheckpoint checkpoint(folder, settings_.checkpoint_every_s);
  FlowRecord record;
  if (auto earlier = checkpoint.resume(*flow))
    record = std::move(*earlier);
  else
    start_from_neighbour(i, *flow);
  const auto report = [&](const WatchProgress& p) {
    observer.progress(i, watch_text(p, problem.air), p.share);
    return true;
  };
  watch_forces(*flow, problem, window(i), record, report, [&] { checkpoint.look(*flow, record); });
  checkpoint.remove();
  write_angle_history(folder, record);
  save_checkpoint(folder.own("checkpoint/"), {}, *flow);
  return row_of_record(record, problem, angles_[i], stability_reference(cases_[i]));
}

StabilityRow Curve::equilibrium_in_time(std::size_t i, ClaimedFolder& folder, FlowEngine& engine,
                                        StabilityObserver& observer) {
  const Settings& resolved = cases_[i];
  const FlowProblem flow = flow_at(i);
  SteadyProblem problem{restrained_mesh(settings_of_run(axis_folder()), shape_), flow,
                        nominal_area(resolved.parachute()), resolved.coupling(), window(i)};
  problem.settings.threads = threads(i);
  SteadySolver solver(std::move(problem), engine);
  SteadyState state = solver.start();
  state.shape = shape_.shape, state.pressure = shape_.pressure;
  // Between its windows the state is complete.
  const fs::path between = folder.path() / "between";
  if (auto earlier = load_checkpoint(between, solver.flow())) {
    state = std::move(earlier->state);
  } else {
    if (const auto neighbour = start_from_neighbour(i, solver.flow()))
      state.shape = neighbour->shape, state.pressure = neighbour->pressure,
      state.residual_traction = neighbour->residual_traction;
    begin_windows(state, resolved.coupling());
  }
  while (!solver.finished(state)) {
    solver.iterate(state, [&](const SteadyProgress& p) {
      observer.progress(i,
                        p.stage == SteadyStage::time
                            ? fmt::format("[{}] {}", p.iteration, watch_text(p.time, flow.air))
                            : fmt::format("[{}] cloth {:.1e}", p.iteration, p.cloth.residual),
                        (p.iteration - 1 + p.time.share) / usual_windows);
    });
    if (!solver.finished(state)) save_checkpoint(folder.own("between/"), state, solver.flow());
  }
  remove_path(between);
  write_angle_history(folder, solver.record());
  write_stl(folder.own("canopy.stl"), surface_of(solver.cells(), state.shape));
  save_checkpoint(folder.own("checkpoint/"), state, solver.flow());
  StabilityRow row = row_of_record(solver.record(), flow, angles_[i], stability_reference(resolved));
  row.enough = row.enough && state.converged;
  return row;
}

StabilityRow Curve::at_rest(std::size_t i, FlowEngine& engine, StabilityObserver& observer) {
  FlowProblem problem = flow_at(i);
  Stopping& stopping = problem.stopping;
  stopping.average_every = Stopping::piece, stopping.average_over = pieces_of_mean * Stopping::piece;
  stopping.max_iterations += stopping.average_over;
  const FlowField field = solve(engine, problem, [&](const FlowProgress& p) {
    observer.progress(
        i,
        fmt::format("iteration {}, residual {:.1e}, drag {:.2f} N", p.iteration, largest_residual(p), p.drag),
        double(p.iteration) / stopping.max_iterations);
    return true;
  });
  return row_of_field(field, problem, angles_[i], stability_reference(cases_[i]));
}

StabilityRow Curve::run_angle(std::size_t i, StabilityObserver& observer) {
  const RunSettings run = run_settings(i);
  const Settings& resolved = cases_[i];
  const auto claimed = open_run_folder(run, resolved, inputs(i), ThreadTeam(threads(i)).size());
  if (!claimed->warning().empty()) observer.warned(claimed->warning());
  if (const auto finished = claimed->finished()) {
    const auto row = from_json_text<StabilityRow>(*finished, row_text);
    observer.ended(i, row, true);
    return row;
  }
  const EngineRecord& record = engine_of(resolved);
  EngineOptions options = engine_options(resolved);
  options.threads = threads(i);
  options.small_eddies = resolved.flow().watch.eddies;
  if (record.needs_folder) options.folder = claimed->own("flow/");
  const auto engine = record.make(options);
  StabilityRow row;
  try {
    row = !in_time()              ? at_rest(i, *engine, observer)
          : settings_.equilibrium ? equilibrium_in_time(i, *claimed, *engine, observer)
                                  : rigid_in_time(i, *claimed, *engine, observer);
  } catch (const Error& error) {
    throw Error(error.code(),
                fmt::format("at an angle of attack of {:g} degrees: {}", angles_[i], message_of(error)));
  }
  if (const std::string failure = claimed->end_with(json_text(row)); !failure.empty())
    observer.warned(failure);
  observer.ended(i, row, false);
  return row;
}

void Curve::take_results() {
  take_trims(result_);
  Judgement judgement = judge({{"cells_across", double(result_.cells_across)}});
  judgement.add(air_warnings(cases_.front()));
  judgement.add(body_warnings(cases_.front(), flow_at(0).grid, in_time(), "increase --cells-across"));
  for (const StabilityRow& row : result_.rows) {
    if (!row.mass_defect) continue;
    const Judgement of_row = judge({{"mass_defect", *row.mass_defect}});
    for (const std::string& text : of_row.warnings)
      judgement.warnings.push_back(fmt::format("{:g} degrees: {}", row.angle, text));
    judgement.usable = judgement.usable && of_row.usable;
  }
  const RunEnd axis = end_of_run(axis_folder());
  result_.usable = judgement.usable && axis.usable;
  result_.warnings.insert(result_.warnings.end(), judgement.warnings.begin(), judgement.warnings.end());
  add_warnings_of(axis, result_.warnings);
}

StabilityResult Curve::run(StabilityObserver& observer) {
  check();
  const auto folder = open();
  if (!folder->warning().empty()) observer.warned(folder->warning());
  run_axis(observer.axis());
  take_shape();
  observer.begin(result_, engine_name());
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    result_.rows.push_back(run_angle(i, observer));
    take_results();
    write(*folder);
    if (i > 0) drop_flow(i - 1);  // no other angle starts from it
  }
  end(*folder, observer);
  return result_;
}

std::vector<std::vector<std::string>> Curve::waves() const {
  std::vector<std::vector<std::string>> waves;
  if (settings_.steady.empty()) waves.push_back({axis_name});
  for (std::size_t i = 0; i < angles_.size(); ++i) {
    if (i == 0 || starts_from_neighbour(i)) waves.emplace_back();
    waves.back().push_back(angle_name(angles_[i]));
  }
  return waves;
}

void Curve::run_part(const std::string& name, StabilityObserver& observer) {
  if (!fs::exists(settings_.run.folder / description))
    throw Error(ExitCode::usage, fmt::format("{}: contains no curve yet: write it there with --batch first",
                                             settings_.run.folder.string()));
  if (name == axis_name && settings_.steady.empty()) return run_axis(observer.axis());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < angles_.size(); ++i) {
    names.push_back(angle_name(angles_[i]));
    if (names.back() != name) continue;
    take_shape();
    if (starts_from_neighbour(i) && !is_sealed(run_settings(i - 1).folder))
      throw Error(ExitCode::io,
                  fmt::format("{}: was not begun: {}, which it starts from, has not ended; submit "
                              "again, or repeat ripstop stability without --only",
                              name, names[i - 1]));
    observer.begin(result_, engine_name());
    run_angle(i, observer);
    return;
  }
  throw Error(ExitCode::usage, fmt::format("--only {}: is no part of this curve; give {} or {}", name,
                                           axis_name, fmt::join(names, ", ")));
}

StabilityResult Curve::gather(std::vector<std::string>& missing, StabilityObserver& observer) {
  check();
  const auto folder = open();
  take_shape();
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    const RunSettings run = run_settings(i);
    const auto text = holds_run(run, cases_[i], inputs(i)) ? finished_result(run.folder) : std::nullopt;
    if (text)
      result_.rows.push_back(from_json_text<StabilityRow>(*text, row_text));
    else
      missing.push_back(angle_name(angles_[i]));
  }
  take_results();
  write(*folder);
  for (std::size_t i = 0; missing.empty() && i + 1 < cases_.size(); ++i) drop_flow(i);
  if (missing.empty()) end(*folder, observer);
  return result_;
}

}  // namespace

std::string angle_name(double angle) {
  return "angle=" + csv_number(angle);
}

void check_stability(const Case& given, const std::vector<double>& angles,
                     const StabilitySettings& settings) {
  Curve(given, angles, settings).check();
}

StabilityResult run_stability(const Case& given, const std::vector<double>& angles,
                              const StabilitySettings& settings, StabilityObserver& observer) {
  return Curve(given, angles, settings).run(observer);
}

std::vector<std::vector<std::string>> stability_waves(const Case& given, const std::vector<double>& angles,
                                                      const StabilitySettings& settings) {
  return Curve(given, angles, settings).waves();
}

void prepare_stability(const Case& given, const std::vector<double>& angles,
                       const StabilitySettings& settings) {
  Curve(given, angles, settings).prepare();
}

void run_stability_part(const Case& given, const std::vector<double>& angles,
                        const StabilitySettings& settings, const std::string& name,
                        StabilityObserver& observer) {
  Curve(given, angles, settings).run_part(name, observer);
}

StabilityResult gather_stability(const Case& given, const std::vector<double>& angles,
                                 const StabilitySettings& settings, std::vector<std::string>& missing,
                                 StabilityObserver& observer) {
  return Curve(given, angles, settings).gather(missing, observer);
}

}  // namespace ripstop::inline run

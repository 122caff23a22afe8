#include "ripstop/run/stability/stability_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "ripstop/case/assemble.h"
#include "ripstop/case/quantity_keys.h"
#include "ripstop/core/build_info.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/thread_team.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/engine.h"
#include "ripstop/run/json.h"
#include "ripstop/run/stability/stability_files.h"
#include "ripstop/run/steady/steady_folder.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

constexpr const char* description = "stability.json";
constexpr const char* axis_name = "axis";

/// The stream turns from one angle to the next while it passes one inflated diameter.
constexpr double turning_diameters = 1;

void check_folder(const fs::path& folder) {
  if (!fs::exists(folder / description) && !foreign_files(folder).empty())
    throw Error(
        ExitCode::usage,
        fmt::format("{}: is not empty and holds no curve of ripstop stability (no {}); choose another --out",
                    folder.string(), description));
  require_unclaimed(folder);
}

/// One curve in its folder.
class Curve {
 public:
  Curve(const Case& given, const std::vector<double>& angles, const StabilitySettings& settings)
      : settings_(settings), angles_(angles), cases_(stability_cases(given, angles)) {
    Case on_axis = given;
    on_axis.flow.angle_of_attack_deg = 0;
    axis_.push_back(resolve(on_axis));
  }

  void check() const {
    check_folder(settings_.run.folder);
    if (settings_.steady.empty())
      check_steady_in(axis_settings(), axis());
    else
      drag_for_opening(settings_.steady, axis());
    for (std::size_t i = 0; i < cases_.size(); ++i) holds_run(run_settings(i), cases_[i], inputs(i));
  }

  StabilityResult run(StabilityObserver& observer);

 private:
  const Settings& axis() const { return axis_.front(); }
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
  std::string engine_name() const { return engine_of(axis()).name(engine_options(axis())); }
  bool in_time() const { return engine_of(axis()).can.time; }
  bool starts_from_neighbour(std::size_t i) const { return settings_.warm && in_time() && i > 0; }

  /// What a row depends on beside its case: the shape, the cells, and the angles that its flow has been at.
  std::string inputs(std::size_t i) const {
    const std::string shape = settings_.steady.empty() ? inputs_hash(axis(), engine_name())
                                                       : inputs_of_run(settings_.steady).value_or("");
    std::string text = fmt::format("{}\nstability\nshape {}\n{} cells across\nwidest {}\n", engine_name(),
                                   shape, settings_.across, csv_number(angles_.back()));
    for (std::size_t k = 0; k < i && starts_from_neighbour(i); ++k)
      text += "after " + csv_number(angles_[k]) + "\n";
    return text;
  }

  Freestream air_at(std::size_t i) const { return flow_problem(cases_[i]).air; }

  std::unique_ptr<ClaimedFolder> open() const;
  void take_shape(StabilityObserver& observer);
  StabilityRow run_angle(std::size_t i, StabilityObserver& observer);
  StabilityRow compute_in_time(std::size_t i, ClaimedFolder& folder, FlowEngine& engine,
                               StabilityObserver& observer);
  void write(ClaimedFolder& folder) const { write_stability_files(folder, result_); }

  const StabilitySettings& settings_;
  std::vector<double> angles_;
  std::vector<Settings> cases_, axis_;
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

void Curve::take_shape(StabilityObserver& observer) {
  SteadyResult steady;
  Settings of_shape = axis();
  if (settings_.steady.empty()) {
    steady = run_steady_in(axis_settings(), axis(), observer.axis()).result;
    if (!steady.converged)
      throw Error(
          ExitCode::not_converged,
          fmt::format("{}: the steady run on the axis has not converged; raise coupling.max_iterations or "
                      "loosen its tolerances",
                      axis_folder().string()));
    drop_flow_checkpoint(axis_folder());
  } else {
    drag_for_opening(settings_.steady, axis());
    of_shape = settings_of_run(settings_.steady);
    steady = steady_result_from_json(finished_result(settings_.steady).value());
  }
  canopy_ = rigid_canopy(of_shape, final_state(axis_folder()).shape);
  // A case with a payload has the speed that the steady run found.
  for (Settings& one : cases_)
    if (one.payload().mass_kg) one = at_speed(one, steady.speed);
  const Reference reference = stability_reference(cases_.front());
  result_.title = axis().title();
  result_.speed = steady.speed, result_.density = reference.density;
  result_.reference_area = reference.area, result_.reference_length = reference.diameter;
  result_.projected_diameter = canopy_.width;
  result_.cells_across = settings_.across;
  result_.cells = stability_flow(cases_.front(), canopy_, settings_.across, angles_.back()).grid.cells();
}

StabilityRow Curve::compute_in_time(std::size_t i, ClaimedFolder& folder, FlowEngine& engine,
                                    StabilityObserver& observer) {
  const FlowProblem problem = stability_flow(cases_[i], canopy_, settings_.across, angles_.back());
  const WatchKeys& keys = cases_[i].flow().watch;
  const double length = inflated_diameter(cases_[i].parachute());
  FlowProblem start = problem;
  if (starts_from_neighbour(i)) start.air = air_at(0);
  const auto flow = engine.start(start);
  if (starts_from_neighbour(i)) {
    flow->restore(run_settings(i - 1).folder / "checkpoint");
    turn_stream(*flow, air_at(i - 1).velocity, problem.air.velocity, turning_diameters * length,
                keys.courant);
  }
  FlowRecord record;
  const StabilityRow row = watch_angle(
      *flow, problem, angles_[i], {keys.courant, keys.standard_error, keys.shortest, keys.longest, length},
      stability_reference(cases_[i]), record, [&](const WatchProgress& p) {
        const double drag = dot(p.step.force, problem.air.direction());
        observer.progress(i,
                          p.mean != 0 ? fmt::format("drag {:.2f} N, mean {:.2f} +- {:.2g} N", drag, p.mean,
                                                    p.standard_error)
                                      : fmt::format("drag {:.2f} N, start-up", drag),
                          p.share);
        return true;
      });
  write_angle_history(folder, record);
  make_folder(folder.own("checkpoint/"));
  flow->save(folder.path() / "checkpoint");
  return row;
}

StabilityRow Curve::run_angle(std::size_t i, StabilityObserver& observer) {
  const RunSettings run = run_settings(i);
  const Settings& resolved = cases_[i];
  const int threads = settings_.threads > 0 ? settings_.threads : resolved.coupling().threads;
  const auto claimed = open_run_folder(run, resolved, inputs(i), ThreadTeam(threads).size());
  if (!claimed->warning().empty()) observer.warned(claimed->warning());
  if (const auto finished = finished_result(run.folder)) {
    const auto row = from_json_text<StabilityRow>(*finished, "the result of an angle of attack");
    observer.ended(i, row, true);
    return row;
  }
  const EngineRecord& record = engine_of(resolved);
  EngineOptions options = engine_options(resolved);
  options.threads = threads;
  options.small_eddies = resolved.flow().watch.eddies;
  if (record.needs_folder) options.folder = claimed->own("flow/");
  const auto engine = record.make(options);
  StabilityRow row;
  if (in_time()) {
    row = compute_in_time(i, *claimed, *engine, observer);
  } else {
    const FlowProblem problem = stability_flow(resolved, canopy_, settings_.across, angles_.back());
    const auto flow = engine->start(problem);
    row = settle_angle(*flow, problem, angles_[i], stability_reference(resolved), [&](const FlowProgress& p) {
      observer.progress(i,
                        fmt::format("iteration {}, residual {:.1e}, drag {:.2f} N", p.iteration,
                                    largest_residual(p), p.drag),
                        double(p.iteration) / problem.stopping.max_iterations);
      return true;
    });
  }
  write_file(claimed->own("result.json"), json_text(row));
  claimed->seal();
  observer.ended(i, row, false);
  return row;
}

StabilityResult Curve::run(StabilityObserver& observer) {
  check();
  const auto folder = open();
  if (!folder->warning().empty()) observer.warned(folder->warning());
  take_shape(observer);
  observer.begin(result_, engine_name());
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    try {
      result_.rows.push_back(run_angle(i, observer));
    } catch (const Error& error) {
      throw Error(error.code(),
                  fmt::format("at an angle of attack of {:g} degrees: {}", angles_[i], message_of(error)));
    }
    take_trims(result_);
    write(*folder);
    // The next angle may start from the last flow only.
    if (i > 0 && !settings_.run.fields) remove_path(run_settings(i - 1).folder / "checkpoint");
  }
  folder->seal();
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

}  // namespace ripstop

#include "ripstop/run/sweep/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>

#include "ripstop/case/cost.h"
#include "ripstop/case/quantity_keys.h"
#include "ripstop/case/settings.h"
#include "ripstop/core/build_info.h"
#include "ripstop/core/file.h"
#include "ripstop/core/shell.h"
#include "ripstop/core/thread_team.h"
#include "ripstop/run/engine.h"
#include "ripstop/run/steady/steady_folder.h"
#include "ripstop/run/used_run.h"

namespace ripstop::inline run {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double most_runs = 10'000;

/// "speed_m_s=20_gamma=0.2"; the last part of a key's name is enough for people.
std::string folder_name(const std::vector<SweepAxis>& axes, const std::vector<std::size_t>& at) {
  std::string name;
  for (std::size_t d = 0; d < axes.size(); ++d) {
    const std::string key = axes[d].name.substr(axes[d].name.rfind('.') + 1);
    name += fmt::format("{}{}={}", d ? "_" : "", plain_name(key), plain_name(axes[d].values[at[d]]));
  }
  return axes.empty() ? "run" : name;
}

RunSettings run_settings(const SweepPoint& point, const SweepSettings& settings) {
  return {settings.folder / point.folder, settings.fresh, settings.fields, false};
}

/// Files that are made anew from the runs whenever a sweep is continued.
std::vector<std::string> sweep_files() {
  std::vector<std::string> names = {"sweep.json", "sweep.csv", "result.json", "profile.csv"};
  for (const char* plot : {"drag", "drag_area", "drag_coefficient", "diameters", "iterations", "wall_time",
                           "profile", "porosity"})
    for (const char* ending : {".svg", ".png"}) names.push_back(std::string(plot) + ending);
  return names;
}

void check_sweep_folder(const fs::path& folder) {
  check_series_folder(folder, "sweep.json", "sweep of Ripstop");
}

/// Claims the folder.
std::unique_ptr<ClaimedFolder> open_sweep_folder(const std::vector<SweepPoint>& points,
                                                 const SweepSettings& settings) {
  const fs::path& folder = settings.folder;
  const fs::path description = folder / "sweep.json";
  auto claimed = std::make_unique<ClaimedFolder>(folder);
  claimed->unseal();
  for (const std::string& name : sweep_files()) claimed->own(name);
  nlohmann::ordered_json j;
  j["program"] = "ripstop";
  j["version"] = version();
  j["processor"] = processor();
  j["runs"] = json::array();
  for (const SweepPoint& point : points) {
    j["runs"].push_back(
        {{"folder", point.folder},
         {"values", point.values},
         {"starts_from", point.start < 0 || !settings.warm ? json() : json(points[point.start].folder)}});
  }
  write_file(description, j.dump(2) + "\n");
  return claimed;
}

/// The work of a sweep and its distribution.
class Board {
 public:
  Board(const std::vector<SweepPoint>& points, const SweepSettings& settings, const SweepEvents& events,
        int jobs)
      : points_(points),
        settings_(settings),
        events_(events),
        jobs_(jobs),
        rows_(points.size()),
        stage_(points.size(), Stage::waiting) {}

  void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      const int next = ready();
      if (next == none_left) return;
      if (next == none_ready) {
        changed_.wait(lock);
        continue;
      }
      stage_[next] = Stage::running;
      // A run that nobody else can join, the first above all, has every core for itself.
      const auto running = static_cast<int>(std::count(stage_.begin(), stage_.end(), Stage::running));
      const int threads = std::max(1, cores_ / (ready() < 0 ? running : jobs_));
      lock.unlock();
      SweepRow row = run(static_cast<std::size_t>(next), threads);
      lock.lock();
      rows_[next] = std::move(row);
      stage_[next] = Stage::ended;
      try {
        drop_what_nobody_needs();
      } catch (const Error& error) {  // the run itself is whole: the same command tries only this again
        rows_[next] = failed(message_of(error), error.code());
      }
      if (events_.ended) events_.ended(static_cast<std::size_t>(next), rows_);
      changed_.notify_all();
    }
  }
  std::vector<SweepRow> rows() && { return std::move(rows_); }

 private:
  enum class Stage { waiting, running, ended };
  static constexpr int none_left = -1, none_ready = -2;

  int ready() const {
    int answer = none_left;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (stage_[i] != Stage::waiting) continue;
      answer = none_ready;
      const int start = start_of(i);
      if (start < 0 || stage_[start] == Stage::ended) return static_cast<int>(i);
    }
    return answer;
  }

  // A run that starts cold instead of from its neighbour has different last digits. A neighbour that failed for the
  // disk, for damage, or for another process in its folder can succeed when the command is repeated, so this run
  // waits for that; one that diverged always fails.
  SweepRow run(std::size_t i, int threads) {
    const int start = start_of(i);
    if (start >= 0 && rows_[start].waits) {
      return failed(
          fmt::format("was not started, because {}, from which it starts, failed; repeat the command",
                      points_[start].folder),
          ExitCode::io);
    }
    try {
      if (!settings_.folder.empty()) require_unclaimed(settings_.folder / points_[i].folder);
    } catch (const Error& error) {
      SweepRow row = failed(message_of(error), error.code());
      row.waits = true;
      return row;
    }
    try {
      return settings_.folder.empty() ? run_in_memory(i, threads) : run_in_folder(i, threads);
    } catch (const Error& error) {
      return failed(message_of(error), error.code());
    } catch (const std::system_error& error) {
      return failed(error.what(), ExitCode::io);
    } catch (const std::exception& error) {
      return failed(error.what(), ExitCode::external);
    }
  }

  SweepRow run_in_folder(std::size_t i, int threads) {
    SteadyFolderSettings run{run_settings(points_[i], settings_), threads, {}, {}, false};
    if (const int start = start_of(i); start >= 0) {
      const fs::path neighbour = settings_.folder / points_[start].folder;
      if (fs::exists(neighbour / "result.json")) run.warm_from = neighbour;
    }
    Follower follower(*this, i);
    return {true, "", ExitCode::done, false, run_steady_in(run, points_[i].resolved, follower).result, {}};
  }

  SweepRow run_in_memory(std::size_t i, int threads) {
    Follower follower(*this, i);
    SteadySolution solution = run_steady(points_[i].resolved, follower, {threads, {}, {}});
    return {true, "", ExitCode::done, false, std::move(solution.result), std::move(solution.state)};
  }

  /// Reports one run to the listener of the sweep; starts it from its neighbour in memory.
  class Follower : public SteadyObserver {
   public:
    Follower(Board& board, std::size_t point) : board_(board), point_(point) {}
    void begin(const SteadyRun& run, SteadyState& state) override {
      const int start = board_.start_of(point_);
      if (!board_.settings_.folder.empty() || start < 0 || !board_.rows_[start].done) return;
      start_from(board_.points_[start].resolved, board_.rows_[start].state, run, state);
    }
    void progress(const SteadyProgress& progress, const SteadyState& state) override {
      if (!board_.events_.progress) return;
      const std::lock_guard lock(board_.mutex_);
      board_.events_.progress(point_, progress, state);
    }

   private:
    Board& board_;
    std::size_t point_;
  };

  int start_of(std::size_t i) const { return settings_.warm ? points_[i].start : -1; }

  static SweepRow failed(const std::string& why, ExitCode code) {
    SweepRow row;
    row.error = why;
    row.code = code;
    row.waits = code == ExitCode::io || code == ExitCode::bad_data;
    return row;
  }

  // A flow field of a printed grid has 130 MB: it is removed as soon as no other run starts from it. A failed run
  // resumes from its own field, also if only the seal is missing.
  void drop_what_nobody_needs() const {
    if (settings_.folder.empty()) return;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      bool needed = settings_.fields || stage_[i] != Stage::ended || !rows_[i].done;
      for (std::size_t k = 0; k < points_.size() && !needed; ++k)  // one that failed may be tried again
        needed = settings_.warm && points_[k].start == static_cast<int>(i) && !rows_[k].done;
      if (!needed) drop_flow_checkpoint(settings_.folder / points_[i].folder);
    }
  }

  const std::vector<SweepPoint>& points_;
  const SweepSettings& settings_;
  const SweepEvents& events_;
  int jobs_, cores_ = ThreadTeam().size();
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<SweepRow> rows_;
  std::vector<Stage> stage_;
};

}  // namespace

SweepAxis sweep_axis(const std::string& key, const std::vector<std::string>& values,
                     const std::string& option) {
  SweepAxis axis{key, values, {}};
  for (const std::string& value : values) axis.settings.push_back({{key, value, option}});
  return axis;
}

std::vector<SweepPoint> sweep_points(const fs::path& case_file, const Overrides& overrides,
                                     const std::vector<SweepAxis>& axes) {
  return sweep_points([&](const Overrides& all) { return read_case(case_file, all); }, overrides, axes);
}

std::vector<SweepPoint> sweep_points(const CaseReader& read, const Overrides& overrides,
                                     const std::vector<SweepAxis>& axes) {
  for (const SweepAxis& axis : axes) {
    for (std::size_t i = 0; i < axis.values.size(); ++i) {
      if (std::find(axis.values.begin(), axis.values.begin() + i, axis.values[i]) != axis.values.begin() + i)
        throw Error(ExitCode::usage, fmt::format("{}: the value {} occurs twice", axis.name, axis.values[i]));
    }
  }
  double runs = 1;
  for (const SweepAxis& axis : axes) runs *= double(axis.values.size());
  if (runs > most_runs)
    throw Error(ExitCode::usage, fmt::format("{:.0f} runs (every combination of the values); a sweep has at "
                                             "most {:.0f} runs: use fewer values",
                                             runs, most_runs));
  std::vector<SweepPoint> points;
  std::map<std::vector<std::size_t>, int> index;
  std::map<std::string, int> names;
  std::vector<std::size_t> at(axes.size(), 0);
  while (true) {
    Overrides all = overrides;
    std::vector<std::string> values;
    for (std::size_t d = 0; d < axes.size(); ++d) {
      values.push_back(axes[d].values[at[d]]);
      const std::vector<Setting>& settings = axes[d].settings[at[d]];
      all.set.insert(all.set.end(), settings.begin(), settings.end());
    }
    SweepPoint point{std::move(values), resolve(read(all)), folder_name(axes, at)};
    if (const int twins = names[point.folder]++) point.folder += fmt::format("_{}", twins + 1);
    index[at] = static_cast<int>(points.size());
    points.push_back(std::move(point));
    std::size_t d = axes.size();
    while (d > 0 && ++at[d - 1] == axes[d - 1].values.size()) at[--d] = 0;
    if (d == 0) break;
  }
  for (const auto& [place, i] : index) {
    for (std::size_t d = axes.size(); d-- > 0;) {
      const std::size_t middle = (axes[d].values.size() - 1) / 2;
      if (place[d] == middle) continue;
      std::vector<std::size_t> neighbour = place;
      neighbour[d] = place[d] < middle ? place[d] + 1 : place[d] - 1;
      points[i].start = index.at(neighbour);
      break;
    }
  }
  return points;
}

void check_sweep(const std::vector<SweepPoint>& points, const SweepSettings& settings) {
  check_sweep_folder(settings.folder);
  for (const SweepPoint& point : points)
    check_steady_in({run_settings(point, settings), 0, {}, {}, settings.elsewhere}, point.resolved);
}

void seal_sweep(const fs::path& folder) {
  ClaimedFolder(folder).seal();
}

int fitting_jobs(const std::vector<SweepPoint>& points) {
  const int cores = ThreadTeam().size();
  double bytes = 0;
  int ranks = 1;
  for (const SweepPoint& point : points) {
    bytes = std::max(bytes, cost_of(point.resolved).memory);
    if (engine_of(point.resolved).can.ranks) ranks = std::max(ranks, point.resolved.flow().ranks);
  }
  const int by_memory = static_cast<int>(std::min(1e6, 0.8 * free_memory() / bytes));
  return std::max(1, std::min({cores / ranks, by_memory, static_cast<int>(points.size())}));
}

std::vector<SweepRow> run_sweep(const std::vector<SweepPoint>& points, const SweepSettings& settings,
                                const SweepEvents& events) {
  std::unique_ptr<ClaimedFolder> claimed;  // until the last run has ended
  if (!settings.folder.empty()) {
    check_sweep(points, settings);  // before anything of an earlier sweep is touched
    claimed = open_sweep_folder(points, settings);
  }
  const int jobs = std::clamp(settings.jobs > 0 ? settings.jobs : fitting_jobs(points), 1,
                              std::max(1, static_cast<int>(points.size())));
  Board board(points, settings, events, jobs);
  std::vector<std::thread> workers;
  try {
    for (int i = 1; i < jobs; ++i) workers.emplace_back([&] { board.work(); });
  } catch (const std::system_error&) {
    // Those that could be started, and this one, do the work.
  }
  board.work();
  for (std::thread& worker : workers) worker.join();
  return std::move(board).rows();
}

std::vector<std::vector<std::size_t>> sweep_waves(const std::vector<SweepPoint>& points, bool warm) {
  std::vector<std::vector<std::size_t>> waves;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::size_t wave = 0;
    if (warm)
      for (int start = points[i].start; start >= 0; start = points[start].start) ++wave;
    if (wave >= waves.size()) waves.resize(wave + 1);
    waves[wave].push_back(i);
  }
  return waves;
}

void prepare_sweep(const std::vector<SweepPoint>& points, const SweepSettings& settings) {
  check_sweep(points, settings);
  open_sweep_folder(points, settings);
}

SteadyResult run_sweep_point(const std::vector<SweepPoint>& points, const SweepSettings& settings,
                             std::size_t point, SteadyObserver& observer) {
  if (!fs::exists(settings.folder / "sweep.json"))
    throw Error(ExitCode::usage, fmt::format("{}: contains no sweep yet: write it with --batch first",
                                             settings.folder.string()));
  SteadyFolderSettings run{run_settings(points[point], settings), 0, {}, {}, false};
  const int start = settings.warm ? points[point].start : -1;
  if (start >= 0 && !is_sealed(run.run.folder)) {
    run.warm_from = settings.folder / points[start].folder;
    if (!is_sealed(run.warm_from))  // from nothing it would have other last digits
      throw Error(ExitCode::io, fmt::format("{}: was not started, because {}, from which it starts, is not "
                                            "finished; submit again, or resume with ripstop sweep",
                                            points[point].folder, points[start].folder));
  }
  return run_steady_in(run, points[point].resolved, observer).result;
}

std::vector<SweepRow> gather_sweep(const std::vector<SweepPoint>& points, const SweepSettings& settings) {
  check_sweep_folder(settings.folder);
  const auto claimed = open_sweep_folder(points, settings);
  std::vector<SweepRow> rows(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const RunSettings run = run_settings(points[i], settings);
    const Settings& resolved = points[i].resolved;
    SweepRow& row = rows[i];
    row.waits = true;
    row.code = ExitCode::io;
    row.error = "is not finished: submit again, or resume with ripstop sweep";
    try {
      if (!holds_run(run, resolved, engine_of(resolved).name(engine_options(resolved)))) continue;
      if (const auto text = finished_result(run.folder))
        row = {true, "", ExitCode::done, false, steady_result_from_json(*text), {}};
    } catch (const Error& error) {
      row.code = error.code();
      row.error = message_of(error);
    }
  }
  const bool all = std::all_of(rows.begin(), rows.end(), [](const SweepRow& row) { return row.done; });
  if (all && !settings.fields)
    for (const SweepPoint& point : points) drop_flow_checkpoint(settings.folder / point.folder);
  return rows;
}

std::vector<std::string> sweep_warnings(const std::vector<SweepPoint>& points,
                                        const std::vector<SweepRow>& rows) {
  std::vector<RunEnd> ends;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (rows[i].done) ends.push_back(end_of_run(to_json(rows[i].result), points[i].folder));
  return grouped_warnings(ends);
}

}  // namespace ripstop::inline run

#include "ripstop/run/report/progress.h"

#include <algorithm>
#include <array>
#include <string>
#include <system_error>

#include "ripstop/core/error.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/report/report_flight.h"
#include "ripstop/run/report/report_plots.h"
#include "ripstop/run/report/shape_files.h"

namespace ripstop::inline run {
namespace {

namespace fs = std::filesystem;

/// The table that each kind of run extends.
constexpr std::array<std::pair<const char*, const char*>, 4> growing_tables = {
    {{"path.csv", "flight"},
     {"balance.csv", "opening"},
     {"iterations.csv", "steady"},
     {"trajectory.csv", "trajectory"}}};

struct RunningPart {
  fs::path folder;
  std::string kind;
  fs::file_time_type written;
};

std::optional<RunningPart> running_part(const fs::path& folder) {
  for (const auto& [table, kind] : growing_tables) {
    std::error_code error;
    const fs::file_time_type written = fs::last_write_time(folder / table, error);
    if (!error) return RunningPart{folder, kind, written};
  }
  return {};
}

/// Of `ripstop load` and `ripstop recovery`.
std::vector<ReportPlot> trajectory_plots(const fs::path& folder) {
  const CsvTable table = read_csv(folder / "trajectory.csv");
  std::vector<ReportPlot> plots;
  const auto add = [&](const char* id, const char* title, const char* unit, const char* column) {
    ReportPlot plot{id, title, {"time", "s"}, {title, unit}, {}, false, false};
    plot.series.push_back(thinned({title, table.column("time_s"), table.column(column)}));
    plots.push_back(std::move(plot));
  };
  add("load", "load on the riser", "N", "force_n");
  add("speed", "speed", "m/s", "speed_m_s");
  add("height", "height above the ground", "m", "height_m");
  return plots;
}

std::vector<ReportPlot> plots_of_part(const RunningPart& part) {
  if (part.kind == "flight") return flight_plots(part.folder);
  if (part.kind == "trajectory") return trajectory_plots(part.folder);
  ReportRun run;
  run.kind = part.kind;
  return plots_of(run, part.folder);
}

}  // namespace

RunProgress progress_in(const fs::path& folder) {
  RunProgress progress;
  std::optional<RunningPart> newest = running_part(folder);
  std::error_code error;
  if (!newest)
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
      if (entry.symlink_status(error).type() != fs::file_type::directory) continue;
      const std::optional<RunningPart> part = running_part(entry.path());
      if (part && (!newest || part->written > newest->written)) newest = part;
    }
  if (!newest) return progress;
  try {
    progress.plots = plots_of_part(*newest);
    const std::vector<ShapeFiles> shapes = shape_files(newest->folder);
    if (!shapes.empty()) progress.shape = shapes.back();
  } catch (const Error&) {
    progress.plots.clear();
  } catch (const fs::filesystem_error&) {
    progress.shape.reset();
  }
  return progress;
}

}  // namespace ripstop::inline run

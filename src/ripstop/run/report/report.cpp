#include "ripstop/run/report/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/words.h"
#include "ripstop/run/report/report_flight.h"
#include "ripstop/run/report/report_plots.h"
#include "ripstop/run/report/report_tables.h"
#include "ripstop/run/report/shape_files.h"
#include "ripstop/run/run_folder.h"
#include "ripstop/run/steady/steady_folder.h"
#include "ripstop/run/steady/warnings.h"

namespace ripstop::inline run {
namespace {

namespace fs = std::filesystem;

void add_shape(ReportRun& run, const fs::path& folder) {
  const bool opening = run.kind == "opening";
  std::vector<ShapeFiles> files = opening ? thinned_out(opening_shapes(folder)) : shape_files(folder);
  if (files.empty()) return;
  if (!opening) files = {files.back()};
  run.shape = read_shape(files);
}

void add_flow(ReportRun& run, const fs::path& folder) {
  if (run.shape.frames.empty()) return;
  constexpr double far = std::numeric_limits<double>::infinity();
  Vec3 low{far, far, far}, high{-far, -far, -far};
  const std::vector<double>& points = run.shape.frames.back().points;
  for (int quad : run.shape.quads) {
    const Vec3 p{points[3 * quad], points[3 * quad + 1], points[3 * quad + 2]};
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  for (const char* name : {"flow.vti", "flow.vtr"})
    if (fs::exists(folder / name)) run.flow = read_flow(folder / name, low, high);
}

std::string name_of(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename();
}

bool is_sweep(const fs::path& folder) {
  return fs::exists(folder / "sweep.json") && fs::exists(folder / "result.json");
}

/// Refuses to replace a file that is not a report.
void check_out(const fs::path& out) {
  if (fs::exists(out) && !(fs::is_regular_file(out) && is_report(read_file(out))))
    throw Error(ExitCode::usage,
                fmt::format("{}: exists and is not a report of Ripstop; choose another --out", out.string()));
}

/// The page into a sealed folder, all of whose other files are as they were when it was sealed.
fs::path write_into(const fs::path& folder, const std::string& page) {
  require_whole(folder, report_name);
  ClaimedFolder claimed(folder);
  write_file(claimed.own(report_name), page);
  claimed.seal();
  return folder / report_name;
}

}  // namespace

ReportRun report_of(const fs::path& folder) {
  const fs::path result = folder / "result.json";
  if (!fs::exists(result) || !fs::exists(folder / "run.json"))
    throw Error(
        ExitCode::usage,
        fmt::format("{}: {}", folder.string(),
                    fs::exists(folder) ? "contains no finished run of ripstop steady, inflate, fly or sweep"
                                       : "the folder does not exist"));
  ReportRun run;
  run.name = name_of(folder);
  add_result(run, read_file(result), result);
  run.kind = number_of(run, "peak_load_n") == number_of(run, "peak_load_n") ? "opening" : "steady";
  run.headline = headline_of(run.kind);
  const Settings resolved = settings_of_run(folder);
  run.case_file = read_file(folder / "case.toml");
  run.tables.push_back(bill_table(resolved));
  if (const ReportTable sources = sources_table(resolved, folder / "run.json"); !sources.rows.empty())
    run.tables.push_back(sources);
  if (run.warnings.empty()) run.warnings = warnings_of(resolved, number_of(run, "max_cloth_strain"));
  add_unusable(run);
  if (!run.converged) run.warnings.insert(run.warnings.begin(), "The coupling did not converge.");
  add_provenance(run, folder / "run.json");
  if (is_flight(run)) {
    add_flight(run, resolved, folder);
    return run;
  }
  run.plots = plots_of(run, folder);
  add_shape(run, folder);
  if (!run.shape.frames.empty()) run.shape.part_names = steady_mesh(resolved).parts;
  add_flow(run, folder);
  return run;
}

std::vector<ReportRun> reports_of(const fs::path& folder) {
  refuse_without_records(folder);
  if (is_sealed(folder)) require_whole(folder, report_name);
  std::vector<ReportRun> runs;
  if (!is_sweep(folder)) runs.push_back(report_of(folder));
  if (!is_sealed(folder))
    throw Error(ExitCode::usage,
                fmt::format("{}: is not finished; wait for it, or repeat its command", folder.string()));
  if (!is_sweep(folder)) return runs;
  const auto sweep = nlohmann::ordered_json::parse(read_file(folder / "result.json"), nullptr, false);
  if (sweep.is_object() && sweep.contains("runs")) {
    for (const auto& row : sweep["runs"]) {
      if (!row.contains("result")) continue;
      runs.push_back(reports_of(folder / row.value("folder", "")).front());
      std::string name;
      for (const auto& [key, value] : row["values"].items())
        name += (name.empty() ? "" : ", ") + in_words(key, value.template get<std::string>());
      if (!name.empty()) runs.back().name = name;
    }
  }
  if (runs.empty())
    throw Error(ExitCode::usage, fmt::format("{}: no run of this sweep has a result", folder.string()));
  return runs;
}

Report report_on(std::vector<ReportRun> runs, const std::string& title) {
  Report report;
  report.title = title;
  if (runs.size() > 1) {
    report.comparison = comparison_table(runs);
    report.plots = comparison_plots(runs, resolve(parse_case(runs.front().case_file, "case.toml")));
  }
  report.runs = std::move(runs);
  return report;
}

std::string write_run_report(ClaimedFolder& folder) {
  try {
    ReportRun run = report_of(folder.path());
    const std::string title = run.title;
    write_file(folder.own(report_name), report_page(report_on({std::move(run)}, title)));
    return {};
  } catch (const std::exception& error) {
    const auto* known = dynamic_cast<const Error*>(&error);
    if (known && known->code() == ExitCode::io) throw;  // the same command will write it once there is room
    return fmt::format("no report was written: {}", error.what());
  }
}

fs::path write_report(const std::vector<fs::path>& folders, const fs::path& out) {
  if (folders.empty()) throw Error(ExitCode::usage, "no run for the report");
  const bool own = out.empty() && folders.size() == 1;
  const fs::path target = own ? folders.front() / report_name : out.empty() ? fs::path(report_name) : out;
  check_out(target);
  std::vector<ReportRun> runs;
  for (const fs::path& folder : folders)
    for (ReportRun& run : reports_of(folder)) runs.push_back(std::move(run));
  std::string title = runs.front().title;
  if (std::any_of(runs.begin(), runs.end(), [&](const ReportRun& run) { return run.title != title; }))
    title = fmt::format("{} runs", runs.size());
  const std::string page = report_page(report_on(std::move(runs), title));
  if (own && is_sealed(folders.front())) return write_into(folders.front(), page);
  write_file(target, page);
  return target;
}

}  // namespace ripstop::inline run

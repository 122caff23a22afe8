#include "ripstop/run/run_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "ripstop/case/resolve.h"
#include "ripstop/case/settings.h"
#include "ripstop/core/build_info.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/run/report/report.h"

namespace ripstop::inline run {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

std::string now_utc() {
  const std::time_t t = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&t, &utc);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday,
                     utc.tm_hour, utc.tm_min, utc.tm_sec);
}

/// Where the values come from that the case need not give.
ordered_json sources_of(const Settings& resolved) {
  ordered_json list = ordered_json::array();
  for (const Source& source : resolved.sources())
    list.push_back(
        {{"key", source.key}, {"unit", source.unit}, {"given", source.given}, {"from", source.from}});
  return list;
}

constexpr const char* inputs = "inputs";    // the note with the inputs of the run
constexpr const char* started = "started";  // and of when it was begun

/// The version of Ripstop that wrote run.json; empty: there is none that can be read.
std::string version_in(const fs::path& folder) {
  if (!fs::is_regular_file(folder / "run.json")) return {};
  const ordered_json run = ordered_json::parse(read_file(folder / "run.json"), nullptr, false);
  const auto found = run.is_object() ? run.find("version") : run.end();
  return found != run.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// A start that was refused, failed or was killed before anything was computed is in nobody's way.
bool has_got_anywhere(const fs::path& folder) {
  return is_sealed(folder) || fs::exists(folder / "checkpoint");
}

}  // namespace

fs::path default_run_folder(const fs::path& case_file, const std::string& what) {
  fs::path name = case_file.stem();
  if (name == "case") name = fs::absolute(case_file).lexically_normal().parent_path().filename();
  return fs::path("runs") / ((name.empty() ? "case" : name.string()) + (what.empty() ? "" : "-" + what));
}

bool holds_run(const RunSettings& settings, const Settings& resolved, const std::string& solver) {
  const fs::path& folder = settings.folder;
  const std::optional<std::string> earlier = noted(folder, inputs);
  if (!earlier) {
    refuse_without_records(folder);
    const std::vector<std::string> foreign = foreign_files(folder);
    if (foreign.empty()) return false;
    throw Error(
        ExitCode::usage,
        fmt::format(
            "{}: is not empty ({}) and contains no run of this version of Ripstop; choose another --out",
            folder.string(), foreign.front()));
  }
  if (settings.fresh) return false;
  if (*earlier == inputs_hash(resolved, solver)) return true;
  if (!has_got_anywhere(folder)) return false;
  if (const std::string other = version_in(folder); !other.empty() && other != version())
    throw Error(ExitCode::usage,
                fmt::format("{}: contains a run of Ripstop {}, which version {} does not continue; choose "
                            "another --out, or replace it with --fresh",
                            folder.string(), other, version()));
  throw Error(ExitCode::usage,
              fmt::format("{}: contains a run with different inputs (case, speed, grid, ranks, program or "
                          "flow engine); choose another --out, or replace it with --fresh",
                          folder.string()));
}

void refuse_without_records(const fs::path& folder) {
  constexpr const char* records = ".ripstop";  // of ClaimedFolder
  const std::string written_by = version_in(folder);
  if (written_by.empty() || fs::exists(folder / records)) return;
  throw Error(
      ExitCode::usage,
      fmt::format("{}: is a run of Ripstop {} without the records of its files ({}) that version {} "
                  "needs; copy the folder with them, or compute its case.toml again with another --out",
                  folder.string(), written_by, records, version()));
}

// The path of an iteration is independent of the limit.
bool continues_run(const RunSettings& settings, const Settings& resolved, const std::string& solver) {
  const fs::path& folder = settings.folder;
  if (settings.fresh || !is_sealed(folder) || !fs::exists(folder / "checkpoint")) return false;
  require_whole(folder);
  const ordered_json result = ordered_json::parse(read_file(folder / "result.json"), nullptr, false);
  if (!result.is_object() || !result.contains("coupling_iterations") || result.value("converged", true))
    return false;
  Case given = resolved.written();
  const int before = read_case(folder / "case.toml").coupling.max_iterations;
  if (before >= given.coupling.max_iterations) return false;
  given.coupling.max_iterations = before;
  return noted(folder, inputs) == inputs_hash(resolve(given), solver);
}

std::optional<std::string> RunFolder::finished() const {
  return finished_result(path());
}

std::string RunFolder::end_with(const std::string& result_json) {
  write("result.json", result_json);
  const std::string failure = settings_.report ? write_run_report(*this) : std::string();
  seal();
  return failure;
}

std::unique_ptr<RunFolder> open_run_folder(const RunSettings& settings, const Settings& resolved,
                                           const std::string& solver, int threads) {
  if (!continues_run(settings, resolved, solver))
    holds_run(settings, resolved, solver);  // a refused run leaves no trace
  auto folder = std::make_unique<RunFolder>(settings);
  const bool continues = continues_run(settings, resolved, solver);
  const bool goes_on = continues || holds_run(settings, resolved, solver);
  if (continues) folder->unseal();
  if (goes_on && is_sealed(settings.folder)) return folder;
  if (!goes_on) folder->clear();
  const std::string begun = noted(settings.folder, started).value_or(now_utc());
  ordered_json run;
  run["program"] = "ripstop";
  run["version"] = version();
  run["compiler"] = compiler();
  run["processor"] = processor();
  run["threads"] = threads;
  run["ranks"] = resolved.flow().ranks;
  run["flow_engine"] = solver;
  run["started"] = begun;
  run["case_file"] = resolved.file().string();
  run["inputs_hash"] = inputs_hash(resolved, solver);
  run["case"] = ordered_json::parse(case_json(resolved));
  run["sources"] = sources_of(resolved);
  folder->note(started, begun);
  folder->note(inputs, inputs_hash(resolved, solver));
  folder->write("run.json", run.dump(2) + "\n");
  folder->write("case.toml", case_toml(resolved));
  return folder;
}

void check_series_folder(const fs::path& folder, const std::string& description, const std::string& what) {
  if (!fs::exists(folder / description) && !foreign_files(folder).empty())
    throw Error(ExitCode::usage,
                fmt::format("{}: is not empty and contains no {} (no {}); choose another --out",
                            folder.string(), what, description));
  require_unclaimed(folder);
}

std::string inputs_hash(const Settings& resolved, const std::string& what) {
  return hash_bytes(fmt::format("{}\n{}\n{}", version(), what, case_json(resolved)));
}

std::optional<std::string> inputs_of_run(const fs::path& folder) {
  return noted(folder, inputs);
}

void require_whole(const fs::path& folder, const std::string& except) {
  std::vector<std::string> damaged = damaged_files(folder);
  std::erase(damaged, except);
  if (damaged.empty()) return;
  throw Error(ExitCode::bad_data, fmt::format("{}: {} missing or changed after the end of the run; restore "
                                              "the files, or compute the run again with --fresh",
                                              folder.string(), fmt::join(damaged, ", ")));
}

void refuse_lost(const ClaimedFolder& folder) {
  if (const std::vector<std::string> lost = folder.lost(); !lost.empty())
    throw Error(ExitCode::bad_data,
                fmt::format("{}: {} missing or changed after the checkpoint; start again with --fresh",
                            folder.path().string(), fmt::join(lost, ", ")));
}

std::optional<std::string> finished_result(const fs::path& folder) {
  refuse_without_records(folder);
  if (!is_sealed(folder)) return std::nullopt;
  require_whole(folder);
  const std::string text = read_file(folder / "result.json");
  const ordered_json result = ordered_json::parse(text, nullptr, false);
  const auto of = result.is_object() ? result.find("inputs_hash") : result.end();
  if (!result.is_object() || (of != result.end() && *of != ordered_json(inputs_of_run(folder).value_or(""))))
    throw Error(ExitCode::bad_data, fmt::format("{}: result.json does not belong to the inputs of this "
                                                "folder; compute the run again with --fresh",
                                                folder.string()));
  return text;
}

void refuse_unfinished(const std::filesystem::path& folder, const char* command) {
  // The folder of something else is no place for the run.
  const bool free = !std::filesystem::exists(folder) || std::filesystem::is_empty(folder);
  throw Error(
      ExitCode::usage,
      fmt::format("{}: contains no finished run of ripstop {}; {}compute one with: ripstop {} CASE --out {}",
                  folder.string(), command, free ? "" : "give the folder of one, or ", command,
                  free ? folder.string() : "runs/NAME"));
}

}  // namespace ripstop::inline run

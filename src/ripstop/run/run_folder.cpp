#include "ripstop/run/run_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "ripstop/core/build_info.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"

namespace ripstop {
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

ordered_json read_json(const fs::path& file) {
  try {
    return ordered_json::parse(read_file(file));
  } catch (const nlohmann::json::exception& error) {
    throw Error(ExitCode::bad_data,
                fmt::format("{}: damaged ({}); start again with --fresh", file.string(), error.what()));
  }
}

constexpr const char* description = "run.json";

std::string inputs_hash(const Case& given, const std::string& solver) {
  return hash_bytes(fmt::format("{}\n{}\n{}", version(), solver, case_json(given)));
}

/// A start that was killed while it wrote run.json, the first file of a run.
bool holds_leftovers_only(const fs::path& folder) {
  const fs::directory_iterator entries(folder);
  return std::all_of(begin(entries), end(entries), [](const fs::directory_entry& entry) {
    const std::string name = entry.path().filename();
    return name.starts_with(".run.json.") && name.ends_with(".tmp");
  });
}

}  // namespace

bool holds_run(const RunSettings& settings, const Case& given, const std::string& solver) {
  const fs::path& folder = settings.folder;
  if (!fs::exists(folder) || fs::is_empty(folder)) return false;
  if (!fs::exists(folder / description)) {
    if (holds_leftovers_only(folder)) return false;
    throw Error(ExitCode::usage,
                fmt::format("{}: is not empty and holds no run of Ripstop (no run.json); choose "
                            "another --out",
                            folder.string()));
  }
  if (settings.fresh) return false;
  if (read_json(folder / description).value("inputs_hash", "") != inputs_hash(given, solver)) {
    throw Error(ExitCode::usage,
                fmt::format("{}: holds a run of other inputs (case, speed, grid, ranks, program or "
                            "flow engine differ); choose another --out, or --fresh to replace it",
                            folder.string()));
  }
  return true;
}

void open_run_folder(const RunSettings& settings, const Case& given, const std::string& solver, int threads) {
  const fs::path& folder = settings.folder;
  const auto write_case = [&] { write_file(folder / "case.toml", case_toml(given)); };
  if (holds_run(settings, given, solver)) {
    if (!fs::exists(folder / "case.toml")) write_case();  // killed before it was there
    return;
  }
  make_folder(folder);
  for (const auto& entry : fs::directory_iterator(folder)) fs::remove_all(entry.path());
  ordered_json run;
  run["program"] = "ripstop";
  run["version"] = version();
  run["compiler"] = compiler();
  run["processor"] = processor();
  run["threads"] = threads;
  run["ranks"] = given.flow.ranks;
  run["flow_engine"] = solver;
  run["started"] = now_utc();
  run["case_file"] = given.file.string();
  run["inputs_hash"] = inputs_hash(given, solver);
  run["case"] = ordered_json::parse(case_json(given));
  write_file(folder / description, run.dump(2) + "\n");
  write_case();
}

std::optional<std::string> finished_result(const fs::path& folder) {
  if (!fs::exists(folder / "result.json")) return std::nullopt;
  read_json(folder / "result.json");
  return read_file(folder / "result.json");
}

}  // namespace ripstop

#include "ripstop/studio/actions.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "ripstop/case/case.h"
#include "ripstop/case/settings.h"
#include "ripstop/core/build_info.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/core/process.h"
#include "ripstop/core/reasons.h"
#include "ripstop/core/toml/document.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/core/toml/read.h"
#include "ripstop/core/toml/set.h"
#include "ripstop/studio/case_edit.h"

namespace ripstop::inline studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Times until the page shows a shape that is not in equilibrium yet, and the next one [s].
constexpr double first_answer = 0.4, later_answer = 1.5;

std::string text_of(const Json& j) {
  return j.dump(-1, ' ', true, Json::error_handler_t::replace);
}

/// A JSON value as TOML; both write texts, numbers and lists alike.
std::string literal_of(const std::string& key, const Json& value) {
  if (value.is_object() || value.is_null())
    throw Error(ExitCode::usage, fmt::format("{} needs a number, a text or a list", key));
  return value.dump();
}

/// The report of `check --json`; of a file that it cannot read at all, a problem without a place.
Json check_report(int code, const std::string& output) {
  Json report = Json::parse(output, nullptr, false);
  if (report.is_object()) return report;
  return {{"valid", false},
          {"problems",
           {{{"line", 0},
             {"key", ""},
             {"message", output.empty() ? fmt::format("exit code {}", code) : output}}}}};
}

}  // namespace

Json parsed(const std::string& text) {
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    throw Error(ExitCode::usage, fmt::format("not JSON: {}", json_reason(error)));
  }
}

void require_name(const std::string& name) {
  if (!is_name(name))
    throw Error(ExitCode::usage,
                fmt::format("{} is not a name: letters, digits, '.', '_' and '-', at most 64", quoted(name)));
}

std::string error_json(const std::string& message) {
  return text_of({{"error", message}});
}

Actions::Actions(const fs::path& folder, std::string program)
    : folder_(fs::canonical(folder)), program_(std::move(program)), queue_(folder_, program_) {}

void Actions::require_inside(const fs::path& path) const {
  const auto [end, rest] = std::mismatch(folder_.begin(), folder_.end(), fs::weakly_canonical(path).begin());
  if (end != folder_.end())
    throw Error(ExitCode::usage, fmt::format("{} leads out of the folder", path.string()));
}

Actions::Call Actions::call(std::vector<std::string> arguments,
                            const std::function<bool()>& keep_going) const {
  Call result;
  ProcessRequest request;
  request.arguments = std::move(arguments);
  request.arguments.insert(request.arguments.begin(), program_);
  request.working_folder = folder_;
  request.time_limit_s = 120;
  request.on_line = [&](const std::string& line) {
    result.output += line + "\n";
    return true;
  };
  request.keep_going = keep_going;
  const ProcessResult done = run_process(request);
  result.code = done.cancelled || done.timed_out ? -1 : done.exit_code;
  return result;
}

void Actions::must(std::vector<std::string> arguments) const {
  const Call done = call(std::move(arguments));
  if (done.code == 0) return;
  std::string message = done.output;
  if (const std::size_t at = message.rfind("ripstop: "); at != std::string::npos)
    message = message.substr(at + 9);
  while (message.ends_with('\n')) message.pop_back();
  throw Error(ExitCode::usage, message);
}

fs::path Actions::case_path(const std::string& file) const {
  require_name(file);
  const fs::path path = folder_ / file;
  if (path.extension() != ".toml" || !fs::is_regular_file(fs::symlink_status(path)))
    throw Error(ExitCode::usage, fmt::format("{} is not a case file of this folder", file));
  return path;
}

fs::path Actions::new_case_path(const std::string& file) const {
  require_name(file);
  const fs::path path = folder_ / file;
  if (path.extension() != ".toml")
    throw Error(ExitCode::usage, fmt::format("{}: the name of a case file ends in .toml", file));
  if (fs::exists(fs::symlink_status(path)))
    throw Error(ExitCode::usage, fmt::format("{} exists already", file));
  return path;
}

fs::path Actions::run_path(const std::string& run) const {
  require_name(run);
  const fs::path path = folder_ / "runs" / run;
  if (!fs::is_directory(fs::symlink_status(path)))
    throw Error(ExitCode::usage, fmt::format("there is no run {}", run));
  require_inside(path);
  return path;
}

std::string Actions::folder() {
  Json cases = Json::array(), runs = Json::array(), families = Json::array();
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
    if (entry.path().extension() == ".toml" && entry.symlink_status().type() == fs::file_type::regular &&
        is_name(entry.path().filename()))
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& path : files) {
    std::string version;
    if (fs::file_size(path) <= 1 << 20) version = hash_file(path);
    cases.push_back({{"file", path.filename()}, {"version", version}});
  }
  if (fs::is_directory(folder_ / "runs"))
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / "runs"))
      if (entry.symlink_status().type() == fs::file_type::directory && is_name(entry.path().filename()))
        runs.push_back({{"name", entry.path().filename()},
                        {"sealed", is_sealed(entry.path())},
                        {"report", fs::is_regular_file(entry.path() / "report.html")}});
  for (const fs::directory_entry& entry : fs::directory_iterator(data_directory() / "examples"))
    if (fs::exists(entry.path() / "case.toml")) families.push_back(entry.path().filename());
  std::sort(families.begin(), families.end());
  std::sort(runs.begin(), runs.end(),
            [](const Json& a, const Json& b) { return a.at("name") < b.at("name"); });
  return text_of({{"folder", folder_.string()},
                  {"version", version()},
                  {"cases", cases},
                  {"runs", runs},
                  {"families", families}});
}

std::string Actions::read(const std::string& file) {
  const std::string text = read_text_file(case_path(file));
  Json written = Json::object();
  try {
    for (const auto& [key, literal] : written_values(text)) written[key] = literal;
  } catch (const InputError&) {
    written = nullptr;  // the check reports it
  }
  const Call check = call({"check", file, "--json"});
  return text_of({{"file", file},
                  {"version", hash_bytes(text)},
                  {"text", text},
                  {"written", written},
                  {"check", check_report(check.code, check.output)}});
}

std::string Actions::replace(const std::string& file, const std::string& version, const std::string& text) {
  {
    const std::lock_guard lock(writing_);
    const fs::path path = case_path(file);
    if (hash_file(path) != version)
      throw Conflict(fmt::format("{} has changed since the page read it", file));
    if (text.size() > 1 << 20) throw Error(ExitCode::usage, "a case file has at most 1 MiB");
    write_file(path, text);
  }
  return read(file);
}

std::string Actions::change(const std::string& file, const std::string& version, const std::string& changes) {
  std::string text = read_text_file(case_path(file));
  const Json keys = parsed(changes);
  for (const auto& [key, value] : keys.items())
    text = value.is_null() ? without_key(text, key) : with_key(text, key, literal_of(key, value));
  return replace(file, version, text);
}

std::string Actions::write(const std::string& file, const std::string& version, const std::string& text) {
  return replace(file, version, text);
}

std::string Actions::create(const std::string& file, const std::string& family) {
  require_name(family);
  const fs::path example = data_directory() / "examples" / family;
  if (!fs::is_regular_file(example / "case.toml"))
    throw Error(ExitCode::usage, fmt::format("there is no family {}", family));
  std::string text = read_file(example / "case.toml");
  // Its path is relative to the example.
  if (text.starts_with("#:schema ")) text.erase(0, text.find('\n') + 1);
  write_file(new_case_path(file), text);
  return read(file);
}

std::string Actions::copy(const std::string& file, const std::string& from) {
  const std::string text = read_text_file(case_path(from));
  write_file(new_case_path(file), text);
  return read(file);
}

std::string Actions::size(const std::string& file, const std::string& family, const std::string& mass,
                          const std::string& rate, const std::string& speed, const std::string& height) {
  new_case_path(file);
  must({"size", "--mass=" + mass, "--descent-rate=" + rate, "--deployment-speed=" + speed,
        "--height=" + height, "--family=" + family, "--out=" + file});
  return read(file);
}

std::string Actions::shape(const std::string& view, const std::string& file, const std::string& pressure,
                           int nodes) {
  require_name(view);
  const fs::path path = case_path(file);
  std::optional<double> given;
  if (!pressure.empty()) {
    const Json number = Json::parse(pressure, nullptr, false);
    if (!number.is_number())
      throw Error(ExitCode::usage, fmt::format("the pressure {} is not a number", quoted(pressure)));
    given = number.get<double>();
  }
  std::vector<Settings> stages = {resolve(read_case(path))};
  if (stages.front().parachute().mesh.cloth_nodes > nodes) {
    Overrides fewer;
    fewer.set.push_back(parse_setting(fmt::format("parachute.mesh.cloth_nodes={}", nodes), "nodes"));
    stages.insert(stages.begin(), resolve(read_case(path, fewer)));
  }
  const std::shared_ptr<LiveShape> shape = shapes_.of(view);
  return shape->answer(shape->begin(std::move(stages), given), first_answer);
}

std::string Actions::later_shape(const std::string& view, int number) {
  require_name(view);
  return shapes_.of(view)->answer(static_cast<unsigned>(number), later_answer);
}

std::string Actions::load(const std::string& file, const std::string& mass, const std::string& speed,
                          const std::string& drag) {
  case_path(file);
  const TemporaryFolder out("ripstop-studio");
  std::vector<std::string> arguments = {"load", file, "--mass=" + mass, "--speed=" + speed,
                                        "--out=" + (out.path / "load").string()};
  if (!drag.empty()) arguments.push_back("--drag-coefficient=" + drag);
  must(arguments);
  return read_file(out.path / "load" / "result.json");
}

std::string Actions::pattern(const std::string& file) {
  case_path(file);
  const TemporaryFolder out("ripstop-studio");
  must({"pattern", file, "--out=" + out.path.string()});
  Json pieces = Json::array();
  std::vector<fs::path> drawings;
  for (const fs::directory_entry& entry : fs::directory_iterator(out.path))
    if (entry.path().extension() == ".svg") drawings.push_back(entry.path());
  std::sort(drawings.begin(), drawings.end());
  for (const fs::path& path : drawings) pieces.push_back({{"name", path.stem()}, {"svg", read_file(path)}});
  return text_of({{"result", parsed(read_file(out.path / "result.json"))}, {"pieces", pieces}});
}

std::string Actions::export_pattern(const std::string& file) {
  const std::string name = case_path(file).stem().string() + "-pattern";
  if (fs::is_symlink(fs::symlink_status(folder_ / name)))
    throw Error(ExitCode::usage, fmt::format("{} is a link; remove it first", name));
  must({"pattern", file, "--paper=a4", "--out=" + name});
  return text_of({{"folder", (folder_ / name).string()}});
}

}  // namespace ripstop::inline studio

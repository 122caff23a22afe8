#include "ripstop/studio/actions.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "ripstop/core/build_info.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/core/process.h"
#include "ripstop/core/toml/document.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/core/toml/read.h"
#include "ripstop/report/report.h"
#include "ripstop/report/shape_view.h"
#include "ripstop/studio/case_edit.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uintmax_t largest_report = 64 << 20;  // [bytes]

std::string text_of(const Json& j) {
  return j.dump(-1, ' ', true, Json::error_handler_t::replace);
}

Json parsed(const std::string& text) {
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    throw Error(ExitCode::usage, fmt::format("not JSON: {}", error.what()));
  }
}

/// Options of a command that the page may give; their values are arguments of their own option only.
const std::set<std::string>& options_of(const std::string& command) {
  static const std::map<std::string, std::set<std::string>> all = {
      {"steady", {"--speed", "--grid", "--unsteady"}},
      {"inflate", {"--pressure", "--duration", "--cloth-nodes", "--speed", "--air"}},
      {"fly", {"--mass", "--duration", "--cloth-nodes", "--angle", "--height", "--wind", "--cells-across"}},
      {"size", {"--mass", "--descent-rate", "--family", "--height"}},
  };
  const auto found = all.find(command);
  if (found == all.end())
    throw Error(ExitCode::usage, fmt::format("{} is not a run that Studio starts", quoted(command)));
  return found->second;
}

std::vector<std::string> arguments_of(const std::string& command, const Json& options) {
  const std::set<std::string>& allowed = options_of(command);
  std::vector<std::string> arguments;
  for (const auto& [option, value] : options.items()) {
    if (!allowed.contains(option))
      throw Error(ExitCode::usage, fmt::format("{} is not an option of {} here", quoted(option), command));
    if (value.is_boolean()) {
      if (value.get<bool>()) arguments.push_back(option);
    } else {
      arguments.push_back(option + "=" + (value.is_string() ? value.get<std::string>() : value.dump()));
    }
  }
  return arguments;
}

void require_name(const std::string& name) {
  if (!is_name(name))
    throw Error(ExitCode::usage,
                fmt::format("{} is not a name: letters, digits, '.', '_' and '-', at most 64", quoted(name)));
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

std::string error_json(const std::string& message) {
  return text_of({{"error", message}});
}

Actions::Actions(const fs::path& folder, std::string program)
    : folder_(fs::canonical(folder)), program_(std::move(program)), queue_(folder_, program_) {}

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
      throw Error(ExitCode::io, fmt::format("{} has changed since the page read it", file));
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

std::string Actions::size(const std::string& file, const std::string& family, double mass, double rate,
                          double height) {
  new_case_path(file);
  must({"size", fmt::format("--mass={}", mass), fmt::format("--descent-rate={}", rate),
        fmt::format("--height={}", height), "--family=" + family, "--out=" + file});
  return read(file);
}

std::string Actions::shape(const std::string& file, const std::string& pressure, const std::string& nodes) {
  case_path(file);
  const unsigned own = ++newest_shape_;
  const TemporaryFolder out("ripstop-studio");
  const fs::path folder = out.path / "shape";
  std::vector<std::string> arguments = {"fabric", file, "--set", "parachute.mesh.cloth_nodes=" + nodes,
                                        "--out=" + folder.string()};
  if (!pressure.empty()) arguments.push_back("--pressure=" + pressure);
  const Call done = call(arguments, [&] { return newest_shape_ == own; });
  if (newest_shape_ != own) return "";
  if (done.code != 0 && done.code != static_cast<int>(ExitCode::not_converged)) {
    const std::size_t at = done.output.rfind("ripstop: ");
    throw Error(ExitCode::usage, at == std::string::npos ? done.output : done.output.substr(at + 9));
  }
  const ShapeView view = read_shape({{0, folder / "canopy.vtp", folder / "lines.vtp"}});
  return fmt::format("{{\"result\": {}, \"shape\": {}}}", read_file(folder / "result.json"),
                     shape_json(view));
}

std::string Actions::load(const std::string& file, const std::string& mass, const std::string& speed) {
  case_path(file);
  const TemporaryFolder out("ripstop-studio");
  must({"load", file, "--mass=" + mass, "--speed=" + speed, "--out=" + (out.path / "load").string()});
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

std::string Actions::jobs() const {
  Json list = Json::array();
  for (const Job& job : queue_.list()) {
    Json j = parsed(job_json(job));
    const std::vector<std::string> lines = queue_.log(job.name);
    j["last_line"] = lines.empty() ? "" : lines.back();
    const fs::path page =
        job.command == "size" ? folder_ / (job.name + ".html") : folder_ / "runs" / job.name / "report.html";
    j["report"] = fs::is_regular_file(page);
    list.push_back(j);
  }
  return text_of(list);
}

void Actions::start(const std::string& request) {
  const Json j = parsed(request);
  Job job;
  try {
    job.name = j.at("name");
    job.command = j.at("command");
    job.arguments = arguments_of(job.command, j.at("options"));
    if (job.command != "size") job.case_file = j.at("case");
  } catch (const Json::exception& error) {
    throw Error(ExitCode::usage, fmt::format("no request of a run: {}", error.what()));
  }
  require_name(job.name);
  if (job.command == "size") {
    new_case_path(job.name + ".toml");
    job.arguments.insert(job.arguments.end(), {"--verify", "--out=" + job.name + ".toml"});
    job.arguments.insert(job.arguments.begin(), "size");
  } else {
    case_path(job.case_file);
    if (fs::exists(fs::symlink_status(folder_ / "runs" / job.name)))
      throw Error(ExitCode::usage, fmt::format("there is a run {} already", job.name));
    job.arguments.insert(job.arguments.begin(), {job.command, job.case_file});
    job.arguments.push_back("--out=runs/" + job.name);
  }
  queue_.add(std::move(job));
}

std::string Actions::log(const std::string& name) const {
  require_name(name);
  return text_of({{"lines", queue_.log(name)}});
}

std::string Actions::exported(const std::string& run, const std::string& format) {
  if (format != "rocketpy" && format != "openrocket")
    throw Error(ExitCode::usage, "the format is rocketpy or openrocket");
  run_path(run);
  const TemporaryFolder out("ripstop-studio");
  const fs::path file = out.path / "export";
  must({"export", format, "runs/" + run, "--out=" + file.string()});
  return text_of({{"name", run + (format == "rocketpy" ? ".py" : ".orc")}, {"text", read_file(file)}});
}

std::string Actions::export_pattern(const std::string& file) {
  const std::string name = case_path(file).stem().string() + "-pattern";
  if (fs::is_symlink(fs::symlink_status(folder_ / name)))
    throw Error(ExitCode::usage, fmt::format("{} is a link; remove it first", name));
  must({"pattern", file, "--paper=a4", "--out=" + name});
  return text_of({{"folder", (folder_ / name).string()}});
}

std::string Actions::report(const std::string& run) const {
  require_name(run);
  fs::path path = folder_ / "runs" / run / "report.html";
  if (!fs::is_regular_file(fs::symlink_status(path))) path = folder_ / (run + ".html");
  if (!fs::is_regular_file(fs::symlink_status(path)) || fs::file_size(path) > largest_report)
    throw Error(ExitCode::usage, fmt::format("{} has no report yet", run));
  const std::string page = read_file(path);
  if (!is_report(page))
    throw Error(ExitCode::usage, fmt::format("{} is not a report of Ripstop", path.string()));
  return page;
}

}  // namespace ripstop

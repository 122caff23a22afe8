// Actions on runs: start, progress, reports and exports.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/toml/read.h"
#include "ripstop/report/report.h"
#include "ripstop/report/shape_view.h"
#include "ripstop/run/report/progress.h"
#include "ripstop/studio/actions.h"

namespace ripstop::inline studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uintmax_t largest_report = 64 << 20;  // [bytes]
constexpr std::size_t most_compared = 8;

/// Options of a command that the page may give; their values are arguments of their own option only.
const std::set<std::string>& options_of(const std::string& command) {
  static const std::map<std::string, std::set<std::string>> all = {
      {"steady", {"--speed", "--grid", "--unsteady"}},
      {"inflate", {"--pressure", "--duration", "--cloth-nodes", "--speed", "--air"}},
      {"fly", {"--mass", "--duration", "--cloth-nodes", "--angle", "--height", "--wind", "--cells-across"}},
      {"sweep", {"--speeds", "--vary", "--grid", "--jobs"}},
      {"load",
       {"--mass", "--speed", "--height", "--reef", "--drag-coefficient", "--steady", "--opening", "--from"}},
      {"stability", {"--angles", "--cells-across", "--speed", "--grid", "--steady"}},
      {"recovery",
       {"--mass", "--apogee", "--drogue", "--main-height", "--speed", "--delay", "--ground", "--wind",
        "--bay-diameter", "--steady", "--drogue-steady"}},
      {"size", {"--mass", "--descent-rate", "--family", "--height"}},
  };
  const auto found = all.find(command);
  if (found == all.end())
    throw Error(ExitCode::usage, fmt::format("{} is not a run that Studio starts", quoted(command)));
  return found->second;
}

bool names_a_run(const std::string& option) {
  return option == "--steady" || option == "--drogue-steady" || option == "--opening" || option == "--from";
}

const char* ending_of(const std::string& format) {
  static const std::map<std::string, const char*> endings = {
      {"rocketpy", ".py"}, {"openrocket", ".orc"}, {"json", ".json"}, {"report", ".html"}, {"toml", ".toml"}};
  const auto found = endings.find(format);
  if (found == endings.end())
    throw Error(ExitCode::usage, "the format is rocketpy, openrocket, json, report or toml");
  return found->second;
}

std::string dumped(const Json& j) {
  return j.dump(-1, ' ', true, Json::error_handler_t::replace);
}

}  // namespace

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
  return dumped(list);
}

std::vector<std::string> Actions::arguments_of(const std::string& command, const std::string& given) const {
  const std::set<std::string>& allowed = options_of(command);
  std::vector<std::string> arguments;
  const Json options = parsed(given);
  for (const auto& [option, value] : options.items()) {
    if (!allowed.contains(option))
      throw Error(ExitCode::usage, fmt::format("{} is not an option of {} here", quoted(option), command));
    if (value.is_boolean()) {
      if (value.get<bool>()) arguments.push_back(option);
      continue;
    }
    std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    if (names_a_run(option)) {
      run_path(text);
      text = "runs/" + text;
    }
    if (option == "--drogue") case_path(text);
    arguments.push_back(option + "=" + text);
  }
  return arguments;
}

void Actions::start(const std::string& request) {
  const Json j = parsed(request);
  Job job;
  try {
    job.name = j.at("name");
    job.command = j.at("command");
    job.arguments = arguments_of(job.command, j.at("options").dump());
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
  return dumped({{"lines", queue_.log(name)}});
}

std::string Actions::progress(const std::string& name, const std::string& known) const {
  require_name(name);
  const fs::path folder = folder_ / "runs" / name;
  if (!fs::is_directory(fs::symlink_status(folder))) return "{\"plots\": []}";
  require_inside(folder);
  const RunProgress found = progress_in(folder);
  std::string shape;
  if (found.shape) {
    const std::string id = fs::relative(found.shape->canopy, folder).string();
    if (id != known) try {
        shape = fmt::format(", \"shapeName\": {}, \"shape\": {}", Json(id).dump(),
                            shape_json(read_shape({*found.shape})));
      } catch (const Error&) {
        shape.clear();  // it has been replaced just now
      }
  }
  return fmt::format("{{\"plots\": {}{}}}", plots_json(found.plots), shape);
}

std::string Actions::exported(const std::string& run, const std::string& format) {
  const std::string name = run + ending_of(format);
  if (format == "report") return dumped({{"name", name}, {"text", report({run})}});
  const fs::path folder = run_path(run);
  if (format == "toml") {
    const fs::path file = folder / "case.toml";
    if (!fs::is_regular_file(fs::symlink_status(file)))
      throw Error(ExitCode::usage, fmt::format("{} has no case.toml", run));
    return dumped({{"name", name}, {"text", read_file(file)}});
  }
  const TemporaryFolder out("ripstop-studio");
  const fs::path file = out.path / "export";
  must({"export", format, "runs/" + run, "--out=" + file.string()});
  return dumped({{"name", name}, {"text", read_file(file)}});
}

fs::path Actions::report_path(const std::string& run) const {
  require_name(run);
  fs::path path = folder_ / "runs" / run / "report.html";
  if (!fs::is_regular_file(fs::symlink_status(path))) path = folder_ / (run + ".html");
  if (!fs::is_regular_file(fs::symlink_status(path)) || fs::file_size(path) > largest_report)
    throw Error(ExitCode::usage, fmt::format("{} has no report yet", run));
  require_inside(path);
  return path;
}

std::string Actions::report(const std::vector<std::string>& runs) const {
  if (runs.empty() || runs.size() > most_compared)
    throw Error(ExitCode::usage, fmt::format("a comparison has 2 to {} runs", most_compared));
  const TemporaryFolder out("ripstop-studio");
  fs::path path = out.path / "report.html";
  if (runs.size() == 1) {
    path = report_path(runs.front());
  } else {
    std::vector<std::string> arguments = {"report"};
    for (const std::string& run : runs) {
      run_path(run);
      arguments.push_back("runs/" + run);
    }
    arguments.push_back("--out=" + path.string());
    must(arguments);
  }
  std::string page = read_file(path);
  if (!is_report(page))
    throw Error(ExitCode::usage, fmt::format("{} is not a report of Ripstop", path.string()));
  return page;
}

}  // namespace ripstop::inline studio

#include "ripstop/flow/openfoam/programs.h"

#include <fmt/format.h>

#include <cctype>
#include <csignal>
#include <fstream>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/openfoam/case_writer.h"

namespace ripstop::inline flow::openfoam {

namespace fs = std::filesystem;

void clear_case(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    const bool time = !name.empty() && std::isdigit(static_cast<unsigned char>(name[0]));
    if (time || name == "constant" || name == "system" || name == "postProcessing" || name == kStopFile ||
        name.starts_with("log.") || name.starts_with("processor")) {
      remove_path(entry.path());
    }
  }
}

void Programs::need_space(double cells) const {
  const double need = (settings_.ranks > 1 ? 0.9e3 : 0.7e3) * cells;
  const double have = static_cast<double>(fs::space(folder_).available);
  if (have < need) {
    throw Error(ExitCode::io, fmt::format("{} has {:.1f} GB free; this case needs about {:.1f} GB",
                                          folder_.string(), have / 1e9, need / 1e9));
  }
}

ProcessRequest Programs::request_for(std::vector<std::string> arguments) const {
  ProcessRequest request;
  request.arguments = std::move(arguments);
  request.working_folder = folder_;
  request.environment = environment(installation_);
  request.time_limit_s = settings_.time_limit_s;
  return request;
}

void Programs::run_tool(const std::string& tool, const std::vector<std::string>& arguments,
                        const std::string& help, const Lines& lines) const {
  std::vector<std::string> words = {program(installation_, tool).string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  ProcessRequest request = request_for(std::move(words));
  std::ofstream log_stream(log_file(tool));
  SolverLog log(SolverLog::Forces::none);
  request.on_line = [&](const std::string& line) {
    log_stream << line << '\n';
    log.feed(line);
    if (lines) lines(line);
    return true;
  };
  const ProcessResult result = run_process(request);
  close_written(log_stream, log_file(tool));
  if (!result.succeeded()) {
    throw Error(ExitCode::external,
                fmt::format("OpenFOAM's {} failed: {}. {}{}{} (whole log: {})", tool, describe(result),
                            log.fatal(), help.empty() ? "" : " ", help, log_file(tool).string()));
  }
}

ProcessResult Programs::run_solver(const FlowReport& report, SolverLog& log, bool& stopped) const {
  std::vector<std::string> arguments;
  if (settings_.ranks > 1) {
    arguments = {program(installation_, "mpirun").string(), "-np", std::to_string(settings_.ranks)};
    if (settings_.hostfile.empty()) {
      // Ranks on logical processors are allowed; runs side by side must not be pinned to the same ones, and
      // a rank that waits must leave its processor to the one it waits for.
      arguments.insert(arguments.end(),
                       {"--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1"});
    } else {
      arguments.insert(arguments.end(), {"--hostfile", fs::absolute(settings_.hostfile).string()});
    }
    arguments.insert(arguments.end(), {"-x", "WM_PROJECT_DIR"});  // Slurm's hosts are not in a file
  }
  arguments.push_back(program(installation_, installation_.solver).string());
  if (settings_.ranks > 1) arguments.push_back("-parallel");

  ProcessRequest request = request_for(std::move(arguments));
  std::ofstream log_stream(log_file(installation_.solver));
  request.on_line = [&](const std::string& line) {
    log_stream << line << '\n';
    if (log.feed(line) && report && !stopped && !report(log.progress())) {
      stopped = true;
      std::ofstream(folder_ / kStopFile) << "stop\n";
    }
    return !log.not_a_number();
  };
  const ProcessResult result = run_process(request);
  close_written(log_stream, log_file(installation_.solver));
  fs::remove(folder_ / kStopFile);
  explain_failure(result, log);
  return result;
}

void Programs::explain_failure(const ProcessResult& result, const SolverLog& log) const {
  const std::string where = fmt::format("iteration {}, field {}", log.iteration(), log.field());
  const std::string file = log_file(installation_.solver).string();
  const int signal = result.signal != 0 ? result.signal : result.exit_code > 128 ? result.exit_code - 128 : 0;
  const bool impossible = log.fatal().find("Negative initial temperature") != std::string::npos;
  if (log.not_a_number() || log.floating_point_trap() || impossible || signal == SIGFPE) {
    throw Error(ExitCode::diverged, fmt::format("the flow diverged at {} of this solve: {}. Try a coarser "
                                                "grid, a lower resistance or a slower air speed (log: {})",
                                                where,
                                                impossible           ? "negative temperature"
                                                : log.not_a_number() ? "not a number"
                                                                     : "floating-point trap",
                                                file));
  }
  if (result.timed_out) {
    throw Error(
        ExitCode::external,
        fmt::format(
            "{} was not finished after {:.0f} s, at {}: increase the time limit or use more ranks (log: {})",
            installation_.solver, settings_.time_limit_s, where, file));
  }
  if (log.out_of_memory() || signal == SIGKILL) {
    throw Error(
        ExitCode::external,
        fmt::format("{} was stopped at {} by {}, usually for lack of memory; use a coarser grid (log: {})",
                    installation_.solver, where,
                    log.out_of_memory() ? "a failed allocation" : describe(result), file));
  }
  if (log.fatal().find("error in IOstream \"sha1\"") != std::string::npos) {
    throw Error(
        ExitCode::external,
        fmt::format("{} cannot run function objects, which every solution by Ripstop needs: versions before "
                    "2206 that were built with g++ 12 or later cannot, such as that of Debian 13. Install a "
                    "later version from www.openfoam.com, or use the built-in engine (log: {})",
                    installation_.solver, file));
  }
  if (!result.succeeded()) {
    const double free = static_cast<double>(fs::space(folder_).available);
    throw Error(ExitCode::external,
                fmt::format("{} failed at {}: {}. {}{} (whole log: {})", installation_.solver, where,
                            describe(result), log.fatal(), free < 1e8 ? " The disk is full." : "", file));
  }
}

}  // namespace ripstop::inline flow::openfoam

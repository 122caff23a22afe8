#include "batch_option.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "number_option.h"
#include "option.h"
#include "ripstop/core/error.h"
#include "ripstop/core/shell.h"
#include "ripstop/core/visible.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* own_options[] = {"--batch", "--hours", "--cores"};

/// Of this process, as it got them.
std::vector<std::string> own_arguments() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> arguments;
  for (std::string argument; std::getline(file, argument, '\0');) arguments.push_back(argument);
  if (arguments.empty()) throw Error(ExitCode::io, "cannot read /proc/self/cmdline");
  arguments.front() = fs::read_symlink("/proc/self/exe").string();  // also where PATH is another one
  return arguments;
}

}  // namespace

void add_batch_options(CLI::App& command, BatchOptions& options) {
  CLI::Option* batch =
      add_choice(command, "--batch", options.system, {"slurm"},
                 "Write job scripts for this batch system and print how to submit them; nothing is computed");
  for (const char* other : {"--fresh", "--dry-run", "--check", "--hostfile", "--json"})
    if (CLI::Option* option = command.get_option_no_throw(other)) batch->excludes(option);
  add_number(command, "--hours", options.hours, from(0.1).up_to(8760), "Time limit of a job of --batch [h]")
      ->default_str("an estimate; longer runs continue in the next job")
      ->needs(batch);
  add_number(command, "--cores", options.cores, from(1).up_to(1024),
             "Cores of a job of --batch, or of each MPI rank")
      ->default_str(fmt::format("coupling.threads, else {}; 1 per rank", usual_cores))
      ->needs(batch);
}

BatchJob batch_job(const BatchOptions& options, const fs::path& folder, BatchNeeds needs) {
  BatchJob job;
  const std::vector<std::string> all = own_arguments();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto is_own = [&](const char* name) { return all[i] == name; };
    const auto has_own = [&](const char* name) { return all[i].starts_with(std::string(name) + "="); };
    if (std::any_of(std::begin(own_options), std::end(own_options), is_own))
      ++i;  // and its value
    else if (std::none_of(std::begin(own_options), std::end(own_options), has_own))
      job.command.push_back(all[i]);
  }
  job.working_folder = fs::current_path();
  job.folder = folder;
  if (options.hours) {
    needs.hours = *options.hours;
    needs.limited = "time limit: --hours";
  }
  job.needs = std::move(needs);
  return job;
}

void write_and_tell(const fs::path& folder, const std::vector<BatchFile>& files, const std::string& command,
                    const std::string& name) {
  const fs::path scripts = write_batch(folder, files);
  for (const BatchFile& file : files) fmt::print("{}\n", visible((scripts / file.name).string()));
  const std::string path = (scripts / name).string();
  const bool plain = std::all_of(path.begin(), path.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string_view("/._-+=").find(c) != std::string::npos;
  });
  fmt::print("Submit: {} {}\n", command, visible(plain ? path : shell_quoted(path)));
}

}  // namespace ripstop::cli

// --batch: scripts for a batch system in place of the computation.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "ripstop/run/sweep/batch.h"

namespace CLI {
class App;
}

namespace ripstop::cli {

struct BatchOptions {
  std::string system;           // "slurm"; empty: compute here
  std::optional<double> hours;  // --hours
  std::optional<int> cores;     // --cores

  bool wanted() const { return !system.empty(); }
};
/// --batch, --hours, --cores. A script has none of these, nor --fresh, which would begin anew whenever its job
/// resumes, nor options that compute nothing.
void add_batch_options(CLI::App& command, BatchOptions& options);

/// The job of the command that this program was started with, less the options of --batch.
BatchJob batch_job(const BatchOptions& options, const std::filesystem::path& folder, BatchNeeds needs);
/// Writes the files and prints their place and how they are submitted: `command` and the name of one of them.
void write_and_tell(const std::filesystem::path& folder, const std::vector<BatchFile>& files,
                    const std::string& command, const std::string& name);

}  // namespace ripstop::cli

// Scripts for a batch system: one run as a job, or a sweep as job arrays.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"

namespace ripstop::inline run {

/// Requirements of a job. Time and memory are estimates.
struct BatchNeeds {
  int ranks = 1;        // processes of the flow solver
  int cores = 1;        // of each of them
  double memory = 0;    // of a node for all ranks [bytes]
  double hours = 0;     // time limit
  std::string limited;  // where the time limit comes from, for a comment
};
/// Assumed: one machine of a cluster has at least so many cores.
constexpr int usual_cores = 4;
/// Of a steady run. `cores` 0: coupling.threads, else usual_cores where there is one rank.
BatchNeeds steady_needs(const Settings& resolved, int cores = 0);
/// Of an opening.
BatchNeeds opening_needs(const Settings& resolved, int threads, int cores = 0);

struct BatchJob {
  std::vector<std::string> command;      // program and arguments, as a process gets them
  std::filesystem::path working_folder;  // where the command was given
  std::filesystem::path folder;          // of the run, or of the sweep
  BatchNeeds needs;
};
/// The runs of a sweep by their folders' names; each starts from one of an earlier wave.
struct BatchSweep {
  BatchJob job;
  std::vector<std::vector<std::string>> waves;
  int at_once = 0;  // most runs side by side; 0: as Slurm likes
};

struct BatchFile {
  std::string name, text;
};

/// Folder of the scripts and logs: next to the run folder, which contains only the run. Throws Error(usage)
/// for a path that Slurm's directives cannot contain: control characters and backslashes.
std::filesystem::path batch_folder(const std::filesystem::path& folder);

/// run.sbatch. A job that nears its time limit stops its run and is queued again to resume from its checkpoint, if
/// there was a new one since the job began. Text of the user occurs only within quotes.
std::vector<BatchFile> slurm_files(const BatchJob& job);
/// run.sbatch, an array's element; gather.sbatch, which makes tables and plots; submit, which submits both, wave
/// after wave.
std::vector<BatchFile> slurm_files(const BatchSweep& sweep);

/// Writes the files into batch_folder(folder); files there that are not Ripstop's remain. Throws as
/// ClaimedFolder does. Returns the folder.
std::filesystem::path write_batch(const std::filesystem::path& folder, const std::vector<BatchFile>& files);

}  // namespace ripstop::inline run

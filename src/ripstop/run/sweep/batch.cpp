#include "ripstop/run/sweep/batch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ripstop/case/cost.h"
#include "ripstop/case/settings.h"
#include "ripstop/core/build_info.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/shell.h"
#include "ripstop/core/visible.h"
#include "ripstop/run/engine.h"

namespace ripstop::inline run {
namespace {

namespace fs = std::filesystem;

// Assumed for a flow that converges; another one continues to its largest number of iterations.
constexpr double usual_iterations = 300, usual_couplings = 10;
constexpr double shortest_limit = 1, longest_limit = 168;  // [h]
constexpr double unknown_limit = 24;                       // [h]
constexpr int notice = 120;                                // before the time limit [s]
constexpr std::size_t most_elements = 1000;                // of an array, Slurm's MaxArraySize but one

/// In a directive, which no shell reads: within quotes Slurm interprets the backslash, and in the name of a
/// log the percent sign.
std::string in_directive(const fs::path& path) {
  std::string text;
  for (const char c : path.string()) {
    if (c == '"') text += '\\';
    if (c == '%') text += '%';
    text += c;
  }
  return text;
}

std::string job_name(const fs::path& folder) {
  const std::string name = plain_name(folder.filename().string());
  return name.empty() ? "ripstop" : name;
}

/// As the batch folder is made from it: absolute and without a slash at its end.
fs::path whole(const fs::path& folder) {
  const fs::path path = fs::absolute(folder).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

std::string header(const BatchJob& job, const std::string& what, const std::string& log) {
  const BatchNeeds& needs = job.needs;
  std::string text = "#!/bin/bash\n";
  const auto add = [&](const std::string& directive) { text += "#SBATCH " + directive + "\n"; };
  add("--job-name=" + job_name(whole(job.folder)) + what);
  add(fmt::format("--output=\"{}/{}.log\"", in_directive(batch_folder(job.folder)), log));
  add("--open-mode=append");
  if (needs.ranks == 1) add("--nodes=1");
  add(fmt::format("--ntasks={}", needs.ranks));
  add(fmt::format("--cpus-per-task={}", needs.cores));
  add(fmt::format("--mem={:.0f}M", std::ceil(1e-6 * needs.memory)));
  add(fmt::format("--time={:.0f}", std::ceil(60 * needs.hours)));
  return text;
}

std::string note(const std::string& what, const BatchNeeds& needs) {
  return fmt::format(
      "# {}; written by ripstop {}. Memory and time limit are estimates ({}); options of\n# sbatch override "
      "the lines above.\n",
      what, version(), needs.limited);
}

std::string command_of(const BatchJob& job) {
  std::string text =
      fmt::format("cd -- {} || exit 7\ncommand=(\n", shell_quoted(job.working_folder.string()));
  for (const std::string& argument : job.command) text += "  " + shell_quoted(argument) + "\n";
  return text + ")\n";
}

/// Runs `command` until it ends or the time limit is near.
std::string resumable(const std::string& checkpoint) {
  return "checkpoint=" + checkpoint + R"sh(

# Near the time limit the run is stopped, and goes on from its checkpoint when Slurm starts this job again: as long as
# there was a new checkpoint since it began, for else it would begin again for ever.
checkpoint_state() { find "$checkpoint" -maxdepth 1 -printf '%P %i %T@\n' 2> /dev/null | sort; }
near_the_limit() {
  kill -TERM "$running"
  wait "$running"
  if [ "$(checkpoint_state)" = "$began_with" ]; then
    echo "The time limit was reached before a checkpoint: increase --hours, or --time of sbatch" >&2
    exit 8
  fi
  echo "Time limit nearly reached: the job is queued again" >&2
  scontrol requeue "$SLURM_JOB_ID" && exit 0
  echo "Slurm did not queue the job again: submit the script again to resume the run" >&2
  exit 8
}
began_with=$(checkpoint_state)
"${command[@]}" &
running=$!
trap near_the_limit USR1
trap 'kill -TERM "$running"' TERM
wait "$running"
)sh";
}

std::string signals() {
  return fmt::format("#SBATCH --requeue\n#SBATCH --signal=B:USR1@{}\n", notice);
}

BatchNeeds needs_of(const Settings& resolved, int cores, const Cost& cost) {
  BatchNeeds needs;
  const EngineRecord& engine = engine_of(resolved);
  needs.ranks = engine.can.ranks ? resolved.flow().ranks : 1;
  needs.cores = cores > 0 ? cores : needs.ranks > 1 ? 1 : usual_cores;
  needs.memory =
      cost.memory + engine.takes.cell_memory * cost.solved_cells + engine.takes.rank_memory * needs.ranks;
  needs.hours = unknown_limit;
  needs.limited = "no estimate is available for this run";
  return needs;
}

}  // namespace

BatchNeeds steady_needs(const Settings& resolved, int cores) {
  const int threads = resolved.flow().ranks > 1 ? 0 : resolved.coupling().threads;
  const Cost cost = steady_cost(resolved);
  BatchNeeds needs = needs_of(resolved, cores > 0 ? cores : threads, cost);
  const FlowSettings flow = resolved.flow();
  if (flow.unsteady) return needs;
  const double iterations = usual_couplings * std::min(usual_iterations, double(flow.max_iterations));
  const double time = iterations * cost.solved_cells * engine_of(resolved).takes.cell_time;  // [core s]
  needs.hours = std::clamp(std::ceil(time / 3600 / needs.ranks / needs.cores), shortest_limit, longest_limit);
  needs.limited = fmt::format("about {:.2g} core hours, and an hour at least", time / 3600);
  return needs;
}

BatchNeeds opening_needs(const Settings& resolved, int threads, int cores) {
  BatchNeeds needs = needs_of(resolved, cores > 0 ? cores : threads, cost_of(resolved));
  needs.ranks = 1;
  return needs;
}

fs::path batch_folder(const fs::path& folder) {
  fs::path path = whole(folder);
  path += ".slurm";
  if (has_control(path.string()) || path.string().find('\\') != std::string::npos)
    throw Error(ExitCode::usage, fmt::format("{}: Slurm cannot write a log there, because the path has a "
                                             "control character or a backslash; choose another --out",
                                             path.string()));
  return path;
}

std::vector<BatchFile> slurm_files(const BatchJob& job) {
  return {{"run.sbatch", header(job, "", "%j") + signals() + note("One run", job.needs) + "\n" +
                             command_of(job) +
                             resumable(shell_quoted((whole(job.folder) / "checkpoint").string()))}};
}

std::vector<BatchFile> slurm_files(const BatchSweep& sweep) {
  const BatchJob& job = sweep.job;
  std::string run =
      header(job, "", "%A_%a") + signals() + note("One run of a sweep", job.needs) + "\nruns=(\n";
  std::string submit =
      "#!/bin/bash\n"
      "# Submits the sweep. Arguments of this script are passed to sbatch: --partition=long --account=mine\n"
      "set -e\n"
      "before=()\n"
      "# The runs from $1 on, $2 of them, once all jobs of the wave before have ended.\n"
      "array() {\n"
      "  local first=$1 count=$2\n"
      "  shift 2\n"
      "  sbatch --parsable \"${before[@]}\" --array=\"0-$((count - 1))" +
      (sweep.at_once > 0 ? fmt::format("%{}", sweep.at_once) : "") + "\" \"$@\" " +
      shell_quoted((batch_folder(job.folder) / "run.sbatch").string()) +
      " \"$first\"\n"
      "}\n"
      "after() { before=(\"--dependency=afterany$(printf ':%s' \"${@%%;*}\")\"); }\n\n";
  std::size_t first = 0;
  for (const std::vector<std::string>& wave : sweep.waves) {
    for (const std::string& name : wave) run += "  " + shell_quoted(name) + "\n";
    submit += "jobs=()\n";
    for (std::size_t done = 0; done < wave.size(); done += most_elements) {
      submit += fmt::format("jobs+=(\"$(array {} {} \"$@\")\")\n", first + done,
                            std::min(most_elements, wave.size() - done));
    }
    submit += "after \"${jobs[@]}\"\n";
    first += wave.size();
  }
  submit += "last=$(sbatch --parsable \"${before[@]}\" \"$@\" " +
            shell_quoted((batch_folder(job.folder) / "gather.sbatch").string()) +
            ")\n"
            "echo \"The table is written by job ${last%%;*}\"\n";
  run += ")\nrun=${runs[$1 + SLURM_ARRAY_TASK_ID]}\n" + command_of(job) + "command+=(\"--only=$run\")\n" +
         resumable(shell_quoted(whole(job.folder).string()) + "/\"$run\"/checkpoint");

  BatchJob gather = job;
  gather.needs.ranks = gather.needs.cores = 1;
  gather.needs.hours = shortest_limit;
  gather.needs.limited = "table and plots of the finished runs";
  return {{"run.sbatch", run},
          {"gather.sbatch", header(gather, "-table", "%j") + note("The sweep's table", gather.needs) + "\n" +
                                command_of(gather) + "\"${command[@]}\" --gather\n"},
          {"submit", submit}};
}

fs::path write_batch(const fs::path& folder, const std::vector<BatchFile>& files) {
  const fs::path scripts = batch_folder(folder);
  ClaimedFolder claimed(scripts);
  for (const BatchFile& file : files) write_file(claimed.own(file.name), file.text);
  return scripts;
}

}  // namespace ripstop::inline run

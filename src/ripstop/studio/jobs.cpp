#include "ripstop/studio/jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/process.h"
#include "ripstop/core/reasons.h"

namespace ripstop::inline studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 6> words = {"queued",        "running", "finished",
                                              "not converged", "stopped", "failed"};
constexpr std::uintmax_t longest_log = 1 << 20;  // [bytes]; older lines of a longer one are dropped
constexpr std::size_t lines_shown = 200;

JobState state_of(const std::string& word) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) throw Error(ExitCode::bad_data, fmt::format("no state of a run: {}", word));
  return static_cast<JobState>(found - words.begin());
}

std::vector<std::string> last_lines(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  if (lines.size() > lines_shown)
    lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(lines_shown));
  return lines;
}

/// runs/.studio, neither of them a link to another place.
fs::path records_in(const fs::path& folder) {
  const fs::path runs = folder / "runs", records = runs / ".studio";
  for (const fs::path& path : {runs, records})
    if (fs::is_symlink(fs::symlink_status(path)))
      throw Error(ExitCode::usage, fmt::format("{} is a link; Studio needs a folder there", path.string()));
  return records;
}

/// The last message of the program in the output of a failed run, with the problems that it lists. An example of the
/// command line is left out: Studio has a form.
std::string message_in(const std::vector<std::string>& lines) {
  const auto last = std::find_if(lines.rbegin(), lines.rend(),
                                 [](const std::string& line) { return line.starts_with("ripstop: "); });
  if (last == lines.rend()) return lines.empty() ? "" : lines.back();
  std::string message = last->substr(9);
  for (auto line = last.base(); line != lines.end(); ++line)
    if (!line->starts_with("Example: ")) message += "\n" + *line;
  return message;
}

}  // namespace

std::string job_json(const Job& job) {
  const Json j = {{"name", job.name},
                  {"command", job.command},
                  {"case", job.case_file},
                  {"arguments", job.arguments},
                  {"state", words[static_cast<std::size_t>(job.state)]},
                  {"message", job.message}};
  return j.dump(2, ' ', true, Json::error_handler_t::replace) + "\n";
}

Job job_from_json(const std::string& text) {
  try {
    const Json j = Json::parse(text);
    return {j.at("name"),      j.at("command"),         j.at("case"),
            j.at("arguments"), state_of(j.at("state")), j.at("message")};
  } catch (const Json::exception& error) {
    throw Error(ExitCode::bad_data, fmt::format("no record of a run: {}", json_reason(error)));
  }
}

JobQueue::JobQueue(fs::path folder, std::string program)
    : folder_(std::move(folder)), program_(std::move(program)), records_(records_in(folder_)) {
  std::vector<std::pair<fs::file_time_type, Job>> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(records_.path())) {
    if (entry.path().extension() != ".json" || !entry.is_regular_file()) continue;
    try {
      found.emplace_back(entry.last_write_time(), job_from_json(read_file(entry.path())));
    } catch (const Error&) {
      continue;  // damaged; its run folder is still listed
    }
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [time, job] : found) {
    if (job.state == JobState::queued || job.state == JobState::running) {
      job.state = JobState::stopped;
      job.message = "the server ended during the run";
    }
    jobs_.push_back(std::move(job));
  }
  worker_ = std::thread([this] { work(); });
}

JobQueue::~JobQueue() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  worker_.join();
}

fs::path JobQueue::record(const std::string& name, const char* ending) const {
  return records_.path() / (name + ending);
}

Job* JobQueue::find(const std::string& name) {
  const auto found =
      std::find_if(jobs_.begin(), jobs_.end(), [&](const Job& job) { return job.name == name; });
  if (found == jobs_.end()) throw Error(ExitCode::usage, fmt::format("there is no run {}", name));
  return &*found;
}

void JobQueue::write(const Job& job) const {
  write_file(record(job.name, ".json"), job_json(job));
}

void JobQueue::add(Job job) {
  const std::lock_guard lock(mutex_);
  for (const Job& other : jobs_)
    if (other.name == job.name)
      throw Error(ExitCode::usage, fmt::format("there is a run {} already", job.name));
  job.state = JobState::queued;
  write(job);
  jobs_.push_back(std::move(job));
  changed_.notify_all();
}

void JobQueue::stop(const std::string& name) {
  const std::lock_guard lock(mutex_);
  Job* job = find(name);
  if (job->state == JobState::running) stopping_ = name;
  if (job->state != JobState::queued) return;
  job->state = JobState::stopped;
  job->message = "stopped before it began";
  write(*job);
}

void JobQueue::resume(const std::string& name) {
  const std::lock_guard lock(mutex_);
  Job* job = find(name);
  if (job->state == JobState::running || job->state == JobState::queued) return;
  job->state = JobState::queued;
  job->message = "";
  write(*job);
  changed_.notify_all();
}

std::vector<Job> JobQueue::list() const {
  const std::lock_guard lock(mutex_);
  return {jobs_.begin(), jobs_.end()};
}

std::vector<std::string> JobQueue::log(const std::string& name) const {
  return last_lines(record(name, ".log"));
}

void JobQueue::work() {
  for (;;) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      const auto next = [this] {
        return std::find_if(jobs_.begin(), jobs_.end(),
                            [](const Job& one) { return one.state == JobState::queued; });
      };
      changed_.wait(lock, [&] { return closing_ || next() != jobs_.end(); });
      if (closing_) return;
      Job& begun = *next();
      begun.state = JobState::running;
      write(begun);
      job = begun;
    }
    run(job);
  }
}

void JobQueue::run(const Job& job) {
  const fs::path file = record(job.name, ".log");
  JobState state = JobState::failed;
  std::string message;
  try {
    std::error_code none;
    if (fs::exists(file) && fs::file_size(file, none) > longest_log) remove_path(file);
    std::ofstream log(file, std::ios::app);
    ProcessRequest request;
    request.arguments = job.arguments;
    request.arguments.insert(request.arguments.begin(), program_);
    request.working_folder = folder_;
    request.on_line = [&](const std::string& line) {
      log << line << std::endl;
      return true;
    };
    request.keep_going = [&] {
      const std::lock_guard lock(mutex_);
      return !closing_ && stopping_ != job.name;
    };
    const ProcessResult result = run_process(request);
    if (result.cancelled) {
      state = JobState::stopped;
    } else if (result.exit_code == 0) {
      state = JobState::finished;
    } else {
      if (result.exit_code == static_cast<int>(ExitCode::not_converged)) state = JobState::not_converged;
      message = fmt::format("{} ({})", message_in(result.last_lines), describe(result));
    }
  } catch (const std::exception& error) {
    message = error.what();
  }
  const std::lock_guard lock(mutex_);
  Job* done = find(job.name);
  done->state = state;
  done->message = message;
  if (stopping_ == job.name) stopping_.clear();
  try {
    write(*done);
  } catch (const Error& error) {  // a full disk: the state remains in memory
    done->message = error.what();
  }
}

}  // namespace ripstop::inline studio

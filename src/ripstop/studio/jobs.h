// Runs of the program that Studio has started: one at a time, each a child process with its run folder in runs/.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <list>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "ripstop/core/claimed_folder.h"

namespace ripstop::inline studio {

enum class JobState { queued, running, finished, not_converged, stopped, failed };

struct Job {
  std::string name;                    // of its run folder
  std::string command, case_file;      // "steady", "my.toml"; a sizing has no case file
  std::vector<std::string> arguments;  // of the program, with the command
  JobState state = JobState::queued;
  std::string message;  // of the end
};
std::string job_json(const Job& job);
Job job_from_json(const std::string& text);

/// Its records are NAME.json and NAME.log in runs/.studio, so that a new server continues with them: a run that an
/// ended server has left is `stopped`, and resumes from its own run folder.
class JobQueue {
 public:
  /// Throws Error(usage) if another server uses the folder, Error(io).
  JobQueue(std::filesystem::path folder, std::string program);
  /// Ends the running job; it resumes when it is continued.
  ~JobQueue();
  JobQueue(const JobQueue&) = delete;
  JobQueue& operator=(const JobQueue&) = delete;

  /// Throws Error(usage) if there is one of this name.
  void add(Job job);
  void stop(const std::string& name);
  void resume(const std::string& name);
  std::vector<Job> list() const;
  /// The last lines of its output.
  std::vector<std::string> log(const std::string& name) const;

 private:
  Job* find(const std::string& name);
  void write(const Job& job) const;
  void work();
  void run(const Job& job);
  std::filesystem::path record(const std::string& name, const char* ending) const;

  std::filesystem::path folder_;
  std::string program_;
  ClaimedFolder records_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Job> jobs_;
  std::string stopping_;  // name of the job to end
  bool closing_ = false;
  std::thread worker_;
};

}  // namespace ripstop::inline studio

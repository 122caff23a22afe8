#include "ripstop/studio/jobs.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

Job a_job(const std::string& name, std::vector<std::string> arguments) {
  Job job;
  job.name = name;
  job.command = "steady";
  job.case_file = "a.toml";
  job.arguments = std::move(arguments);
  return job;
}

/// State of a job once `wanted` or an end is reached.
JobState state_after(const JobQueue& queue, const std::string& name, JobState wanted) {
  for (int i = 0; i < 600; ++i) {
    for (const Job& job : queue.list())
      if (job.name == name && job.state == wanted) return job.state;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return queue.list().front().state;
}

TEST(JobQueue, RunsOneAfterTheOtherAndKeepsTheirOutput) {
  const TemporaryFolder folder("ripstop-jobs");
  JobQueue queue(folder.path, "/bin/sh");
  queue.add(a_job("first", {"-c", "echo one; sleep 0.2; echo two"}));
  queue.add(a_job(
      "second",
      {"-c", "echo 'ripstop: no such thing:' >&2; echo '  a thing' >&2; echo 'Example: x' >&2; exit 2"}));
  EXPECT_EQ(state_after(queue, "first", JobState::finished), JobState::finished);
  EXPECT_EQ(queue.log("first"), (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(state_after(queue, "second", JobState::failed), JobState::failed);
  EXPECT_EQ(queue.list().back().message, "no such thing:\n  a thing (exit code 2)");
  EXPECT_THROW(queue.add(a_job("first", {})), Error);
}

TEST(JobQueue, StopsARunningJobAndResumesIt) {
  const TemporaryFolder folder("ripstop-jobs");
  JobQueue queue(folder.path, "/bin/sh");
  queue.add(a_job("long", {"-c", "if [ -e begun ]; then exit 0; fi; touch begun; sleep 60"}));
  ASSERT_EQ(state_after(queue, "long", JobState::running), JobState::running);
  while (!std::filesystem::exists(folder.path / "begun"))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  queue.stop("long");
  EXPECT_EQ(state_after(queue, "long", JobState::stopped), JobState::stopped);
  queue.resume("long");
  EXPECT_EQ(state_after(queue, "long", JobState::finished), JobState::finished);
}

TEST(JobQueue, ANewServerFindsTheRunsOfAnEndedOneAndASecondIsRefused) {
  const TemporaryFolder folder("ripstop-jobs");
  {
    JobQueue queue(folder.path, "/bin/sh");
    queue.add(a_job("running", {"-c", "sleep 60"}));
    queue.add(a_job("waiting", {"-c", "exit 0"}));
    ASSERT_EQ(state_after(queue, "running", JobState::running), JobState::running);
    EXPECT_THROW(JobQueue(folder.path, "/bin/sh"), Error);
  }
  write_file(folder.path / "runs/.studio/damaged.json", "{");
  const JobQueue queue(folder.path, "/bin/sh");
  ASSERT_EQ(queue.list().size(), 2U);
  for (const Job& job : queue.list()) EXPECT_EQ(job.state, JobState::stopped) << job.name;
}

}  // namespace
}  // namespace ripstop

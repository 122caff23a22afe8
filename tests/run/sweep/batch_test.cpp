// Batch scripts run by bash, with programs of a few lines in Slurm's place.
#include "ripstop/run/sweep/batch.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <thread>

#include "ripstop/case/cost.h"
#include "ripstop/core/error.h"
#include "ripstop/core/process.h"
#include "tests/run/steady/finished_run.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

const std::string hostile = "it's $(touch harm) `touch harm` #1 %j \"; touch harm; é";

class Batch : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(root_.path / "bin"); }
  void program(const std::string& name, const std::string& body) {
    write_file(root_.path / "bin" / name, "#!/bin/bash\n" + body + "\n");
    fs::permissions(root_.path / "bin" / name, fs::perms::owner_all);
  }
  ProcessResult bash(std::vector<std::string> arguments,
                     std::vector<std::pair<std::string, std::string>> environment = {}) {
    ProcessRequest request;
    request.arguments = std::move(arguments);
    request.arguments.insert(request.arguments.begin(), "/bin/bash");
    request.working_folder = root_.path;
    request.environment = std::move(environment);
    request.environment.emplace_back("PATH", (root_.path / "bin").string() + ":/usr/bin:/bin");
    request.time_limit_s = 60;
    return run_process(request);
  }
  BatchJob job(std::vector<std::string> command) {
    BatchJob made;
    made.command = std::move(command);
    made.working_folder = root_.path / hostile;
    made.folder = root_.path / hostile / "run";
    made.needs = {2, 1, 1.5e9, 2.5, "a guess"};
    fs::create_directories(made.working_folder);
    return made;
  }
  void harmless() const {
    for (const auto& entry : fs::recursive_directory_iterator(root_.path))
      EXPECT_NE(entry.path().filename(), "harm") << entry.path();
  }
  std::string text(const fs::path& file) const { return fs::exists(file) ? read_file(file) : "none"; }

  TemporaryFolder root_{"batch"};
};

TEST_F(Batch, AJobRunsTheCommandInItsFolderWithEveryArgumentAsItWas) {
  program("words", "printf '%s\\0' \"$PWD\" \"$@\" > \"" + (root_.path / "got").string() + "\"; exit 4");
  const std::string broken = "line\nbreak'\n#SBATCH --wrap=harm\n";
  const BatchJob one = job({(root_.path / "bin/words").string(), "steady", hostile, broken, ""});
  const fs::path scripts = write_batch(one.folder, slurm_files(one));
  EXPECT_EQ(scripts, root_.path / hostile / "run.slurm");
  EXPECT_EQ(bash({(scripts / "run.sbatch").string()}).exit_code, 4);  // of the command
  std::string wanted;
  for (const std::string& word :
       {one.working_folder.string(), std::string("steady"), hostile, broken, std::string()})
    wanted += word + '\0';
  EXPECT_EQ(text(root_.path / "got"), wanted);
  harmless();
}

// sbatch reads directives up to the first line that is no comment.
TEST_F(Batch, TheDirectivesAreOursWhateverTheNamesAre) {
  const BatchJob one = job({"program", "\n#SBATCH --wrap=harm\n"});
  std::istringstream lines(slurm_files(one)[0].text);
  std::string line, directives;
  std::getline(lines, line);
  EXPECT_EQ(line, "#!/bin/bash");
  while (std::getline(lines, line) && (line.empty() || line[0] == '#'))
    if (line.starts_with("#SBATCH")) directives += line.substr(8) + "\n";
  std::string folder = (root_.path / hostile).string();
  folder.replace(folder.find("%j"), 2, "%%j");
  folder.replace(folder.find('"'), 1, "\\\"");
  EXPECT_EQ(directives,
            "--job-name=run\n--output=\"" + folder +
                "/run.slurm/%j.log\"\n--open-mode=append\n--ntasks=2\n--cpus-per-task=1\n--mem=1500M\n"
                "--time=150\n--requeue\n--signal=B:USR1@120\n");
}

TEST_F(Batch, AFolderThatNoDirectiveCanHoldIsRefused) {
  for (const char* name : {"line\nbreak", "back\\slash", "bell\x07"}) {
    try {
      batch_folder(root_.path / name);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_NE(std::string(error.what()).find("choose another --out"), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(batch_folder("/runs/x/"), "/runs/x.slurm");
}

TEST_F(Batch, OtherFilesAreNotOverwritten) {
  const BatchJob one = job({"program"});
  fs::create_directories(batch_folder(one.folder));
  write_file(batch_folder(one.folder) / "run.sbatch", "mine");
  EXPECT_THROW(write_batch(one.folder, slurm_files(one)), Error);
  EXPECT_EQ(text(batch_folder(one.folder) / "run.sbatch"), "mine");
}

class NearTheLimit : public Batch {
 protected:
  /// Exit code of a job that receives its time limit once its command, `work`, has begun.
  int told(const std::string& work) {
    program("scontrol", "echo \"$@\" >> \"" + (root_.path / "called").string() + "\"");
    const fs::path begun = root_.path / "begun", ended = root_.path / "ended";
    program("work", "mkdir -p run/checkpoint\n" + work + "\ntrap 'touch \"" + ended.string() +
                        "\"; exit 143' TERM\ntouch \"" + begun.string() + "\"\nwhile :; do sleep 0.05; done");
    const BatchJob one = job({(root_.path / "bin/work").string()});
    const fs::path scripts = write_batch(one.folder, slurm_files(one));
    std::thread limit([&] {
      while (!fs::exists(begun)) std::this_thread::sleep_for(std::chrono::milliseconds(10));
      kill(shell_of((scripts / "run.sbatch").string()), SIGUSR1);
    });
    const int code = bash({(scripts / "run.sbatch").string()}, {{"SLURM_JOB_ID", "17"}}).exit_code;
    limit.join();
    EXPECT_TRUE(fs::exists(ended)) << "the run was not stopped";
    return code;
  }
  /// The process that runs a script.
  static pid_t shell_of(const std::string& path) {
    for (const auto& entry : fs::directory_iterator("/proc")) {
      std::ifstream file(entry.path() / "cmdline", std::ios::binary);
      std::string program, argument;
      if (std::getline(file, program, '\0') && std::getline(file, argument, '\0') && program == "/bin/bash" &&
          argument == path)
        return std::stoi(entry.path().filename());
    }
    return 0;
  }
};

TEST_F(NearTheLimit, ARunWithANewCheckpointIsStoppedAndQueuedAgain) {
  EXPECT_EQ(told("touch run/checkpoint/current"), 0);
  EXPECT_EQ(text(root_.path / "called"), "requeue 17\n");
}

TEST_F(NearTheLimit, ARunWithoutOneEndsForItWouldBeginAgainForEver) {
  fs::create_directories(root_.path / hostile / "run/checkpoint");
  write_file(root_.path / hostile / "run/checkpoint/current", "of an earlier job");
  EXPECT_EQ(told(""), 8);
  EXPECT_EQ(text(root_.path / "called"), "none");
}

class BatchOfASweep : public Batch {
 protected:
  /// An sbatch that records its arguments and prints 101, 102, ... of a federation.
  void submit(const BatchSweep& sweep, const std::vector<std::string>& options) {
    program("sbatch", "log=\"" + (root_.path / "submitted").string() +
                          "\"; touch \"$log\"; printf '%s|' \"$@\" >> \"$log\"; echo >> \"$log\"; "
                          "echo \"$((100 + $(wc -l < \"$log\")));here\"");
    const fs::path scripts = write_batch(sweep.job.folder, slurm_files(sweep));
    std::vector<std::string> arguments = {(scripts / "submit").string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_TRUE(bash(arguments).succeeded());
  }
};

TEST_F(BatchOfASweep, EveryWaveWaitsForTheOneBeforeAndTheTableForTheLast) {
  const BatchSweep sweep{job({"program"}), {{"v=3"}, {"v=2", "v=4"}, {"v=1", "v=5"}}, 2};
  submit(sweep, {"--account=a b"});
  const std::string folder = batch_folder(sweep.job.folder).string();
  EXPECT_EQ(text(root_.path / "submitted"),
            "--parsable|--array=0-0%2|--account=a b|" + folder + "/run.sbatch|0|\n" +
                "--parsable|--dependency=afterany:101|--array=0-1%2|--account=a b|" + folder +
                "/run.sbatch|1|\n" + "--parsable|--dependency=afterany:102|--array=0-1%2|--account=a b|" +
                folder + "/run.sbatch|3|\n" + "--parsable|--dependency=afterany:103|--account=a b|" + folder +
                "/gather.sbatch|\n");
  harmless();
}

TEST_F(BatchOfASweep, AnArrayHasNoMoreElementsThanSlurmTakes) {
  BatchSweep sweep{job({"program"}), {{}}, 0};
  for (int i = 0; i < 2500; ++i) sweep.waves[0].push_back("v=" + std::to_string(i));
  submit(sweep, {});
  const std::string called = text(root_.path / "submitted");
  EXPECT_NE(called.find("--array=0-999|"), std::string::npos) << called;
  EXPECT_NE(called.find("run.sbatch|2000|"), std::string::npos) << called;
  EXPECT_NE(called.find("--array=0-499|"), std::string::npos) << called;
  EXPECT_NE(called.find("--dependency=afterany:101:102:103|"), std::string::npos) << called;
}

TEST_F(BatchOfASweep, AnElementRunsItsOwnRunAndTheLastJobGathers) {
  program("words", "printf '%s|' \"$@\" >> \"" + (root_.path / "got").string() + "\"");
  const BatchSweep sweep{job({(root_.path / "bin/words").string(), "sweep"}), {{"v=2"}, {"v=1", "v=3"}}, 0};
  const fs::path scripts = write_batch(sweep.job.folder, slurm_files(sweep));
  EXPECT_TRUE(bash({(scripts / "run.sbatch").string(), "0"}, {{"SLURM_ARRAY_TASK_ID", "0"}}).succeeded());
  EXPECT_TRUE(bash({(scripts / "run.sbatch").string(), "1"}, {{"SLURM_ARRAY_TASK_ID", "1"}}).succeeded());
  EXPECT_TRUE(bash({(scripts / "gather.sbatch").string()}).succeeded());
  EXPECT_EQ(text(root_.path / "got"), "sweep|--only=v=2|sweep|--only=v=3|sweep|--gather|");
  harmless();
}

// One process stays on one machine; the job that gathers is small and short, whatever a run takes.
TEST_F(BatchOfASweep, OneRankIsAskedForOnOneMachineAndTheTableForAnHour) {
  BatchSweep sweep{job({"program"}), {{"v=2"}}, 0};
  const auto directives = [&](int file) {
    std::istringstream lines(slurm_files(sweep)[file].text);
    std::string found;
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("#SBATCH --n") || line.starts_with("#SBATCH --c") ||
          line.starts_with("#SBATCH --t"))
        found += line.substr(8) + " ";
    return found;
  };
  EXPECT_EQ(directives(0), "--ntasks=2 --cpus-per-task=1 --time=150 ");
  EXPECT_EQ(directives(1), "--nodes=1 --ntasks=1 --cpus-per-task=1 --time=60 ");
  sweep.job.needs.ranks = 1, sweep.job.needs.cores = 4, sweep.job.needs.memory = 1.4999e9;
  EXPECT_EQ(directives(0), "--nodes=1 --ntasks=1 --cpus-per-task=4 --time=150 ");
  EXPECT_NE(slurm_files(sweep)[0].text.find("--mem=1500M"), std::string::npos);
  EXPECT_EQ(slurm_files(sweep)[1].name, "gather.sbatch");
}

TEST(BatchNeeds, AreTheCostOfTheCaseAndOfItsEngine) {
  Overrides overrides;
  overrides.engine = "openfoam";
  overrides.ranks = 6;
  overrides.set = {{"flow.cells", "[200,200,300]"}, {"flow.max_iterations", "200"}};
  const auto file = std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml";
  Case given = read_case(file, overrides);
  const EngineCost takes = engine_of("openfoam").takes;
  const Cost cost = cost_of(resolve(given));
  BatchNeeds needs = steady_needs(resolve(given));
  EXPECT_EQ(needs.cores, 1);  // ranks are the cores
  EXPECT_DOUBLE_EQ(needs.memory, cost.memory + takes.cell_memory * cost.cells + takes.rank_memory * 6);
  const double core_hours = 10 * 200 * cost.cells * takes.cell_time / 3600;  // ten couplings
  EXPECT_EQ(needs.hours, std::ceil(core_hours / 6));
  EXPECT_GT(needs.hours, 1);
  EXPECT_EQ(needs.limited, fmt::format("about {:.2g} core hours, and an hour at least", core_hours));
  EXPECT_EQ(steady_needs(resolve(given), 3).hours, std::ceil(core_hours / 6 / 3));
  given.flow.max_iterations = 100000;  // three hundred are usual
  EXPECT_EQ(steady_needs(resolve(given)).hours, std::ceil(1.5 * core_hours / 6));
  const BatchNeeds opening = opening_needs(resolve(given), 2);
  EXPECT_EQ(opening.ranks, 1);
  EXPECT_EQ(opening.cores, 2);
  EXPECT_EQ(opening.hours, 24);
  EXPECT_EQ(opening.limited, "no estimate is available for this run");
  EXPECT_EQ(opening_needs(resolve(given), 2, 5).cores, 5);

  overrides.set.push_back({"flow.porosity_model", "sheet"});
  overrides.set.push_back({"parachute.canopy_material", "f-111-physical"});
  const Settings quarter = resolve(read_case(file, overrides));
  EXPECT_NEAR(steady_needs(quarter).memory - cost_of(quarter, true).memory,
              takes.cell_memory * cost.cells / 4 + takes.rank_memory * 6, 1);
  EXPECT_NEAR(steady_needs(in_full_domain(quarter)).memory - cost_of(quarter).memory,
              takes.cell_memory * cost.cells + takes.rank_memory * 6, 1);

  Case small = square_law_case();
  small.flow.unsteady = true;
  EXPECT_EQ(steady_needs(resolve(small)).hours, 24);
  small.coupling.threads = 0;
  EXPECT_EQ(steady_needs(resolve(small)).cores, 4);
}

TEST(BatchNeeds, FollowFromTheCase) {
  const Case tiny = square_law_case();
  EXPECT_EQ(steady_needs(resolve(tiny)).ranks, 1);
  EXPECT_EQ(steady_needs(resolve(tiny)).cores, 1);  // its coupling.threads
  EXPECT_EQ(steady_needs(resolve(tiny), 8).cores, 8);
  EXPECT_EQ(steady_needs(resolve(tiny)).hours, 1);
  Overrides overrides;
  overrides.engine = "openfoam";
  overrides.ranks = 16;
  overrides.set = {{"flow.cells", "[400,400,600]"}};
  const Case large = read_case(fs::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml", overrides);
  const BatchNeeds needs = steady_needs(resolve(large));
  EXPECT_EQ(needs.ranks, 16);
  EXPECT_EQ(needs.cores, 1);
  EXPECT_GT(needs.memory, 96e6 * 1e3);
  EXPECT_GT(needs.hours, 10);
  EXPECT_LE(needs.hours, 168);
}

}  // namespace
}  // namespace ripstop

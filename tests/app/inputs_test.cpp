// Impossible input is refused before any computation, an incomplete write is no success, and every failure
// has its exit code.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "program.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/stl.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

class Inputs : public testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_.path / name).string(); }
  /// Refused with this code and these words, within seconds.
  void refused(const std::vector<std::string>& arguments, int code, const std::string& words) {
    const Finished run = ripstop_with(arguments, RIPSTOP_SOURCE_DIR, 20);
    EXPECT_EQ(run.code, code) << arguments.front() << ": " << run.output;
    EXPECT_NE(run.output.find(words), std::string::npos) << arguments.front() << ": " << run.output;
  }
  /// Exit code of the program when it may take so much address space.
  int limited(const std::vector<std::string>& arguments, rlim_t bytes) const {
    const pid_t child = fork();
    if (child == 0) {
      const rlimit limit{bytes, bytes};
      if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(125);
      _exit(wait_for(start(arguments, in("out"), in("errors"))));
    }
    return wait_for(child);
  }
  TemporaryFolder folder_{"inputs"};
};

TEST_F(Inputs, ImpossibleInputIsRefusedBeforeAnyComputation) {
  refused({"check", stratos, "--set", "parachute.mesh.line_segment_m=0.001", "--set",
           "parachute.lines.length_m=1000"},
          2, "of lines and riser would have 1.8e+07 nodes");
  refused({"inflate", stratos, "--pressure", "500", "--check", "--set", "inflation.line_segment_m=0.001",
           "--set", "parachute.lines.length_m=1000"},
          2, "inflation.line_segment_m = 0.001");
  refused({"inflate", stratos, "--pressure", "500", "--check", "--duration", "1000", "--set",
           "inflation.history_hz=1e6"},
          2, "1e+09 rows");
  refused({"coupon", "f-111", "--length", "100", "--width", "0.001"}, 2, "nodes, more than");
  refused({"coupon", "f-111", "--length", "10", "--width", "0.01", "--orientation", "45"}, 2,
          "nodes, more than");
  std::string many = "1";
  for (int i = 2; i < 100; ++i) many += "," + std::to_string(i);
  refused({"sweep", stratos, "--speeds", many, "--vary", "flow.temperature_k=300." + many, "--vary",
           "flow.turbulence_intensity=0." + many},
          2, "970299 runs");
  refused({"calibrate", "damping", stratos, "--from", "16", "--to", "4"}, 2, "0 < from < to");
  refused({"calibrate", "damping", stratos, "--pressure", "300", "--set", "inflation.measured_peak_n=1000",
           "--set", "inflation.low_pass_hz=9e5", "--cloth-nodes", "1000"},
          2, "inflation.low_pass_hz = 900000");
  refused({"calibrate", "porosity", stratos, "--gammas", "0.2", "--measured", in("none.csv")}, 2, "none.csv");
  write_file(in("drag.csv"), "speed_m_s,density_kg_m3,drag_n\n20,1.2,150\n");
  refused(
      {"calibrate", "porosity", stratos, "--gammas", "0.2", "--measured", in("drag.csv"), "--out", in("p")},
      2, "two or more");
  EXPECT_FALSE(fs::exists(in("p")));
}

TEST_F(Inputs, ACoupledInflationIsCheckedAndRefusedForClothThatIsNoSheet) {
  const std::string flat = (fs::path(RIPSTOP_SOURCE_DIR) / "examples/flat-circular/case.toml").string();
  const Finished check = ripstop_with({"inflate", flat, "--air", "coupled", "--cloth-nodes", "1500",
                                       "--check", "--set", "inflation.initial_radius_m=0.15"});
  EXPECT_EQ(check.code, 0) << check.output;
  EXPECT_NE(check.output.find("coupled flow at 20 m/s: 80 x 80 x 98 cells"), std::string::npos)
      << check.output;
  refused({"inflate", stratos, "--air", "coupled"}, 2, "flow.porosity_model");
  const auto deployed = [&](const char* strip_force) {
    return std::vector<std::string>{"inflate",
                                    flat,
                                    "--air",
                                    "coupled",
                                    "--cloth-nodes",
                                    "1500",
                                    "--check",
                                    "--set",
                                    "inflation.mass=payload",
                                    "--set",
                                    "payload.mass_kg=2",
                                    "--set",
                                    std::string("deployment.strip_force_n=") + strip_force};
  };
  const Finished bag = ripstop_with(deployed("1"));
  EXPECT_EQ(bag.code, 0) << bag.output;
  EXPECT_NE(bag.output.find(" m/s, the speed after the deployment: 80 x 80 x 98 cells"), std::string::npos)
      << bag.output;
  refused(deployed("1000"), 2, "or a higher airspeed at deployment (--speed; 20 m/s) pulls it out");
}

TEST_F(Inputs, AnOpeningWithoutARadiusHasAClosedMouthAndStatesIt) {
  const Finished check =
      ripstop_with({"inflate", examples + "flat-circular/case.toml", "--pressure", "100", "--cloth-nodes",
                    "1500", "--check", "--units", "us", "--threads", "1"});
  EXPECT_EQ(check.code, 0) << check.output;
  EXPECT_NE(check.output.find("inflation.initial_radius_m is not given; the mouth is closed: radius"),
            std::string::npos)
      << check.output;
  EXPECT_NE(check.output.find(" in) from the axis"), std::string::npos) << check.output;
}

TEST_F(Inputs, ACurveOverTheAngleOfAttackIsRefusedWithTheValueThatIsWrong) {
  const std::string flat = examples + "flat-circular/case.toml";
  const std::vector<std::string> command = {"stability", flat, "--dry-run", "--out", in("curve")};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), command.begin(), command.end());
    return more;
  };
  refused(with({"--angles", "40:0:5"}), 2, "--angles 40:0:5: from 40 down to 0");
  refused(with({"--angles", "0:40:0"}), 2, "a step of 0");
  refused(with({"--angles", "0:100:10"}), 2, "100 degrees; an angle of attack is from 0 to 90");
  refused(with({"--set", "flow.angle_of_attack_deg=5"}), 2, "this command sets the angle");
  refused(with({"--set", "flow.sides=\"slip\""}), 2, "flow.sides = \"slip\", given by --set");
  refused(with({"--set", "flow.tunnel.kind=\"open-jet\"", "--set", "flow.tunnel.width_m=2"}), 2,
          "not a wind tunnel");
  refused(with({"--steady", in("none")}), 2, "contains no finished run");
  refused({"stability", stratos, "--dry-run"}, 2, "flow.porosity_model");
  const Finished listed = ripstop_with(with({"--angles", "0:20:10"}));
  EXPECT_EQ(listed.code, 0) << listed.output;
  EXPECT_NE(listed.output.find("curve/angle=20\n"), std::string::npos) << listed.output;
  EXPECT_FALSE(fs::exists(in("curve")));
}

TEST_F(Inputs, AnOldKeyIsWarnedOfOnceByEveryCommand) {
  const std::string warning =
      "warning: materials.f-111.darcy is a deprecated key: write materials.f-111.darcy_1_m2\n";
  const std::vector<std::vector<std::string>> commands = {
      {"check", stratos},
      {"steady", stratos, "--dry-run", "--out", in("steady")},
      {"sweep", stratos, "--speeds", "10,20", "--dry-run", "--out", in("sweep")},
      {"inflate", stratos, "--pressure", "500", "--check"}};
  for (std::vector<std::string> command : commands) {
    command.insert(command.end(), {"--set", "materials.f-111.darcy=60"});
    const Finished run = ripstop_with(command);
    EXPECT_EQ(run.code, 0) << run.output;
    const std::size_t first = run.output.find(warning);
    ASSERT_NE(first, std::string::npos) << run.output;
    EXPECT_EQ(run.output.find("is a deprecated key", first + warning.size()), std::string::npos)
        << run.output;
  }
}

TEST_F(Inputs, ADryRunRefusesTheSameInputAsTheRun) {
  fs::create_directories(in("mine"));
  write_file(in("mine/notes.txt"), "mine");
  const std::vector<std::string> steady = {"steady", stratos, "--out", in("mine")},
                                 sweep = {"sweep", stratos, "--speeds", "10,20", "--out", in("mine")},
                                 inflate = {"inflate", stratos, "--pressure", "500", "--out", in("mine")};
  for (auto [command, dry] : {std::pair{steady, "--dry-run"}, {sweep, "--dry-run"}, {inflate, "--check"}}) {
    refused(command, 2, "is not empty");
    command.push_back(dry);
    refused(command, 2, "is not empty");
  }
  EXPECT_EQ(read_file(in("mine/notes.txt")), "mine");
}

TEST_F(Inputs, MissingMemoryIsReportedBeforeItIsAllocated) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer takes more address space than any limit leaves";
#endif
  constexpr rlim_t gigabyte = 1 << 30;
  EXPECT_EQ(limited({"steady", stratos, "--dry-run", "--grid", "500,500,600"}, 4 * gigabyte), 8);
  EXPECT_NE(read_file(in("errors")).find("needs about 75.2 GB of memory"), std::string::npos)
      << read_file(in("errors"));
  EXPECT_EQ(limited({"coupon", "f-111", "--threads", "1024"}, gigabyte), 8);
  EXPECT_NE(read_file(in("errors")).find("of 1024 threads could be started"), std::string::npos)
      << read_file(in("errors"));
}

TEST_F(Inputs, ASurfaceOutsideTheBoxHasNoDragToCompare) {
  const Triangle flat{{-0.5, -0.5, 2}, {0.5, -0.5, 2}, {0, 0.5, 2}};
  Triangle far = flat;
  far.c.z = 1e6;
  write_stl(in("far.stl"), {flat, far});
  refused({"flow-parity", "--surface", in("far.stl")}, 3, "must be inside the domain");
  write_stl(in("none.stl"), {});
  refused({"flow-parity", "--surface", in("none.stl")}, 3, "contains no triangle");
}

TEST_F(Inputs, OutputThatCouldNotBeWrittenIsNoSuccess) {
  for (std::vector<std::string> command :
       std::vector<std::vector<std::string>>{{"check", stratos},
                                             {"check", stratos, "--json"},
                                             {"check", stratos, "--resolved"},
                                             {"schema"},
                                             {"schema", "--reference"},
                                             {"pattern", stratos, "--out", in("pattern")},
                                             {"steady", stratos, "--dry-run"},
                                             {"--help"},
                                             {"--version"}}) {
    EXPECT_EQ(wait_for(start(command, "/dev/full", in("errors"))), 7) << command.front();
    EXPECT_NE(read_file(in("errors")).find("writ"), std::string::npos)
        << command.front() << read_file(in("errors"));
  }
}

// Every command that computes for longer than a moment; each would take a minute or more.
TEST_F(Inputs, AFolderThatCannotBeMadeIsReportedBeforeTheComputation) {
  const std::string flat = examples + "flat-circular/case.toml", none = "/proc/nowhere/run";
  for (std::vector<std::string> command : std::vector<std::vector<std::string>>{
           {"steady", flat},
           {"sweep", flat, "--speeds", "10,20"},
           {"compare", flat, "--linear"},
           {"inflate", flat, "--pressure", "300"},
           {"fly", flat, "--mass", "2"},
           {"stability", flat},
           {"fabric", flat},
           {"coupon", "f-111"},
           {"fit", examples + "fit-ripstop/bench.toml"},
           {"calibrate", "damping", flat, "--pressure", "300", "--set", "inflation.measured_peak_n=1000"}}) {
    command.insert(command.end(), {"--out", none});
    refused(command, 7, "cannot create folder " + none);
  }
}

TEST_F(Inputs, APipeInPlaceOfAFileDoesNotBlock) {
  const std::string pipe = in("pipe.toml");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"check", pipe},
                                             {"fit", pipe},
                                             {"coupon", pipe},
                                             {"import", pipe},
                                             {"photogrammetry", pipe},
                                             {"flow-parity", "--surface", pipe},
                                             {"calibrate", "porosity", stratos, "--measured", pipe}})
    refused(command, 7, "a pipe or a device");
}

TEST_F(Inputs, AFolderInPlaceOfAFileIsReported) {
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"check", examples}, {"fit", examples}})
    refused(command, 7, "is a folder");
}

TEST_F(Inputs, NoEscapeOfAFileReachesTheTerminal) {
  std::string text = read_file(examples + "elliptical/elliptical.chute");
  const std::size_t name = text.find("\"name\": \"") + 9;
  text.insert(name, "\\u001b]0;taken\\u0007\\u009b2J");
  const std::size_t key = text.find("\"gores\"");
  text.insert(key, "\"\\u001b[31mred\": 1, ");
  write_file(in("bad.chute"), text);
  const Finished import = ripstop_with({"import", in("bad.chute"), "--out", in("bad.toml")});
  EXPECT_EQ(import.code, 0) << import.output;
  write_file(in("key.toml"), "\"\\u001b[31mred\\u009b\" = 1\n");
  write_file(in("table.csv"), "speed_m_s,density_kg_m3,drag (\x1b[31mN)\n1,2,3\n");
  const Finished others[] = {import, ripstop_with({"check", in("key.toml")}),
                             ripstop_with({"check", "\x1b[31m"}), ripstop_with({"\x1b[31m"}),
                             ripstop_with({"calibrate", "porosity", stratos, "--measured", in("table.csv")})};
  for (const Finished& run : others) {
    EXPECT_EQ(run.output.find('\x1b'), std::string::npos) << run.output;
    EXPECT_EQ(run.output.find("\xc2\x9b"), std::string::npos) << run.output;
    EXPECT_NE(run.output.find("\\x1b"), std::string::npos) << run.output;
  }
}

TEST_F(Inputs, AStoppedRunReportsHowToResume) {
  for (const int signal_number : {SIGINT, SIGTERM}) {
    fs::remove_all(in("run"));
    const std::vector<std::string> command = {"steady",  stratos,
                                              "--grid",  "24,24,36",
                                              "--speed", "10",
                                              "--set",   "parachute.mesh.cloth_nodes=1500",
                                              "--set",   "coupling.threads=1",
                                              "--out",   in("run")};
    const pid_t child = start(command, in("out"), in("errors"));
    while (!fs::exists(in("run/checkpoint/current"))) {
      ASSERT_EQ(waitpid(child, nullptr, WNOHANG), 0) << "ended before its first checkpoint";
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    kill(child, signal_number);
    EXPECT_EQ(wait_for(child), 128 + signal_number);
    const std::string said = read_file(in("errors"));
    EXPECT_NE(said.find("repeat the same command to resume"), std::string::npos) << said;
    EXPECT_NE(said.find(signal_number == SIGINT ? "Ctrl-C" : "SIGTERM"), std::string::npos) << said;
  }
}

TEST_F(Inputs, AnOpeningThatHasNotSettledIsNotConvergedAndHasNoSteadyLoad) {
  const Finished run = ripstop_with({"inflate", stratos, "--pressure", "500", "--duration", "0.002",
                                     "--cloth-nodes", "1000", "--threads", "1", "--out", in("opening")});
  EXPECT_EQ(run.code, 4) << run.output;
  EXPECT_NE(run.output.find("not settled within inflation.duration_s = 0.002 s"), std::string::npos)
      << run.output;
  EXPECT_NE(run.output.find("not a steady load at the speed of deployment"), std::string::npos) << run.output;
  EXPECT_EQ(run.output.find("  steady load"), std::string::npos) << run.output;
  const auto result = nlohmann::json::parse(read_file(in("opening/result.json")));
  EXPECT_EQ(result.at("inputs_hash"),
            nlohmann::json::parse(read_file(in("opening/run.json"))).at("inputs_hash"));
}

}  // namespace
}  // namespace ripstop

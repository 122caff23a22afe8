// The commands from a payload to a parachute and back as a user meets them: exit codes and messages.
#include <gtest/gtest.h>

#include <filesystem>

#include "program.h"
#include "ripstop/core/file.h"
#include "ripstop/report/report.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

class FlightCommands : public testing::Test {
 protected:
  int run(std::vector<std::string> arguments) { return wait_for(start(arguments, in("out"), in("error"))); }
  std::string said() const { return read_file(folder_.path / "error"); }
  std::string printed() const { return read_file(folder_.path / "out"); }
  std::string in(const char* name) const { return (folder_.path / name).string(); }
  const std::string flat_ = RIPSTOP_SOURCE_DIR "/examples/flat-circular/case.toml";
  TemporaryFolder folder_{"flight-commands"};
};

TEST_F(FlightCommands, SizeWritesACaseThatChecks) {
  ASSERT_EQ(run({"size", "--mass", "2.4", "--descent-rate", "5", "--height", "300", "--out", in("my.toml")}),
            0);
  EXPECT_NE(printed().find("nominal diameter"), std::string::npos);
  EXPECT_TRUE(printed().ends_with(in("my.html") + "\n")) << printed();  // the report's path last
  EXPECT_TRUE(is_report(read_file(in("my.html"))));
  EXPECT_EQ(run({"check", in("my.toml")}), 0);
  EXPECT_EQ(run({"load", in("my.toml"), "--speed", "25", "--out", in("load")}), 0);
  EXPECT_NE(printed().find("Pflanz"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_.path / "load" / "force.png"));
}

TEST_F(FlightCommands, SizeStatesTheHeightThatItAssumes) {
  const std::vector<std::string> size = {"size", "--mass",  "2.4",   "--descent-rate",
                                         "5",    "--force", "--out", in("my.toml")};
  const std::string assumed =
      "0 m above sea level, for descent and opening (flow.height_m = 0 m of the case: "
      "the default of --height, sea level)";
  for (const char* option : {"", "--height", "--density"}) {
    std::vector<std::string> with = size;
    if (*option) with.insert(with.end(), {option, "1"});
    ASSERT_EQ(run(with), 0);
    EXPECT_EQ(printed().find(assumed) != std::string::npos, !*option) << printed();
  }
}

TEST_F(FlightCommands, AFileThatIsThereStaysUnlessForced) {
  write_file(in("my.toml"), "mine");
  const std::vector<std::string> size = {"size", "--mass", "2.4",        "--descent-rate",
                                         "5",    "--out",  in("my.toml")};
  EXPECT_EQ(run(size), 2);
  EXPECT_EQ(read_file(in("my.toml")), "mine");
  std::vector<std::string> forced = size;
  forced.push_back("--force");
  EXPECT_EQ(run(forced), 0);
  EXPECT_NE(read_file(in("my.toml")), "mine");
  fs::remove(in("my.toml"));
  EXPECT_EQ(run(size), 2) << "my.html is there";
}

/// A user's input and the required content of the message.
struct Mistake {
  std::vector<std::string> arguments;
  std::string named;
};

TEST_F(FlightCommands, BadInputIsRefusedWithItsReasonAndLeavesNoFile) {
  fs::create_directories(in("empty"));
  fs::create_directories(in("other") + "/notes");
  const auto load = [&](std::vector<std::string> more) {
    std::vector<std::string> all = {"load", flat_, "--out", in("load")};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const auto opening = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--mass", "2", "--speed", "25"});
    return load(more);
  };
  const auto size = [&](std::vector<std::string> more) {
    std::vector<std::string> all = {"size", "--out", in("my.toml")};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const Mistake mistakes[] = {
      {size({"--mass", "-2.4", "--descent-rate", "5"}), "--mass = -2.4: must be above 0"},
      {size({"--mass", "nan", "--descent-rate", "5"}), "--mass = nan: must be a finite number"},
      {size({"--mass", "2.4", "--descent-rate", "-5"}), "--descent-rate = -5: must be above 0"},
      {size({"--mass", "2.4", "--descent-rate", "50", "--deployment-speed", "20"}),
       "descent rate of 50 m/s is not below the deployment speed of 20 m/s"},
      {size({"--mass", "2.4", "--descent-rate", "5", "--height", "99000"}),
       "--height = 99000: must be at least -2000 and at most 80000"},
      {size({"--mass", "2.4", "--descent-rate", "5", "--density", "-1"}), "--density = -1: must be above 0"},
      {size({"--mass", "2.4", "--descent-rate", "5", "--family", "conicl"}), "did you mean conical?"},
      {load({"--speed", "25"}), "--mass KG"},
      {load({"--mass", "-1", "--speed", "25"}), "--mass = -1: must be above 0"},
      {load({"--mass", "2", "--speed", "nan"}), "--speed = nan: must be a finite number"},
      {load({"--mass", "50", "--speed", "5"}), "is above the 5 m/s of the deployment"},
      {opening({"--height", "90000"}), "--height = 90000: must be at least -2000 and at most 80000"},
      {opening({"--height", "300", "--ground", "500"}), "above the ground at 500 m"},
      {opening({"--angle", "120"}), "--angle = 120: must be at least -90 and at most 90"},
      {opening({"--reef", "0.1"}), "SHARE:SECONDS"},
      {opening({"--reef", "1.2:3"}), "reefed stage at 1.2"},
      {opening({"--reef", "0.1:-3"}), "duration of a reefed stage (s) of -3"},
      {opening({"--drag-coefficient", "-1"}), "--drag-coefficient = -1: must be above 0"},
      {opening({"--opening-coefficient", "0"}), "--opening-coefficient = 0: must be above 0"},
      {opening({"--filling-constant", "-8"}), "--filling-constant = -8: must be above 0"},
      {opening({"--filling-exponent", "0"}), "--filling-exponent = 0: must be above 0"},
      {opening({"--impulse-integral", "2"}), "--impulse-integral = 2: must be above 0 and at most 1"},
      {opening({"--snatch-speed", "-3"}), "--snatch-speed = -3: must be above 0"},
      {opening({"--packed-area", "-1"}), "--packed-area = -1: must be above 0"},
      {opening({"--packed-area", "1", "--payload-area", "-1"}), "--payload-area = -1: must be at least 0"},
      {opening({"--steady", in("empty")}), "contains no finished run of ripstop steady"},
      {opening({"--opening", in("empty")}), "contains no finished run of ripstop inflate"},
      {{"descent", in("empty"), "--mass", "4"}, "compute one with: ripstop steady CASE --out " + in("empty")},
      {{"descent", in("other"), "--mass", "4"},
       "give the folder of one, or compute one with: ripstop steady CASE --out runs/NAME"},
      {{"descent", in("none"), "--mass", "4"}, "contains no finished run of ripstop steady"},
      {{"export", "rocketpy", in("empty")}, "contains no finished run of ripstop steady"},
      {{"export", "openrocket", in("none")}, "contains no finished run of ripstop steady"},
      {{"export", "rocketpy", flat_}, "is a file; the folder of a finished run is required"},
      {{"export", "spacepy", in("empty")}, "spacepy"},
      {{"export", "rocketpy", in("empty"), "--trigger", "300 kg"},
       "--trigger = 300 kg: must be apogee, or a height above the ground"},
      {{"export", "rocketpy", in("empty"), "--trigger", "-3"}, "--trigger = -3: must be apogee"},
      {{"check", flat_, "--set", "payload.mass_kg=-1"}, "payload.mass_kg = -1: must be above 0"},
      {{"check", flat_, "--set", "margins.safety_factor=0.5"}, "must be at least 1 and at most 10"},
      {{"check", flat_, "--set", "margins.seam_efficiency=1.5"}, "must be above 0 and at most 1"},
  };
  for (const Mistake& m : mistakes) {
    EXPECT_EQ(run(m.arguments), 2) << m.named;
    EXPECT_NE(said().find(m.named), std::string::npos) << m.named << " in: " << said();
  }
  EXPECT_FALSE(fs::exists(in("my.toml")));
  EXPECT_FALSE(fs::exists(in("load")));
}

TEST_F(FlightCommands, AnEmptyDeploymentFoldsGoresAndACross) {
  const auto check = [&](const std::string& file) {
    return run({"inflate", file, "--air", "coupled", "--check", "--threads", "1", "--set", "deployment={}"});
  };
  EXPECT_EQ(check(flat_), 0) << said();
  EXPECT_NE(printed().find("folded start: 36 folds"), std::string::npos) << printed();
  EXPECT_EQ(check(RIPSTOP_SOURCE_DIR "/examples/cross/case.toml"), 0) << said();
  EXPECT_NE(printed().find("folded start: 4 folds"), std::string::npos) << printed();
}

TEST_F(FlightCommands, ARefusedImportStatesThatItsCaseIsNotWritten) {
  write_file(in("tiny.ork"),
             "<openrocket><rocket><subcomponents><parachute><name>P</name><diameter>0.005</diameter>"
             "</parachute></subcomponents></rocket></openrocket>");
  EXPECT_NE(run({"import", in("tiny.ork"), "--out", in("tiny.toml")}), 0);
  EXPECT_NE(said().find("tiny.toml (not written):6:22: parachute.nominal_diameter_m = 0.005"),
            std::string::npos)
      << said();
  EXPECT_FALSE(fs::exists(in("tiny.toml")));
}

TEST_F(FlightCommands, CompareFlightPrintsBothUnits) {
  const std::string folder = RIPSTOP_SOURCE_DIR "/examples/flight-log/";
  const auto compare = [&](const std::string& units) {
    return run({"compare-flight", folder + "flight.csv", "--case", folder + "main.toml", "--ground", "200",
                "--units", units, "--out", in("log")});
  };
  EXPECT_EQ(compare("si"), 0) << said();
  EXPECT_EQ(printed().find("ft"), std::string::npos) << printed();
  EXPECT_EQ(compare("us"), 0) << said();
  for (const char* value : {"35.99 m/s (118.1 ft/s)", "m2 (3.207 +- ", "1500 m (4921 ft) above ground"})
    EXPECT_NE(printed().find(value), std::string::npos) << printed();
}

// One iteration of a coarse run is not a finished drag: nothing may be made of it.
TEST_F(FlightCommands, ARunThatDidNotConvergeCarriesNoFlight) {
  EXPECT_EQ(run({"steady", flat_, "--grid", "16,16,24", "--set", "parachute.mesh.cloth_nodes=500", "--set",
                 "coupling.max_iterations=1", "--set", "coupling.threads=1", "--out", in("run")}),
            4);
  const std::vector<std::vector<std::string>> users = {
      {"descent", in("run"), "--mass", "4"},
      {"export", "rocketpy", in("run")},
      {"load", flat_, "--mass", "2", "--speed", "25", "--steady", in("run"), "--out", in("load")}};
  for (const std::vector<std::string>& arguments : users) {
    EXPECT_EQ(run(arguments), 3) << arguments[0];
    EXPECT_NE(said().find("has not converged and its drag cannot be used"), std::string::npos) << said();
  }
  EXPECT_EQ(run({"descent", in("run"), "--mass", "-4"}), 2);
  EXPECT_FALSE(fs::exists(in("load")));
}

}  // namespace
}  // namespace ripstop

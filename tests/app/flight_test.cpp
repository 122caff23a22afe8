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
  int run(std::vector<std::string> arguments) {
    return wait_for(start(arguments, (folder_.path / "out").string()));
  }
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

TEST_F(FlightCommands, BadInputIsRefusedAsUsage) {
  EXPECT_EQ(run({"size", "--mass", "-2.4", "--descent-rate", "5", "--out", in("my.toml")}), 2);
  EXPECT_EQ(run({"size", "--mass", "2.4", "--descent-rate", "50", "--deployment-speed", "20", "--out",
                 in("my.toml")}),
            2);
  EXPECT_FALSE(fs::exists(folder_.path / "my.toml"));
  EXPECT_EQ(run({"load", flat_, "--speed", "25"}), 2);  // no mass
  EXPECT_EQ(run({"load", flat_, "--mass", "-1", "--speed", "25"}), 2);
  EXPECT_EQ(run({"load", flat_, "--mass", "50", "--speed", "5"}), 2);
  EXPECT_EQ(run({"load", flat_, "--mass", "2", "--speed", "25", "--reef", "0.1"}), 2);
  EXPECT_EQ(run({"descent", in("none"), "--mass", "4"}), 2);
  EXPECT_EQ(run({"export", "rocketpy", in("none")}), 2);
  EXPECT_EQ(run({"export", "spacepy", in("none")}), 2);
}

}  // namespace
}  // namespace ripstop

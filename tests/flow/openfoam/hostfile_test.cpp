// The hosts of MPI, looked at before anything is computed.
#include "ripstop/flow/openfoam/hostfile.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>
#include <sstream>

#include "../../refusal.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/process.h"
#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/flow/steady.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;
using openfoam::parse_hosts;
using openfoam::require_slots;

std::string refusal(const std::string& text) {
  return refusal_of([&] { parse_hosts(text, "hosts"); }, ExitCode::usage);
}

TEST(Hostfile, HasALineAHost) {
  const auto hosts = parse_hosts(
      "# ours\nnode-1.cluster slots=4 max_slots=8\n\n  me@10.0.0.2 slots=2# two\nnode3\nn4 count=1 port=22\n",
      "hosts");
  ASSERT_EQ(hosts.size(), 4u);
  EXPECT_EQ(hosts[0].name, "node-1.cluster");
  EXPECT_EQ(hosts[0].slots, 4);
  EXPECT_EQ(hosts[1].name, "me@10.0.0.2");
  EXPECT_EQ(hosts[1].slots, 2);
  EXPECT_FALSE(hosts[2].slots);
  EXPECT_EQ(hosts[3].slots, 1);
}

TEST(Hostfile, AMistakeIsNamedWithLineWordAndRange) {
  EXPECT_EQ(refusal("a slots=2\nb slots=0\n"),
            "hosts:2:3: slots = 0: must be a whole number, at least 1 and at most 4096");
  EXPECT_NE(refusal("a slots=two\n").find("hosts:1:3: slots = two: must be"), std::string::npos);
  EXPECT_NE(refusal("a slots\n").find("slots = nothing"), std::string::npos);
  EXPECT_NE(refusal("a slot=2\n").find("slot: is not a word of a hostfile; did you mean slots?"),
            std::string::npos);
  EXPECT_NE(refusal("-oProxyCommand=harm\n").find("is not a name of a host"), std::string::npos);
  EXPECT_NE(refusal("a;harm\n").find("is not a name of a host"), std::string::npos);
  EXPECT_NE(refusal("").find("hosts: contains no host"), std::string::npos);
  EXPECT_NE(refusal("# none\n\n").find("contains no host"), std::string::npos);
  EXPECT_NE(refusal("a slots=0\nb slots=0\n").find("2 problems"), std::string::npos);
}

TEST(Hostfile, NeedsASlotForEveryRank) {
  const TemporaryFolder folder("hosts");
  const fs::path file = folder.path / "hosts";
  write_file(file, "a slots=2\nb slots=1\n");
  require_slots(file, 3);
  try {
    require_slots(file, 4);
    ADD_FAILURE() << "taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("its 2 hosts have 3 slots for 4 ranks"), std::string::npos)
        << error.what();
  }
  write_file(file, "a slots=2\nb\n");
  require_slots(file, 400);  // b has as many as cores
  EXPECT_THROW(require_slots(folder.path / "none", 2), Error);
  EXPECT_THROW(require_slots(folder.path, 2), Error);
}

/// mpirun that notes its arguments and fails, before any other on PATH.
TEST(Hostfile, IsOneArgumentOfMpirunWhateverItsName) {
  const TemporaryFolder folder("hosts");
  const fs::path hosts = folder.path / "my $(touch harm) hosts", bin = folder.path / "bin";
  fs::create_directories(bin);
  write_file(hosts, "localhost slots=2\n");
  write_file(bin / "mpirun",
             "#!/bin/sh\nprintf '%s\\n' \"$@\" > \"" + (folder.path / "got").string() + "\"\nexit 1\n");
  fs::permissions(bin / "mpirun", fs::perms::owner_all);
  const std::string before = getenv("PATH");
  setenv("PATH", (bin.string() + ":" + before).c_str(), 1);
  OpenFoamSettings settings;
  settings.folder = folder.path / "case";
  settings.ranks = 2;
  settings.hostfile = hosts;
  FlowProblem problem;
  problem.grid = {{0, 0, 0}, {1, 1, 1}, 4, 4, 4};
  problem.air.velocity = {0, 0, 10};
  problem.bodies = {porous_body({{21, 22}, 100, 10})};
  problem.stopping.max_iterations = 3;
  EXPECT_THROW(solve(*make_openfoam(settings), problem), Error);
  setenv("PATH", before.c_str(), 1);
  const std::string got = read_file(folder.path / "got");
  EXPECT_TRUE(got.starts_with("-np\n2\n--hostfile\n" + hosts.string() + "\n-x\nWM_PROJECT_DIR\n")) << got;
  EXPECT_FALSE(fs::exists(folder.path / "harm") || fs::exists(settings.folder / "harm"));
}

}  // namespace
}  // namespace ripstop

#include "ripstop/core/cgroup.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "ripstop/core/file.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;
using Files = std::vector<std::pair<std::string, std::string>>;

/// Quota of a system with these files.
std::optional<int> processors_with(const Files& files) {
  const TemporaryFolder folder("cgroup");
  const fs::path& root = folder.path;
  for (const auto& [name, text] : files) {
    fs::create_directories((root / name).parent_path());
    write_file(root / name, text);
  }
  return cgroup_processors(root);
}

TEST(Cgroup, RoundsTheQuotaOfVersionTwoUp) {
  const auto with = [](const std::string& quota) {
    return processors_with({{"proc/self/cgroup", "0::/\n"}, {"sys/fs/cgroup/cpu.max", quota}});
  };
  EXPECT_EQ(with("200000 100000\n"), 2);
  EXPECT_EQ(with("150000 100000\n"), 2);
  EXPECT_EQ(with("1000 100000\n"), 1);
  EXPECT_EQ(with("max 100000\n"), std::nullopt);
  EXPECT_EQ(with("nonsense\n"), std::nullopt);
}

TEST(Cgroup, UsesTheSmallestQuotaOfTheGroupsAbove) {
  EXPECT_EQ(processors_with({{"proc/self/cgroup", "0::/slice/job/step\n"},
                             {"sys/fs/cgroup/slice/cpu.max", "300000 100000"},
                             {"sys/fs/cgroup/slice/job/cpu.max", "800000 100000"},
                             {"sys/fs/cgroup/slice/job/step/cpu.max", "max 100000"}}),
            3);
}

TEST(Cgroup, ReadsVersionOneAlsoWhereThePathIsThatOutsideTheContainer) {
  const std::string groups = "9:memory:/docker/1\n4:cpu,cpuacct:/docker/1\n0::/docker/1\n";
  EXPECT_EQ(processors_with({{"proc/self/cgroup", groups},
                             {"sys/fs/cgroup/cpu/cpu.cfs_quota_us", "400000"},
                             {"sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000"}}),
            4);
  EXPECT_EQ(processors_with({{"proc/self/cgroup", groups},
                             {"sys/fs/cgroup/cpu/cpu.cfs_quota_us", "-1"},
                             {"sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000"}}),
            std::nullopt);
}

TEST(Cgroup, HasNoQuotaWithoutControlGroups) {
  EXPECT_EQ(processors_with({}), std::nullopt);
  EXPECT_EQ(processors_with({{"proc/self/cgroup", "no group\n"}}), std::nullopt);
}

}  // namespace
}  // namespace ripstop

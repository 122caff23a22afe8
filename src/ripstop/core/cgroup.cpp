#include "ripstop/core/cgroup.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

namespace ripstop {
namespace {

namespace fs = std::filesystem;

/// Version 2 has "quota period" or "max period"; version 1 has a file of its own for each, and -1 means no quota.
std::optional<double> quota_of(const fs::path& group) {
  std::ifstream version_2(group / "cpu.max");
  double quota = 0, period = 0;
  if (version_2 >> quota >> period && quota > 0 && period > 0) return quota / period;
  std::ifstream version_1(group / "cpu.cfs_quota_us"), its_period(group / "cpu.cfs_period_us");
  if (version_1 >> quota && its_period >> period && quota > 0 && period > 0) return quota / period;
  return std::nullopt;
}

}  // namespace

std::optional<int> cgroup_processors(const fs::path& root) {
  std::optional<double> least;
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // "0::/path", or "3:cpu,cpuacct:/path" of version 1
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    std::string controllers(1, ',');
    controllers.append(line, first + 1, second - first - 1).append(1, ',');
    const bool version_2 = controllers == ",,";
    if (!version_2 && controllers.find(",cpu,") == std::string::npos) continue;
    const fs::path mount = root / (version_2 ? "sys/fs/cgroup" : "sys/fs/cgroup/cpu");
    // A container may see the path outside, whose folder does not exist: then the mount itself has the quota.
    for (fs::path group = fs::path(line.substr(second + 1)).relative_path();; group = group.parent_path()) {
      if (const auto quota = quota_of(mount / group)) least = std::min(least.value_or(*quota), *quota);
      if (group.empty()) break;
    }
  }
  if (!least || *least > 1e6) return std::nullopt;
  return std::max(1, static_cast<int>(std::ceil(*least)));
}

}  // namespace ripstop

// CPU quota of the control group (cgroup) of this process, which containers and batch systems set.
#pragma once

#include <filesystem>
#include <optional>

namespace ripstop {

/// Processors that the CPU quota allows, rounded up: the smallest quota / period of the control group of this process
/// and of the groups above it, version 2 (`cpu.max`) and version 1 (`cpu.cfs_quota_us`). Empty without a quota.
/// `root` contains `proc/self/cgroup` and `sys/fs/cgroup`.
std::optional<int> cgroup_processors(const std::filesystem::path& root = "/");

}  // namespace ripstop

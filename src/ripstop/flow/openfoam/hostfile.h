// The hosts that Open MPI may put ranks on, read before it does: its own messages come when much has been computed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ripstop::inline flow::openfoam {

struct Host {
  std::string name;
  std::optional<long long> slots;  // ranks that fit; absent: one per core, a number that only the host has
};

/// Lines "name slots=4 max_slots=8", with comments from a '#' on; `file` is its name in messages. Throws
/// InputError(usage) naming line, word and range.
std::vector<Host> parse_hosts(const std::string& text, const std::string& file);

/// Throws as parse_hosts() does, and Error(usage) where all hosts together have fewer slots than ranks.
void require_slots(const std::filesystem::path& file, int ranks);

}  // namespace ripstop::inline flow::openfoam

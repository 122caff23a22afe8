// The folder of a run, whatever runs in it: which inputs it is of, and whether it has ended.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "ripstop/case/case.h"

namespace ripstop {

struct RunSettings {
  std::filesystem::path folder;
  bool fresh = false;  // throw away what the folder holds of an earlier run
  bool fields = true;  // write shapes and flow for ParaView after every iteration
};

/// Whether the folder holds a run of these inputs to go on with. `solver` says what computes, and with what
/// beside the case. Throws Error(usage) for a folder that holds a run of other inputs, unless `fresh`, and
/// for one that holds anything but a run of Ripstop.
bool holds_run(const RunSettings& settings, const Case& given, const std::string& solver);

/// Opens or makes the folder of a run and writes run.json and case.toml; what holds_run() refuses is left as
/// it is.
void open_run_folder(const RunSettings& settings, const Case& given, const std::string& solver, int threads);

/// result.json of a run that had ended. Throws Error(bad_data) when it is damaged.
std::optional<std::string> finished_result(const std::filesystem::path& folder);

}  // namespace ripstop

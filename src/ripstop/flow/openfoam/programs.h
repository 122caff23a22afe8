// OpenFOAM's programs at work in a case's folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "ripstop/core/process.h"
#include "ripstop/flow/openfoam/installation.h"
#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/flow/openfoam/solver_log.h"

namespace ripstop::inline flow::openfoam {

/// Removes the files of OpenFOAM and of Ripstop; only for a folder of Ripstop.
void clear_case(const std::filesystem::path& folder);

class Programs {
 public:
  Programs(const OpenFoamSettings& settings, const std::filesystem::path& folder,
           const Installation& installation)
      : settings_(settings), folder_(folder), installation_(installation) {}

  /// A full disk makes OpenFOAM leave cut files behind without a word, so the room is looked at before.
  /// Measured at 1.5 million cells: mesh 0.11 kB a cell, a set of fields 0.10; a second set exists for a
  /// moment, and ranks have a copy of the mesh. Asked for with room to spare.
  /// Throws Error(io).
  void need_space(double cells) const;
  using Lines = std::function<void(const std::string& line)>;
  /// One of OpenFOAM's tools, with its arguments; `lines` receives its output. Throws Error(external) if it
  /// fails, with a possible remedy.
  void run_tool(const std::string& tool, const std::vector<std::string>& arguments = {},
                const std::string& help = {}, const Lines& lines = {}) const;
  /// `stopped`: the report wanted no more. Throws Error(diverged) and Error(external) as Flow::advance() does.
  ProcessResult run_solver(const FlowReport& report, SolverLog& log, bool& stopped) const;

  const std::string& solver() const { return installation_.solver; }
  std::filesystem::path solver_log() const { return log_file(installation_.solver); }

 private:
  std::filesystem::path log_file(const std::string& program) const { return folder_ / ("log." + program); }
  ProcessRequest request_for(std::vector<std::string> arguments) const;
  void explain_failure(const ProcessResult& result, const SolverLog& log) const;

  OpenFoamSettings settings_;
  std::filesystem::path folder_;
  Installation installation_;
};

}  // namespace ripstop::inline flow::openfoam

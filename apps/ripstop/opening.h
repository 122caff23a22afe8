// What ripstop inflate and ripstop calibrate damping share: the case of an opening and its pressure.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/case.h"
#include "ripstop/run/inflation_folder.h"

namespace CLI {
class App;
}

namespace ripstop {

struct OpeningOptions {
  std::filesystem::path case_file, steady_run;
  Overrides overrides;
  std::optional<double> pressure, damping, duration;
  std::optional<int> cloth_nodes;
  int threads = 0;  // 0: as in [coupling]
};
void add_opening_options(CLI::App& command, OpeningOptions& options);

/// The case with what the command line changes, on a mesh that can be folded.
Case opening_case(const OpeningOptions& options);
int threads_of(const OpeningOptions& options, const Case& value);

/// Throws Error(usage) unless the pressure is given once, Error(bad_data) for a steady run without a result.
LoadSource load_source(const Case& value, const std::filesystem::path& steady_run);

/// The opening of the case; dp from the equilibrium of a coarse mesh when a steady drag is asked for.
InflationProblem opening_problem(const Case& value, const LoadSource& source, int threads);

}  // namespace ripstop

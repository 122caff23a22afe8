// The options that ripstop inflate and ripstop calibrate damping share.
#pragma once

#include <filesystem>

#include "ripstop/case/opening.h"

namespace CLI {
class App;
}

namespace ripstop::cli {

struct OpeningOptions {
  std::filesystem::path case_file, steady_run;
  Overrides overrides;
  int threads = 0;  // 0: as in [coupling]
};
void add_opening_options(CLI::App& command, OpeningOptions& options);

/// The opening of the case with the changes of the command line.
Settings opening_settings(const OpeningOptions& options);
/// "airspeed at deployment 20 m/s (payload.deployment_speed_m_s of the case)".
void print_deployment_speed(const Settings& opening);
int threads_of(const OpeningOptions& options, const Settings& opening);

/// As of the case, or of a steady run. Throws Error(bad_data) for a steady run without a result.
LoadSource load_source(const Settings& opening, const std::filesystem::path& steady_run);

}  // namespace ripstop::cli

#include "opening.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "case_options.h"
#include "number_option.h"
#include "option.h"
#include "ripstop/case/deployment.h"
#include "ripstop/run/steady/steady_folder.h"
#include "units_option.h"

namespace ripstop::cli {
void add_opening_options(CLI::App& command, OpeningOptions& options) {
  command.add_option("case", options.case_file, "Case file (TOML) with an [inflation] table")->required();
  CLI::Option* steady = add_run_folder(command, "--steady", options.steady_run,
                                       "Run folder of ripstop steady; its drag determines the pressure")
                            ->default_str("pressure or drag coefficient of the case");
  add_key_number(command, "--pressure", "inflation.pressure_pa", options.overrides.pressure,
                 "Pressure difference over the canopy [Pa]")
      ->excludes(steady);
  add_key_option(command, "--duration", "inflation.duration_s", "Time from deployment to the end [s]",
                 options.overrides);
  add_key_option(command, "--cloth-nodes", "parachute.mesh.cloth_nodes", "Target number of cloth nodes",
                 options.overrides);
  add_key_number(command, "--speed", "flow.speed_m_s", options.overrides.speed,
                 "Airspeed at deployment [m/s]")
      ->default_str("payload.deployment_speed_m_s, else flow.speed_m_s");
  add_set_option(command, options.overrides);
  add_number(command, "--threads", options.threads, from(1).up_to(key_range("coupling.threads").high),
             "Number of threads")
      ->default_str("coupling.threads");
}

Settings opening_settings(const OpeningOptions& options) {
  Case given = read_given(options.case_file, options.overrides);
  if (!options.steady_run.empty()) {  // replaces the value of the case
    given.inflation.pressure_pa.reset();
    given.inflation.drag_coefficient.reset();
  }
  if (!given.inflation.initial_radius_m) {
    close_mouth(given.parachute, given.inflation);
    fmt::print(stderr,
               "note: inflation.initial_radius_m is not given; the mouth is closed: radius of the folded "
               "skirt {:.4g} m\n",
               *given.inflation.initial_radius_m);
  }
  return resolve(opening_case(given));
}

void print_deployment_speed(const Settings& opening) {
  const DeploymentSpeed start = opening_speed(opening);
  print_text("airspeed at deployment: {:.4g} m/s ({})\n", start.speed, start.from);
}

int threads_of(const OpeningOptions& options, const Settings& opening) {
  return options.threads > 0 ? options.threads : opening.coupling().threads;
}

LoadSource load_source(const Settings& opening, const std::filesystem::path& steady_run) {
  return steady_run.empty() ? load_source(opening) : steady_load(steady_run, opening);
}

}  // namespace ripstop::cli

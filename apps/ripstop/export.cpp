// ripstop export: steady runs in the formats of flight simulators.

#include "ripstop/run/descent/export.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "number_option.h"
#include "option.h"
#include "reefed_stage.h"
#include "ripstop/case/payload.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/quantity.h"
#include "ripstop/core/visible.h"
#include "warnings.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string format, trigger = "apogee";
  fs::path run, out, flight, drogue, drogue_flight;
  std::optional<double> deployment_speed, drogue_speed, bay_diameter;
  std::string drogue_trigger = "apogee";
  std::vector<std::string> reefing;
  bool force = false, drogue_released = false;
};

/// "apogee", or a height with or without its unit, in metres.
CLI::Option* add_trigger(CLI::App& command, const std::string& option, std::string& trigger,
                         const std::string& help) {
  return command
      .add_option_function<std::string>(
          option,
          [&trigger, option](const std::string& text) {
            trigger = text;
            if (text == "apogee") return;
            const TypedNumber height = read_typed(text, "m");
            if (!height.refusal.empty() || !(height.value > 0))
              throw Error(
                  ExitCode::usage,
                  fmt::format("{} = {}: must be apogee, or a height above the ground, above 0 m, as in "
                              "{} 300 or {} '1000 ft'",
                              option, visible(text), option, option));
            trigger = fmt::format("{}", height.value);
          },
          help + ": apogee, or a height above the ground [m]")
      ->type_name("apogee|NUMBER")
      ->default_str(trigger);
}

ExportedParachute exported_run(const fs::path& run, std::optional<double> speed, const fs::path& flight,
                               const char* option) {
  ExportedParachute p = exported(finished_steady(run), speed,
                                 flight.empty() ? std::nullopt : std::optional(finished_flight(flight)));
  if (p.speed_assumed)
    print_warnings({fmt::format("{}: the lag of {:.3g} s is for a deployment at {:.3g} m/s ({}); give {}",
                                p.run, p.lag, p.deployment_speed, p.deployment_speed_from, option)});
  return p;
}

std::string text_of(const std::string& format, const ExportedRecovery& recovery) {
  if (format == "rocketpy") return rocketpy_text(recovery);
  if (format == "openrocket") return openrocket_text(recovery);
  if (format == "openrocket-design") return openrocket_design(recovery);
  return recovery.stages.size() == 1 ? to_json(recovery.stages[0].parachute) : to_json(recovery);
}

int export_run(const ExportArguments& options) {
  if (!options.out.empty() && fs::exists(options.out) && !options.force)
    throw Error(ExitCode::usage, fmt::format("{} exists; choose another --out, or replace it with --force",
                                             options.out.string()));
  ExportedRecovery recovery;
  recovery.drogue_released = options.drogue_released;
  if (!options.drogue.empty())
    recovery.stages.push_back(
        {exported_run(options.drogue, options.drogue_speed, options.drogue_flight, "--drogue-speed"),
         options.drogue_trigger});
  recovery.stages.push_back(
      {exported_run(options.run, options.deployment_speed, options.flight, "--deployment-speed"),
       options.trigger});
  if (options.bay_diameter && options.format == "rocketpy")
    throw Error(
        ExitCode::usage,
        "--bay-diameter: a RocketPy file has no packed size; leave the option out, or export openrocket, "
        "openrocket-design or json");
  if (options.bay_diameter)
    for (ExportedStage& stage : recovery.stages) pack_into_bay(*options.bay_diameter, stage.parachute);
  for (const std::string& text : options.reefing)
    recovery.stages.back().reefing.push_back(parse_reefed_stage(text));
  const std::string text = text_of(options.format, recovery);
  print_warnings(warnings_of(recovery));
  if (options.out.empty()) {
    fmt::print("{}", text);
    return 0;
  }
  if (options.out.has_parent_path()) make_folder(options.out.parent_path());
  write_file(options.out, text);
  fmt::print("{}\n", options.out.string());
  return 0;
}

}  // namespace

void add_export(CLI::App& app, int& status) {
  auto options = std::make_shared<ExportArguments>();
  CLI::App* command = app.add_subcommand(
      "export", "Export the parachutes of steady runs for RocketPy, OpenRocket or as JSON");
  command->footer(
      "Example: ripstop export rocketpy runs/my-canopy --trigger 300 --out parachute.py\n"
      "         ripstop export openrocket-design runs/main --trigger 300 --drogue runs/drogue --out "
      "recovery.ork");
  add_choice(
      *command, "format", options->format, {"rocketpy", "openrocket", "openrocket-design", "json"},
      "Format: rocketpy, openrocket (component database .orc), openrocket-design (.ork with deployment "
      "events) or json")
      ->required();
  command->add_option("run", options->run, "Folder of a finished run of ripstop steady")->required();
  add_run_folder(*command, "--flight", options->flight,
                 "Folder of a finished run of ripstop fly of this parachute; its coefficient in descent "
                 "replaces the axial one");
  add_trigger(*command, "--trigger", options->trigger, "Deployment trigger");
  add_number(*command, "--deployment-speed", options->deployment_speed, above(0).up_to(1000),
             "Airspeed at line stretch, which sets the filling time (lag) [m/s]")
      ->default_str(fmt::format("payload.deployment_speed_m_s of the case, else the speed of the run; with "
                                "[payload], the larger of {:g} m/s and {:g} times the rate of descent",
                                least_deployment_speed, deployment_over_descent));
  add_number(*command, "--drogue-speed", options->drogue_speed, above(0).up_to(1000),
             "Airspeed at line stretch of the drogue [m/s]")
      ->default_str("as --deployment-speed");
  CLI::Option* drogue =
      add_run_folder(*command, "--drogue", options->drogue,
                     "Folder of a finished run of ripstop steady of the drogue, which opens first");
  add_run_folder(*command, "--drogue-flight", options->drogue_flight,
                 "Folder of a run of ripstop fly of the drogue")
      ->needs(drogue);
  add_trigger(*command, "--drogue-trigger", options->drogue_trigger, "Deployment trigger of the drogue")
      ->needs(drogue);
  command
      ->add_flag("--drogue-released", options->drogue_released,
                 "The drogue is released when the main opens; without this option it remains attached")
      ->needs(drogue);
  command
      ->add_option("--reef", options->reefing,
                   "Reefed stage SHARE:SECONDS of the parachute, as for ripstop load; repeatable, in order")
      ->expected(1)
      ->take_all();
  add_number(*command, "--bay-diameter", options->bay_diameter, above(0).up_to(10),
             "Inner diameter of the parachute bay, which the packed parachute fills; not for rocketpy [m]")
      ->default_str("packed parachute twice as long as wide");
  command->add_option("--out", options->out, "File")->default_str("standard output");
  command->add_flag("--force", options->force, "Replace an existing file");
  command->callback([options, &status] { status = export_run(*options); });
}

}  // namespace ripstop::cli

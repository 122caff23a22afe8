// ripstop export: a steady run in the formats of flight simulators.

#include "ripstop/run/descent/export.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "number_option.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string format, trigger = "apogee";
  fs::path run, out, flight;
  std::optional<double> deployment_speed;
  bool force = false;
};

int export_run(const ExportArguments& options) {
  if (!options.out.empty() && fs::exists(options.out) && !options.force)
    throw Error(ExitCode::usage, fmt::format("{} exists; choose another --out, or replace it with --force",
                                             options.out.string()));
  const auto flight = options.flight.empty() ? std::nullopt : std::optional(finished_flight(options.flight));
  const ExportedParachute p = exported(finished_steady(options.run), options.deployment_speed, flight);
  const std::string text = options.format == "rocketpy"     ? rocketpy_text(p, options.trigger)
                           : options.format == "openrocket" ? openrocket_text(p)
                                                            : to_json(p);
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
      "export", "Export the parachute of a steady run for RocketPy, OpenRocket or as JSON");
  command->footer("Example: ripstop export rocketpy runs/my-canopy --trigger 300 --out parachute.py");
  command->add_option("format", options->format, "Format: rocketpy, openrocket or json")
      ->required()
      ->check(CLI::IsMember({"rocketpy", "openrocket", "json"}));
  command->add_option("run", options->run, "Folder of a finished run of ripstop steady")->required();
  command
      ->add_option(
          "--flight", options->flight,
          "Folder of a finished run of ripstop fly of this parachute: its coefficient in descent, in place "
          "of the axial one")
      ->check(CLI::ExistingDirectory);
  command->add_option("--trigger", options->trigger,
                      "Deployment trigger of RocketPy: apogee, or a height above ground [m]");
  add_number(*command, "--deployment-speed", options->deployment_speed, above(0).up_to(1000),
             "Speed at deployment, which sets the filling time (lag) [m/s] (default: speed of the run)");
  command->add_option("--out", options->out, "File (default: standard output)");
  command->add_flag("--force", options->force, "Replace an existing file");
  command->callback([options, &status] { status = export_run(*options); });
}

}  // namespace ripstop

// ripstop descent: how fast a payload comes down under the parachute of a steady run or a flight.

#include "ripstop/run/descent/descent.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "json_option.h"
#include "number_option.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/flight/atmosphere.h"
#include "units_option.h"
#include "warnings.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct DescentArguments {
  fs::path run, out;
  double mass = 0;
  std::vector<double> heights = {0, 300, 1000, 3000};
  double ground = 0;
  bool json = false;
};

void print_result(const Descent& d) {
  print_text(
      "{}\n  payload {:.4g} kg, parachute {:.3g} kg, drag area {:.4f} +- {:.4f} m2 (computed at {:.4g} "
      "m/s)\n",
      d.title, d.payload_mass, d.parachute_mass, d.drag_area, d.drag_area_uncertainty, d.run_speed);
  print_text("  drag coefficient {:.3f} on S0, {}{}\n", d.drag_coefficient,
             d.basis == "descent" ? "in descent (computed free flight)" : "axial (steady flow on the axis)",
             d.known_coefficient ? fmt::format("; Knacke, in descent: {:.2f} to {:.2f}",
                                               d.known_coefficient->at(0), d.known_coefficient->at(1))
                                 : "");
  const int width = both_units() ? 18 : 15, speed_width = both_units() ? 38 : 20;
  fmt::print("{:>{}} {:>13} {:>{}} {:>22}\n", "above sea level", width, "air density", "rate of descent",
             speed_width, fmt::format("time to {:g} m", d.ground));
  for (const DescentRow& row : d.rows)
    fmt::print("{:>{}} {:>13} {:>{}} {:>22}\n", in_units(fmt::format("{:.4g} m", row.height)), width,
               fmt::format("{:.4f} kg/m3", row.density),
               in_units(fmt::format("{:.3f} +- {:.3f} m/s", row.speed, row.speed_uncertainty)), speed_width,
               row.time ? fmt::format("{:.1f} +- {:.1f} s", *row.time, *row.time_uncertainty) : "-");
}

int descent(const DescentArguments& options) {
  if (!options.out.empty()) make_results_folder(options.out, "descent");
  const Descent result =
      run_descent(carrying_run(options.run), options.mass, options.heights, options.ground);
  if (!options.out.empty()) write_file(options.out / "result.json", to_json(result));
  return show(result, options.json, [&] { print_result(result); });
}

}  // namespace

void add_descent(CLI::App& app, int& status) {
  auto options = std::make_shared<DescentArguments>();
  CLI::App* command =
      app.add_subcommand("descent", "Compute rate of descent and descent time from a steady run or a flight");
  command->footer(
      "+- is the numerical uncertainty of the run (last change of the drag, averaging, force balance), or "
      "the standard\nerror of the flight. It does not include the error of the model.\n"
      "Example: ripstop descent runs/stratos --mass 4 --height 300,1000");
  command->add_option("run", options->run, "Folder of a finished run of ripstop steady or fly")->required();
  add_number(*command, "--mass", options->mass, key_range("payload.mass_kg"),
             "Mass of the payload, without the parachute [kg]")
      ->required();
  const Range height = from(lowest_height).up_to(highest_height);
  add_numbers(*command, "--height", options->heights, height, "Heights above sea level [m]");
  add_number(*command, "--ground", options->ground, height, "Height of the ground above sea level [m]");
  command->add_option("--out", options->out, "Folder for result.json")->default_str("none");
  add_units_option(*command);
  add_json_option(*command, options->json);
  command->callback([options, &status] { status = descent(*options); });
}

}  // namespace ripstop::cli

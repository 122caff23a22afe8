// ripstop compare-flight: drag areas, deployments and opening loads from the logs of a flight.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "case_options.h"
#include "commands.h"
#include "json_option.h"
#include "number_option.h"
#include "ripstop/case/case.h"
#include "ripstop/core/error.h"
#include "ripstop/core/visible.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/run/flight/measured_flight.h"
#include "table_options.h"
#include "units_option.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct CompareFlightArguments {
  MeasuredFlightRequest request;
  fs::path case_file, out = "flight-log";
  std::string columns, decimal = "auto";
  double mass_uncertainty_percent = 1;
  bool json = false;
};

void print_phases(const MeasuredFlight& f) {
  const int height_width = both_units() ? 32 : 16, speed_width = both_units() ? 24 : 16,
            area_width = both_units() ? 42 : 26;
  fmt::print("{:>6} {:>{}} {:>{}} {:>{}} {:>22}\n", "phase", "above ground", height_width, "rate of descent",
             speed_width, "drag area", area_width, "C_D on S0 of the case");
  for (std::size_t i = 0; i < f.phases.size(); ++i) {
    const DescentPhase& p = f.phases[i];
    const std::string heights = in_units(fmt::format("{:.0f} to {:.0f} m", p.from_height, p.to_height));
    if (p.drag_area)
      fmt::print("{:>6} {:>{}} {:>{}} {:>{}} {:>22.3f}\n", i + 1, heights, height_width,
                 in_units(fmt::format("{:.2f} m/s", p.speed)), speed_width,
                 in_units(fmt::format("{:.4f} +- {:.4f} m2", *p.drag_area, *p.drag_area_uncertainty)),
                 area_width, *p.drag_area / f.nominal_area);
    else
      fmt::print("{:>6} {:>{}} {:>{}} not known: {}\n", i + 1, heights, height_width, "", speed_width,
                 in_units(p.problem));
  }
}

void print_result(const MeasuredFlight& f, const fs::path& out) {
  print_text(
      "{}\n  mass {:.4g} kg ({}), apogee {:.0f} m above ground, noise of the heights {:.2f} m (standard "
      "deviation)\n",
      visible_line(f.title), f.mass, f.mass_from, f.highest, f.height_noise);
  print_phases(f);
  for (const LoggedDeployment& d : f.deployments) {
    print_text("deployment at {:.1f} s, {:.0f} m above ground: speed {:.1f} to {:.1f} m/s", d.time, d.height,
               d.speed_before, d.speed_after);
    if (d.peak_load) print_text(", peak {:.4g} N", *d.peak_load);
    if (d.filling_time) print_text(", filling time {:.2f} s", *d.filling_time);
    if (d.filling_distance) print_text(", filling distance {:.1f} D0", *d.filling_distance);
    print_text("{}\n", d.problem.empty() ? "" : "; " + d.problem);
  }
  for (const FlightComparison& c : f.computed)
    print_text(
        "computed drag area {:.4f} +- {:.4f} m2{}: {}\n", c.drag_area, c.drag_area_uncertainty,
        c.difference ? fmt::format(", {:+.1f} % relative to phase {}", 100 * *c.difference, c.phase) : "",
        c.run);
  fmt::print("{}\n", (out / "report.html").string());
}

int compare(CompareFlightArguments& options) {
  options.request.columns = table::parse_columns(options.columns);
  options.request.decimal = table::parse_decimal(options.decimal);
  options.request.mass_uncertainty = options.mass_uncertainty_percent / 100;
  const MeasuredFlight flight = compare_flight(read_settings(options.case_file), options.request);
  write_measured_flight(options.out, flight);
  const int status = show(flight, options.json, [&] { print_result(flight, options.out); });
  for (const std::string& note : flight.notes) fmt::print(stderr, "note: {}\n", visible_line(note));
  return status;
}

}  // namespace

void add_compare_flight(CLI::App& app, int& status) {
  auto options = std::make_shared<CompareFlightArguments>();
  CLI::App* command = app.add_subcommand(
      "compare-flight",
      "Determine drag areas over height, deployments and opening loads from the logs of a flight");
  command->footer(
      "A phase is the time between two deployments, before the first or after the last one. Its drag\n"
      "area is determined where the rate of descent is steady; +- is one standard deviation, from the\n"
      "uncertainties of height and mass.\n"
      "Example: ripstop compare-flight examples/flight-log/flight.csv --case examples/flight-log/main.toml "
      "--ground 200");
  command
      ->add_option("logs", options->request.logs,
                   "Tables of time with altitude, acceleration or force, on one clock")
      ->required();
  command->add_option("--case", options->case_file, "Case of the parachute (TOML)")->required();
  add_number(*command, "--mass", options->request.mass, key_range("payload.mass_kg"),
             "Total mass that descends: payload and parachute [kg]")
      ->default_str("payload and parachute of the case");
  add_number(*command, "--mass-uncertainty", options->mass_uncertainty_percent, from(0).up_to(50),
             "Standard deviation of the mass [%]");
  add_number(*command, "--ground", options->request.ground, from(lowest_height).up_to(highest_height),
             "Height of the ground above sea level [m]");
  add_number(*command, "--height-zero", options->request.height_zero,
             from(-highest_height).up_to(highest_height),
             "Height above ground where the log reads 0 [m]; -200 for a log of heights above sea level and "
             "--ground 200");
  add_number(*command, "--body-drag-area", options->request.body_drag_area, from(0).up_to(100),
             "Drag area of everything but the canopies [m2]");
  command->add_option("--run", options->request.runs,
                      "Folder of a finished run of ripstop steady; repeatable");
  add_table_options(*command, options->columns, options->decimal, "altitude=Hoehe [m]");
  command->add_option("--out", options->out, "Folder for report, plots and result.json");
  add_units_option(*command);
  add_json_option(*command, options->json);
  command->callback([options, &status] { status = compare(*options); });
}

}  // namespace ripstop::cli

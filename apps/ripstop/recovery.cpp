// ripstop recovery: from apogee to the ground under a drogue and a main, or under one parachute.

#include "ripstop/run/descent/recovery.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "case_options.h"
#include "commands.h"
#include "json_option.h"
#include "margins.h"
#include "number_option.h"
#include "option.h"
#include "ripstop/core/error.h"
#include "ripstop/core/words.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/run/opening/handbook.h"
#include "ripstop/run/sizing/pattern.h"
#include "units_option.h"
#include "warnings.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct RecoveryArguments {
  fs::path main_case, drogue_case, out = "runs/recovery";
  Overrides overrides;
  std::optional<double> mass, apogee;
  RecoveryRequest request;
  CLI::Option* main_height = nullptr;
  bool json = false;
};

std::string range_text(const Ranged& r, const char* unit) {
  if (rounded(r.low) == rounded(r.high)) return fmt::format("{} {}", rounded(r.value), unit);
  return fmt::format("{} {}, range {} to {} {}", rounded(r.value), unit, rounded(r.low), rounded(r.high),
                     unit);
}

void print_stage(const RecoveryStage& s, bool wind) {
  print_text("\n{}: {}\n", s.name, s.title);
  print_row("drag", fmt::format("C_D {:.3f} ({}) on S0 = {:.4g} m2, drag area {:.4g} m2: {}",
                                s.drag_coefficient, s.drag_basis, s.reference_area,
                                s.drag_coefficient * s.reference_area, s.drag_source));
  print_row("range of C_D in descent", fmt::format("{:.3f} to {:.3f}: {}", s.descent_drag.low,
                                                   s.descent_drag.high, s.descent_drag.from));
  print_row(
      "opening",
      fmt::format("{:.2f} s after apogee, {} m above the ground, at {}, path {} deg below the "
                  "horizon, {:.4g} kg/m3 (standard atmosphere)",
                  s.time, rounded(s.height), range_text(s.speed, "m/s"), rounded(s.path_angle), s.density));
  print_row("opening load",
            finite_mass_text(s.lowest_finite_mass_load, s.highest_finite_mass_load, s.design_load,
                             fmt::format("fills in {:.3g} s", s.filling_time)));
  print_row(
      "design load",
      fmt::format("{}: {}", range_text({s.design_load, s.lowest_design_load, s.highest_design_load}, "N"),
                  s.design_load_from));
  print_row("uncertainty of the load",
            fmt::format("{:.0f} %{}: {}", 100 * s.load_uncertainty, s.of_trajectory ? "" : " at one speed",
                        s.load_uncertainty_from));
  if (s.snatch_load)
    print_row("snatch load", fmt::format("{} N by [deployment] of its case, at the highest airspeed",
                                         rounded(*s.snatch_load)));
  if (s.separation_load)
    print_row("separation load",
              fmt::format("{} N on the shock cord when two sections separate", rounded(*s.separation_load)));
  print_row("margins and hardware",
            fmt::format("under {} N, the highest design load{}{}", rounded(s.highest_design_load),
                        s.separation_load == s.hardware.rated ? "; of hardware under the separation load"
                        : s.hardware.rated > s.highest_design_load
                            ? "; of lines, riser and hardware under the snatch load"
                            : "",
                        heavy_payload_note(s.design_load_caution)));
  print_margins(s.margins, s.design_load_caution);
  print_row("required hardware", hardware_text(s.hardware, s.design_load_caution));
  print_row("fastest safe deployment", s.safe ? safe_speed_text(*s.safe, s.design_load_caution)
                                              : "not computed: a measured load is that at one speed");
  print_row("rate of descent at the end", range_text(s.descent_rate, "m/s"));
  print_row("duration", range_text(s.duration, "s"));
  if (wind) print_row("drift", range_text(s.drift, "m"));
  print_row("packed", fmt::format("{}; mass {:.3g} kg", packed_text(s.mass, s.packed_volume), s.mass));
  if (s.bay_length)
    print_row(
        "length in the bay",
        fmt::format("{} at this density, {} packed loosely; without harness and protector",
                    length_text(*s.bay_length),
                    length_text(*s.bay_length * std::max(1.0, s.mass / (loosely_packed * s.packed_volume)))));
}

std::string wind_text(const RecoveryResult& r) {
  if (!(r.wind.speed_m_s > 0)) return "none given (--wind)";
  if (!(r.wind.exponent > 0)) return fmt::format("{} m/s at all heights", rounded(r.wind.speed_m_s));
  return fmt::format("{} m/s at {} m above the ground, power law with the exponent {:g}: {} m/s at apogee",
                     rounded(r.wind.speed_m_s), rounded(r.wind.reference_height_m), r.wind.exponent,
                     rounded(r.apogee_wind));
}

void print_result(const RecoveryResult& r, const RecoveryArguments& options) {
  print_text(
      "{}\n  {:.4g} kg and parachutes {:.3g} kg, apogee {:.5g} m above the ground, which is {:.4g} m above "
      "sea level; horizontal airspeed at apogee {:.4g} m/s{}\n",
      r.title, r.mass, r.total_mass - r.mass, r.apogee, r.ground, options.request.speed,
      options.request.speed == RecoveryRequest{}.speed ? ", the default of --speed (assumed)" : "");
  for (const RecoveryStage& stage : r.stages) print_stage(stage, r.wind.speed_m_s > 0);
  print_text("\nlanding\n");
  print_row("rate of descent", range_text(r.landing_speed, "m/s"));
  print_row("kinetic energy", range_text(r.energy, "J"));
  for (const SectionEnergy& section : r.sections)
    print_row("", fmt::format("section of {:.4g} kg: {}", section.mass, range_text(section.energy, "J")));
  print_row("time since apogee", range_text(r.time, "s"));
  print_row("wind", wind_text(r));
  if (r.wind.speed_m_s > 0) print_row("drift with the wind", range_text(r.drift, "m"));
  print_row("path in still air",
            fmt::format("{} m horizontally, in the direction of flight at apogee", rounded(r.range)));
  if (std::none_of(r.stages.begin(), r.stages.end(),
                   [](const RecoveryStage& s) { return s.separation_load.has_value(); }))
    print_separation();
  print_text(
      "Ranges are computed with the smallest and the largest drag coefficients in descent; ranges of loads "
      "include the scatter of openings.\n"
      "{} (report.html, height.png, speed.png, trajectory.csv, result.json)\n",
      options.out.string());
}

int recovery(RecoveryArguments& options) {
  const Settings main = read_settings(options.main_case, options.overrides);
  const auto drogue =
      options.drogue_case.empty() ? std::nullopt : std::optional(read_settings(options.drogue_case));
  if (!options.mass && !main.payload().mass_kg)
    throw Error(ExitCode::usage,
                "the descending mass is missing: give --mass KG, or [payload] mass_kg in the "
                "case of the main parachute");
  if (!drogue && options.main_height->count() > 0)
    throw Error(
        ExitCode::usage,
        "--main-height needs --drogue: give both. Without a drogue the main opens at apogee, or at the "
        "time --delay after it; the output states its height then");
  if (!options.apogee)
    throw Error(ExitCode::usage, "the apogee is missing: give --apogee M, above the ground");
  options.request.apogee = *options.apogee;
  options.request.mass = options.mass ? *options.mass : *main.payload().mass_kg;
  const RecoveryResult result = run_recovery(main, drogue, options.request);
  write_recovery(options.out, result);
  return show(result, options.json, [&] {
    print_result(result, options);
    print_replaced_mass(options.mass, main);
  });
}

void add_flight(CLI::App& command, CLI::Option* drogue, RecoveryArguments& options) {
  RecoveryRequest& r = options.request;
  add_number(command, "--mass", options.mass, key_range("payload.mass_kg"),
             "Mass of the payload: rocket without the parachutes [kg]")
      ->default_str("payload.mass_kg of the main's case");
  add_number(command, "--apogee", options.apogee, above(0).up_to(highest_height),
             "Apogee above the ground [m]");
  options.main_height = add_number(command, "--main-height", r.main_height, above(0).up_to(highest_height),
                                   "Height above the ground at which the main opens, with a drogue [m]")
                            ->default_str(fmt::format("{:g} with --drogue", r.main_height));
  add_number(command, "--speed", r.speed, above(0).up_to(1000),
             "Horizontal airspeed at apogee [m/s]; the default is assumed");
  add_number(command, "--delay", r.delay, from(0).up_to(1000), "Time from apogee to the first opening [s]");
  add_number(command, "--ground", r.ground, from(lowest_height).up_to(highest_height),
             "Height of the ground above sea level [m]");
  add_number(command, "--body-area", r.body_drag_area, from(0).up_to(1e4),
             "Drag area of the payload (rocket body) [m2]")
      ->default_str("payload.drag_area_m2 of the main's case");
  add_key_option(command, "--wind", "flight.wind.speed_m_s",
                 "Speed of the wind at its reference height [m/s]; other keys of the profile with --set "
                 "flight.wind.KEY",
                 options.overrides);
  command
      .add_flag("--drogue-released", r.drogue_released,
                "The drogue is released when the main opens; without this option it remains attached")
      ->needs(drogue);
}

}  // namespace

void add_recovery(CLI::App& app, int& status) {
  auto options = std::make_shared<RecoveryArguments>();
  RecoveryRequest& r = options->request;
  CLI::App* command = app.add_subcommand(
      "recovery",
      "Compute the recovery of a rocket from apogee: openings, loads, margins, rates, drift, landing energy");
  command->footer(
      "Example: ripstop recovery main.toml --drogue drogue.toml --mass 22 --apogee 3000 --main-height 300 "
      "--wind 5 \\\n"
      "           --bay-diameter '5.9 in' --units us");
  command->add_option("case", options->main_case, "Case file of the main, or of the only parachute (TOML)")
      ->required();
  CLI::Option* drogue =
      command->add_option("--drogue", options->drogue_case, "Case file of the drogue, which opens at apogee");
  add_flight(*command, drogue, *options);
  add_run_folder(*command, "--steady", r.main_steady,
                 "Run folder of ripstop steady or fly with the drag area of the main");
  add_run_folder(*command, "--drogue-steady", r.drogue_steady,
                 "Run folder of ripstop steady or fly with the drag area of the drogue")
      ->needs(drogue);
  add_run_folder(*command, "--main-opening", r.main_opening,
                 "Run folder of ripstop inflate with the opening of the main");
  add_run_folder(*command, "--drogue-opening", r.drogue_opening,
                 "Run folder of ripstop inflate with the opening of the drogue")
      ->needs(drogue);
  add_number(*command, "--main-measured-load", r.main_measured_load, above(0).up_to(1e8),
             "Opening load of the main, measured at the speed of this opening [N]");
  add_number(*command, "--drogue-measured-load", r.drogue_measured_load, above(0).up_to(1e8),
             "Opening load of the drogue, measured at the speed of this opening [N]")
      ->needs(drogue);
  add_numbers(*command, "--section", r.sections, above(0).up_to(1e6),
              "Masses of sections of the rocket, for the kinetic energy of each at landing [kg]");
  add_number(
      *command, "--separation-speed", r.separation_speed, above(0).up_to(1000),
      "Relative speed at which two sections separate, for the load on the shock cord in [hardware]; needs "
      "--section, with the sections in order along the rocket [m/s]");
  add_number(*command, "--bay-diameter", r.bay_diameter, above(0).up_to(2),
             "Inner diameter of the parachute bay, for the length that the packed parachute needs; inches as "
             "'6 in' [m]");
  add_number(*command, "--packing-density", r.packing_density, packing_density_range,
             "Packing density, 250 (loose) to 400 by hand, 600 with a press [kg/m3]");
  add_set_option(*command, options->overrides);
  command->add_option("--out", options->out, "Folder");
  add_units_option(*command);
  add_json_option(*command, options->json);
  command->callback([options, &status] { status = recovery(*options); });
}

}  // namespace ripstop::cli

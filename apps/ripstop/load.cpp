// ripstop load: opening loads of a parachute for a payload mass, by several methods.

#include "ripstop/run/opening/load.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "case_options.h"
#include "commands.h"
#include "json_option.h"
#include "margins.h"
#include "number_option.h"
#include "option.h"
#include "reefed_stage.h"
#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/run/opening/fastest.h"
#include "ripstop/run/opening/filling.h"
#include "ripstop/run/opening/handbook.h"
#include "units_option.h"
#include "warnings.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct LoadArguments {
  fs::path case_file, out = "runs/load";
  Overrides overrides;
  std::optional<double> mass, height, speed;
  LoadRequest request;
  std::vector<std::string> reefing;
  bool json = false, fastest = false;
  double margin = 0;
};

std::string air_text(double height, double density, const std::string& from) {
  return fmt::format("{:.4g} m above sea level, {:.4g} kg/m3 ({})", height, density, from);
}

/// Of a filling below 46 m/s, where the filling constant depends on the speed.
std::string slow_filling_text(double constant) {
  return fmt::format(" (n = {:.3g} above 46 m/s; below it from t_f = {:.2f} D0 / v^0.85 in ft and ft/s)",
                     constant, slow_filling_coefficient(constant));
}

/// The caution is printed where it differs from that of the stage before.
void print_stage(const StageLoads& s, const StageLoads* before, const LoadResult& r,
                 const std::string& known_caution) {
  const double share = s.filling_time * s.speed / (s.filling_constant * r.nominal_diameter);
  print_text(
      "\nstage from {:.2f} s: {:.3g} m/s on a path {:.3g} deg below the horizon, {:.4g} m above sea level, "
      "{:.4g} kg/m3, drag area {:.3g} to {:.3g} m2{}\n"
      "  filling time {:.3g} s = {:.3g} D0 / speed{}{}, ballistic parameter {:.3g}, mass ratio R_m {:.3g}\n",
      s.begin, s.speed, s.path_angle, s.height, s.density, s.drag_area_before, s.drag_area,
      before && s.drag_area_before > 1.0005 * before->drag_area
          ? " (the canopy of the stage before is still larger than in steady flow)"
          : "",
      s.filling_time, s.filling_constant,
      s.filling_constant == r.filling_constant ? "" : slow_filling_text(r.filling_constant),
      share < 0.9995
          ? fmt::format(" x {:.3g} (square root of the drag area that the stage adds over the full one)",
                        share)
          : "",
      s.ballistic_parameter, s.mass_ratio);
  const int width = both_units() ? 24 : 10;
  fmt::print("  {:<18} {:>{}} {:>8}  {:<8} {}\n", "method", "load", width, "peak s", "use for", "reason");
  std::vector<std::string> notes;  // each is printed once, below the table
  for (const MethodLoad& m : s.methods) {
    const auto known = std::find(notes.begin(), notes.end(), m.note);
    const std::string reason = m.note.empty() ? "" : fmt::format("({})", known - notes.begin() + 1);
    if (!m.note.empty() && known == notes.end()) notes.push_back(m.note);
    fmt::print("  {:<18} {:>{}} {:>8}  {:<8} {}\n", m.method, in_units(fmt::format("{:.1f} N", m.load)),
               width, m.time > 0 ? fmt::format("{:.3f}", m.time) : "-",
               m.method == r.design_method && m.load == r.design_load ? "design"
               : m.applies                                            ? "estimate"
                                                                      : "-",
               reason);
  }
  for (std::size_t i = 0; i < notes.size(); ++i) print_text("  ({}) {}\n", i + 1, notes[i]);
  if (!s.caution.empty() && s.caution != known_caution) print_text("  filling: {}\n", s.caution);
  const auto applicable =
      std::count_if(s.methods.begin(), s.methods.end(), [](const MethodLoad& m) { return m.applies; });
  if (applicable > 1)
    print_text("  applicable methods: {:.1f} to {:.1f} N, spread (highest - lowest) / mean {:.0f} %\n",
               s.lowest, s.highest, 100 * s.spread);
  else if (applicable == 1)
    print_text("  one applicable method: {:.1f} N\n", s.lowest);
  else
    print_text("  no method estimates this opening; use the infinite-mass load\n");
}

void print_snatch(const SnatchResult& s) {
  print_text("snatch load {:.1f} N (speed difference {:.3g} m/s: {}; {}), {:.1f} N per line{}\n", s.load,
             s.speed_difference, s.from, s.model, s.line_load,
             s.line_margin ? fmt::format("; lines: breaking load / snatch load {:.2f}", *s.line_margin) : "");
  if (s.riser_margin) print_text("riser: breaking load / snatch load {:.2f}\n", *s.riser_margin);
  if (s.other_load)
    print_text("snatch load {:.1f} N (speed difference {:.3g} m/s: [deployment] of the case; {})\n",
               *s.other_load, *s.other_speed_difference, deployment_model);
  if (s.changes.empty()) return;
  const auto cell = [](const std::optional<double>& load) {
    return load ? in_units(fmt::format("{:.1f} N", *load)) : std::string("breaks");
  };
  const int width = both_units() ? 24 : 13;
  const auto line = [&](const std::string& part, const std::array<std::string, 4>& cells) {
    fmt::print("  {:<18}", part);
    for (const std::string& text : cells) fmt::print(" {:>{}}", text, width);
    fmt::print("\n");
  };
  line("snatch load with", {"length / 2", "length x 2", "stiffness / 2", "stiffness x 2"});
  for (const SnatchChange& c : s.changes)
    line(c.part,
         {cell(c.half_length), cell(c.double_length), cell(c.half_stiffness), cell(c.double_stiffness)});
}

void print_fastest(const FastestResult& r, const fs::path& folder, const std::optional<double>& mass,
                   const Settings& resolved) {
  print_text("{}\n  payload {:.4g} kg, parachute {:.3g} kg\n", r.title, r.payload_mass, r.parachute_mass);
  print_replaced_mass(mass, resolved);
  print_text("  at line stretch: path {:.3g} deg below the horizon, {}\n", r.path_angle,
             air_text(r.height, r.density, r.air_source));
  print_text("  FASTEST SAFE DEPLOYMENT {}\n", safe_speed_text(r.design(), r.design_load_caution));
  print_text(
      "  margin of safety {:g} of {}tape or hem, lines, riser and hardware{}; "
      "uncertainty of the load {:.0f} %: {}\n\n",
      r.margin, r.cloth_checked ? "cloth, " : "", r.cloth_checked ? "" : " (the cloth is not checked)",
      100 * r.load_uncertainty, r.load_uncertainty_from);
  for (const SafeSpeed& s : r.methods)
    print_text("  {:<18} {}; load {:.1f} N at {}{}\n", s.method, safe_speed_text(s), s.load,
               s.unsafe_at ? fmt::format("{:.1f} m/s", *s.unsafe_at)
                           : fmt::format("{:.1f} m/s", s.speed.value_or(fastest_deployment)),
               s.applies                     ? ""
               : s.method == r.design_method ? "; " + s.note
                                             : "; not applicable: " + s.note);
  if (r.snatch) print_snatch(*r.snatch);
  print_text("  USE {}\n", r.advice);
  print_text("{} (result.json)\n", folder.string());
}

void print_result(const LoadResult& r, const fs::path& folder, const std::optional<double>& mass,
                  const Settings& resolved) {
  print_text("{}\n  payload {:.4g} kg, parachute {:.3g} kg, S0 {:.4g} m2\n", r.title, r.payload_mass,
             r.parachute_mass, r.reference_area);
  print_replaced_mass(mass, resolved);
  print_text("  at line stretch: {:.4g} m/s ({}), path {:.3g} deg below the horizon, {}\n", r.speed,
             r.speed_source, r.path_angle, air_text(r.height, r.density, r.air_source));
  print_text(
      "  C_D {:.3f}: {}\n  C_x {:.2f}: {}\n  filling distance {:.3g} D0, exponent of the drag area over "
      "time {:g} (Ludtke: {:g}): {}\n",
      r.drag_coefficient, r.drag_source, r.opening_coefficient, r.opening_source, r.filling_constant,
      r.filling_exponent, r.ludtke_exponent, r.filling_source);
  print_text("  DESIGN LOAD {:.1f} N: {}; largest line load {:.2f} times the mean\n", r.design_load,
             r.design_load_from, r.line_load_factor);
  const bool snatch = r.snatch && r.snatch->largest() > r.design_load;
  const bool snatch_governs = r.required_load > r.highest_design_load;
  print_text("  highest design load {:.1f} N, with the uncertainty of {:.0f} %: {}\n", r.highest_design_load,
             100 * r.load_uncertainty, r.load_uncertainty_from);
  if (snatch_governs)
    print_text(
        "  Select tape for this load, and lines, riser and hardware for the snatch load of {:.1f} N.\n",
        r.required_load);
  else
    print_text("  Select lines, tape, riser and hardware for this load{}{}.\n",
               r.smallest_margin ? fmt::format(": margin of safety {}, {}", margin_text(*r.smallest_margin),
                                               r.smallest_margin_member)
                                 : "",
               heavy_payload_note(r.design_load_caution));
  if (r.stages.size() > 1)
    print_text(
        "  The speed of a later stage is that of the trajectory: the design load requires that the reefed "
        "stages decelerate the payload as computed. Without reefing the infinite-mass load at line stretch "
        "is {:.1f} N.\n",
        r.opening_coefficient * r.design_drag_coefficient * r.reference_area * 0.5 * r.density * r.speed *
            r.speed);
  else if (r.design_method == infinite_mass_method)
    print_text(
        "  The design load is computed without a filling distance. Methods with a smaller load assume "
        "one.\n");
  print_text("  The load of an \"estimate\" is expected if the canopy fills as that method assumes.\n");
  if (r.margins && r.highest_margins)
    print_margins(*r.margins, *r.highest_margins, r.design_load_caution, snatch);
  print_row("required hardware", hardware_text(r.hardware, r.design_load_caution));
  std::string caution;
  const StageLoads* before = nullptr;
  for (const StageLoads& stage : r.stages) {
    print_stage(stage, before, r, caution);
    caution = stage.caution, before = &stage;
  }
  print_text("\npeak load of the trajectory {:.1f} N after {:.3f} s\n", r.peak_load, r.peak_time);
  if (r.snatch) print_snatch(*r.snatch);
  if (r.steady_reached)
    print_text("steady descent at {:.3g} m/s; the trajectory ends {:.2f} s after line stretch, {:.4g} m {}\n",
               r.steady_speed, r.steady_time, std::abs(r.steady_drop),
               r.steady_drop < 0 ? "higher" : "lower");
  else
    print_text("steady descent is NOT reached above the ground: {:.3g} m/s at impact after {:.2f} s\n",
               r.steady_speed, r.steady_time);
  print_separation();
  print_text("{} (force.png, speed.png, trajectory.csv, result.json)\n", folder.string());
}

int load(LoadArguments& options) {
  const Settings resolved = read_settings(options.case_file, options.overrides);
  LoadRequest& request = options.request;
  if (!options.mass && !resolved.payload().mass_kg)
    throw Error(ExitCode::usage,
                "the mass of the payload is missing: give --mass KG, or [payload] mass_kg in the case");
  request.payload_mass = options.mass ? *options.mass : *resolved.payload().mass_kg;
  request.height = options.height;
  for (const std::string& text : options.reefing) request.reefing.push_back(parse_reefed_stage(text));
  if (options.fastest) {
    const FastestResult fastest = run_fastest(resolved, request, options.margin);
    write_fastest(options.out, fastest);
    return show(fastest, options.json, [&] { print_fastest(fastest, options.out, options.mass, resolved); });
  }
  take_speed(resolved, options.speed, request);
  const LoadResult result = run_load(resolved, request);
  write_load(options.out, result);
  return show(result, options.json, [&] { print_result(result, options.out, options.mass, resolved); });
}

void add_coefficients(CLI::App& command, LoadRequest& r) {
  add_number(command, "--drag-coefficient", r.drag_coefficient, key_range("inflation.drag_coefficient"),
             "Drag coefficient on S0")
      ->default_str(
          "of the --steady run, else inflation.drag_coefficient of the case, else Knacke's for the family");
  add_number(command, "--opening-coefficient", r.opening_coefficient, above(0).up_to(10),
             "Opening force coefficient C_x")
      ->default_str("of the canopy family");
  add_number(
      command, "--filling-constant", r.filling_constant, above(0).up_to(1000),
      "Filling distance n in t_f = n D0 / v; below 46 m/s the default is multiplied by 4.0 v^0.15 / 8 (v in "
      "ft/s)")
      ->default_str("of the canopy family");
  add_number(command, "--filling-exponent", r.filling_exponent, above(0).up_to(20),
             "Exponent of the drag area over time")
      ->default_str("of the canopy family");
  add_number(command, "--impulse-integral", r.impulse_integral, above(0).up_to(1),
             "Mean over peak force during filling, for the momentum-impulse method");
  add_run_folder(command, "--steady", r.steady,
                 "Run folder of ripstop steady or fly that provides the drag area");
  add_run_folder(command, "--opening", r.opening,
                 "Run folder of ripstop inflate that provides the drag area over distance");
  add_run_folder(
      command, "--from", r.filling_from,
      "Run folder of ripstop inflate that provides filling constant n and exponent of the drag area");
  add_number(command, "--measured-load", r.measured_load, above(0).up_to(1e8),
             "Opening load measured at this speed and mass, which becomes the design load [N]");
  add_number(command, "--snatch-speed", r.snatch_speed, above(0).up_to(1000),
             "Speed difference of payload and canopy at line stretch [m/s]");
  add_number(command, "--packed-area", r.packed_drag_area, above(0).up_to(1e4),
             "Drag area of the packed canopy with its pilot chute, to compute that speed difference [m2]");
  add_number(command, "--payload-area", r.payload_drag_area, from(0).up_to(1e4),
             "Drag area of the payload or rocket body [m2]")
      ->default_str("payload.drag_area_m2 of the case");
}

}  // namespace

void add_load(CLI::App& app, int& status) {
  auto options = std::make_shared<LoadArguments>();
  CLI::App* command =
      app.add_subcommand("load", "Estimate opening and snatch loads for a payload mass by several methods");
  command->footer(
      "Example: ripstop load examples/flat-circular/case.toml --mass 2.4 --speed 25 --height 300 --reef "
      "0.1:2\n"
      "         ripstop load examples/flat-circular/case.toml --mass 2.4 --fastest");
  command->add_option("case", options->case_file, "Case file (TOML)")->required();
  add_number(*command, "--mass", options->mass, key_range("payload.mass_kg"),
             "Mass of the payload without the parachute [kg]")
      ->default_str("payload.mass_kg of the case");
  CLI::Option* speed = add_number(*command, "--speed", options->speed,
                                  key_range("payload.deployment_speed_m_s"), "Airspeed at line stretch [m/s]")
                           ->default_str("payload.deployment_speed_m_s of the case");
  CLI::Option* fastest =
      command
          ->add_flag(
              "--fastest", options->fastest,
              "Find the largest airspeed at line stretch at which tape or hem, lines, riser and "
              "[hardware] keep their margin of safety, by every method. The snatch load is included if its "
              "speed difference is known")
          ->excludes(speed);
  add_number(*command, "--margin", options->margin, from(0).up_to(100),
             "Margin of safety that tape or hem, lines, riser and hardware keep with --fastest")
      ->needs(fastest);
  const Range height = from(lowest_height).up_to(highest_height);
  add_number(*command, "--height", options->height, height,
             "Height above sea level at line stretch, with the air of the standard atmosphere there [m]")
      ->default_str("height and density of the case");
  add_number(*command, "--ground", options->request.ground, height,
             "Height of the ground above sea level, where the flight ends [m]")
      ->default_str("sea level with --height, else none");
  add_number(*command, "--angle", options->request.path_angle, from(-90).up_to(90),
             "Angle of the flight path below the horizon [deg]");
  command
      ->add_option("--reef", options->reefing,
                   "Reefed stage SHARE:SECONDS: fraction of the full drag area (0 to 1) and duration; "
                   "repeatable, in order")
      ->expected(1)
      ->take_all();
  add_coefficients(*command, options->request);
  add_set_option(*command, options->overrides);
  command->add_option("--out", options->out, "Folder");
  add_units_option(*command);
  add_json_option(*command, options->json);
  command->callback([options, &status] { status = load(*options); });
}

}  // namespace ripstop::cli

// ripstop size: which parachute lets a payload down at a wanted rate, as a case file.

#include "ripstop/run/sizing/size.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "json_option.h"
#include "margins.h"
#include "number_option.h"
#include "option.h"
#include "progress.h"
#include "ripstop/case/payload.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/run/flight/finished_flight.h"
#include "ripstop/run/flight/flight_folder.h"
#include "ripstop/run/opening/handbook.h"
#include "ripstop/run/sizing/size_report.h"
#include "ripstop/run/steady/steady_folder.h"
#include "steady_terminal.h"
#include "stopping.h"
#include "units_option.h"
#include "warnings.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct SizeArguments {
  SizeRequest request;
  fs::path out = "my-canopy.toml";
  bool verify = false, fly = false, json = false, force = false;
  double duration = 30;  // of the flights [s]
};

void print_result(const SizeResult& r, const SizeArguments& options, const fs::path& page) {
  const auto row = print_row;
  print_text("{}\n", r.given.title);
  row("air", fmt::format("{:.4g} kg/m3, {:.4g} m above sea level, for descent and opening ({}{})", r.density,
                         r.height, r.air_source,
                         !options.request.density && r.height == SizeRequest{}.height
                             ? ": the default of --height, sea level"
                             : ""));
  row("drag coefficient",
      fmt::format("{:.3f} on S0, {}{}", r.drag_coefficient, r.drag_source,
                  r.handbook_drag_coefficient
                      ? fmt::format("; Knacke, in descent: {:.2f} to {:.2f}",
                                    r.handbook_drag_coefficient->at(0), r.handbook_drag_coefficient->at(1))
                      : ""));
  row("C_D of the family",
      fmt::format("axial {:.3f}, in descent {}", r.axial_coefficient,
                  r.flown_coefficient ? fmt::format("{:.3f} +- {:.3f} (computed free flight)",
                                                    *r.flown_coefficient, *r.flown_error)
                                      : std::string("not computed for this family and cloth")));
  row("nominal diameter",
      fmt::format("{:.3f} m{}, S0 {:.4g} m2", r.nominal_diameter,
                  r.handbook_diameter ? fmt::format(" ({:.2f} to {:.2f} m by the handbook)",
                                                    r.handbook_diameter->at(1), r.handbook_diameter->at(0))
                                      : "",
                  r.nominal_area));
  row("vent", fmt::format("{:.4f} m2, {:.2f} % of S0", r.vent_area, 100 * r.vent_area / r.nominal_area));
  row("gores, lines",
      fmt::format("{} gores, {} lines of {:.3f} m, {}{}", r.gores, r.line_count, r.line_length,
                  r.line_material, r.gores_source.empty() ? "" : "; " + r.gores_source));
  row("tape",
      fmt::format("{}: {}{}", r.tape_material, r.tape_source, heavy_payload_note(r.design_load_caution)));
  row("mass", fmt::format("{:.3g} kg: cloth {:.3g} kg, tape {:.3g} kg, lines {:.3g} kg", r.parachute_mass,
                          r.cloth_mass, r.tape_mass, r.line_mass));
  row("packed volume", packed_text(r.parachute_mass, r.packed_volume));
  row("DESIGN LOAD",
      fmt::format("{:.0f} N at {:.3g} m/s{}: {}; largest line load {:.2f} times the mean{}", r.design_load,
                  r.deployment_speed,
                  r.deployment_speed == usual_deployment_speed(r.descent_rate)
                      ? ", the default of --deployment-speed"
                      : "",
                  r.design_load_from, r.line_load_factor, heavy_payload_note(r.design_load_caution)));
  if (r.smallest_margin)
    row("highest design load",
        fmt::format("{:.0f} N with the uncertainty of {:.0f} % ({}): margin of safety {}, {}",
                    r.highest_design_load, 100 * r.load_uncertainty, r.load_uncertainty_from,
                    margin_text(*r.smallest_margin), r.smallest_margin_member));
  row("opening load",
      finite_mass_text(r.lowest_finite_mass_load, r.highest_finite_mass_load, r.design_load,
                       fmt::format("fills over {:.3g} D0", r.opening.front().filling_constant)));
  if (!r.opening.front().caution.empty()) row("", r.opening.front().caution);
  if (r.margins && r.highest_margins) print_margins(*r.margins, *r.highest_margins, r.design_load_caution);
  for (const SizeCheck& c : r.checks)
    row(c.basis == "descent" ? "flight" : "run",
        fmt::format("diameter {:.3f} m, rate of descent {:.3f}{} m/s, C_D {:.3f} ({})", c.nominal_diameter,
                    c.descent_rate,
                    c.descent_rate_error ? fmt::format(" +- {:.3f}", *c.descent_rate_error) : "",
                    c.drag_coefficient, c.basis));
  row("case", options.out.string());
  if (!page.empty()) row("report", page.string());
}

/// Every run of --verify has its folder next to the case file.
fs::path verify_folder(const SizeArguments& options, int run) {
  fs::path folder = options.out;
  folder.replace_extension();
  folder += fmt::format("-verify-{}", run);
  return folder;
}

fs::path page_of(const SizeArguments& options) {
  fs::path page = options.out;
  return page.replace_extension(".html");
}

/// The page is next to the case file. Returns its path, or an empty one if it could not be made, which is
/// reported.
fs::path write_page(const SizeArguments& options, const SizeResult& result) {
  const fs::path page = page_of(options);
  try {
    std::vector<fs::path> runs;
    if (!result.checks.empty()) runs.push_back(verify_folder(options, int(result.checks.size())));
    write_file(page, report_page(size_report(result, runs)));
    return page;
  } catch (const std::exception& error) {
    const auto* known = dynamic_cast<const Error*>(&error);
    if (known && known->code() == ExitCode::io) throw;
    fmt::print(stderr, "ripstop: no report was written: {}\n", error.what());
    return {};
  }
}

void refuse_existing(const SizeArguments& options) {
  if (options.force) return;
  for (const fs::path& file : {options.out, page_of(options)})
    if (fs::exists(file))
      throw Error(ExitCode::usage,
                  fmt::format("{} exists; choose another --out, or replace it with --force", file.string()));
}

/// Progress of a flight of --verify --fly.
class VerifyTerminal : public FlightObserver {
 public:
  void warned(const std::string& text) override { progress_.line("ripstop: " + text); }
  void starting(const SteadyProgress& p, const SteadyState&) override {
    progress_.show(fmt::format("equilibrium on the axis, iteration {}", p.iteration));
  }
  void advanced(FreeFlight& flight, const FreeFlightState&, const FlightHistory& history, bool) override {
    const FreeFlightRow& row = history.rows.back();
    progress_.show(fmt::format("flight, {:.2f} of {:g} s, {:.2f} m/s down, {:.1f} deg", row.time,
                               flight.problem().settings.duration_s, -row.velocity.z, row.angle));
  }

 private:
  Progress progress_;
};

FlightResult flight_of(const Settings& sized, const fs::path& folder, double duration) {
  const Settings resolved = sized_flight(sized, duration);
  VerifyTerminal terminal;
  if (const auto flown = run_flight_in({{folder, false}, resolved.coupling().threads}, resolved, terminal))
    return *flown;
  return finished_flight(folder).result;
}

int size(const SizeArguments& options) {
  if (options.fly && !options.verify)
    throw Error(ExitCode::usage, "--fly: the flights are runs of --verify; give both");
  refuse_existing(options);
  SizeResult result = run_size(options.request);
  if (options.verify) {
    goes_on_when_repeated();  // its runs do
    verify_size(options.request, result, [&](const Settings& resolved, int run) {
      const fs::path folder = verify_folder(options, run);
      if (options.fly) return VerifiedDescent(flight_of(resolved, folder, options.duration));
      SteadyTerminal terminal(folder);
      return VerifiedDescent(run_steady_in({{folder, false}, 0, {}, {}}, resolved, terminal).result);
    });
  }
  if (options.out.has_parent_path()) make_folder(options.out.parent_path());
  write_file(options.out, result.case_text);
  const fs::path page = write_page(options, result);
  if (options.json)
    fmt::print("{}", to_json(result));
  else
    print_result(result, options, page);
  print_warnings(result.warnings);
  return 0;
}

}  // namespace

void add_size(CLI::App& app, int& status) {
  auto options = std::make_shared<SizeArguments>();
  SizeRequest& r = options->request;
  CLI::App* command = app.add_subcommand(
      "size", "Design a parachute for a payload and a rate of descent and write its case file");
  command->footer(
      "The default drag coefficient is a result of Ripstop for the family (examples/families.json).\n"
      "Example: ripstop size --mass 2.4 --descent-rate 5 --family flat-circular --height 300 --out my.toml");
  add_number(*command, "--mass", r.payload_mass, key_range("payload.mass_kg"),
             "Mass of the payload, without the parachute [kg]")
      ->required();
  add_number(*command, "--descent-rate", r.descent_rate, key_range("flow.speed_m_s"),
             "Required rate of descent [m/s]")
      ->required();
  command->add_option("--family", r.family, "Canopy family: name of its example");
  auto* height = add_number(*command, "--height", r.height, from(lowest_height).up_to(highest_height),
                            "Height above sea level at which this rate is required [m]");
  add_number(*command, "--density", r.density, key_range("flow.density_kg_m3"),
             "Density of the air, instead of the height [kg/m3]")
      ->excludes(height);
  add_number(*command, "--drag-coefficient", r.drag_coefficient, key_range("inflation.drag_coefficient"),
             "Drag coefficient on S0")
      ->default_str("value computed for the family");
  add_choice<DragReference>(*command, "--drag-coefficient-on", r.drag_coefficient_on,
                            {{"nominal", DragReference::nominal}, {"projected", DragReference::projected}},
                            "Reference area of --drag-coefficient: nominal (S0), or projected (circle of the "
                            "open canopy, as stated by makers)");
  add_number(*command, "--deployment-speed", r.deployment_speed, key_range("payload.deployment_speed_m_s"),
             "Airspeed at line stretch, for the opening load and the case [m/s]")
      ->default_str(fmt::format("the larger of {:g} m/s and {:g} times the rate of descent",
                                least_deployment_speed, deployment_over_descent));
  command->add_option("--line-material", r.line_material, "Line material of the library")
      ->default_str("the lightest with sufficient strength");
  add_number(*command, "--packing-density", r.packing_density, from(50).up_to(1500),
             "Density of the packed parachute, 250 (loose) to 400 by hand, 600 with a press [kg/m3]");
  command->add_flag("--verify", options->verify,
                    "Run the case and adjust the diameter until the rate of descent is met within 1 %");
  command->add_flag("--fly", options->fly, "With --verify: free flights instead of steady runs on the axis");
  add_number(*command, "--duration", options->duration, key_range("flight.duration_s"),
             "Duration of each flight of --fly [s]");
  add_choice<DragBasis>(
      *command, "--coefficient", r.basis,
      {{"safe", DragBasis::safe}, {"axial", DragBasis::axial}, {"descent", DragBasis::descent}},
      "Drag coefficient of the family: axial (steady flow), descent (free flight), or safe (the smaller "
      "one)");
  command->add_option("--out", options->out, "Case file");
  command->add_flag("--force", options->force, "Replace an existing case file");
  add_units_option(*command);
  add_json_option(*command, options->json);
  command->callback([options, &status] { status = size(*options); });
}

}  // namespace ripstop::cli

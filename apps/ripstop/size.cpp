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
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/run/sizing/size_report.h"
#include "ripstop/run/steady/steady_folder.h"
#include "steady_terminal.h"
#include "stopping.h"
#include "warnings.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

struct SizeArguments {
  SizeRequest request;
  fs::path out = "my-canopy.toml";
  bool verify = false, json = false, force = false;
};

void print_result(const SizeResult& r, const fs::path& file, const fs::path& page) {
  const auto row = [](const char* name, const std::string& text) { fmt::print("  {:<20} {}\n", name, text); };
  fmt::print("{}\n", r.given.title);
  row("air", fmt::format("{:.4g} kg/m3", r.density));
  row("drag coefficient",
      fmt::format("{:.3f} on S0, {}{}", r.drag_coefficient, r.drag_source,
                  r.handbook_drag_coefficient
                      ? fmt::format("; Knacke {:.2f} to {:.2f}", r.handbook_drag_coefficient->at(0),
                                    r.handbook_drag_coefficient->at(1))
                      : ""));
  row("nominal diameter",
      fmt::format("{:.3f} m{}, S0 {:.4g} m2", r.nominal_diameter,
                  r.handbook_diameter ? fmt::format(" ({:.2f} to {:.2f} by the handbook)",
                                                    r.handbook_diameter->at(1), r.handbook_diameter->at(0))
                                      : "",
                  r.nominal_area));
  row("vent", fmt::format("{:.4f} m2, {:.2f} %", r.vent_area, 100 * r.vent_area / r.nominal_area));
  row("gores, lines",
      fmt::format("{} gores, {} lines of {:.3f} m, {}{}", r.gores, r.line_count, r.line_length,
                  r.line_material, r.gores_source.empty() ? "" : "; " + r.gores_source));
  row("tape", fmt::format("{}: {}", r.tape_material, r.tape_source));
  row("mass", fmt::format("{:.3g} kg: cloth {:.3g}, tape {:.3g}, lines {:.3g}", r.parachute_mass,
                          r.cloth_mass, r.tape_mass, r.line_mass));
  row("packed volume", fmt::format("{:.3g} litres", 1000 * r.packed_volume));
  row("DESIGN LOAD", fmt::format("{:.0f} N at {:.3g} m/s: {}; largest line load {:.2f} times the mean, "
                                 "{:.0f} % of the allowable load",
                                 r.design_load, r.deployment_speed, r.design_load_from, r.line_load_factor,
                                 100 * r.line_used));
  row("applicable methods",
      fmt::format("{:.0f} to {:.0f} N (ripstop load)", r.opening_load_low, r.opening_load));
  if (!r.opening.front().caution.empty()) row("", r.opening.front().caution);
  print_margins(r.margins);
  for (const SizeCheck& c : r.checks)
    row("run", fmt::format("diameter {:.3f} m, descent rate {:.3f} m/s, C_D {:.3f}", c.nominal_diameter,
                           c.descent_rate, c.drag_coefficient));
  row("case", file.string());
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

int size(const SizeArguments& options) {
  refuse_existing(options);
  SizeResult result = run_size(options.request);
  if (options.verify) {
    goes_on_when_repeated();  // its runs do
    verify_size(options.request, result, [&](const Settings& resolved, int run) {
      const fs::path folder = verify_folder(options, run);
      SteadyTerminal terminal(folder);
      return run_steady_in({{folder, false}, 0, {}, {}}, resolved, terminal).result;
    });
  }
  if (options.out.has_parent_path()) make_folder(options.out.parent_path());
  write_file(options.out, result.case_text);
  const fs::path page = write_page(options, result);
  if (options.json)
    fmt::print("{}", to_json(result));
  else
    print_result(result, options.out, page);
  print_warnings(result.warnings);
  return 0;
}

}  // namespace

void add_size(CLI::App& app, int& status) {
  auto options = std::make_shared<SizeArguments>();
  SizeRequest& r = options->request;
  CLI::App* command = app.add_subcommand(
      "size", "Design a parachute for a payload and a descent rate and write its case file");
  command->footer(
      "The default drag coefficient is a result of Ripstop for the family (examples/families.json).\n"
      "Example: ripstop size --mass 2.4 --descent-rate 5 --family flat-circular --height 300 --out my.toml");
  add_number(*command, "--mass", r.payload_mass, key_range("payload.mass_kg"),
             "Mass of the payload, without the parachute [kg]")
      ->required();
  add_number(*command, "--descent-rate", r.descent_rate, key_range("flow.speed_m_s"),
             "Required descent rate [m/s]")
      ->required();
  command->add_option("--family", r.family, "Canopy family, a folder of examples/ (default: flat-circular)");
  auto* height = add_number(*command, "--height", r.height, from(lowest_height).up_to(highest_height),
                            "Height above sea level at which this rate is required [m] (default: 0)");
  add_number(*command, "--density", r.density, key_range("flow.density_kg_m3"),
             "Density of the air, instead of the height [kg/m3]")
      ->excludes(height);
  add_number(*command, "--drag-coefficient", r.drag_coefficient, key_range("inflation.drag_coefficient"),
             "Drag coefficient on S0 (default: value computed for the family)");
  command
      ->add_option_function<std::string>(
          "--drag-coefficient-on",
          [&r](const std::string& area) {
            r.drag_coefficient_on = area == "projected" ? DragReference::projected : DragReference::nominal;
          },
          "Area of --drag-coefficient: nominal (S0), or projected (the circle of the open canopy, as makers "
          "state "
          "it)")
      ->check(CLI::IsMember({"nominal", "projected"}));
  add_number(
      *command, "--deployment-speed", r.deployment_speed, above(0).up_to(1000),
      "Speed at deployment, for the opening load [m/s] (default: 20, at least 3 times the descent rate)");
  command->add_option("--line-material", r.line_material,
                      "Line material of the library (default: the lightest with sufficient strength)");
  add_number(*command, "--packing-density", r.packing_density, from(50).up_to(1500),
             "Density of the packed parachute [kg/m3] (default: 400, packed by hand)");
  command->add_flag("--verify", options->verify,
                    "Run the case and adjust the diameter until the descent rate is met within 1 %");
  command->add_option("--out", options->out, "Case file (default: my-canopy.toml)");
  command->add_flag("--force", options->force, "Replace an existing case file");
  add_json_option(*command, options->json);
  command->callback([options, &status] { status = size(*options); });
}

}  // namespace ripstop

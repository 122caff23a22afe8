// ripstop calibrate porosity: the cloth's porosity from the measured drag of a reference parachute.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "case_options.h"
#include "commands.h"
#include "number_option.h"
#include "option.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/plot.h"
#include "ripstop/run/sweep/porosity_sweep.h"
#include "ripstop/run/sweep/sweep_files.h"
#include "sweep_progress.h"
#include "table_options.h"
#include "warnings.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

// [NFM] section on porosity, Stratos IV: C_D = -1.7794 gamma + 0.9195, R2 = 0.989.
constexpr double printed_slope = -1.7794, printed_intercept = 0.9195;

struct PorosityArguments : SweepOptions {
  fs::path measured;
  std::string columns, decimal = "auto";
  std::vector<double> gammas = {0.18, 0.2, 0.22, 0.24}, permeabilities;
  double thickness = PorositySweep().thickness;
  int shifts = PorositySweep().shifts;
};

PorosityKnob knob_of(const PorosityArguments& options) {
  return options.permeabilities.empty() ? PorosityKnob::gamma : PorosityKnob::permeability;
}

/// The file's points, or the rows of [[measured]] that have a drag, on the case's basis.
std::vector<MeasuredDrag> measured_points(const PorosityArguments& options, const Settings& resolved) {
  if (options.measured.empty()) {
    const std::vector<MeasuredDrag> points = measured_drag(resolved);
    if (points.empty())
      throw Error(
          ExitCode::usage,
          "no measured drag: give --measured FILE with the columns speed_m_s, density_kg_m3, drag_n, or "
          "drag_n in rows of [[measured]]");
    return points;
  }
  const MeasuredFile measured = read_measured_drag(options.measured, table::parse_columns(options.columns),
                                                   table::parse_decimal(options.decimal));
  for (const std::string& line : measured.understood) fmt::print(stderr, "{}\n", line);
  return measured.points;
}

void write_plots(const fs::path& folder, const Settings& resolved, const std::vector<MeasuredDrag>& measured,
                 const std::vector<PorosityTrial>& trials, const PorosityCalibration& found,
                 PorosityKnob knob, double area) {
  PlotSeries computed{"computed, every speed and grid alignment", {}, {}, false, true, false};
  double low = found.knob, high = found.knob;
  for (const PorosityTrial& t : trials) {
    computed.x.push_back(t.knob);
    computed.y.push_back(t.drag_area / area);
    low = std::min(low, t.knob);
    high = std::max(high, t.knob);
  }
  PlotSeries line{fmt::format("C_D = {:.4f} {:+.4f} x, R\u00b2 = {:.3f}", found.coefficient.intercept,
                              found.coefficient.slope, found.coefficient.r2),
                  {},
                  {},
                  true,
                  false,
                  false};
  PlotSeries band{"95 % confidence band", {}, {}, true, false, true};  // both edges, a gap between them
  PlotSeries printed{"[NFM], Stratos IV: 0.9195 - 1.7794 \u03b3", {}, {}, true, false, true};
  constexpr int steps = 40;
  const auto x_of = [&](int i) { return low + (high - low) * i / steps; };
  for (int i = 0; i <= steps; ++i) {
    line.x.push_back(x_of(i));
    line.y.push_back(found.coefficient.at(x_of(i)));
    printed.x.push_back(x_of(i));
    printed.y.push_back(printed_intercept + printed_slope * x_of(i));
  }
  for (const int side : {1, -1}) {
    for (int i = 0; i <= steps; ++i) {
      band.x.push_back(x_of(i));
      band.y.push_back(found.coefficient.at(x_of(i)) + side * found.coefficient.band(x_of(i)));
    }
    band.x.push_back(NAN);
    band.y.push_back(NAN);
  }
  PlotSeries reference{"measured, at the fitted value", {}, {}, false, true, false};
  for (const MeasuredDrag& point : measured) {
    reference.x.push_back(found.knob);
    reference.y.push_back(point.drag_area() / area);
  }
  const bool gamma = knob == PorosityKnob::gamma;
  Plot plot{resolved.title(),
            {gamma ? "porosity \u03b3 of Ergun's law" : "permeability [CFM/ft\u00b2]"},
            {fmt::format("drag coefficient C_D on {:.4f} m\u00b2", area)},
            {computed, line, band, reference}};
  if (gamma) plot.series.push_back(printed);
  for (const char* name : {"porosity.svg", "porosity.png"}) write_plot(folder / name, plot);
}

ordered_json line_json(const LineFit& line) {
  return {{"slope", line.slope},
          {"intercept", line.intercept},
          {"r2", line.r2},
          {"slope_error", line.slope_error},
          {"intercept_error", line.intercept_error},
          {"scatter", line.scatter},
          {"points", line.points}};
}

void write_result(const fs::path& folder, const Settings& resolved, const std::vector<MeasuredDrag>& measured,
                  const PorosityCalibration& found, PorosityKnob knob, const PressureDrop& law,
                  const PorosityArguments& options, double area, const std::vector<std::string>& warnings) {
  ordered_json j;
  j["title"] = resolved.title();
  j["knob"] = knob_name(knob);
  j["value"] = found.knob;
  j["standard_error"] = found.error();
  j["standard_error_measured"] = found.error_measured;
  j["standard_error_computed"] = found.error_computed;
  j["interval_95"] = {found.knob - found.interval, found.knob + found.interval};
  j["material"] = resolved.parachute().canopy_material;
  const auto [linear, quadratic] = resistance_keys(resolved.flow().porosity_model);
  j[linear] = law.linear;
  j[quadratic] = law.quadratic;
  if (knob == PorosityKnob::gamma) {
    j["thickness_m"] = options.thickness;
    j["printed_fit"] = {{"slope", printed_slope}, {"intercept", printed_intercept}, {"r2", 0.989}};
  }
  j["reference_area_m2"] = area;
  j["drag_coefficient_fit"] = line_json(found.coefficient);
  j["root_mean_square_misfit"] = found.misfit;
  j["shift_scatter"] = found.shift_scatter;
  j["outside_the_trials"] = found.outside;
  j["points"] = ordered_json::array();
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const MeasuredDrag& m = measured[i];
    j["points"].push_back({{"nominal_speed_m_s", m.nominal_speed},
                           {"speed_m_s", m.speed},
                           {"density_kg_m3", m.density},
                           {"measured_drag_n", m.drag},
                           {"measured_drag_area_m2", m.drag_area()},
                           {"computed_drag_area_m2", found.computed[i]},
                           {"drag_area_fit", line_json(found.lines[i])}});
  }
  j["warnings"] = warnings;
  write_file(folder / "result.json", j.dump(2) + "\n");
}

void print_result(const std::vector<MeasuredDrag>& measured, const PorosityCalibration& found,
                  PorosityKnob knob, const PressureDrop& law, const Settings& resolved) {
  const LineFit& c = found.coefficient;
  fmt::print("\nC_D = {:.4f} {:+.4f} x with x = {}, R2 = {:.4f}, {} computed points ", c.intercept, c.slope,
             knob_name(knob), c.r2, c.points);
  if (knob == PorosityKnob::gamma) fmt::print("([NFM], Stratos IV: 0.9195 -1.7794 x, R2 = 0.989)");
  fmt::print("\nscatter over the grid alignments: {:.2f} % (rms)\n\n", 100 * found.shift_scatter);
  fmt::print("{:>12} {:>14} {:>14} {:>8}\n", "nominal m/s", "measured m2", "computed m2", "error");
  for (std::size_t i = 0; i < measured.size(); ++i)
    fmt::print("{:>12g} {:>14.4f} {:>14.4f} {:>+7.2f} %\n", measured[i].nominal_speed,
               measured[i].drag_area(), found.computed[i],
               100 * (found.computed[i] / measured[i].drag_area() - 1));
  fmt::print(
      "\n{} = {:.5g} +- {:.2g} (standard error: {:.2g} from the measured points, {:.2g} from the computed "
      "points)\n",
      knob_name(knob), found.knob, found.error(), found.error_measured, found.error_computed);
  const auto [linear, quadratic] = resistance_keys(resolved.flow().porosity_model);
  fmt::print(
      "  for other parachutes of this cloth: --set materials.{0}.{1}={2:.10g} --set "
      "materials.{0}.{3}={4:.10g}\n",
      resolved.parachute().canopy_material, linear, law.linear, quadratic, law.quadratic);
}

int calibrate(PorosityArguments& options) {
  finish(options, "porosity");
  const Settings resolved = read_settings(options.case_file, options.overrides);
  PorositySweep sweep{knob_of(options), options.gammas, options.thickness, options.shifts};
  if (sweep.knob == PorosityKnob::permeability) sweep.values = options.permeabilities;
  std::sort(sweep.values.begin(), sweep.values.end());
  require_slope(sweep);
  const PorosityKnob knob = sweep.knob;
  const std::vector<MeasuredDrag> measured = measured_points(options, resolved);
  const std::vector<SweepAxis> axes = porosity_axes(resolved, sweep, measured);
  const std::vector<SweepPoint> points = sweep_points(options.case_file, options.overrides, axes);
  const fs::path& folder = options.settings.folder;
  fmt::print(stderr, "{}: {} measured points, {} = {}, {} grid alignments: {} runs in {}\n", resolved.title(),
             measured.size(), knob_name(knob), fmt::join(sweep.values, " "), sweep.shifts, points.size(),
             folder.string());
  const std::vector<SweepRow> rows = run_and_tell(axes, points, options.settings);
  write_csv(folder / "sweep.csv", sweep_table(axes, points, rows));
  const std::vector<std::string> warnings = sweep_warnings(points, rows);
  print_warnings(warnings);
  require_all(points, rows);

  const std::vector<PorosityTrial> trials = porosity_trials(resolved, sweep, rows);
  const double area = rows.front().result.reference_area;
  const PorosityCalibration found = calibrate_porosity(measured, trials, area);
  const PressureDrop law = cloth_of(knob, found.knob, options.thickness);
  write_plots(folder, resolved, measured, trials, found, knob, area);
  write_result(folder, resolved, measured, found, knob, law, options, area, warnings);
  seal_sweep(folder);
  if (options.json) {
    fmt::print("{}", read_file(folder / "result.json"));
  } else {
    print_result(measured, found, knob, law, resolved);
    fmt::print("  {} (porosity.svg, porosity.png, sweep.csv)\n", (folder / "result.json").string());
  }
  if (!found.outside) return 0;
  fmt::print(stderr, "the fitted {} is outside the computed range: extend --gammas or --permeabilities\n",
             knob_name(knob));
  return static_cast<int>(ExitCode::not_converged);
}

}  // namespace

void add_calibrate_porosity(CLI::App& parent, int& status) {
  auto options = std::make_shared<PorosityArguments>();
  CLI::App* command = parent.add_subcommand(
      "porosity", "Determine the porosity of the cloth from the measured drag of a reference parachute");
  command->footer(
      "The file of --measured is a table with the columns speed_m_s, density_kg_m3 and drag_n; one row is "
      "enough.\n"
      "An interrupted calibration resumes when the command is repeated. For other parachutes of the same "
      "cloth use\nthe two --set options that it prints.\n"
      "Example: ripstop calibrate porosity examples/stratos-iv/case.toml --gammas 0.18,0.20,0.22,0.24 "
      "--shifts 3");
  add_sweep_options(*command, *options);
  add_existing_file(*command, "--measured", options->measured, "Measured points (CSV)")
      ->default_str("the rows of [[measured]] with a drag, at the speed_basis of the case");
  add_table_options(*command, options->columns, options->decimal, "speed=v [m/s],drag=Widerstand [N]");
  CLI::Option* gammas = add_numbers(*command, "--gammas", options->gammas, from(0.01).up_to(0.99),
                                    "Values of Ergun's porosity");
  add_numbers(*command, "--permeabilities", options->permeabilities, from(1e-3).up_to(9999),
              "Instead: values of the permeability [CFM/ft2 at half an inch of water], with b = 0 in dp = a "
              "v + b v |v|")
      ->excludes(gammas);
  add_number(*command, "--thickness", options->thickness, above(0).up_to(0.1),
             "Thickness of the cloth in Ergun's law; its default reproduces a and b of [NFM] in dp = a v + b "
             "v |v| [m]");
  add_number(*command, "--shifts", options->shifts, from(1).up_to(100),
             "Number of grid alignments along the flow that are averaged");
  command->add_option("--out", options->settings.folder, "Folder")
      ->default_str("runs/<name of the case>-porosity");
  command->callback([options, &status] { status = calibrate(*options); });
}

}  // namespace ripstop::cli

// ripstop compare: the nonlinear model beside the linear one, and where their difference comes from.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/coupling/profile.h"
#include "ripstop/output/plot.h"
#include "ripstop/run/steady_run.h"
#include "ripstop/run/sweep_files.h"
#include "sweep_progress.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct Options : SweepOptions {
  bool linear = false;
};

template <class Kind>
std::vector<Setting> only_first(const Kind& material, const std::vector<double>& coefficients,
                                const char* key) {
  return {{fmt::format("materials.{}.{}", material.name, key), fmt::format("[{}]", coefficients.front()),
           "--linear"}};
}

std::vector<Setting> linear_cloth(const Case& value) {
  const Fabric& cloth = canopy_fabric(value);
  std::vector<Setting> settings = only_first(cloth, cloth.coefficients_n_m, "coefficients_n_m");
  if (!cloth.weft_coefficients_n_m.empty()) {
    const auto weft = only_first(cloth, cloth.weft_coefficients_n_m, "weft_coefficients_n_m");
    settings.insert(settings.end(), weft.begin(), weft.end());
  }
  return settings;
}

std::vector<Setting> linear_lines(const Case& value) {
  const Line &line = suspension_line(value), &riser = riser_line(value);
  std::vector<Setting> settings = only_first(line, line.coefficients_n, "coefficients_n");
  if (riser.name != line.name) {
    const auto other = only_first(riser, riser.coefficients_n, "coefficients_n");
    settings.insert(settings.end(), other.begin(), other.end());
  }
  return settings;
}

/// All laws, and each of them alone, cut to K_1. The first is the case as it is.
SweepAxis models(const Case& value) {
  const Tape& tape = reinforcement_tape(value);
  return {"model",
          {"nonlinear", "linear", "linear cloth", "linear lines", "linear tape"},
          {{},
           {{"coupling.linear", "true", "--linear"}},
           linear_cloth(value),
           linear_lines(value),
           only_first(tape, tape.coefficients_n_m, "coefficients_n_m")}};
}

struct Shape {
  std::vector<ProfileRing> profile;
  std::map<std::string, Strains> strains;
};

Shape shape_of(const SweepPoint& point, const fs::path& folder) {
  const Mesh mesh = parachute_mesh(point.value);
  const SteadyState state = final_state(folder / point.folder);
  return {canopy_profile(mesh, state.shape), part_strains(mesh, state.shape)};
}

/// Greatest change of the half diameter of any row of nodes [m].
double profile_change(const Shape& a, const Shape& b) {
  double change = 0;
  for (std::size_t i = 0; i < std::min(a.profile.size(), b.profile.size()); ++i)
    change = std::max(change, std::abs(a.profile[i].diameter - b.profile[i].diameter) / 2);
  return change;
}

void write_profiles(const fs::path& folder, const std::string& title, const std::vector<Shape>& shapes) {
  Plot plot{title, {"distance from the skirt [m]"}, {"radius [m]", false, 0.0}, {}};
  CsvTable table{{"patch", "row", "nonlinear_z_m", "nonlinear_diameter_m", "linear_z_m", "linear_diameter_m"},
                 {}};
  for (const std::size_t k : {0, 1}) {
    PlotSeries series{k ? "linear" : "nonlinear", {}, {}, true, false, k == 1};
    int patch = 0;
    for (const ProfileRing& ring : shapes[k].profile) {
      if (ring.patch != patch) {
        series.x.push_back(NAN);
        series.y.push_back(NAN);
        patch = ring.patch;
      }
      series.x.push_back(ring.z);
      series.y.push_back(ring.diameter / 2);
    }
    plot.series.push_back(series);
  }
  for (std::size_t i = 0; i < shapes[0].profile.size(); ++i) {
    const ProfileRing &a = shapes[0].profile[i], &b = shapes[1].profile[i];
    table.rows.push_back({double(a.patch), double(a.row), a.z, a.diameter, b.z, b.diameter});
  }
  write_csv(folder / "profile.csv", table);
  if (shapes[0].profile.empty()) return;
  for (const char* name : {"profile.svg", "profile.png"}) write_plot(folder / name, plot);
}

ordered_json model_json(const std::string& model, const SweepRow& row, const SweepRow& first,
                        const Shape& shape, const Shape& first_shape) {
  ordered_json j{{"model", model},
                 {"drag_n", row.drag},
                 {"drag_area_m2", row.drag_area},
                 {"drag_difference", row.drag / first.drag - 1},
                 {"projected_diameter_m", row.projected_diameter},
                 {"skirt_diameter_m", row.skirt_diameter},
                 {"canopy_length_m", row.length},
                 {"largest_profile_change_m", profile_change(shape, first_shape)},
                 {"coupling_iterations", row.iterations},
                 {"wall_time_s", row.wall_time}};
  for (const auto& [part, strain] : shape.strains)
    j["strain"][part] = {{"mean", strain.mean}, {"largest", strain.largest}};
  return j;
}

void print(const SweepAxis& axis, const std::vector<SweepRow>& rows, const std::vector<Shape>& shapes) {
  fmt::print("\n{:<14} {:>9} {:>9} {:>10} {:>9} {:>10} {:>10} {:>10}\n", "", "drag N", "change", "diameter m",
             "shape mm", "lines", "tape", "cloth");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto strain = [&](const char* part) {
      const auto found = shapes[i].strains.find(part);
      return found == shapes[i].strains.end() ? std::string("-")
                                              : fmt::format("{:.4f} %", 100 * found->second.mean);
    };
    fmt::print("{:<14} {:>9.3f} {:>7.3f} % {:>10.4f} {:>9.3f} {:>10} {:>10} {:>10}\n", axis.values[i],
               rows[i].drag, 100 * (rows[i].drag / rows[0].drag - 1), rows[i].projected_diameter,
               1000 * profile_change(shapes[i], shapes[0]), strain("lines"), strain("tape"), strain("cloth"));
  }
  const SweepRow &a = rows[0], &b = rows[1];
  const double area = 2 * std::log(b.projected_diameter / a.projected_diameter);
  const double all = std::log(b.drag / a.drag),
               alone = rows[2].drag + rows[3].drag + rows[4].drag - 3 * a.drag;
  fmt::print("\nlinear - nonlinear: {:+.3f} N ({:+.3f} %)\n", b.drag - a.drag, 100 * (b.drag / a.drag - 1));
  fmt::print(
      "  each material alone: cloth {:+.3f}, lines {:+.3f}, tape {:+.3f} N; together beyond their sum "
      "{:+.3f} N\n",
      rows[2].drag - a.drag, rows[3].drag - a.drag, rows[4].drag - a.drag, b.drag - a.drag - alone);
  fmt::print("  by projected area {:+.3f} %, by drag per projected area {:+.3f} %\n", 100 * area,
             100 * (all - area));
  fmt::print("  strains are means over the springs of each part\n");
}

int compare(Options& options) {
  finish(options, "compare");
  // The neighbour's flow field would hide a difference smaller than the residual: every run starts cold.
  options.settings.warm = false;
  const Case value = read_case(options.case_file, options.overrides);
  if (value.coupling.linear)
    throw Error(ExitCode::usage, "the case is linear itself (coupling.linear = true): nothing to compare");
  const SweepAxis axis = models(value);
  const std::vector<SweepPoint> points = sweep_points(options.case_file, options.overrides, {axis});
  const fs::path& folder = options.settings.folder;
  const std::vector<SweepRow> rows = run_and_tell({axis}, points, options.settings);
  write_csv(folder / "sweep.csv", sweep_table({axis}, points, rows));
  require_all(points, rows);
  std::vector<Shape> shapes;
  ordered_json j;
  j["title"] = value.title;
  j["drag_tolerance"] = resolve(value).coupling.drag_tolerance;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    shapes.push_back(shape_of(points[i], folder));
    j["models"].push_back(model_json(axis.values[i], rows[i], rows[0], shapes[i], shapes[0]));
  }
  if (const Measured* row = measured_row(value)) {
    if (row->drag_n) j["measured_drag_n"] = *row->drag_n;
    if (row->printed_nonlinear_n) j["printed_nonlinear_n"] = *row->printed_nonlinear_n;
    if (row->printed_linear_n) j["printed_linear_n"] = *row->printed_linear_n;
  }
  write_profiles(folder, value.title, shapes);
  write_file(folder / "result.json", j.dump(2) + "\n");
  fmt::print("{}, {:.4g} m/s", value.title, air(value).speed);
  print(axis, rows, shapes);
  fmt::print("{} (profile.svg, profile.png, profile.csv, sweep.csv)\n", (folder / "result.json").string());
  return 0;
}

}  // namespace

void add_compare(CLI::App& app, int& status) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("compare", "Two models of one case side by side");
  command->footer(
      "Runs the case as it is, with K_1 alone for every material, and with K_1 alone for the cloth, the "
      "lines and\n"
      "the tape in turn.\n"
      "Example: ripstop compare examples/stratos-iv/case.toml --linear --speed 30");
  add_sweep_options(*command, *options);
  command->add_option("--speed", options->overrides.speed, "Nominal speed [m/s]");
  command->add_flag("--linear", options->linear, "Against the linear model, which keeps only K_1")
      ->required();
  command->add_option("--out", options->settings.folder,
                      "Folder (default: runs/<folder of the case>-compare)");
  command->callback([options, &status] { status = compare(*options); });
}

}  // namespace ripstop

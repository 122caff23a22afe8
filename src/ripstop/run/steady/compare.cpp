#include "ripstop/run/steady/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ripstop/case/assemble.h"
#include "ripstop/case/cluster.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/plot.h"
#include "ripstop/run/json.h"

namespace ripstop::inline run {
namespace {

template <class Kind>
std::vector<Setting> only_first(const Kind& material, const std::vector<double>& coefficients,
                                const char* key) {
  return {{fmt::format("materials.{}.{}", material.name, key), fmt::format("[{}]", coefficients.front()),
           "--linear"}};
}

std::vector<Setting> linear_cloth(const Settings& resolved) {
  const Fabric& cloth = resolved.materials().canopy;
  std::vector<Setting> settings = only_first(cloth, cloth.coefficients_n_m, "coefficients_n_m");
  if (!cloth.weft_coefficients_n_m.empty()) {
    const auto weft = only_first(cloth, cloth.weft_coefficients_n_m, "weft_coefficients_n_m");
    settings.insert(settings.end(), weft.begin(), weft.end());
  }
  return settings;
}

std::vector<Setting> linear_lines(const Settings& resolved) {
  const Line &line = resolved.materials().line, &riser = resolved.materials().riser;
  std::vector<Setting> settings = only_first(line, line.coefficients_n, "coefficients_n");
  if (riser.name != line.name) {
    const auto other = only_first(riser, riser.coefficients_n, "coefficients_n");
    settings.insert(settings.end(), other.begin(), other.end());
  }
  return settings;
}

double profile_change(const ComparedModel& a, const ComparedModel& b) {
  double change = 0;
  for (std::size_t i = 0; i < std::min(a.profile.size(), b.profile.size()); ++i)
    change = std::max(change, std::abs(a.profile[i].diameter - b.profile[i].diameter) / 2);
  return change;
}

ComparedModel model_of(const SweepPoint& point, const SteadyResult& result, const SteadyState& end) {
  const CanopyMesh mesh = parachute_mesh(point.resolved);
  ComparedModel m;
  m.model = point.values.front();
  m.drag = result.drag;
  m.drag_area = result.drag_area;
  m.projected_diameter = result.size.projected_diameter;
  m.skirt_diameter = result.size.skirt_diameter;
  m.length = result.size.length;
  m.iterations = result.iterations;
  m.wall_time = result.wall_time;
  m.strain = part_strains(mesh, end.shape);
  m.profile = canopy_profile(mesh, end.shape);
  return m;
}

}  // namespace

SweepAxis linear_models(const Settings& resolved) {
  require_one_canopy(resolved, "a comparison of material models");
  if (resolved.coupling().linear)
    throw Error(ExitCode::usage,
                "the case is already linear (coupling.linear = true); remove the key to compare the models");
  SweepAxis axis{
      "model",
      {"nonlinear", "linear", "linear cloth", "linear lines"},
      {{}, {{"coupling.linear", "true", "--linear"}}, linear_cloth(resolved), linear_lines(resolved)}};
  if (const std::optional<Tape>& tape = resolved.materials().tape) {
    axis.values.push_back("linear tape");
    axis.settings.push_back(only_first(*tape, tape->coefficients_n_m, "coefficients_n_m"));
  }
  return axis;
}

std::string to_json(const Comparison& comparison) {
  return json_text(comparison);
}

Comparison compare_models(const std::vector<SweepPoint>& points, const std::vector<SweepRow>& rows,
                          const std::function<SteadyState(std::size_t)>& end_of) {
  const Settings& resolved = points.front().resolved;
  Comparison c;
  c.title = resolved.title();
  c.speed = resolved.flow().speed_m_s;
  c.drag_tolerance = resolved.coupling().drag_tolerance;
  for (std::size_t i = 0; i < points.size(); ++i) {
    ComparedModel model = model_of(points[i], rows[i].result, end_of(i));
    const ComparedModel& first = c.models.empty() ? model : c.models.front();
    model.drag_difference = model.drag / first.drag - 1;
    model.profile_change = profile_change(model, first);
    c.models.push_back(std::move(model));
  }
  const ComparedModel &a = c.models.at(0), &b = c.models.at(1);
  c.beyond_sum = b.drag - a.drag;
  for (std::size_t i = 2; i < c.models.size(); ++i) c.beyond_sum -= c.models[i].drag - a.drag;
  c.by_projected_area = 2 * std::log(b.projected_diameter / a.projected_diameter);
  c.by_drag_per_area = std::log(b.drag / a.drag) - c.by_projected_area;
  if (const std::optional<Measured>& row = resolved.measured_row()) {
    c.measured_drag = row->drag_n;
    c.printed_nonlinear = row->printed_nonlinear_n;
    c.printed_linear = row->printed_linear_n;
  }
  c.warnings = sweep_warnings(points, rows);
  return c;
}

void write_comparison(const std::filesystem::path& folder, const Comparison& comparison) {
  make_folder(folder);
  const std::vector<ProfileRing>&nonlinear = comparison.models.at(0).profile,
        &linear = comparison.models.at(1).profile;
  Plot plot{comparison.title, {"distance from the skirt [m]"}, {"radius [m]", false, 0.0}, {}};
  for (const auto* profile : {&nonlinear, &linear}) {
    const bool dashed = profile == &linear;
    PlotSeries series{dashed ? "linear" : "nonlinear", {}, {}, true, false, dashed};
    int patch = 0;
    for (const ProfileRing& ring : *profile) {
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
  CsvTable table{{"patch", "row", "nonlinear_z_m", "nonlinear_diameter_m", "linear_z_m", "linear_diameter_m"},
                 {}};
  for (std::size_t i = 0; i < nonlinear.size(); ++i) {
    const ProfileRing &a = nonlinear[i], &b = linear[i];
    table.rows.push_back({double(a.patch), double(a.row), a.z, a.diameter, b.z, b.diameter});
  }
  write_csv(folder / "profile.csv", table);
  if (!nonlinear.empty())
    for (const char* name : {"profile.svg", "profile.png"}) write_plot(folder / name, plot);
  write_file(folder / "result.json", to_json(comparison));
}

}  // namespace ripstop::inline run

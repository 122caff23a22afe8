#include "ripstop/run/sweep/porosity_sweep.h"

#include <fmt/format.h>

#include <algorithm>

#include "ripstop/case/settings.h"
#include "ripstop/core/error.h"

namespace ripstop::inline run {

std::vector<MeasuredDrag> measured_drag(const Settings& resolved) {
  std::vector<MeasuredDrag> points;
  for (const Measured& row : resolved.measured()) {
    if (!row.drag_n) continue;
    const bool nominal = resolved.flow().speed_basis == SpeedBasis::nominal;
    points.push_back({row.nominal_speed_m_s, nominal ? row.nominal_speed_m_s : row.measured_speed_m_s,
                      row.density_kg_m3, *row.drag_n});
  }
  return points;
}

MeasuredFile read_measured_drag(const std::filesystem::path& file,
                                const std::vector<table::ColumnChoice>& columns, table::Decimal decimal) {
  using table::Quantity;
  const table::Table all = table::read_table(
      file, {{Quantity::speed, Quantity::density, Quantity::drag, Quantity::force}, columns, decimal});
  if (all.specimens.size() > 1)
    throw Error(ExitCode::bad_data, fmt::format("{}:{}: a second table begins here; the measured drag must "
                                                "be one table of speed, density and drag",
                                                file.string(), all.specimens[1].header_line));
  const table::Specimen& rows = all.specimens.front();
  const std::vector<double>& speed = need_only(all, rows, Quantity::speed).values;
  const std::vector<double>& density = need_only(all, rows, Quantity::density).values;
  const bool named = !rows.all(Quantity::drag).empty() || rows.all(Quantity::force).empty();
  const std::vector<double>& drag = need_only(all, rows, named ? Quantity::drag : Quantity::force).values;
  MeasuredFile measured{{}, explanation(all)};
  for (std::size_t i = 0; i < speed.size(); ++i) {
    if (!(speed[i] > 0) || !(density[i] > 0) || !(drag[i] > 0))
      throw Error(ExitCode::bad_data,
                  fmt::format("{}:{}: speed {:g} m/s, density {:g} kg/m3, drag {:g} N: each must be above 0",
                              file.string(), rows.lines[i], speed[i], density[i], drag[i]));
    measured.points.push_back({speed[i], speed[i], density[i], drag[i]});
  }
  return measured;
}

std::string knob_name(PorosityKnob knob) {
  return knob == PorosityKnob::gamma ? "gamma" : "permeability_cfm";
}

std::vector<double> cell_shifts(const Settings& resolved, int shifts) {
  const double cell = flow_grid(resolved.flow()).spacing().z;
  std::vector<double> all;
  for (int k = 0; k < shifts; ++k) all.push_back(cell * (k - 0.5 * (shifts - 1)) / shifts);
  return all;
}

void require_slope(const PorositySweep& sweep) {
  if (sweep.values.size() < 2)
    throw Error(ExitCode::usage,
                "one value of the porosity determines no slope: give two or more, separated by commas");
}

std::vector<SweepAxis> porosity_axes(const Settings& resolved, const PorositySweep& sweep,
                                     const std::vector<MeasuredDrag>& measured) {
  SweepAxis condition{"condition", {}, {}}, knob{knob_name(sweep.knob), {}, {}}, shift{"shift_m", {}, {}};
  for (const MeasuredDrag& point : measured) {
    std::string name = fmt::format("{}", point.nominal_speed);
    for (int twin = 2;
         std::find(condition.values.begin(), condition.values.end(), name) != condition.values.end();)
      name = fmt::format("{}-{}", point.nominal_speed, twin++);
    condition.values.push_back(name);
    condition.settings.push_back({{"flow.speed_m_s", fmt::format("{}", point.speed), "--measured"},
                                  {"flow.speed_basis", "nominal", "--measured"},
                                  {"flow.density_kg_m3", fmt::format("{}", point.density), "--measured"}});
  }
  const std::string cloth = "materials." + resolved.parachute().canopy_material + ".";
  const auto keys = resistance_keys(resolved.flow().porosity_model);
  for (const double value : sweep.values) {
    const PressureDrop law = cloth_of(sweep.knob, value, sweep.thickness);
    knob.values.push_back(fmt::format("{}", value));
    knob.settings.push_back({{cloth + keys.first, fmt::format("{}", law.linear), "porosity"},
                             {cloth + keys.second, fmt::format("{}", law.quadratic), "porosity"}});
  }
  const FlowSettings& flow = resolved.flow();
  for (const double by : cell_shifts(resolved, sweep.shifts)) {
    shift.values.push_back(fmt::format("{:.4g}", by));
    std::vector<Setting> settings = {
        {"flow.canopy_position_m", fmt::format("{}", flow.canopy_position_m + by), "--shifts"}};
    if (flow.core.size_m.z > 0)  // it would go along with the canopy
      settings.push_back({"flow.core.start_m", fmt::format("{}", flow.core.start_m), "--shifts"});
    shift.settings.push_back(settings);
  }
  return {condition, knob, shift};
}

std::vector<PorosityTrial> porosity_trials(const Settings& resolved, const PorositySweep& sweep,
                                           const std::vector<SweepRow>& rows) {
  const std::vector<double> shifts = cell_shifts(resolved, sweep.shifts);
  std::vector<PorosityTrial> trials;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t run = i / shifts.size();
    trials.push_back({sweep.values[run % sweep.values.size()], shifts[i % shifts.size()],
                      run / sweep.values.size(), rows[i].result.drag_area});
  }
  return trials;
}

}  // namespace ripstop::inline run

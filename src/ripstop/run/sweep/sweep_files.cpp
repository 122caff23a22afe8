#include "ripstop/run/sweep/sweep_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

#include "ripstop/core/file.h"
#include "ripstop/core/words.h"
#include "ripstop/output/plot.h"
#include "ripstop/run/json.h"
#include "ripstop/run/report/report.h"

namespace ripstop::inline run {
namespace {

std::optional<double> number_in(const std::string& text) {
  double value = 0;
  const char* last = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), last, value);
  if (error != std::errc() || stop != last) return std::nullopt;
  return value;
}

std::optional<std::size_t> drawn_axis(const std::vector<SweepAxis>& axes) {
  for (std::size_t d = 0; d < axes.size(); ++d) {
    bool numbers = axes[d].values.size() > 1;
    for (const std::string& value : axes[d].values) numbers = numbers && number_in(value);
    if (numbers) return d;
  }
  return std::nullopt;
}

std::string status_of(const SweepRow& row) {
  if (row.done && row.result.converged)
    return row.result.usable.value_or(true) ? "converged" : "converged, must not be used";
  if (row.done) return "not converged";
  return row.error.empty() ? "waiting" : "failed: " + row.error;
}

struct Quantity {
  const char* file;
  const char* label;
  double SteadyResult::*value;
  double (*of_drag)(double drag, double q, double area);  // the same of a measured drag; null: not measured
};
constexpr Quantity quantities[] = {
    {"drag", "drag [N]", &SteadyResult::drag, [](double drag, double, double) { return drag; }},
    {"drag_area", "drag area [m\u00b2]", &SteadyResult::drag_area,
     [](double drag, double q, double) { return drag / q; }},
    {"drag_coefficient", "drag coefficient", &SteadyResult::drag_coefficient,
     [](double drag, double q, double area) { return drag / q / area; }},
    {"wall_time", "wall time [s]", &SteadyResult::wall_time, nullptr},
};

/// Measured values of the case's rows of [[measured]] over the nominal speed.
std::vector<PlotSeries> known_drag(const Settings& resolved, const Quantity& quantity) {
  std::vector<PlotSeries> all;
  const auto add = [&](const char* name, std::optional<double> Measured::*drag) {
    PlotSeries series{name, {}, {}, false, true, false};
    for (const Measured& row : resolved.measured()) {
      if (!(row.*drag)) continue;
      const bool nominal = resolved.flow().speed_basis == SpeedBasis::nominal;
      const double speed = nominal ? row.nominal_speed_m_s : row.measured_speed_m_s;
      series.x.push_back(row.nominal_speed_m_s);
      series.y.push_back(quantity.of_drag(*(row.*drag), 0.5 * row.density_kg_m3 * speed * speed,
                                          nominal_area(resolved.parachute())));
    }
    if (!series.x.empty()) all.push_back(series);
  };
  add("measured", &Measured::drag_n);
  add("published nonlinear model", &Measured::printed_nonlinear_n);
  return all;
}

/// The measured drag at the one speed of all runs, as a level over whatever else is varied.
std::vector<PlotSeries> measured_levels(const std::vector<SweepPoint>& points, const Plot& plot,
                                        const Quantity& quantity) {
  const Settings& first = points.front().resolved;
  const std::optional<Measured>& row = first.measured_row();
  const auto same_air = [&](const SweepPoint& point) {
    const std::optional<Measured>& other = point.resolved.measured_row();
    return other && row && other->nominal_speed_m_s == row->nominal_speed_m_s &&
           nominal_area(point.resolved.parachute()) == nominal_area(first.parachute());
  };
  if (!row || !row->drag_n || !std::all_of(points.begin(), points.end(), same_air)) return {};
  double low = plot.series.front().x.front(), high = low;
  for (const PlotSeries& series : plot.series)
    for (double x : series.x) low = std::min(low, x), high = std::max(high, x);
  const double speed = first.flow().speed_m_s;
  const double level = quantity.of_drag(*row->drag_n, 0.5 * first.flow().density_kg_m3 * speed * speed,
                                        nominal_area(first.parachute()));
  return {{"measured", {low, high}, {level, level}, true, false, true}};
}

}  // namespace

TextTable sweep_table(const std::vector<SweepAxis>& axes, const std::vector<SweepPoint>& points,
                      const std::vector<SweepRow>& rows) {
  TextTable table;
  for (const SweepAxis& axis : axes) table.columns.push_back(axis.name);
  const auto each_column = [](const SteadyResult& result, const auto& visit) {
    each_member(result, [&]([[maybe_unused]] const char* name, [[maybe_unused]] const auto& member,
                            [[maybe_unused]] auto... how) {
      if constexpr ((std::is_same_v<decltype(how), InTable> || ...)) visit(name, as_number(member));
    });
  };
  each_column({}, [&](const char* name, double) { table.columns.push_back(name); });
  for (const char* name : {"status", "folder"}) table.columns.push_back(name);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SweepRow& r = rows[i];
    std::vector<std::string> fields = points[i].values;
    each_column(r.result,
                [&](const char*, double value) { fields.push_back(r.done ? csv_number(value) : ""); });
    fields.push_back(status_of(r));
    fields.push_back(points[i].folder);
    table.rows.push_back(fields);
  }
  return table;
}

std::string sweep_json(const std::string& title, const std::vector<SweepAxis>& axes,
                       const std::vector<SweepPoint>& points, const std::vector<SweepRow>& rows) {
  nlohmann::ordered_json j;
  j["title"] = title;
  j["warnings"] = sweep_warnings(points, rows);
  j["runs"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < points.size(); ++i) {
    nlohmann::ordered_json run;
    for (std::size_t d = 0; d < axes.size(); ++d) run["values"][axes[d].name] = points[i].values[d];
    run["status"] = status_of(rows[i]);
    run["folder"] = points[i].folder;
    if (rows[i].done) run["result"] = rows[i].result;
    j["runs"].push_back(run);
  }
  return j.dump(2) + "\n";
}

void write_sweep_plots(const std::filesystem::path& folder, const std::string& title,
                       const std::vector<SweepAxis>& axes, const std::vector<SweepPoint>& points,
                       const std::vector<SweepRow>& rows) {
  const auto axis = drawn_axis(axes);
  if (!axis) return;
  // Lines by the names of their values on the other axes.
  std::map<std::string, std::vector<std::size_t>> lines;
  bool any = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::string name;
    for (std::size_t d = 0; d < axes.size(); ++d) {
      if (d == *axis || axes[d].values.size() < 2) continue;
      name += (name.empty() ? "" : ", ") + in_words(axes[d].name, points[i].values[d]);
    }
    if (rows[i].done) lines[name].push_back(i);
    any = any || rows[i].done;
  }
  if (!any) return;
  const bool over_speed = axes[*axis].name == "flow.speed_m_s";
  const auto draw =
      [&](const std::string& file, const std::string& label, const Quantity* known,
          const std::vector<std::pair<std::string, std::function<double(const SweepRow&)>>>& parts) {
        Plot plot{title, {in_words(axes[*axis].name).with_unit()}, {label}, {}};
        for (const auto& [part, value] : parts) {
          for (const auto& [name, members] : lines) {
            PlotSeries series;
            series.name = part + (part.empty() || name.empty() ? "" : ", ") + name;
            series.dashed = plot.series.size() % 2 == 1;  // one that lies on its neighbour leaves it seen
            for (const std::size_t i : members) {
              series.x.push_back(*number_in(points[i].values[*axis]));
              series.y.push_back(value(rows[i]));
            }
            plot.series.push_back(series);
          }
        }
        if (known && known->of_drag) {
          for (const PlotSeries& series : over_speed ? known_drag(points.front().resolved, *known)
                                                     : measured_levels(points, plot, *known))
            plot.series.push_back(series);
        }
        for (const char* ending : {".svg", ".png"}) write_plot(folder / (file + ending), plot);
      };
  for (const Quantity& q : quantities)
    draw(q.file, q.label, &q, {{"", [&](const SweepRow& row) { return row.result.*q.value; }}});
  draw("iterations", "coupling iterations", nullptr,
       {{"", [](const SweepRow& row) { return double(row.result.iterations); }}});
  draw("diameters", "diameter [m]", nullptr,
       {{"projected", [](const SweepRow& row) { return row.result.size.projected_diameter; }},
        {"skirt", [](const SweepRow& row) { return row.result.size.skirt_diameter; }}});
}

std::string finish_sweep(const std::filesystem::path& folder, const std::vector<SweepAxis>& axes,
                         const std::vector<SweepPoint>& points, const std::vector<SweepRow>& rows) {
  const std::string& title = points.front().resolved.title();
  std::string json = sweep_json(title, axes, points, rows);
  write_csv(folder / "sweep.csv", sweep_table(axes, points, rows));
  write_file(folder / "result.json", json);
  write_sweep_plots(folder, title, axes, points, rows);
  seal_sweep(folder);
  if (std::any_of(rows.begin(), rows.end(), [](const SweepRow& row) { return row.done; }))
    write_report({folder});
  return json;
}

}  // namespace ripstop::inline run

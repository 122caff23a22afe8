#include "ripstop/run/report/report_flight.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "ripstop/case/assemble.h"
#include "ripstop/core/file.h"
#include "ripstop/fsi/carried_bodies.h"
#include "ripstop/fsi/flight_record.h"
#include "ripstop/fsi/opening_end.h"
#include "ripstop/fsi/opening_record.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/flight/flight_folder.h"
#include "ripstop/run/report/report_plots.h"
#include "ripstop/run/report/report_tables.h"
#include "ripstop/run/report/shape_files.h"

namespace ripstop::inline run {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t path_points = 2000;  // in the page

/// The inflation that was computed first, as far as the folder has one.
struct Before {
  std::vector<AirRow> air;
  std::vector<double> load_time, load;  // [s], mean load on the riser [N]
  std::vector<ShapeFiles> shapes;
};

Before inflation_in(const fs::path& folder) {
  Before before;
  const fs::path opening = folder / opening_name;
  if (!fs::exists(opening / "air.csv")) return before;
  before.air = read_rows<AirRow>(opening / "air.csv");
  const CsvTable history = read_csv(opening / "history.csv");
  before.load_time = history.column("time_s"), before.load = history.column("load_mean_n");
  before.shapes = opening_shapes(opening);
  return before;
}

/// The z axis of the box of an inflation is the path of the payload, `below` the horizon [rad]; turned so that z is up.
void turn_up(std::vector<double>& points, double below) {
  const double down = std::sin(below), level = std::cos(below);
  for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
    const double x = points[i], z = points[i + 2];
    points[i] = down * x - level * z, points[i + 2] = level * x + down * z;
  }
}

double path_angle_at(const std::vector<AirRow>& air, double time, double otherwise) {
  const auto after =
      std::find_if(air.begin(), air.end(), [&](const AirRow& row) { return row.time >= time; });
  return after == air.end() ? otherwise : after->angle * std::numbers::pi / 180;
}

/// "vtk/canopy_0012.vtp" is the twelfth shape after the start.
std::vector<ShapeFiles> flight_shapes(const fs::path& folder, double began, double a_second) {
  std::vector<ShapeFiles> files = shape_files(folder);
  for (ShapeFiles& one : files) {
    const std::string name = one.canopy.stem();
    one.time = began + std::stod(name.substr(name.find('_') + 1)) / a_second;
  }
  return files;
}

void add_path(ShapeView& shape, const Before& before, const std::vector<FreeFlightRow>& rows, double height) {
  std::vector<double> times;
  std::vector<Vec3> places;
  const std::vector<double> distances = distances_over_ground(before.air);
  for (std::size_t i = 0; i < before.air.size(); ++i) {
    const AirRow& row = before.air[i];
    times.push_back(row.time), places.push_back({distances[i], 0, height - row.fallen});
  }
  for (const FreeFlightRow& row : rows) times.push_back(row.time), places.push_back(row.payload);
  const std::size_t every = times.size() / path_points + 1;
  for (std::size_t i = 0; i < times.size(); i += every) {
    shape.path_times.push_back(times[i]);
    shape.path.insert(shape.path.end(), {places[i].x, places[i].y, places[i].z});
  }
}

ReportPlot over_time(const char* id, const char* title, ReportColumn y) {
  ReportPlot plot;
  plot.id = id, plot.title = title, plot.x = {"time", "s"}, plot.y = std::move(y), plot.over_time = true;
  return plot;
}

template <class Rows, class Value>
ReportSeries series_of(const char* name, const Rows& rows, Value value) {
  ReportSeries series{name, {}, {}, true, false};
  for (const auto& row : rows) series.x.push_back(row.time), series.y.push_back(value(row));
  return thinned(std::move(series));
}

std::vector<ReportPlot> plots_from(const Before& before, const std::vector<FreeFlightRow>& rows) {
  const auto flown = [&](const char* name, auto value) { return series_of(name, rows, value); };
  ReportPlot load = over_time("load", "Force of lines and riser on the payload", {"force", "N"});
  if (!before.load.empty())
    load.series.push_back(thinned({"inflation", before.load_time, before.load, true, false}));
  load.series.push_back(flown("flight", [](const FreeFlightRow& r) { return norm(r.line_force); }));
  ReportPlot angle = over_time("angle", "Oscillation", {"angle", "°"});
  angle.series = {flown("to the vertical", [](const FreeFlightRow& r) { return r.angle; }),
                  flown("angle of attack", [](const FreeFlightRow& r) { return r.attack; })};
  ReportPlot speed = over_time("speed", "Speed of the payload", {"speed", "m/s"});
  if (!before.air.empty())
    speed.series.push_back(
        series_of("inflation, along the path", before.air, [](const AirRow& r) { return r.speed; }));
  speed.series.push_back(flown("rate of descent", [](const FreeFlightRow& r) { return -r.velocity.z; }));
  speed.series.push_back(flown("horizontal, over the ground", [](const FreeFlightRow& r) {
    return std::hypot(r.velocity.x, r.velocity.y);
  }));
  ReportPlot place = over_time("place", "Path of the payload", {"position", "m"});
  place.series = {flown("x", [](const FreeFlightRow& r) { return r.payload.x; }),
                  flown("y", [](const FreeFlightRow& r) { return r.payload.y; }),
                  flown("height", [](const FreeFlightRow& r) { return r.payload.z; })};
  ReportPlot mouth = over_time("mouth", "Area of the mouth", {"area", "m²"});
  mouth.series = {flown("mouth", [](const FreeFlightRow& r) { return r.mouth_area; })};
  return {std::move(load), std::move(angle), std::move(speed), std::move(place), std::move(mouth)};
}

/// Of rigid bodies, in the order of their names.
void add_bodies(std::vector<ReportPlot>& plots, const Settings& resolved, const fs::path& folder) {
  if (!fs::exists(folder / "bodies.csv")) return;
  ReportPlot plot = over_time("bodies", "Drag of the rigid bodies", {"drag", "N"});
  for (const auto& [name, keys] : resolved.written().bodies)
    plot.series.push_back({name, {}, {}, true, false});
  for (const FlightBodyRow& row : read_rows<FlightBodyRow>(folder / "bodies.csv")) {
    ReportSeries& series = plot.series.at(static_cast<std::size_t>(row.body) - 1);
    series.x.push_back(row.time), series.y.push_back(row.drag);
  }
  for (ReportSeries& series : plot.series) series = thinned(std::move(series));
  plots.push_back(std::move(plot));
}

/// A number of the group "handover" of result.json.
std::optional<double> handover(const fs::path& folder, const char* key) {
  const auto json = nlohmann::json::parse(read_file(folder / "result.json"), nullptr, false);
  if (!json.is_object() || !json.contains("handover")) return {};
  return json["handover"].value(key, 0.0);
}

}  // namespace

bool is_flight(const ReportRun& run) {
  return std::any_of(run.values.begin(), run.values.end(),
                     [](const ReportValue& value) { return value.key == "descent_drag_coefficient"; });
}

std::vector<ReportPlot> flight_plots(const std::vector<FreeFlightRow>& rows) {
  return plots_from({}, rows);
}

std::vector<ReportPlot> flight_plots(const fs::path& folder) {
  return plots_from(inflation_in(folder), read_rows<FreeFlightRow>(folder / "path.csv"));
}

void add_flight(ReportRun& run, const Settings& resolved, const fs::path& folder) {
  run.kind = "flight";
  run.headline = headline_of(run.kind);
  const auto rows = read_rows<FreeFlightRow>(folder / "path.csv");
  const Before before = inflation_in(folder);
  run.plots = plots_from(before, rows);
  for (ReportPlot& plot : canopy_plots(folder))
    if (plot.id != "mouths") run.plots.push_back(std::move(plot));
  add_bodies(run.plots, resolved, folder);
  const double began = handover(folder, "time_s").value_or(0),
               below = handover(folder, "path_angle_deg").value_or(90) * std::numbers::pi / 180;
  std::vector<ShapeFiles> files = before.shapes;
  const std::vector<ShapeFiles> own = flight_shapes(folder, began, resolved.flight().shapes_per_s);
  // The flight's first shape is the last one of the inflation.
  files.insert(files.end(), own.begin() + (files.empty() || own.empty() ? 0 : 1), own.end());
  files = thinned_out(std::move(files));
  if (files.empty()) return;
  run.shape = read_shape(files);
  for (ShapeFrame& frame : run.shape.frames)
    turn_up(frame.points, frame.time < began ? path_angle_at(before.air, frame.time, below) : below);
  const CanopyMesh mesh = flying_mesh(resolved);
  run.shape.part_names = mesh.parts;
  run.shape.anchor = mesh.fixed.empty() ? 0 : mesh.fixed.front();
  add_path(run.shape, before, rows, resolved.flight().height_m.value_or(0));
}

}  // namespace ripstop::inline run

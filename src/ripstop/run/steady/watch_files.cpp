#include "ripstop/run/steady/watch_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/flow_picture.h"
#include "ripstop/output/plot.h"
#include "ripstop/output/vtk.h"

namespace ripstop::inline run {
namespace {

constexpr std::size_t most_plotted = 2000;  // of a line in the plot
constexpr std::size_t shots = 6;            // in the picture

/// Of the air on the canopy [N].
Vec3 on_canopy(const FlowStep& step) {
  return step.force - force_on_others(step.bodies);
}

void write_history(ClaimedFolder& folder, const FlowRecord& record) {
  CsvTable table{{"time_s", "step_s", "courant", "force_x_n", "force_y_n", "drag_n", "momentum_gap_n"}, {}};
  for (const FlowStep& step : record.steps) {
    const Vec3 force = on_canopy(step);
    table.rows.push_back(
        {step.time, step.length, step.courant, force.x, force.y, force.z, step.momentum_gap.z});
  }
  write_csv(folder.own("history.csv"), table);
}

void write_wake(ClaimedFolder& folder, const Settings& resolved, const FlowRecord& record) {
  if (record.slices.empty()) return;
  make_folder(folder.path() / "wake");
  std::vector<VtkSeriesFile> series;
  for (std::size_t n = 0; n < record.slices.size(); ++n) {
    const FlowSlice& slice = record.slices[n];
    const std::string name = fmt::format("wake/plane_{:03}", n);
    folder.own(name + (slice.field.grid.uniform() ? ".vti" : ".vtr"));
    const auto file = write_image(folder.path() / name, flow_image(slice.field));
    series.push_back({slice.time, std::filesystem::path("wake") / file.filename()});
  }
  write_pvd(folder.own("wake.pvd"), series);

  std::vector<FlowShot> strip;
  const std::size_t every = std::max<std::size_t>(1, record.slices.size() / shots);
  for (std::size_t n = every - 1; n < record.slices.size() && strip.size() < shots; n += every) {
    const FlowSlice& slice = record.slices[n];
    strip.push_back({fmt::format("t = {:.3f} s", slice.time), &slice.field});
  }
  write_flow_picture(folder.own("wake.png"), resolved.title() + ": the middle plane", strip);
}

}  // namespace

Plot history_plot(const std::string& title, const FlowRecord& record) {
  Plot plot;
  plot.title = fmt::format("{}: drag {:.1f} N, standard error {:.2g} N", title, record.drag.mean,
                           record.drag.standard_error);
  plot.x.label = "time [s]";
  plot.y.label = "force [N]";
  const char* names[] = {"drag", "running mean, without the start-up", "side force along x",
                         "side force along y"};
  for (const char* name : names) plot.series.emplace_back().name = name;
  for (PlotSeries& series : plot.series) series.markers = false;
  plot.series[1].dashed = true;
  const double begin = record.steps.front().time - record.steps.front().length;
  const std::size_t every = std::max<std::size_t>(1, record.steps.size() / most_plotted);
  double sum = 0, since = 0;
  for (std::size_t n = 0; n < record.steps.size(); ++n) {
    const FlowStep& step = record.steps[n];
    const double time = step.time - begin;
    const Vec3 force = on_canopy(step);
    if (time > record.start_up) sum += step.length * force.z, since += step.length;
    if (n % every != 0) continue;
    const auto add = [&](int series, double value) {
      plot.series[series].x.push_back(time), plot.series[series].y.push_back(value);
    };
    add(0, force.z), add(2, force.x), add(3, force.y);
    if (since > 0) add(1, sum / since);
  }
  return plot;
}

void write_watch(ClaimedFolder& folder, const Settings& resolved, const FlowRecord& record) {
  if (record.steps.empty()) return;
  write_history(folder, record);
  write_plot(folder.own("history.png"), history_plot(resolved.title(), record));
  write_wake(folder, resolved, record);
}

}  // namespace ripstop::inline run

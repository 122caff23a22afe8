// Simple plots of y over x: drag against iteration, drag against speed, residuals.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ripstop::inline output {

struct PlotSeries {
  std::string name;  // in the legend; empty: not listed
  std::vector<double> x, y;
  bool line = true;  // joins neighbours; a value that cannot be drawn leaves a gap
  bool markers = true;
  bool dashed = false;
  std::vector<double> bars = {};  // half the height of an error bar at each point; empty: none
};
struct PlotAxis {
  std::string label;  // with unit: "speed [m/s]"
  bool logarithmic = false;
  std::optional<double> from = {}, to = {};  // absent: round values about the data
};
struct Plot {
  std::string title;
  PlotAxis x, y;
  std::vector<PlotSeries> series;
};

/// PNG or SVG by the ending of `path`. Throws Error(bad_data) when a series' x, y and bars differ in length, no
/// value can be drawn, or an axis is empty; Error(usage) for another ending, Error(io).
void write_plot(const std::filesystem::path& path, const Plot& plot);

}  // namespace ripstop::inline output

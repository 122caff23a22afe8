#include "ripstop/output/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "ripstop/core/error.h"
#include "ripstop/output/drawing.h"
#include "ripstop/output/ticks.h"

namespace ripstop::inline output {
namespace {

constexpr int plot_width = 1200, plot_height = 800;
constexpr double left = 130, right = plot_width - 40.0, top = 80, bottom = plot_height - 100.0;

/// Where the values of one axis lie on the page.
struct Scale {
  double low = 0, high = 1;    // in drawn units: the value, or its logarithm
  double at_low = 0, at_high;  // [pixel]
  bool logarithmic = false;
  std::vector<double> ticks;
  double step = 1;

  bool shows(double value) const { return std::isfinite(value) && (!logarithmic || value > 0); }
  double operator()(double value) const {
    const double drawn = logarithmic ? std::log10(value) : value;
    return at_low + (at_high - at_low) * (drawn - low) / (high - low);
  }
};

Scale make_scale(const std::filesystem::path& path, const PlotAxis& axis, const std::vector<double>& values,
                 double at_low, double at_high, int count) {
  Scale scale{0, 1, at_low, at_high, axis.logarithmic, {}, 1};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double low = infinity, high = -infinity;
  for (double value : values) {
    if (scale.shows(value)) low = std::min(low, value), high = std::max(high, value);
  }
  low = axis.from.value_or(low);
  high = axis.to.value_or(high);
  if (!scale.shows(low) || !scale.shows(high) || low > high) {
    throw Error(ExitCode::bad_data, fmt::format("{} could not be drawn: the axis \"{}\" has no values",
                                                path.string(), axis.label));
  }
  if (axis.logarithmic) {
    scale.low = axis.from ? std::log10(low) : std::floor(std::log10(low) + 1e-9);
    scale.high = axis.to ? std::log10(high) : std::ceil(std::log10(high) - 1e-9);
    if (scale.high <= scale.low) scale.high = scale.low + 1;
    scale.ticks = logarithmic_ticks(std::pow(10, scale.low), std::pow(10, scale.high), count);
    return scale;
  }
  if (low == high) {
    const double half = low == 0 ? 1 : 0.1 * std::abs(low);
    low -= half, high += half;
  }
  const auto step_of = [&](double a, double b) {
    const std::vector<double> marks = ticks(a, b, count);
    return marks.size() > 1 ? marks[1] - marks[0] : b - a;
  };
  scale.step = step_of(low, high);
  scale.low = axis.from ? low : scale.step * std::floor(low / scale.step + 1e-9);
  scale.high = axis.to ? high : scale.step * std::ceil(high / scale.step - 1e-9);
  scale.ticks = ticks(scale.low, scale.high, count);
  if (scale.ticks.size() > 1) scale.step = scale.ticks[1] - scale.ticks[0];
  return scale;
}

std::string label_of(const Scale& scale, double value) {
  if (!scale.logarithmic) return tick_label(value, scale.step);
  constexpr const char* raised[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                    "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  const int exponent = static_cast<int>(std::lround(std::log10(value)));
  std::string label = exponent < 0 ? "10\u207b" : "10";
  for (char digit : std::to_string(std::abs(exponent))) label += raised[digit - '0'];
  return label;
}

void draw_frame(cairo_t* page, const Plot& plot, const Scale& x, const Scale& y) {
  fill_box(page, left, top, right - left, bottom - top, panel);
  for (double value : x.ticks) {
    draw_line(page, x(value), top, x(value), bottom, 1, faint);
    draw_text(page, x(value), bottom + 28, label_of(x, value), {18, Align::centre, false, ink});
  }
  for (double value : y.ticks) {
    draw_line(page, left, y(value), right, y(value), 1, faint);
    draw_text(page, left - 12, y(value) + 6, label_of(y, value), {18, Align::right, false, ink});
  }
  draw_line(page, left, bottom, right, bottom, 1.5, ink);
  draw_line(page, left, top, left, bottom, 1.5, ink);
  draw_text(page, left, 48, plot.title, {24, Align::left, true, ink});
  draw_text(page, 0.5 * (left + right), plot_height - 28, plot.x.label, {20, Align::centre, false, ink});
  cairo_save(page);
  cairo_translate(page, 36, 0.5 * (top + bottom));
  cairo_rotate(page, -0.5 * std::numbers::pi);
  draw_text(page, 0, 0, plot.y.label, {20, Align::centre, false, ink});
  cairo_restore(page);
}

/// Circle, square, diamond or triangle, in turn, with a white rim.
void draw_marker(cairo_t* page, double x, double y, std::size_t kind, Colour colour) {
  constexpr double r = 6.5;
  switch (kind % 4) {
    case 0:
      cairo_new_sub_path(page);
      cairo_arc(page, x, y, r, 0, 2 * std::numbers::pi);
      break;
    case 1:
      cairo_rectangle(page, x - 0.9 * r, y - 0.9 * r, 1.8 * r, 1.8 * r);
      break;
    case 2:
      cairo_move_to(page, x, y - 1.25 * r);
      cairo_line_to(page, x + 1.25 * r, y);
      cairo_line_to(page, x, y + 1.25 * r);
      cairo_line_to(page, x - 1.25 * r, y);
      break;
    default:
      cairo_move_to(page, x, y - 1.2 * r);
      cairo_line_to(page, x + 1.2 * r, y + 0.9 * r);
      cairo_line_to(page, x - 1.2 * r, y + 0.9 * r);
  }
  cairo_close_path(page);
  set_colour(page, colour);
  cairo_fill_preserve(page);
  set_colour(page, {1, 1, 1});
  cairo_set_line_width(page, 1.5);
  cairo_stroke(page);
}

/// An error bar with caps.
void draw_bar(cairo_t* page, double x, double low, double high, Colour colour) {
  constexpr double cap = 9, width = 2;
  draw_line(page, x, low, x, high, width, colour);
  for (const double end : {low, high}) draw_line(page, x - cap, end, x + cap, end, width, colour);
}

void begin_stroke(cairo_t* page, const PlotSeries& series, Colour colour) {
  constexpr double dashes[] = {9, 6};
  cairo_set_dash(page, dashes, series.dashed ? 2 : 0, 0);
  cairo_set_line_width(page, 2.5);
  cairo_set_line_join(page, CAIRO_LINE_JOIN_ROUND);
  set_colour(page, colour);
}

void draw_series(cairo_t* page, const PlotSeries& series, std::size_t index, const Scale& x, const Scale& y) {
  cairo_save(page);
  constexpr double rim = 9;  // a marker on the frame is whole
  cairo_rectangle(page, left - rim, top - rim, right - left + 2 * rim, bottom - top + 2 * rim);
  cairo_clip(page);
  const auto drawn = [&](std::size_t i) { return x.shows(series.x[i]) && y.shows(series.y[i]); };
  if (series.line) {
    bool joined = false;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      const bool shown = drawn(i);
      if (shown && joined) cairo_line_to(page, x(series.x[i]), y(series.y[i]));
      if (shown && !joined) cairo_move_to(page, x(series.x[i]), y(series.y[i]));
      joined = shown;
    }
    begin_stroke(page, series, series_colour(index));
    cairo_stroke(page);
    cairo_set_dash(page, nullptr, 0, 0);
  }
  for (std::size_t i = 0; i < series.bars.size(); ++i) {
    const double low = series.y[i] - series.bars[i], high = series.y[i] + series.bars[i];
    if (drawn(i) && low < high && y.shows(low) && y.shows(high))
      draw_bar(page, x(series.x[i]), y(low), y(high), series_colour(index));
  }
  for (std::size_t i = 0; series.markers && i < series.x.size(); ++i) {
    if (drawn(i)) draw_marker(page, x(series.x[i]), y(series.y[i]), index, series_colour(index));
  }
  cairo_restore(page);
}

/// Points of a series as drawn: the values, and in between those that its line passes.
std::vector<std::array<double, 2>> drawn_points(const PlotSeries& series, const Scale& x, const Scale& y) {
  constexpr int parts = 16;
  std::vector<std::array<double, 2>> points;
  bool joined = false;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const bool shown = x.shows(series.x[i]) && y.shows(series.y[i]);
    if (shown) {
      const std::array<double, 2> end = {x(series.x[i]), y(series.y[i])};
      if (joined && series.line) {
        const std::array<double, 2> begin = points.back();
        for (int k = 1; k < parts; ++k) {
          const double t = 1.0 * k / parts;
          points.push_back({begin[0] + t * (end[0] - begin[0]), begin[1] + t * (end[1] - begin[1])});
        }
      }
      points.push_back(end);
    }
    joined = shown;
  }
  return points;
}

/// In the corner where it hides the least, or between two of them where that is less.
void draw_legend(cairo_t* page, const Plot& plot, const Scale& x, const Scale& y) {
  constexpr double row = 30, pad = 14, sample = 46;
  double width = 0;
  int rows = 0;
  for (const PlotSeries& series : plot.series) {
    if (series.name.empty()) continue;
    width = std::max(width, text_width(page, series.name, {18, Align::left, false, ink}));
    ++rows;
  }
  if (rows == 0) return;
  width += sample + 3 * pad;
  const double height = rows * row + pad;
  std::vector<std::array<double, 2>> points;
  for (const PlotSeries& series : plot.series) {
    for (const auto& point : drawn_points(series, x, y)) points.push_back(point);
  }
  double best_x = 0, best_y = 0;
  auto fewest = std::numeric_limits<std::ptrdiff_t>::max();
  for (const double down : {0., 1., 0.5, 0.25, 0.75}) {
    const double cy = top + 12 + down * (bottom - top - height - 24);
    for (const double cx : {right - width - 12, left + 12}) {
      const auto hidden = std::count_if(points.begin(), points.end(), [&](const auto& point) {
        const double px = point[0] - cx, py = point[1] - cy;
        return px > -12 && px < width + 12 && py > -12 && py < height + 12;
      });
      if (hidden < fewest) fewest = hidden, best_x = cx, best_y = cy;
    }
  }
  fill_box(page, best_x, best_y, width, height, {1, 1, 1}, 0.88);
  double at = best_y + 0.5 * pad + 0.5 * row;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const PlotSeries& series = plot.series[i];
    if (series.name.empty()) continue;
    if (series.line) {
      begin_stroke(page, series, series_colour(i));
      cairo_move_to(page, best_x + pad, at);
      cairo_line_to(page, best_x + pad + sample, at);
      cairo_stroke(page);
      cairo_set_dash(page, nullptr, 0, 0);
    }
    if (series.markers) draw_marker(page, best_x + pad + 0.5 * sample, at, i, series_colour(i));
    draw_text(page, best_x + 2 * pad + sample, at + 6, series.name, {18, Align::left, false, ink});
    at += row;
  }
}

}  // namespace

void write_plot(const std::filesystem::path& path, const Plot& plot) {
  std::vector<double> all_x, all_y;
  for (const PlotSeries& series : plot.series) {
    const std::size_t bars = series.bars.size();
    if (series.x.size() != series.y.size() || (bars != 0 && bars != series.y.size())) {
      throw Error(ExitCode::bad_data,
                  fmt::format("{} could not be drawn: series \"{}\" has {} x for {} y and {} bars",
                              path.string(), series.name, series.x.size(), series.y.size(), bars));
    }
    all_x.insert(all_x.end(), series.x.begin(), series.x.end());
    all_y.insert(all_y.end(), series.y.begin(), series.y.end());
    for (std::size_t i = 0; i < bars; ++i)
      for (const double bar : {-series.bars[i], series.bars[i]}) all_y.push_back(series.y[i] + bar);
  }
  const Scale x = make_scale(path, plot.x, all_x, left, right, 8);
  const Scale y = make_scale(path, plot.y, all_y, bottom, top, 6);
  write_drawing(path, plot_width, plot_height, [&](cairo_t* page) {
    draw_frame(page, plot, x, y);
    // Markers without a line, measurements mostly, lie on top.
    for (bool line : {true, false}) {
      for (std::size_t i = 0; i < plot.series.size(); ++i) {
        if (plot.series[i].line == line) draw_series(page, plot.series[i], i, x, y);
      }
    }
    draw_legend(page, plot, x, y);
  });
}

}  // namespace ripstop::inline output

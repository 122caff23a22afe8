#include "ripstop/output/flow_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "ripstop/core/error.h"
#include "ripstop/output/drawing.h"
#include "ripstop/output/ticks.h"

namespace ripstop::inline output {
namespace {

constexpr int shot_width = 420, margin = 24, head = 60, caption = 34, foot = 74;  // [pixel]
constexpr int most_in_a_row = 3;

/// Displayed part of a plane: all but the outer cells that grow to more than three times the finest.
struct Window {
  double x_low, x_high, z_low, z_high;
};
Window window_of(const FlowGrid& grid) {
  const auto span = [&](int axis) {
    int low = 0, high = grid.count(axis) - 1;
    double finest = grid.width(axis, 0);
    for (int c = 0; c <= high; ++c) finest = std::min(finest, grid.width(axis, c));
    while (low < high && grid.width(axis, low) > 3 * finest) ++low;
    while (high > low && grid.width(axis, high) > 3 * finest) --high;
    return std::pair{grid.edge(axis, low), grid.edge(axis, high + 1)};
  };
  const auto [x_low, x_high] = span(0);
  const auto [z_low, z_high] = span(2);
  return {x_low, x_high, z_low, z_high};
}

std::uint32_t argb(Colour colour) {
  const auto byte = [](double value) { return static_cast<std::uint32_t>(std::lround(255 * value)); };
  return 0xff000000U | byte(colour.red) << 16 | byte(colour.green) << 8 | byte(colour.blue);
}

Raster raster_of(const FlowField& field, const Window& window, ColourRange range, int columns, int rows) {
  const FlowGrid& grid = field.grid;
  Raster raster{columns, rows, std::vector<std::uint32_t>(std::size_t(columns) * rows)};
  const double y = grid.centre(1, 0);
  for (int row = 0; row < rows; ++row) {
    const double x = window.x_high - (row + 0.5) * (window.x_high - window.x_low) / rows;
    for (int column = 0; column < columns; ++column) {
      const double z = window.z_low + (column + 0.5) * (window.z_high - window.z_low) / columns;
      const double speed = norm(sample(grid, field.velocity, {x, y, z}));
      raster.argb[std::size_t(columns) * row + column] =
          argb(scale_colour((speed - range.low) / (range.high - range.low)));
    }
  }
  return raster;
}

void draw_scale(cairo_t* page, double y, ColourRange range) {
  constexpr int bar = 400, height = 14;
  for (int i = 0; i < bar; ++i)
    fill_box(page, margin + i, y, 1.5, height, scale_colour(static_cast<double>(i) / bar));
  const std::vector<double> values = ticks(range.low, range.high, 5);
  for (const double value : values) {
    const double at = margin + bar * (value - range.low) / (range.high - range.low);
    draw_line(page, at, y + height, at, y + height + 5, 1, ink);
    draw_text(page, at, y + height + 22, tick_label(value, values.size() > 1 ? values[1] - values[0] : 1),
              {.size = 14, .align = Align::centre});
  }
  draw_text(page, margin + bar + 24, y + height, "speed [m/s]", {.size = 15});
}

}  // namespace

void write_flow_picture(const std::filesystem::path& path, const std::string& title,
                        const std::vector<FlowShot>& shots) {
  if (shots.empty()) throw Error(ExitCode::bad_data, path.string() + " was not written: no field is given");
  std::vector<double> speeds;
  for (const FlowShot& shot : shots) {
    if (shot.field->grid.ny != 1)
      throw Error(ExitCode::bad_data, path.string() + " was not written: the field is no plane");
    for (const Vec3& u : shot.field->velocity) speeds.push_back(norm(u));
  }
  const ColourRange range = {0, colour_range(speeds, 1e-3).high};
  const Window window = window_of(shots.front().field->grid);
  const int in_a_row = std::min(most_in_a_row, static_cast<int>(shots.size()));
  const int lines = (static_cast<int>(shots.size()) + in_a_row - 1) / in_a_row;
  const int columns = shot_width;
  const int rows = std::max(1, static_cast<int>(std::lround(columns * (window.x_high - window.x_low) /
                                                            (window.z_high - window.z_low))));
  const int width = std::max(2, in_a_row) * (columns + margin) + margin;
  const int height = head + lines * (rows + caption) + foot;
  write_drawing(path, width, height, [&](cairo_t* page) {
    draw_text(page, margin, 36, title, {.size = 20, .bold = true});
    for (int n = 0; n < static_cast<int>(shots.size()); ++n) {
      const int column = n % in_a_row, line = n / in_a_row;
      const double x = margin + column * (columns + margin), y = head + line * (rows + caption);
      draw_raster(page, x, y, raster_of(*shots[n].field, window, range, columns, rows));
      draw_text(page, x, y + rows + 20, shots[n].caption, {.size = 15});
    }
    draw_scale(page, head + lines * (rows + caption) + 14, range);
  });
}

}  // namespace ripstop::inline output

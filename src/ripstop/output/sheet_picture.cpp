#include "ripstop/output/sheet_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ripstop/core/error.h"
#include "ripstop/output/drawing.h"
#include "ripstop/output/ticks.h"

namespace ripstop::inline output {
namespace {

constexpr int page_width = 900, page_height = 1200, top = 84, margin = 24, bar_width = 190;
constexpr double clipped_share = 0.005;  // of the cells, at either end of the colours

void draw_bar(cairo_t* page, ColourRange range, const std::string& quantity) {
  const double x = page_width - bar_width + 20, y = top + 30, height = 620, width = 34;
  draw_text(page, page_width - margin, 52, quantity, {20, Align::right, true, ink});
  constexpr int strips = 310;
  for (int i = 0; i < strips; ++i)
    fill_box(page, x, y + height * i / strips, width, height / strips + 1,
             scale_colour(1 - (i + 0.5) / strips));
  const std::vector<double> marks = ticks(range.low, range.high, 8);
  const double step = marks.size() > 1 ? marks[1] - marks[0] : 1;
  for (double mark : marks) {
    const double at = y + height * (range.high - mark) / (range.high - range.low);
    draw_line(page, x + width, at, x + width + 8, at, 1.5, ink);
    draw_text(page, x + width + 14, at + 6, tick_label(mark, step), {18, Align::left, false, ink});
  }
}

}  // namespace

ColourRange write_sheet_picture(const std::filesystem::path& path, const Mesh& mesh,
                                const std::vector<Vec3>& positions, const SheetPicture& picture) {
  const std::vector<Cell> cells = cells_of(mesh);
  if (picture.cell_values.size() != cells.size() || positions.size() != mesh.start.size())
    throw Error(ExitCode::bad_data,
                fmt::format("a picture of {} cells and {} nodes got {} values and {} positions", cells.size(),
                            mesh.start.size(), picture.cell_values.size(), positions.size()));
  std::vector<double> shown;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i].corner[0] >= 0) shown.push_back(picture.cell_values[i]);
  const ColourRange range = colour_range(shown, clipped_share);

  Scene scene;
  scene.points = positions;
  std::vector<Vec3> corners = picture.outline;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].corner[0] < 0) continue;
    const double value = picture.cell_values[i];
    Scene::Quad quad{
        {}, std::isfinite(value) ? scale_colour((value - range.low) / (range.high - range.low)) : no_value};
    std::copy(std::begin(cells[i].corner), std::end(cells[i].corner), quad.corner);
    scene.quads.push_back(quad);
    for (int corner : quad.corner) corners.push_back(positions[corner]);
  }
  const int width = page_width - bar_width - 2 * margin, height = page_height - top - margin;
  const double aspect = static_cast<double>(width) / height;
  const Camera camera = fitted(camera_from({}, {0, 0, 1}, {0, 1, 0}, 0), corners, aspect, 0.04);
  write_drawing(path, page_width, page_height, [&](cairo_t* page) {
    draw_text(page, margin, 52, picture.title, {28, Align::left, true, ink});
    fill_box(page, margin, top, width, height, panel);
    draw_raster(page, margin, top, render(scene, camera, width, height));
    for (std::size_t i = 0; i < picture.outline.size(); ++i) {
      const Projected a = project(camera, picture.outline[i], width, height);
      const Projected b = project(camera, picture.outline[(i + 1) % picture.outline.size()], width, height);
      const int dashes = 2 * static_cast<int>(std::hypot(b.x - a.x, b.y - a.y) / 16) + 1;
      for (int k = 0; k < dashes; k += 2) {
        const auto at = [&](double from, double to, int j) { return from + (to - from) * j / dashes; };
        draw_line(page, margin + at(a.x, b.x, k), top + at(a.y, b.y, k), margin + at(a.x, b.x, k + 1),
                  top + at(a.y, b.y, k + 1), 1.5, ink);
      }
    }
    draw_bar(page, range, picture.quantity);
  });
  return range;
}

}  // namespace ripstop::inline output

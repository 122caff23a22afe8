#include "ripstop/output/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ripstop/core/error.h"
#include "ripstop/output/drawing.h"
#include "ripstop/output/ticks.h"

namespace ripstop::inline output {
namespace {

constexpr int sheet_width = 1800, sheet_height = 1200;
struct Box {
  int x, y, width, height;
};
constexpr Box oblique_box{24, 84, 1064, 644}, front_box{1104, 84, 672, 644}, side_box{24, 744, 1352, 432},
    bar_box{1392, 744, 384, 432};

/// The share of cells at either end of the values that the colour bar leaves out by default: stress peaks at
/// line ends would otherwise darken everything else.
constexpr double clipped_share = 0.01;

/// Canopy and lines, and the corners that each view must hold.
struct Shown {
  Scene scene;
  std::vector<Vec3> canopy, everything;
};

void add_springs(Shown& shown, const Mesh& mesh, const std::vector<int>& springs, std::size_t begin,
                 std::size_t end, double width) {
  for (std::size_t i = begin; i < end; ++i) {
    const Spring& spring = mesh.springs[springs[i]];
    shown.scene.lines.push_back({spring.a, spring.b, width, ink});
    shown.everything.push_back(shown.scene.points[spring.a]);
    shown.everything.push_back(shown.scene.points[spring.b]);
  }
}

Shown what_to_show(const CanopyMesh& mesh, const std::vector<Vec3>& positions,
                   const std::vector<double>& values, ColourRange range) {
  Shown shown;
  shown.scene.points = positions;
  const std::vector<Cell> cells = cells_of(mesh);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].corner[0] < 0) continue;
    const double fraction = (values[i] - range.low) / (range.high - range.low);
    Scene::Quad quad{{}, std::isfinite(values[i]) ? scale_colour(fraction) : no_value};
    std::copy(std::begin(cells[i].corner), std::end(cells[i].corner), quad.corner);
    shown.scene.quads.push_back(quad);
    for (int corner : quad.corner) shown.canopy.push_back(positions[corner]);
  }
  shown.everything = shown.canopy;
  for (const LineRun& line : mesh.rigging.lines) {
    const auto free = static_cast<std::size_t>(line.free_springs);
    add_springs(shown, mesh, line.springs, 0, free, 1.5);
    add_springs(shown, mesh, line.springs, free, line.springs.size(), 1.0);  // along the canopy
  }
  add_springs(shown, mesh, mesh.rigging.riser_springs, 0, mesh.rigging.riser_springs.size(), 3.0);
  return shown;
}

std::vector<double> checked_values(const std::filesystem::path& path, const Mesh& mesh,
                                   const std::vector<Vec3>& positions, const CanopyPicture& picture) {
  const auto reject = [&](const std::string& reason) {
    throw Error(ExitCode::bad_data, fmt::format("{} could not be drawn: {}", path.string(), reason));
  };
  const std::vector<Cell> cells = cells_of(mesh);
  if (positions.size() != mesh.start.size() || picture.cell_values.size() != cells.size()) {
    reject(fmt::format("{} positions for {} nodes, {} values for {} cells", positions.size(),
                       mesh.start.size(), picture.cell_values.size(), cells.size()));
  }
  if (!std::all_of(positions.begin(), positions.end(), is_finite)) reject("a node's position is not finite");
  std::vector<double> shown;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].corner[0] >= 0) shown.push_back(picture.cell_values[i]);
  }
  if (shown.empty()) reject("the mesh has no cloth");
  return shown;
}

/// The camera's axis letters about (x, y); z is the flow.
void draw_axes(cairo_t* page, double x, double y, const Camera& camera) {
  constexpr double length = 34;
  const struct {
    Vec3 axis;
    const char* name;
  } axes[] = {{{1, 0, 0}, "x"}, {{0, 1, 0}, "y"}, {{0, 0, 1}, "z"}};
  for (const auto& [axis, name] : axes) {
    const double u = dot(axis, camera.right), v = -dot(axis, camera.up);
    if (std::hypot(u, v) < 0.1) continue;  // toward the eye
    draw_arrow(page, x, y, x + length * u, y + length * v, 2, ink);
    draw_text(page, x + (length + 13) * u, y + (length + 13) * v + 5, name, {15, Align::centre, false, ink});
  }
}

/// A bar of round length, about a sixth of the panel, at its lower right.
void draw_scale_bar(cairo_t* page, const Box& box, const Camera& camera) {
  const double metres_shown = camera.height * box.width / box.height, pixels = box.height / camera.height;
  const double power = std::pow(10, std::floor(std::log10(metres_shown / 5)));
  const double share = metres_shown / 5 / power;
  const double length = power * (share >= 5 ? 5 : share >= 2 ? 2 : 1);
  const double right = box.x + box.width - 24, y = box.y + box.height - 24, left = right - length * pixels;
  draw_line(page, left, y, right, y, 3, ink);
  for (double x : {left, right}) draw_line(page, x, y - 6, x, y + 6, 2, ink);
  draw_text(page, 0.5 * (left + right), y - 10, fmt::format("{:g} m", length),
            {16, Align::centre, false, ink});
}

void draw_view(cairo_t* page, const Box& box, const Scene& scene, const Camera& camera, const char* caption) {
  fill_box(page, box.x, box.y, box.width, box.height, panel);
  draw_raster(page, box.x, box.y, render(scene, camera, box.width, box.height));
  draw_text(page, box.x + 16, box.y + 28, caption, {17, Align::left, false, ink});
}

void draw_flow_arrow(cairo_t* page, const Box& box) {
  const double x = box.x + 24, y = box.y + 64;
  draw_arrow(page, x, y, x + 110, y, 3.5, ink);
  draw_text(page, x + 120, y + 6, "flow", {17, Align::left, false, ink});
}

/// Horizontal colour bar with labelled ends, round values between, and the colours of values outside.
void draw_colour_bar(cairo_t* page, const CanopyPicture& picture, ColourRange range, ColourRange extremes) {
  const double left = bar_box.x + 34, width = bar_box.width - 68, top = bar_box.y + 120, height = 30;
  fill_box(page, bar_box.x, bar_box.y, bar_box.width, bar_box.height, panel);
  draw_text(page, left, bar_box.y + 92, picture.quantity, {18, Align::left, true, ink});
  for (int i = 0; i < static_cast<int>(width); ++i) {
    fill_box(page, left + i, top, 1, height, scale_colour((i + 0.5) / width));
  }
  const auto beyond = [&](double x, double direction, Colour colour) {  // pointed end: values lie outside
    set_colour(page, colour);
    cairo_move_to(page, x, top);
    cairo_line_to(page, x + 0.6 * height * direction, top + 0.5 * height);
    cairo_line_to(page, x, top + height);
    cairo_fill(page);
  };
  if (extremes.low < range.low) beyond(left, -1, scale_colour(0));
  if (extremes.high > range.high) beyond(left + width, 1, scale_colour(1));

  const double span = range.high - range.low, label_y = top + height + 26;
  const auto mark = [&](double value, double step) {
    const double x = left + width * (value - range.low) / span;
    draw_line(page, x, top + height, x, top + height + 7, 1.5, ink);
    draw_text(page, x, label_y, tick_label(value, step), {16, Align::centre, false, ink});
  };
  mark(range.low, span / 1000);
  mark(range.high, span / 1000);
  const std::vector<double> inner = ticks(range.low, range.high, 4);
  for (double value : inner) {
    const double fraction = (value - range.low) / span;
    if (fraction > 0.2 && fraction < 0.8) mark(value, inner.size() > 1 ? inner[1] - inner[0] : span);
  }
  const auto note = [&](double y, const char* name, double value) {
    draw_text(page, left, y, fmt::format("{}: {:.4g}", name, value), {16, Align::left, false, ink});
  };
  note(label_y + 50, "smallest", extremes.low);
  note(label_y + 76, "largest", extremes.high);
}

}  // namespace

ColourRange write_canopy_picture(const std::filesystem::path& path, const CanopyMesh& mesh,
                                 const std::vector<Vec3>& positions, const CanopyPicture& picture) {
  const std::vector<double> values = checked_values(path, mesh, positions, picture);
  const ColourRange range = picture.range ? *picture.range : colour_range(values, clipped_share);
  if (!(range.low < range.high)) {
    throw Error(ExitCode::bad_data,
                fmt::format("{}: the colour range {} .. {} is empty", path.string(), range.low, range.high));
  }
  const Shown shown = what_to_show(mesh, positions, picture.cell_values, range);

  Vec3 centre;
  for (Vec3 point : shown.canopy) centre += point / static_cast<double>(shown.canopy.size());
  double radius = 0;
  for (Vec3 point : shown.canopy) radius = std::max(radius, norm(point - centre));

  const auto view = [&](const Box& box, Vec3 toward_eye, double distance, const std::vector<Vec3>& held,
                        double margin) {
    const Camera camera = camera_from(centre, toward_eye, {0, 1, 0}, distance);
    return fitted(camera, held, 1.0 * box.width / box.height, margin);
  };
  const Camera oblique = view(oblique_box, {-0.55, 0.33, -0.77}, 5 * radius, shown.canopy, 0.05);
  const Camera front = view(front_box, {0, 0, -1}, 0, shown.canopy, 0.09);
  const Camera side = view(side_box, {-1, 0, 0}, 0, shown.everything, 0.11);

  write_drawing(path, sheet_width, sheet_height, [&](cairo_t* page) {
    TextStyle title{30, Align::left, true, ink};
    title.size *= std::min(1.0, (sheet_width - 2.0 * oblique_box.x) / text_width(page, picture.title, title));
    draw_text(page, oblique_box.x, 54, picture.title, title);
    draw_view(page, oblique_box, shown.scene, oblique, "from upstream, oblique");
    draw_axes(page, oblique_box.x + oblique_box.width - 64, oblique_box.y + oblique_box.height - 64, oblique);
    draw_view(page, front_box, shown.scene, front, "front, seen from upstream");
    draw_axes(page, front_box.x + 64, front_box.y + front_box.height - 64, front);
    draw_scale_bar(page, front_box, front);
    draw_view(page, side_box, shown.scene, side, "side");
    draw_axes(page, side_box.x + 64, side_box.y + side_box.height - 64, side);
    draw_scale_bar(page, side_box, side);
    draw_flow_arrow(page, side_box);
    draw_colour_bar(page, picture, range, colour_range(values));
  });
  return range;
}

void write_contact_sheet(const std::filesystem::path& path, const CanopyMesh& mesh, const std::string& title,
                         const std::string& quantity, const std::vector<CanopyShot>& shots) {
  constexpr int most_shots = 12, across = 4, tile_width = 450, tile_height = 420, head = 84, foot = 48;
  if (shots.empty() || shots.size() > most_shots) {
    throw Error(ExitCode::bad_data, fmt::format("{}: an overview of {} shapes; must be 1 to {}",
                                                path.string(), shots.size(), most_shots));
  }
  std::vector<double> values;
  for (const CanopyShot& shot : shots) {
    const auto own = checked_values(path, mesh, shot.positions, {title, quantity, shot.cell_values});
    values.insert(values.end(), own.begin(), own.end());
  }
  const ColourRange range = colour_range(values, clipped_share);
  std::vector<Shown> shown;
  std::vector<Vec3> held;
  for (const CanopyShot& shot : shots) {
    shown.push_back(what_to_show(mesh, shot.positions, shot.cell_values, range));
    held.insert(held.end(), shown.back().canopy.begin(), shown.back().canopy.end());
  }
  Vec3 centre;
  for (Vec3 point : held) centre += point / static_cast<double>(held.size());
  double radius = 0;
  for (Vec3 point : held) radius = std::max(radius, norm(point - centre));
  const Camera camera = fitted(camera_from(centre, {-0.8, 0.33, -0.5}, {0, 1, 0}, 6 * radius), held,
                               1.0 * tile_width / tile_height, 0.05);

  const int count = static_cast<int>(shots.size()), columns = std::min(count, across);
  const int rows = (count + columns - 1) / columns;
  write_drawing(path, columns * tile_width, head + rows * tile_height + foot, [&](cairo_t* page) {
    draw_text(page, 24, 54, title, {28, Align::left, true, ink});
    for (int i = 0; i < count; ++i) {
      const Box box{(i % columns) * tile_width + 6, head + (i / columns) * tile_height + 6, tile_width - 12,
                    tile_height - 12};
      draw_view(page, box, shown[i].scene, camera, shots[i].caption.c_str());
    }
    draw_text(page, 24, head + rows * tile_height + 30,
              fmt::format("{} from {:.3g} (dark) to {:.3g} (bright)", quantity, range.low, range.high),
              {18, Align::left, false, ink});
  });
}

}  // namespace ripstop::inline output

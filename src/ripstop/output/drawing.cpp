#include "ripstop/output/drawing.h"

#include <cairo-svg.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "ripstop/core/build_info.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"

#ifdef __SANITIZE_ADDRESS__
// Fontconfig keeps its list of fonts to the end of the process; Cairo offers no way to return it.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libfontconfig.so\n";
}
#endif

namespace ripstop::inline output {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Page = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void check(cairo_status_t status, const std::filesystem::path& path) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw Error(ExitCode::bad_data,
              fmt::format("{} could not be drawn: {}", path.string(), cairo_status_to_string(status)));
}

/// Set explicitly: otherwise a font keeps the setting of the first picture of the process, .png or .svg.
void set_font_options(cairo_t* page) {
  const std::unique_ptr<cairo_font_options_t, decltype(&cairo_font_options_destroy)> options(
      cairo_font_options_create(), cairo_font_options_destroy);
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(page, options.get());
}

/// Portable archives and wheels contain the fonts of the pictures, so that a system without fonts draws the same text.
void use_shipped_fonts() {
  static const bool done = [] {
    try {
      const std::filesystem::path list = data_directory() / "fonts/fonts.conf";
      if (std::filesystem::exists(list)) ::setenv("FONTCONFIG_FILE", list.c_str(), 0);
    } catch (const Error&) {  // no shipped data: the fonts of the system
    }
    return true;
  }();
  static_cast<void>(done);
}

void choose_font(cairo_t* page, const TextStyle& style) {
  use_shipped_fonts();
  cairo_select_font_face(page, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(page, style.size);
}

}  // namespace

void write_drawing(const std::filesystem::path& path, int width, int height,
                   const std::function<void(cairo_t*)>& draw) {
  const std::string ending = path.extension().string();
  if (ending != ".png" && ending != ".svg") {
    throw Error(ExitCode::usage,
                fmt::format("{}: the name of a picture must end in .png or .svg", path.string()));
  }
  const bool svg = ending == ".svg";
  std::string bytes;
  const Surface surface(svg ? cairo_svg_surface_create_for_stream(append, &bytes, width, height)
                            : cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height),
                        cairo_surface_destroy);
  {
    const Page page(cairo_create(surface.get()), cairo_destroy);
    set_font_options(page.get());
    fill_box(page.get(), 0, 0, width, height, {1, 1, 1});
    draw(page.get());
    check(cairo_status(page.get()), path);
  }
  if (svg) {
    cairo_surface_finish(surface.get());
    check(cairo_surface_status(surface.get()), path);
  } else {
    check(cairo_surface_write_to_png_stream(surface.get(), append, &bytes), path);
  }
  write_file(path, bytes);
}

void set_colour(cairo_t* page, Colour colour, double alpha) {
  cairo_set_source_rgba(page, colour.red, colour.green, colour.blue, alpha);
}

double text_width(cairo_t* page, const std::string& text, const TextStyle& style) {
  choose_font(page, style);
  cairo_text_extents_t extents;
  cairo_text_extents(page, text.c_str(), &extents);
  return extents.x_advance;
}

void draw_text(cairo_t* page, double x, double y, const std::string& text, const TextStyle& style) {
  const double width = text_width(page, text, style);
  if (style.align == Align::centre) x -= 0.5 * width;
  if (style.align == Align::right) x -= width;
  set_colour(page, style.colour);
  cairo_move_to(page, x, y);
  cairo_show_text(page, text.c_str());
}

void draw_line(cairo_t* page, double x0, double y0, double x1, double y1, double width, Colour colour) {
  set_colour(page, colour);
  cairo_set_line_width(page, width);
  cairo_move_to(page, x0, y0);
  cairo_line_to(page, x1, y1);
  cairo_stroke(page);
}

void draw_arrow(cairo_t* page, double x0, double y0, double x1, double y1, double width, Colour colour) {
  const double length = std::hypot(x1 - x0, y1 - y0);
  if (length == 0) return;
  const double ux = (x1 - x0) / length, uy = (y1 - y0) / length, head = std::min(6 * width, 0.6 * length);
  const double bx = x1 - head * ux, by = y1 - head * uy;
  draw_line(page, x0, y0, bx, by, width, colour);
  cairo_move_to(page, x1, y1);
  cairo_line_to(page, bx - 0.4 * head * uy, by + 0.4 * head * ux);
  cairo_line_to(page, bx + 0.4 * head * uy, by - 0.4 * head * ux);
  cairo_close_path(page);
  cairo_fill(page);
}

void fill_box(cairo_t* page, double x, double y, double width, double height, Colour colour, double alpha) {
  set_colour(page, colour, alpha);
  cairo_rectangle(page, x, y, width, height);
  cairo_fill(page);
}

void draw_raster(cairo_t* page, double x, double y, const Raster& raster) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, raster.width, raster.height),
                        cairo_surface_destroy);
  unsigned char* pixels = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  cairo_surface_flush(surface.get());
  for (int row = 0; row < raster.height; ++row) {
    std::copy_n(raster.argb.data() + static_cast<std::size_t>(row) * raster.width, raster.width,
                reinterpret_cast<std::uint32_t*>(pixels + static_cast<std::ptrdiff_t>(row) * stride));
  }
  cairo_surface_mark_dirty(surface.get());
  cairo_set_source_surface(page, surface.get(), x, y);
  cairo_paint(page);
}

}  // namespace ripstop::inline output

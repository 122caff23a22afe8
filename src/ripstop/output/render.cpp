#include "ripstop/output/render.h"

#include <algorithm>
#include <array>
#include <limits>

#include "ripstop/core/error.h"

namespace ripstop::inline output {
namespace {

constexpr Colour rim_colour{0.93, 0.94, 0.95};
constexpr double line_rim_width = 1.4;  // both sides together [pixel]

Vec3 unit(Vec3 a) {
  const double length = norm(a);
  return length > 0 ? a / length : Vec3{};
}

double square_of(double a) {
  return a * a;
}

enum class Hit : char { nothing, surface, line, line_rim };

/// The nearest hit so far of every ray of some rows of the picture: as many rows as fit into a cache.
struct Buffer {
  int width, top = 0, bottom = 0;  // rows top .. bottom - 1
  std::vector<double> depth;
  std::vector<Colour> colour;
  std::vector<Hit> hit;

  Buffer(int w, int rows)
      : width(w), depth(static_cast<std::size_t>(w) * rows), colour(depth.size()), hit(depth.size()) {}
  void begin(int first, int end) {
    top = first;
    bottom = end;
    std::fill(depth.begin(), depth.end(), std::numeric_limits<double>::infinity());
    std::fill(hit.begin(), hit.end(), Hit::nothing);
  }
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y - top) * width + x; }
};

/// Pixels whose centre may lie in [low, high], within begin .. end.
std::pair<int, int> pixel_range(double low, double high, int begin, int end) {
  return {static_cast<int>(std::clamp(std::ceil(low - 0.5), 1.0 * begin, 1.0 * end)),
          static_cast<int>(std::clamp(std::floor(high - 0.5) + 1, 1.0 * begin, 1.0 * end))};
}

struct Vertex {
  Projected at;
  Vec3 normal;  // averaged over the cells, not of unit length
};

/// Light that a point of the surface sends to the eye, at most 1: from all sides, from a lamp at the upper
/// left, and from the eye.
double brightness(const Camera& camera, Vec3 normal) {
  const Vec3 n = unit(normal);
  const Vec3 facing = dot(n, camera.toward_eye) < 0 ? -n : n;  // cloth is lit on both sides
  const Vec3 lamp = unit(camera.toward_eye + 0.75 * camera.up - 0.55 * camera.right);
  return 0.48 + 0.36 * std::max(0.0, dot(facing, lamp)) + 0.16 * dot(facing, camera.toward_eye);
}

void fill(Buffer& buffer, const Camera& camera, const Vertex& a, const Vertex& b, const Vertex& c,
          Colour colour) {
  // Barycentric weights from the edge functions; linear in x and y.
  const double area = (b.at.x - a.at.x) * (c.at.y - a.at.y) - (b.at.y - a.at.y) * (c.at.x - a.at.x);
  if (!a.at.visible || !b.at.visible || !c.at.visible || area == 0) return;
  const auto [x0, x1] =
      pixel_range(std::min({a.at.x, b.at.x, c.at.x}), std::max({a.at.x, b.at.x, c.at.x}), 0, buffer.width);
  const auto [y0, y1] = pixel_range(std::min({a.at.y, b.at.y, c.at.y}), std::max({a.at.y, b.at.y, c.at.y}),
                                    buffer.top, buffer.bottom);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double wb = ((px - a.at.x) * (c.at.y - a.at.y) - (py - a.at.y) * (c.at.x - a.at.x)) / area;
      const double wc = ((b.at.x - a.at.x) * (py - a.at.y) - (b.at.y - a.at.y) * (px - a.at.x)) / area;
      const double wa = 1 - wb - wc;
      if (wa < 0 || wb < 0 || wc < 0) continue;
      const double depth = wa * a.at.depth + wb * b.at.depth + wc * c.at.depth;
      const std::size_t i = buffer.at(x, y);
      if (!(depth < buffer.depth[i])) continue;
      const double light = brightness(camera, wa * a.normal + wb * b.normal + wc * c.normal);
      buffer.depth[i] = depth;
      buffer.colour[i] = {light * colour.red, light * colour.green, light * colour.blue};
      buffer.hit[i] = Hit::surface;
    }
  }
}

/// `nearer` [m] lifts the line before the cloth it is sewn on. A line hides rims that are up to four times as
/// much before it: those of its own neighbours, where it runs toward the eye.
void draw_segment(Buffer& buffer, const Projected& a, const Projected& b, double width, double nearer,
                  Colour colour, Hit kind) {
  if (!a.visible || !b.visible) return;
  const double half = 0.5 * width, dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const auto [x0, x1] = pixel_range(std::min(a.x, b.x) - half, std::max(a.x, b.x) + half, 0, buffer.width);
  const auto [y0, y1] =
      pixel_range(std::min(a.y, b.y) - half, std::max(a.y, b.y) + half, buffer.top, buffer.bottom);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const double px = x + 0.5 - a.x, py = y + 0.5 - a.y;
      const double along = square > 0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0;
      if (square_of(px - along * dx) + square_of(py - along * dy) > half * half) continue;
      const double depth = a.depth + along * (b.depth - a.depth) - nearer;
      const std::size_t i = buffer.at(x, y);
      const bool over_rim = kind == Hit::line && buffer.hit[i] == Hit::line_rim;
      if (!(depth < buffer.depth[i] + (over_rim ? 4 * nearer : 0))) continue;
      buffer.depth[i] = depth;
      buffer.colour[i] = colour;
      buffer.hit[i] = kind;
    }
  }
}

/// Darkens the rim of the nearer surface where the one behind it is farther by more than `step`: edges and
/// folds of one colour stay apart. Right in the rows that have `reach` more about them.
void outline(Buffer& buffer, double step, int reach) {
  std::vector<char> rim(buffer.depth.size(), 0);
  for (int y = buffer.top; y < buffer.bottom; ++y) {
    for (int x = 0; x < buffer.width; ++x) {
      const std::size_t i = buffer.at(x, y);
      if (buffer.hit[i] != Hit::surface) continue;
      for (const auto& [ox, oy] : {std::array{reach, 0}, {-reach, 0}, {0, reach}, {0, -reach}}) {
        const int nx = x + ox, ny = y + oy;
        if (nx < 0 || ny < buffer.top || nx >= buffer.width || ny >= buffer.bottom) continue;
        if (buffer.depth[buffer.at(nx, ny)] - buffer.depth[i] > step) rim[i] = 1;
      }
    }
  }
  for (std::size_t i = 0; i < rim.size(); ++i) {
    if (!rim[i]) continue;
    Colour& c = buffer.colour[i];
    c = {0.45 * c.red, 0.45 * c.green, 0.45 * c.blue};
  }
}

/// The numbers of the parts that may be seen in each group of `rows` rows, in their order. `extents` are the lowest and
/// highest y of every part.
std::vector<std::vector<std::size_t>> grouped(const std::vector<std::pair<double, double>>& extents, int rows,
                                              int all_rows) {
  std::vector<std::vector<std::size_t>> groups(static_cast<std::size_t>((all_rows + rows - 1) / rows));
  for (std::size_t i = 0; i < extents.size(); ++i) {
    const auto [first, end] = pixel_range(extents[i].first, extents[i].second, 0, all_rows);
    for (int group = first / rows; group * rows < end; ++group)
      groups[static_cast<std::size_t>(group)].push_back(i);
  }
  return groups;
}

/// Adds rows of the picture: means of samples x samples rays a pixel, premultiplied by the share that hit something.
void add_averaged(Raster& raster, const Buffer& buffer, int begin, int end, int samples) {
  for (int y = begin; y < end; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      double sum[4] = {};  // alpha, red, green, blue
      for (int k = 0; k < samples * samples; ++k) {
        const std::size_t i = buffer.at(x * samples + k % samples, y * samples + k / samples);
        if (buffer.hit[i] == Hit::nothing) continue;
        const Colour& c = buffer.colour[i];
        sum[0] += 1;
        sum[1] += c.red;
        sum[2] += c.green;
        sum[3] += c.blue;
      }
      std::uint32_t pixel = 0;
      if (sum[0] > 0) {
        for (double part : sum) {
          pixel = pixel << 8 | static_cast<std::uint32_t>(std::lround(255 * part / (samples * samples)));
        }
      }
      raster.argb.push_back(pixel);
    }
  }
}

}  // namespace

Camera camera_from(Vec3 target, Vec3 toward_eye, Vec3 up, double distance) {
  Camera camera;
  camera.target = target;
  camera.toward_eye = unit(toward_eye);
  camera.right = unit(cross(up, camera.toward_eye));
  camera.up = cross(camera.toward_eye, camera.right);
  camera.distance = distance;
  return camera;
}

Projected project(const Camera& camera, Vec3 point, int width, int height) {
  const Vec3 p = point - camera.target;
  const double away = -dot(p, camera.toward_eye);
  double scale = 1;
  Projected at{0, 0, away, true};
  if (camera.distance > 0) {
    const double from_eye = camera.distance + away;
    if (from_eye < 1e-3 * camera.distance) return {0, 0, 0, false};
    // D (1 - D / z) is linear on the picture, and near z = D it is the parallel depth z - D.
    scale = camera.distance / from_eye;
    at.depth = camera.distance * (1 - scale);
  }
  const double pixels = height / camera.height;  // a metre
  at.x = 0.5 * width + (dot(p, camera.right) * scale - camera.u) * pixels;
  at.y = 0.5 * height - (dot(p, camera.up) * scale - camera.v) * pixels;
  return at;
}

Camera fitted(Camera camera, const std::vector<Vec3>& points, double aspect, double margin) {
  camera.u = camera.v = 0;
  camera.height = 1;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double left = infinity, right = -infinity, top = infinity, bottom = -infinity;
  for (Vec3 point : points) {
    const Projected at = project(camera, point, 0, 1);  // x = u, y = 1/2 - v [m]
    if (!at.visible) continue;
    left = std::min(left, at.x), right = std::max(right, at.x);
    top = std::min(top, at.y), bottom = std::max(bottom, at.y);
  }
  if (!(left <= right)) throw Error(ExitCode::bad_data, "the picture would be empty: no point is in view");
  camera.u = 0.5 * (left + right);
  camera.v = 0.5 - 0.5 * (top + bottom);
  camera.height = std::max(bottom - top, (right - left) / aspect) / (1 - 2 * margin);
  if (camera.height == 0) camera.height = 1;  // a single point
  return camera;
}

Raster render(const Scene& scene, const Camera& camera, int width, int height, int samples) {
  const int all_rows = height * samples;
  std::vector<Vertex> vertices(scene.points.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i].at = project(camera, scene.points[i], width * samples, all_rows);
  }
  for (const Scene::Quad& quad : scene.quads) {
    const auto [a, b, c, d] = quad.corner;
    const Vec3 normal = cross(scene.points[c] - scene.points[a], scene.points[d] - scene.points[b]);
    for (int corner : quad.corner) vertices[corner].normal += normal;
  }
  const int reach = std::max(1, samples / 2);
  const double nearer = 0.006 * camera.height;
  constexpr int rows = 16;  // of pixels at a time
  Buffer buffer(width * samples, rows * samples + 2 * reach);
  Raster raster{width, height, {}};
  raster.argb.reserve(static_cast<std::size_t>(width) * height);
  // Each group of rows has `reach` more about it.
  std::vector<std::pair<double, double>> quad_extents, line_extents;
  for (const Scene::Quad& quad : scene.quads) {
    const auto [a, b, c, d] = quad.corner;
    const auto [low, high] =
        std::minmax({vertices[a].at.y, vertices[b].at.y, vertices[c].at.y, vertices[d].at.y});
    quad_extents.emplace_back(low - reach, high + reach);
  }
  for (const SceneLine& line : scene.lines) {
    const double margin = reach + 0.5 * (line.width + line_rim_width) * samples;
    const auto [low, high] = std::minmax(vertices[line.a].at.y, vertices[line.b].at.y);
    line_extents.emplace_back(low - margin, high + margin);
  }
  const auto quads = grouped(quad_extents, rows * samples, all_rows);
  const auto lines = grouped(line_extents, rows * samples, all_rows);
  for (int begin = 0; begin < height; begin += rows) {
    const int end = std::min(begin + rows, height);
    const auto group = static_cast<std::size_t>(begin / rows);
    buffer.begin(std::max(begin * samples - reach, 0), std::min(end * samples + reach, all_rows));
    for (const std::size_t number : quads[group]) {
      const Scene::Quad& quad = scene.quads[number];
      const auto [a, b, c, d] = quad.corner;
      fill(buffer, camera, vertices[a], vertices[b], vertices[c], quad.colour);
      fill(buffer, camera, vertices[a], vertices[c], vertices[d], quad.colour);
    }
    outline(buffer, 0.012 * camera.height, reach);
    // Lines sewn on the cloth show on both of its sides, with a light rim that parts them from dark cloth.
    for (const std::size_t number : lines[group]) {
      const SceneLine& line = scene.lines[number];
      draw_segment(buffer, vertices[line.a].at, vertices[line.b].at, (line.width + line_rim_width) * samples,
                   nearer, rim_colour, Hit::line_rim);
    }
    for (const std::size_t number : lines[group]) {
      const SceneLine& line = scene.lines[number];
      draw_segment(buffer, vertices[line.a].at, vertices[line.b].at, line.width * samples, nearer,
                   line.colour, Hit::line);
    }
    add_averaged(raster, buffer, begin, end, samples);
  }
  return raster;
}

}  // namespace ripstop::inline output

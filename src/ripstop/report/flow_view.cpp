#include "ripstop/report/flow_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/core/error.h"
#include "ripstop/output/vtk_read.h"

namespace ripstop::inline report {
namespace {

/// A field on the cells of a rectilinear grid, trilinear between their centres.
struct GridField {
  std::array<std::vector<double>, 3> edges;  // [m]
  std::vector<double> pressure, velocity;    // one, three a cell

  std::size_t count(std::size_t axis) const { return edges[axis].size() - 1; }
  double centre(std::size_t axis, std::size_t i) const { return 0.5 * (edges[axis][i] + edges[axis][i + 1]); }
};

struct Sample {
  double pressure = 0;
  Vec3 velocity;
};

struct Between {
  std::size_t low, high;
  double weight;  // of high
};
Between between(const GridField& field, std::size_t axis, double x) {
  const std::vector<double>& edges = field.edges[axis];
  const std::size_t last = field.count(axis) - 1;
  const auto above =
      static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), x) - edges.begin());
  const std::size_t cell = std::min(above > 0 ? above - 1 : 0, last);
  const std::size_t low = x < field.centre(axis, cell) ? (cell > 0 ? cell - 1 : 0) : cell;
  const std::size_t high = std::min(low + 1, last);
  if (low == high) return {low, high, 0};
  const double from = field.centre(axis, low), to = field.centre(axis, high);
  return {low, high, std::clamp((x - from) / (to - from), 0.0, 1.0)};
}

Sample sample(const GridField& field, Vec3 at) {
  const Between x = between(field, 0, at.x), y = between(field, 1, at.y), z = between(field, 2, at.z);
  Sample sum;
  for (int corner = 0; corner < 8; ++corner) {
    const std::size_t i = corner & 1 ? x.high : x.low, j = corner & 2 ? y.high : y.low,
                      k = corner & 4 ? z.high : z.low;
    const double weight = (corner & 1 ? x.weight : 1 - x.weight) * (corner & 2 ? y.weight : 1 - y.weight) *
                          (corner & 4 ? z.weight : 1 - z.weight);
    const std::size_t cell = i + field.count(0) * (j + field.count(1) * k);
    sum.pressure += weight * field.pressure[cell];
    sum.velocity +=
        weight * Vec3{field.velocity[3 * cell], field.velocity[3 * cell + 1], field.velocity[3 * cell + 2]};
  }
  return sum;
}

GridField read_field(const std::filesystem::path& path) {
  VtkFile file = read_vtk(path);
  const VtkData* pressure = file.find("CellData", "pressure_pa");
  const VtkData* velocity = file.find("CellData", "velocity_m_per_s");
  std::size_t cells = 1;
  for (const std::vector<double>& edges : file.edges) cells *= edges.size() < 2 ? 0 : edges.size() - 1;
  if (!pressure || !velocity || cells == 0 || pressure->values.size() != cells ||
      velocity->values.size() != 3 * cells)
    throw Error(ExitCode::bad_data, fmt::format("{}: is not a flow field written by Ripstop", path.string()));
  return {file.edges, pressure->values, velocity->values};
}

double narrowest(const GridField& field) {
  double width = field.edges[0].back() - field.edges[0].front();
  for (const std::vector<double>& edges : field.edges)
    for (std::size_t i = 1; i < edges.size(); ++i) width = std::min(width, edges[i] - edges[i - 1]);
  return width;
}

struct Box {
  Vec3 low, high;
  bool holds(Vec3 p) const {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z && p.z <= high.z;
  }
};

/// A diameter about the canopy, more behind it, as far as the flow's own box goes.
Box surroundings(const GridField& field, Vec3 low, Vec3 high) {
  const double wide = std::max(high.x - low.x, high.y - low.y);
  const Vec3 first{field.edges[0].front(), field.edges[1].front(), field.edges[2].front()};
  const Vec3 last{field.edges[0].back(), field.edges[1].back(), field.edges[2].back()};
  const Vec3 from{low.x - 0.75 * wide, low.y - 0.75 * wide, low.z - 0.75 * wide};
  const Vec3 to{high.x + 0.75 * wide, high.y + 0.75 * wide, high.z + 2 * wide};
  return {{std::max(from.x, first.x), std::max(from.y, first.y), std::max(from.z, first.z)},
          {std::min(to.x, last.x), std::min(to.y, last.y), std::min(to.z, last.z)}};
}

/// Midpoint rule, dx/ds = u/|u| over steps of `step`; `way` -1 goes upstream.
std::vector<Vec3> streamline(const GridField& field, const Box& box, Vec3 at, double step, double way,
                             double slowest) {
  std::vector<Vec3> points;
  constexpr int most = 2400;
  for (int i = 0; i < most && box.holds(at); ++i) {
    points.push_back(at);
    const Vec3 u = sample(field, at).velocity;
    if (norm(u) < slowest) break;
    const Vec3 middle = sample(field, at + (0.5 * step * way / norm(u)) * u).velocity;
    if (norm(middle) < slowest) break;
    at += (step * way / norm(middle)) * middle;
  }
  return points;
}

void add_streamline(FlowView& view, const GridField& field, const std::vector<Vec3>& points) {
  constexpr std::size_t kept = 3;  // every so many points; the line is drawn straight in between
  if (points.size() < 4 * kept) return;
  int length = 0;
  for (std::size_t i = 0; i < points.size(); i += kept, ++length) {
    view.streamlines.insert(view.streamlines.end(), {points[i].x, points[i].y, points[i].z});
    view.streamline_speed.push_back(norm(sample(field, points[i]).velocity));
  }
  view.lengths.push_back(length);
}

void add_streamlines(FlowView& view, const GridField& field, const Box& box, Vec3 low, Vec3 high) {
  const Vec3 middle = 0.5 * (low + high);
  const double radius = 0.25 * (high.x - low.x + high.y - low.y), step = 0.02 * radius;
  const double slowest = 1e-3 * norm(sample(field, {middle.x, middle.y, box.low.z}).velocity);
  constexpr int spokes = 16;
  const auto seed = [&](double share, int spoke, double z) {
    const double angle = 2 * std::numbers::pi * spoke / spokes;
    return Vec3{middle.x + share * radius * std::cos(angle), middle.y + share * radius * std::sin(angle), z};
  };
  for (double share : {0.05, 0.2, 0.4, 0.6, 0.8, 1.0, 1.25})
    for (int spoke = share < 0.1 ? spokes - 1 : 0; spoke < spokes; ++spoke)
      add_streamline(view, field, streamline(field, box, seed(share, spoke, box.low.z), step, 1, slowest));
  for (int spoke = 0; spoke < spokes; spoke += 2)  // the eddies behind the canopy
    add_streamline(view, field,
                   streamline(field, box, seed(0.7, spoke, high.z + 0.5 * radius), step, 1, slowest));
}

}  // namespace

FlowView read_flow(const std::filesystem::path& file, Vec3 low, Vec3 high, int most_cells) {
  const GridField field = read_field(file);
  const Box box = surroundings(field, low, high);
  const Vec3 size = box.high - box.low;
  const double h = std::max(narrowest(field), std::cbrt(size.x * size.y * size.z / most_cells));
  FlowView view;
  const double sizes[] = {size.x, size.y, size.z};
  for (std::size_t axis = 0; axis < 3; ++axis) view.cells[axis] = std::max(2, int(sizes[axis] / h));
  view.spacing = {size.x / view.cells[0], size.y / view.cells[1], size.z / view.cells[2]};
  view.origin = box.low + 0.5 * view.spacing;
  for (int k = 0; k < view.cells[2]; ++k)
    for (int j = 0; j < view.cells[1]; ++j)
      for (int i = 0; i < view.cells[0]; ++i) {
        const Sample here =
            sample(field, {view.origin.x + i * view.spacing.x, view.origin.y + j * view.spacing.y,
                           view.origin.z + k * view.spacing.z});
        view.pressure.push_back(here.pressure);
        view.speed.push_back(norm(here.velocity));
      }
  add_streamlines(view, field, box, low, high);
  return view;
}

}  // namespace ripstop::inline report

#include "ripstop/flow/cartesian/quarter.h"

#include <map>
#include <tuple>
#include <utility>

namespace ripstop::inline flow::cartesian {
namespace {

using Place = std::tuple<int, int, int, int>;  // axis and cell

/// The low face of this axis and cell in the mirrors, in a box of 2 nx by 2 ny cells.
Place mirrored(const SheetFace& face, int image, int nx, int ny) {
  const int i = face.axis == 0 ? 2 * nx - face.i : 2 * nx - 1 - face.i,
            j = face.axis == 1 ? 2 * ny - face.j : 2 * ny - 1 - face.j;
  return {face.axis, (image & 1) != 0 ? i : face.i, (image & 2) != 0 ? j : face.j, face.k};
}

double square_of_distance(Vec3 a, Vec3 b) {
  return dot(a - b, a - b);
}

}  // namespace

Vec3 mirrored(Vec3 v, int image) {
  return {(image & 1) != 0 ? -v.x : v.x, (image & 2) != 0 ? -v.y : v.y, v.z};
}

FlowGrid quarter_of(const FlowGrid& whole) {
  FlowGrid grid = whole;
  grid.origin = {0, 0, whole.origin.z};
  grid.size = {0.5 * whole.size.x, 0.5 * whole.size.y, whole.size.z};
  grid.nx = whole.nx / 2, grid.ny = whole.ny / 2;
  for (const int axis : {0, 1}) {
    Grading& grading = grid.grading[static_cast<std::size_t>(axis)];
    if (grading.after == 0) continue;
    grading.core_low = 0, grading.before = 0, grading.ratio_before = 1;
  }
  return grid;
}

FlowProblem quarter_of(FlowProblem whole) {
  const FlowGrid grid = std::exchange(whole.grid, quarter_of(whole.grid));
  for (FlowBody& body : whole.bodies) {
    if (body.is_sheet()) continue;
    std::vector<int> cells;
    for (const int cell : body.porous().cells) {
      const int i = cell % grid.nx - whole.grid.nx, j = cell / grid.nx % grid.ny - whole.grid.ny,
                k = cell / grid.nx / grid.ny;
      if (i >= 0 && j >= 0) cells.push_back(whole.grid.index(i, j, k));
    }
    body.porous().cells = std::move(cells);
  }
  return whole;
}

Vec3 of_whole_box(Vec3 sum) {
  return {0, 0, images * sum.z};
}

BodyLoad of_whole_box(const BodyLoad& load, Vec3 moment_about) {
  const Vec3 force = of_whole_box(load.force);
  return {force, cross(-1.0 * moment_about, force)};  // the line of action of mirrored forces is the axis
}

Axis whole_of(const Axis& half) {
  std::vector<double> edges;
  for (int f = half.n; f > 0; --f) edges.push_back(-half.edge[static_cast<std::size_t>(f)]);
  edges.insert(edges.end(), half.edge.begin(), half.edge.end());
  return make_axis(std::move(edges), End::zero_gradient, End::zero_gradient);
}

FlowField whole_of(FlowField quarter, const FlowGrid& whole) {
  const FlowGrid grid = std::exchange(quarter.grid, whole);
  const std::vector<double> pressure = std::exchange(quarter.pressure, {});
  const std::vector<Vec3> velocity = std::exchange(quarter.velocity, {});
  quarter.pressure.reserve(static_cast<std::size_t>(whole.cells()));
  quarter.velocity.reserve(static_cast<std::size_t>(whole.cells()));
  for (int k = 0; k < whole.nz; ++k) {
    for (int j = 0; j < whole.ny; ++j) {
      for (int i = 0; i < whole.nx; ++i) {
        const bool low_x = i < grid.nx, low_y = j < grid.ny;
        const int cell =
            grid.index(low_x ? grid.nx - 1 - i : i - grid.nx, low_y ? grid.ny - 1 - j : j - grid.ny, k);
        quarter.pressure.push_back(pressure[static_cast<std::size_t>(cell)]);
        quarter.velocity.push_back(
            mirrored(velocity[static_cast<std::size_t>(cell)], (low_x ? 1 : 0) + (low_y ? 2 : 0)));
      }
    }
  }
  return quarter;
}

std::vector<std::array<int, images>> take_quarter(std::vector<SheetFace>& faces, int nx, int ny) {
  std::map<Place, std::vector<const SheetFace*>> by_place;
  for (const SheetFace& face : faces) by_place[{face.axis, face.i, face.j, face.k}].push_back(&face);
  // Of the layers in the mirrored place the one that is nearest; of a mesh that is symmetric to rounding only, a face
  // may lack its image: then the nearest of all faces.
  const auto triangle_near = [&](Vec3 point, const Place& place) {
    const auto found = by_place.find(place);
    double least = 1e300;
    int triangle = -1;
    const auto offer = [&](const SheetFace& face) {
      const double square = square_of_distance(face.point, point);
      if (square < least) least = square, triangle = face.triangle;
    };
    if (found != by_place.end())
      for (const SheetFace* face : found->second) offer(*face);
    else
      for (const SheetFace& face : faces) offer(face);
    return triangle;
  };
  std::vector<SheetFace> own;
  std::vector<std::array<int, images>> triangles;
  for (const SheetFace& face : faces) {
    if (face.i < nx || face.j < ny) continue;
    std::array<int, images>& of = triangles.emplace_back();
    for (int image = 0; image < images; ++image)
      of[static_cast<std::size_t>(image)] =
          image == 0 ? face.triangle
                     : triangle_near(mirrored(face.point, image), mirrored(face, image, nx, ny));
    own.push_back(face);
    own.back().i -= nx, own.back().j -= ny;
  }
  faces = std::move(own);
  return triangles;
}

void add_images(const SheetLoad& load, const std::array<int, images>& triangle, int in_plane,
                std::vector<SheetLoad>& loads) {
  loads.push_back(load);
  for (int image = 1; image < images; ++image) {
    if ((image & in_plane) != 0) continue;
    SheetLoad& other = loads.emplace_back(load);
    other.triangle = triangle[static_cast<std::size_t>(image)];
    other.point = mirrored(load.point, image), other.outward = mirrored(load.outward, image);
    other.force = mirrored(load.force, image);
  }
}

}  // namespace ripstop::inline flow::cartesian

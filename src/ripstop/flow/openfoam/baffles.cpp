#include "ripstop/flow/openfoam/baffles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_set>

#include "ripstop/core/checked_int.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/cartesian/sheet_faces.h"
#include "ripstop/flow/openfoam/case_writer.h"
#include "ripstop/flow/openfoam/foam_file.h"

namespace ripstop::inline flow::openfoam {
namespace {

namespace fs = std::filesystem;

constexpr double covered = 0.5;  // of a face, from where on it is closed
/// Slope of the pressure over the velocity, relative to rho U, above which cloth is tight.
constexpr double tight = 0.5;
/// Laws of loose cloth that differ by less share a patch.
constexpr double alike = 0.05;

cartesian::Axis axis_of(const FlowGrid& grid, int axis) {
  return cartesian::make_axis(grid.edges(axis), cartesian::End::zero_gradient, cartesian::End::zero_gradient);
}

double component(Vec3 v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

Vec3 along(int axis, double value) {
  return {axis == 0 ? value : 0, axis == 1 ? value : 0, axis == 2 ? value : 0};
}

/// The one that a face of the grid lies across.
int axis_of(const Baffle& baffle) {
  return baffle.area.x > 0 ? 0 : baffle.area.y > 0 ? 1 : 2;
}

/// Sums of a / slant and b / slant^2: the law of all layers for the velocity through the face.
std::array<double, 2> law_of(const Baffle& baffle, const std::vector<FlowBody>& bodies) {
  std::array<double, 2> law{};
  for (const Layer& layer : baffle.layers) {
    law[0] += bodies[layer.body].drop().linear / layer.slant;
    law[1] += bodies[layer.body].drop().quadratic / (layer.slant * layer.slant);
  }
  return law;
}

/// v of a v + b v |v| = drop.
double velocity(double a, double b, double drop) {
  if (drop == 0 || (a <= 0 && b <= 0)) return 0;
  return 2 * drop / (a + std::sqrt(a * a + 4 * b * std::abs(drop)));
}

/// Slope of the pressure over the velocity at the dynamic pressure of the stream [Pa s/m].
double slope_of(double a, double b, const Freestream& air) {
  return a + 2 * b * velocity(a, b, 0.5 * air.density * air.speed() * air.speed());
}

/// The faces of a sheet and, in a quarter, the triangle of each mirror image.
struct SheetFaces {
  std::vector<cartesian::SheetFace> faces;
  std::vector<std::array<int, cartesian::images>> mirrored;
};

SheetFaces faces_of(const FlowProblem& problem, const FlowBody& sheet) {
  const FlowGrid& grid = problem.grid;
  const cartesian::Axis x = axis_of(grid, 0), y = axis_of(grid, 1), z = axis_of(grid, 2);
  SheetFaces found;
  if (problem.quarter) {
    found.faces = cartesian::sheet_faces(whole_of(x), whole_of(y), z, sheet.surface);
    found.mirrored = cartesian::take_quarter(found.faces, grid.nx, grid.ny);
  } else {
    found.faces = cartesian::sheet_faces(x, y, z, sheet.surface);
    found.mirrored.resize(found.faces.size());
  }
  return found;
}

std::vector<Baffle> all_baffles(const FlowProblem& problem) {
  const FlowGrid& grid = problem.grid;
  const int steps[] = {1, grid.nx, grid.nx * grid.ny};
  std::map<std::pair<int, int>, Baffle> found;
  for (int s = 0; s < static_cast<int>(problem.bodies.size()); ++s) {
    const SheetFaces found_of_sheet = faces_of(problem, problem.bodies[s]);
    for (std::size_t n = 0; n < found_of_sheet.faces.size(); ++n) {
      const cartesian::SheetFace& face = found_of_sheet.faces[n];
      const int at[] = {face.i, face.j, face.k};
      if (at[face.axis] == 0) continue;  // in a plane of symmetry
      double area = 1;
      for (int other = 0; other < 3; ++other)
        if (other != face.axis) area *= grid.width(other, at[other]);
      if (face.cover < covered) continue;
      const int high = grid.index(face.i, face.j, face.k), low = high - steps[face.axis];
      Baffle& baffle = found[{low, face.axis}];
      baffle.low = low, baffle.high = high, baffle.area = along(face.axis, area);
      baffle.layers.push_back({s, face.triangle, face.point, face.outward, face.against,
                               area * component(face.normal, face.axis),
                               std::clamp(face.area / area, 1e-2, 1.0), found_of_sheet.mirrored[n]});
    }
  }
  std::vector<Baffle> baffles;
  for (auto& [key, baffle] : found) baffles.push_back(std::move(baffle));
  return baffles;
}

}  // namespace

double passing(const Baffle& baffle, const std::vector<FlowBody>& bodies, double drop) {
  const auto [a, b] = law_of(baffle, bodies);
  return velocity(a, b, drop);
}

double pace(const Baffle& baffle, const FlowProblem& problem) {
  const auto [a, b] = law_of(baffle, problem.bodies);
  const double slope = slope_of(a, b, problem.air), flow = 2 * problem.air.density * problem.air.speed();
  return slope / (slope + flow);
}

bool is_loose(double linear, double quadratic, const Freestream& air) {
  return slope_of(linear, quadratic, air) <= tight * air.density * air.speed();
}

bool shuts(double across, const FlowGrid& grid) {
  return across > 0.9 * grid.size.x * grid.size.y;
}

std::vector<BafflePatch> baffles_of(const FlowProblem& problem) {
  const auto place = [](double value) {
    constexpr int none = -1000000;
    if (!(value > 0)) return none;
    return checked_int(std::round(std::log(value) / alike), none, -none, [&] {
      return fmt::format("a baffle with a pressure drop coefficient of {}: it must be finite", value);
    });
  };
  std::map<std::pair<int, int>, BafflePatch> loose;
  BafflePatch walls{"cloth", false, 0, 0, {}};
  std::vector<Baffle> baffles = all_baffles(problem);
  double across = 0;
  for (const Baffle& baffle : baffles) across += baffle.area.z;
  const bool shut = shuts(across, problem.grid);
  for (Baffle& baffle : baffles) {
    const auto [a, b] = law_of(baffle, problem.bodies);
    if (!shut && !is_loose(a, b, problem.air)) {
      walls.baffles.push_back(std::move(baffle));
      continue;
    }
    BafflePatch& patch = loose[{place(a), place(b)}];
    if (patch.baffles.empty()) patch = {"", true, a, b, {}};
    patch.baffles.push_back(std::move(baffle));
  }
  std::vector<BafflePatch> patches;
  if (!walls.baffles.empty()) patches.push_back(std::move(walls));
  for (auto& [key, patch] : loose) {
    patch.name = fmt::format("cloth{}", patches.size());
    patches.push_back(std::move(patch));
  }
  return patches;
}

namespace {

/// The corners of a cell's face across `axis`, its low or high one, such that the normal leads out of the cell.
class Corners {
 public:
  explicit Corners(const FlowGrid& grid) : nx_(grid.nx), ny_(grid.ny) {}

  std::array<int, 4> face(int cell, int axis, bool high) const {
    std::array<int, 3> at = {cell % nx_, cell / nx_ % ny_, cell / (nx_ * ny_)};
    at[axis] += high;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<int, 4> corners{};
    for (int n = 0; n < 4; ++n) {
      std::array<int, 3> corner = at;
      corner[u] += n == 1 || n == 2;
      corner[v] += n >= 2;
      corners[n] = corner[0] + (nx_ + 1) * (corner[1] + (ny_ + 1) * corner[2]);
    }
    if (!high) std::swap(corners[1], corners[3]);
    return corners;
  }

 private:
  int nx_, ny_;
};

struct Faces {
  std::vector<int> corners, owner, neighbour;
  struct Patch {
    std::string name, type;
    std::size_t start, count;
  };
  std::vector<Patch> patches;

  void add(const std::array<int, 4>& face, int cell) {
    corners.insert(corners.end(), face.begin(), face.end());
    owner.push_back(cell);
  }
  void end_patch(const std::string& name, const std::string& type) {
    const std::size_t start =
        patches.empty() ? neighbour.size() : patches.back().start + patches.back().count;
    patches.push_back({name, type, start, owner.size() - start});
  }
};

/// Inner faces in the order of their cells, as OpenFOAM requires.
void add_inner(const FlowGrid& grid, const std::vector<BafflePatch>& patches, Faces& faces) {
  std::unordered_set<long long> parted;
  for (const BafflePatch& patch : patches)
    for (const Baffle& baffle : patch.baffles) parted.insert(3LL * baffle.low + axis_of(baffle));
  const Corners corners(grid);
  const int steps[] = {1, grid.nx, grid.nx * grid.ny};
  for (int cell = 0; cell < grid.cells(); ++cell) {
    const int at[] = {cell % grid.nx, cell / grid.nx % grid.ny, cell / (grid.nx * grid.ny)};
    for (int axis = 0; axis < 3; ++axis) {
      if (at[axis] + 1 == grid.count(axis) || parted.count(3LL * cell + axis)) continue;
      faces.add(corners.face(cell, axis, true), cell);
      faces.neighbour.push_back(cell + steps[axis]);
    }
  }
}

void add_box(const FlowProblem& problem, Faces& faces) {
  const FlowGrid& grid = problem.grid;
  const Corners corners(grid);
  const auto side = [&](int axis, bool high) {
    const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    for (int b = 0; b < grid.count(v); ++b) {
      for (int a = 0; a < grid.count(u); ++a) {
        int at[3] = {};
        at[u] = a, at[v] = b, at[axis] = high ? grid.count(axis) - 1 : 0;
        const int cell = grid.index(at[0], at[1], at[2]);
        faces.add(corners.face(cell, axis, high), cell);
      }
    }
  };
  side(2, false);
  faces.end_patch("inlet", "type patch;");
  side(2, true);
  faces.end_patch("outlet", "type patch;");
  for (const int axis : {0, 1})
    for (const bool high : {false, true})
      if (high || !problem.quarter) side(axis, high);
  faces.end_patch("sides", "type patch;");
  for (int axis = 0; problem.quarter && axis < 2; ++axis) {
    side(axis, false);
    faces.end_patch(symmetry_planes[axis], "type symmetryPlane;");
  }
}

void add_cloth(const FlowGrid& grid, const std::vector<BafflePatch>& patches, Faces& faces) {
  const Corners corners(grid);
  for (const BafflePatch& patch : patches) {
    const auto type = [&](const char* other) {
      return patch.loose
                 ? fmt::format("type cyclic; matchTolerance 1e-4; neighbourPatch {}{};", patch.name, other)
                 : "type wall;";
    };
    for (const Baffle& baffle : patch.baffles)
      faces.add(corners.face(baffle.low, axis_of(baffle), true), baffle.low);
    faces.end_patch(patch.name + "_low", type("_high"));
    for (const Baffle& baffle : patch.baffles) {
      // The same four corners the other way round, the first one first: so cyclic patches find each other.
      std::array<int, 4> face = corners.face(baffle.low, axis_of(baffle), true);
      std::swap(face[1], face[3]);
      faces.add(face, baffle.high);
    }
    faces.end_patch(patch.name + "_high", type("_low"));
  }
}

std::vector<double> points_of(const FlowGrid& grid) {
  const std::vector<double> x = grid.edges(0), y = grid.edges(1), z = grid.edges(2);
  std::vector<double> points;
  points.reserve(3 * x.size() * y.size() * z.size());
  for (const double c : z)
    for (const double b : y)
      for (const double a : x) points.insert(points.end(), {a, b, c});
  return points;
}

}  // namespace

void write_mesh(const fs::path& folder, const FlowProblem& problem, const std::vector<BafflePatch>& patches) {
  const FlowGrid& grid = problem.grid;
  Faces faces;
  add_inner(grid, patches, faces);
  add_box(problem, faces);
  add_cloth(grid, patches, faces);
  std::string boundary = fmt::format("{}\n(\n", faces.patches.size());
  for (const Faces::Patch& patch : faces.patches)
    boundary += fmt::format("{} {{ {} nFaces {}; startFace {}; }}\n", patch.name, patch.type, patch.count,
                            patch.start);
  std::vector<int> begins(faces.owner.size() + 1);
  for (std::size_t n = 0; n < begins.size(); ++n) begins[n] = static_cast<int>(4 * n);
  const std::string sizes = fmt::format("nPoints:{} nCells:{} nFaces:{} nInternalFaces:{}",
                                        (grid.nx + 1) * (grid.ny + 1) * (grid.nz + 1), grid.cells(),
                                        faces.owner.size(), faces.neighbour.size());
  make_folder(folder);
  write_file(folder / "points",
             foam_header("vectorField", "points", "binary") + binary_list(points_of(grid), 3));
  write_file(folder / "faces", foam_header("faceCompactList", "faces", "binary") + binary_list(begins) +
                                   binary_list(faces.corners));
  write_file(folder / "owner", foam_header("labelList", "owner", "binary", sizes) + binary_list(faces.owner));
  write_file(folder / "neighbour",
             foam_header("labelList", "neighbour", "binary", sizes) + binary_list(faces.neighbour));
  write_file(folder / "boundary", foam_header("polyBoundaryMesh", "boundary", "ascii") + boundary + ")\n");
}

}  // namespace ripstop::inline flow::openfoam

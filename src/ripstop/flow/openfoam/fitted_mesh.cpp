#include "ripstop/flow/openfoam/fitted_mesh.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/flow/hems.h"
#include "ripstop/flow/openfoam/case_writer.h"
#include "ripstop/flow/openfoam/field_file.h"
#include "ripstop/flow/stl.h"

namespace ripstop::inline flow::openfoam {
namespace {

namespace fs = std::filesystem;

// By how much of a sheet's area and of the length of its rims, gaps and vent those of its faces may differ.
constexpr double tolerance = 0.25;

std::string name_of(std::size_t sheet) {
  return fmt::format("cloth{}", sheet);
}

bool is_loose_in(const FlowProblem& problem, const FlowBody& sheet) {
  double across = 0;
  for (const FlowBody& one : problem.bodies)
    for (const Triangle& t : one.surface) across += 0.5 * std::abs(cross(t.b - t.a, t.c - t.a).z);
  return shuts(across, problem.grid) || is_loose(sheet.drop().linear, sheet.drop().quadratic, problem.air);
}

constexpr char kSnappy[] = R"foam(castellatedMesh true;
snap true;
addLayers false;
geometry
{{
{0}}}
castellatedMeshControls
{{
    maxLocalCells 200000000;
    maxGlobalCells 200000000;
    minRefinementCells 0;
    maxLoadUnbalance 0.1;
    nCellsBetweenLevels 3;
    features
    (
{1}    );
    refinementSurfaces
    {{
{2}    }}
    resolveFeatureAngle 60;
    refinementRegions {{ }}
    locationInMesh ({3:.17g} {4:.17g} {5:.17g});
    allowFreeStandingZoneFaces true;
}}
snapControls
{{
    nSmoothPatch 3;
    tolerance 2;
    nSolveIter 100;
    nRelaxIter 5;
    nFeatureSnapIter 10;
    implicitFeatureSnap false;
    explicitFeatureSnap true;
    multiRegionFeatureSnap false;
}}
addLayersControls
{{
    relativeSizes true;
    layers {{ }}
    expansionRatio 1.2;
    finalLayerThickness 0.3;
    minThickness 0.1;
    nGrow 0;
    featureAngle 130;
    nRelaxIter 5;
    nSmoothSurfaceNormals 1;
    nSmoothNormals 3;
    nSmoothThickness 10;
    maxFaceThicknessRatio 0.5;
    maxThicknessToMedialRatio 0.3;
    minMedianAxisAngle 90;
    nBufferCellsNoExtrude 0;
    nLayerIter 50;
}}
meshQualityControls
{{
    maxNonOrtho 65;
    maxBoundarySkewness 3;
    maxInternalSkewness 2;
    maxConcave 80;
    minFlatness 0.5;
    minVol 1e-15;
    minTetQuality 1e-15;
    minArea -1;
    minTwist 0.02;
    minDeterminant 0.001;
    minFaceWeight 0.05;
    minVolRatio 0.01;
    minTriangleTwist -1;
    nSmoothScale 4;
    errorReduction 0.75;
    relaxed {{ maxNonOrtho 75; }}
}}
mergeTolerance 1e-6;
)foam";

/// Edges that the mesh is to have too.
void write_hems(const fs::path& path, const std::vector<Triangle>& surface) {
  std::map<std::array<double, 3>, std::size_t> numbers;
  std::string points, edges;
  const auto number_of = [&](Vec3 v) {
    const auto [at, is_new] = numbers.emplace(std::array{v.x, v.y, v.z}, numbers.size());
    if (is_new) points += fmt::format("({:.17g} {:.17g} {:.17g})\n", v.x, v.y, v.z);
    return at->second;
  };
  const auto all = hems(surface);
  for (const auto& [from, to, inward] : all) {
    const std::size_t begin = number_of(from), end = number_of(to);
    edges += fmt::format("({} {})\n", begin, end);
  }
  write_dictionary(path, "featureEdgeMesh",
                   fmt::format("{}\n(\n{})\n{}\n(\n{})\n", numbers.size(), points, all.size(), edges));
}

void write_snappy(const fs::path& folder, const FlowProblem& problem, int levels) {
  std::string geometry, features, surfaces, baffles;
  for (std::size_t s = 0; s < problem.bodies.size(); ++s) {
    if (problem.bodies[s].surface.empty()) continue;
    const std::string name = name_of(s);
    write_stl(folder / "constant/triSurface" / (name + ".stl"), problem.bodies[s].surface);
    geometry += fmt::format("    {0}.stl {{ type triSurfaceMesh; name {0}; }}\n", name);
    features += fmt::format("        {{ file \"{}.eMesh\"; level {}; }}\n", name, levels);
    surfaces +=
        fmt::format("        {0} {{ level ({1} {1}); faceZone {0}; faceType internal; }}\n", name, levels);
    write_hems(folder / "constant/triSurface" / (name + ".eMesh"), problem.bodies[s].surface);
    const FlowBody& sheet = problem.bodies[s];
    const bool loose = is_loose_in(problem, sheet);
    const auto patch = [&](const char* side, const char* other) {
      return fmt::format(
          "{0}_{1}; {2}", name, side,
          loose ? fmt::format("type cyclic; matchTolerance 1e-4; neighbourPatch {}_{};", name, other)
                : "type wall;");
    };
    baffles += fmt::format(
        "    {0}\n    {{\n        type faceZone; zoneName {0};\n        patches\n        {{\n"
        "            master {{ name {1} }}\n            slave {{ name {2} }}\n        }}\n    }}\n",
        name, patch("low", "high"), patch("high", "low"));
  }
  // A point of no face: within the first cell of a corner.
  const FlowGrid& grid = problem.grid;
  const auto inside = [&](int axis, double share) {
    return grid.edge(axis, 0) + share * (grid.edge(axis, 1) - grid.edge(axis, 0));
  };
  write_dictionary(folder / "system/snappyHexMeshDict", "dictionary",
                   fmt::format(kSnappy, geometry, features, surfaces, inside(0, 0.317), inside(1, 0.373),
                               inside(2, 0.411)));
  write_dictionary(folder / "system/createBafflesDict", "dictionary",
                   fmt::format("internalFacesOnly true;\nnoFields true;\nbaffles\n{{\n{}}}\n", baffles));
}

/// Of a surface.
struct Size {
  double area = 0, rim = 0;

  explicit Size(const std::vector<Triangle>& surface) : area(surface_area(surface)) {
    for (const Hem& hem : hems(surface)) rim += norm(hem.to - hem.from);
  }
};

/// Points and faces of constant/polyMesh.
class Geometry {
 public:
  explicit Geometry(const fs::path& mesh)
      : points_(read_points(mesh / "points")), faces_(read_faces(mesh / "faces")) {
    for (const int point : faces_.corners)
      if (point < 0 || static_cast<std::size_t>(point) >= points_.size())
        throw Error(ExitCode::io, (mesh / "faces").string() + " refers to a point that does not exist");
  }

  std::size_t faces() const { return faces_.begins.size() - 1; }
  /// About its middle.
  void add_triangles(std::size_t face, std::vector<Triangle>& surface) const {
    const Vec3 middle = centre(face);
    const int begin = faces_.begins[face], end = faces_.begins[face + 1];
    for (int n = begin; n < end; ++n)
      surface.push_back(
          {middle, points_[faces_.corners[n]], points_[faces_.corners[n + 1 < end ? n + 1 : begin]]});
  }
  Vec3 centre(std::size_t face) const {
    Vec3 sum;
    for (int n = faces_.begins[face]; n < faces_.begins[face + 1]; ++n) sum += points_[faces_.corners[n]];
    return sum / (faces_.begins[face + 1] - faces_.begins[face]);
  }
  /// Whether two faces have the same corners.
  bool same(std::size_t one, std::size_t other) const {
    const auto corners = [&](std::size_t face) {
      std::vector<int> all(faces_.corners.begin() + faces_.begins[face],
                           faces_.corners.begin() + faces_.begins[face + 1]);
      std::sort(all.begin(), all.end());
      return all;
    };
    return corners(one) == corners(other);
  }
  /// Out of the face's owner [m2].
  Vec3 area(std::size_t face) const {
    std::vector<Triangle> parts;
    add_triangles(face, parts);
    Vec3 sum;
    for (const Triangle& t : parts) sum += 0.5 * cross(t.b - t.a, t.c - t.a);
    return sum;
  }

 private:
  std::vector<Vec3> points_;
  FaceList faces_;
};

int cells_of(const std::vector<int>& owner, const std::vector<int>& neighbour) {
  int last = 0;
  for (const auto& cells : {std::cref(owner), std::cref(neighbour)})
    for (const int cell : cells.get()) last = std::max(last, cell);
  return last + 1;
}

/// The grid's cell that each cell of the mesh lies in by the middle of its faces' middles, its part of the volume of
/// all cells there, and a substitute for grid cells without any.
void find_cells(const Geometry& geometry, const std::vector<int>& neighbour, const FlowGrid& grid,
                MeshPart& part) {
  const std::size_t count = static_cast<std::size_t>(cells_of(part.owner, neighbour));
  std::vector<Vec3> centre(count);
  std::vector<double> volume(count), faces(count);
  const auto add = [&](int cell, Vec3 middle, Vec3 area) {
    centre[cell] += middle;
    volume[cell] += dot(middle, area) / 3;
    faces[cell] += 1;
  };
  for (std::size_t face = 0; face < geometry.faces(); ++face) {
    const Vec3 middle = geometry.centre(face), area = geometry.area(face);
    add(part.owner[face], middle, area);
    if (face < neighbour.size()) add(neighbour[face], middle, -area);
  }
  std::vector<double> whole(static_cast<std::size_t>(grid.cells()));
  part.cells.resize(count);
  for (std::size_t cell = 0; cell < count; ++cell) {
    const Vec3 at = centre[cell] / faces[cell];
    part.cells[cell] = grid.index(grid.cell_at(0, at.x), grid.cell_at(1, at.y), grid.cell_at(2, at.z));
    whole[part.cells[cell]] += volume[cell];
  }
  part.share.resize(count);
  for (std::size_t cell = 0; cell < count; ++cell) part.share[cell] = volume[cell] / whole[part.cells[cell]];
  for (int cell = 0; cell < grid.cells(); ++cell) {
    if (whole[cell] > 0) continue;
    const Vec3 at = grid.centre(cell % grid.nx, cell / grid.nx % grid.ny, cell / (grid.nx * grid.ny));
    const auto apart = [&](std::size_t other) { return norm(centre[other] / faces[other] - at); };
    std::size_t nearest = 0;
    for (std::size_t other = 1; other < count; ++other)
      if (apart(other) < apart(nearest)) nearest = other;
    part.stand_ins.emplace_back(cell, static_cast<int>(nearest));
  }
}

Vec3 nearest_on(const Triangle& t, Vec3 p) {
  const Vec3 ab = t.b - t.a, ac = t.c - t.a;
  const auto on = [](Vec3 from, Vec3 along, Vec3 to) {
    const double length = dot(along, along);
    return from + (length > 0 ? std::clamp(dot(to - from, along) / length, 0.0, 1.0) : 0.0) * along;
  };
  const Vec3 normal = cross(ab, ac);
  if (const double size = dot(normal, normal); size > 0) {
    const Vec3 ap = p - t.a;
    const double v = dot(cross(ap, ac), normal) / size, w = dot(cross(ab, ap), normal) / size;
    if (v >= 0 && w >= 0 && v + w <= 1) return t.a + v * ab + w * ac;
  }
  Vec3 best = on(t.a, ab, p);
  for (const Vec3 other : {on(t.a, ac, p), on(t.b, t.c - t.b, p)})
    if (norm(other - p) < norm(best - p)) best = other;
  return best;
}

/// Where on a surface the nearest point to another is.
class Nearest {
 public:
  explicit Nearest(const std::vector<Triangle>& surface) : surface_(surface) {
    for (const Triangle& t : surface) {
      const Vec3 middle = (t.a + t.b + t.c) / 3;
      balls_.push_back({middle, std::max({norm(t.a - middle), norm(t.b - middle), norm(t.c - middle)})});
    }
  }

  struct Place {
    int triangle = 0;
    Vec3 point;
  };
  Place to(Vec3 p) const {
    Place place;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < surface_.size(); ++n) {
      const double out = least + balls_[n].radius;
      const Vec3 apart = balls_[n].middle - p;
      if (dot(apart, apart) > out * out) continue;
      const Vec3 point = nearest_on(surface_[n], p);
      if (norm(point - p) >= least) continue;
      least = norm(point - p);
      place = {static_cast<int>(n), point};
    }
    return place;
  }

 private:
  struct Ball {
    Vec3 middle;
    double radius;
  };
  const std::vector<Triangle>& surface_;
  std::vector<Ball> balls_;
};

const Patch& patch_of(const MeshPart& part, const std::string& name) {
  for (const Patch& patch : part.patches)
    if (patch.name == name) return patch;
  throw Error(ExitCode::external,
              fmt::format("OpenFOAM's mesh in {} has no patch {}", part.folder.string(), name));
}

std::vector<Baffle> baffles_on(int number, const FlowBody& sheet, const MeshPart& part,
                               const Geometry& geometry) {
  const std::string name = name_of(static_cast<std::size_t>(number));
  const std::string low_name = name + "_low", high_name = name + "_high";
  const Patch &low = patch_of(part, low_name), &high = patch_of(part, high_name);
  const Nearest nearest(sheet.surface);
  std::vector<Baffle> baffles;
  std::vector<Triangle> faces;
  for (int n = 0; n < low.faces; ++n) {
    const std::size_t face = static_cast<std::size_t>(low.start + n),
                      other = static_cast<std::size_t>(high.start + n);
    if (low.faces != high.faces || !geometry.same(face, other))
      throw Error(ExitCode::external,
                  fmt::format("OpenFOAM's mesh in {} has two sides of {} that do not coincide",
                              part.folder.string(), name));
    Baffle baffle;
    baffle.low = part.owner[face], baffle.high = part.owner[other];
    baffle.area = geometry.area(face);
    const auto [triangle, point] = nearest.to(geometry.centre(face));
    const Triangle& t = sheet.surface[triangle];
    Layer layer;
    layer.body = number, layer.triangle = triangle, layer.point = point;
    layer.against = dot(cross(t.b - t.a, t.c - t.a), baffle.area) < 0;
    layer.area = norm(baffle.area);
    layer.outward = (layer.against ? -1 : 1) / layer.area * baffle.area;
    geometry.add_triangles(face, faces);
    baffle.layers.push_back(layer);
    baffles.push_back(std::move(baffle));
  }
  const Size size(faces), whole(sheet.surface);
  const auto alike = [](double a, double b) { return std::abs(a - b) <= tolerance * b; };
  if (!alike(size.area, whole.area) || !alike(size.rim, whole.rim))
    throw QuantityError(
        ExitCode::external,
        fmt::format(
            "OpenFOAM's mesh has {:.4g} m2 of faces with {:.4g} m of rims on {:.4g} m2 of cloth with {:.4g} "
            "m: its cells are too coarse for gaps or folds of the cloth; use a finer flow grid or a higher "
            "refinement at the cloth",
            size.area, size.rim, whole.area, whole.rim),
        {"flow grid", "refinement at the cloth"});
  const double slant = whole.area / size.area;
  for (Baffle& baffle : baffles)
    for (Layer& layer : baffle.layers) layer.area *= slant, layer.slant = slant;
  return baffles;
}

/// Cells that cloth encloses on all sides, in the creases of folds, have no pressure. One face of each such pocket is
/// opened, so that it is part of the flow on that side.
void open_pockets(const fs::path& mesh) {
  constexpr double large = 0.01;                // of all cells: a closed body is no crease
  if (!fs::exists(mesh / "faceZones")) return;  // no face on the cloth: reported where the faces are counted
  std::vector<FaceZone> zones = read_face_zones(mesh / "faceZones");
  const std::vector<int> owner = read_labels(mesh / "owner"), neighbour = read_labels(mesh / "neighbour");
  std::vector<char> cloth(neighbour.size());
  for (const FaceZone& zone : zones)
    for (const int face : zone.faces)
      if (face >= 0 && static_cast<std::size_t>(face) < cloth.size()) cloth[face] = 1;
  std::vector<int> leader, size;
  const auto first_of = [&](int cell) {
    while (leader[cell] != cell) cell = leader[cell] = leader[leader[cell]];
    return cell;
  };
  const auto join = [&](int one, int other) {
    one = first_of(one), other = first_of(other);
    if (one == other) return;
    if (size[one] < size[other]) std::swap(one, other);
    leader[other] = one, size[one] += size[other];
  };
  leader.resize(static_cast<std::size_t>(cells_of(owner, neighbour)));
  for (std::size_t cell = 0; cell < leader.size(); ++cell) leader[cell] = static_cast<int>(cell);
  size.assign(leader.size(), 1);
  for (std::size_t face = 0; face < neighbour.size(); ++face)
    if (!cloth[face]) join(owner[face], neighbour[face]);
  bool opened = false;
  for (FaceZone& zone : zones) {
    std::erase_if(zone.faces, [&](int face) {
      const int one = first_of(owner[face]), other = first_of(neighbour[face]);
      if (one == other || std::min(size[one], size[other]) > large * static_cast<double>(leader.size()))
        return false;
      join(one, other);
      return opened = true;
    });
  }
  if (!opened) return;
  std::string body = fmt::format("{}\n(\n", zones.size());
  for (const FaceZone& zone : zones)
    body += fmt::format(
        "{}\n{{\n    type faceZone;\n    faceLabels List<label> {}({});\n    flipMap List<bool> "
        "{}{{0}};\n}}\n",
        zone.name, zone.faces.size(), fmt::join(zone.faces, " "), zone.faces.size());
  write_dictionary(mesh / "faceZones", "regIOobject", body + ")\n");
}

constexpr const char* finer = "try cells of more equal sides or a different refinement at the cloth";

void mesh_with(const Programs& programs, const fs::path& folder, const FlowProblem& problem, int levels) {
  remove_path(folder / "constant/polyMesh");
  remove_path(folder / "constant/triSurface");
  make_folder(folder / "constant/triSurface");
  write_snappy(folder, problem, levels);
  programs.run_tool("blockMesh");
  if (std::all_of(problem.bodies.begin(), problem.bodies.end(),
                  [](const FlowBody& s) { return s.surface.empty(); }))
    return;
  programs.run_tool("snappyHexMesh", {"-overwrite"}, finer);
  open_pockets(folder / "constant/polyMesh");
  programs.run_tool("createBaffles", {"-overwrite"}, finer);
  std::vector<std::string> faults;
  programs.run_tool("checkMesh", {"-constant"}, finer, [&](const std::string& line) {
    const std::size_t stars = line.find("***");
    if (line.find("*Number of regions") != std::string::npos) faults.emplace_back("cloth encloses cells");
    if (stars != std::string::npos) faults.push_back(line.substr(stars + 3));
  });
  if (!faults.empty())
    throw Error(ExitCode::external, fmt::format("checkMesh of OpenFOAM rejects the mesh in {}: {}; {}",
                                                folder.string(), fmt::join(faults, "; "), finer));
}

}  // namespace

void make_fitted_mesh(const fs::path& folder, const FlowProblem& problem, int levels,
                      const Programs& programs) {
  try {
    mesh_with(programs, folder, problem, levels);
  } catch (const Error& error) {
    throw restated(error, error.what(), {"cells of more equal sides", "refinement at the cloth"});
  }
}

FittedMesh read_fitted_mesh(const fs::path& folder, const FlowProblem& problem) {
  FittedMesh mesh{read_mesh(folder, 1).front(), {}};
  const Geometry geometry(folder / "constant/polyMesh");
  if (geometry.faces() != mesh.part.owner.size())
    throw Error(ExitCode::io, fmt::format("OpenFOAM's mesh in {} has {} faces and {} owners", folder.string(),
                                          geometry.faces(), mesh.part.owner.size()));
  find_cells(geometry, read_labels(folder / "constant/polyMesh/neighbour"), problem.grid, mesh.part);
  for (std::size_t s = 0; s < problem.bodies.size(); ++s) {
    const FlowBody& sheet = problem.bodies[s];
    if (sheet.surface.empty()) continue;
    BafflePatch patch;
    patch.name = name_of(s);
    patch.baffles = baffles_on(static_cast<int>(s), sheet, mesh.part, geometry);
    patch.loose = is_loose_in(problem, sheet);
    const double slant = patch.baffles.front().layers.front().slant;
    patch.linear = sheet.drop().linear / slant, patch.quadratic = sheet.drop().quadratic / (slant * slant);
    mesh.patches.push_back(std::move(patch));
  }
  return mesh;
}

}  // namespace ripstop::inline flow::openfoam

namespace ripstop::inline flow {

double fitted_cells(const FlowGrid& grid, double cloth_area, int levels) {
  // Measured (log.checkMesh): 6.6 to 8.2 at canopies of 14 to 28 cells across, 10.4 at a cup of 4.
  constexpr double cells_a_face = 8;
  const Vec3 h = grid.spacing();
  const double faces = cloth_area / std::pow(h.x * h.y * h.z, 2.0 / 3);
  double cells = grid.cells();
  for (int level = 1; level <= levels; ++level) cells += cells_a_face * faces * std::pow(4, level);
  return cells;
}

}  // namespace ripstop::inline flow

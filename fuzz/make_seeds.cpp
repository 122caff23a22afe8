// Seeds that are bytes: written by the code that writes such files, so that they follow every change of a format.
#include <filesystem>

#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/flow/stl.h"
#include "ripstop/output/vtk.h"
#include "ripstop/run/opening/inflation_folder.h"
#include "ripstop/run/steady/checkpoint.h"
#include "ripstop/run/steady/steady.h"

namespace {

using namespace ripstop;
namespace fs = std::filesystem;

std::string header(const std::string& format, const std::string& kind) {
  return "FoamFile\n{\n version 2.0;\n format " + format + ";\n class " + kind +
         ";\n arch \"LSB;label=32;scalar=64\";\n object seed;\n}\n";
}

std::string field(const std::string& format, const std::string& list) {
  return header(format, "volVectorField") +
         "dimensions [0 1 -1 0 0 0 0];\ninternalField nonuniform List<vector> 2(" + list +
         ");\nboundaryField\n{\n inlet { type fixedValue; value uniform (0 0 7); }\n sides { type "
         "zeroGradient; }\n}\n";
}

std::string binary(const std::vector<int>& labels) {
  return std::to_string(labels.size()) + "(" +
         std::string(reinterpret_cast<const char*>(labels.data()), labels.size() * sizeof(int)) + ")";
}

/// The points, faces and zones of a mesh.
void write_mesh(const fs::path& folder) {
  write_file(folder / "points", header("ascii", "vectorField") + "3((0 0 0)(1 0 0)(0 1 0))\n");
  write_file(folder / "faces", header("binary", "faceCompactList") + binary({0, 3, 7}) + "\n" +
                                   binary({0, 1, 2, 0, 2, 3, 4}) + "\n");
  write_file(folder / "faceZones", header("binary", "regIOobject") +
                                       "1(cloth { type faceZone; faceLabels List<label> " + binary({5, 6}) +
                                       "; flipMap List<bool> 2(" + std::string("\0\1", 2) + "); })\n");
}

void write_checkpoints(const fs::path& folder) {
  SteadyState steady;
  steady.shape = {{0, 0, 1}, {1, 0, 2}, {0, 1, 3}};
  steady.pressure = {100, 101.5};
  steady.iterations.emplace_back();
  write_file(folder / "steady", to_bytes(steady));
  InflationState opening;
  opening.cloth.x = {0, 1, 2};
  opening.cloth.v = {0.5, 0, -1};
  write_file(folder / "opening", to_bytes(opening));
  write_file(folder / "result", to_json(SteadyResult{}));
  write_sealed(folder / "sealed", "what is sealed");
}

void write_vtk(const fs::path& folder) {
  VtkSurface surface;
  surface.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}};
  const int quad[] = {0, 1, 2, 3};
  surface.polygons.add(quad);
  surface.point_arrays.push_back(vtk_array("height_m", std::vector<double>{0, 0, 0, 0.5}));
  write_vtp(folder / "canopy.vtp", surface);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const fs::path root = argv[1];
  for (const char* reader : {"stl", "vtk", "checkpoint", "openfoam"}) make_folder(root / reader);
  write_stl(root / "stl" / "two.stl", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}});
  write_vtk(root / "vtk");
  write_checkpoints(root / "checkpoint");
  const std::vector<double> values = {1, 2, 3, 4, -5, 6e-300};
  write_file(root / "openfoam" / "binary",
             field("binary", {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)}));
  write_file(root / "openfoam" / "ascii", field("ascii", "(1 2 3)(4 -5 6e-300)"));
  write_mesh(root / "openfoam");
  return 0;
}

#include "ripstop/flow/openfoam/state.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/core/reasons.h"
#include "ripstop/flow/boundaries.h"

namespace ripstop::inline flow::openfoam {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kMarker = "saved.json";
constexpr int kFormat = 3;

[[noreturn]] void fail(const fs::path& path, const char* what) {
  throw Error(ExitCode::io, fmt::format("{}: {}: {}", path.string(), what, std::strerror(errno)));
}

void flush(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail(path, "cannot be opened");
  const int result = fsync(file);
  close(file);
  if (result != 0) fail(path, "cannot be flushed to the disk");
}

json to_json(Vec3 v) {
  return json::array({v.x, v.y, v.z});
}

Vec3 vec3(const json& j) {
  return {j.at(0), j.at(1), j.at(2)};
}

json to_json(const Grading& g) {
  return json::array({g.core_low, g.core_high, g.before, g.after, g.ratio_before, g.ratio_after});
}

Grading grading(const json& j) {
  return {j.at(0), j.at(1), j.at(2), j.at(3), j.at(4), j.at(5)};
}

json describe_basis(const Basis& basis) {
  const Freestream& air = basis.air;
  return {
      {"grid",
       {{"origin_m", to_json(basis.grid.origin)},
        {"size_m", to_json(basis.grid.size)},
        {"cells", {basis.grid.nx, basis.grid.ny, basis.grid.nz}},
        {"grading",
         {to_json(basis.grid.grading[0]), to_json(basis.grid.grading[1]), to_json(basis.grid.grading[2])}}}},
      {"air",
       {{"velocity_m_s", to_json(air.velocity)},
        {"density_kg_m3", air.density},
        {"viscosity_pa_s", air.viscosity},
        {"temperature_k", air.temperature},
        {"turbulence_intensity", air.turbulence_intensity},
        {"viscosity_ratio", air.viscosity_ratio}}},
      {"sides", std::string(basis.sides.word)},
      {"ranks", basis.ranks},
      {"second_order", basis.second_order},
      {"incompressible", basis.incompressible},
      {"fitted_mesh", basis.fitted_mesh},
      {"cloth_levels", basis.cloth_levels},
      {"quarter", basis.quarter}};
}

Basis basis_from(const json& j) {
  Basis basis;
  const json& grid = j.at("grid");
  const json& air = j.at("air");
  basis.grid = {vec3(grid.at("origin_m")),
                vec3(grid.at("size_m")),
                grid.at("cells").at(0),
                grid.at("cells").at(1),
                grid.at("cells").at(2),
                {grading(grid.at("grading").at(0)), grading(grid.at("grading").at(1)),
                 grading(grid.at("grading").at(2))}};
  basis.air = {vec3(air.at("velocity_m_s")), air.at("density_kg_m3"),        air.at("viscosity_pa_s"),
               air.at("temperature_k"),      air.at("turbulence_intensity"), air.at("viscosity_ratio")};
  const std::string sides = j.at("sides");
  for (const auto& row : boundaries())
    if (row->word == sides) basis.sides = {row->word};
  basis.ranks = j.at("ranks");
  basis.second_order = j.at("second_order");
  basis.incompressible = j.value("incompressible", false);  // old records without the choice
  basis.fitted_mesh = j.value("fitted_mesh", false);
  basis.cloth_levels = j.value("cloth_levels", 0);
  basis.quarter = j.value("quarter", false);
  return basis;
}

fs::path part_name(std::size_t part) {
  return fmt::format("part{}", part);
}

/// Files of the problem written by a call (engine.cpp, write_problem): their place, and their place in a
/// saved state.
std::vector<std::pair<fs::path, fs::path>> problem_files(const CaseFolders& folders, const fs::path& saved) {
  const fs::path zones = "constant/polyMesh/cellZones";
  std::vector<std::pair<fs::path, fs::path>> files;
  for (const fs::path file :
       {"constant/porosityProperties", "constant/cellZones", "system/controlDict", "system/fvSolution"})
    files.emplace_back(folders.whole / file, saved / "problem" / file.filename());
  files.emplace_back(folders.whole / zones, saved / "problem/cellZones.mesh");
  if (folders.with_mesh)
    for (const fs::path file : {"points", "faces", "owner", "neighbour", "boundary"})
      files.emplace_back(folders.whole / "constant/polyMesh" / file, saved / "problem" / file);
  for (std::size_t part = 0; part < folders.parts.size(); ++part)
    if (folders.parts[part] != folders.whole)
      files.emplace_back(folders.parts[part] / zones,
                         saved / "problem" / ("cellZones." + part_name(part).string()));
  return files;
}

}  // namespace

bool operator==(const Basis& a, const Basis& b) {
  return describe_basis(a) == describe_basis(b);
}

void save_state(const fs::path& folder, const Basis& basis, const CaseFolders& case_folders,
                const std::string& time) {
  make_folder(folder);
  if (fs::remove(folder / seal_name)) flush(folder);  // from here until the end the folder counts as empty
  for (std::size_t part = 0; part < case_folders.parts.size(); ++part) {
    const fs::path from = case_folders.parts[part] / time, to = folder / part_name(part);
    remove_path(to);
    fs::copy(from, to, fs::copy_options::recursive);
    for (const auto& entry : fs::recursive_directory_iterator(to)) flush(entry.path());
    flush(to);
  }
  remove_path(folder / "problem");
  make_folder(folder / "problem");
  for (const auto& [from, to] : problem_files(case_folders, folder)) {
    if (!fs::exists(from)) continue;  // a flow that nobody advanced has no cells
    fs::copy_file(from, to);
    flush(to);
  }
  flush(folder / "problem");
  const json marker = {{"what", "flow fields saved by Ripstop from an OpenFOAM case"},
                       {"format", kFormat},
                       {"time", time},
                       {"basis", describe_basis(basis)}};
  write_file(folder / kMarker, marker.dump(2) + "\n");
  seal_folder(folder);
}

SavedState read_state(const fs::path& folder) {
  const fs::path path = folder / kMarker;
  check_folder(folder);
  try {
    const json marker = json::parse(read_file(path));
    if (marker.at("format") != kFormat) {
      throw Error(ExitCode::io, fmt::format("{} has format {}; this version reads {}", path.string(),
                                            marker.at("format").dump(), kFormat));
    }
    SavedState state{basis_from(marker.at("basis")), marker.at("time")};
    if (state.time.empty() || state.time.find_first_not_of("0123456789") != std::string::npos) {
      throw Error(ExitCode::io, fmt::format("{} contains no valid time", path.string()));
    }
    return state;
  } catch (const json::exception& error) {
    throw Error(ExitCode::io, fmt::format("{} is damaged: {}; start again with --fresh", path.string(),
                                          json_reason(error)));
  }
}

void copy_state(const fs::path& folder, const SavedState& state, const CaseFolders& to) {
  for (std::size_t part = 0; part < to.parts.size(); ++part) {
    remove_path(to.parts[part] / state.time);
    fs::copy(folder / part_name(part), to.parts[part] / state.time, fs::copy_options::recursive);
  }
  for (const auto& [lies, saved] : problem_files(to, folder))
    if (fs::exists(saved)) fs::copy_file(saved, lies, fs::copy_options::overwrite_existing);
}

}  // namespace ripstop::inline flow::openfoam

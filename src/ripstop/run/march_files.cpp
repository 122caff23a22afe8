#include "ripstop/run/march_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "ripstop/canopy/stress.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/flow/unsteady.h"

namespace ripstop::inline run {
namespace {

namespace fs = std::filesystem;

constexpr const char* file = "checkpoint";

}  // namespace

fs::path MarchFiles::air_folder(int which) const {
  return folder_.own("air/") / alternating_folders[static_cast<std::size_t>(which)];
}

void MarchFiles::drop_air(const fs::path& folder) {
  remove_path(folder / "air");
}

MarchFiles::Table& MarchFiles::table(const std::string& name) {
  return *std::find_if(tables_.begin(), tables_.end(), [&](const Table& t) { return t.name == name; });
}

std::string MarchFiles::hash() const {
  std::string hashes;
  for (const Table& table : tables_) hashes += hash_file(folder_.own(table.name));
  return hash_bytes(hashes);
}

std::optional<std::string> MarchFiles::load() {
  const fs::path saved = folder_.own(file);
  if (!fs::exists(saved)) return std::nullopt;
  const std::string bytes = read_sealed(saved), head = bytes.substr(0, bytes.find('\n'));
  loaded_ = head.substr(0, head.find(' '));
  last_ = head.ends_with(alternating_folders[1]) ? 1 : 0;
  return bytes.substr(std::min(bytes.size(), head.size() + 1));
}

void MarchFiles::check() const {
  if (!loaded_.empty() && loaded_ != hash()) {
    std::vector<std::string> names;
    for (const Table& table : tables_) names.push_back(table.name);
    throw Error(ExitCode::bad_data,
                fmt::format("{}: {} is missing or was changed after the checkpoint; start again with --fresh",
                            folder_.path().string(), fmt::join(names, " or ")));
  }
  refuse_lost(folder_);
}

void MarchFiles::save(const std::string& state, const CoupledFlow* air) {
  std::string head = hash();
  if (air) {
    last_ = 1 - last_;
    air->save(air_folder(last_));
    head += fmt::format(" {}", alternating_folders[static_cast<std::size_t>(last_)]);
  }
  folder_.keep();
  write_sealed(folder_.own(file), head + '\n' + state);
  timer_.restart();
}

std::string frame_file(const std::string& what, long long frame, const std::string& ending) {
  return fmt::format("vtk/{}_{:04}.{}", what, frame, ending);
}

void write_frame(RunFolder& folder, const CanopyMesh& mesh, const Cloth& cloth, const ClothState& state,
                 const std::vector<double>& pressure, long long frame) {
  make_folder(folder.path() / "vtk");
  const std::vector<Vec3> x = positions(state, cloth);
  std::vector<double> mises, strain;
  for (const CellStress& stress : cell_stress(cloth, state)) {
    mises.push_back(stress.von_mises);
    strain.push_back(stress.max_strain);
  }
  VtkSurface canopy = canopy_surface(mesh, x);
  canopy.point_arrays.push_back(vtk_array_single("velocity_m_per_s", velocities(state, cloth)));
  const auto add = [&](const char* name, const std::vector<double>& values) {
    canopy.cell_arrays.push_back(vtk_array_single(name, cloth_cells_only(mesh, values)));
  };
  add("von_mises_n_per_m", mises), add("strain_max", strain);
  if (!pressure.empty()) add("pressure_difference_applied_pa", pressure);
  folder.write(frame_file("canopy", frame), canopy);
  VtkSurface lines = spring_lines(mesh, x);
  lines.cell_arrays.push_back(vtk_array_single("tension_n", spring_tensions(cloth, state)));
  folder.write(frame_file("lines", frame), lines);
}

void write_air_frame(RunFolder& folder, const CoupledFlow& air, long long frame) {
  const FlowField field = air.flow().field();
  const fs::path name = folder.own(frame_file("air", frame, air_ending(field.grid)));
  write_image(fs::path(name).replace_extension(), flow_image(middle_plane(field)));
}

}  // namespace ripstop::inline run

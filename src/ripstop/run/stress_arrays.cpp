#include "ripstop/run/stress_arrays.h"

#include "ripstop/canopy/stress.h"

namespace ripstop::inline run {

std::vector<VtkArray> stress_arrays(const Mesh& mesh, const std::vector<Vec3>& positions,
                                    const std::vector<CellStress>& stress) {
  std::vector<VtkArray> arrays;
  const auto add = [&](const char* name, const auto& value) {
    std::vector<double> values;
    values.reserve(stress.size());
    for (const CellStress& s : stress) values.push_back(value(s));
    arrays.push_back(vtk_array(name, cloth_cells_only(mesh, values)));
  };
  add("stress_max_n_per_m", [](const CellStress& s) { return s.principal_max; });
  add("stress_min_n_per_m", [](const CellStress& s) { return s.principal_min; });
  add("warp_n_per_m", [](const CellStress& s) { return s.warp; });
  add("weft_n_per_m", [](const CellStress& s) { return s.weft; });
  add("tautness", [](const CellStress& s) { return static_cast<double>(s.tautness); });
  add("von_mises_n_per_m", [](const CellStress& s) { return s.von_mises; });
  add("strain_max", [](const CellStress& s) { return s.max_strain; });
  std::vector<Vec3> directions;
  const std::vector<Cell> cells = cells_of(mesh);
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i].corner[0] >= 0) directions.push_back(stress[i].direction);
  arrays.push_back(vtk_array("stress_max_direction", directions));
  std::vector<double> means;
  for (const CellStress& s : strip_stress(mesh, positions, stress)) means.push_back(s.von_mises);
  arrays.push_back(vtk_array("von_mises_strip_n_per_m", cloth_cells_only(mesh, means)));
  return arrays;
}

}  // namespace ripstop::inline run

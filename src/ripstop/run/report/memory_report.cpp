#include "ripstop/run/report/memory_report.h"

#include <algorithm>

#include "ripstop/output/vtk.h"
#include "ripstop/run/report/report_tables.h"
#include "ripstop/run/stress_arrays.h"

namespace ripstop::inline run {

ReportRun memory_report(const std::string& kind, const std::string& json, const Settings& resolved) {
  ReportRun run;
  add_result(run, json, "result.json");
  run.kind = kind;
  run.name = "in memory";
  run.headline = headline_of(kind);
  run.case_file = case_toml(resolved);
  run.tables.push_back(bill_table(resolved));
  add_unusable(run);
  if (!run.converged) run.warnings.insert(run.warnings.begin(), "The run did not converge.");
  return run;
}

ShapeView memory_shape(const Mesh& mesh, const std::vector<Vec3>& positions,
                       const std::vector<CellStress>& stress) {
  if (positions.empty()) return {};
  VtkSurface canopy = canopy_surface(mesh, positions);
  if (!stress.empty())
    for (VtkArray& array : stress_arrays(mesh, positions, stress))
      canopy.cell_arrays.push_back(std::move(array));
  ShapeView view = shape_of(canopy, spring_lines(mesh, positions));
  view.part_names = mesh.parts;
  return view;
}

ShapeView memory_shape(const Mesh& mesh, const std::vector<Snapshot>& snapshots) {
  ShapeView view;
  const std::size_t count = std::min(snapshots.size(), most_frames);
  for (std::size_t i = 0; i < count; ++i) {
    const Snapshot& shot = snapshots[count > 1 ? i * (snapshots.size() - 1) / (count - 1) : 0];
    ShapeView one = memory_shape(mesh, shot.positions, {});
    ShapeFrame& frame = one.frames.front();
    frame.time = shot.time;
    frame.cells.push_back({"von_mises_n_per_m", cloth_cells_only(mesh, shot.von_mises)});
    if (i == 0)
      view = std::move(one);
    else
      view.frames.push_back(std::move(frame));
  }
  return view;
}

}  // namespace ripstop::inline run

// The report of a run in memory, without a folder, for a notebook. Its plots are those of report_plots and
// report_flight.
#pragma once

#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/cloth/cloth.h"
#include "ripstop/fsi/opening_record.h"
#include "ripstop/mesh/mesh.h"
#include "ripstop/output/csv.h"
#include "ripstop/report/report.h"

namespace ripstop::inline run {

/// Values, tables and case of a result, `json` as in result.json. `kind` as in ReportRun, or "fabric". Throws
/// Error(bad_data).
ReportRun memory_report(const std::string& kind, const std::string& json, const Settings& resolved);

/// One shape with the stress of every cell; no stress: it is not known. Without positions there is no shape.
ShapeView memory_shape(const Mesh& mesh, const std::vector<Vec3>& positions,
                       const std::vector<CellStress>& stress);
/// Shapes in time, at most `most_frames` of them.
ShapeView memory_shape(const Mesh& mesh, const std::vector<Snapshot>& snapshots);
inline constexpr std::size_t most_frames = 25;

/// Listed structs as the table that a run folder has of them.
template <class Row>
CsvTable memory_table(const std::vector<Row>& rows) {
  CsvTable table{columns_of<Row>(), {}};
  for (const Row& row : rows) table.rows.push_back(row_of(row));
  return table;
}

}  // namespace ripstop::inline run

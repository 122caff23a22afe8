// The files of a run in time: tables that grow, checkpoints, and shapes for ParaView.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/core/members.h"
#include "ripstop/core/vec3.h"
#include "ripstop/fsi/coupled_flow.h"
#include "ripstop/parachute/canopy_mesh.h"
#include "ripstop/run/checkpoint_parts.h"
#include "ripstop/run/run_folder.h"

namespace ripstop::inline run {

/// The tables and checkpoints of a run in time. A checkpoint is a sealed file: the hash of the tables that belong to it,
/// the folder of its air, and the state of the solver. The air alternates between two folders, so that the last
/// checkpoint remains whole until the next one is.
class MarchFiles {
 public:
  /// A checkpoint is due after so many seconds of wall time.
  MarchFiles(RunFolder& folder, double every_s) : folder_(folder), timer_(every_s) {}

  /// The state at the last checkpoint; nothing: the run begins. Throws Error(bad_data), Error(io).
  std::optional<std::string> load();
  /// And the air of that state.
  void restore(CoupledFlow& air) const { air.restore(air_folder(last_)); }
  /// A table with its first `kept` rows; later ones are removed. The file has no values for the last `hidden` columns.
  template <class Row>
  std::vector<Row> open(const std::string& name, std::size_t kept, std::size_t hidden = 0);
  /// Throws Error(bad_data) where a table, or another file, is not as at the checkpoint.
  void check() const;

  bool due(double times = 1) const { return timer_.due(times); }
  /// Rows that the table does not have yet.
  template <class Row>
  void add(const std::string& name, const std::vector<Row>& all);
  /// Everything so far is on the disk when this returns. Without `air` the run has none.
  void save(const std::string& state, const CoupledFlow* air);
  /// Of a run that has ended.
  void drop_air() const { drop_air(folder_.path()); }
  static void drop_air(const std::filesystem::path& folder);

 private:
  struct Table {
    std::string name;
    std::vector<std::string> columns;
    std::size_t rows = 0;  // in the file
  };
  CsvLog log(const Table& table) const { return {folder_.own(table.name), table.columns, table.rows}; }
  std::filesystem::path air_folder(int which) const;
  std::string hash() const;
  Table& table(const std::string& name);

  RunFolder& folder_;
  CheckpointTimer timer_;
  std::vector<Table> tables_;
  std::string loaded_;  // hash of the tables at the checkpoint; empty: none
  int last_ = 1;        // which folder has the air of the last checkpoint
};

template <class Row>
std::vector<Row> MarchFiles::open(const std::string& name, std::size_t kept, std::size_t hidden) {
  std::vector<std::string> columns = columns_of<Row>();
  columns.resize(columns.size() - hidden);
  tables_.push_back({name, std::move(columns), kept});
  log(tables_.back());
  std::vector<Row> rows;
  for (std::vector<double> values : read_csv(folder_.own(name)).rows) {
    values.resize(values.size() + hidden);
    rows.push_back(from_row<Row>(values));
  }
  return rows;
}

template <class Row>
void MarchFiles::add(const std::string& name, const std::vector<Row>& all) {
  Table& of = table(name);
  CsvLog file = log(of);
  std::vector<std::vector<double>> rows;
  for (; of.rows < all.size(); ++of.rows) {
    rows.push_back(row_of(all[of.rows]));
    rows.back().resize(of.columns.size());
  }
  file.add_rows(rows);
}

/// A file of a numbered frame: "vtk/canopy_0012.vtp".
std::string frame_file(const std::string& what, long long frame, const std::string& ending = "vtp");
/// Canopy and lines at a frame, with velocities, stresses and tensions; `pressure` over the cells, or empty.
void write_frame(RunFolder& folder, const CanopyMesh& mesh, const Cloth& cloth, const ClothState& state,
                 const std::vector<double>& pressure, long long frame);
/// The middle plane of the air.
void write_air_frame(RunFolder& folder, const CoupledFlow& air, long long frame);
/// <what>.pvd of frames from `first` to `last`; `time` gives that of a frame [s].
template <class Time>
void write_frames(RunFolder& folder, const std::string& what, long long first, long long last,
                  const Time& time, const std::string& ending = "vtp") {
  std::vector<VtkSeriesFile> series;
  for (long long i = first; i <= last; ++i) series.push_back({time(i), frame_file(what, i, ending)});
  folder.write(what + ".pvd", series);
}
/// Ending of the files of write_air_frame().
inline std::string air_ending(const FlowGrid& grid) {
  return grid.uniform() ? "vti" : "vtr";
}

}  // namespace ripstop::inline run

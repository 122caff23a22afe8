// The folder of one opening: run.json, history.csv and balance.csv while it runs, shapes for ParaView,
// checkpoint, and at the end the plot, the contact sheet and result.json.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/opening.h"
#include "ripstop/inflation/inflation.h"
#include "ripstop/inflation/opening_estimate.h"
#include "ripstop/inflation/summary.h"
#include "ripstop/run/run_folder.h"

namespace ripstop {

struct InflationResult {
  InflationSummary summary;
  OpeningEstimate estimate;
  double peak_load = 0, peak_time = 0, impulse = 0;  // [N], [s], [N s]
  double overshoot = 0;                              // peak over steady load
  double smooth_overshoot = 0;                       // low-passed peak over steady load; 0: no low-pass
  std::vector<double> line_peaks;                    // of each line over every step [N]
  StressPeak stress;
  double stress_time = 0;      // [s]
  double break_load = 0;       // of the cloth [N/m]; 0: unknown
  double energy_residual = 0;  // largest |residual| of all frames after the first tenth of the work
  double wall_time = 0;        // since the folder was opened [s]
};

class InflationFolder {
 public:
  /// As open_run_folder().
  InflationFolder(const RunSettings& settings, const Case& value, const std::string& solver, int threads);

  std::optional<std::string> finished_result() const;
  /// The state of the last whole checkpoint; the tables are cut back to it. Nothing: start over.
  std::optional<InflationState> go_on(const Inflation& solver);

  /// folded.png and the first shape.
  void write_start(const Inflation& solver, const InflationState& state);
  void add_rows(const std::vector<HistoryRow>& rows);
  void write_frame(const Inflation& solver, const InflationState& state, const InflationFrame& frame);
  /// Everything so far is on the disk when this returns.
  void save(const InflationState& state);
  InflationResult finish(const Inflation& solver, const InflationState& state, const Case& value,
                         const LoadSource& source);

 private:
  std::vector<HistoryRow> history() const;
  void write_pictures(const Inflation& solver, const InflationState& state, const Case& value,
                      const InflationResult& result, const std::vector<HistoryRow>& rows) const;

  std::filesystem::path folder_;
  std::vector<std::vector<double>> pending_rows_, pending_frames_;
  double opened_ = 0;  // [s]
};

/// Every double bit for bit. inflation_state_from_bytes() throws Error(bad_data) for anything else.
std::string to_bytes(const InflationState& state);
InflationState inflation_state_from_bytes(const std::string& bytes);

}  // namespace ripstop

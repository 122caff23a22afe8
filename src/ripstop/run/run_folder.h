// The folder of one steady run: what it was (run.json), how it went (iterations.csv, canopy.pvd), what came
// out (result.json), and what it needs to go on after a kill (checkpoint/).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "ripstop/canopy/shape.h"
#include "ripstop/canopy/stress.h"
#include "ripstop/case/case.h"
#include "ripstop/coupling/steady.h"

namespace ripstop {

struct RunSettings {
  std::filesystem::path folder;
  bool fresh = false;  // throw away what the folder holds of an earlier run
  bool fields = true;  // write shapes and flow for ParaView after every iteration
};

/// Whether the folder holds a run of these inputs to go on with. `solver` says what computes, and with what
/// beside the case. Throws Error(usage) for a folder that holds a run of other inputs, unless `fresh`, and
/// for one that holds anything but a run of Ripstop.
bool holds_run(const RunSettings& settings, const Case& value, const std::string& solver);

/// Opens or makes the folder of a run and writes run.json and case.toml; what holds_run() refuses is left as
/// it is.
void open_run_folder(const RunSettings& settings, const Case& value, const std::string& solver, int threads);

class RunFolder {
 public:
  /// As open_run_folder().
  RunFolder(const RunSettings& settings, const Case& value, const std::string& engine, int threads);

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path flow_folder() const { return folder_ / "flow"; }
  std::filesystem::path checkpoint_folder() const { return folder_ / "checkpoint"; }
  /// result.json of a run that had ended.
  std::optional<std::string> finished_result() const;

  /// iterations.csv is cut back to what the checkpoint holds.
  void go_on_from(const SteadyState& state);
  /// Files of one finished coupling iteration: its row, the lines' tensions, canopy, lines and flow for
  /// ParaView, a picture.
  void write_iteration(const SteadySolver& solver, const SteadyState& state, const FlowField& field);
  /// canopy.stl, drag.png and, last, result.json.
  void write_result(const SteadySolver& solver, const SteadyState& state, const Case& value);

 private:
  void write_fields(const SteadySolver& solver, const SteadyState& state, const FlowField& field) const;
  void write_state(const SteadySolver& solver, const SteadyState& state) const;
  void write_series(std::size_t iterations) const;

  std::filesystem::path folder_;
  std::string title_;
  bool fields_;
};

/// The program's summary of one finished run, as in result.json.
struct SteadyResult {
  double drag = 0, drag_area = 0, drag_coefficient = 0;  // [N], [m2], -
  double reference_area = 0, speed = 0, density = 0;
  CanopySize size;
  int iterations = 0;
  bool converged = false;
  double max_line_tension = 0;  // [N]
  StressPeak stress;
  double wall_time = 0;  // of all coupling iterations [s]
  SteadyIteration last;
};
SteadyResult steady_result(const SteadySolver& solver, const SteadyState& state, const Case& value);

}  // namespace ripstop

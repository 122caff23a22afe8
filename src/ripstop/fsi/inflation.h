// The opening of a folded canopy under a uniform pressure difference and absolute damping, [NFM] section on
// inflation as mended in docs/theory/inflation.md.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/canopy/shape.h"
#include "ripstop/canopy/stress.h"
#include "ripstop/cloth/cloth.h"
#include "ripstop/core/members.h"
#include "ripstop/fsi/air.h"
#include "ripstop/fsi/inflation_settings.h"
#include "ripstop/parachute/fold.h"

namespace ripstop {

/// A line through rings at the joints of skirt and lines, until it is cut.
struct ReefingLine {
  double length = 0;  // [m]
  double cut = 0;     // [s]
  SpringLaw law;      // [N]
};

struct InflationProblem {
  CanopyMesh mesh;  // as cut; fold lines and line damping are applied by the solver
  InflationSettings settings;
  double pressure = 0;  // dp [Pa], without `air`
  bool linear = false;  // keep only K_1 of every law
  int threads = 0;
  int symmetry = 1;  // turns by 2 pi / symmetry map the parachute as cut onto itself
  std::optional<AirProblem> air = {};
  std::vector<ReefingLine> reefing = {};  // in the order of their cuts
};

/// Axial load on the riser (downstream > 0) over one interval of the history.
struct HistoryRow {
  double time = 0;                               // its end [s]
  double mean = 0, least = 0, largest = 0;       // over all its steps [N]
  double reefing_mean = 0, reefing_largest = 0;  // tension of the reefing line, likewise [N]
};

template <Of<HistoryRow> T, class Visit>
void each_member(T& row, Visit&& visit) {
  visit("time_s", row.time);
  visit("load_mean_n", row.mean);
  visit("load_least_n", row.least);
  visit("load_largest_n", row.largest);
  visit("reefing_line_mean_n", row.reefing_mean);
  visit("reefing_line_largest_n", row.reefing_largest);
}

/// Now and then along the way.
struct InflationFrame {
  double time = 0;                                                 // [s]
  double pressure_work = 0, kinetic = 0, elastic = 0, damped = 0;  // [J]
  double residual = 0;               // share of the work that the other terms do not account for
  double step = 0, stable_step = 0;  // used, and allowed at the present strain [s]
  CanopySize size;
  StressPeak stress;
  double asymmetry = 0;  // largest distance of a node from where a turn by 2 pi / symmetry puts its like [m]
  double contact_depth = 0;  // largest share of their distance by which layers are pressed into each other
  double pierced = 0;        // share of the cloth's edges that pierce cloth, see pierced_share()
  double cut = 0;            // elastic energy that went with reefing lines when they were cut [J]
};

template <Of<InflationFrame> T, class Visit>
void each_member(T& frame, Visit&& visit) {
  visit("time_s", frame.time);
  visit("pressure_work_j", frame.pressure_work);
  visit("kinetic_energy_j", frame.kinetic);
  visit("elastic_energy_j", frame.elastic);
  visit("damped_energy_j", frame.damped);
  visit("residual", frame.residual);
  visit("step_s", frame.step);
  visit("stable_step_s", frame.stable_step);
  visit("projected_diameter_m", frame.size.projected_diameter);
  visit("projected_area_m2", frame.size.projected_area);
  visit("skirt_diameter_m", frame.size.skirt_diameter);
  visit("canopy_length_m", frame.size.length);
  visit("max_von_mises_n_m", frame.stress.von_mises);
  visit("max_cloth_strain", frame.stress.strain);
  visit("asymmetry_m", frame.asymmetry);
  visit("contact_depth", frame.contact_depth);
  visit("pierced_edges", frame.pierced);
  visit("cut_energy_j", frame.cut);
}

/// A shape for the contact sheet.
struct InflationShot {
  double time = 0;  // [s]
  std::vector<Vec3> positions;
  std::vector<double> von_mises;  // of every cell [N/m]
};

template <Of<InflationShot> T, class Visit>
void each_member(T& shot, Visit&& visit) {
  visit("time", shot.time);
  visit("positions", shot.positions);
  visit("von_mises", shot.von_mises);
}

/// All that a run needs to go on, to the last bit.
struct InflationState {
  ClothState cloth;
  StepRecord record;
  double step = 0;           // [s]
  long long blocks = 0;      // done
  double peak_load = 0;      // over every step [N]
  double peak_time = 0;      // [s]
  double impulse = 0;        // [N s]
  int step_changes = 0;      // how often strain made the step smaller
  std::vector<double> cuts;  // of the reefing lines that have been cut, when [s]
  double cut_energy = 0;     // see InflationFrame [J]
  AirMemory air;             // where the opening has air
  StressPeak highest_stress;
  double highest_stress_time = 0;  // [s]
  std::vector<InflationShot> shots;
};

template <Of<InflationState> T, class Visit>
void each_member(T& s, Visit&& visit) {
  visit("x", s.cloth.x);
  visit("v", s.cloth.v);
  visit("time", s.cloth.time);
  visit("steps", s.cloth.steps);
  visit("peak_tension", s.record.peak_tension);
  visit("pressure_work", s.record.pressure_work);
  visit("damped", s.record.damped);
  visit("step", s.step);
  visit("blocks", s.blocks);
  visit("peak_load", s.peak_load);
  visit("peak_time", s.peak_time);
  visit("impulse", s.impulse);
  visit("step_changes", s.step_changes);
  visit("cuts", s.cuts);
  visit("cut_energy", s.cut_energy);
  visit("von_mises", s.highest_stress.von_mises);
  visit("strain", s.highest_stress.strain);
  visit("place", s.highest_stress.place);
  visit("patch", s.highest_stress.patch);
  sewing_members(s.highest_stress, visit);
  visit("stress_time", s.highest_stress_time);
  visit("air", s.air);
  visit("shots", s.shots);
}

class Inflation {
 public:
  /// Throws Error(usage) for a folding or a number that does not fit.
  explicit Inflation(InflationProblem problem);

  InflationState start() const;

  /// A run is `blocks()` blocks; every frame is a whole number of blocks, every block of rows.
  long long blocks() const { return static_cast<long long>(problem_.settings.frames) * blocks_per_frame_; }
  bool at_frame(const InflationState& state) const { return state.blocks % blocks_per_frame_ == 0; }
  int rows_per_block() const { return rows_per_block_; }
  double row_duration() const { return row_; }  // [s]

  /// One block; what the air did in it is added to `air_rows`. The step is `step_fraction` of the largest stable
  /// one; when strain has made that smaller than the step by the block's end, the block is computed again, in air
  /// the step of the air. Throws Error(diverged).
  std::vector<HistoryRow> advance(InflationState& state, std::vector<AirRow>* air_rows = nullptr);
  InflationFrame frame(InflationState& state) const;

  const CanopyMesh& mesh() const { return mesh_; }
  /// Without reefing line.
  const Cloth& cloth() const { return *cloths_.back(); }
  const FoldedStart& folded() const { return folded_; }
  /// How much weaker the cloth's dampers are than `cloth_damping_s` says, so that they do not set the step.
  const ViscosityLimit& viscosity_limit() const { return viscosity_limit_; }
  const InflationProblem& problem() const { return problem_; }
  /// The air of a coupled opening, which goes on with it; null under a uniform pressure.
  OpeningAir* air() const { return air_.get(); }
  int threads() const { return team_.size(); }
  std::vector<double> peak_tension_of_lines(const InflationState& state) const;  // [N]

 private:
  std::vector<HistoryRow> compute_block(InflationState& state);
  std::vector<HistoryRow> compute_block_in_air(InflationState& state, std::vector<AirRow>* air_rows);
  ClothMotion tentative_motion(const InflationState& state, double length);
  void step_in_air(InflationState& state, const Loads& loads, int rows, std::vector<HistoryRow>& history);
  HistoryRow row_of_history(InflationState& state, long long index, int steps, double dt, int from) const;
  const Cloth& cloth_of(const InflationState& state) const { return *cloths_[state.cuts.size()]; }
  void add_reefing_lines(const ClothOptions& options);
  /// Whether a line was.
  bool cut_what_is_due(InflationState& state) const;
  void take_shots(InflationState& state) const;
  std::vector<Vec3> with_imperfection() const;

  InflationProblem problem_;
  CanopyMesh mesh_;
  FoldedStart folded_;
  ViscosityLimit viscosity_limit_;
  std::vector<ClothPtr> cloths_;  // with the reefing line of every stage, at last without
  ThreadTeam team_;
  std::unique_ptr<OpeningAir> air_;
  int blocks_per_frame_ = 1, rows_per_block_ = 1;
  double row_ = 0;               // [s]
  double elastic_at_start_ = 0;  // of an imperfection, or of a start that folds with some strain [J]
};

/// Lines, riser and tape get dampers C = `line_time` K_1 w / L0, the cloth's springs likewise with
/// `cloth_time`: Kelvin-Voigt solids whose loss does not depend on the mesh. Of the cloth's, half acts along
/// yarns between nodes two cells apart. Times in [s].
void damp_springs(Mesh& mesh, double line_time, double cloth_time);

}  // namespace ripstop

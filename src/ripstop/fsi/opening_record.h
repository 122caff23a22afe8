// Records of an opening: rows of its load, frames, snapshots, and the state of a checkpoint.
#pragma once

#include <string>
#include <vector>

#include "ripstop/canopy/shape.h"
#include "ripstop/canopy/stress.h"
#include "ripstop/cloth/cloth.h"
#include "ripstop/core/members.h"
#include "ripstop/fsi/coupled_flow.h"

namespace ripstop::inline fsi {

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

/// Sizes, energies and stresses at one time.
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
struct Snapshot {
  double time = 0;  // [s]
  std::vector<Vec3> positions;
  std::vector<double> von_mises;  // of every cell [N/m]
};

template <Of<Snapshot> T, class Visit>
void each_member(T& s, Visit&& visit) {
  visit("time", s.time);
  visit("positions", s.positions);
  visit("von_mises", s.von_mises);
}

/// Everything that the next block depends on, to the last bit.
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
  std::vector<Snapshot> snapshots;
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
  visit("shots", s.snapshots);
}

}  // namespace ripstop::inline fsi

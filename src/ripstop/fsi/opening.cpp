#include "ripstop/fsi/opening.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "ripstop/core/checked_int.h"
#include "ripstop/fsi/coupled_opening.h"
#include "ripstop/fsi/summary.h"
#include "ripstop/fsi/uniform_pressure_opening.h"

namespace ripstop::inline fsi {
namespace {

constexpr double longest_block = 2e-3;  // [s]

constexpr double most_parts = 1e7;

/// As many blocks or rows as `count` rounded up, except for rounding errors.
int parts_of(double count, const char* what) {
  const auto message = [&] {
    return fmt::format(
        "inflation: {:.3g} {}: use a shorter duration, more frames or a lower rate of the history", count,
        what);
  };
  return checked_int(std::max(std::ceil(count - 1e-9), 1.0), 1, most_parts, message, ExitCode::usage);
}

InflationProblem with_snapshots(InflationProblem problem, double span) {
  if (std::vector<double>& shown = problem.settings.sheet_s; shown.empty()) {
    shown = {0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 1};
    for (double& instant : shown) instant *= span;
  }
  return problem;
}

}  // namespace

Opening::Opening(InflationProblem problem, double snapshot_span, double least_rows,
                 AdaptiveStepper::Step step)
    : problem_(with_snapshots(std::move(problem), snapshot_span)),
      team_(problem_.threads),
      cloths_(problem_.mesh, problem_.settings, problem_.reefing, problem_.symmetry, problem_.linear, team_,
              problem_.cluster, problem_.sizes),
      blocks_per_frame_(parts_of(problem_.settings.duration_s / problem_.settings.frames / longest_block,
                                 "blocks for each frame")),
      rows_per_block_(parts_of(problem_.settings.duration_s / problem_.settings.frames / blocks_per_frame_ *
                                   std::max(problem_.settings.history_hz, least_rows),
                               "rows of the history for each block")),
      row_(problem_.settings.duration_s / problem_.settings.frames / blocks_per_frame_ / rows_per_block_),
      stepper_(step, problem_.settings.step_fraction, row_, team_) {
  if (problem_.settings.low_pass_hz > 0)
    low_pass({}, row_,
             problem_.settings.low_pass_hz);  // refuses at the beginning the same input as at the end
}

InflationState Opening::start() const {
  InflationState state;
  state.cloth = cloths_.start();
  state.step = stepper_.allowed_step(state, cloth_of(state));
  take_snapshot(state);
  return state;
}

bool Opening::end_block(InflationState& state) const {
  ++state.blocks;
  const bool cut = cloths_.cut_due(state);
  take_snapshot(state);
  return cut;
}

// One at most for every instant that has come; instants closer than a block share one.
void Opening::take_snapshot(InflationState& state) const {
  const std::vector<double>& instants = problem_.settings.sheet_s;
  const double now = state.cloth.time, last = state.snapshots.empty() ? -1.0 : state.snapshots.back().time;
  if (std::none_of(instants.begin(), instants.end(),
                   [&](double t) { return t > last * (1 + 1e-12) && t <= now * (1 + 1e-12); }))
    return;
  Snapshot snapshot{now, positions(state.cloth, cloth()), {}};
  for (const CellStress& stress : cell_stress(cloth(), state.cloth))
    snapshot.von_mises.push_back(stress.von_mises);
  state.snapshots.push_back(std::move(snapshot));
}

InflationFrame Opening::frame(InflationState& state) const {
  const std::vector<Vec3> x = positions(state.cloth, cloth());
  InflationFrame frame;
  frame.time = state.cloth.time;
  frame.pressure_work = state.record.pressure_work + state.air.work;
  frame.damped = state.record.damped;
  frame.cut = state.cut_energy;
  frame.kinetic = kinetic_energy(cloth(), state.cloth);
  frame.elastic = elastic_energy(cloth_of(state), state.cloth);
  const double left = frame.pressure_work + cloths_.elastic_energy_at_start() - frame.kinetic -
                      frame.elastic - frame.damped - frame.cut;
  frame.residual = frame.pressure_work > 0 ? left / frame.pressure_work : 0;
  frame.step = state.step;
  frame.stable_step = stability_limit(cloth_of(state), state.cloth).stable_step;
  const std::vector<std::vector<Vec3>> canopies = cloths_.upright(x);
  frame.size = mean_size(cloths_.one(), canopies);
  frame.stress = stress_peak(mesh(), x, cell_stress(cloth(), state.cloth));
  frame.contact_depth = contact_report(cloth_of(state), state.cloth).deepest;
  frame.pierced = pierced_share(mesh(), x);
  for (const std::vector<Vec3>& one : canopies)
    frame.asymmetry =
        std::max(frame.asymmetry, asymmetry(cloths_.one(), one, std::gcd(problem_.symmetry, folded().folds)));
  if (frame.stress.von_mises > state.highest_stress.von_mises) {
    state.highest_stress = frame.stress;
    state.highest_stress_time = frame.time;
  }
  return frame;
}

std::vector<CanopyRow> Opening::canopy_rows(const InflationState& state) const {
  return ripstop::canopy_rows(mesh(), cloth(), state.cloth, mesh().fixed.front());
}

std::vector<double> Opening::peak_tension_of_lines(const InflationState& state) const {
  std::vector<double> peaks(mesh().rigging.lines.size(), 0.0);
  if (state.record.peak_tension.empty()) return peaks;
  const std::vector<LineTension> tensions = line_tensions(mesh(), state.record.peak_tension);
  for (std::size_t i = 0; i < peaks.size(); ++i) peaks[i] = tensions[i].largest_tension;
  return peaks;
}

std::unique_ptr<Opening> make_opening(InflationProblem problem) {
  if (problem.air) return std::make_unique<CoupledOpening>(std::move(problem));
  return std::make_unique<UniformPressureOpening>(std::move(problem));
}

}  // namespace ripstop::inline fsi

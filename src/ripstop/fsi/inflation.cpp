#include "ripstop/fsi/inflation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "ripstop/core/error.h"
#include "ripstop/fsi/folded_start.h"
#include "ripstop/fsi/summary.h"

namespace ripstop {
namespace {

// Of a block, after which the stable step is looked at: the looking costs about as much as 40 steps.
constexpr double longest_block = 2e-3;  // [s]
// Of the cloth's viscosity, that acts along yarns between nodes two cells apart. There it takes a quarter of
// what the same loss in a wave that the mesh resolves takes of the stable step between neighbours, and it
// resists being folded at the scale of the grid. A wave of two cells only feels the rest.
constexpr double share_over_two_cells = 2.0 / 3;
// How often one block is tried with a smaller step before its divergence is the user's.
constexpr int most_tries = 4;
// Of the time in which the stream passes a cell: no row is longer where there is air, whose steps are whole
// numbers of rows and as long as its fastest cell allows.
constexpr double longest_row_in_air = 0.03;
// Of a row: no flow of the stream's air asks for so little.
constexpr double shortest_step_in_air = 0.05;
constexpr int looks_at_added_mass = 25;  // in an opening

double least_rows_in(const FlowProblem& flow) {
  double least = 1e300;
  for (int axis = 0; axis < 3; ++axis) {
    const int n = axis == 0 ? flow.grid.nx : axis == 1 ? flow.grid.ny : flow.grid.nz;
    for (int c = 0; c < n; ++c) least = std::min(least, flow.grid.width(axis, c));
  }
  return flow.air.speed / (longest_row_in_air * least);  // [1/s]
}

}  // namespace

void damp_springs(Mesh& mesh, double line_time, double cloth_time) {
  for (Spring& spring : mesh.springs) {
    const SpringLaw& law = mesh.laws[spring.law];
    spring.damping += line_time * law.tangent(0) * spring.scale / spring.rest_length;
  }
  if (cloth_time == 0) return;
  for (Patch& patch : mesh.patches) {
    for (const Direction d : {along_row, along_column})
      patch.viscosity[d] += (1 - share_over_two_cells) * cloth_time * patch.law[d].tangent(0);
    for (const Direction d : {shear_up, shear_down, bend_row, bend_column})
      patch.viscosity[d] += cloth_time * patch.law[d].tangent(0);
    // Two such springs cross every section, each with half the w / L0.
    patch.viscosity[bend_row] += 0.5 * share_over_two_cells * cloth_time * patch.law[along_row].tangent(0);
    patch.viscosity[bend_column] +=
        0.5 * share_over_two_cells * cloth_time * patch.law[along_column].tangent(0);
  }
}

Inflation::Inflation(InflationProblem problem) : problem_(std::move(problem)), team_(problem_.threads) {
  const InflationSettings& s = problem_.settings;
  if (!s.initial_radius_m) {
    throw Error(ExitCode::usage,
                "inflation.initial_radius_m is not given: the radius of the folded skirt, for example 0.1");
  }
  if (std::vector<double>& shown = problem_.settings.sheet_s; shown.empty()) {
    shown = {0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 1};
    for (double& instant : shown) instant *= problem_.air ? s.duration_s : 0.1;
  }
  folded_ = folded_start(problem_.mesh, {*s.initial_radius_m, s.folds, s.slack_m}, problem_.symmetry, team_);
  mesh_ = with_creases(problem_.mesh, folded_);
  damp_springs(mesh_, s.line_damping_s, s.cloth_damping_s);
  ClothOptions options{problem_.linear, s.damping_n_s_m3, s.quadratic_damping_n_s2_m4};
  if (s.contact_pa > 0) options.contact = ContactOptions{s.contact_pa, s.contact_friction, folded_.positions};
  if (s.cloth_damping_s > 0)
    viscosity_limit_ = limit_viscosity(mesh_, options, folded_.positions, s.cloth_damping_step_share);
  add_reefing_lines(options);
  cloths_.push_back(make_cloth(mesh_, options));

  const double frame = s.duration_s / s.frames;
  blocks_per_frame_ = std::max(1, static_cast<int>(std::ceil(frame / longest_block - 1e-9)));
  const double block = frame / blocks_per_frame_;
  const double rows = std::max(s.history_hz, problem_.air ? least_rows_in(problem_.air->flow) : 0.0);
  rows_per_block_ = std::max(1, static_cast<int>(std::ceil(block * rows - 1e-9)));
  row_ = block / rows_per_block_;
  if (s.low_pass_hz > 0)
    low_pass({}, row_, s.low_pass_hz);  // refuses at the beginning what it would at the end
  ClothState begin = start_state(cloth());
  set_positions(begin, cloth(), with_imperfection());
  elastic_at_start_ = elastic_energy(cloth(), begin);
  if (problem_.air) air_ = std::make_unique<OpeningAir>(*problem_.air, mesh_);
}

InflationState Inflation::start() const {
  InflationState state;
  state.cloth = start_state(cloth());
  set_positions(state.cloth, cloth(), with_imperfection());
  state.step = problem_.settings.step_fraction * stability_limit(cloth_of(state), state.cloth).stable_step;
  take_shots(state);
  if (air_) air_->weigh_air(positions(state.cloth, cloth()), state.air);
  return state;
}

void Inflation::add_reefing_lines(const ClothOptions& options) {
  Mesh reefed = mesh_;
  for (std::size_t i = 0; i < problem_.reefing.size(); ++i) {
    const ReefingLine& line = problem_.reefing[i];
    const double damping = problem_.settings.line_damping_s * line.law.tangent(0) / line.length;
    reefed.drawstring = Drawstring{line_joints(mesh_), line.length, line.law, damping};
    cloths_.push_back(make_cloth(reefed, options));
  }
  if (problem_.reefing.empty()) return;
  ClothState folded = start_state(*cloths_.front());
  set_positions(folded, *cloths_.front(), folded_.positions);
  const double needed = drawn_length(*cloths_.front(), folded), length = problem_.reefing.front().length;
  if (needed > length)
    throw Error(
        ExitCode::usage,
        fmt::format("inflation.reefing[0].line_m = {:g}: the folded skirt is {:.4g} m round, more than its "
                    "reefing line; a smaller inflation.initial_radius_m fits into it",
                    length, needed));
}

// The energy of the line goes with it.
bool Inflation::cut_what_is_due(InflationState& state) const {
  const std::vector<ReefingLine>& lines = problem_.reefing;
  const double now = state.cloth.time;
  const std::size_t before = state.cuts.size();
  while (state.cuts.size() < lines.size() && lines[state.cuts.size()].cut <= now * (1 + 1e-12)) {
    state.cut_energy += elastic_energy(cloth_of(state), state.cloth);
    state.cuts.push_back(now);
    state.cut_energy -= elastic_energy(cloth_of(state), state.cloth);
  }
  return state.cuts.size() > before;
}

std::vector<Vec3> Inflation::with_imperfection() const {
  const InflationSettings& s = problem_.settings;
  std::vector<Vec3> x = folded_.positions;
  if (s.imperfection_m == 0) return x;
  for (const Patch& patch : mesh_.patches) {
    for (int i = patch.first_node; i < patch.first_node + patch.rows * patch.columns; ++i) {
      const double wave = std::cos(s.imperfection_harmonic * std::atan2(x[i].y, x[i].x));
      x[i] += (s.imperfection_m * wave / folded_.outer_radius) * Vec3{x[i].x, x[i].y, 0};
    }
  }
  return x;
}

std::vector<HistoryRow> Inflation::advance(InflationState& state, std::vector<AirRow>* air_rows) {
  if (air_) return compute_block_in_air(state, air_rows);
  const double fraction = problem_.settings.step_fraction;
  for (int tries = 1;; ++tries) {
    InflationState next = state;
    double stable = 0;
    try {
      std::vector<HistoryRow> rows = compute_block(next);
      stable = stability_limit(cloth_of(next), next.cloth).stable_step;
      if (next.step <= stable) {
        if (cut_what_is_due(next)) stable = stability_limit(cloth_of(next), next.cloth).stable_step;
        // Down with the bound at once, up only when it has risen clearly.
        if (fraction * stable < next.step || fraction * stable > 1.1 * next.step)
          next.step = fraction * stable;
        take_shots(next);
        state = std::move(next);
        return rows;
      }
    } catch (const Error& error) {
      if (error.code() != ExitCode::diverged || tries == most_tries) throw;
      stable = 0.5 * state.step / fraction;
    }
    state.step = fraction * stable;
    ++state.step_changes;
  }
}

// Steps [from, from + steps) of the last call of step().
HistoryRow Inflation::row_of_history(InflationState& state, long long index, int steps, double dt,
                                     int from) const {
  const double begin = static_cast<double>(index) * row_;
  const auto load = [&](int k) { return state.record.fixed_force[from + k].z; };
  HistoryRow row{static_cast<double>(index + 1) * row_, 0, load(0), load(0)};
  const std::vector<double>& reefing = state.record.drawstring;
  for (int k = from; k < from + steps && !reefing.empty(); ++k) {
    row.reefing_mean += reefing[k] / steps;
    row.reefing_largest = std::max(row.reefing_largest, reefing[k]);
  }
  for (int k = 0; k < steps; ++k) {
    row.mean += load(k) / steps;
    row.least = std::min(row.least, load(k));
    row.largest = std::max(row.largest, load(k));
    if (load(k) <= state.peak_load) continue;
    state.peak_load = load(k);
    state.peak_time = begin + k * dt;
  }
  state.impulse += row.mean * row_;
  return row;
}

std::vector<HistoryRow> Inflation::compute_block(InflationState& state) {
  const InflationSettings& s = problem_.settings;
  const int steps = static_cast<int>(std::ceil(row_ / state.step));
  const double dt = row_ / steps;
  // Under a constant pressure all rows are stepped at once, while it rises one by one.
  const double block_end = static_cast<double>(state.blocks + 1) * rows_per_block_ * row_;
  const bool rising = s.ramp_s > block_end - rows_per_block_ * row_;
  const int together = rising ? 1 : rows_per_block_;
  Loads loads;
  std::vector<HistoryRow> rows;
  for (int first = 0; first < rows_per_block_; first += together) {
    const long long index = state.blocks * rows_per_block_ + first;
    const double begin = static_cast<double>(index) * row_;
    const double share = rising ? std::min(1.0, (begin + 0.5 * row_) / s.ramp_s) : 1.0;
    loads.cell_pressure.assign(mesh_.cell_count(), share * problem_.pressure);
    ripstop::step(state.cloth, cloth_of(state), loads, dt, steps * together, team_, &state.record);
    state.cloth.time = static_cast<double>(index + together) * row_;
    for (int i = 0; i < together; ++i) rows.push_back(row_of_history(state, index + i, steps, dt, i * steps));
  }
  ++state.blocks;
  return rows;
}

std::vector<HistoryRow> Inflation::compute_block_in_air(InflationState& state,
                                                        std::vector<AirRow>* air_rows) {
  std::vector<Vec3> x = positions(state.cloth, cloth());
  std::vector<HistoryRow> history;
  while (static_cast<int>(history.size()) < rows_per_block_) {
    // A step of the air is a whole number of rows, as many as it allows, all alike as far as that goes.
    const int left = rows_per_block_ - static_cast<int>(history.size());
    const double longest = air_->longest_step();
    if (!(longest > shortest_step_in_air * row_))
      throw Error(ExitCode::diverged,
                  fmt::format("at {:.6g} s the air would need steps of {:.3g} s: it has diverged; a smaller "
                              "inflation.courant or a finer grid (flow.cells) may help",
                              state.cloth.time, longest));
    const int steps = static_cast<int>(std::ceil(left * row_ / longest));
    const int rows = std::max(1, left / steps);
    AirRow row;
    const Loads loads = air_->step(x, tentative_motion(state, rows * row_), rows * row_, state.air, row);
    step_in_air(state, loads, rows, history);
    row.time = state.cloth.time;
    double pull = 0;
    for (int n = 1; n <= rows; ++n) pull += history[history.size() - n].mean / rows;
    air_->fly(pull, rows * row_, state.air);
    row.path = state.air.path, row.fallen = state.air.fallen;
    row.angle = state.air.angle * 180 / std::numbers::pi;
    if (air_rows) air_rows->push_back(row);
    std::vector<Vec3> now = positions(state.cloth, cloth());
    for (std::size_t n = 0; n < x.size(); ++n) state.air.work += dot(loads.node_force[n], now[n] - x[n]);
    x = std::move(now);
  }
  ++state.blocks;
  cut_what_is_due(state);
  take_shots(state);
  return history;
}

// Of a step of the air, were the last load to go on.
ClothMotion Inflation::tentative_motion(const InflationState& state, double length) {
  const Cloth& with_line = cloth_of(state);
  const double stable = problem_.settings.step_fraction * stability_limit(with_line, state.cloth).stable_step;
  ClothMotion motion;
  motion.steps = static_cast<int>(std::ceil(length / stable));
  ClothState cloth = state.cloth;
  ripstop::step(cloth, with_line, air_->last_load(state.air), length / motion.steps, motion.steps, team_);
  const std::vector<Vec3> before = positions(state.cloth, with_line);
  motion.velocity = positions(cloth, with_line);
  for (std::size_t n = 0; n < before.size(); ++n)
    motion.velocity[n] = (motion.velocity[n] - before[n]) / length;
  return motion;
}

// So many rows under one load.
void Inflation::step_in_air(InflationState& state, const Loads& loads, int rows,
                            std::vector<HistoryRow>& history) {
  const double fraction = problem_.settings.step_fraction;
  const long long first = state.blocks * rows_per_block_ + static_cast<long long>(history.size());
  state.step = fraction * stability_limit(cloth_of(state), state.cloth).stable_step;
  for (int tries = 1;; ++tries) {
    InflationState next = state;
    const int steps = static_cast<int>(std::ceil(row_ / next.step));
    const double dt = row_ / steps;
    double stable = 0;
    try {
      ripstop::step(next.cloth, cloth_of(next), loads, dt, steps * rows, team_, &next.record);
      stable = stability_limit(cloth_of(state), next.cloth).stable_step;
    } catch (const Error& error) {
      if (error.code() != ExitCode::diverged || tries == most_tries) throw;
      stable = 0.5 * dt;
    }
    if (dt <= stable) {
      next.cloth.time = static_cast<double>(first + rows) * row_;
      for (int i = 0; i < rows; ++i) history.push_back(row_of_history(next, first + i, steps, dt, i * steps));
      state = std::move(next);
      return;
    }
    state.step = fraction * stable;
    ++state.step_changes;
  }
}

// One shot at most for every instant that has come; instants closer than a block share one.
void Inflation::take_shots(InflationState& state) const {
  const std::vector<double>& instants = problem_.settings.sheet_s;
  const double now = state.cloth.time, last = state.shots.empty() ? -1.0 : state.shots.back().time;
  if (std::none_of(instants.begin(), instants.end(),
                   [&](double t) { return t > last * (1 + 1e-12) && t <= now * (1 + 1e-12); }))
    return;
  InflationShot shot{now, positions(state.cloth, cloth()), {}};
  for (const CellStress& stress : cell_stress(cloth(), state.cloth))
    shot.von_mises.push_back(stress.von_mises);
  state.shots.push_back(std::move(shot));
}

InflationFrame Inflation::frame(InflationState& state) const {
  const std::vector<Vec3> x = positions(state.cloth, cloth());
  InflationFrame frame;
  frame.time = state.cloth.time;
  frame.pressure_work = state.record.pressure_work + state.air.work;
  frame.damped = state.record.damped;
  frame.cut = state.cut_energy;
  frame.kinetic = kinetic_energy(cloth(), state.cloth);
  frame.elastic = elastic_energy(cloth_of(state), state.cloth);
  const double left =
      frame.pressure_work + elastic_at_start_ - frame.kinetic - frame.elastic - frame.damped - frame.cut;
  frame.residual = frame.pressure_work > 0 ? left / frame.pressure_work : 0;
  frame.step = state.step;
  frame.stable_step = stability_limit(cloth_of(state), state.cloth).stable_step;
  frame.size = canopy_size(mesh_, x);
  frame.stress = stress_peak(mesh_, x, cell_stress(cloth(), state.cloth));
  frame.contact_depth = contact_report(cloth_of(state), state.cloth).deepest;
  frame.pierced = pierced_share(mesh_, x);
  frame.asymmetry = asymmetry(mesh_, x, std::gcd(problem_.symmetry, folded_.folds));
  const long long every = std::max(1, problem_.settings.frames / looks_at_added_mass);
  if (air_ && (state.blocks / blocks_per_frame_ % every == 0 || state.blocks == blocks()))
    air_->weigh_air(x, state.air);
  if (frame.stress.von_mises > state.highest_stress.von_mises) {
    state.highest_stress = frame.stress;
    state.highest_stress_time = frame.time;
  }
  return frame;
}

std::vector<double> Inflation::peak_tension_of_lines(const InflationState& state) const {
  std::vector<double> peaks(mesh_.rigging.lines.size(), 0.0);
  if (state.record.peak_tension.empty()) return peaks;
  const std::vector<LineTension> tensions = line_tensions(mesh_, state.record.peak_tension);
  for (std::size_t i = 0; i < peaks.size(); ++i) peaks[i] = tensions[i].largest_tension;
  return peaks;
}

}  // namespace ripstop

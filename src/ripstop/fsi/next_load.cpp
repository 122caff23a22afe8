#include "ripstop/fsi/next_load.h"

namespace ripstop::inline fsi {
namespace {

// A flow that does not come to rest, for example with jets through slots, returns different loads for the same shape.
// If after so many iterations the drag still changes by more than the time before, answers are no longer extrapolated
// but averaged.
constexpr int most_accelerated = 5;

std::vector<double> joined(const std::vector<double>& pressure, const RigidTraction& traction) {
  const auto& [a, b] = traction;
  std::vector<double> values = pressure;
  values.insert(values.end(), {a.x, a.y, a.z, b.x, b.y, b.z});
  return values;
}

}  // namespace

void update_load(SteadyState& state, const ClothLoad& answer, double drag_change,
                 const std::vector<double>& area, const CouplingSettings& settings) {
  Accelerator& accelerator = state.accelerator;
  if (settings.acceleration == Acceleration::anderson && !state.in_time) {
    const bool jitters =
        static_cast<int>(state.iterations.size()) - state.spread.before >= most_accelerated &&
        drag_change > state.iterations.back().drag_change;
    if (jitters || accelerator.update == Acceleration::none) accelerator.average(settings.relaxation);
  }
  // Means in time have the same expected load and differ by scatter. The first windows are those of a developing
  // wake: the first one is replaced by the second, and from then on the weight of each is its number.
  const auto& all = state.iterations;
  if (const std::size_t n = all.size(); state.in_time && n >= 2 && all[n - 1].in_time && all[n - 2].in_time)
    accelerator.average(2 * settings.relaxation);
  std::vector<double> weight = area;
  weight.resize(area.size() + 6, 0.0);  // the residual traction follows the steps of the pressures
  const std::vector<double> next =
      accelerator.next(joined(state.pressure, state.residual_traction),
                       joined(answer.pressure, answer.residual_traction), weight);
  state.pressure.assign(next.begin(), next.end() - 6);
  const double* r = next.data() + state.pressure.size();
  state.residual_traction = {{r[0], r[1], r[2]}, {r[3], r[4], r[5]}};
}

void begin_windows(SteadyState& state, const CouplingSettings& settings) {
  state.in_time = true;
  state.converged = false;
  state.accelerator.update = Acceleration::none;  // differences of means in time are mostly noise
  state.accelerator.relaxation = settings.relaxation;
}

}  // namespace ripstop::inline fsi

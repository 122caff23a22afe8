// The handbook's opening loads for the deployment that a case describes, to compare a computed opening with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/run/opening/method_load.h"

namespace ripstop::inline run {

struct LoadResult;

/// Three standard deviations of the peaks of openings that differ only in mesh or folds: 5 % each for a disk-gap-band
/// (docs/validation/inflation.md, Step and cells), less for a flat circular canopy.
inline constexpr double opening_scatter = 0.15;

/// Whether a uniform-pressure inflation has the default damping, which was calibrated on one peak (docs/validation.md,
/// Openings).
bool has_default_damping(const InflationSettings& inflation);
/// Why the peak load of a uniform-pressure inflation is not a prediction.
std::string limit_of_damping(const InflationSettings& inflation);

/// All methods of run_load() for payload and density of the case at `speed` [m/s]. Empty where they cannot be computed
/// (no payload, or a descent rate above the speed).
std::vector<MethodLoad> handbook_methods(const Settings& resolved, double speed);

/// The lowest and the highest load of the methods that apply and that compute the deceleration during filling [N].
struct FiniteMassRange {
  double lowest = 0, highest = 0;
};
/// Absent where no such method applies. The infinite-mass load is not among them: it has no filling distance.
std::optional<FiniteMassRange> finite_mass_range(const std::vector<MethodLoad>& methods);

/// Statement that a solid canopy has a heavy payload, with the mass ratio of the stage; empty where the highest design load
/// is at least that of the coupled openings of such canopies.
std::string heavy_payload(const Settings& resolved, const LoadResult& load);
/// Load of the coupled openings of canopies with a heavy payload, and the remedy.
std::string heavy_payload_advice();
/// After a number that follows from the load of a heavy payload: "; the payload is heavy: ..."; empty without a `caution`
/// (LoadResult::design_load_caution).
std::string heavy_payload_note(const std::string& caution);

/// Warning if `computed` [N] is outside the range of the finite-mass methods of `methods` by more than
/// opening_scatter; else nothing. `distance` is the computed path to the peak over D0, where it is known.
std::optional<std::string> handbook_disagreement(double computed, std::optional<double> distance,
                                                 const std::vector<MethodLoad>& methods);

/// Warning if the peak `computed` [N] of a coupled opening is above the `infinite_mass` load of the handbook [N] by more
/// than opening_scatter; else nothing. `payload`: the opening has one, and is not at constant speed.
std::optional<std::string> above_infinite_mass(double computed, double infinite_mass, bool payload);

}  // namespace ripstop::inline run

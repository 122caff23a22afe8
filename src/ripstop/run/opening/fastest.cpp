#include "ripstop/run/opening/fastest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "ripstop/case/cluster.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/words.h"
#include "ripstop/run/json.h"
#include "ripstop/run/opening/handbook.h"
#include "ripstop/run/steady/warnings.h"

namespace ripstop::inline run {
namespace {

constexpr double slowest_deployment = 1;  // [m/s]
constexpr double speed_tolerance = 1e-3;  // relative

/// The loads of one parachute by every method, at any speed.
class LoadsAtSpeed {
 public:
  LoadsAtSpeed(const Settings& resolved, LoadRequest request, const LoadInputs& inputs,
               const std::function<double(double)>& least_load)
      : resolved_(resolved), request_(std::move(request)), inputs_(inputs), least_load_(least_load) {
    request_.descent = false;
  }

  /// Each result is computed once: methods and uncertainties share their speeds.
  const LoadResult& at(double speed) const {
    const auto known = results_.find(speed);
    if (known != results_.end()) return known->second;
    LoadRequest asked = request_;
    asked.speed = speed;
    return results_.emplace(speed, run_load(resolved_, asked, inputs_)).first->second;
  }

  /// Infinite at a speed at which lines or riser break; nothing where no speed difference is known.
  std::optional<SnatchResult> snatch(double speed) const {
    LoadRequest asked = request_;
    asked.speed = speed;
    try {
      return snatch_of(resolved_, asked, at(speed));
    } catch (const Error& error) {
      if (error.code() != ExitCode::usage) throw;
      SnatchResult broken;
      broken.load = std::numeric_limits<double>::infinity();
      return broken;
    }
  }
  /// Throws where lines or riser break, or payload and canopy do not part, at the slowest deployment.
  void require_snatch(double slowest) const {
    LoadRequest asked = request_;
    asked.speed = slowest;
    snatch_of(resolved_, asked, at(slowest));
  }
  double snatch_load(double speed) const {
    const auto known = snatches_.find(speed);
    if (known != snatches_.end()) return known->second;
    const auto found = snatch(speed);
    return snatches_.emplace(speed, found ? found->largest() : 0).first->second;
  }
  /// Of the whole descent; 0 where it is not asked for.
  double least_load(double speed) const {
    if (!least_load_) return 0;
    const auto known = least_loads_.find(speed);
    if (known != least_loads_.end()) return known->second;
    return least_loads_.emplace(speed, least_load_(speed)).first->second;
  }

 private:
  const Settings& resolved_;
  LoadRequest request_;
  const LoadInputs& inputs_;
  const std::function<double(double)>& least_load_;
  mutable std::map<double, double> snatches_, least_loads_;
  mutable std::map<double, LoadResult> results_;
};

struct MethodPeak {
  double load = 0;  // largest of all stages [N]
  bool applies = true;
  std::string note = {};
};

MethodPeak peak_of(const LoadResult& r, const std::string& method) {
  MethodPeak peak;
  for (const StageLoads& stage : r.stages)
    for (const MethodLoad& m : stage.methods)
      if (m.method == method && m.load > peak.load) peak = {m.load, m.applies, m.note};
  return peak;
}

/// The load of the design method, or a larger one of another method that determines the design load there, of a computed
/// opening with a limit, or of the whole descent.
MethodPeak design_peak(const LoadResult& r, const std::string& method, double least_load) {
  MethodPeak peak = peak_of(r, method);
  if (const MethodPeak computed = peak_of(r, computed_method); computed.load > peak.load)
    peak = {computed.load, false, "the larger load of the computed opening is used"};
  if (r.design_load > peak.load)
    peak = {r.design_load, false, fmt::format("the larger load of the method {} is used", r.design_method)};
  if (least_load > peak.load) peak = {least_load, false, "the largest load of the descent is used"};
  return peak;
}

/// The largest speed at which `keeps` is true, from `low`, where it is, to the fastest deployment; nothing: it is true
/// there too.
template <class Keeps>
std::optional<double> largest_speed(double low, Keeps&& keeps) {
  double high = fastest_deployment;
  if (keeps(high)) return {};
  while (high / low > 1 + speed_tolerance) {
    const double middle = std::sqrt(low * high);
    (keeps(middle) ? low : high) = middle;
  }
  return low;
}

SafeSpeed safe_speed(const Settings& resolved, const LoadsAtSpeed& loads, const std::string& method,
                     double slowest, const FastestResult& r) {
  const bool design = method == r.design_method;
  const auto peak_at = [&](double speed) {
    return design ? design_peak(loads.at(speed), method, loads.least_load(speed))
                  : peak_of(loads.at(speed), method);
  };
  const auto least = [&](double load, double speed) {
    const bool of_opening = design || method == computed_method;
    return *weakest(load_margins(resolved, load, loads.snatch_load(speed),
                                 of_opening ? loads.at(speed).shares : MemberShares{}));
  };
  const auto speed_with = [&](double factor) {
    return largest_speed(slowest, [&](double speed) {
      return *least(factor * peak_at(speed).load, speed).margin >= r.margin;
    });
  };
  SafeSpeed safe;
  safe.method = method;
  // The lower end is a claim too: with its load even the slowest deployment has to keep the margin.
  if (*least((1 + r.load_uncertainty) * peak_at(slowest).load, slowest).margin < r.margin) {
    safe.unsafe_at = slowest;
  } else {
    safe.speed = speed_with(1);
    safe.lowest = speed_with(1 + r.load_uncertainty);
    safe.highest = speed_with(1 - r.load_uncertainty);
  }
  const double at = safe.unsafe_at ? slowest : safe.speed.value_or(fastest_deployment);
  const MethodPeak peak = peak_at(at);
  safe.load = peak.load, safe.applies = peak.applies, safe.note = peak.note;
  safe.member = least(peak.load, at).member;
  return safe;
}

std::string printed(const std::optional<double>& speed) {
  return speed ? fmt::format("{:.1f} m/s", *speed) : fmt::format("more than {:g} m/s", fastest_deployment);
}

/// Name of the slowest speed of the search.
std::string slowest_text(const FastestResult& r) {
  if (*r.design().unsafe_at <= slowest_deployment) return "of the search";
  return fmt::format(
      "at which the canopy decelerates the payload on a path {:.3g} deg below the horizon, {} m above sea "
      "level. For another path or height give --angle (0 for a level path, as at apogee) or --height",
      r.path_angle, rounded(r.height));
}

/// Which speed to use. Infinite mass and the finite-mass methods may differ by a factor of three and more, as a large
/// canopy slows a light payload down during a long filling.
std::string advice_of(const FastestResult& r, double filling_distance) {
  const SafeSpeed& design = r.design();
  if (design.unsafe_at && r.snatch && r.snatch->largest() > design.load)
    return fmt::format(
        "no speed: under the snatch load of {} N the margin of safety of the {} is below the required {:g}; "
        "use a stronger or longer part, or reduce the speed difference",
        rounded(r.snatch->largest()), design.member, r.margin);
  if (design.unsafe_at)
    return fmt::format("no speed: the {} does not keep its margin even at {} m/s, the slowest speed {}",
                       design.member, rounded(*design.unsafe_at, 3), slowest_text(r));
  if (r.design_method == computed_method)
    return fmt::format(
        "{}, the safe speed of the computed opening. It is valid for the deployment of that run",
        printed(design.lowest));
  std::string text = fmt::format(
      "{}{}, the safe speed for infinite mass, in which the speed does not decrease during "
      "filling. Not included: failure of a reefing line{} and the stress of the cloth",
      r.design_load_caution.empty() ? "" : "at most ", printed(design.lowest),
      r.snatch ? "" : ", the snatch load");
  text += heavy_payload_note(r.design_load_caution);
  if (r.snatch && r.snatch->largest() > (1 + r.load_uncertainty) * design.load)
    text += fmt::format(". At this speed the snatch load of {} N is larger than the opening load",
                        rounded(r.snatch->largest()));
  std::optional<double> low = fastest_deployment, high = 0.0;
  bool others = false;
  for (const SafeSpeed& s : r.methods) {
    if (s.method == infinite_mass_method || !s.applies) continue;
    others = true;
    if (s.lowest && low) low = std::min(*low, *s.lowest);
    high = s.lowest && high ? std::optional(std::max(*high, *s.lowest)) : std::nullopt;
  }
  if (!others) return text;
  return text + fmt::format(
                    ". The other methods allow {} to {}. They assume that the canopy fills over {:.3g} D0. "
                    "The distance depends on the deployment, and over a shorter one the load is higher. Use "
                    "a speed above {} only if a measured opening or a coupled inflation (--opening) of this "
                    "deployment confirms that distance",
                    printed(low), printed(high), filling_distance, printed(design.lowest));
}

}  // namespace

const SafeSpeed& FastestResult::design() const {
  return *std::find_if(methods.begin(), methods.end(),
                       [&](const SafeSpeed& s) { return s.method == design_method; });
}

std::string to_json(const FastestResult& result) {
  return json_text(result);
}

FastestResult run_fastest(const Settings& resolved, const LoadRequest& request, double margin,
                          std::optional<LoadUncertainty> known,
                          const std::function<double(double)>& least_load) {
  require_one_canopy(resolved, "an opening load");
  if (!(margin >= 0) || !std::isfinite(margin))
    throw Error(ExitCode::usage, fmt::format("a margin of safety of {:g}: must be 0 or above", margin));
  if (!weakest(load_margins(resolved, 1)))
    throw Error(ExitCode::usage,
                "no strength of lines, riser or hardware is known: give break_load_n to the materials of the "
                "lines, or [hardware.NAME] with breaking_load_n or rated_load_n");
  if (request.measured_load)
    throw Error(ExitCode::usage,
                "a measured load belongs to one speed: leave out --measured-load for the fastest deployment");
  FastestResult r;
  const LoadInputs inputs = load_inputs(resolved, request);
  r.warnings = inputs.warnings;
  const LoadsAtSpeed loads(resolved, request, inputs, least_load);
  const LoadResult& fast = loads.at(fastest_deployment);
  r.title = fast.title, r.payload_mass = fast.payload_mass, r.parachute_mass = fast.parachute_mass;
  r.height = fast.height, r.density = fast.density, r.air_source = fast.air_source;
  r.path_angle = request.path_angle, r.margin = margin;
  LoadUncertainty uncertainty = known ? std::move(*known) : load_uncertainty(inputs.drag);
  r.load_uncertainty = uncertainty.value, r.load_uncertainty_from = std::move(uncertainty.from);
  const double slowest =
      std::max(slowest_deployment, 1.001 * slowest_opening(r.payload_mass + r.parachute_mass,
                                                           fast.drag_coefficient * fast.reference_area,
                                                           r.density, request.path_angle));
  loads.require_snatch(slowest);
  const bool computed = fast.record_peak_load && request.reefing.empty() && fast.record_limit.empty();
  r.design_method = computed ? computed_method : infinite_mass_method;
  for (const MethodLoad& m : fast.stages.front().methods)
    r.methods.push_back(safe_speed(resolved, loads, m.method, slowest, r));
  r.snatch = loads.snatch(r.design().unsafe_at ? slowest : r.design().lowest.value_or(fastest_deployment));
  if (r.snatch && r.snatch->other_load) r.warnings.push_back(two_snatch_loads(*r.snatch));
  r.design_load_caution = fast.design_load_caution;
  r.cloth_checked = fast.shares.cloth > 0;
  r.advice = advice_of(r, fast.filling_constant);
  if (!r.design_load_caution.empty()) r.warnings.push_back(r.design_load_caution);
  for (std::string& text : strain_warnings(resolved, 0)) r.warnings.push_back(std::move(text));
  for (std::string& text : hardware_warnings(resolved)) r.warnings.push_back(std::move(text));
  if (r.design().unsafe_at)
    r.warnings.push_back(
        r.snatch && r.snatch->largest() > r.design().load
            ? fmt::format(
                  "no deployment is safe: the {} does not keep its margin under the snatch load of {} N; use "
                  "stronger parts, or reduce the speed difference",
                  r.design().member, rounded(r.snatch->largest()))
            : fmt::format(
                  "no deployment is safe by the method {}: at {:.3g} m/s, about the rate of descent, the "
                  "{} does not keep its margin with the uncertainty of {:.0f} % of the load; use stronger "
                  "parts",
                  r.design_method, slowest, r.design().member, 100 * r.load_uncertainty));
  return r;
}

void write_fastest(const std::filesystem::path& folder, const FastestResult& result) {
  make_results_folder(folder, "load");
  write_file(folder / "result.json", to_json(result));
}

}  // namespace ripstop::inline run

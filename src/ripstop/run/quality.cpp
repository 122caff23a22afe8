#include "ripstop/run/quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>

#include "ripstop/core/words.h"
#include "ripstop/fsi/ledger.h"

namespace ripstop::inline run {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
static_assert(ledger_tolerance == 0.01, "the remedy of ledger_gap");

/// The value with both limits. The unit of a limit is without "of the work".
std::string compared(const QualityLimit& limit, double value, bool refused) {
  const auto [apart_from_warn, warn] = rounded_apart(limit.shown_as * value, limit.shown_as * limit.warn);
  const auto [apart_from_refuse, refuse] =
      rounded_apart(limit.shown_as * value, limit.shown_as * limit.refuse);
  const std::string shown = std::max(apart_from_warn, apart_from_refuse,
                                     [](const auto& a, const auto& b) { return a.size() < b.size(); }) +
                            limit.unit;
  const std::string unit = std::string_view(limit.unit).starts_with(" %") ? " %" : limit.unit;
  const char* side = limit.at_least ? "below" : "above";
  if (refused && limit.refuse != never)
    return fmt::format("{}, the result {} (limit {}{}; values {} {}{} cause a warning)", shown, refused_text,
                       refuse, unit, side, warn, unit);
  if (refused) return fmt::format("{}, the result {}", shown, refused_text);
  if (limit.refuse == never)
    return fmt::format("{} (values {} {}{} cause a warning)", shown, side, warn, unit);
  return fmt::format("{} (values {} {}{} cause a warning, {} {}{} the result is not usable)", shown, side,
                     warn, unit, side, refuse, unit);
}

/// The part of a warning before "the result must not be used"; absent: it does not have these words.
std::optional<std::string> before_refusal(const std::string& warning) {
  const std::size_t end = warning.find(std::string("the result ") + refused_text);
  if (end == std::string::npos) return {};
  std::string reason = warning.substr(0, end);
  while (!reason.empty() && std::string_view(" ,:;").find(reason.back()) != std::string_view::npos)
    reason.pop_back();
  return reason;
}

}  // namespace

// Values of runs that agree with measurements, and why the limits are where they are: docs/theory/quality.md.
const std::vector<QualityLimit>& quality_limits() {
  static const std::vector<QualityLimit> limits = {
      {"energy_residual", "residual of the energy balance", 0.05, 0.2, false, 100, " % of the work",
       "reduce the time step (inflation.step_fraction, inflation.courant) or use finer cells (flow.cells)"},
      {"momentum_residual", "residual of the momentum balance of the air", 0.01, 0.05, false, 100,
       " % of the peak load", "reduce the time step of the flow (inflation.courant)"},
      {"mass_defect", "largest mass defect of the air after the start-up", 0.01, 0.05, false, 100,
       " % of the mass flux of the stream",
       "reduce the time step of the flow (inflation.courant, flight.courant, flow.watch.courant)"},
      {"flight_energy_residual", "residual of the energy balance of the flight", 0.01, 0.05, false, 100,
       " % of the potential energy lost", "reduce the time step (inflation.step_fraction, flight.courant)"},
      {"flight_momentum_residual", "residual of the momentum balance of the flight", 0.01, 0.05, false, 100,
       " % of the weight", "use finer cells (flight.cells_across)"},
      {"start_strain", "strain of the folded start", 1e-3, 0.02, false, 100, " %",
       "change inflation.initial_radius_m or inflation.folds"},
      {"peak_after_start_up", "time of the peak load over that of the end of the start-up", 2, 1.1, true, 1,
       "", "the peak is a part of the impulsive start of the air; use a smaller inflation.initial_radius_m"},
      {"pierced_edges", "share of cloth edges that pierce cloth", 0.02, never, false, 100, " %",
       "raise inflation.contact_pa or parachute.mesh.cloth_nodes"},
      {"contact_depth", "compression of layers of cloth in contact", 0.6, never, false, 100,
       " % of their distance", "raise inflation.contact_pa"},
      {"ledger_gap", "difference of air load, cloth load and line load", 0.02, 0.1, false, 100, " %",
       "let the coupling converge, which requires at most 1 % in a steady flow (coupling.max_iterations)"},
      {"momentum_deficit_gap", "difference of momentum deficit and air load", 0.05, 0.2, false, 100, " %",
       "lower flow.residual or raise flow.max_iterations"},
      {"drag_left", "estimated remaining change of the drag", 0.01, never, false, 100, " %",
       "raise flow.max_iterations, or compute the flow in time (flow.unsteady)"},
      {"canopy_asymmetry", "deviation of the canopy from its mirror image", 0.005, never, false, 100,
       " % of its projected diameter", "compare with the full flow domain (flow.symmetry = \"full\")"},
      {"cells_across", "number of flow cells across the inflated canopy", 10, 4, true, 1, "",
       "use more cells (flow.cells) or a smaller domain (flow.box_m)"},
  };
  return limits;
}

const QualityLimit& quality_limit(std::string_view key) {
  const auto& all = quality_limits();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& limit) { return limit.key == key; });
  if (found == all.end()) throw std::logic_error("no quality limit for " + std::string(key));
  return *found;
}

std::string reason_of_refusal(const std::string& warning) {
  const auto reason = before_refusal(warning);
  if (!reason) return warning.find(refused_text) == std::string::npos ? "" : warning;
  return reason->empty() ? warning : *reason;
}

std::string without_refusal(const std::string& warning) {
  const auto reason = before_refusal(warning);
  if (!reason) return warning;
  const std::string text =
      *reason + warning.substr(warning.find(refused_text, reason->size()) + std::strlen(refused_text));
  return text.empty() ? warning : text;
}

bool QualityLimit::beyond(double value, double bound) const {
  constexpr double rounding = 1 - 1e-9;
  return !std::isfinite(value) || (at_least ? value < rounding * bound : value > bound);
}

Judgement judge(const std::vector<QualityValue>& values) {
  Judgement judgement;
  for (const QualityValue& v : values) {
    const QualityLimit& limit = quality_limit(v.key);
    if (!limit.beyond(v.value, limit.warn)) continue;
    const bool refused = limit.beyond(v.value, limit.refuse);
    judgement.usable = judgement.usable && !refused;
    judgement.warnings.push_back(
        fmt::format("{}: {}; {}", limit.name, compared(limit, v.value, refused), limit.remedy));
  }
  return judgement;
}

}  // namespace ripstop::inline run

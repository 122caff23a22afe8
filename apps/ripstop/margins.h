// Lines of the summary of a result: payload, stresses and margins.
#pragma once

#include <optional>
#include <string>

#include "ripstop/canopy/stress.h"
#include "ripstop/case/settings.h"
#include "ripstop/run/opening/fastest.h"
#include "ripstop/run/steady/steady.h"

namespace ripstop::cli {

/// `max_line_tension` in N.
void print_stresses(double max_line_tension, const StressPeak& stress);
void print_payload(const SteadyResult& result);
/// The row above names the load of the margins. `caution`: LoadResult::design_load_caution, here and below.
void print_margins(const std::optional<Margins>& margins, const std::string& caution = {});
/// The utilisation under the design load and under the highest one, and the weakest member under the highest one.
/// Where a snatch load exceeds the design load (`snatch`), lines, riser and hardware carry it.
void print_margins(const Margins& design, const Margins& highest, const std::string& caution,
                   bool snatch = false);
/// Range of the finite-mass methods [N], for a canopy that `fills` as they assume ("fills in 1 s").
std::string finite_mass_text(const std::optional<double>& lowest, const std::optional<double>& highest,
                             double design_load, const std::string& fills);
/// A line where --mass replaces another payload.mass_kg of the case.
void print_replaced_mass(const std::optional<double>& given, const Settings& resolved);
/// The load of a shock cord that no opening load contains, with its formula.
void print_separation();
/// Volume of the packed parachute alone, and at the density of a loose packing.
std::string packed_text(double mass, double volume);
/// Strength that each part of the hardware needs.
std::string hardware_text(const HardwareNeed& need, const std::string& caution);
/// "11 m/s (12.3 m/s without the uncertainty of the load), limited by line", or that there is none.
std::string safe_speed_text(const SafeSpeed& safe, const std::string& caution = {});
/// ", riser: margin of safety -0.85, ALLOWABLE LOAD EXCEEDED"; empty where no strength is known.
std::string weakest_text(const std::optional<Margins>& margins);

}  // namespace ripstop::cli

#include "margins.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "ripstop/core/words.h"
#include "ripstop/parachute/cut.h"
#include "ripstop/run/opening/handbook.h"
#include "units_option.h"

namespace ripstop::cli {

void print_stresses(double max_line_tension, const StressPeak& stress) {
  print_row("maximum line tension", fmt::format("{:.1f} N", max_line_tension));
  print_row("maximum von Mises stress",
            fmt::format("{:.0f} N/m, mean over 50 mm ({})", stress.von_mises, stress.patch));
  print_row("maximum yarn force",
            fmt::format("{:.0f} N/m warp, {:.0f} N/m weft, means over 50 mm; {:.0f} % of the cloth wrinkled, "
                        "{:.0f} % slack",
                        stress.warp, stress.weft, 100 * stress.wrinkled, 100 * stress.slack));
}

void print_payload(const SteadyResult& r) {
  if (!r.payload) return;
  print_row("payload", fmt::format("{:.4g} kg and parachute {:.3g} kg: drag / weight {:.4f} after {} speeds",
                                   r.payload->mass, r.payload->parachute_mass, r.payload->drag_over_weight,
                                   r.payload->speeds));
}

namespace {

std::string used_text(const Margin& m) {
  return m.used       ? fmt::format("{:.1f} %", 100 * *m.used)
         : m.strength ? std::string("no load")
                      : std::string("strength not known");
}

/// `under` names the load of the margins ("under the highest design load, "); empty: a row above does.
void print_weakest(const Margins& margins, const std::string& under, const std::string& caution) {
  if (margins.weakest.empty()) return;
  const Margin& m = *weakest(margins);
  const bool with_cloth = std::any_of(margins.members.begin(), margins.members.end(),
                                      [](const Margin& each) { return each.member == "cloth"; });
  print_row("weakest member",
            fmt::format("{}{}: {} {} {} times safety factor {:.3g}, allowable load {} {} ({:.0f} % of the "
                        "{}); margin of safety {}{}{}{}",
                        under, m.member, m.load_from.value_or("load"), rounded(m.load), m.unit,
                        *m.used * *m.strength * m.knock_down / m.load, rounded(*m.strength * m.knock_down),
                        m.unit, 100 * m.knock_down, m.strength_from, margin_text(*m.margin),
                        *m.margin < 0 ? ": ALLOWABLE LOAD EXCEEDED" : "",
                        with_cloth ? "" : "; the cloth is not checked (ripstop inflate computes its stress)",
                        heavy_payload_note(caution)));
}

}  // namespace

void print_margins(const std::optional<Margins>& margins, const std::string& caution) {
  if (!margins) return;
  std::string text;
  for (const Margin& m : weakest_of_kinds(*margins))
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", m.member, used_text(m));
  print_row("utilisation", text);
  print_weakest(*margins, "", caution);
}

void print_margins(const Margins& design, const Margins& highest, const std::string& caution, bool snatch) {
  std::string text;
  for (const Margin& m : design.members) {
    const auto with_highest = std::find_if(highest.members.begin(), highest.members.end(),
                                           [&](const Margin& each) { return each.member == m.member; });
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", m.member, used_text(m));
    if (m.used && with_highest != highest.members.end() && with_highest->used)
      text += fmt::format(" ({})", used_text(*with_highest));
  }
  print_row("utilisation",
            text + "; under the design load (under the highest design load)" +
                (snatch ? "; of lines, riser and hardware at least under the snatch load" : ""));
  print_weakest(highest,
                fmt::format("under the highest design load{}, ", snatch ? " or the snatch load" : ""),
                caution);
}

std::string finite_mass_text(const std::optional<double>& lowest, const std::optional<double>& highest,
                             double design_load, const std::string& fills) {
  if (!lowest || !highest) return "no finite-mass method of ripstop load applies; use the design load";
  const std::string range = rounded(*lowest) == rounded(*highest)
                                ? rounded(*lowest)
                                : fmt::format("{} to {}", rounded(*lowest), rounded(*highest));
  return fmt::format("{} N if the canopy {} (finite-mass methods of ripstop load); {}", range, fills,
                     *highest < design_load ? "not for design" : "the largest is the design load");
}

std::string hardware_text(const HardwareNeed& need, const std::string& caution) {
  return fmt::format(
      "each swivel, link or cord needs {}a rated load of {} N, or a breaking load of {} N (metal) or {} N "
      "(textile){}",
      caution.empty() ? "" : "at least ", rounded(need.rated), rounded(need.metal), rounded(need.textile),
      heavy_payload_note(caution));
}

void print_replaced_mass(const std::optional<double>& given, const Settings& resolved) {
  const std::optional<double>& own = resolved.payload().mass_kg;
  if (!given || !own || *given == *own) return;
  const auto [mass, replaced] = rounded_apart(*given, *own, 4);
  print_text("  --mass of {} kg replaces payload.mass_kg = {} kg of the case\n", mass, replaced);
}

void print_separation() {
  print_text(
      "Not included: the load when sections of the rocket separate. A shock cord with the stiffness k "
      "(stiffness_n) and the length L (length_m) carries F = sqrt(2 E k / L). For sections of masses "
      "m1 and m2 that separate at the speed v, E = m1 m2 v^2 / (2 (m1 + m2)). If F exceeds the rated load in "
      "the row 'required hardware', design the hardware for F.\n");
}

std::string packed_text(double mass, double volume) {
  std::string text =
      fmt::format("{:.3g} litres at {:.0f} kg/m3, parachute only", 1000 * volume, mass / volume);
  if (mass / volume > loosely_packed)
    text += fmt::format("; {:.3g} litres if packed loosely at {:g} kg/m3", 1000 * mass / loosely_packed,
                        loosely_packed);
  return text;
}

std::string safe_speed_text(const SafeSpeed& s, const std::string& caution) {
  if (s.unsafe_at)
    return fmt::format("NONE: the {} does not keep its margin at {:.1f} m/s", s.member, *s.unsafe_at);
  const auto text = [](const std::optional<double>& speed) {
    return speed ? fmt::format("{:.1f}", *speed) : fmt::format("above {:g}", fastest_deployment);
  };
  if (!s.lowest) return fmt::format("no limit up to {:g} m/s (Mach 0.8)", fastest_deployment);
  return fmt::format("{}{} m/s ({} m/s without the uncertainty of the load), limited by {}{}",
                     caution.empty() ? "" : "at most ", text(s.lowest), text(s.speed), s.member,
                     heavy_payload_note(caution));
}

std::string weakest_text(const std::optional<Margins>& margins) {
  const Margin* m = margins ? weakest(*margins) : nullptr;
  if (!m) return "";
  return fmt::format(", {}: margin of safety {}{}", m->member, margin_text(*m->margin),
                     *m->margin < 0 ? ", ALLOWABLE LOAD EXCEEDED" : "");
}

}  // namespace ripstop::cli

#include "margins.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "ripstop/core/words.h"
#include "units_option.h"

namespace ripstop::cli {

void print_stresses(double max_line_tension, const StressPeak& stress) {
  print_row("maximum line tension", fmt::format("{:.1f} N", max_line_tension));
  print_row("maximum von Mises stress", fmt::format("{:.0f} N/m ({})", stress.von_mises, stress.patch));
  print_row("maximum yarn force",
            fmt::format("{:.0f} N/m warp, {:.0f} N/m weft; {:.0f} % of the cloth wrinkled, {:.0f} % slack",
                        stress.warp, stress.weft, 100 * stress.wrinkled, 100 * stress.slack));
}

void print_payload(const SteadyResult& r) {
  if (!r.payload) return;
  print_row("payload",
            fmt::format("{:.4g} kg and parachute {:.3g} kg: drag / weight {:.4f}, {} speeds computed",
                        r.payload->mass, r.payload->parachute_mass, r.payload->drag_over_weight,
                        r.payload->speeds));
}

void print_margins(const std::optional<Margins>& margins, std::optional<double> largest) {
  if (!margins) return;
  const auto under_largest = [&](const Margin& m) {
    return largest ? fmt::format(" ({:.1f} %)", 100 * *largest * *m.used) : "";
  };
  std::string text;
  for (const Margin& m : weakest_of_kinds(*margins))
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", m.member,
                        m.used       ? fmt::format("{:.1f} %", 100 * *m.used) + under_largest(m)
                        : m.strength ? std::string("no load")
                                     : std::string("strength not known"));
  print_row("utilisation", text + (largest ? "; under the design load (under the largest load)" : ""));
  if (!margins->weakest.empty()) {
    const Margin& m = *weakest(*margins);
    print_row(
        "weakest member",
        fmt::format("{}: {} {} {} times safety factor {:.3g}, allowable load {} {} ({:.0f} % of the "
                    "strength); margin of safety {:+.2f}{}",
                    m.member, m.load_from.value_or("load"), rounded(m.load), m.unit,
                    *m.used * *m.strength * m.knock_down / m.load, rounded(*m.strength * m.knock_down),
                    m.unit, 100 * m.knock_down, *m.margin, *m.margin < 0 ? ": ALLOWABLE LOAD EXCEEDED" : ""));
  }
}

std::string hardware_text(const HardwareNeed& need) {
  return fmt::format(
      "each swivel, link or cord needs a rated load of {} N, or a breaking load of {} N (metal) or {} N "
      "(textile)",
      rounded(need.rated), rounded(need.metal), rounded(need.textile));
}

std::string safe_speed_text(const SafeSpeed& s) {
  if (s.unsafe_at)
    return fmt::format("NONE: the {} exceeds its allowable load at {:.1f} m/s", s.member, *s.unsafe_at);
  const auto text = [](const std::optional<double>& speed) {
    return speed ? fmt::format("{:.1f}", *speed) : fmt::format("above {:g}", fastest_deployment);
  };
  return fmt::format("{} m/s, range {} to {} m/s, {} reaches its allowable load", text(s.speed),
                     text(s.lowest), text(s.highest), s.member);
}

std::string weakest_text(const std::optional<Margins>& margins) {
  const Margin* m = margins ? weakest(*margins) : nullptr;
  if (!m) return "";
  return fmt::format(", {}: margin of safety {:+.2f}{}", m->member, *m->margin,
                     *m->margin < 0 ? ", ALLOWABLE LOAD EXCEEDED" : "");
}

}  // namespace ripstop::cli

#include "margins.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace ripstop {
namespace {

void row(const char* name, const std::string& text) {
  fmt::print("  {:<26} {}\n", name, text);
}

/// The weakest of the lines stands for all.
std::vector<Margin> shown(const Margins& margins) {
  std::vector<Margin> rows;
  for (const Margin& m : margins.members) {
    const bool line = m.member.starts_with("line ");
    if (line && !rows.empty() && rows.back().member.starts_with("line ")) {
      if (m.used.value_or(0) > rows.back().used.value_or(0)) rows.back() = m;
      continue;
    }
    rows.push_back(m);
  }
  return rows;
}

}  // namespace

void print_payload(const SteadyResult& r) {
  if (!r.payload) return;
  row("payload", fmt::format("{:.4g} kg and parachute {:.3g} kg: drag over weight {:.4f}, {} speeds tried",
                             r.payload->mass, r.payload->parachute_mass, r.payload->drag_over_weight,
                             r.payload->speeds));
}

void print_margins(const std::optional<Margins>& margins) {
  if (!margins) return;
  std::string text;
  for (const Margin& m : shown(*margins))
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", m.member,
                        m.used ? fmt::format("{:.1f} %", 100 * *m.used) : "strength not known");
  row("strength used", text);
  if (!margins->weakest.empty()) {
    const Margin& m = *weakest(*margins);
    row("weakest",
        fmt::format("{}: {:.4g} {} of {:.4g}, of which {:.0f} % are left; margin of safety {:+.2f}{}",
                    m.member, m.load, m.unit, *m.strength, 100 * m.knock_down, *m.margin,
                    *m.margin < 0 ? ": DOES NOT HOLD" : ""));
  }
}

}  // namespace ripstop

#include "ripstop/case/quantity_keys.h"

#include <algorithm>
#include <stdexcept>

#include "ripstop/core/quantity_error.h"

namespace ripstop {

const std::vector<std::pair<std::string, std::string>>& quantity_keys() {
  static const std::vector<std::pair<std::string, std::string>> keys = {
      {"cloth tolerance", "coupling.cloth_tolerance"},
      {"cloth mesh", "parachute.mesh"},
      {"flow grid", "grid (flow.cells)"},
      {"Courant number of the flow", "inflation.courant"},
      {"mass of the payload", "payload.mass_kg"},
      {"region of fine cells", "region of fine cells (flow.core.size_m)"},
      {"radius of the folded skirt", "inflation.initial_radius_m"},
      {"length of the first reefing line", "inflation.reefing[0].line_m"},
      {"low-pass cutoff", "inflation.low_pass_hz"},
      {"the history rate", "inflation.history_hz"}};
  return keys;
}

std::string message_of(const Error& error) {
  std::string text = error.what();
  const auto* named = dynamic_cast<const QuantityError*>(&error);
  if (!named) return text;
  for (const std::string& quantity : named->quantities()) {
    const auto found = std::find_if(quantity_keys().begin(), quantity_keys().end(),
                                    [&](const auto& entry) { return entry.first == quantity; });
    if (found == quantity_keys().end()) throw std::out_of_range("no key for the quantity " + quantity);
    if (const std::size_t at = text.find(quantity); at != std::string::npos)
      text.replace(at, quantity.size(), found->second);
  }
  return text;
}

}  // namespace ripstop

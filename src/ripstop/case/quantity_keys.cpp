#include "ripstop/case/quantity_keys.h"

#include <algorithm>
#include <stdexcept>

#include "ripstop/core/quantity_error.h"

namespace ripstop::inline cases {

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
      {"the history rate", "inflation.history_hz"},
      {"number of folds", "inflation.folds"},
      {"spread angle", "cluster.spread_angle_deg"},
      {"the widest spread angle", "cluster.widest_spread_angle_deg"},
      {"length of the riser", "parachute.riser.length_m"},
      {"slack of the lines", "inflation.slack_m"},
      {"number of cloth nodes", "parachute.mesh.cloth_nodes"},
      {"length of lines on the canopy", "parachute.lines.onto_disk_m"},
      {"tape on the seams", "parachute.tape.seams = true with a parachute.tape.material"},
      {"number of threads", "number of threads (--threads, --jobs, coupling.threads)"},
      {"the built-in engine", "flow.engine = \"builtin\""},
      {"open jet", "flow.tunnel.kind = \"open-jet\""},
      {"speed of the free stream", "flow.speed_m_s"},
      {"the temperature of the air", "flow.temperature_k"},
      {"the size of the domain", "flow.box_m"},
      {"the position of the body", "the position of the body (x_m, y_m and body.NAME.trailing_distance_m)"},
      {"sides", "flow.sides"},
      {"outlet", "flow.outlet"},
      {"porosity model", "flow.porosity_model"},
      {"kind of tunnel", "flow.tunnel.kind"},
      {"iterations of the mean", "flow.average_over"},
      {"unsteady flow", "flow.unsteady"},
      {"symmetry of the flow", "flow.symmetry"},
      {"MPI ranks", "flow.ranks"},
      {"kind of mesh", "flow.mesh"},
      {"upwind convection", "flow.convection = \"upwind\""},
      {"longer domain", "longer domain (flow.box_m)"},
      {"cells of more equal sides", "cells of more equal sides (flow.cells, flow.core.size_m)"},
      {"refinement at the cloth", "refinement at the cloth (flow.cloth_levels)"}};
  return keys;
}

const std::string& key_of_quantity(const std::string& quantity) {
  const auto found = std::find_if(quantity_keys().begin(), quantity_keys().end(),
                                  [&](const auto& entry) { return entry.first == quantity; });
  if (found == quantity_keys().end()) throw std::out_of_range("no key for the quantity " + quantity);
  return found->second;
}

std::string message_of(const Error& error) {
  std::string text = error.what();
  const auto* named = dynamic_cast<const QuantityError*>(&error);
  if (!named) return text;
  for (const std::string& quantity : named->quantities()) {
    const std::string& key = key_of_quantity(quantity);
    if (const std::size_t at = text.find(quantity); at != std::string::npos)
      text.replace(at, quantity.size(), key);
  }
  return text;
}

}  // namespace ripstop::inline cases

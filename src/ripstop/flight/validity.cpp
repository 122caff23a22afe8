#include "ripstop/flight/validity.h"

#include <fmt/format.h>

#include <limits>

#include "ripstop/core/error.h"
#include "ripstop/core/words.h"

namespace ripstop::inline flight {

const std::vector<ValidRange>& valid_ranges() {
  constexpr double any = std::numeric_limits<double>::infinity();
  constexpr const char* calibrated_cells =
      "the cell sizes for which the porosity coefficients of [NFM] are calibrated";
  static const std::vector<ValidRange> ranges = {
      // C_x and C_D are subsonic values; the drag coefficient of textile canopies changes near the speed of sound.
      {infinite_mass_model, "Mach number", "", 0, 0.8, any, "subsonic coefficients (assumed)"},
      {finite_mass_model, "Mach number", "", 0, 0.8, any, "subsonic coefficients (assumed)"},
      {finite_mass_model, "speed at line stretch", " m/s", 0, 152, any,
       "t_f = n D0 / v is valid up to 500 ft/s, below 150 ft/s t_f = 4.0 D0 / v^0.85, Knacke"},
      {filling_model, "nominal diameter", " m", 3, 40, any,
       "range of the canopies in Knacke's tables, 10 to 130 ft (assumed)"},
      {finite_mass_model, "ballistic parameter A", "", 0.01, any, any, "Knacke Fig. 5-51"},
      {flow_model, "Mach number", "", 0, 0.3, any, "the density changes by less than 5 % in the flow"},
      {flow_model, "Reynolds number", "", 1e4, any, any,
       "drag of sharp edges and turbulent wakes is independent of it (assumed)"},
      {scaled_drag_model, "Mach number", "", 0, 0.3, 1, "the run is incompressible"},
      {permeability_model, "dynamic pressure", " Pa", 0, 2000, any,
       "the fit to a measured curve has 6 % too little air flow at 2 kPa and 18 % at 11 kPa"},
      // Drag of the calibrated coefficients falls by 8 to 14 % from cells of 0.04 m to smaller ones: the range is 2 %.
      {porous_cells_model, "cell width across the stream", " m", 0.0196, 0.0204, any,
       "cells of 0.02 x 0.02 x 0.0267 m", calibrated_cells},
      {porous_cells_model, "cell length along the stream", " m", 0.0261, 0.0272, any,
       "cells of 0.02 x 0.02 x 0.0267 m", calibrated_cells},
      {scaled_drag_model, "Reynolds number", "", 1e4, any, any, "as for the run (assumed)"},
  };
  return ranges;
}

std::vector<std::string> outside_range(const std::string& model, const std::vector<ModelValue>& values) {
  std::vector<std::string> all;
  for (const ModelValue& v : values)
    for (const ValidRange& r : valid_ranges()) {
      if (r.model != model || v.quantity != std::string(r.quantity)) continue;
      if (v.value >= r.low && v.value <= r.high) continue;
      const std::string range = r.high < std::numeric_limits<double>::infinity()
                                    ? fmt::format("{:g} to {:g}{}", r.low, r.high, r.unit)
                                    : fmt::format("{:g}{} and above", r.low, r.unit);
      const std::string value = rounded_apart(v.value, v.value < r.low ? r.low : r.high).first;
      const std::string limits = r.outside_of ? r.outside_of : std::string("the range of the ") + r.model;
      std::string text = fmt::format("{} of {}{} is outside {}, {} ({})", r.quantity, value, r.unit, limits,
                                     range, r.source);
      if (v.value > r.refused_above)
        throw Error(ExitCode::usage, fmt::format("{}; above {:g} it gives no result", text, r.refused_above));
      all.push_back(std::move(text));
    }
  return all;
}

}  // namespace ripstop::inline flight

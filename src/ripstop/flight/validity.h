// The range of validity of every model whose answer is a plain number, in one list.
#pragma once

#include <string>
#include <vector>

namespace ripstop::inline flight {

struct ValidRange {
  const char* model;
  const char* quantity;
  const char* unit;
  double low = 0, high = 0;  // outside of these the answer has a warning
  double refused_above = 0;  // infinite: never refused
  const char* source;
  const char* outside_of = nullptr;  // of a warning, in place of "the range of the" model
};
const std::vector<ValidRange>& valid_ranges();

/// Names of the models in the list.
inline constexpr const char *infinite_mass_model = "infinite-mass opening load",
                            *finite_mass_model = "finite-mass handbook methods",
                            *filling_model = "handbook filling distance", *flow_model = "incompressible flow",
                            *scaled_drag_model = "drag area of a run at another speed",
                            *permeability_model = "permeability of open cloth",
                            *porous_cells_model = "porosity coefficients of [NFM]";

struct ModelValue {
  const char* quantity;
  double value = 0;
};
/// A sentence for every value that lies outside its range, with the range and its source; a quantity that the model has
/// no range for is ignored. Throws Error(usage) for a value above `refused_above`.
std::vector<std::string> outside_range(const std::string& model, const std::vector<ModelValue>& values);

}  // namespace ripstop::inline flight

#include "warnings.h"

#include <fmt/format.h>

#include "ripstop/material/fit_material.h"

namespace ripstop {

void print_material_warnings(const Case& value, double largest_cloth_strain) {
  for (const auto& [name, material] : value.materials) {
    const double strain = name == value.parachute.canopy_material ? largest_cloth_strain : 0.0;
    for (const std::string& text : material_warnings(material, strain))
      fmt::print(stderr, "warning: {}\n", text);
  }
}

}  // namespace ripstop

#include "warnings.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "ripstop/core/visible.h"
#include "ripstop/run/steady/warnings.h"

namespace ripstop {
namespace {

void print_all(const std::vector<std::string>& warnings) {
  for (const std::string& text : warnings) fmt::print(stderr, "warning: {}\n", visible(text));
}

}  // namespace

void print_deprecations(const std::vector<std::string>& deprecations) {
  print_all(deprecations);
}

void print_mesh_warning(const Settings& resolved) {
  print_all(mesh_warnings(resolved));
}

void print_case_warnings(const Settings& resolved) {
  print_all(case_warnings(resolved));
}

void print_material_warnings(const Settings& resolved, double largest_cloth_strain) {
  print_all(strain_warnings(resolved, largest_cloth_strain));
}

}  // namespace ripstop

#include "ripstop/material/strength.h"

#include <variant>
#include <vector>

#include "ripstop/material/spring_law.h"

namespace ripstop::inline material {
namespace {

constexpr double share_along_yarn = 0.5;  // of the mass of a cloth

Strength strength(double break_load, const std::vector<double>& coefficients, double width,
                  double tested_strain) {
  if (break_load > 0) return {break_load, "breaking load"};
  if (tested_strain > 0)
    return {width * SpringLaw{coefficients}.tension(tested_strain), "load at the tested strain"};
  return {std::nullopt, "not known: the material has neither break load nor tested strain"};
}

double carrying_mass(const Fabric& cloth) {
  return share_along_yarn * cloth.areal_density_kg_m2;
}
double carrying_mass(const Line& line) {
  return line.linear_density_kg_m;
}
double carrying_mass(const Tape& tape) {
  return tape.linear_density_kg_m;
}

}  // namespace

Strength strength_of(const Fabric& cloth) {
  return strength(cloth.break_load_n_m, cloth.coefficients_n_m, 1, cloth.tested_strain);
}

Strength strength_of(const Line& line) {
  return strength(line.break_load_n, line.coefficients_n, 1, line.tested_strain);
}

Strength strength_of(const Tape& tape) {
  return strength(tape.break_load_n, tape.coefficients_n_m, tape.width_m, tape.tested_strain);
}

std::optional<double> specific_strength(const Material& material) {
  return std::visit(
      [](const auto& m) -> std::optional<double> {
        const Strength known = strength_of(m);
        const double mass = carrying_mass(m);
        if (!known.value || !(mass > 0)) return {};
        return *known.value / mass;
      },
      material);
}

}  // namespace ripstop::inline material

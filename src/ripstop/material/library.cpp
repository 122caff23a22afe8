#include "ripstop/material/library.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ripstop/core/build_info.h"
#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/read.h"
#include "ripstop/core/toml/write.h"
#include "ripstop/material/spring_law.h"

namespace ripstop::inline material {
namespace {

constexpr double stiffness_limit = 1e9;  // of K_1 [N] or [N/m]; steel cable of 100 mm has less
// Of K_k relative to K_1 / strain^(k - 1), with the tested strain or, where that is unknown, the least at which a
// pull is taken for one to failure. Fits of degree 8 have some 1e4: the terms of a Chebyshev polynomial.
constexpr double coefficient_ratio_limit = 1e6;
constexpr double least_tested_strain = 0.0025;
constexpr double coefficient_limit = 1e40;  // of any: above all that these allow

std::vector<double>& coefficients(Fabric& material) {
  return material.coefficients_n_m;
}
std::vector<double>& coefficients(Tape& material) {
  return material.coefficients_n_m;
}
std::vector<double>& coefficients(Line& material) {
  return material.coefficients_n;
}

void describe_kind(Fields& fields, Material& material) {
  fields.kind("kind", material, {"fabric", "line", "tape"}, "Kind of the material.");
}

std::string load_base(Material& material, const std::string& name) {
  try {
    if (!is_name(name)) return "must be the name of a material in the library";
    material = library_material(name);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

/// A stiffness that falls to zero within the tested strain would make the lattice unstable.
void check_law(const std::vector<double>& k, double tested_strain, const std::string& key,
               const std::string& strain_key, Findings& findings) {
  if (!findings.sound({key, strain_key}) || k.empty()) return;
  if (k[0] <= 0) {
    findings.add(key + "[0]", k[0], "above 0", "must be above 0: the initial stiffness is positive");
    return;
  }
  if (k[0] > stiffness_limit)
    findings.add(key + "[0]", k[0], fmt::format("at most {:g}", stiffness_limit),
                 "exceeds that of a steel cable");
  const double strain = tested_strain > 0 ? tested_strain : least_tested_strain;
  double limit = coefficient_ratio_limit * k[0];
  for (std::size_t i = 1; i < k.size(); ++i) {
    limit /= strain;
    if (std::abs(k[i]) > limit)
      findings.add(fmt::format("{}[{}]", key, i), k[i], fmt::format("between {:g} and {:g}", -limit, limit),
                   fmt::format("exceeds {:g} K_1 / {:g}^{}, the limit of a curve up to this strain",
                               coefficient_ratio_limit, strain, i));
  }
  const SpringLaw law{k, 1};
  constexpr int samples = 1000;
  for (int i = 1; i <= samples; ++i) {
    const double at = tested_strain * i / samples;
    if (law.tangent(at) > 0) continue;
    findings.add(key, fmt::format("[{}]", fmt::join(k, ", ")), "",
                 fmt::format("the load falls with growing strain beyond {:.3g}, within tested_strain = {}; "
                             "the load must increase up to this strain",
                             at, tested_strain));
    return;
  }
}

void describe_source(Fields& fields, std::string& source, std::string& warning) {
  fields.text("source", source, 500, "Source of the values.");
  fields.text("warning", warning, most_warning_text,
              "Warnings of the fit of its tests. Every run repeats them.");
}

void describe_compression(Fields& fields, double& compression, std::optional<double>& buckling_strain) {
  fields.number("compression", compression, from(0).up_to(1),
                "Stiffness in compression relative to K_1 up to the buckling strain; 0: none.");
  fields
      .number("buckling_strain", buckling_strain, from(0).up_to(1),
              "Compressive strain beyond which the cloth wrinkles and carries no more load.")
      .absent("1e-6 in steady runs with the `sheet` model and in openings, else never");
}

void describe_damping(Fields& fields, double& damping) {
  fields.number("damping_n_s_m", damping, from(0).up_to(1000), "Relative damping C of each spring.");
}

void describe_resistance(Fields& fields, ClothResistance& cloth) {
  fields
      .number("pressure_drop_linear_pa_s_m", cloth.pressure_drop_linear_pa_s_m, from(0).up_to(1e12),
              "Linear coefficient a of the cloth's pressure drop a v + b v|v| ([NFM] Eq. 15).")
      .absent("`0`");
  fields
      .number("pressure_drop_quadratic_pa_s2_m2", cloth.pressure_drop_quadratic_pa_s2_m2, from(0).up_to(1e9),
              "Quadratic coefficient b of this pressure drop.")
      .absent("`0`");
  fields
      .number("permeability_cfm", cloth.permeability_cfm, above(0).below(1e4),
              "Air permeability in CFM/ft2 at 124.5 Pa (ASTM D737), instead of a and b: a is 124.5 Pa over "
              "the velocity, b is 0.")
      .absent("a and b are used");
  fields
      .number(
          "darcy_1_m2", cloth.darcy_1_m2, from(0).up_to(1e12),
          "Darcy coefficient d of porous cells (`paper` model), calibrated for one cell size; instead of a "
          "and b.")
      .absent("`0`");
  fields
      .number("forchheimer_1_m", cloth.forchheimer_1_m, from(0).up_to(1e9),
              "Forchheimer coefficient f of porous cells (`paper` model).")
      .absent("`0`");
}

void describe_tested_strain(Fields& fields, double& strain) {
  fields.number("tested_strain", strain, from(0).up_to(5), "Largest strain of the fitted tests; 0: unknown.");
}

}  // namespace

void describe(Fields& fields, Fabric& fabric) {
  describe_source(fields, fabric.source, fabric.warning);
  fields
      .numbers("coefficients_n_m", fabric.coefficients_n_m, 1, 8,
               from(-coefficient_limit).up_to(coefficient_limit),
               "K_1..K_n of load per width against strain along the warp, N/m ([NFM] Eq. 2); K_1 above 0.")
      .required();
  fields.numbers("weft_coefficients_n_m", fabric.weft_coefficients_n_m, 0, 8,
                 from(-coefficient_limit).up_to(coefficient_limit),
                 "K_1..K_n along the weft, N/m; empty: as along the warp.");
  fields.number("shear_fraction", fabric.shear_fraction, from(0).below(1),
                "Shear fraction xi: share of the shear springs ([NFM] Eq. 11).");
  fields.number("bending_fraction", fabric.bending_fraction, from(0).below(1),
                "Bending fraction eps: share of the bending springs ([NFM] Eq. 11).");
  describe_compression(fields, fabric.compression, fabric.buckling_strain);
  describe_damping(fields, fabric.damping_n_s_m);
  fields.number("areal_density_kg_m2", fabric.areal_density_kg_m2, above(0).up_to(10), "Mass per area.")
      .required();
  fields
      .number("thickness_m", fabric.thickness_m, above(0).up_to(0.1),
              "Thickness, for stresses in Pa and porosity.")
      .required();
  describe_tested_strain(fields, fabric.tested_strain);
  fields.number("break_load_n_m", fabric.break_load_n_m, from(0).up_to(1e7),
                "Load per width at failure; 0: unknown.");
  describe_resistance(fields, fabric.resistance);
}

void describe(Fields& fields, Line& line) {
  describe_source(fields, line.source, line.warning);
  fields
      .numbers("coefficients_n", line.coefficients_n, 1, 8, from(-coefficient_limit).up_to(coefficient_limit),
               "K_1..K_n of tension against strain, N ([NFM] Eq. 2); K_1 above 0.")
      .required();
  fields.number("bending_fraction", line.bending_fraction, from(0).below(1),
                "Bending fraction eps: share of the springs that span two segments of the line.");
  fields.number("compression", line.compression, from(0).up_to(1),
                "Stiffness in compression relative to K_1; 0: the line goes slack.");
  describe_damping(fields, line.damping_n_s_m);
  fields.number("linear_density_kg_m", line.linear_density_kg_m, above(0).up_to(100), "Mass per length.")
      .required();
  describe_tested_strain(fields, line.tested_strain);
  fields.number("break_load_n", line.break_load_n, from(0).up_to(1e9), "Tension at failure; 0: unknown.");
}

void describe(Fields& fields, Tape& tape) {
  describe_source(fields, tape.source, tape.warning);
  fields
      .numbers("coefficients_n_m", tape.coefficients_n_m, 1, 8,
               from(-coefficient_limit).up_to(coefficient_limit),
               "K_1..K_n of load per width against strain, N/m ([NFM] Eq. 2); K_1 above 0.")
      .required();
  fields.number("width_m", tape.width_m, above(0).up_to(1), "Width.").required();
  fields.number("linear_density_kg_m", tape.linear_density_kg_m, above(0).up_to(100), "Mass per length.")
      .required();
  fields.number("thickness_m", tape.thickness_m, above(0).up_to(0.1), "Thickness.").required();
  describe_compression(fields, tape.compression, tape.buckling_strain);
  describe_damping(fields, tape.damping_n_s_m);
  describe_tested_strain(fields, tape.tested_strain);
  fields.number("break_load_n", tape.break_load_n, from(0).up_to(1e9), "Tension at failure; 0: unknown.");
}

void describe(Fields& fields, Material& material) {
  fields.base(
      "base", [&material](const std::string& name) { return load_base(material, name); },
      "Material of the library to start from; the keys given here replace its values.");
  describe_kind(fields, material);
}

void check_material(const Material& material, const std::string& key, Findings& findings) {
  const auto dot = [&](const char* name) { return key.empty() ? std::string(name) : key + "." + name; };
  std::visit(
      [&](auto chosen) {
        const std::string name =
            dot(std::holds_alternative<Line>(material) ? "coefficients_n" : "coefficients_n_m");
        check_law(coefficients(chosen), chosen.tested_strain, name, dot("tested_strain"), findings);
      },
      material);
  const auto* fabric = std::get_if<Fabric>(&material);
  if (fabric)
    check_law(fabric->weft_coefficients_n_m, fabric->tested_strain, dot("weft_coefficients_n_m"),
              dot("tested_strain"), findings);
  if (!fabric || !findings.sound({dot("shear_fraction"), dot("bending_fraction")})) return;
  if (fabric->shear_fraction + fabric->bending_fraction >= 1)
    findings.add(
        dot("shear_fraction"), fabric->shear_fraction, fmt::format("below {}", 1 - fabric->bending_fraction),
        fmt::format(
            "no share remains for the axial springs with bending_fraction = {}; the sum must be below 1",
            fabric->bending_fraction));
}

std::string kind_of(const Material& material) {
  constexpr const char* names[] = {"fabric", "line", "tape"};
  return names[material.index()];
}

std::string name_of(const Material& material) {
  return std::visit([](const auto& chosen) { return chosen.name; }, material);
}

void set_name(Material& material, const std::string& name) {
  std::visit([&](auto& chosen) { chosen.name = name; }, material);
}

std::string material_to_toml(const Material& material) {
  Material copy = material;
  Fields fields;
  describe_kind(fields, copy);
  return to_toml(fields);
}

std::vector<std::string> library_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(data_directory() / "materials"))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

Material read_material(const std::filesystem::path& file) {
  std::vector<Problem> problems;
  Material material;
  try {
    Document document = parse_toml(read_text_file(file), file.string());
    rename_old_keys(document.root);
    Origins origins;
    // A library file is complete: no `base`.
    read_and_check([&](Fields& fields) { describe_kind(fields, material); }, document, origins, problems);
    Findings findings(origins, problems);
    check_material(material, "", findings);
    if (auto* fabric = std::get_if<Fabric>(&material))
      settle_resistance(
          fabric->resistance, [](const std::string&) { return true; },
          [&](const std::string& key, const std::string& message) { findings.add(key, "", "", message); });
  } catch (const InputError& error) {
    problems = error.problems();
  }
  if (!problems.empty()) throw InputError(ExitCode::bad_data, problems);
  set_name(material, file.stem().string());
  return material;
}

Material library_material(const std::string& name) {
  const std::vector<std::string> names = library_names();
  if (std::find(names.begin(), names.end(), name) != names.end())
    return read_material(data_directory() / "materials" / (name + ".toml"));
  const std::string near = nearest(name, names);
  throw Error(ExitCode::usage, fmt::format("no material {} in the library; {}", quoted(name),
                                           near.empty() ? fmt::format("available: {}", fmt::join(names, ", "))
                                                        : fmt::format("did you mean {}?", quoted(near))));
}

}  // namespace ripstop::inline material

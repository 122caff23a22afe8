#include "ripstop/material/library.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <regex>
#include <sstream>

#include "ripstop/core/file.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/core/units.h"
#include "ripstop/material/fit_material.h"
#include "ripstop/material/permeability.h"
#include "ripstop/material/spring_law.h"

namespace ripstop {
namespace {

std::vector<Material> everything() {
  std::vector<Material> list;
  for (const std::string& name : library_names()) list.push_back(library_material(name));
  return list;
}

TEST(Library, EveryMaterialHasASource) {
  EXPECT_GE(everything().size(), 20u);
  for (const Material& material : everything())
    std::visit([](const auto& m) { EXPECT_GT(m.source.size(), 20u) << m.name; }, material);
}

/// Words for the numbers of each key; `source` or a comment contains one of them.
const std::map<std::string, std::string> words_of_sources = {{"coefficients", "\\bK\\b|curve|modulus"},
                                                             {"shear_fraction", "\\bxi\\b"},
                                                             {"bending_fraction", "\\beps\\b|Bending"},
                                                             {"compression", "compression|slack"},
                                                             {"areal_density", "weight|mass"},
                                                             {"linear_density", "linear density|mass|pound"},
                                                             {"thickness", "thickness"},
                                                             {"break_load", "strength|break|lbf"},
                                                             {"tested_strain", "strain|elongation"},
                                                             {"width", "width"},
                                                             {"pressure_drop", "permeability|CFM"},
                                                             {"darcy", "Darcy"},
                                                             {"forchheimer", "Forchheimer"}};

TEST(Library, EveryNumberHasASourceOrIsAssumed) {
  int numbers = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "materials")) {
    if (entry.path().extension() != ".toml") continue;
    std::string explained;
    std::vector<std::string> bare;  // keys of numbers without a comment of their own
    std::istringstream lines(read_file(entry.path()));
    std::smatch key;
    for (std::string line; std::getline(lines, line);) {
      const std::size_t comment = line.find('#');
      if (comment != std::string::npos || line.starts_with("source")) explained += line + "\n";
      if (!std::regex_search(line, key, std::regex(R"(^\w+ = [\[\d-])"))) continue;
      ++numbers;
      if (comment == std::string::npos) bare.push_back(key[0]);
    }
    for (const std::string& name : bare) {
      const auto group = std::find_if(words_of_sources.begin(), words_of_sources.end(), [&](const auto& one) {
        return name.find(one.first) != std::string::npos;
      });
      ASSERT_NE(group, words_of_sources.end()) << name;
      EXPECT_TRUE(std::regex_search(explained, std::regex(group->second))) << entry.path() << " " << name;
    }
  }
  EXPECT_GT(numbers, 150);
}

TEST(Library, AMaterialFileThatCannotBeClothIsRefused) {
  const TemporaryFolder folder("material");
  Fabric cloth = std::get<Fabric>(library_material("f-111"));
  cloth.shear_fraction = 0.6, cloth.bending_fraction = 0.1;
  write_file(folder.path / "cloth.toml", material_to_toml(cloth));
  EXPECT_EQ(std::get<Fabric>(read_material(folder.path / "cloth.toml")).shear_fraction, 0.6);
  cloth.bending_fraction = 0.4;  // nothing is left for the yarns
  write_file(folder.path / "cloth.toml", material_to_toml(cloth));
  try {
    read_material(folder.path / "cloth.toml");
    FAIL() << "was accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    ASSERT_EQ(error.problems().size(), 1u) << error.what();
    EXPECT_EQ(error.problems()[0].key, "shear_fraction");
  }
}

TEST(Library, EveryClothBreaksWhereItsCurveReachesItsBreakingLoad) {
  for (const Material& material : everything()) {
    const auto* cloth = std::get_if<Fabric>(&material);
    if (!cloth) continue;
    const std::vector<double>& weft = cloth->weft_coefficients_n_m;  // the weaker one where it is given
    EXPECT_NEAR(SpringLaw({weft.empty() ? cloth->coefficients_n_m : weft, 1}).tension(cloth->tested_strain) /
                    cloth->break_load_n_m,
                1, 0.02)
        << cloth->name;
  }
}

TEST(Library, EveryLineBreaksWhereItsCurveReachesItsBreakingLoad) {
  for (const Material& material : everything()) {
    const auto* line = std::get_if<Line>(&material);
    if (!line || line->break_load_n == 0) continue;
    EXPECT_NEAR(SpringLaw({line->coefficients_n, 1}).tension(line->tested_strain) / line->break_load_n, 1,
                0.01)
        << line->name;
    // No fibre bears more than 4 N/tex; a unit wrong by 1000 would.
    EXPECT_LT(line->break_load_n / line->linear_density_kg_m, 4e6) << line->name;
    EXPECT_GT(line->break_load_n / line->linear_density_kg_m, 0.1e6) << line->name;
  }
}

TEST(Library, ClothsLetThroughTheAirOfTheirSpecification) {
  struct Range {
    const char* name;
    double low, high;
  };
  for (const Range& r : {Range{"f-111-physical", 0.5, 5}, Range{"pia-c-44378-type-ii", 30, 50},
                         Range{"pia-c-44378-type-iv", 0.5, 3}, Range{"mil-c-7020-type-i", 80, 120}}) {
    const Fabric cloth = std::get<Fabric>(library_material(r.name));
    const double flow = cfm(as_sheet(cloth.resistance));
    EXPECT_GE(flow, r.low) << r.name;
    EXPECT_LE(flow, r.high) << r.name;
    EXPECT_EQ(model_of(cloth.resistance), PorosityModel::sheet) << r.name;
  }
  const PressureDrop lot = as_sheet(std::get<Fabric>(library_material("pia-c-44378-type-iv-lot")).resistance);
  EXPECT_NEAR(cfm(lot), 0.89, 1e-3);
  const Fabric printed = std::get<Fabric>(library_material("f-111"));
  EXPECT_EQ(as_cells(printed.resistance).darcy, 65.98);
  EXPECT_EQ(model_of(printed.resistance), PorosityModel::paper);
  EXPECT_TRUE(material_warnings(printed, 0.1).empty());
}

// v = 2.06 m/s (dp / 1000 Pa)^0.61, measured on MIL-C-7020 type III.
TEST(Library, OpenClothFollowsTheMeasuredCurveFrom100To1000Pa) {
  const auto law = [](const char* name) {
    return as_sheet(std::get<Fabric>(library_material(name)).resistance);
  };
  const PressureDrop type_iii = law("mil-c-7020-type-iii");
  for (const double pressure : {100.0, 124.5, 200.0, 500.0, 1000.0})
    EXPECT_NEAR(velocity_at(type_iii, pressure) / (2.06 * std::pow(pressure / 1000, 0.61)), 1, 0.024)
        << pressure;
  for (const char* open :
       {"mil-c-7020-type-i", "mil-c-7020-type-ii", "pia-c-44378-type-ii", "pia-c-44378-type-iii"}) {
    EXPECT_NEAR(law(open).quadratic / law(open).linear, type_iii.quadratic / type_iii.linear, 2e-4) << open;
    EXPECT_LT(velocity_at(law(open), 1000) / velocity_at(law(open), 124.5), 5.1) << open;
  }
}

TEST(Library, TheWeftOfTheMeasuredLotBreaksAtItsOwnStrain) {
  const Fabric lot = std::get<Fabric>(library_material("pia-c-44378-type-iv-lot"));
  constexpr double pound_per_inch = pound_force / inch;
  EXPECT_NEAR(SpringLaw({lot.weft_coefficients_n_m, 1}).tension(0.221), 47.0 * pound_per_inch, 1);
  EXPECT_NEAR(SpringLaw({lot.coefficients_n_m, 1}).tension(0.241), 48.5 * pound_per_inch, 1);
}

}  // namespace
}  // namespace ripstop

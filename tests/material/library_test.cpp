#include "ripstop/material/library.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <regex>
#include <sstream>
#include <utility>

#include "ripstop/core/file.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/core/units.h"
#include "ripstop/material/fit_material.h"
#include "ripstop/material/permeability.h"
#include "ripstop/material/spring_law.h"
#include "ripstop/material/strength.h"

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
    if (!line) continue;
    EXPECT_NEAR(SpringLaw({line->coefficients_n, 1}).tension(line->tested_strain) / line->break_load_n, 1,
                0.01)
        << line->name;
  }
}

/// A row of the table of strengths in materials/README.md [N/tex].
struct StrengthRow {
  std::regex names;
  double fibre = 0, low = 0, high = 0;
};

std::vector<StrengthRow> strength_table() {
  std::vector<StrengthRow> rows;
  std::istringstream lines(read_file(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "materials/README.md"));
  const std::regex row(R"(\| ([a-z0-9*., -]+) \| ([\d.]+) \| ([\d.]+)(?: to ([\d.]+))? \|)");
  for (std::string line; std::getline(lines, line);) {
    std::smatch cells;
    if (!std::regex_match(line, cells, row)) continue;
    const std::string stars = std::regex_replace(cells[1].str(), std::regex(R"(\*)"), ".*");
    const std::string names = std::regex_replace(stars, std::regex(", "), "|");
    const double low = std::stod(cells[3]);
    rows.push_back(
        {std::regex(names), std::stod(cells[2]), low, cells[4].matched ? std::stod(cells[4]) : low});
  }
  return rows;
}

// 0.6 of the fibre in a braid, or in the yarns of a weave, is assumed.
TEST(Library, NoMaterialIsStrongerThanItsMassOfFibreAllows) {
  constexpr double most = 0.6, rounding = 1.005;  // of loads to 1 N and masses to three digits
  const std::vector<StrengthRow> table = strength_table();
  EXPECT_EQ(table.size(), 5u);
  for (const Material& material : everything()) {
    const std::string name = name_of(material);
    const std::optional<double> specific = specific_strength(material);
    ASSERT_TRUE(specific) << name;
    EXPECT_TRUE(material_warnings(material, 0).empty()) << name;
    if (name == "nylon-tape") {  // the load at its tested strain
      EXPECT_NEAR(*specific / 1e6, 0.024, 5e-4);
      continue;
    }
    const auto row = std::find_if(table.begin(), table.end(),
                                  [&](const StrengthRow& one) { return std::regex_match(name, one.names); });
    ASSERT_NE(row, table.end()) << name << ": of which fibre?";
    EXPECT_LE(*specific / 1e6, rounding * most * row->fibre) << name;
    EXPECT_GE(*specific / 1e6, row->low - 0.005) << name;
    EXPECT_LE(*specific / 1e6, row->high + 0.005) << name;
  }
}

TEST(Library, AStrengthAboveThatOfTheStrongestFibreIsWarnedOf) {
  Line line = std::get<Line>(library_material("spectra-line"));
  line.name = "cord";
  line.break_load_n = 0.99 * strongest_fibre * line.linear_density_kg_m;
  EXPECT_TRUE(material_warnings(line, 0).empty());
  line.break_load_n = 1.01 * strongest_fibre * line.linear_density_kg_m;
  ASSERT_EQ(material_warnings(line, 0).size(), 1u);
  EXPECT_EQ(material_warnings(line, 0)[0].find("cord: its strength (breaking load) is 4.04 N/tex"), 0u)
      << material_warnings(line, 0)[0];
  // Stiffness times an assumed strain: 9.3 kN of 2 g/m.
  line.break_load_n = 0, line.tested_strain = 0.04;
  ASSERT_EQ(material_warnings(line, 0).size(), 1u);
  EXPECT_EQ(
      material_warnings(line, 0)[0].find("cord: its strength (load at the tested strain) is 4.63 N/tex"), 0u)
      << material_warnings(line, 0)[0];
  Fabric cloth = std::get<Fabric>(library_material("f-111"));
  cloth.break_load_n_m = 1.01 * strongest_fibre * cloth.areal_density_kg_m2 / 2;
  EXPECT_EQ(material_warnings(cloth, 0).size(), 1u);
  Tape tape = std::get<Tape>(library_material("nylon-tape"));
  EXPECT_NEAR(*specific_strength(tape), 0.02 * (3064.2 * 0.3 + 68823.4 * 0.09) / 6e-3, 1);
  tape.break_load_n = 0, tape.tested_strain = 0;
  EXPECT_FALSE(specific_strength(tape));
  EXPECT_TRUE(material_warnings(tape, 0).empty());
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

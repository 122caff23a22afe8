// The permeability of a cloth in a case: three ways to give it, and the old names of its keys.
#include <gtest/gtest.h>

#include "fixture.h"
#include "ripstop/case/assemble.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

/// The short case with a cloth of its own that starts from one of the library.
std::string with_cloth(const std::string& base, const std::string& keys) {
  return replaced(short_case, "gores = 12", "gores = 12\ncanopy_material = \"own\"") +
         "box_m = [8, 8, 12]\n[materials.own]\nbase = \"" + base + "\"\n" + keys;
}

Settings settings_of(const std::string& text) {
  return resolve(parse_case(text, "case.toml"));
}

const ClothResistance& resistance(const Settings& resolved) {
  return resolved.materials().canopy.resistance;
}

TEST(PermeabilityKeys, APressureDropReachesTheSheetOfTheFlow) {
  const Settings resolved = settings_of(with_cloth(
      "f-111-physical", "pressure_drop_linear_pa_s_m = 400\npressure_drop_quadratic_pa_s2_m2 = 50\n"));
  EXPECT_EQ(flow_problem(resolved).bodies.at(0).drop(), (PressureDrop{400, 50}));
}

TEST(PermeabilityKeys, OneKeyKeepsTheOtherOfTheBase) {
  const Settings resolved =
      settings_of(with_cloth("f-111-physical", "pressure_drop_quadratic_pa_s2_m2 = 50\n"));
  EXPECT_EQ(flow_problem(resolved).bodies.at(0).drop(), (PressureDrop{8169.3, 50}));
}

TEST(PermeabilityKeys, CfmIsALinearLawAndIsWrittenOutAsOne) {
  for (const char* base : {"f-111-physical", "f-111"}) {
    const Settings resolved = settings_of(with_cloth(base, "permeability_cfm = 40\n"));
    EXPECT_EQ(resolved.flow().porosity_model, PorosityModel::sheet) << base;
    EXPECT_EQ(flow_problem(resolved).bodies.at(0).drop(), law_of_cfm(40)) << base;
    EXPECT_NEAR(flow_problem(resolved).bodies.at(0).drop().linear, 612.7, 0.1) << base;
    EXPECT_FALSE(resistance(resolved).permeability_cfm) << base;
    EXPECT_FALSE(resistance(resolved).darcy_1_m2) << base;
    const Settings again = settings_of(case_toml(resolved));
    EXPECT_EQ(flow_problem(again).bodies.at(0).drop(), law_of_cfm(40)) << base;
  }
}

TEST(PermeabilityKeys, DarcyAndForchheimerAreForCells) {
  const Settings resolved =
      settings_of(with_cloth("f-111-physical", "darcy_1_m2 = 70\nforchheimer_1_m = 30\n"));
  EXPECT_EQ(resolved.flow().porosity_model, PorosityModel::paper);
  const FlowProblem problem = flow_problem(resolved);
  ASSERT_EQ(problem.bodies.size(), 1u);
  ASSERT_FALSE(problem.bodies[0].is_sheet());
  EXPECT_EQ(problem.bodies[0].porous().darcy, 70);
  EXPECT_EQ(problem.bodies[0].porous().forchheimer, 30);
}

TEST(PermeabilityKeys, TwoWaysInOneMaterialAreRefused) {
  const auto refused = [](const std::string& keys) {
    const Outcome outcome = outcome_of(with_cloth("f-111-physical", keys));
    return outcome.problems.size() == 1 ? outcome.problems[0].key : outcome.message;
  };
  EXPECT_EQ(refused("pressure_drop_linear_pa_s_m = 400\npermeability_cfm = 3\n"),
            "materials.own.permeability_cfm");
  EXPECT_EQ(refused("permeability_cfm = 3\ndarcy_1_m2 = 70\n"), "materials.own.darcy_1_m2");
  EXPECT_EQ(refused("permeability_cfm = 0\n"), "materials.own.permeability_cfm");
  EXPECT_EQ(refused("pressure_drop_linear_pa_s_m = -1\n"), "materials.own.pressure_drop_linear_pa_s_m");
}

TEST(PermeabilityKeys, OfACaseMadeInCodeTwoWaysAreRefusedToo) {
  Case given = parse_case(short_case, "case.toml");
  std::get<Fabric>(given.materials.at("f-111-physical")).resistance.permeability_cfm = 3;
  EXPECT_EQ(validate(given).at(0).key, "materials.f-111-physical.permeability_cfm");
}

/// Everything that is said of old keys, a line each.
std::string told(const Settings& resolved) {
  std::string text;
  for (const std::string& line : resolved.deprecations()) text += line + "\n";
  return text;
}

TEST(OldPermeabilityKeys, TakeTheirMeaningFromTheModelKeyAndAreWarnedOf) {
  const Settings sheet = settings_of(
      with_cloth("f-111-physical", "darcy = 400\nforchheimer = 50\nporosity_model = \"sheet\"\n"));
  EXPECT_EQ(flow_problem(sheet).bodies.at(0).drop(), (PressureDrop{400, 50}));
  EXPECT_EQ(
      told(sheet),
      "materials.own.darcy is a deprecated key: write materials.own.pressure_drop_linear_pa_s_m\n"
      "materials.own.forchheimer is a deprecated key: write materials.own.pressure_drop_quadratic_pa_s2_m2\n"
      "materials.own.porosity_model is an old key and no longer needed, because the keys of the permeability "
      "determine the porosity model; remove it\n");
  const Settings paper =
      settings_of(with_cloth("f-111-physical", "darcy = 70\nforchheimer = 30\nporosity_model = \"paper\"\n"));
  EXPECT_EQ(paper.flow().porosity_model, PorosityModel::paper);
  EXPECT_EQ(flow_problem(paper).bodies.at(0).porous().darcy, 70);
  EXPECT_NE(told(paper).find("write materials.own.darcy_1_m2\n"), std::string::npos) << told(paper);
  EXPECT_NE(told(paper).find("write materials.own.forchheimer_1_m\n"), std::string::npos) << told(paper);
}

TEST(OldPermeabilityKeys, WithoutTheModelKeyAreThoseOfTheBase) {
  EXPECT_EQ(flow_problem(settings_of(with_cloth("f-111", "darcy = 70\n"))).bodies.at(0).porous().darcy, 70);
  EXPECT_EQ(flow_problem(settings_of(with_cloth("f-111", "darcy = 70\n"))).bodies.at(0).porous().forchheimer,
            37.45);
  EXPECT_EQ(flow_problem(settings_of(with_cloth("f-111-physical", "darcy = 70\n"))).bodies.at(0).drop(),
            (PressureDrop{70, 0}));
}

TEST(OldPermeabilityKeys, AModelKeyAloneTakesTheNumbersOfTheBase) {
  const Settings resolved = settings_of(with_cloth("f-111", "porosity_model = \"sheet\"\n"));
  EXPECT_EQ(flow_problem(resolved).bodies.at(0).drop(), (PressureDrop{65.98, 37.45}));
  EXPECT_EQ(resolved.flow().porosity_model, PorosityModel::sheet);
}

TEST(OldPermeabilityKeys, OfTheCommandLineAreTakenAndTheirSourceStaysTheOption) {
  Overrides overrides;
  overrides.set = {parse_setting("materials.f-111-physical.darcy=250", "--set")};
  const Case given = parse_case(short_case, "case.toml", overrides);
  EXPECT_EQ(flow_problem(resolve(given)).bodies.at(0).drop().linear, 250);
  ASSERT_EQ(given.deprecations.size(), 1u);
  EXPECT_EQ(given.origins.at("materials.f-111-physical.pressure_drop_linear_pa_s_m").option, "--set");
}

TEST(OldPermeabilityKeys, BesideTheirNewNameAreUnknown) {
  const Outcome outcome = outcome_of(with_cloth("f-111", "darcy = 70\ndarcy_1_m2 = 60\n"));
  ASSERT_EQ(outcome.problems.size(), 1u) << outcome.message;
  EXPECT_EQ(outcome.problems[0].key, "materials.own.darcy");
}

TEST(OldPermeabilityKeys, NewOnesAreNotWarnedOfAndNoFileOfTheLibraryHasOldOnes) {
  EXPECT_EQ(told(settings_of(with_cloth("f-111", "darcy_1_m2 = 70\n"))), "");
  for (const auto& file :
       std::filesystem::directory_iterator(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "materials")) {
    if (file.path().extension() != ".toml") continue;
    Document document = parse_toml(read_file(file.path()), file.path().string());
    EXPECT_TRUE(rename_old_keys(document.root).empty()) << file.path();
  }
}

TEST(OldPermeabilityKeys, OfAMaterialFileAreRead) {
  const TemporaryFolder folder("old-keys");
  const std::string text = read_file(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "materials/f-111.toml");
  std::string old = replaced(text, "darcy_1_m2 = 65.98", "darcy = 65.98");
  old = replaced(old, "forchheimer_1_m = 37.45", "forchheimer = 37.45\nporosity_model = \"paper\"");
  write_file(folder.path / "old.toml", old);
  const Material material = read_material(folder.path / "old.toml");
  EXPECT_EQ(std::get<Fabric>(material).resistance.darcy_1_m2, 65.98);
  EXPECT_EQ(std::get<Fabric>(material).resistance.forchheimer_1_m, 37.45);
}

}  // namespace
}  // namespace ripstop

#include "ripstop/run/steady/warnings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "ripstop/case/case.h"
#include "ripstop/case/resolve.h"
#include "ripstop/parachute/profile.h"
#include "ripstop/run/descent/recovery.h"
#include "ripstop/run/opening/fastest.h"
#include "ripstop/run/quality.h"

namespace ripstop {
namespace {

Case warned_case() {
  return read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml");
}

TEST(Warnings, ClothBeyondItsTestedStrainIsWarnedOfLinesAreNotByTheCloths) {
  Case given = warned_case();
  Fabric cloth = canopy_fabric(given);
  cloth.tested_strain = 0.2;
  given.materials.insert_or_assign(given.parachute.canopy_material, cloth);
  const std::size_t before = strain_warnings(resolve(given), 0.19).size();
  const std::vector<std::string> beyond = strain_warnings(resolve(given), 0.21);
  ASSERT_EQ(beyond.size(), before + 1);
  int told = 0;
  for (const std::string& warning : beyond)
    told += warning.find(cloth.name + ": the largest strain of a spring, 0.21,") != std::string::npos;
  EXPECT_EQ(told, 1);
  EXPECT_EQ(warnings_of(resolve(given), 0.21).size(), case_warnings(resolve(given)).size() + beyond.size());
}

TEST(Warnings, TheAirIsOutsideItsRangesAtHighSpeedAndOnSmallSlowCanopies) {
  const auto with = [](const char* speed, const char* cloth, std::vector<Setting> more = {}) {
    Overrides overrides;
    overrides.set = std::move(more);
    overrides.set.insert(
        overrides.set.end(),
        {{"flow.speed_m_s", speed}, {"parachute.canopy_material", cloth}, {"flow.porosity_model", "sheet"}});
    return air_warnings(resolve(read_case(
        std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/flat-circular/case.toml", overrides)));
  };
  const auto only = [](const std::vector<std::string>& all, const char* words) {
    ASSERT_EQ(all.size(), 1u) << words;
    EXPECT_NE(all[0].find(words), std::string::npos) << all[0];
  };
  constexpr const char *open = "mil-c-7020-type-iii", *tight = "pia-c-44378-type-iv";
  EXPECT_TRUE(with("50", open).empty());
  only(with("70", open), "dynamic pressure of 2940 Pa is outside the range");
  EXPECT_TRUE(with("70", tight).empty());
  only(with("100", tight, {{"flow.temperature_k", "220"}}), "Mach number of 0.336");
  only(with("1", tight, {{"parachute.nominal_diameter_m", "0.14"}}), "Reynolds number of");
}

// 615 N in place of 400 N were printed without a warning.
TEST(Warnings, CoefficientsOfPorousCellsHoldOnTheCellsOfTheirCalibration) {
  Case given = warned_case();
  EXPECT_TRUE(porosity_warnings(resolve(given)).empty());
  given.flow.cells = {50, 50, 75};
  const std::vector<std::string> coarse = porosity_warnings(resolve(given));
  ASSERT_EQ(coarse.size(), 2u);
  for (const std::string& text : coarse)
    EXPECT_TRUE(std::regex_search(
        text,
        std::regex(
            "of 0\\.0[0-9]+ m is outside the cell sizes for which the porosity coefficients of \\[NFM\\] are "
            "calibrated, 0\\.0[0-9]+ to 0\\.0[0-9]+ m \\(cells of 0\\.02 x 0\\.02 x 0\\.0267 m\\)")))
        << text;
  const std::vector<std::string> all = case_warnings(resolve(given));
  EXPECT_NE(std::find(all.begin(), all.end(), coarse[0]), all.end());
  given.flow.box_m = Vec3{1, 1, 2};  // the same cells again
  EXPECT_TRUE(porosity_warnings(resolve(given)).empty());
  Fabric cloth = canopy_fabric(given);
  cloth.resistance.darcy_1_m2 = 50;
  given.materials.insert_or_assign(given.parachute.canopy_material, cloth);
  const std::vector<std::string> own = porosity_warnings(resolve(given));
  ASSERT_EQ(own.size(), 1u);
  EXPECT_NE(own[0].find("the cells at this canopy are 0.02 x 0.02 x 0.0267 m"), std::string::npos) << own[0];
}

TEST(Warnings, AMeshIsWarnedOfWithFewerNodesThanItsTypeNeeds) {
  Case given = warned_case();
  const int enough = experience(given.parachute).cloth_nodes;
  given.parachute.mesh.cloth_nodes = enough;
  EXPECT_TRUE(mesh_warnings(resolve(given)).empty());
  given.parachute.mesh.cloth_nodes = enough - 1;
  const std::vector<std::string> told = mesh_warnings(resolve(given));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].find(fmt::format("parachute.mesh.cloth_nodes = {}: ", enough - 1)), 0u) << told[0];
  EXPECT_NE(told[0].find(fmt::format("fewer than {} nodes", enough)), std::string::npos) << told[0];
}

TEST(Warnings, AGridIsWarnedOfWhereTheAirsOwnLoadFindsFewerThanTenCellsAcrossTheCanopy) {
  Case given = warned_case();
  given.coupling.load = CanopyLoad::of_flow;
  given.flow.core.size_m = Vec3{0, 0, 0};
  const double across = inflated_diameter(given.parachute), box = resolve(given).flow().box_m.x;
  const auto cells = [&](double wanted) {
    const int n = static_cast<int>(std::ceil(wanted * box / across));
    given.flow.cells = std::array{n, n, n};
    return grid_warnings(resolve(given));
  };
  EXPECT_TRUE(cells(10).empty());
  const std::vector<std::string> told = cells(6);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].find("6.2 flow cells across the inflated canopy: with fewer than 10 "), 0u) << told[0];
  EXPECT_EQ(case_warnings(resolve(given)).size(),
            mesh_warnings(resolve(given)).size() + 1 + porosity_warnings(resolve(given)).size());
  const std::vector<std::string> refused = cells(3);
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_NE(refused[0].find(
                " flow cells across the inflated canopy: the result must not be used (limit 4; fewer than "
                "10 cause a warning); increase flow.cells"),
            std::string::npos)
      << refused[0];
  EXPECT_TRUE(reason_of_refusal(refused[0]).ends_with(" flow cells across the inflated canopy"));
  given.coupling.load = CanopyLoad::uniform;
  EXPECT_TRUE(grid_warnings(resolve(given)).empty());
}

// Ten cells across are enough, whatever the rounding of box and cells; slightly fewer are not printed as ten.
TEST(Warnings, TenCellsAcrossAreEnoughAndFewerAreNotPrintedAsTen) {
  Case given = warned_case();
  given.coupling.load = CanopyLoad::of_flow;
  given.flow.core.size_m = Vec3{0, 0, 0};
  const double across = inflated_diameter(given.parachute);
  const auto with_cells = [&](double cells) {
    const double width = across / cells * 50;
    given.flow.cells = std::array{50, 50, 50}, given.flow.box_m = Vec3{width, width, width};
    return grid_warnings(resolve(given));
  };
  EXPECT_TRUE(with_cells(10 * (1 - 1e-12)).empty());
  const std::vector<std::string> warnings = with_cells(9.97);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].find("9.97 flow cells across the inflated canopy: with fewer than 10 "), 0u)
      << warnings[0];
}

TEST(Warnings, PermeabilityOfAnotherModelIsWarnedOfWithBothWords) {
  Case given = warned_case();
  given.parachute.canopy_material = "f-111";  // for `paper`
  given = checked(given);
  given.flow.porosity_model = PorosityModel::paper;
  EXPECT_TRUE(porosity_warnings(resolve(given)).empty());
  given.flow.porosity_model = PorosityModel::sheet;
  const std::vector<std::string> told = porosity_warnings(resolve(given));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].find("flow.porosity_model = \"sheet\", but the permeability of materials.f-111 is for "
                         "\"paper\""),
            0u)
      << told[0];
}

TEST(Warnings, AnApexThatIsPulledDownIsWarnedOf) {
  Case given = read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/elliptical/case.toml");
  EXPECT_TRUE(shape_warnings(resolve(given)).empty());
  ProfileCanopy canopy = *given.parachute.canopy.as<ProfileCanopy>();
  std::vector<double>& heights = canopy.pieces.back().height_m;
  const double highest = heights.back();
  heights.back() = highest - 0.05;
  given.parachute.canopy = canopy;
  const std::vector<std::string> warnings = shape_warnings(resolve(checked(given)));
  ASSERT_EQ(warnings.size(), 1u);
  const double below = *std::max_element(heights.begin(), heights.end()) - heights.back();
  EXPECT_NE(warnings[0].find(fmt::format("the vent is {:.3g} m below", below)), std::string::npos)
      << warnings[0];
}

// Every command that compares loads with this strength has the warning.
TEST(Warnings, AStrengthAboveThatOfAnyFibreIsWarnedOfByCheckLoadFastestAndRecovery) {
  const auto with = [](double break_load) {
    Case given = read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/flat-circular/case.toml");
    Line cord = suspension_line(given);
    cord.name = given.parachute.lines.material = "cord", cord.break_load_n = break_load;
    given.materials.insert_or_assign(cord.name, cord);
    return resolve(checked(given));
  };
  const auto warned = [](const std::vector<std::string>& all) {
    return std::count_if(all.begin(), all.end(), [](const std::string& text) {
      return text.find("cord: its strength (breaking load) is 4.5 N/tex") != std::string::npos;
    });
  };
  const Settings strong = with(9000), usual = with(3500);
  EXPECT_EQ(warned(case_warnings(strong)), 1);
  EXPECT_EQ(warned(warnings_of(strong, 0)), 1);
  EXPECT_EQ(warned(warnings_of(strong, 0, true)), 1);
  LoadRequest load;
  load.payload_mass = 0.4, load.speed = 20;  // a heavier one has a caution on its opening
  EXPECT_EQ(warned(run_load(strong, load).warnings), 1);
  EXPECT_EQ(warned(run_fastest(strong, load).warnings), 1);
  RecoveryRequest recovery;
  recovery.mass = 2.4, recovery.apogee = 300;
  EXPECT_EQ(warned(run_recovery(strong, {}, recovery).warnings), 1);
  EXPECT_TRUE(case_warnings(usual).empty());
  EXPECT_TRUE(run_load(usual, load).warnings.empty());
}

}  // namespace
}  // namespace ripstop

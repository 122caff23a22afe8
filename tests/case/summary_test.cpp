// The summary of a case.
#include "ripstop/case/summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "ripstop/case/cost.h"
#include "ripstop/parachute/disk_gap_band.h"

namespace ripstop {
namespace {

// Stratos IV on 1.5 million cells with 26,000 nodes took 0.66 GB (sheet, full domain).
TEST(Cost, OfTheRunThatWasMeasuredIsItsMemoryAndHalfAsMuchAtMost) {
  Overrides printed;
  printed.grid = {100, 100, 150};
  const Case given =
      read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml", printed);
  const Cost cost = cost_of(resolve(given));
  EXPECT_EQ(cost.cells, 1.5e6);
  EXPECT_GT(cost.memory, 0.66e9);
  EXPECT_LT(cost.memory, 1.5 * 0.66e9);
  EXPECT_LT(cost.cloth_memory, 0.1 * cost.memory);
}

// log.checkMesh counts 103,562 cells of ripstop steady examples/flat-circular/case.toml --flow openfoam --grid 40 40 50
// --set flow.mesh=fitted --set flow.cloth_levels=2, 283,321 with 60 60 75 and one level.
TEST(Cost, OfAFittedMeshIsThatOfItsCells) {
  const auto cells = [](std::array<int, 3> grid, const char* levels) {
    Overrides fitted;
    fitted.engine = "openfoam";
    fitted.grid = grid;
    fitted.set = {{"flow.mesh", "\"fitted\""}, {"flow.cloth_levels", levels}};
    return cost_of(
               resolve(read_case(
                   std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/flat-circular/case.toml", fitted)))
        .cells;
  };
  EXPECT_NEAR(cells({40, 40, 50}, "2"), 103562, 0.05 * 103562);
  EXPECT_NEAR(cells({60, 60, 75}, "1"), 283321, 0.05 * 283321);
  EXPECT_EQ(cells({40, 40, 50}, "0"), 80000);
}

// time ripstop steady examples/stratos-iv/case.toml --grid 40,40,60 --set coupling.threads=1: 11.6 s of one core.
TEST(Cost, TimeIsAboutThatOfARunThatWasMeasuredAndGrowsWithCellsAndNodes) {
  const auto time = [](int across, const char* nodes) {
    Overrides overrides;
    overrides.grid = {across, across, 3 * across / 2};
    overrides.set = {{"parachute.mesh.cloth_nodes", nodes, "--set"}};
    return cost_of(
               resolve(read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml",
                                 overrides)))
        .time;
  };
  const double measured = time(40, "25600");
  EXPECT_GT(measured, 0.5 * 11.6);
  EXPECT_LT(measured, 2 * 11.6);
  EXPECT_NEAR((time(160, "25600") - measured) / (time(80, "25600") - measured), 63 / 7.0, 1e-9);
  EXPECT_NEAR((time(40, "102400") - measured) / (time(40, "51200") - measured), 3, 1e-9);
  Overrides printed;
  printed.grid = {40, 40, 60};
  EXPECT_EQ(
      summarize(resolve(read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml",
                                  printed)))
          .core_time,
      measured);
}

TEST(Summary, ClothTapeLinesAndRiserAreAllThatHasMass) {
  for (const char* name : {"stratos-iv", "walrus", "adept", "flat-circular", "conical", "hemispherical",
                           "quarter-spherical", "extended-skirt", "ringslot", "cross", "elliptical"}) {
    Overrides coarse;
    coarse.set = {{"parachute.mesh.cloth_nodes", "3000", "--set"},
                  {"parachute.riser.length_m", "0.5", "--set"}};
    const CaseSummary s = summarize(resolve(
        read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples" / name / "case.toml", coarse)));
    for (const double part : {s.mass.cloth, s.mass.tape, s.mass.lines, s.mass.riser})
      EXPECT_GT(part, 0) << name;
    EXPECT_NEAR(s.mass.cloth + s.mass.tape + s.mass.lines + s.mass.riser, s.mass.total, 1e-9 * s.mass.total)
        << name;
  }
}

TEST(Summary, TheGapOfADiskGapBandIsOpenAreaAllRoundTheDisk) {
  const Case given = read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml");
  const auto* canopy = given.parachute.canopy.as<DiskGapBand>();
  ASSERT_TRUE(canopy);
  const CaseSummary s = summarize(resolve(given));
  EXPECT_NEAR(s.slot_area, std::numbers::pi * canopy->disk_diameter_m * canopy->gap_height_m, 1e-12);
  const double open = s.vent_area + s.slot_area;
  EXPECT_NEAR(s.geometric_porosity, open / (open + s.nominal_area), 1e-12);
}

// A line continues across the vent to the opposite one. The gores of 2 pi / 12 are cut flat, with the area of their
// sector: the corners of the vent are farther out than its radius.
TEST(Summary, VentLinesAreLinesAndNotTape) {
  const std::filesystem::path file =
      std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples" / "flat-circular" / "case.toml";
  Overrides plain, without;
  plain.set = {{"parachute.mesh.cloth_nodes", "3000", "--set"}};
  without.set = plain.set;
  without.set.push_back({"parachute.vent_lines", "false", "--set"});
  const Case given = read_case(file, plain);
  const CaseSummary s = summarize(resolve(given)), open = summarize(resolve(read_case(file, without)));
  EXPECT_NEAR(s.mass.tape, open.mass.tape, 1e-12);
  const double half = std::numbers::pi / 12;
  const double vent = 0.1 * std::sqrt(half / (std::sin(half) * std::cos(half)));
  const double cut = vent + 2 * Allowances{}.line_loop;
  EXPECT_NEAR(s.mass.lines - open.mass.lines, 6 * cut * suspension_line(given).linear_density_kg_m, 1e-9);
}

}  // namespace
}  // namespace ripstop

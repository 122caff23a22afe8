// Files written for OpenFOAM and read back, without it.
#include "ripstop/flow/openfoam/case_writer.h"

#include <gtest/gtest.h>

#include <sstream>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/openfoam/state.h"

namespace ripstop::openfoam {
namespace {

namespace fs = std::filesystem;

std::array<int, 3> parts_of(const FlowGrid& grid, int ranks) {
  const TemporaryFolder folder("split");
  for (const char* part : {"system", "constant"}) make_folder(folder.path / part);
  FlowProblem problem;
  problem.grid = grid;
  OpenFoamSettings settings;
  settings.ranks = ranks;
  write_case(folder.path, problem, settings);
  const std::string text = read_file(folder.path / "system/decomposeParDict");
  EXPECT_NE(text.find("numberOfSubdomains " + std::to_string(ranks) + ";"), std::string::npos) << text;
  std::array<int, 3> parts{};
  std::istringstream(text.substr(text.find("n (") + 3)) >> parts[0] >> parts[1] >> parts[2];
  return parts;
}

double area_between(const FlowGrid& g, const std::array<int, 3>& parts) {
  return (parts[0] - 1.0) * g.ny * g.nz + (parts[1] - 1.0) * g.nx * g.nz + (parts[2] - 1.0) * g.nx * g.ny;
}

TEST(WrittenCase, TheBoxHasAPartForEveryRankWithTheLeastAreaBetween) {
  using Parts = std::array<int, 3>;
  EXPECT_EQ(parts_of({{}, {1, 1, 4}, 10, 10, 40}, 4), (Parts{1, 1, 4}));
  EXPECT_EQ(parts_of({{}, {1, 1, 1}, 12, 12, 12}, 4), (Parts{1, 2, 2}));
  EXPECT_EQ(parts_of({{}, {1, 1, 4}, 10, 10, 40}, 6), (Parts{1, 1, 6}));
  EXPECT_EQ(parts_of({{}, {4, 2, 1}, 40, 20, 10}, 6), (Parts{3, 2, 1}));
  EXPECT_EQ(parts_of({{}, {1, 1, 1}, 1, 1, 2}, 2), (Parts{1, 1, 2}));
  for (const FlowGrid& grid : {FlowGrid{{}, {1, 1, 1}, 7, 9, 11}, FlowGrid{{}, {1, 1, 1}, 30, 2, 5}}) {
    for (const int ranks : {1, 2, 3, 4, 6, 8, 12}) {
      const Parts found = parts_of(grid, ranks);
      EXPECT_EQ(found[0] * found[1] * found[2], ranks);
      for (int x = 1; x <= std::min(ranks, grid.nx); ++x) {
        for (int y = 1; y <= std::min(ranks, grid.ny); ++y) {
          const int z = ranks / (x * y);
          if (x * y * z != ranks || z > grid.nz) continue;
          EXPECT_LE(area_between(grid, found), area_between(grid, {x, y, z})) << ranks;
        }
      }
    }
  }
}

TEST(SavedFlow, ComesBackWithTheGridAndTheAirThatItWasSavedFor) {
  const TemporaryFolder folder("state");
  Basis basis;
  basis.grid = {{-1, -2, -3}, {4, 5, 6}, 20, 30, 40};
  for (int axis = 0; axis < 3; ++axis)
    basis.grid.grading[axis] = {0.1 + axis,    0.2 + axis,  3 + 10 * axis,
                                4 + 10 * axis, 1.05 + axis, 1.06 + axis};
  basis.air.velocity = {0, 0, 11}, basis.air.density = 0.9, basis.air.viscosity = 2e-5,
  basis.air.temperature = 250;
  basis.air.turbulence_intensity = 0.03, basis.air.viscosity_ratio = 7;
  basis.sides = Sides::slip;
  basis.ranks = 6;
  basis.second_order = basis.incompressible = true;
  save_state(folder.path / "saved", basis, {folder.path / "case", {}}, "120");
  const SavedState back = read_state(folder.path / "saved");
  EXPECT_EQ(back.time, "120");
  EXPECT_EQ(back.basis.grid, basis.grid);
  EXPECT_TRUE(back.basis == basis);
  EXPECT_EQ(back.basis.air.viscosity_ratio, 7);
  EXPECT_EQ(back.basis.ranks, 6);
  EXPECT_TRUE(back.basis.second_order && back.basis.incompressible && back.basis.sides == Sides::slip);
  const fs::path marker = folder.path / "saved/saved.json";
  const std::string whole = read_file(marker);
  for (const char* time : {"", "12a", "../0", "-1"}) {
    std::string text = whole;
    write_file(marker, text.replace(text.find("\"120\""), 5, "\"" + std::string(time) + "\""));
    EXPECT_THROW(read_state(folder.path / "saved"), Error) << time;
  }
  Basis other = basis;
  other.grid.grading[1].after += 1;
  EXPECT_FALSE(back.basis == other);
}

}  // namespace
}  // namespace ripstop::openfoam

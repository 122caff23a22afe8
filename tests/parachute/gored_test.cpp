// Canopies of gores: halving of columns, connection of strips, refused designs and their reasons.
#include "ripstop/parachute/gored.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <regex>
#include <set>
#include <sstream>

#include "examples.h"
#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/parachute/fold.h"
#include "ripstop/parachute/profile.h"
#include "ripstop/parachute/ring_layout.h"

namespace ripstop {
namespace {

using std::numbers::pi;

Design of_twelve_gores(int nodes) {
  Design design;
  design.gores = design.lines.count = 12;
  design.mesh.cloth_nodes = nodes;
  return design;
}

// A flat disk of 0.5 m with a vent of 0.05 m: columns are halved where they are closer than 0.72 spacings.
TEST(RingLayout, RingsFollowEachOtherWithHalfTheColumnsAndNoneIsThin) {
  const std::vector<Strip> disk = {{0.45, [](double s) { return 2 * pi * (0.5 - s); }, false}};
  const double area = pi * (0.5 * 0.5 - 0.05 * 0.05);
  for (int nodes = 1200; nodes <= 20000; nodes += 400) {
    const RingLayout layout = lay_out_rings(disk, area, of_twelve_gores(nodes));
    EXPECT_NEAR(layout.nodes() / double(nodes), 1, 0.12) << nodes;
    EXPECT_LE(layout.nodes(), nodes) << nodes;
    ASSERT_EQ(layout.strips.size(), 1u);
    const std::vector<Ring>& rings = layout.strips[0];
    double at = 0, thinnest = 1, thickest = 0;
    for (std::size_t i = 0; i < rings.size(); ++i) {
      EXPECT_EQ(rings[i].from, at);
      EXPECT_EQ(rings[i].columns % 12, 0);
      if (i > 0) {
        EXPECT_EQ(2 * rings[i].columns, rings[i - 1].columns);
      }
      EXPECT_GE(rings[i].cells, 2);
      EXPECT_EQ(rings[i].rise(0), 0);
      EXPECT_DOUBLE_EQ(rings[i].rise(rings[i].cells), rings[i].to - rings[i].from);
      const double row = (rings[i].to - rings[i].from) / rings[i].cells;
      thinnest = std::min(thinnest, row), thickest = std::max(thickest, row);
      at = rings[i].to;
    }
    EXPECT_EQ(at, 0.45);
    EXPECT_GT(thinnest, 0.45 * thickest) << nodes;
  }
}

// As many rows as make cells as high as they are wide: ds = circumference / columns.
TEST(RingLayout, OnTheBiasEveryCellIsAsHighAsItIsWide) {
  const std::vector<Strip> disk = {{0.45, [](double s) { return 2 * pi * (0.5 - s); }, false}};
  Design design = of_twelve_gores(4000);
  design.cut = FabricCut::bias;
  const RingLayout layout = lay_out_rings(disk, pi * (0.25 - 0.0025), design);
  for (const Ring& ring : layout.strips[0]) {
    ASSERT_EQ(ring.graded.size(), std::size_t(ring.cells) + 1);
    EXPECT_EQ(ring.graded.front(), 0);
    EXPECT_DOUBLE_EQ(ring.graded.back(), ring.to - ring.from);
    const double first = ring.graded[1] / (2 * pi * (0.5 - ring.from - 0.5 * ring.graded[1]) / ring.columns);
    EXPECT_NEAR(first, 1, 0.5 / ring.cells + 0.02) << ring.from;
    for (int row = 0; row < ring.cells; ++row) {
      const double low = ring.graded[row], high = ring.graded[row + 1];
      const double wide = 2 * pi * (0.5 - ring.from - 0.5 * (low + high)) / ring.columns;
      EXPECT_NEAR((high - low) / wide / first, 1, 2e-3) << ring.from << " " << row;
    }
  }
}

TEST(RingLayout, TooFewNodesForTheSeamsAndLinesAreRefused) {
  Design design = of_twelve_gores(50);
  design.lines.count = 7;
  try {
    lay_out_rings({{0.45, [](double s) { return 2 * pi * (0.5 - s); }, false}}, 0.75, design);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_STREQ(error.what(),
                 "number of cloth nodes = 50: too few for 12 gores and 7 lines, whose seams and radials need "
                 "columns in multiples of 84; use more nodes");
  }
}

/// The elliptical example cut into two pieces that touch.
Case of_two_pieces(bool sewn) {
  Case given = example("elliptical", 2500);
  ProfileCanopy canopy;
  canopy.pieces.resize(2);
  canopy.pieces[0].radius_m = {0.5, 0.4}, canopy.pieces[0].height_m = {0, 0.2};
  canopy.pieces[1].radius_m = {0.4, 0.06}, canopy.pieces[1].height_m = {0.2, 0.3};
  canopy.pieces[1].sewn = sewn;
  given.parachute.canopy = canopy;
  return given;
}

TEST(ProfileCanopies, EdgesOfUnequalFullnessAreNotSewnTogether) {
  const auto problems = [](double below, double above) {
    Case given = of_two_pieces(true);
    ProfileCanopy canopy = *given.parachute.canopy.as<ProfileCanopy>();
    canopy.pieces[0].trailing_fullness = below, canopy.pieces[1].leading_fullness = above;
    given.parachute.canopy = canopy;
    try {
      checked(given);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(problems(0.1, 0.1), "");
  EXPECT_NE(problems(0.1, 0.2).find("parachute.pieces[1].sewn = true: edges of unequal fullness"),
            std::string::npos)
      << problems(0.1, 0.2);
}

/// Nodes around one edge that are tied to, or shared with, the other piece.
int held_nodes(const CanopyMesh& mesh) {
  const auto piece = [&](const char* name, bool last) {
    const Patch* found = nullptr;
    for (const Patch& patch : mesh.patches)
      if (patch.name == name && (!found || last)) found = &patch;
    return found;
  };
  const Patch *below = piece("piece 1", true), *above = piece("piece 2", false);
  if (!below || !above) return -1;
  std::set<int> lower, upper;
  for (int c = 0; c < below->columns; ++c) lower.insert(below->node(below->rows - 1, c));
  for (int c = 0; c < above->columns; ++c) upper.insert(above->node(0, c));
  int held = 0;
  for (const Tie& tie : mesh.ties) {
    const bool from_below = lower.contains(tie.node), from_above = upper.contains(tie.node);
    if (!from_below && !from_above) continue;
    held += std::all_of(tie.masters.begin(), tie.masters.end(), [&](const Tie::Master& master) {
      return (from_below ? upper : lower).contains(master.node);
    });
  }
  return held;
}

TEST(ProfileCanopies, APieceThatIsSewnIsHeldAlongItsWholeEdgeElseAtSeamsAndLines) {
  const CanopyMesh sewn = parachute_mesh(resolve(of_two_pieces(true))),
                   held = parachute_mesh(resolve(of_two_pieces(false)));
  const auto columns = [](const CanopyMesh& mesh) {
    int most = 0;
    for (const Patch& patch : mesh.patches)
      if (patch.name == "piece 1") most = patch.columns;  // of the last ring
    return most;
  };
  EXPECT_EQ(held_nodes(sewn), columns(sewn));
  const Design design = of_two_pieces(false).parachute;
  std::set<double> radials;
  for (int k = 0; k < design.gores; ++k) radials.insert(std::round(360e6 * k / design.gores));
  for (int k = 0; k < design.lines.count; ++k) radials.insert(std::round(360e6 * k / design.lines.count));
  EXPECT_EQ(held_nodes(held), static_cast<int>(radials.size()));
  EXPECT_LT(held_nodes(held), columns(held));
}

TEST(ProfileCanopies, ThePatternsStripsAreTheFlatGoresOfItsMeridian) {
  ProfileCanopy canopy = *of_two_pieces(true).parachute.canopy.as<ProfileCanopy>();
  canopy.pieces[1].leading_fullness = 0.1, canopy.pieces[1].trailing_fullness = 0.3;
  canopy.pieces[1].sewn = false;
  canopy.pieces[1].height_m = {0.25, 0.35};
  const int gores = 8;
  const GorePattern pattern = gore_pattern(canopy, gores);
  ASSERT_EQ(pattern.strips.size(), 2u);
  const double apothem = pi / gores / std::tan(pi / gores);
  const double lower = std::hypot(apothem * 0.1, 0.2), upper = std::hypot(apothem * 0.34, 0.1);
  const auto chord = [&](double radius) { return 2 * pi * radius / gores; };
  const GoreStrip &one = pattern.strips[0], &two = pattern.strips[1];
  EXPECT_EQ(one.name, "piece 1");
  EXPECT_EQ(two.name, "piece 2");
  EXPECT_DOUBLE_EQ(one.length(), lower);
  EXPECT_DOUBLE_EQ(two.length(), upper);
  EXPECT_DOUBLE_EQ(one.width(0), chord(0.5));
  EXPECT_DOUBLE_EQ(one.width(lower), chord(0.4));
  EXPECT_DOUBLE_EQ(two.chord(upper), chord(0.06));
  EXPECT_DOUBLE_EQ(two.width(0), 1.1 * chord(0.4));
  EXPECT_DOUBLE_EQ(two.width(upper), 1.3 * chord(0.06));
  EXPECT_EQ(one.slot, 0);
  EXPECT_NEAR(two.slot, 0.05, 1e-12);
  EXPECT_FALSE(one.joined || two.joined || one.whole);
  EXPECT_TRUE(two.whole);  // its fullness needs one number of columns
  const double trapezoids = gores * (lower * 0.5 * (chord(0.5) + chord(0.4)) + 0.05 * chord(0.4) +
                                     upper * 0.5 * (chord(0.4) + chord(0.06)));
  const double vent = gores * 0.25 * chord(0.06) * chord(0.06) / std::tan(pi / gores);
  EXPECT_NEAR(pattern.nominal_area, trapezoids + vent, 1e-12);
}

// Its middle tilts outward about the upper edge.
TEST(ProfileCanopies, AGoreThatBulgesMoreBelowThanAboveIsAsHighInItsMiddleAsOnThePattern) {
  Case given = of_two_pieces(false);
  ProfileCanopy canopy = *given.parachute.canopy.as<ProfileCanopy>();
  canopy.pieces[1].leading_fullness = 0.1, canopy.pieces[1].trailing_fullness = 0.05;
  canopy.pieces[1].height_m = {0.25, 0.45};
  given.parachute.canopy = canopy;
  const CanopyMesh mesh = parachute_mesh(resolve(given));
  const Patch& patch = mesh.patches.back();
  const double gore = 2 * pi / given.parachute.gores;
  const double height = gore_pattern(canopy, given.parachute.gores).strips[1].length();
  int middles = 0;
  for (int column = 0; column < patch.columns; ++column) {
    const Vec3 low = mesh.start[patch.node(0, column)], high = mesh.start[patch.node(patch.rows - 1, column)];
    const double turns = std::atan2(low.y, low.x) / gore;
    if (std::abs(turns - std::floor(turns) - 0.5) > 1e-6) continue;
    EXPECT_NEAR(norm(high - low), height, 1e-9) << column;
    ++middles;
  }
  EXPECT_EQ(middles, given.parachute.gores);
}

TEST(FoldsWithoutStrain, DisksCylindersAndConesDoAndAGoreThatBulgesDoesNot) {
  for (const char* name : {"stratos-iv", "walrus"})
    EXPECT_TRUE(folds_without_strain(parachute_mesh(resolve(example(name, 4000))))) << name;
  for (const char* name : {"flat-circular", "adept", "cross", "hemispherical"})
    EXPECT_FALSE(folds_without_strain(parachute_mesh(resolve(example(name, 4000))))) << name;
}

/// The last column of the guide's table of meshes.
TEST(FamilyExperience, HasTheNodesThatTheGuideMeasured) {
  std::istringstream guide(read_file(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "docs/guide/canopies.md"));
  const std::regex row(R"(\| `([a-z-]+)` \|.*\| ([0-9,]+)( \(.*\))? \|)");
  int rows = 0;
  for (std::string line; std::getline(guide, line);) {
    std::smatch found;
    if (!std::regex_match(line, found, row)) continue;
    std::string nodes = found[2];
    std::erase(nodes, ',');
    EXPECT_EQ(experience(example(found[1]).parachute).cloth_nodes, std::stoi(nodes)) << line;
    ++rows;
  }
  EXPECT_GE(rows, static_cast<int>(family_examples().size()));
}

// Knacke, NWC TP 6575, Tables 5-1 and 5-2: drag in descent and C_x at infinite mass.
TEST(FamilyExperience, IsTheHandbooks) {
  const struct {
    const char* example;
    double low, high, opening;
  } printed[] = {{"flat-circular", 0.75, 0.80, 1.7}, {"conical", 0.75, 0.90, 1.8},
                 {"hemispherical", 0.62, 0.77, 1.6}, {"extended-skirt", 0.78, 0.87, 1.4},
                 {"cross", 0.60, 0.85, 1.15},        {"ringslot", 0.56, 0.65, 1.05},
                 {"stratos-iv", 0.52, 0.58, 1.3},    {"quarter-spherical", 0, 0, 1.6},
                 {"elliptical", 0, 0, 1.8}};
  for (const auto& row : printed) {
    const Experience known = experience(example(row.example).parachute);
    EXPECT_EQ(known.drag_coefficient.low, row.low) << row.example;
    EXPECT_EQ(known.drag_coefficient.high, row.high) << row.example;
    EXPECT_EQ(known.opening_coefficient, row.opening) << row.example;
    EXPECT_GE(known.projected_ratio.high, known.projected_ratio.low) << row.example;
    EXPECT_NE(std::string(known.opening_source), "") << row.example;
  }
}

}  // namespace
}  // namespace ripstop

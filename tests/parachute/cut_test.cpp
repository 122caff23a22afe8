// The cut pieces are those of the mesh: pieces and lengths of the pattern against the mesh and each other.
#include "ripstop/parachute/cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "examples.h"
#include "ripstop/case/assemble.h"
#include "ripstop/case/case.h"
#include "ripstop/parachute/piece_edges.h"

namespace ripstop {
namespace {

class CutTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, CutTest, testing::ValuesIn(family_examples()), name_of_example);

TEST_P(CutTest, ThePiecesMakeUpTheCloth) {
  const Case given = example(GetParam());
  double area = 0;
  for (const Piece& piece : cut_pattern(given.parachute).pieces) {
    EXPECT_EQ(piece.outline.size(), piece.edges.size());
    EXPECT_GT(polygon_area(piece.outline), 0);
    area += piece.count * piece_area(piece);
  }
  EXPECT_NEAR(area / computed_area(given.parachute), 1, 1e-3);
}

TEST_P(CutTest, AllowancesLieOutsideByTheirWidth) {
  const Case given = example(GetParam());
  for (const Piece& piece : cut_pattern(given.parachute).pieces) {
    const Allowances allowances{.seam = 0.002, .hem = 0.003};
    const std::vector<Point2> cut = with_allowance(piece, allowances);
    double strip = 0;
    for (std::size_t i = 0; i < piece.outline.size(); ++i) {
      const Point2 a = piece.outline[i], b = piece.outline[(i + 1) % piece.outline.size()];
      const double width = piece.edges[i] == Edge::seam ? allowances.seam : allowances.hem;
      strip += std::hypot(b.x - a.x, b.y - a.y) * width;
    }
    const double added = polygon_area(cut) - polygon_area(piece.outline);
    // Beyond the strips along the edges only the corners count, of the order of the width squared each.
    EXPECT_NEAR(added, strip, 4 * 6 * 0.003 * 0.003) << piece.name;
    const std::vector<Point2> none = with_allowance(piece, {.seam = 0, .hem = 0});
    EXPECT_NEAR(polygon_area(none), polygon_area(piece.outline), 1e-12);
  }
}

TEST_P(CutTest, TapesAndLinesAreAsLongAsInTheMesh) {
  const Case given = example(GetParam());
  const CanopyMesh mesh = parachute_mesh(resolve(given));
  double tape_mesh = 0, line_mesh = 0;
  for (const int spring : mesh.rigging.tape_springs) tape_mesh += mesh.springs[spring].rest_length;
  for (const LineRun& line : mesh.rigging.lines)
    for (const int spring : line.springs) line_mesh += mesh.springs[spring].rest_length;
  for (const int spring : mesh.rigging.vent_line_springs) line_mesh += mesh.springs[spring].rest_length;
  const CutPattern pattern = cut_pattern(given.parachute);
  double tape = 0;
  for (const CutLength& part : pattern.tapes) tape += part.count * part.length;
  // Tapes along arcs are chords in the mesh; vertical tapes are a little shorter than a gore's seam.
  EXPECT_NEAR(tape_mesh / tape, 1, 0.02);
  const LineSet& lines = given.parachute.lines;
  double line = lines.count * (lines.length_m + pattern.line_on_canopy);
  for (const CutLength& part : pattern.lines) line += part.count * part.length;
  EXPECT_NEAR(line_mesh / line, 1, 1e-3);
}

TEST_P(CutTest, TheBillWithoutAllowancesHasTheMassOfTheMesh) {
  const Case given = example(GetParam());
  const Bill bill = bill_of(cut_pattern(given.parachute), given.parachute, resolve(given).materials(),
                            {.seam = 0, .hem = 0, .line_loop = 0, .tape_overlap = 0}, 400);
  const CanopyMesh mesh = parachute_mesh(resolve(given));
  const double mass = std::accumulate(mesh.mass.begin(), mesh.mass.end(), 0.0);
  EXPECT_NEAR(bill.mass / mass, 1, 0.005);
  EXPECT_NEAR(bill.packed_volume * 400, bill.mass, 1e-12);
  const Bill cut =
      bill_of(cut_pattern(given.parachute), given.parachute, resolve(given).materials(), {}, 400);
  EXPECT_GT(cut.mass, bill.mass);
}

TEST(CutPattern, ThePiecesGrainIsThatOfTheCut) {
  Case given = example("adept");
  for (const auto& [cut, grain] : {std::pair{FabricCut::block, 0.0}, std::pair{FabricCut::across, 90.0},
                                   std::pair{FabricCut::bias, 45.0}}) {
    given.parachute.cut = cut;
    for (const Piece& piece : cut_pattern(given.parachute).pieces) EXPECT_EQ(piece.grain, grain);
  }
}

TEST(CutPattern, AFlatCircularGoreIsATrapezoidWithTheAngleOfItsGore) {
  const Case given = example("flat-circular");
  const CutPattern pattern = cut_pattern(given.parachute);
  ASSERT_EQ(pattern.pieces.size(), 1u);
  ASSERT_EQ(pattern.pieces[0].outline.size(), 4u);
  const Point2 lower = pattern.pieces[0].outline[1], upper = pattern.pieces[0].outline[2];
  EXPECT_NEAR((lower.x - upper.x) / (upper.y - lower.y), std::tan(std::numbers::pi / 12), 1e-12);
}

TEST(CutPattern, HemsAreSkirtAndVentAroundAllGores) {
  const Case given = example("flat-circular");
  const CutPattern pattern = cut_pattern(given.parachute);
  const std::vector<CutLength> hems = hems_of(pattern);
  ASSERT_EQ(hems.size(), 2u);
  const Piece& gore = pattern.pieces[0];
  EXPECT_EQ(hems[0].name, "skirt");
  EXPECT_NEAR(hems[0].length, gore.count * 2 * gore.outline[1].x, 1e-12);
  EXPECT_EQ(hems[1].name, "vent");
  EXPECT_NEAR(hems[1].length, gore.count * 2 * gore.outline[2].x, 1e-12);
  for (const CutLength& tape : pattern.tapes)  // along both hems, where there is tape
    for (const CutLength& hem : hems) {
      if (tape.name == hem.name) {
        EXPECT_NEAR(tape.length, hem.length, 1e-12);
      }
    }
}

TEST(CutPattern, TheCutLengthOfOnePieceHasItsOwnAllowance) {
  const Settings given = resolve(example("annular"));
  const Allowances extra{.line_loop = 0.2, .tape_overlap = 0.1};
  int lengths = 0;
  for (const BillRow& row :
       bill_of(cut_pattern(given.parachute()), given.parachute(), given.materials(), extra, 400).rows) {
    if (row.is_cloth) continue;
    EXPECT_NEAR(row.cut_each(), row.finished / row.count + (row.kind == BillPart::tape ? 0.1 : 0.4), 1e-12)
        << row.part;
    ++lengths;
  }
  EXPECT_GE(lengths, 3) << "suspension lines, apex lines, tape";
}

// A line at every seam, or more of them equally spaced along the lowest edge.
TEST(CutPattern, MarksTheLinesAndNamesTheEdgesOfEveryFamily) {
  for (const CanopyFamily* family : families()) {
    const Case given =
        read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples" / family->example / "case.toml");
    const CutPattern cut = cut_pattern(given.parachute);
    int marks = 0;
    for (const Piece& piece : cut.pieces) {
      EXPECT_EQ(piece.edge_names.size(), piece.edges.size()) << family->example << " " << piece.name;
      marks += static_cast<int>(piece.marks.size());
      for (const EdgeRun& run : edge_runs(piece)) EXPECT_NE(run.name, "") << family->example;
    }
    EXPECT_GT(marks, 1) << family->example;
  }
}

TEST(CutPattern, NotchesOfASeamLieAlikeOnBothSidesOfAGore) {
  const Case given = read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/conical/case.toml");
  const Piece gore = cut_pattern(given.parachute).pieces.front();
  const auto all = notches(gore, {});
  ASSERT_GE(all.size(), 2u);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [from, to] = all[i];
    const auto& [other_from, other_to] = all[all.size() - 1 - i];
    EXPECT_NEAR(from.x, -other_from.x, 1e-9);
    EXPECT_NEAR(to.y, other_to.y, 1e-9);
  }
}

}  // namespace
}  // namespace ripstop

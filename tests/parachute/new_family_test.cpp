// A canopy family that the program has not, added by CONTRIBUTING.md's list and nothing else: its keys, the
// functions that take them, its record, a row in the list.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "../blown_up.h"
#include "../printed_materials.h"
#include "ripstop/canopy/shape.h"
#include "ripstop/cloth/cloth.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/toml/read.h"
#include "ripstop/core/toml/write.h"
#include "ripstop/fsi/opening_estimate.h"
#include "ripstop/output/pattern_files.h"
#include "ripstop/parachute/flat_circular.h"
#include "ripstop/parachute/gored.h"

namespace ripstop {

/// [parachute] with type = "biconical": a steep cone below a shallow one.
struct Biconical {
  static const CanopyFamily family;

  double skirt_diameter_m = 0;
  double break_diameter_m = 0;  // where the cones meet
  double vent_diameter_m = 0;
  bool vent_lines = true;

  static constexpr double steep = 50 * std::numbers::pi / 180, shallow = 20 * std::numbers::pi / 180;
};

void describe(Fields& fields, Biconical& canopy) {
  fields.number("skirt_diameter_m", canopy.skirt_diameter_m, from(0.01).up_to(100), "Of the skirt.")
      .required();
  fields.number("break_diameter_m", canopy.break_diameter_m, above(0).up_to(100), "Where the cones meet.")
      .required();
  describe_vent(fields, canopy.vent_diameter_m, canopy.vent_lines);
}

void check_shape(const Biconical& canopy, const Design& design, Findings& findings) {
  check_vent(canopy.vent_diameter_m, canopy.break_diameter_m, canopy.vent_lines, design, findings);
}

Experience experience(const Biconical&) {
  return {.projected_ratio = {0.6, 0.9},
          .drag_coefficient = {0.7, 0.9},
          .opening_coefficient = 1.5,
          .opening_source = "made up for this test",
          .cloth_nodes = 3000};
}

GorePattern gore_pattern(const Biconical& canopy, int gores) {
  const double skirt = canopy.skirt_diameter_m / 2, middle = canopy.break_diameter_m / 2;
  const double lower = (skirt - middle) / std::cos(Biconical::steep);
  const double upper = (middle - canopy.vent_diameter_m / 2) / std::cos(Biconical::shallow);
  const double area =
      std::numbers::pi * ((skirt + middle) * lower + middle * middle / std::cos(Biconical::shallow));
  GorePattern pattern{gores, area, {}, canopy.vent_lines};
  pattern.strips = {
      strip_on(
          "lower cone", [&](double s) { return skirt - s * std::cos(Biconical::steep); }, 0, lower, gores),
      strip_on(
          "upper cone", [&](double s) { return middle - s * std::cos(Biconical::shallow); }, 0, upper,
          gores)};
  pattern.strips[0].whole = true;
  pattern.strips[1].joined = true;
  return pattern;
}

constinit const CanopyFamily Biconical::family = family_of<Biconical>("biconical", "biconical");

namespace {

using std::numbers::pi;

const char* const text = R"([parachute]
type = "biconical"
skirt_diameter_m = 1.0
break_diameter_m = 0.8
vent_diameter_m = 0.1
gores = 12
[parachute.lines]
count = 12
length_m = 1.2
[parachute.mesh]
cloth_nodes = 3000
)";

/// The program's list and one more row.
struct Parachute {
  Design design;
};
void describe(Fields& fields, Parachute& parachute) {
  Families list = families();
  list.push_back(&Biconical::family);
  describe(fields, parachute.design, list);
}

struct CaseFile {
  Parachute parachute;
};
void describe(Fields& fields, CaseFile& file) {
  fields.table("parachute", file.parachute, "The parachute.").required();
}

Fields fields_of(CaseFile& file) {
  Fields fields;
  describe(fields, file);
  return fields;
}

/// As a case is read and checked.
std::vector<Problem> read(const std::string& toml, CaseFile& file) {
  Origins origins;
  std::vector<Problem> problems;
  read_table(fields_of(file), parse_toml(toml, "case.toml"), origins, problems);
  check_values(fields_of(file), origins, problems);
  Findings findings(origins, problems);
  check_design(file.parachute.design, findings);
  return problems;
}

Design biconical() {
  CaseFile file;
  const std::vector<Problem> problems = read(text, file);
  for (const Problem& problem : problems) ADD_FAILURE() << to_text(problem);
  return file.parachute.design;
}

std::string with(const std::string& from, const std::string& to) {
  std::string toml = text;
  return toml.replace(toml.find(from), from.size(), to);
}

TEST(NewFamily, IsReadCheckedAndWrittenAsTheOthersAre) {
  const Design design = biconical();
  ASSERT_NE(design.canopy.as<Biconical>(), nullptr);
  EXPECT_EQ(design.canopy.as<Biconical>()->break_diameter_m, 0.8);
  EXPECT_EQ(design.canopy.as<FlatCircular>(), nullptr);

  CaseFile again, file{{design}};
  EXPECT_TRUE(read(to_toml(fields_of(file)), again).empty());
  EXPECT_EQ(to_json(fields_of(again)), to_json(fields_of(file)));

  CaseFile scratch;
  EXPECT_NE(json_schema(fields_of(scratch), "case").find("\"break_diameter_m\""), std::string::npos);
  EXPECT_NE(reference_tables(fields_of(scratch)).find("With `type = \"biconical\"`"), std::string::npos);
}

TEST(NewFamily, MistakesInItsKeysAreReportedWithTheirPlace) {
  const auto mistake = [](const std::string& toml) {
    CaseFile file;
    const std::vector<Problem> problems = read(toml, file);
    return problems.size() == 1 ? to_text(problems[0]) : std::to_string(problems.size()) + " problems";
  };
  EXPECT_EQ(
      mistake(with("vent_diameter_m = 0.1", "vent_diameter_m = 0.9")),
      "case.toml:5:19: parachute.vent_diameter_m = 0.9: the vent must be smaller than the canopy, 0.8 m "
      "across");
  EXPECT_NE(mistake(with("break_diameter_m", "brake_diameter_m")).find("2 problems"), std::string::npos);
  EXPECT_NE(mistake(with("biconical", "biconic")).find("did you mean \"biconical\"?"), std::string::npos);
}

TEST(NewFamily, OutsideOfTheListItCannotBeWritten) {
  Design design = biconical();
  Fields fields;
  describe(fields, design);
  EXPECT_THROW(to_toml(fields), Error);
}

// Frusta of cones: the sum of the radii times pi times the slant length.
TEST(NewFamily, HasTheClothOfItsConesInPatternMeshAndDrawing) {
  const Design design = biconical();
  const double cloth =
      pi * (0.9 * 0.1 / std::cos(Biconical::steep) + 0.45 * 0.35 / std::cos(Biconical::shallow));
  EXPECT_NEAR(computed_area(design), cloth, 1e-9);
  const CanopyMesh mesh = build_mesh(design, printed_materials());
  double meshed = 0;
  for (const Patch& patch : mesh.patches)
    meshed = std::accumulate(patch.cell_area.begin(), patch.cell_area.end(), meshed);
  EXPECT_NEAR(meshed / cloth, 1, 1e-3);

  const CutPattern pattern = cut_pattern(design);
  ASSERT_EQ(pattern.pieces.size(), 2u);
  double cut = 0;
  for (const Piece& piece : pattern.pieces) cut += piece.count * polygon_area(piece.outline);
  EXPECT_NEAR(cut / cloth, 1, 1e-6);
  const TemporaryFolder folder("new-family");
  write_pattern_svg(folder.path / "lower.svg", pattern.pieces[0], {});
  EXPECT_NE(read_text_file(folder.path / "lower.svg").find("lower cone"), std::string::npos);
}

TEST(NewFamily, IsOpenUnderPressure) {
  const Design design = biconical();
  const CanopyMesh mesh = build_mesh(design, printed_materials());
  const BlownUp canopy = blown_up(mesh, 240, 2e-3);
  EXPECT_NEAR(canopy.held_share(), 1, 0.01);
  const double nominal = std::sqrt(4 / std::numbers::pi * nominal_area(design));
  const double ratio = canopy_size(mesh, canopy.positions()).projected_diameter / nominal;
  EXPECT_GT(ratio, experience(design).projected_ratio.low);
  EXPECT_LT(ratio, experience(design).projected_ratio.high);
  EXPECT_NEAR(opening_estimate(design, 2000, 500).load.value(), 3000, 1e-9);
}

}  // namespace
}  // namespace ripstop

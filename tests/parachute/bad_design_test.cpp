// Designs that cannot be built are refused with the key and the reason.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "ripstop/case/case.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

struct BadDesign {
  const char* name;
  const char* example;
  const char* from;  // in the example's case file
  const char* to;
  const char* key;
  const char* reason;
};

const BadDesign bad_designs[] = {
    {"FullnessUnderZero", "adept", "sails = 9", "sails = 3\nrows = [{leading_fullness = -0.1}, {}, {}]",
     "parachute.rows[0].leading_fullness", "at least 0"},
    {"SailSlotWiderThanTheRow", "adept", "sails = 9", "sails = 3\nrows = [{}, {slot_deg = 25}, {}]",
     "parachute.rows[1].slot_deg",
     "the slot above row 2 is wider than the row, for which slots and vent leave 10.5 degrees of arc"},
    {"FirstSailSlotWiderThanItsRow", "adept", "sails = 9", "sails = 3\nrows = [{slot_deg = 30}, {}, {}]",
     "parachute.rows[0].slot_deg",
     "the slot above row 1 is wider than the row, for which slots and vent leave 8.85 degrees of arc"},
    {"SlotAboveTheLastRow", "adept", "sails = 9", "sails = 3\nrows = [{}, {}, {slot_deg = 2}]",
     "parachute.rows[2].slot_deg", "the vent is above the last row"},
    {"RowsThatAreNotAsManyAsSails", "adept", "sails = 9", "sails = 9\nrows = [{}, {}, {}]", "parachute.sails",
     "there are 3 tables [[parachute.rows]]; one is required for every sail of a gore"},
    {"RingSlotWiderThanTheRings", "ringslot", "slot_height_m = 0.013", "slot_height_m = 0.045",
     "parachute.slot_height_m", "the slots are wider than the rings, which are 0.0375 m high"},
    {"LinesShorterThanTheRadius", "flat-circular", "length_m = 1.0", "length_m = 0.5",
     "parachute.lines.length_m", "too short to meet on the axis"},
    {"TwoGores", "conical", "gores = 12", "gores = 2", "parachute.gores", "at least 3"},
    {"ArmsLongerThanTheLinesCanSpan", "cross", "length_m = 1.2", "length_m = 0.6", "parachute.lines.length_m",
     "too short to meet on the axis"},
    {"RingsailsVentWiderThanItsSkirt", "adept", "vent_diameter_m = 0.06", "vent_diameter_m = 6",
     "parachute.vent_diameter_m", "the vent must be smaller than the canopy, 0.866025 m across"},
    {"CrossWithoutArms", "cross", "arm_width_m = 0.396", "arm_width_m = 1.2", "parachute.arm_width_m",
     "must be longer than wide"},
    {"CrossWithSixArms", "cross", "gores = 4", "gores = 6", "parachute.gores", "four arms"},
    {"LinesThatTheArmsCannotShare", "cross", "count = 16", "count = 18", "parachute.lines.count",
     "every arm of a cross has the same number"},
    {"VentWiderThanTheCanopy", "hemispherical", "vent_diameter_m = 0.08", "vent_diameter_m = 0.75",
     "parachute.vent_diameter_m", "the vent must be smaller than the canopy, 0.707107 m across"},
    {"CrossWithoutInnerHems", "cross", "material = \"nylon-tape\"", "inner_hems = false",
     "parachute.tape.inner_hems", "only canopies made of gores"},
    {"NoVent", "flat-circular", "vent_diameter_m = 0.1", "vent_diameter_m = 0", "parachute.vent_diameter_m",
     "above 0"},
    {"VentSmallerThanACell", "hemispherical", "vent_diameter_m = 0.08", "vent_diameter_m = 0.004",
     "parachute.vent_diameter_m",
     "smaller than a cell of the mesh, 0.00991 m with parachute.mesh.cloth_nodes = 8000; make it larger, or "
     "use at least 49085 nodes"},
    {"ProfileWithAVentSmallerThanACell", "elliptical", "0.054]", "0.002]", "parachute.pieces[0].radius_m[60]",
     "smaller than a cell of the mesh"},
    {"VentLinesOfAnOddNumberOfLines", "quarter-spherical", "count = 12", "count = 9", "parachute.lines.count",
     "set parachute.vent_lines = false"},
    {"SkirtDrawnInByMoreThanItsHeight", "extended-skirt", "skirt_height_m = 0.086",
     "skirt_height_m = 0.086\nskirt_diameter_share = 0.5", "parachute.skirt_height_m",
     "the radius of the extension decreases by 0.215 m, more than its height"},
    {"ProfileWithMoreRadiiThanHeights", "elliptical", "radius_m = [", "radius_m = [0.46, ",
     "parachute.pieces[0].height_m",
     "there are 62 radii and 61 heights; every point of the meridian requires both"},
    {"ProfileWithAWaist", "elliptical", "0.054]", "0.2]", "parachute.pieces[0].radius_m[60]",
     "a waist is not supported"},
    {"ProfileSewnToNothing", "elliptical", "radius_m = [", "sewn = true\nradius_m = [",
     "parachute.pieces[0].sewn", "there is no piece below"},
    {"MoreLineNodesThanThereMayBe", "flat-circular",
     "length_m = 1.0\n\n# What the tables of docs/ have of this example was computed with this tape; without "
     "the key "
     "it follows from the load.\n[parachute.tape]\nmaterial = \"nylon-tape\"\n\n[parachute.mesh]",
     "length_m = 500\n\n[parachute.mesh]\nline_segment_m = 0.001", "parachute.mesh.line_segment_m",
     "6000 m of lines and riser would have 6e+06 nodes, more than 2e+06; make it at least 0.003 m"},
    {"LinesPastTheVent", "conical", "length_m = 1.0", "length_m = 1.0\nonto_disk_m = 0.6",
     "parachute.lines.onto_disk_m", "beyond the edge of the vent"},
};

class BadDesignTest : public testing::TestWithParam<BadDesign> {};
INSTANTIATE_TEST_SUITE_P(Every, BadDesignTest, testing::ValuesIn(bad_designs),
                         [](const auto& design) { return design.param.name; });

TEST_P(BadDesignTest, IsRefusedWithKeyAndReason) {
  const BadDesign& bad = GetParam();
  const std::filesystem::path file =
      std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples" / bad.example / "case.toml";
  std::string text = read_file(file);
  ASSERT_NO_THROW(parse_case(text, "case.toml"));
  const std::size_t place = text.find(bad.from);
  ASSERT_NE(place, std::string::npos);
  text.replace(place, std::string(bad.from).size(), bad.to);
  try {
    parse_case(text, "case.toml");
    FAIL() << "was accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    bool found = false;
    for (const Problem& problem : error.problems())
      found |=
          problem.key == bad.key && (problem.message + problem.allowed).find(bad.reason) != std::string::npos;
    EXPECT_TRUE(found) << error.what();
  }
}

// What stands under a key is what the key holds: half the diameter, and half a cell as the least.
TEST(BadDesign, AVentOfAProfileIsToldAsTheRadiusThatItIs) {
  std::string text = read_file(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/elliptical/case.toml");
  text.replace(text.find("0.054]"), 6, "0.002]");
  std::string value, allowed;
  try {
    parse_case(text, "case.toml");
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 1u);
    value = error.problems().front().value, allowed = error.problems().front().allowed;
  }
  EXPECT_EQ(value, "0.002");
  ASSERT_EQ(allowed.rfind("at least ", 0), 0u) << allowed;
  const std::string least = allowed.substr(9);
  const std::size_t place = text.find("0.002]");
  EXPECT_THROW(parse_case(text.replace(place, 5, std::to_string(0.98 * std::stod(least))), "case.toml"),
               InputError);
  const std::size_t end = text.find(']', place);
  EXPECT_NO_THROW(
      parse_case(text.replace(place, end - place, std::to_string(1.02 * std::stod(least))), "case.toml"));
}

}  // namespace
}  // namespace ripstop

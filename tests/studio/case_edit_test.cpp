#include "ripstop/studio/case_edit.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

const std::string hand_written =
    "# My canopy\n"
    "title = \"Größe\"   # kept\n"
    "\n"
    "[parachute]\n"
    "gores = 12  # as many as lines\n"
    "  nominal_diameter_m = 1.0\n"
    "\n"
    "# Lines of the last flight.\n"
    "[parachute.lines]\n"
    "length_m = \"40 in\" # with loops\n"
    "count = 12\n"
    "\n"
    "[flow]\n"
    "box_m = [\n"
    "  2, # across\n"
    "  2, 4]\n"
    "core = {start_m = 1.0, size_m = [1, 1, 1]}\n";

TEST(CaseEdit, ReplacesAValueAndKeepsEveryOtherByte) {
  std::string expected = hand_written;
  expected.replace(expected.find("12  #"), 2, "16");
  EXPECT_EQ(with_key(hand_written, "parachute.gores", "16"), expected);
}

TEST(CaseEdit, ReplacesTextsListsAndMembersOfInlineTables) {
  EXPECT_EQ(written_values(with_key(hand_written, "title", "\"#\\\"x\"")).at("title"), "\"#\\\"x\"");
  const std::string box = with_key(hand_written, "flow.box_m", "[3,3,5]");
  EXPECT_NE(box.find("box_m = [3,3,5]\ncore"), std::string::npos);
  const std::string core = with_key(hand_written, "flow.core.start_m", "0.5");
  EXPECT_NE(core.find("core = {start_m = 0.5, size_m = [1, 1, 1]}"), std::string::npos);
  const std::string inside = with_key(hand_written, "flow.core.growth", "1.1");
  EXPECT_EQ(written_values(inside).at("flow.core.growth"), "1.1");
}

TEST(CaseEdit, AddsAKeyBehindTheLastOneOfItsTable) {
  const std::string cut = with_key(hand_written, "parachute.cut", "\"bias\"");
  EXPECT_NE(cut.find("  nominal_diameter_m = 1.0\ncut = \"bias\"\n\n# Lines of"), std::string::npos);
  const std::string material = with_key(hand_written, "parachute.lines.material", "\"nylon\"");
  EXPECT_NE(material.find("count = 12\nmaterial = \"nylon\"\n\n[flow]"), std::string::npos);
}

TEST(CaseEdit, AddsATableAtTheEndAndAKeyOfTheRootBeforeTheFirstTable) {
  EXPECT_TRUE(with_key(hand_written, "payload.mass_kg", "2.4").ends_with("\n[payload]\nmass_kg = 2.4\n"));
  EXPECT_EQ(with_key("[flow]\nspeed_m_s = 20", "title", "\"a\""),
            "title = \"a\"\n\n[flow]\nspeed_m_s = 20\n");
  EXPECT_EQ(with_key("", "flow.speed_m_s", "20"), "[flow]\nspeed_m_s = 20\n");
}

TEST(CaseEdit, RemovesTheLinesOfAKeyWithTheirComment) {
  const std::string shorter = without_key(hand_written, "flow.box_m");
  EXPECT_NE(shorter.find("[flow]\ncore"), std::string::npos);
  EXPECT_EQ(without_key(with_key(hand_written, "payload.mass_kg", "2.4"), "payload.mass_kg"),
            hand_written + "\n[payload]\n");
}

const std::string with_tables =
    "title = \"a\"\n"
    "\n"
    "# The rocket.\n"
    "[body.rocket]\n"
    "shape = \"sphere\" # nearly\n"
    "diameter_m = 0.1\n"
    "\n"
    "[[measured]]\n"
    "speed_m_s = 10\n"
    "\n"
    "# The second run.\n"
    "[[measured]]\n"
    "speed_m_s = 20\n";

TEST(CaseEdit, AddsAndRemovesNamedTables) {
  const std::string more = with_key(with_tables, "body.tail.shape", "\"box\"");
  EXPECT_EQ(more, with_tables + "\n[body.tail]\nshape = \"box\"\n");
  EXPECT_EQ(without_key(more, "body.tail"), with_tables);
  const std::string less = without_key(with_tables, "body.rocket");
  EXPECT_EQ(less.find("rocket]"), std::string::npos);
  EXPECT_NE(less.find("# The rocket.\n\n[[measured]]"), std::string::npos);
  EXPECT_THROW(without_key(with_tables, "body.tail"), Error);
  EXPECT_THROW(without_key("hardware = {a = {strands = 2}}\n", "hardware.a"), Error);
}

TEST(CaseEdit, ChangesAddsAndRemovesMembersOfListsOfTables) {
  const std::string changed = with_key(with_tables, "measured[1].drag_n", "5");
  EXPECT_EQ(changed, with_tables + "drag_n = 5\n");
  EXPECT_NE(
      with_key(with_tables, "measured[0].drag_n", "5").find("speed_m_s = 10\ndrag_n = 5\n\n# The second"),
      std::string::npos);
  const std::string more = with_key(with_tables, "measured[2].speed_m_s", "30");
  EXPECT_EQ(more, with_tables + "\n[[measured]]\nspeed_m_s = 30\n");
  EXPECT_EQ(without_key(more, "measured[2]"), with_tables);
  const auto rest = written_values(without_key(changed, "measured[0]"));
  EXPECT_EQ(rest.at("measured[0].speed_m_s"), "20");
  EXPECT_EQ(rest.at("measured[0].drag_n"), "5");
  EXPECT_THROW(with_key(with_tables, "measured[7].speed_m_s", "30"), Error);
  EXPECT_THROW(without_key(with_tables, "measured[2]"), Error);
}

TEST(CaseEdit, RefusesAChangeOfOtherValues) {
  EXPECT_THROW(without_key(hand_written, "flow.core.start_m"), Error);  // shares its line
  EXPECT_THROW(without_key(hand_written, "flow.speed_m_s"), Error);
  EXPECT_THROW(with_key(hand_written, "parachute.gores", "1\nvent_lines = false"), Error);
  EXPECT_THROW(with_key(hand_written, "parachute.gores", "1 # \"\n[flow"), Error);
  EXPECT_THROW(with_key(hand_written, "parachute", "3"), Error);
  EXPECT_THROW(with_key("a = \"\n", "b", "1"), Error);
}

TEST(CaseEdit, KeepsLineBreaksOfWindowsAndDottedKeys) {
  EXPECT_EQ(with_key("[flow]\r\nspeed_m_s = 20 \r\n", "flow.speed_m_s", "25"),
            "[flow]\r\nspeed_m_s = 25 \r\n");
  EXPECT_EQ(with_key("flow.speed_m_s = 20\n", "flow.speed_m_s", "25"), "flow.speed_m_s = 25\n");
}

TEST(CaseEdit, WritesEveryValueOfEveryExampleBackUnchanged) {
  for (const auto& entry : std::filesystem::directory_iterator(RIPSTOP_SOURCE_DIR "/examples")) {
    if (!std::filesystem::exists(entry.path() / "case.toml")) continue;
    const std::string text = read_file(entry.path() / "case.toml");
    const auto values = written_values(text);
    EXPECT_GT(values.size(), 8U) << entry.path();
    for (const auto& [key, literal] : values)
      EXPECT_EQ(with_key(text, key, literal), text) << entry.path() << key;
  }
}

}  // namespace
}  // namespace ripstop

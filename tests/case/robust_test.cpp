// Any bytes of a case file are a valid case or a reported mistake.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "fixture.h"
#include "ripstop/case/assemble.h"
#include "ripstop/core/file.h"
#include "ripstop/parachute/disk_gap_band.h"

namespace ripstop {
namespace {

std::string example_text() {
  return read_file(examples / "stratos-iv" / "case.toml");
}

std::vector<std::string> all_example_texts() {
  std::set<std::filesystem::path> files;
  for (const auto& folder : std::filesystem::directory_iterator(examples))
    if (exists(folder.path() / "case.toml")) files.insert(folder.path() / "case.toml");
  std::vector<std::string> texts;
  for (const auto& file : files) texts.push_back(read_file(file));
  return texts;
}

/// True when the text is a valid case. A mistake must be an InputError with a message; a valid case must remain equal
/// when it is written and read again.
bool is_valid_or_told(const std::string& text) {
  try {
    const Case given = parse_case(text, "case.toml");
    const Air wind = air(given);
    EXPECT_TRUE(wind.speed > 0 && wind.density > 0);
    const std::string written = case_toml(resolve(given));
    EXPECT_EQ(case_toml(resolve(parse_case(written, "written"))), written);
    return true;
  } catch (const InputError& error) {
    EXPECT_FALSE(error.problems().empty());
    for (const Problem& problem : error.problems()) EXPECT_FALSE(problem.message.empty());
    return false;
  }
}

TEST(AnyBytes, EveryExampleIsValidAndSurvivesBeingWrittenAndRead) {
  const std::vector<std::string> texts = all_example_texts();
  ASSERT_GE(texts.size(), 2u);
  for (const std::string& text : texts) EXPECT_TRUE(is_valid_or_told(text)) << text;
}

TEST(AnyBytes, ATruncatedFileIsRefusedOrValid) {
  const std::string text = example_text();
  ASSERT_TRUE(is_valid_or_told(text));
  int valid = 0;
  for (std::size_t length = 0; length < text.size(); ++length)
    valid += is_valid_or_told(text.substr(0, length));
  // The row for the chosen speed is the last of the measured ones: only a cut in or after it can pass.
  EXPECT_GT(valid, 0);
  EXPECT_LT(valid, static_cast<int>(text.size() - text.rfind("[[measured]]")));
}

TEST(AnyBytes, AFlippedByteIsRefusedOrValid) {
  const std::vector<std::string> texts = all_example_texts();
  std::mt19937 random(20240607);
  int valid = 0, told = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string spoilt = texts[i % texts.size()];
    const int flips = 1 + i % 3;
    for (int k = 0; k < flips; ++k)
      spoilt[random() % spoilt.size()] ^= static_cast<char>(1u << (random() % 8));
    (is_valid_or_told(spoilt) ? valid : told)++;
  }
  // Both happen: a flip in a comment or a digit mostly leaves a case, one in a key or a bracket does not.
  EXPECT_GT(valid, 40);
  EXPECT_GT(told, 400);
}

TEST(AnyBytes, ReplacedDigitsAreRefusedOrValid) {
  const std::vector<std::string> texts = all_example_texts();
  const std::string pieces[] = {
      "-",    "0",  "9", "e", ".", "\"", "[", "]", "nan", "inf", "1e308", "-1e-308", "99999999999999999999",
      "true", "\n", "#"};
  std::mt19937 random(7);
  for (int i = 0; i < 4000; ++i) {
    std::string spoilt = texts[i % texts.size()];
    spoilt.replace(random() % spoilt.size(), 1 + random() % 2, pieces[random() % std::size(pieces)]);
    is_valid_or_told(spoilt);
  }
}

TEST(AnyBytes, DeepNestingIsRefusedWithoutExhaustingTheStack) {
  const auto repeated = [](const std::string& piece, int n) {
    std::string text;
    for (int i = 0; i < n; ++i) text += piece;
    return text;
  };
  for (const std::string& text :
       {repeated("[", 200000), repeated("a.", 500000) + "a = 1", "x = " + repeated("[", 3900),
        "x = " + repeated("{a=", 1000), repeated("a.", 1900) + "a = 1",
        repeated("[a", 1) + repeated(".a", 1900) + "]\n" + repeated("b.", 1900) + "b = 1",
        "x = " + repeated("[\n", 100000), std::string(2 << 20, '\n')})
    EXPECT_FALSE(is_valid_or_told(text));
}

TEST(AnyBytes, ControlCharactersNeverReachTheMessage) {
  const Outcome outcome =
      outcome_of(replaced(valid_case, "gores = 6", "\"\\u001b[31mgores\" = \"\\u001b[0m\""));
  ASSERT_FALSE(outcome.valid);
  EXPECT_EQ(outcome.message.find('\x1b'), std::string::npos);
}

TEST(AnyDesign, EveryAcceptedParachuteCanBeMeshed) {
  std::mt19937 random(42);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto integer = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  int accepted = 0, told = 0;
  for (int i = 0; i < 80; ++i) {
    Case given = parse_case(valid_case, "case.toml");
    Design& design = given.parachute;
    design.canopy =
        DiskGapBand{between(0.2, 1.9), between(0.005, 0.5), between(0.001, 0.3), between(0.01, 0.5)};
    design.gores = integer(3, 24);
    design.lines.count = integer(3, 36);
    design.lines.length_m = between(0.3, 4);
    design.lines.onto_disk_m = between(0, 0.4);
    design.mesh.cloth_nodes = integer(500, 6000);
    design.riser.length_m = i % 2 ? 0 : between(0.1, 2);
    try {
      given = parse_case(case_toml(resolve(given)), "random");
    } catch (const InputError&) {
      ++told;
      continue;
    }
    ++accepted;
    const CanopyMesh mesh = parachute_mesh(resolve(given));
    double cloth = 0;
    for (const Patch& patch : mesh.patches)
      for (double area : patch.cell_area) cloth += area;
    EXPECT_NEAR(cloth, computed_area(given.parachute), 0.05 * cloth) << case_toml(resolve(given));
    for (const Spring& spring : mesh.springs) ASSERT_GT(spring.rest_length, 0) << case_toml(resolve(given));
    for (double mass : mesh.mass) ASSERT_GT(mass, 0) << case_toml(resolve(given));
  }
  EXPECT_GT(accepted, 20);
  EXPECT_GT(told, 10);
}

}  // namespace
}  // namespace ripstop

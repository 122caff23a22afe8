// Designs of openchute: converted parts are cut as in openchute, and no part of the file is ignored silently.
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <set>

#include "../refusal.h"
#include "ripstop/case/assemble.h"
#include "ripstop/case/case.h"
#include "ripstop/case/chute_import.h"
#include "ripstop/core/file.h"
#include "ripstop/parachute/conical.h"
#include "ripstop/parachute/cross.h"
#include "ripstop/parachute/disk_gap_band.h"
#include "ripstop/parachute/flat_circular.h"
#include "ripstop/parachute/profile.h"

namespace ripstop {
namespace {

constexpr double pi = std::numbers::pi;
const std::filesystem::path source = RIPSTOP_SOURCE_DIR;

std::string chute_text(const std::string& name) {
  return read_file(name == "elliptical" ? source / "examples/elliptical/elliptical.chute"
                                        : source / "tests/case/chute" / (name + ".chute"));
}
ImportedCase imported(const std::string& name, const ChuteImportOptions& options = {}) {
  return import_chute(read_chute(chute_text(name), name), options, name);
}
bool says(const std::vector<std::string>& list, const std::string& words) {
  return std::any_of(list.begin(), list.end(),
                     [&](const std::string& s) { return s.find(words) != std::string::npos; });
}

// Half a gore is pi r / N wide at radius r; its height is that of the polygon's flat sides.
TEST(Chute, AGoreHasTheOutlineThatOpenchuteCuts) {
  const Case given = parse_case(imported("elliptical").case_text, "case.toml");
  const GorePattern pattern = gore_pattern(*given.parachute.canopy.as<ProfileCanopy>(), 10);
  ASSERT_EQ(pattern.strips.size(), 1u);
  const std::vector<Station>& stations = pattern.strips[0].stations;
  const int n = static_cast<int>(stations.size()) - 1;
  double height = 0, r0 = 0, y0 = 0;
  for (int i = 0; i <= n; ++i) {
    const double angle = (pi / 2 - std::asin(0.12)) * i / n;
    const double r = 0.45 * std::cos(angle), y = 0.315 * std::sin(angle);
    const double corner = r * pi / (10 * std::sin(pi / 10)), corner0 = r0 * pi / (10 * std::sin(pi / 10));
    if (i > 0) height += std::hypot((corner - corner0) * std::cos(pi / 10), y - y0);
    EXPECT_NEAR(stations[i].width / 2, corner * std::sin(pi / 10), 1e-8);
    EXPECT_NEAR(stations[i].height, height, 1e-8);
    r0 = r, y0 = y;
  }
  EXPECT_NEAR(r0, 0.45 * 0.12, 1e-12);
}

// But for the tape and the tolerance that the example names.
TEST(Chute, TheShippedCaseIsTheOutputOfTheImport) {
  std::string shipped = read_file(source / "examples/elliptical/case.toml");
  const std::size_t named = shipped.find("# What the tables"), mesh = shipped.find("[parachute.mesh]");
  ASSERT_LT(named, mesh);
  shipped.erase(named, mesh - named);
  const std::size_t coupling = shipped.find("\n[coupling]");
  ASSERT_NE(coupling, std::string::npos);
  shipped.erase(coupling);
  EXPECT_EQ(shipped,
            import_chute(read_chute(chute_text("elliptical"), "x"), {}, "elliptical.chute").case_text);
}

TEST(Chute, DiskAndBandBecomeADiskGapBandOfTheSameSizes) {
  const ImportedCase result = imported("disk-gap-band");
  const Case given = parse_case(result.case_text, "case.toml");
  const auto& canopy = *given.parachute.canopy.as<DiskGapBand>();
  EXPECT_NEAR(canopy.disk_diameter_m, 1.2, 1e-9);
  EXPECT_NEAR(canopy.vent_diameter_m, 0.108, 1e-9);
  EXPECT_NEAR(canopy.gap_height_m, 0.06, 1e-9);
  EXPECT_NEAR(canopy.band_height_m, 0.3, 1e-9);
  EXPECT_EQ(given.parachute.gores, 12);
  EXPECT_NEAR(canopy_fabric(given).areal_density_kg_m2, 0.038, 1e-12);
}

TEST(Chute, TwoGoresOfACylinderAreTheStripsOfACross) {
  const ImportedCase result = imported("cross");
  const Case given = parse_case(result.case_text, "case.toml");
  EXPECT_NEAR(given.parachute.canopy.as<Cross>()->arm_length_m, 1.2, 1e-8);
  EXPECT_NEAR(given.parachute.canopy.as<Cross>()->arm_width_m, 0.4, 1e-8);
  EXPECT_TRUE(says(result.changed, "gores = 4"));
}

TEST(Chute, OneConeBecomesAConicalCanopyOfTheSameArea) {
  std::string text = chute_text("disk-gap-band");
  const std::size_t second = text.find("\"section_type\"", text.find("\"section_type\"") + 5);
  text = text.substr(0, text.rfind(",", second)) + "]}";
  const Case flat = parse_case(import_chute(read_chute(text, "x"), {}, "x").case_text, "case.toml");
  ASSERT_TRUE(flat.parachute.canopy.as<FlatCircular>());
  EXPECT_NEAR(computed_area(flat.parachute), pi * (0.36 - 0.054 * 0.054), 1e-8);
  EXPECT_TRUE(says(import_chute(read_chute(text, "x"), {}, "x").mapped, "flat disk of 1.2 m"));
  const std::size_t inner = text.find("\"0\"", text.find("\"expressions\""));
  text.replace(inner, 3, "\"0.3\"");
  const ImportedCase result = import_chute(read_chute(text, "x"), {}, "x");
  const Case cone = parse_case(result.case_text, "case.toml");
  ASSERT_TRUE(cone.parachute.canopy.as<Conical>());
  EXPECT_NEAR(computed_area(cone.parachute), pi * 0.654 * std::hypot(0.3, 0.546), 1e-8);
  EXPECT_TRUE(says(result.changed, "the file contains 0, its formula gives 0.3"));
  // A metre higher it is the same cone.
  text.replace(inner, 5, "\"1.3\"");
  text.replace(text.find("\"0\"", inner), 3, "\"1\"");
  const Case higher = parse_case(import_chute(read_chute(text, "x"), {}, "x").case_text, "case.toml");
  ASSERT_TRUE(higher.parachute.canopy.as<Conical>());
  EXPECT_NEAR(computed_area(higher.parachute), computed_area(cone.parachute), 1e-8);
}

TEST(Chute, SailsKeepTheirFullnessAndSlots) {
  const ImportedCase result = imported("sails");
  const Case given = parse_case(result.case_text, "case.toml");
  const auto& canopy = *given.parachute.canopy.as<ProfileCanopy>();
  ASSERT_EQ(canopy.pieces.size(), 3u);
  EXPECT_EQ(canopy.pieces[1].leading_fullness, 0.08);
  for (const ProfilePiece& piece : canopy.pieces) EXPECT_FALSE(piece.sewn);
  const GorePattern pattern = gore_pattern(canopy, 12);
  EXPECT_EQ(pattern.strips[1].slot, 0);
  // The chord of 2.5 degrees on a sphere of 0.8 m, drawn in a little by the polygon.
  EXPECT_NEAR(pattern.strips[2].slot / (2 * 0.8 * std::sin(pi / 144)), 1, 0.02);
  EXPECT_NEAR(pattern.strips[1].stations.front().width / pattern.strips[1].stations.front().chord, 1.08,
              1e-12);
}

TEST(Chute, NothingOfTheFileIsSilentlyLeftOut) {
  const ImportedCase result = imported("odd");
  for (const char* words : {"ripples", "SlantAngle", "cuts: 1", "\"Heavy nylon\", 67", "seam-allowance 0.01",
                            "diameter: ignored, because openchute and Ripstop use the values of each section",
                            "global_seam_allowance", "colours"})
    EXPECT_TRUE(says(result.not_mapped, words)) << words;
  for (const char* words : {"1 / 3 of integers is 0", "0.135 m below the highest point", "end in a point"})
    EXPECT_TRUE(says(result.changed, words)) << words;
  for (const char* words : {"9 lines", "--line-length", "values of F-111", "sewn to it", "flow:"})
    EXPECT_TRUE(says(result.assumed, words)) << words;
  const Case given = parse_case(result.case_text, "case.toml");
  EXPECT_EQ(given.title, "Odd \"one\"\\x07");
  EXPECT_NE(result.case_text.find("# Instruction: One step"), std::string::npos);
  // From the drawn-in skirt up, though the file has it second and downward.
  const auto& canopy = *given.parachute.canopy.as<ProfileCanopy>();
  EXPECT_NEAR(canopy.pieces[0].radius_m.front(), 0.2 + 0.3 * std::cos(0.5), 1e-8);
  EXPECT_NEAR(canopy.pieces[1].radius_m.back(), 0.02, 1e-8);
  EXPECT_FALSE(canopy.vent_lines);
}

/// Of every object of the file that is not openchute's own copy of a shape, the place.
void places_of(const nlohmann::json& node, const std::string& at, std::vector<std::string>& places) {
  if (!node.is_structured()) return;
  if (node.is_object()) places.push_back(at);
  for (const auto& [key, value] : node.items()) {
    if (key == "ellipse" || key == "line" || key == "geo" || key == "fabric" || key == "colors" ||
        key == "fullness" || key == "range" || key.rfind("modifier", 0) == 0 || key == "cuts")
      continue;
    places_of(value, at + "/" + key, places);
  }
}

TEST(Chute, AnUnknownKeyIsReportedAtAnyPlace) {
  std::set<std::string> kinds;
  for (const char* name : {"elliptical", "odd", "cross", "sails"}) {
    const nlohmann::json sound = nlohmann::json::parse(chute_text(name));
    std::vector<std::string> places;
    places_of(sound, "", places);
    for (const std::string& place : places) {
      nlohmann::json file = sound;
      file[nlohmann::json::json_pointer(place + "/surplus")] = 1;
      const ChuteFile read = read_chute(file.dump(), "x");
      EXPECT_TRUE(says(read.not_mapped, "surplus: unknown key, ignored")) << name << place;
      const std::string kind = place.substr(place.rfind('/') + 1);
      kinds.insert(std::isdigit(static_cast<unsigned char>(kind[0])) ? "" : kind);
    }
  }
  EXPECT_EQ(kinds,
            (std::set<std::string>{"", "Circular", "EllipseArc", "Line", "Polygonal", "section_type"}));
}

/// `text` with the first `from` replaced.
std::string with_first(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(Chute, AnArcHasAsManyPointsFromWhereverItsAnglesCount) {
  const auto points_of_first_piece = [](const std::string& text) {
    const ImportedCase result = import_chute(read_chute(text, "odd"), {}, "odd");
    const Case given = parse_case(result.case_text, "case.toml");
    std::size_t most = 0;
    for (const ProfilePiece& piece : given.parachute.canopy.as<ProfileCanopy>()->pieces)
      most = std::max(most, piece.radius_m.size());
    return most;
  };
  const std::string quarter = chute_text("odd");
  std::string turned = with_first(quarter, "\"start_angle\": \"0\"", "\"start_angle\": \"pi\"");
  turned = with_first(turned, "\"stop_angle\": \"pi/2\"", "\"stop_angle\": \"3*pi/2\"");
  turned = with_first(turned, "\"rotation\": \"0.0\"", "\"rotation\": \"pi\"");
  EXPECT_NE(turned, quarter);
  EXPECT_GT(points_of_first_piece(quarter), 50u);
  EXPECT_EQ(points_of_first_piece(turned), points_of_first_piece(quarter));
}

TEST(Chute, RoundPiecesAreCutAsTheGoresOfTheOthersWhicheverComesFirst) {
  using Json = nlohmann::json;
  for (const std::size_t round : {0, 1}) {
    Json mixed = Json::parse(chute_text("disk-gap-band"));
    Json& sections = mixed["chute_sections"];
    sections[round]["gores"] = 8, sections[1 - round]["gores"] = 9;
    const Json line = sections[1 - round]["section_type"]["Circular"];
    sections[1 - round]["section_type"] = {{"Polygonal", {{"objects", {{{"Line", line}}}}}}};
    const ImportedCase result = import_chute(read_chute(mixed.dump(), "mixed"), {}, "mixed");
    EXPECT_TRUE(says(result.changed, "gores = 8: cut as 9 gores, like the other pieces")) << round;
    EXPECT_EQ(parse_case(result.case_text, "case.toml").parachute.gores, 9) << round;
  }
}

TEST(Chute, TheMeshHasTheClothOfThePattern) {
  for (const char* name : {"elliptical", "disk-gap-band", "cross", "sails", "odd"}) {
    Case given = parse_case(imported(name).case_text, "case.toml");
    const CanopyMesh mesh = parachute_mesh(resolve(given));
    double area = 0;
    for (const Patch& patch : mesh.patches)
      area = std::accumulate(patch.cell_area.begin(), patch.cell_area.end(), area);
    EXPECT_NEAR(area / computed_area(given.parachute), 1, 1e-3) << name;
  }
}

TEST(Chute, GivenValuesReplaceAssumedOnes) {
  const ImportedCase result = imported("odd", {.line_count = 18, .line_length = 2.5, .vent_diameter = 0.1});
  const Case given = parse_case(result.case_text, "case.toml");
  EXPECT_EQ(given.parachute.lines.count, 18);
  EXPECT_EQ(given.parachute.lines.length_m, 2.5);
  EXPECT_TRUE(given.parachute.canopy.as<ProfileCanopy>()->vent_lines);
  EXPECT_NEAR(given.parachute.canopy.as<ProfileCanopy>()->pieces[1].radius_m.back(), 0.05, 1e-8);
  EXPECT_FALSE(says(result.assumed, "lines of"));
}

struct BadChute {
  const char* name;
  const char* file;
  const char* from;
  const char* to;
  const char* message;
};
const BadChute bad_chutes[] = {
    {"UnknownName", "elliptical", "flatness*radius", "flatnes*radius",
     "parameter_values[1].expression: \"flatnes*radius\", character 1: unknown name \"flatnes\"; did you "
     "mean "
     "\"flatness\"?"},
    {"Circle", "elliptical", "diameter/2", "diameter/2+0*height", "radius -> height -> radius"},
    {"Itself", "elliptical", "diameter/2", "radius/2", "\"radius\" refers to itself"},
    {"DefinedBelow", "elliptical", "diameter/2", "diameter/2+0*vent_angle",
     "defined only below, in parameter_values[2]"},
    {"DivisionByZero", "elliptical", "diameter/2", "diameter/(2-2)", "character 9: division by zero"},
    {"NoValue", "elliptical", "math::asin(vent_share)", "math::asin(vent_share*10)", "has no finite value"},
    {"NameTwice", "elliptical", "\"id\": \"height\"", "\"id\": \"radius\"", "is used twice"},
    {"NameOfAUnit", "elliptical", "\"id\": \"diameter\"", "\"id\": \"mm\"", "is used twice"},
    {"NoName", "elliptical", "\"id\": \"diameter\"", "\"id\": \"2d\"", "is not a valid name"},
    {"MissingKey", "elliptical", "\"radius_x\": \"radius\"", "\"radius_z\": \"radius\"",
     "EllipseArc: the key \"radius_x\" is missing"},
    {"NoNumber", "elliptical", "\"value\": 0.9", "\"value\": \"0.9\"",
     "input_values[0].value: must be a number"},
    {"NoStoredNumber", "cross", "0.3819718634205488,", "\"wide\",",
     "Circular.line.begin[0]: must be a number"},
    {"UnknownShape", "elliptical", "\"EllipseArc\"", "\"Spline\"",
     "objects[0]: must be \"Line\", \"EllipseArc\" or \"PointList\""},
    {"TwoGores", "elliptical", "\"gores\": 10", "\"gores\": 2", "Ripstop needs at least 3"},
    {"OnlySlots", "elliptical", "\"gores\": 10", "\"gores\": 0",
     "no section with gores; the design needs at least one"},
    {"HalfAGore", "elliptical", "\"gores\": 10", "\"gores\": 9.5", "whole number"},
    {"AcrossTheAxis", "elliptical", "\"0.5*pi-vent_angle\"", "\"0.7*pi\"", "the meridian crosses the axis"},
    {"NoLength", "elliptical", "\"0.5*pi-vent_angle\"", "\"0\"", "the arc has no length"},
    {"GoresThatDiffer", "sails", "\"gores\": 12", "\"gores\": 11", "the seams of all pieces"},
    {"FullnessUnderZero", "sails", "0.08", "-0.08", "must be at least 0"},
    {"NotJson", "sails", "{", "[", "not JSON"},
    {"WideCross", "cross", "\"value\": 3.0", "\"value\": 0.5", "wider than long"},
};

class ChuteMistake : public testing::TestWithParam<BadChute> {};
INSTANTIATE_TEST_SUITE_P(Every, ChuteMistake, testing::ValuesIn(bad_chutes),
                         [](const auto& mistake) { return mistake.param.name; });

TEST_P(ChuteMistake, IsReportedWithFileAndPlace) {
  const BadChute& mistake = GetParam();
  std::string text = chute_text(mistake.file);
  const bool last = std::string(mistake.name) == "GoresThatDiffer";  // the first is that of the whole file
  const std::size_t place = last ? text.rfind(mistake.from) : text.find(mistake.from);
  ASSERT_NE(place, std::string::npos);
  text.replace(place, std::string(mistake.from).size(), mistake.to);
  try {
    import_chute(read_chute(text, "design.chute"), {}, "design.chute");
    FAIL() << "was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_EQ(std::string(error.what()).rfind("design.chute: ", 0), 0u) << error.what();
    EXPECT_NE(std::string(error.what()).find(mistake.message), std::string::npos) << error.what();
  }
}

TEST(Chute, APointListIsReadLineByLine) {
  std::string text = chute_text("odd");
  const std::size_t begin = text.find("{", text.find("\"objects\": [") + 12);
  const std::size_t end = text.find("]", text.find("\"expressions\"", begin));
  const std::size_t close = text.find("}", text.find("}", end) + 1);
  const auto with = [&](const std::string& points) {
    return text.substr(0, begin) + R"({"PointList": {"geo": {"points": []}, "point_list": ")" + points +
           R"(", "scale_x": "2", "scale_y": "0.5", "offset": ["0.1", "0"], "scale_x_f": 2.0, "scale_y_f": 0.5,
              "offset_f": [0.1, 0.0]})" +
           text.substr(close);
  };
  const ChuteFile file = read_chute(with(R"(0.2,0\n 0.1 , 0.5\n\n-0.04,1)"), "x");
  ASSERT_EQ(file.sections[0].points.size(), 3u);
  EXPECT_NEAR(file.sections[0].points[2].r, 0.02, 1e-12);
  EXPECT_NEAR(file.sections[0].points[1].y, 0.25, 1e-12);
  const std::string message =
      refusal_of([&] { read_chute(with(R"(0.2,0\n\n0.1;1)"), "x"); }, ExitCode::bad_data);
  EXPECT_NE(message.find("line 3: \"0.1;1\" is not a point x,y"), std::string::npos) << message;
}

// openchute's own ringsail draws its slots as sections of 0 gores.
TEST(Chute, ANumberThatDiffersFromItsFormulaIsReportedAtAnyPlace) {
  const std::string text = chute_text("odd");
  const std::string stored[] = {"\"start_angle\": 0.0", "\"radius_x\": 0.3", "\"radius_y\": 0.35",
                                "\"center\": [\n          0.2", ",\n          0.0\n         ]"};
  for (const std::string& number : stored) {
    std::string other = text;
    const std::size_t at = other.find(number, other.find("\"ellipse\""));
    ASSERT_NE(at, std::string::npos) << number;
    const std::size_t digits = number.find("0.") + at;
    other.replace(digits, 3, "0.7");
    EXPECT_TRUE(says(import_chute(read_chute(other, "x"), {}, "x").changed, "the file contains 0.7"))
        << number;
  }
}

TEST(Chute, ALongNameIsCutBetweenLetters) {
  std::string text = chute_text("odd");
  const std::string name = R"(Odd \"one\"\u0007)";
  text.replace(text.find(name), name.size(), std::string(99, 'a') + "\u00e9\u00e9");
  const Case given = parse_case(import_chute(read_chute(text, "x"), {}, "x").case_text, "case.toml");
  EXPECT_EQ(given.title, std::string(99, 'a'));
}

TEST(Chute, ASectionOfNoGoresIsASlotAndNoCloth) {
  const std::string text = chute_text("sails");
  const ChuteFile file = read_chute(text, "x");
  ASSERT_GE(file.sections.size(), 2u);
  std::string slot = text;
  const std::size_t gores = slot.find("\"gores\": ", slot.find("\"chute_sections\"")) + 9;
  slot.replace(gores, slot.find(',', gores) - gores, "0");
  const ChuteFile open = read_chute(slot, "x");
  EXPECT_EQ(open.sections.size(), file.sections.size() - 1);
  EXPECT_TRUE(says(open.not_mapped, ": 0 gores"));
}

TEST(Chute, ALongFormulaIsCutInTheMessage) {
  std::string text = chute_text("elliptical");
  const std::string formula = "diameter/2";
  const std::size_t place = text.find(formula);
  ASSERT_NE(place, std::string::npos);
  text.replace(place, formula.size(), "unknown+" + std::string(200'000, '1'));
  const std::string refusal = refusal_of([&] { read_chute(text, "long.chute"); }, ExitCode::bad_data);
  EXPECT_NE(refusal.find("parameter_values["), std::string::npos);
  EXPECT_LT(refusal.size(), 400u);
}

// A disk and a band that touch: the type "disk-gap-band" has a gap above 0.
TEST(Chute, ADiskAndABandWithoutAGapBecomeAProfile) {
  ChuteFile file = read_chute(chute_text("disk-gap-band"), "x");
  ASSERT_EQ(file.sections.size(), 2u);
  ChuteSection& a = file.sections[0];
  ChuteSection& b = file.sections[1];
  const bool a_is_disk = std::abs(a.points.front().y - a.points.back().y) < 1e-9;
  ChuteSection& band = a_is_disk ? b : a;
  const ChuteSection& disk = a_is_disk ? a : b;
  const double up = disk.points.front().y - std::max(band.points.front().y, band.points.back().y);
  ASSERT_GT(up, 0);
  for (MeridianPoint& p : band.points) p.y += up;
  const ImportedCase result = import_chute(file, {}, "touching.chute");
  EXPECT_EQ(result.type, "profile");
  EXPECT_TRUE(says(result.changed, "\"disk-gap-band\" cannot represent this shape"));
  const Case given = parse_case(result.case_text, "case.toml");
  EXPECT_TRUE(given.parachute.canopy.as<ProfileCanopy>()->pieces[1].sewn);
}

TEST(Chute, AShapeThatNoTypeHasIsRefusedWithItsSections) {
  ChuteFile file = read_chute(chute_text("elliptical"), "x");
  for (MeridianPoint& p : file.sections[0].points) p.r = 0.5 + 0.1 * std::cos(40 * p.y);  // waists
  const std::string refusal = refusal_of([&] { import_chute(file, {}, "waist.chute"); }, ExitCode::bad_data);
  EXPECT_EQ(refusal.find("waist.chute: " + file.sections[0].place + ": "), 0u) << refusal;
  EXPECT_NE(refusal.find("no canopy family"), std::string::npos) << refusal;
}

TEST(Chute, AKeyThatIsThereTwiceIsRefused) {
  const std::string text = chute_text("sails");
  std::string twice = text;
  twice.insert(twice.find("\"gores\""), "\"gores\": 9, ");
  EXPECT_THROW(read_chute(twice, "x"), Error);
  read_chute(text, "x");
  std::string deep = "{\"name\": " + std::string(100'000, '[') + std::string(100'000, ']') + "}";
  EXPECT_THROW(read_chute(deep, "x"), Error);
}

// A file cut short or with a byte changed is refused or read, never worse.
TEST(Chute, BrokenFilesAreRefused) {
  const std::string text = chute_text("odd");
  for (std::size_t size = 0; size + 2 < text.size(); size += 13)
    EXPECT_THROW(read_chute(text.substr(0, size), "x"), Error) << size;
  int refused = 0;
  for (std::size_t i = 0; i < text.size(); i += 7) {
    std::string changed = text;
    changed[i] = i % 2 ? '9' : '"';
    try {
      const ImportedCase result = import_chute(read_chute(changed, "x"), {}, "x");
      parse_case(result.case_text, "case.toml");
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace ripstop

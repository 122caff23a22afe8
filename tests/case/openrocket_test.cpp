// Designs and databases of OpenRocket: values as the file has them, in SI, or a refusal with the place.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "../refusal.h"
#include "ripstop/case/case.h"
#include "ripstop/case/openrocket_import.h"
#include "ripstop/case/openrocket_text.h"
#include "ripstop/case/resolve.h"
#include "ripstop/core/file.h"
#include "ripstop/core/process.h"
#include "ripstop/parachute/design.h"

namespace ripstop {
namespace {

const std::filesystem::path two_stages =
    std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/openrocket/two-stage-recovery.ork";

class OpenRocket : public testing::Test {
 protected:
  std::filesystem::path written(const std::string& text, const std::string& name = "rocket.ork") const {
    write_file(folder_.path / name, text);
    return folder_.path / name;
  }
  /// The example with one text replaced.
  std::filesystem::path with(const std::string& from, const std::string& to) const {
    std::string text = read_file(two_stages);
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return written(text.replace(place, from.size(), to));
  }
  /// The file that a script of Python writes to its argument.
  std::filesystem::path packed(const std::string& script) const {
    write_file(folder_.path / "pack.py", script);
    ProcessRequest request;
    request.arguments = {"/usr/bin/python3", (folder_.path / "pack.py").string(),
                         (folder_.path / "packed.ork").string(), two_stages.string()};
    request.time_limit_s = 60;
    request.on_line = [](const std::string&) { return true; };
    EXPECT_EQ(run_process(request).exit_code, 0);
    return folder_.path / "packed.ork";
  }

  TemporaryFolder folder_{"openrocket"};
};

bool has_sentence(const std::vector<std::string>& list, const std::string& words) {
  return std::any_of(list.begin(), list.end(),
                     [&](const std::string& s) { return s.find(words) != std::string::npos; });
}

TEST_F(OpenRocket, ADesignHasItsRecoveryDevicesWithStageEventAndMass) {
  const OpenRocketFile file = read_openrocket(two_stages);
  EXPECT_EQ(file.name, "Student rocket");
  ASSERT_EQ(file.devices.size(), 3u);
  const RecoveryDevice &drogue = file.devices[0], &main = file.devices[1], &marker = file.devices[2];
  EXPECT_EQ(drogue.name, "Drogue");
  EXPECT_EQ(drogue.stage, "Sustainer");
  EXPECT_EQ(drogue.line, 12);
  EXPECT_EQ(drogue.event, "apogee");
  EXPECT_EQ(drogue.delay, 1.5);
  EXPECT_EQ(drogue.drag_coefficient, 0.75);
  EXPECT_EQ(drogue.diameter, 0.61);
  EXPECT_EQ(drogue.cloth_density, 0.067);
  EXPECT_EQ(drogue.line_density, 0.0018);
  EXPECT_EQ(main.event, "altitude");
  EXPECT_EQ(main.altitude, 300);
  EXPECT_EQ(main.line_count, 12);
  EXPECT_EQ(main.line_length, 2.8);
  EXPECT_EQ(main.descent_mass, 22.0);
  EXPECT_EQ(main.simulation, "Sport launch");
  EXPECT_TRUE(marker.streamer);
  EXPECT_TRUE(marker.automatic);
  EXPECT_TRUE(has_sentence(file.notes, "\"Main\": the deployment settings of 1 flight configuration"));
}

TEST_F(OpenRocket, ACompressedDesignIsReadAsThePlainOne) {
  const std::string plain = read_file(two_stages);
  EXPECT_EQ(
      openrocket_text_of(packed("import sys, gzip\n"
                                "gzip.open(sys.argv[1], 'wb').write(open(sys.argv[2], 'rb').read())\n")),
      plain);
  const std::string zip =
      "import sys, zipfile\nz = zipfile.ZipFile(sys.argv[1], 'w', zipfile.ZIP_DEFLATED)\n"
      "z.writestr('../../outside', 'x')\n";
  EXPECT_EQ(openrocket_text_of(packed(zip + "z.write(sys.argv[2], 'rocket.ork')\nz.close()\n")), plain);
  EXPECT_FALSE(std::filesystem::exists(folder_.path.parent_path().parent_path() / "outside"));
  const auto empty = packed(zip + "z.close()\n");
  EXPECT_NE(refusal_of([&] { openrocket_text_of(empty); }, ExitCode::bad_data).find("no entry rocket.ork"),
            std::string::npos);
}

TEST_F(OpenRocket, AnArchiveThatUnpacksToTooMuchOrIsDamagedIsRefused) {
  for (const char* script :
       {"import sys, gzip\ngzip.open(sys.argv[1], 'wb').write(bytes(5000000))\n",
        "import sys, zipfile\nz = zipfile.ZipFile(sys.argv[1], 'w', zipfile.ZIP_DEFLATED)\n"
        "z.writestr('rocket.ork', bytes(5000000))\nz.close()\n"}) {
    const auto bomb = packed(script);
    EXPECT_LT(std::filesystem::file_size(bomb), 10000u);
    EXPECT_NE(refusal_of([&] { openrocket_text_of(bomb, 1 << 20); }, ExitCode::bad_data)
                  .find("unpacks to more than 1 MiB"),
              std::string::npos);
  }
  const auto damaged = packed(
      "import sys, zipfile\nz = zipfile.ZipFile(sys.argv[1], 'w')\n"
      "z.write(sys.argv[2], 'rocket.ork')\nz.close()\n"
      "f = open(sys.argv[1], 'r+b')\nf.seek(400)\nf.write(b'?')\n");
  EXPECT_NE(refusal_of([&] { openrocket_text_of(damaged); }, ExitCode::bad_data).find("checksum"),
            std::string::npos);
}

TEST_F(OpenRocket, EntitiesAreNotExpandedAndDeepNestingIsRefused) {
  const auto entity = with("<openrocket version",
                           "<!DOCTYPE openrocket [<!ENTITY a \"0.6\"><!ENTITY f SYSTEM \"/etc/hostname\">]>"
                           "<openrocket version");
  EXPECT_EQ(read_openrocket(entity).devices.size(), 3u);
  const auto used = written(
      "<!DOCTYPE x [<!ENTITY a \"0.6\">]><openrocket><rocket><subcomponents><parachute>"
      "<diameter>&a;</diameter></parachute></subcomponents></rocket></openrocket>");
  EXPECT_NE(
      refusal_of([&] { read_openrocket(used); }, ExitCode::bad_data).find("<diameter> &a;: must be a number"),
      std::string::npos);
  std::string deep = "<openrocket><rocket>", end = "</rocket></openrocket>";
  for (int i = 0; i < 300; ++i)
    deep += "<subcomponents><bodytube>", end = "</bodytube></subcomponents>" + end;
  EXPECT_NE(refusal_of([&] { read_openrocket(written(deep + end)); }, ExitCode::bad_data)
                .find("inside one another"),
            std::string::npos);
}

TEST_F(OpenRocket, OddValuesAreRefusedWithLineAndElement) {
  const struct {
    const char *from, *to, *message;
  } odd[] = {
      {"<diameter>0.61<", "<diameter>wide<", ":19: <diameter> wide: must be a number"},
      {"<diameter>0.61<", "<diameter>NaN<", ":19: <diameter> NaN: must be a number"},
      {"<diameter>0.61<", "<diameter>-0.61<", ":19: <diameter> -0.61: must be from 0.005 to 100 m"},
      {"<diameter>0.61<", "<diameter>610<", ":19: <diameter> 610: must be from 0.005 to 100 m"},
      {"<cd>0.75<", "<cd>0<", ":14: <cd> 0: must be from 0.01 to 20"},
      {"<linecount>6<", "<linecount>6.5<", ":20: <linecount> 6.5: must be an integer"},
      {"density=\"0.067\"", "density=\"heavy\"", ":15: <material> heavy: must be a number"},
      {"</rocket>", "", "is not valid XML"},
      {"<openrocket version=\"1.9\" creator=\"Ripstop\">", "<html>", "is not valid XML"},
  };
  for (const auto& [from, to, message] : odd) {
    const auto path = with(from, to);
    const std::string refusal = refusal_of([&] { read_openrocket(path); }, ExitCode::bad_data);
    EXPECT_NE(refusal.find(message), std::string::npos) << refusal;
  }
  const auto page = written("<html><body/></html>");
  EXPECT_NE(refusal_of([&] { read_openrocket(page); }, ExitCode::bad_data).find("neither a design"),
            std::string::npos);
}

TEST_F(OpenRocket, ADeviceIsChosenByNumberOrNameAndTheChoiceIsListed) {
  const OpenRocketFile file = read_openrocket(two_stages);
  EXPECT_EQ(choose_device(file, "2").name, "Main");
  EXPECT_EQ(choose_device(file, "Drogue").name, "Drogue");
  for (const char* wanted : {"", "Pilot", "0", "4"}) {
    const std::string refusal = refusal_of([&] { choose_device(file, wanted); }, ExitCode::usage);
    EXPECT_NE(refusal.find("2  Main, 2.44 m, altitude, stage Sustainer"), std::string::npos) << refusal;
    EXPECT_NE(refusal.find("3  Marker, streamer"), std::string::npos) << refusal;
  }
  OpenRocketFile one = file;
  one.devices.erase(one.devices.begin());
  EXPECT_EQ(choose_device(one, "").name, "Main");  // the only parachute
}

TEST_F(OpenRocket, TheCaseHasTheDeviceAndItsDragArea) {
  const OpenRocketFile file = read_openrocket(two_stages);
  const ImportedCase drogue = import_openrocket(file, choose_device(file, "Drogue"), {}, "rocket.ork");
  const Case given = parse_case(drogue.case_text, "drogue.toml");
  EXPECT_EQ(given.title, "Drogue");
  EXPECT_NEAR(nominal_diameter(given.parachute), 0.61, 1e-9);
  EXPECT_EQ(given.parachute.lines.count, 6);
  EXPECT_EQ(given.parachute.lines.length_m, 0.7);
  EXPECT_NEAR(given.inflation.drag_coefficient.value(), 0.75, 1e-9);
  const Settings resolved = resolve(given);
  EXPECT_EQ(resolved.materials().canopy.areal_density_kg_m2, 0.067);
  EXPECT_EQ(resolved.materials().line.linear_density_kg_m, 0.0018);
  EXPECT_NE(drogue.case_text.find("# Deployment: apogee, delay 1.5 s"), std::string::npos);
  EXPECT_FALSE(has_sentence(drogue.changed, "projected"));
}

// `ripstop recovery` adds the mass of Ripstop's own parachutes.
TEST_F(OpenRocket, ThePayloadOfASimulationIsWithoutTheParachutesOfTheStage) {
  const auto payload = [](const OpenRocketFile& file, const char* device) {
    const ImportedCase import = import_openrocket(file, choose_device(file, device), {}, "rocket.ork");
    return std::pair(parse_case(import.case_text, "case.toml").payload.mass_kg.value(), import);
  };
  const double quarter = std::numbers::pi / 4;
  const double drogue = quarter * 0.61 * 0.61 * 0.067 + 6 * 0.7 * 0.0018;
  const double main = quarter * 2.44 * 2.44 * 0.0373 + 12 * 2.8 * 0.0029;
  const OpenRocketFile file = read_openrocket(two_stages);
  const auto [with_main, import] = payload(file, "Main");
  EXPECT_NEAR(with_main, 22 - drogue - main, 1e-6);
  EXPECT_NEAR(payload(file, "Drogue").first, with_main, 1e-9);
  EXPECT_TRUE(
      has_sentence(import.mapped, "\"Sport launch\", 22 kg, without the parachutes (\"Drogue\" 0.027"));
  const auto heavy = with("<diameter>0.61<", "<overridemass>0.5</overridemass><diameter>0.61<");
  EXPECT_NEAR(payload(read_openrocket(heavy), "Main").first, 22 - 0.5 - main, 1e-6);
  const auto unknown = with(" density=\"0.067\"", "");
  const auto [without, note] = payload(read_openrocket(unknown), "Main");
  EXPECT_NEAR(without, 22 - main, 1e-6);
  EXPECT_TRUE(has_sentence(note.changed, "includes the parachute \"Drogue\""));
  OpenRocketImportOptions options;
  options.payload_mass = 20;
  const std::string text =
      import_openrocket(file, choose_device(file, "Main"), options, "rocket.ork").case_text;
  EXPECT_EQ(parse_case(text, "case.toml").payload.mass_kg, 20);
  const auto odd = read_openrocket(with("<diameter>0.61<", "<overridemass>30</overridemass><diameter>0.61<"));
  EXPECT_NE(
      refusal_of([&] { import_openrocket(odd, choose_device(odd, "Main"), {}, "r.ork"); }, ExitCode::bad_data)
          .find("not more than its parachutes; give the payload with --mass"),
      std::string::npos);
}

// A maker's coefficient on the projected area: the drag area stays, and the cloth is larger than the open canopy.
TEST_F(OpenRocket, ACoefficientOnTheProjectedAreaIsConverted) {
  const OpenRocketFile file = read_openrocket(two_stages);
  const RecoveryDevice& main = choose_device(file, "Main");
  EXPECT_TRUE(
      has_sentence(import_openrocket(file, main, {}, "rocket.ork").changed, "--diameter-is projected"));
  OpenRocketImportOptions options;
  options.diameter = GivenDiameter::projected;
  const ImportedCase import = import_openrocket(file, main, options, "rocket.ork");
  const Case given = parse_case(import.case_text, "main.toml");
  const double area = nominal_area(given.parachute);
  EXPECT_NEAR(std::sqrt(4 / std::numbers::pi * area), 2.44 / 0.70, 1e-6);
  EXPECT_NEAR(given.inflation.drag_coefficient.value() * area, 2.2 * std::numbers::pi / 4 * 2.44 * 2.44,
              1e-6);
  EXPECT_NEAR(given.inflation.drag_coefficient.value(), 2.2 * 0.70 * 0.70, 1e-6);
}

TEST_F(OpenRocket, AStreamerShortLinesAndAWideHoleAreRefused) {
  const OpenRocketFile file = read_openrocket(two_stages);
  EXPECT_NE(refusal_of([&] { import_openrocket(file, file.devices[2], {}, "r.ork"); }, ExitCode::bad_data)
                .find("r.ork:41: \"Marker\" is a streamer"),
            std::string::npos);
  OpenRocketImportOptions options;
  options.line_length = 0.3;
  EXPECT_NE(
      refusal_of([&] { import_openrocket(file, file.devices[0], options, "r.ork"); }, ExitCode::bad_data)
          .find("too short to meet"),
      std::string::npos);
  options = {};
  options.vent_diameter = 0.7;
  EXPECT_NE(
      refusal_of([&] { import_openrocket(file, file.devices[0], options, "r.ork"); }, ExitCode::bad_data)
          .find("not smaller than its canopy"),
      std::string::npos);
}

TEST_F(OpenRocket, ADatabaseIsReadInItsOwnUnits) {
  const auto path = written(
      "<OpenRocketComponent><Version>0.1</Version><Materials>"
      "<Material "
      "UnitsOfMeasure=\"g/m2\"><Name>ripstop</Name><Density>45</Density><Type>SURFACE</Type></Material>"
      "<Material "
      "UnitsOfMeasure=\"kg/m\"><Name>cord</Name><Density>0.002</Density><Type>LINE</Type></Material>"
      "</Materials><Components><Parachute><Manufacturer>Maker</Manufacturer><PartNumber>P-48</PartNumber>"
      "<Material Type=\"SURFACE\">ripstop</Material><Mass Unit=\"oz\">10</Mass><Diameter "
      "Unit=\"in\">48</Diameter>"
      "<Sides>8</Sides><LineCount>8</LineCount><LineLength Unit=\"ft\">5</LineLength>"
      "<LineMaterial Type=\"LINE\">cord</LineMaterial></Parachute></Components></OpenRocketComponent>",
      "parts.orc");
  const OpenRocketFile file = read_openrocket(path);
  ASSERT_EQ(file.devices.size(), 1u);
  const RecoveryDevice& d = file.devices[0];
  EXPECT_EQ(d.name, "Maker P-48");
  EXPECT_NEAR(d.diameter.value(), 1.2192, 1e-12);
  EXPECT_NEAR(d.line_length.value(), 1.524, 1e-12);
  EXPECT_NEAR(d.mass.value(), 0.2834952, 1e-6);
  EXPECT_NEAR(d.cloth_density.value(), 0.045, 1e-12);
  EXPECT_EQ(d.line_density, 0.002);
  EXPECT_EQ(d.sides, 8);
  EXPECT_FALSE(d.drag_coefficient);
  const Case given = parse_case(import_openrocket(file, d, {}, "parts.orc").case_text, "p.toml");
  EXPECT_EQ(given.parachute.gores, 8);
  EXPECT_FALSE(given.payload.mass_kg);
}

}  // namespace
}  // namespace ripstop

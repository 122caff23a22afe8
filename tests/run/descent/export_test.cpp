// Exports obey the rules of the format: Python that compiles and calls with RocketPy's own names, XML with
// OpenRocket's elements.
#include "ripstop/run/descent/export.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "ripstop/case/openrocket_import.h"
#include "ripstop/case/payload.h"
#include "ripstop/core/error.h"
#include "ripstop/core/process.h"
#include "ripstop/run/descent/flown.h"
#include "ripstop/run/opening/filling.h"
#include "tests/run/steady/finished_run.h"

namespace ripstop {
namespace {

class Export : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>("export");
    fly_square_law(folder_->path / "run", {{"title", "\"Stratos <IV> & \\\"more\\\"\""}});
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static ExportedParachute parachute() { return exported(finished_steady(folder_->path / "run")); }

  /// Output of Python for the script with the path of the file as its argument.
  static std::string python(const std::string& script, const std::string& file) {
    const auto path = folder_->path / "checked";
    write_file(path, file);
    write_file(folder_->path / "check.py", script);
    ProcessRequest request;
    request.arguments = {"/usr/bin/python3", (folder_->path / "check.py").string(), path.string()};
    request.time_limit_s = 60;
    std::string output;
    request.on_line = [&](const std::string& line) {
      output += line + "\n";
      return true;
    };
    EXPECT_EQ(run_process(request).exit_code, 0) << output;
    return output;
  }
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

TEST_F(Export, RocketPyIsPythonThatCallsAddParachuteByItsNames) {
  const std::string script = R"(
import ast, sys
text = open(sys.argv[1]).read()
ast.parse(text)
space = {}
exec(compile(text, "parachute.py", "exec"), space)
class Rocket:
    def add_parachute(self, name, cd_s, trigger, sampling_rate=100, lag=0, noise=(0, 0, 0), radius=None, height=None,
                      porosity=0.0432, drag_coefficient=1.4):
        print(repr(name)); print(cd_s); print(trigger); print(radius, height, lag)
        print(drag_coefficient * 3.141592653589793 * radius**2)
space["add_to"](Rocket())
)";
  const ExportedParachute p = parachute();
  const std::string output = python(script, rocketpy_text(p, "450"));
  EXPECT_EQ(output.find("'Stratos <IV> & \"more\"'\n"), 0u) << output;
  const std::size_t last = output.rfind('\n', output.size() - 2) + 1;
  EXPECT_NEAR(std::stod(output.substr(last)), p.drag_area, 1e-9);  // C_D on pi radius^2, as RocketPy has it
  EXPECT_NE(output.find("\n450\n"), std::string::npos) << output;
  EXPECT_NEAR(std::stod(output.substr(output.find('\n') + 1)), SquareLawEngine::area, 0.01);
  EXPECT_NE(rocketpy_text(p, "apogee").find("trigger=\"apogee\""), std::string::npos);
  for (const char* wrong : {"apogeo", "-3", "nan", "300m", ""})
    EXPECT_THROW(rocketpy_text(p, wrong), Error) << wrong;
}

TEST_F(Export, StatesTheRangeInDescentOfAnAxialDragArea) {
  const FinishedSteady run = finished_steady(folder_->path / "run");
  const ExportedParachute p = parachute();
  ASSERT_EQ(p.basis, "axial");
  const DescentDrag range =
      descent_drag(run.resolved, {p.drag_coefficient, "", usual_drag_uncertainty, "axial"});
  const std::string text = fmt::format("C_D {:.3f} to {:.3f} on S0", range.low, range.high);
  ASSERT_FALSE(p.warnings.empty());
  EXPECT_NE(p.warnings.back().find(text), std::string::npos) << p.warnings.back();
  EXPECT_NE(rocketpy_text(p, "apogee").find(text), std::string::npos);
}

TEST_F(Export, WarnsOfADrogueLargerThanTheMain) {
  ExportedRecovery recovery{{{parachute()}, {parachute()}}};
  const std::size_t own = warnings_of(recovery).size();
  recovery.stages[1].parachute.drag_area *= 0.5;
  const std::vector<std::string> warnings = warnings_of(recovery);
  ASSERT_EQ(warnings.size(), own + 1);
  EXPECT_NE(warnings.back().find("exchange the two parachutes"), std::string::npos);
}

TEST_F(Export, OpenRocketIsAComponentDatabaseWithItsElementsAndMaterials) {
  const std::string script = R"(
import sys, xml.etree.ElementTree as tree
root = tree.parse(sys.argv[1]).getroot()
assert root.tag == "OpenRocketComponent" and root.find("Version").text == "0.1"
materials = {m.find("Name").text: m for m in root.find("Materials")}
assert all(m.find("Type").text in ("SURFACE", "LINE", "BULK") and float(m.find("Density").text) > 0 for m in materials.values())
(parachute,) = root.find("Components")
assert parachute.tag == "Parachute"
allowed = {"Manufacturer", "PartNumber", "Description", "Material", "Mass", "Diameter", "Sides", "PackedDiameter",
           "PackedLength", "DragCoefficient", "LineCount", "LineLength", "LineMaterial"}
assert {e.tag for e in parachute} == allowed, parachute
for key in ("Material", "LineMaterial"):
    found = materials[parachute.find(key).text]
    assert found.find("Type").text == parachute.find(key).get("Type")
d, cd = (float(parachute.find(k).text) for k in ("Diameter", "DragCoefficient"))
print(cd * 3.141592653589793 / 4 * d * d)
int(parachute.find("Sides").text), int(parachute.find("LineCount").text)
)";
  const ExportedParachute p = parachute();
  EXPECT_NEAR(std::stod(python(script, openrocket_text(p))), p.drag_area, 1e-9);
  EXPECT_NE(openrocket_text(p).find(fmt::format("C_D on S0 = {:.4f} m2", p.nominal_area)), std::string::npos);
}

// From the run to a component database, to a case of a flat circular canopy: the same device.
TEST_F(Export, OpenRocketsComponentIsImportedAsTheSameDevice) {
  const ExportedParachute p = parachute();
  write_file(folder_->path / "part.orc", openrocket_text(p));
  const OpenRocketFile file = read_openrocket(folder_->path / "part.orc");
  ASSERT_EQ(file.devices.size(), 1u);
  const RecoveryDevice& device = file.devices[0];
  EXPECT_EQ(device.name, "Ripstop " + p.title);
  EXPECT_NEAR(device.mass.value(), p.mass, 1e-12);
  const Settings back =
      resolve(parse_case(import_openrocket(file, device, {}, "part.orc").case_text, "p.toml"));
  EXPECT_NEAR(nominal_diameter(back.parachute()) / p.nominal_diameter, 1, 1e-8);
  EXPECT_EQ(back.parachute().gores, p.gores);
  EXPECT_EQ(back.parachute().lines.count, p.line_count);
  EXPECT_NEAR(back.parachute().lines.length_m, p.line_length, 1e-9);
  EXPECT_NEAR(back.materials().canopy.areal_density_kg_m2, p.cloth_density, 1e-9);
  EXPECT_NEAR(back.materials().line.linear_density_kg_m, p.line_density, 1e-9);
  const double drag_area = back.inflation().drag_coefficient.value() * nominal_area(back.parachute());
  EXPECT_NEAR(drag_area / p.drag_area, 1, 1e-8);
}

// The distribution is about that range: mean and two standard deviations to each side.
TEST_F(Export, TheDistributionOfTheDragAreaHasTheRangeInDescent) {
  const ExportedParachute p = parachute();
  const FinishedSteady run = finished_steady(folder_->path / "run");
  const DescentDrag range =
      descent_drag(run.resolved, {p.drag_coefficient, "", usual_drag_uncertainty, "axial"});
  EXPECT_NEAR((p.drag_area_mean - 2 * p.drag_area_deviation) / (range.low * p.nominal_area), 1, 1e-9);
  EXPECT_NEAR((p.drag_area_mean + 2 * p.drag_area_deviation) / (range.high * p.nominal_area), 1, 1e-9);
  ASSERT_FALSE(p.warnings.empty());
  EXPECT_NE(p.warnings.back().find(fmt::format("the middle of the range, {:.4g} m2", p.drag_area_mean)),
            std::string::npos)
      << p.warnings.back();
}

TEST_F(Export, APackedParachuteFillsABayOfGivenDiameter) {
  ExportedParachute p = parachute();
  const double volume = p.packed_volume;
  pack_into_bay(0.15, p);
  EXPECT_EQ(p.packed_diameter, 0.15);
  EXPECT_NEAR(std::numbers::pi / 4 * 0.15 * 0.15 * p.packed_length, volume, 1e-12);
  EXPECT_NE(openrocket_design(ExportedRecovery{{{p}}}).find("<packedradius>0.075</packedradius>"),
            std::string::npos);
  EXPECT_THROW(pack_into_bay(0, p), Error);
}

/// Drogue at apogee, main at 300 m, first reefed to a quarter of its drag area for 5 s.
ExportedRecovery two_stages(const ExportedParachute& parachute) {
  ExportedRecovery recovery;
  ExportedParachute drogue = parachute;
  drogue.drag_area *= 0.1, drogue.nominal_area *= 0.1;
  drogue.drag_area_mean *= 0.1, drogue.drag_area_deviation *= 0.1;
  drogue.nominal_diameter *= std::sqrt(0.1), drogue.radius *= std::sqrt(0.1), drogue.lag = 0.2;
  recovery.stages = {{drogue, "apogee"}, {parachute, "300", {{0.25, 5}}}};
  recovery.stages[1].parachute.lag = 1.2;
  return recovery;
}

// RocketPy 1.12 (simulation/flight.py) passes pressure, height and state to a trigger and no time. It calls a trigger once
// per sample with time_overshoot and twice without, and has not the same samples after every event. It uses the drag area
// that opened last.
TEST_F(Export, RocketPyHasDrogueReefedMainAndDisreefInTime) {
  const std::string script = R"(
import sys
space = {}
exec(compile(open(sys.argv[1]).read(), "parachutes.py", "exec"), space)
class Rocket:
    def add_parachute(self, name, cd_s, trigger, sampling_rate, lag, noise, radius, height, porosity, drag_coefficient):
        assert abs(drag_coefficient * 3.141592653589793 * radius**2 / cd_s - 1) < 1e-12
        return (name, cd_s, trigger, lag, sampling_rate)
added = space["add_to"](Rocket())
drogue, reefed, main = added
after = main[2]
for calls, step in ((1, 0.01), (2, 0.01), (1, 0.1)):  # each flight begins anew
    state = [0, 0, 0, 0, 0, 10]
    assert not any(after(0, h, state) for h in range(0, 1000))
    time, v, z, begin = 0, 20, 1000.0, None
    while True:
        state[2], state[5] = z, -v
        if begin is None and z - 200 < 300: begin = time
        opens = [after(0, z - 200, state) for _ in range(calls)]
        if opens[-1]: break
        slower = 9.81 if begin is None else 9.81 - 0.09 * v * v  # the reefed main decelerates
        z, v, time = z - v * step - slower * step**2 / 2, v + slower * step, time + step
    print(time - begin)
for one in added: print(one[1], one[3])
for one in space["deviations"]:
    shape, scale, name = one["lag"]
    assert name == "gamma"
    print(*one["cd_s"], shape * scale, shape**0.5 * scale)
print(drogue[2], reefed[2])
)";
  const ExportedRecovery recovery = two_stages(parachute());
  std::istringstream output(python(script, rocketpy_text(recovery)));
  const double area = parachute().drag_area, mean = parachute().drag_area_mean,
               deviation = parachute().drag_area_deviation;
  const double lag = std::sqrt(0.25) * 1.2, rest = std::sqrt(0.75) * 1.2;
  const double expected[] = {5,
                             5,
                             5,
                             0.1 * area,
                             0.2,
                             0.35 * area,
                             lag,
                             1.1 * area,
                             rest,
                             0.1 * mean,
                             0.1 * deviation,
                             0.2,
                             recovery.stages[0].parachute.lag_deviation,
                             0.35 * mean,
                             std::hypot(0.1, 0.25) * deviation};
  for (const double value : expected) {
    double printed = 0;
    ASSERT_TRUE(output >> printed);
    EXPECT_NEAR(printed, value, 0.03 * value + 1e-9);
  }
  ExportedRecovery released = recovery;
  released.drogue_released = true;
  EXPECT_NE(rocketpy_text(released).find(fmt::format("cd_s={},", area)), std::string::npos);
  ExportedRecovery hasty = recovery;
  hasty.stages[1].reefing[0].duration = 0.5;
  EXPECT_THROW(rocketpy_text(hasty), Error);
}

// OpenRocket adds the drag areas of all devices that are open.
TEST_F(Export, OpenRocketsDesignHasTheSameDragAreasAfterEveryEvent) {
  write_file(folder_->path / "two.ork", openrocket_design(two_stages(parachute())));
  const OpenRocketFile file = read_openrocket(folder_->path / "two.ork");
  ASSERT_EQ(file.devices.size(), 3u);
  const auto area = [](const RecoveryDevice& d) {
    return *d.drag_coefficient * std::numbers::pi / 4 * *d.diameter * *d.diameter;
  };
  const double whole = parachute().drag_area;
  EXPECT_NEAR(area(file.devices[0]) / (0.1 * whole), 1, 1e-9);
  EXPECT_NEAR(area(file.devices[1]) / (0.25 * whole), 1, 1e-9);
  EXPECT_NEAR((area(file.devices[1]) + area(file.devices[2])) / whole, 1, 1e-9);
  EXPECT_EQ(file.devices[0].event, "apogee");
  EXPECT_EQ(file.devices[1].event, "altitude");
  EXPECT_EQ(file.devices[2].altitude, 300);
  EXPECT_NEAR(*file.devices[0].delay, 0.2, 1e-12);
  EXPECT_NEAR(*file.devices[2].delay, 5 + std::sqrt(0.75) * 1.2, 1e-12);
  EXPECT_NEAR(*file.devices[1].mass, parachute().mass, 1e-12);
  EXPECT_EQ(*file.devices[2].mass, 0);
  ExportedRecovery released = two_stages(parachute());
  released.drogue_released = true;
  EXPECT_THROW(openrocket_design(released), Error);
}

// File, case, run, file: the same device with the same deployment.
TEST_F(Export, ADeviceOfOpenRocketComesBackFromItsCaseAsTheSameDevice) {
  const double diameter = 1.5, coefficient = 0.62;
  write_file(
      folder_->path / "given.ork",
      fmt::format("<openrocket version=\"1.8\"><rocket><name>R</name><subcomponents><stage><name>S</name>"
                  "<subcomponents><parachute><name>Main</name><cd>{}</cd>"
                  "<material type=\"surface\" density=\"0.06\">cloth</material>"
                  "<deployevent>altitude</deployevent><deployaltitude>250</deployaltitude>"
                  "<deploydelay>0</deploydelay><diameter>{}</diameter><linecount>10</linecount>"
                  "<linelength>1.8</linelength><linematerial type=\"line\" density=\"0.002\">cord"
                  "</linematerial></parachute></subcomponents></stage></subcomponents></rocket></openrocket>",
                  coefficient, diameter));
  const OpenRocketFile file = read_openrocket(folder_->path / "given.ork");
  const RecoveryDevice& given = file.devices.at(0);
  FinishedSteady run = finished_steady(folder_->path / "run");  // a run of the case has its drag area
  run.resolved = resolve(parse_case(import_openrocket(file, given, {}, "given.ork").case_text, "main.toml"));
  run.result.title = run.resolved.title();
  run.result.reference_area = nominal_area(run.resolved.parachute());
  run.result.drag_coefficient = run.resolved.inflation().drag_coefficient.value();
  run.result.drag_area = run.result.drag_coefficient * run.result.reference_area;
  ExportedRecovery recovery;
  recovery.stages = {{exported(run), "250"}};
  write_file(folder_->path / "back.ork", openrocket_design(recovery));
  const OpenRocketFile again = read_openrocket(folder_->path / "back.ork");
  ASSERT_EQ(again.devices.size(), 1u);
  const RecoveryDevice& back = again.devices[0];
  EXPECT_EQ(back.name, given.name);
  EXPECT_NEAR(*back.diameter / *given.diameter, 1, 1e-6);
  EXPECT_NEAR(*back.drag_coefficient / *given.drag_coefficient, 1, 1e-6);
  EXPECT_EQ(back.line_count, given.line_count);
  EXPECT_NEAR(*back.line_length, *given.line_length, 1e-9);
  EXPECT_NEAR(*back.cloth_density, *given.cloth_density, 1e-9);
  EXPECT_NEAR(*back.line_density, *given.line_density, 1e-9);
  EXPECT_EQ(back.event, given.event);
  EXPECT_EQ(back.altitude, given.altitude);
}

TEST_F(Export, EveryNumberIsThatOfTheRunOrOfItsDesign) {
  const FinishedSteady run = finished_steady(folder_->path / "run");
  const ExportedParachute p = exported(run);
  const Design& design = run.resolved.parachute();
  EXPECT_EQ(p.title, run.result.title);
  EXPECT_EQ(p.run, (folder_->path / "run").string());
  EXPECT_EQ(p.drag_area, run.result.drag_area);
  EXPECT_DOUBLE_EQ(p.drag_area_uncertainty, run.drag_uncertainty * p.drag_area);
  EXPECT_EQ(p.drag_coefficient, run.result.drag_coefficient);
  EXPECT_DOUBLE_EQ(p.nominal_area, nominal_area(design));
  EXPECT_DOUBLE_EQ(p.nominal_diameter, std::sqrt(4 / std::numbers::pi * p.nominal_area));
  EXPECT_DOUBLE_EQ(2 * p.radius, run.result.size.projected_diameter);
  EXPECT_EQ(p.height, run.result.size.length);
  EXPECT_DOUBLE_EQ(p.porosity, facts(design).geometric_porosity());
  // Disk-gap-band: ten diameters, below 150 ft/s 10 / 8 times 4.0 v^0.15 in ft/s.
  EXPECT_DOUBLE_EQ(exported(run, 50).lag, 10 * p.nominal_diameter / 50);
  const double slow = 10.0 / 8 * 4 * std::pow(5 / 0.3048, 0.15);
  EXPECT_DOUBLE_EQ(exported(run, 5).lag, slow * p.nominal_diameter / 5);
  EXPECT_EQ(exported(run, 5).lag_from, std::string("filling distance 7.61 D0 at 5 m/s (given): ") +
                                           known_filling("disk-gap-band").source);
  EXPECT_EQ(p.mass, run.parachute_mass);
  EXPECT_EQ(p.gores, design.gores);
  EXPECT_EQ(p.line_count, design.lines.count);
  EXPECT_EQ(p.line_length, design.lines.length_m);
  EXPECT_EQ(p.line_material, design.lines.material);
  EXPECT_EQ(p.cloth_material, design.canopy_material);
  EXPECT_EQ(p.line_density, run.resolved.materials().line.linear_density_kg_m);
  EXPECT_EQ(p.cloth_density, run.resolved.materials().canopy.areal_density_kg_m2);
  // A cylinder twice as long as wide.
  EXPECT_DOUBLE_EQ(p.packed_length, 2 * p.packed_diameter);
  EXPECT_NEAR(
      std::numbers::pi / 4 * p.packed_diameter * p.packed_diameter * p.packed_length / p.packed_volume, 1,
      1e-12);
}

// The speed of a run with a payload is its rate of descent; a parachute is deployed at a higher one.
TEST_F(Export, ARunWithAPayloadHasTheDeploymentSpeedOfSizeAndStatesIt) {
  FinishedSteady run = finished_steady(folder_->path / "run");
  EXPECT_EQ(exported(run).deployment_speed, run.result.speed);
  EXPECT_FALSE(exported(run).speed_assumed);
  Case descends = run.resolved.written();
  descends.payload.mass_kg = 3;
  run.resolved = resolve(descends), run.result.speed = 5;
  const ExportedParachute p = exported(run);
  EXPECT_TRUE(p.speed_assumed);
  EXPECT_EQ(p.deployment_speed, least_deployment_speed);
  EXPECT_DOUBLE_EQ(p.lag, exported(run, 20).lag);
  EXPECT_EQ(exported(run, 12).deployment_speed, 12);
  const std::string assumed = fmt::format(
      "at {0:g} m/s (assumed, the larger of {0:g} m/s and {1:g} times the rate of descent of 5 m/s",
      least_deployment_speed, deployment_over_descent);
  for (const std::string& text : {rocketpy_text(p, "apogee"), openrocket_design({{{p, "apogee"}}})})
    EXPECT_NE(text.find(assumed), std::string::npos) << text;
  run.result.speed = 9;
  EXPECT_EQ(exported(run).deployment_speed, 9 * deployment_over_descent);
  descends.payload.deployment_speed_m_s = 31;
  run.resolved = resolve(descends);
  EXPECT_EQ(exported(run).deployment_speed, 31);
  EXPECT_FALSE(exported(run).speed_assumed);
  EXPECT_EQ(exported(run).deployment_speed_from, "payload.deployment_speed_m_s of the case");
  EXPECT_EQ(exported(run, 12).deployment_speed, 12);
}

TEST_F(Export, WithAFlightHasItsCoefficientInDescentAndStatesSo) {
  const FinishedSteady run = finished_steady(folder_->path / "run");
  EXPECT_EQ(exported(run).basis, "axial");
  EXPECT_NE(rocketpy_text(exported(run), "apogee").find("axial (steady flow"), std::string::npos);
  FinishedFlight flight{"flight", run.resolved, {}};
  flight.result.reference_area = run.result.reference_area;
  flight.result.coefficient = 0.8 * run.result.drag_coefficient;
  flight.result.coefficient_error = 0.01 * *flight.result.coefficient;
  flight.result.descent = 5;
  const ExportedParachute p = exported(run, {}, flight);
  EXPECT_EQ(p.basis, "descent");
  EXPECT_DOUBLE_EQ(p.drag_area, *flight.result.coefficient * p.nominal_area);
  EXPECT_DOUBLE_EQ(p.drag_area_uncertainty, 0.01 * p.drag_area);
  EXPECT_NE(rocketpy_text(p, "apogee").find("in descent (computed free flight"), std::string::npos);
  EXPECT_NE(openrocket_text(p).find("descent"), std::string::npos);
  Case other = run.resolved.written();
  other.parachute.lines.length_m *= 2;
  flight.resolved = resolve(other);
  EXPECT_THROW(exported(run, {}, flight), Error);
}

TEST_F(Export, JsonHasEveryNumber) {
  const ExportedParachute p = parachute();
  const auto json = nlohmann::json::parse(to_json(p));
  EXPECT_EQ(json.at("drag_area_m2"), p.drag_area);
  const double reference = json.at(json.at("drag_coefficient_on").get<std::string>());
  EXPECT_NEAR(json.at("drag_coefficient").get<double>() * reference, p.drag_area, 1e-9);
  EXPECT_GT(json.at("packed_volume_m3"), 0);
  const FinishedSteady run = finished_steady(folder_->path / "run");
  EXPECT_EQ(json.at("lag_s"), p.lag);
  EXPECT_THROW(exported(finished_steady(folder_->path / "run"), -1), Error);
}

}  // namespace
}  // namespace ripstop

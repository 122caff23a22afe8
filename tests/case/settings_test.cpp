// Settings: complete, immutable, and the same again from the case that they write out.
#include "ripstop/case/settings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>

#include "fixture.h"
#include "ripstop/case/assemble.h"
#include "ripstop/run/json.h"

namespace ripstop {
namespace {

static_assert(!std::is_default_constructible_v<Settings> && !std::is_constructible_v<Settings, Case>);
static_assert(std::is_same_v<decltype(std::declval<Settings&>().flow()), const FlowSettings&>);
static_assert(std::is_same_v<decltype(std::declval<Settings&>().written()), const Case&>);

Settings example(const std::string& name, const std::vector<std::string>& set = {}) {
  Overrides overrides;
  for (const std::string& text : set) overrides.set.push_back(parse_setting(text, "--set"));
  return resolve(read_case(examples / name / "case.toml", overrides));
}

std::vector<Settings> various() {
  return {example("stratos-iv", {"flow.speed_basis=measured"}),
          example("cross"),
          example("adept"),
          example("elliptical"),
          example("flat-circular", {"payload.mass_kg=4", "flow.unsteady=false"}),
          example("flat-circular", {"flow.unsteady=true"}),
          example("flat-circular", {"flow.tunnel.kind=open-jet", "flow.tunnel.width_m=5"}),
          example("flat-circular", {"flow.tunnel.kind=closed", "flow.tunnel.width_m=5"}),
          example("walrus")};
}

TEST(Settings, EverySourceNamesAKeyOfTheCaseAndItsUnit) {
  const std::map<std::string, std::string> units = {{"parachute.nominal_area_m2", "m²"},
                                                    {"parachute.lines.onto_disk_m", "m"},
                                                    {"parachute.tape.material", ""},
                                                    {"flow.speed_m_s", "m/s"},
                                                    {"flow.density_kg_m3", "kg/m³"},
                                                    {"flow.temperature_k", "K"},
                                                    {"flow.viscosity_pa_s", "Pa s"},
                                                    {"flow.porosity_model", ""},
                                                    {"flow.box_m", "m"},
                                                    {"flow.cells", ""},
                                                    {"flow.canopy_position_m", "m"},
                                                    {"flow.core.size_m", "m"},
                                                    {"flow.core.start_m", "m"},
                                                    {"flow.core.growth", ""},
                                                    {"flow.core.off_axis", ""},
                                                    {"flow.convection", ""},
                                                    {"flow.sides", ""},
                                                    {"flow.outlet", ""},
                                                    {"flow.residual", ""},
                                                    {"flow.max_iterations", ""},
                                                    {"flow.average_over", ""},
                                                    {"coupling.load", ""},
                                                    {"coupling.drag_tolerance", ""},
                                                    {"coupling.shape_tolerance_m", "m"},
                                                    {"inflation.line_segment_m", "m"},
                                                    {"flow.tunnel.shape", ""},
                                                    {"flow.tunnel.height_m", "m"},
                                                    {"flow.tunnel.nozzle_distance_m", "m"},
                                                    {"flow.tunnel.outside_speed", ""},
                                                    {"flow.tunnel.shear_layer_m", "m"},
                                                    {"flow.tunnel.displacement_thickness_m", "m"}};
  for (const Settings& resolved : various()) {
    const auto written = nlohmann::ordered_json::parse(case_json(resolved));
    for (const Source& source : resolved.sources()) {
      EXPECT_TRUE(written.contains(pointer_of(source.key))) << source.key;
      ASSERT_TRUE(units.contains(source.key)) << source.key;
      EXPECT_EQ(source.unit, units.at(source.key)) << source.key;
      EXPECT_FALSE(source.from.empty()) << source.key;
    }
    EXPECT_THROW(resolved.source("flow.engine"), std::out_of_range);
  }
}

TEST(Settings, TheCaseThatTheyWriteOutHasTheSameSettings) {
  for (const Settings& resolved : various()) {
    const Settings again = resolve(parse_case(case_toml(resolved), "written.toml"));
    EXPECT_EQ(again.flow(), resolved.flow()) << resolved.title();
    EXPECT_EQ(case_json(again), case_json(resolved)) << resolved.title();
    EXPECT_EQ(again.materials().tape.has_value(), resolved.materials().tape.has_value());
    EXPECT_EQ(again.measured_row().has_value(), resolved.measured_row().has_value());
    ASSERT_EQ(again.sources().size(), resolved.sources().size());
    for (std::size_t i = 0; i < again.sources().size(); ++i) {
      EXPECT_EQ(again.sources()[i].key, resolved.sources()[i].key);
      EXPECT_TRUE(again.sources()[i].given) << again.sources()[i].key;
    }
  }
}

TEST(Settings, TheSpeedIsTheActualOneAndTheNominalOneIsNamedSo) {
  const Settings nominal = example("stratos-iv"),
                 measured = example("stratos-iv", {"flow.speed_basis=measured"});
  EXPECT_EQ(nominal.flow().speed_m_s, 30);
  EXPECT_EQ(measured.flow().speed_m_s, 27.1);
  EXPECT_EQ(measured.flow().nominal_speed_m_s, 30);
  EXPECT_EQ(flow_problem(measured).air.speed(), 27.1);
  ASSERT_TRUE(measured.measured_row().has_value());
  EXPECT_EQ(measured.measured_row()->measured_speed_m_s, 27.1);
}

TEST(Settings, AtAnotherSpeedEverythingElseStays) {
  const Settings first = example("flat-circular", {"payload.mass_kg=4"}), fast = at_speed(first, 12.3456789);
  EXPECT_EQ(fast.flow().speed_m_s, 12.3456789);
  EXPECT_EQ(fast.flow().nominal_speed_m_s, 12.3456789);
  EXPECT_EQ(fast.parachute().tape.material, first.parachute().tape.material);
  EXPECT_EQ(case_json(at_speed(fast, first.flow().speed_m_s)), case_json(first));
}

TEST(SameFlow, IgnoresHowTheCaseIsWritten) {
  const Settings a = resolve(parse_case(short_case, "a.toml"));
  const Settings b = resolve(parse_case(
      "# another file\n" + replaced(short_case, "density_kg_m3 = 1.2", "density_kg_m3 = 12.0e-1"), "b.toml"));
  EXPECT_TRUE(same_flow(a.flow(), b.flow()));
  const Settings c = resolve(parse_case(case_toml(a), "c.toml"));
  EXPECT_TRUE(same_flow(a.flow(), c.flow()));
}

using Edit = void (*)(FlowSettings&);

TEST(SameFlow, NoticesEveryValueThatTheFieldDependsOn) {
  const FlowSettings flow = resolve(parse_case(short_case, "a.toml")).flow();
  const Edit edits[] = {[](FlowSettings& f) { f.engine = "openfoam"; },
                        [](FlowSettings& f) { f.angle_of_attack_deg = 5; },
                        [](FlowSettings& f) { f.azimuth_deg = 5; },
                        [](FlowSettings& f) { f.mesh = FlowMesh::fitted; },
                        [](FlowSettings& f) { f.cloth_levels = 1; },
                        [](FlowSettings& f) { f.ranks = 2; },
                        [](FlowSettings& f) { f.time_limit_s = 60; },
                        [](FlowSettings& f) { f.porosity_model = PorosityModel::paper; },
                        [](FlowSettings& f) { f.box_m.y += 0.1; },
                        [](FlowSettings& f) { f.cells[2] += 1; },
                        [](FlowSettings& f) { f.tunnel.kind = TunnelKind::closed; },
                        [](FlowSettings& f) { f.tunnel.nozzle.width = 3; },
                        [](FlowSettings& f) { f.tunnel.nozzle_distance_m = 1; },
                        [](FlowSettings& f) { f.tunnel.outside_speed = 0.1; },
                        [](FlowSettings& f) { f.tunnel.shear_layer_m = 0.2; },
                        [](FlowSettings& f) { f.tunnel.displacement_thickness_m = 0.01; },
                        [](FlowSettings& f) { f.core.size_m.x *= 1.1; },
                        [](FlowSettings& f) { f.core.start_m += 0.1; },
                        [](FlowSettings& f) { f.core.growth = 1.2; },
                        [](FlowSettings& f) { f.core.off_axis = 0.25; },
                        [](FlowSettings& f) { f.convection = Convection::upwind; },
                        [](FlowSettings& f) { f.sides = Sides::slip; },
                        [](FlowSettings& f) { f.outlet = Outlet::fixed_pressure; },
                        [](FlowSettings& f) { f.residual *= 2; },
                        [](FlowSettings& f) { f.max_iterations += 1; },
                        [](FlowSettings& f) { f.average_over += 1; }};
  for (const Edit edit : edits) {
    FlowSettings other = flow;
    edit(other);
    EXPECT_FALSE(same_flow(flow, other)) << &edit - edits;
    EXPECT_FALSE(same_flow(other, flow)) << &edit - edits;
  }
}

TEST(SameFlow, LetsTheCanopyMoveAndTheAirChangeWhereTheEngineScalesIt) {
  FlowSettings builtin = resolve(parse_case(short_case, "a.toml")).flow(), openfoam = builtin;
  openfoam.engine = "openfoam";
  ASSERT_TRUE(engine_of("builtin").can.other_air && !engine_of("openfoam").can.other_air);
  const Edit free[] = {[](FlowSettings& f) { f.canopy_position_m += 0.1; },
                       [](FlowSettings& f) { f.unsteady = true; },
                       [](FlowSettings& f) { f.watch.longest += 1; }};
  const Edit of_air[] = {[](FlowSettings& f) { f.speed_m_s += 1; },
                         [](FlowSettings& f) { f.nominal_speed_m_s += 1; },
                         [](FlowSettings& f) { f.speed_basis = SpeedBasis::measured; },
                         [](FlowSettings& f) { f.height_m = 100; },
                         [](FlowSettings& f) { f.density_kg_m3 += 0.1; },
                         [](FlowSettings& f) { f.viscosity_pa_s *= 2; },
                         [](FlowSettings& f) { f.temperature_k += 1; },
                         [](FlowSettings& f) { f.turbulence_intensity *= 2; },
                         [](FlowSettings& f) { f.viscosity_ratio *= 2; }};
  const auto same_after = [](const FlowSettings& flow, Edit edit) {
    FlowSettings other = flow;
    edit(other);
    return same_flow(flow, other);
  };
  for (const Edit edit : free)
    EXPECT_TRUE(same_after(builtin, edit) && same_after(openfoam, edit)) << &edit - free;
  for (const Edit edit : of_air) {
    EXPECT_TRUE(same_after(builtin, edit)) << &edit - of_air;
    EXPECT_FALSE(same_after(openfoam, edit)) << &edit - of_air;
  }
}

// Few gores are wide when they lie flat: the default core is exactly as wide as the canopy, and may be rounded down.
TEST(Settings, DefaultCoreContainsCanopiesOfThreeAndFourGores) {
  for (const int gores : {3, 4})
    for (int i = 0; i < 100; ++i) {
      const double diameter = 2 + 0.01 * i;
      std::string text =
          replaced(short_case, "gores = 12", fmt::format("gores = {}\nvent_lines = false", gores));
      text = replaced(text, "count = 12", fmt::format("count = {}", gores));
      text = replaced(text, "nominal_diameter_m = 3.0", fmt::format("nominal_diameter_m = {:g}", diameter));
      EXPECT_EQ(outcome_of(text).message, "") << gores << " gores, " << diameter << " m";
    }
}

}  // namespace
}  // namespace ripstop

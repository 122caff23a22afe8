// Angles as text, trim angles, the flow about a canopy at an angle, and the signs of the coefficients.
#include "ripstop/run/stability/stability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ripstop/core/error.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/extent.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

constexpr double pi = 3.14159265358979;

std::string refusal_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  return "accepted";
}

TEST(StabilityAngles, AreARangeWithItsEndOrOneAngle) {
  EXPECT_EQ(angles_of_text("0:40:5"), (std::vector<double>{0, 5, 10, 15, 20, 25, 30, 35, 40}));
  EXPECT_EQ(angles_of_text("20"), std::vector<double>{20});
  EXPECT_EQ(angles_of_text("5:5:1"), std::vector<double>{5});
  EXPECT_EQ(angles_of_text("0:10:4"), (std::vector<double>{0, 4, 8}));
  EXPECT_EQ(angles_of_text("0:0.3:0.1").size(), 4u);
}

TEST(StabilityAngles, RejectsARangeThatDoesNotRiseWithItsValue) {
  const std::pair<const char*, const char*> refused[] = {
      {"", "not a number"},       {"a:b:c", "\"a\""},        {"0:40", "2 numbers"},
      {"0:40:5:1", "4 numbers"},  {"0:40:0", "a step of 0"}, {"0:40:-5", "step of -5"},
      {"40:0:5", "down to 0"},    {"-5:40:5", "-5 degrees"}, {"0:95:5", "95 degrees"},
      {"0:90:0.01", "at most"},   {"0:nan:5", "\"nan\""},    {"0:1e999:5", "1e999"},
      {"0:40:5 ", "not a number"}};
  for (const auto& [text, word] : refused) {
    const std::string why = refusal_of([&, t = text] { angles_of_text(t); });
    EXPECT_NE(why.find(word), std::string::npos) << text << ": " << why;
    EXPECT_NE(why.find("--angles"), std::string::npos) << why;
  }
}

TEST(StabilityCases, RejectsFlowsThatAStreamAtAnAngleCannotHave) {
  const Case good = checked(flat_circular_case(1, 800, 20));
  EXPECT_EQ(stability_cases(good, {0, 10}).at(1).flow().angle_of_attack_deg, 10);
  const auto why = [&](auto edit) {
    Case bad = good;
    edit(bad.flow);
    return refusal_of([&] { stability_cases(bad, {0}); });
  };
  EXPECT_NE(why([](FlowKeys& f) { f.angle_of_attack_deg = 3; }).find("angle_of_attack_deg"),
            std::string::npos);
  EXPECT_NE(why([](FlowKeys& f) { f.sides = Sides::slip; }).find("flow.sides"), std::string::npos);
  EXPECT_NE(why([](FlowKeys& f) { f.porosity_model = PorosityModel::paper; }).find("\"sheet\""),
            std::string::npos);
  EXPECT_NE(why([](FlowKeys& f) {
              f.tunnel.kind = TunnelKind::open_jet;
              f.tunnel.width_m = 2;
            }).find("flow.tunnel.kind"),
            std::string::npos);
}

StabilityRow row_at(double angle, double c_m, double error = 0.001) {
  StabilityRow row;
  row.angle = angle, row.c_m = c_m, row.c_m_error = error;
  return row;
}

TEST(Trims, OfAnUnstableAxisIsWhereTheMomentFallsThroughZero) {
  const auto trims = trims_of({row_at(0, 0.002), row_at(10, 0.02), row_at(20, 0.01), row_at(30, -0.03)});
  ASSERT_EQ(trims.size(), 2u);
  EXPECT_EQ(trims[0].angle, 0);
  EXPECT_FALSE(trims[0].stable);
  EXPECT_TRUE(trims[0].certain);
  EXPECT_FALSE(trims[0].standard_error.has_value());
  EXPECT_NEAR(trims[1].angle, 22.5, 1e-12);
  EXPECT_TRUE(trims[1].stable);
  EXPECT_TRUE(trims[1].certain);
  // Of both rows by their weights, over the slope of 0.004 a degree.
  EXPECT_NEAR(*trims[1].standard_error, std::hypot(0.75, 0.25) * 0.001 / 0.004, 1e-12);
}

TEST(Trims, OfAStableAxisIsTheAxis) {
  const auto trims = trims_of({row_at(0, 0.001), row_at(10, -0.02), row_at(20, -0.05)});
  ASSERT_EQ(trims.size(), 1u);
  EXPECT_TRUE(trims[0].stable);
}

TEST(Trims, AreUncertainWithinTwoStandardErrorsOfZero) {
  const auto trims = trims_of({row_at(10, 0.0015), row_at(20, -0.01)});
  ASSERT_EQ(trims.size(), 1u);
  EXPECT_FALSE(trims[0].certain);
  EXPECT_TRUE(trims_of({row_at(10, 0.1), row_at(20, 0.2)}).empty());
  EXPECT_TRUE(trims_of({row_at(0, 0.1)}).empty());
}

/// A disk of 1 m normal to z at the origin, cut to the part with x above `from`, its confluence 1 m before it.
FlowProblem part_of_disk(double angle, double from) {
  FlowProblem problem;
  problem.grid = {{-2, -2, -2}, {4, 4, 4}, 20, 20, 20};
  problem.air.velocity = 20 * wind_direction(angle);
  problem.sides = Sides::far_field;
  std::vector<Triangle> surface;
  for (const Triangle& t : disk(1, {}))
    if (t.a.x + t.b.x + t.c.x > 3 * from) surface.push_back(t);
  problem.bodies = {sheet_body(surface, {0, 1.2})};
  problem.bodies[0].moment_about = {0, 0, -1};
  return problem;
}

StabilityRow in_time(const FlowProblem& problem, double angle) {
  CartesianSettings settings;
  settings.threads = 1;
  const auto engine = make_cartesian(settings);
  const auto flow = engine->start(problem);
  FlowRecord record;
  watch(*flow, problem, {.standard_error = 0.1, .shortest = 4, .longest = 8, .length = 1}, record);
  return row_of_record(record, problem, angle, {1.2, pi / 4, 1});
}

TEST(StabilityRow, OfAFlatDiskHasAForceAlongTheAxisAndNoMomentAboutAPointOnIt) {
  const StabilityRow row = in_time(part_of_disk(30, -9), 30);
  EXPECT_EQ(row.angle, 30);
  EXPECT_GT(row.c_t, 0.3);
  EXPECT_NEAR(row.c_n, 0, 1e-9 * row.c_t);
  // The pressure is higher on the edge that the stream meets first, so that the moment is small and not 0.
  EXPECT_LT(std::abs(row.c_m), 0.1 * row.c_t);
  EXPECT_NEAR(row.c_d, row.c_t * std::cos(pi / 6), 1e-9);
  EXPECT_NEAR(row.c_l, row.c_t * std::sin(pi / 6), 1e-9);
}

// Half the disk, on the side of positive x: its force along the axis acts at about 0.2 m from it, and lifts this
// side. The stream comes towards positive x, so that the axis turns away from it: the angle increases.
TEST(StabilityRow, OfHalfADiskOnTheLeeSideHasAMomentThatIncreasesTheAngle) {
  const StabilityRow row = in_time(part_of_disk(20, 0), 20);
  EXPECT_NEAR(row.c_m, 0.2 * row.c_t, 0.1 * row.c_t);
  EXPECT_NEAR(row.c_n, 0, 1e-9 * row.c_t);
}

TEST(TurnStream, KeepsAUniformStreamUniform) {
  FlowProblem problem;
  problem.grid = {{-2, -2, -2}, {4, 4, 4}, 12, 12, 12};
  problem.air.velocity = 20 * wind_direction(0);
  problem.sides = Sides::far_field;
  CartesianSettings settings;
  settings.threads = 1;
  const auto engine = make_cartesian(settings);
  const auto flow = engine->start(problem);
  const Vec3 to = 20 * wind_direction(10);
  turn_stream(*flow, problem.air.velocity, to, 1, 0.7);
  for (const Vec3& u : flow->field().velocity) ASSERT_LT(norm(u - to), 1e-9);
}

TEST(StabilityFlow, ContainsTheCanopyInCellsOfTheAskedWidthAndItsWakeAtTheWidestAngle) {
  const Settings resolved = resolve(checked(flat_circular_case(1, 800, 20)));
  RigidCanopy canopy;
  canopy.surface = hemispherical_cup(0.7, {0, 0, 3});
  canopy.width = 0.7, canopy.confluence = {0, 0, 2};
  const FlowProblem problem = stability_flow(resolved, canopy, 12, 40);
  EXPECT_EQ(problem.sides, Sides::far_field);
  EXPECT_EQ(problem.bodies.at(0).moment_about.z, 2);
  EXPECT_TRUE(problem.bodies.at(0).is_sheet());
  const Vec3 wake = Vec3{0, 0, 3} + 0.7 * wind_direction(40);
  for (const Vec3& inside : {Vec3{-0.35, -0.35, 3}, Vec3{0.35, 0.35, 3.3}, wake}) {
    const Vec3 cell = problem.grid.spacing(inside);
    for (const double width : {cell.x, cell.y, cell.z}) EXPECT_NEAR(width, 0.7 / 12, 0.03 * 0.7 / 12);
  }
  // The same cells serve every angle.
  const Settings turned = edited(resolved, [](Case& c) { c.flow.angle_of_attack_deg = 40; });
  EXPECT_EQ(stability_flow(turned, canopy, 12, 40).grid, problem.grid);
  EXPECT_NEAR(stability_flow(turned, canopy, 12, 40).air.velocity.x, 20 * std::sin(40 * pi / 180), 1e-12);
}

TEST(StabilityFlow, ContainsBodiesWithRoomUpstreamOfThemAtEveryAngle) {
  Case given = flat_circular_case(1, 800, 20);
  given.bodies["rocket"].shape = CylinderKeys{0.2, 1, 0};
  given.bodies["rocket"].trailing_distance_m = 1.5;
  const Settings resolved = resolve(checked(given)),
                 turned = edited(resolved, [](Case&c) { c.flow.angle_of_attack_deg = 40; });
  const double skirt = resolved.flow().canopy_position_m, front = skirt - 2.5;
  RigidCanopy canopy;
  canopy.surface = hemispherical_cup(0.7, {0, 0, skirt});
  canopy.width = 0.7, canopy.confluence = {0, 0, skirt - 1};
  const FlowProblem problem = stability_flow(resolved, canopy, 12, 40);
  ASSERT_EQ(problem.bodies.size(), 2u);
  EXPECT_EQ(problem.bodies[1].name, "rocket");
  EXPECT_NEAR(problem.grid.origin.z, front - 4 * 0.2, 1e-9);
  for (const double z : {front - 0.05, front + 0.5, skirt - 0.8})
    EXPECT_NEAR(problem.grid.spacing({0, 0, z}).z, 0.7 / 12, 0.05 * 0.7 / 12) << z;
  const FlowProblem at_angle = stability_flow(turned, canopy, 12, 40);
  EXPECT_EQ(at_angle.grid, problem.grid);
  EXPECT_EQ(extent_of(at_angle.bodies[1].surface).low, extent_of(problem.bodies[1].surface).low)
      << "at rest with the canopy, the stream turns";
}

TEST(StabilityRow, HasTheLoadsOnBodiesApartFromTheCoefficientsOfTheCanopy) {
  FlowProblem problem = part_of_disk(30, -9);
  FlowRecord record;
  for (int n = 1; n <= 40; ++n) {
    FlowStep step;
    step.length = 0.1, step.time = 0.1 * n;
    step.bodies = {{{0, 0, 50 + std::sin(n)}, {}}, {{2, 0, 3 + std::cos(n)}, {0, 0.5, 0}}};
    step.force = step.bodies[0].force + step.bodies[1].force;
    record.steps.push_back(step);
  }
  const StabilityRow alone = row_of_record(record, problem, 30, {1.2, pi / 4, 1});
  EXPECT_FALSE(alone.bodies);
  problem.bodies.push_back(sheet_body(block({0.2, 0.2, 0.2}, {0, 0, -1}), impermeable, "rocket"));
  const StabilityRow row = row_of_record(record, problem, 30, {1.2, pi / 4, 1});
  EXPECT_EQ(row.c_t, alone.c_t);
  ASSERT_TRUE(row.bodies);
  const StabilityBody& rocket = row.bodies->at(0);
  EXPECT_EQ(rocket.name, "rocket");
  EXPECT_NEAR(rocket.force.x, 2, 1e-9);
  EXPECT_NEAR(rocket.force.z, 3, 0.1);
  EXPECT_NEAR(rocket.moment.y, 0.5, 1e-9);
  EXPECT_NEAR(rocket.drag, 2 * std::sin(pi / 6) + rocket.force.z * std::cos(pi / 6), 1e-9);
  EXPECT_GT(rocket.standard_error.value(), 0);
  // A row is a row of the table, without the bodies.
  EXPECT_EQ(row_of(row).size(), columns_of<StabilityRow>().size());
  EXPECT_EQ(columns_of<StabilityRow>().back(), "mass_defect");
}

// Behind a block on the axis a disk has less drag, and on the axis neither has a moment.
TEST(StabilityRow, OfADiskBehindABlockHasLessForceAlongTheAxis) {
  FlowProblem problem = part_of_disk(0, -9);
  const StabilityRow alone = in_time(problem, 0);
  problem.bodies.push_back(sheet_body(block({0.6, 0.6, 0.4}, {0, 0, -0.8}), impermeable, "block"));
  const StabilityRow behind = in_time(problem, 0);
  EXPECT_LT(behind.c_t, 0.8 * alone.c_t);
  EXPECT_GT(behind.bodies.value().at(0).drag, 0);
}

}  // namespace
}  // namespace ripstop

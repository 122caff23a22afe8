// [deployment]: what an empty table means, and what is refused.
#include "fixture.h"
#include "ripstop/case/deployment.h"
#include "ripstop/case/opening.h"

namespace ripstop {
namespace {

std::string with_deployment(const std::string& keys) {
  return std::string(valid_case) + "\n[inflation]\nair = \"coupled\"\n\n[deployment]\n" + keys;
}

Settings resolved_opening(const std::string& keys) {
  return resolve(opening_case(parse_case(with_deployment(keys), "case.toml")));
}

TEST(DeploymentKeys, EmptyTableHasUsualValues) {
  const Settings resolved = resolved_opening("");
  ASSERT_TRUE(resolved.deployment());
  const PackedParachute packed = packed_parachute(resolved);
  EXPECT_TRUE(packed.lines_first);
  EXPECT_GT(packed.bag_mass, 0);
  EXPECT_NEAR(packed.bag_drag_area, 0.015 * nominal_area(resolved.parachute()), 0.5 * packed.bag_drag_area);
  EXPECT_EQ(packed.relative_speed, 0);
  EXPECT_GT(packed.strip_force, 0);
  ASSERT_TRUE(resolved.inflation().initial_radius_m);
  EXPECT_LT(*resolved.inflation().initial_radius_m, 0.1 * nominal_diameter(resolved.parachute()));
  const auto deployment = deployment_of(resolved);
  ASSERT_TRUE(deployment);
  EXPECT_FALSE(deployment->stopped) << *deployment->stopped;
}

TEST(DeploymentKeys, CaseWithoutTheTableHasNoDeploymentAndWritesNone) {
  const Settings resolved = resolve(parse_case(valid_case, "case.toml"));
  EXPECT_FALSE(resolved.deployment());
  EXPECT_EQ(case_toml(resolved).find("[deployment]"), std::string::npos);
  EXPECT_FALSE(deployment_of(resolved));
}

TEST(DeploymentKeys, WrittenCaseReadsBackWithItsTable) {
  const Settings resolved = resolve(parse_case(with_deployment("strip_force_n = 7"), "case.toml"));
  const std::string text = case_toml(resolved);
  EXPECT_NE(text.find("[deployment]"), std::string::npos);
  EXPECT_EQ(case_toml(resolve(parse_case(text, "again.toml"))), text);
}

TEST(DeploymentKeys, EjectionImpulseIsSharedByPayloadAndParachute) {
  const Settings resolved = resolved_opening("ejection_impulse_n_s = 2");
  const PackedParachute packed = packed_parachute(resolved);
  EXPECT_NEAR(packed.relative_speed, 2 / (packed.bag_mass + packed.canopy_mass + packed.lines_mass), 1e-9);
}

TEST(DeploymentKeys, RejectsTwoWaysToGiveOneSpeed) {
  const Outcome outcome = outcome_of(with_deployment("ejection_impulse_n_s = 2\nrelative_speed_m_s = 3"));
  ASSERT_EQ(outcome.problems.size(), 1u) << outcome.message;
  EXPECT_EQ(outcome.problems[0].key, "deployment.ejection_impulse_n_s");
}

TEST(DeploymentKeys, RejectsAContainerLongerThanTheLines) {
  const Settings resolved = resolved_opening("length_m = 90");
  try {
    packed_parachute(resolved);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("deployment.length_m"), std::string::npos) << error.what();
  }
}

TEST(DeploymentKeys, CanopyThatIsNeverPulledOutIsAnErrorThatNamesTheKey) {
  const Settings resolved = resolved_opening("strip_force_n = 50000");
  try {
    opening_problem(resolved, load_source(resolved), 1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("deployment.strip_force_n"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace ripstop

#include "ripstop/run/sizing/check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "ripstop/case/case.h"
#include "ripstop/case/resolve.h"
#include "ripstop/run/opening/load.h"
#include "tests/refusal.h"

namespace ripstop {
namespace {

bool warns_of_opening(const CheckResult& result) {
  return std::any_of(result.warnings.begin(), result.warnings.end(), [](const std::string& text) {
    return text.starts_with("in an opening at ") && text.find("margin of safety") != std::string::npos;
  });
}

TEST(Check, RefusesARiserThatPassesThroughABody) {
  Case given = read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/wake/case.toml");
  EXPECT_NO_THROW(run_check(resolve(given)));
  given.bodies.at("rocket").trailing_distance_m = 1;
  const std::string message = refusal_of([&] { run_check(resolve(given)); }, ExitCode::usage);
  EXPECT_NE(message.find("pass through the body \"rocket\""), std::string::npos) << message;
}

TEST(CheckMargins, OfMembersThatTheOpeningBreaksAreWarnings) {
  Case given = read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/flat-circular/case.toml");
  given.payload.mass_kg.reset();
  given.flow.speed_m_s = 5;
  EXPECT_FALSE(warns_of_opening(run_check(resolve(given))));
  given.flow.speed_m_s = 90;
  EXPECT_TRUE(warns_of_opening(run_check(resolve(given))));
}

TEST(CheckMargins, AreThoseAtTheDeploymentSpeedOfThePayload) {
  Case given = read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/flat-circular/case.toml");
  given.payload.mass_kg = 3, given.flow.speed_m_s = 5;
  EXPECT_FALSE(warns_of_opening(run_check(resolve(given))));
  given.payload.deployment_speed_m_s = 90;
  const CheckResult checked = run_check(resolve(given));
  EXPECT_EQ(checked.summary.deployment.speed, 90);
  const std::vector<std::string>& warnings = checked.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& text) {
    return text.starts_with("in an opening at 90 m/s (payload.deployment_speed_m_s of the case)");
  }));
}

TEST(CheckMargins, AHeavyPayloadIsWarnedOfAsInTheLoadCommand) {
  Case given = read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/flat-circular/case.toml");
  given.payload.deployment_speed_m_s = 20;
  for (const double mass : {0.2, 60.0}) {
    given.payload.mass_kg = mass;
    LoadRequest asked;
    asked.payload_mass = mass, asked.speed = 20, asked.path_angle = 0;
    const std::string caution = run_load(resolve(given), asked).design_load_caution;
    EXPECT_EQ(caution.empty(), mass < 1) << caution;
    const std::vector<std::string> warnings = run_check(resolve(given)).warnings;
    EXPECT_EQ(std::any_of(warnings.begin(), warnings.end(),
                          [](const std::string& text) {
                            return text.find("the payload is heavy for this canopy") != text.npos;
                          }),
              mass > 1);
  }
}

// Parts that carry the load and not its uncertainty fail by both commands, each with its own warning.
TEST(CheckMargins, AreThoseOfTheLoadCommandUnderTheHighestDesignLoad) {
  Case given = read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/flat-circular/case.toml");
  given.payload.mass_kg = 3, given.payload.deployment_speed_m_s = 20;
  LoadRequest asked;
  asked.payload_mass = 3, asked.speed = 20;
  const LoadResult free = run_load(resolve(given), asked);
  const auto warned = [](const std::vector<std::string>& warnings, const std::string& part) {
    return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& text) {
      return text.find(part + " exceeds its allowable load") != std::string::npos;
    });
  };
  for (const double share : {0.99, 1.01}) {
    for (const char* part : {"link", "swivel"})
      given.hardware[part].rated_load_n = share * free.highest_design_load;
    ASSERT_GT(*given.hardware["link"].rated_load_n, free.design_load);
    const std::vector<std::string> load = run_load(resolve(given), asked).warnings,
                                   check = run_check(resolve(given)).warnings;
    for (const char* part : {"link", "swivel"}) {
      EXPECT_EQ(warned(load, part), share < 1) << part << share;
      EXPECT_EQ(warned(check, part), share < 1) << part << share;
    }
  }
}

}  // namespace
}  // namespace ripstop

// One parachute has one mass: in pattern, flight, summary, loads and export.
#include <gtest/gtest.h>

#include "ripstop/case/payload.h"
#include "ripstop/case/summary.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/run/opening/load.h"
#include "ripstop/run/sizing/pattern.h"
#include "ripstop/run/sizing/size.h"

namespace ripstop {
namespace {

void expect_one_mass(const Case& given, const std::string& name) {
  const PatternResult pattern = run_pattern(resolve(given), {}, packed_by_hand);
  const double mass = pattern.bill.mass;
  EXPECT_EQ(parachute_mass(resolve(given)), mass) << name;
  EXPECT_NEAR(pattern.bill.packed_volume * packed_by_hand, mass, 1e-12 * mass) << name;
  const PartMasses parts = summarize(resolve(given)).mass;
  EXPECT_EQ(parts.total, mass) << name;
  EXPECT_NEAR(parts.cloth + parts.tape + parts.lines + parts.riser, mass, 1e-12 * mass) << name;
  EXPECT_NEAR(suspended_weight(resolve(given), 2) / standard_gravity, 2 + mass, 1e-12) << name;
  LoadRequest asked;
  asked.payload_mass = 2, asked.speed = 40, asked.drag_coefficient = 0.7, asked.opening_coefficient = 1.5;
  EXPECT_EQ(run_load(resolve(given), asked).parachute_mass, mass) << name;
}

TEST(OneMass, OfEveryExample) {
  int examples = 0;
  const auto folder = std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto file = entry.path() / "case.toml";
    if (!std::filesystem::exists(file)) continue;
    Overrides coarse;
    coarse.set.push_back({"parachute.mesh.cloth_nodes", "2000", ""});
    expect_one_mass(read_case(file, coarse), entry.path().filename());
    ++examples;
  }
  EXPECT_GE(examples, 10);
}

// 7.6 g were printed, 14.7 g cut and packed.
TEST(OneMass, OfASizedParachuteOfEveryFamily) {
  for (const FamilyDrag& drag : family_drags())
    for (const double payload : {0.05, 2.4}) {
      SizeRequest asked;
      asked.payload_mass = payload, asked.descent_rate = 5, asked.family = drag.family;
      const SizeResult r = run_size(asked);
      EXPECT_EQ(r.parachute_mass, run_pattern(resolve(r.given), {}, 400).bill.mass)
          << drag.family << " " << payload;
      EXPECT_NEAR(r.packed_volume * asked.packing_density, r.parachute_mass, 1e-12) << drag.family;
    }
}

}  // namespace
}  // namespace ripstop

#include "ripstop/canopy/margins.h"

#include <gtest/gtest.h>

#include "ripstop/canopy/stress.h"

namespace ripstop {
namespace {

struct Materials {
  Fabric cloth;
  Tape tape;
  Line line, riser;
  Materials() {
    cloth.break_load_n_m = 8000;
    tape.coefficients_n_m = {3000, 60000};
    tape.width_m = 0.02;
    tape.tested_strain = 0.2;
    line.break_load_n = 1800;
    riser.coefficients_n = {200000, 500000};
    riser.tested_strain = 0.04;
  }
};
const MarginFactors none{1, 1, 1, 1, 1, 1, 1};

TEST(Margins, WithoutFactorsAreBreakLoadOverLoad) {
  const Materials m;
  const Margins margins = margins_of({2000, 20, {300, 600}, 900}, none, m.cloth, &m.tape, m.line, m.riser);
  ASSERT_EQ(margins.members.size(), 5u);
  EXPECT_DOUBLE_EQ(*margins.members[0].used, 0.25);
  EXPECT_NEAR(*margins.members[1].strength, 0.02 * (3000 * 0.2 + 60000 * 0.04), 1e-9);
  EXPECT_EQ(margins.members[1].strength_from, "load at the tested strain");
  EXPECT_DOUBLE_EQ(*margins.members[3].margin, 2);
  EXPECT_NEAR(*margins.members[4].strength, 200000 * 0.04 + 500000 * 0.0016, 1e-9);
  EXPECT_EQ(margins.weakest, "tape");
}

TEST(Margins, EveryFactorWeakensItsOwnMembers) {
  const Materials m;
  const MarginFactors f{2, 0.5, 0.8, 0.9, 0.95, 1, 1};
  const Margins margins = margins_of({2000, 20, {300, 600}, 900}, f, m.cloth, &m.tape, m.line, m.riser);
  EXPECT_DOUBLE_EQ(margins.members[0].knock_down, 0.5 * 0.9 * 0.95);
  EXPECT_DOUBLE_EQ(*margins.members[0].used, 2 * 2000 / (8000 * 0.5 * 0.9 * 0.95));
  EXPECT_DOUBLE_EQ(margins.members[2].knock_down, 0.8 * 0.9 * 0.95);
}

TEST(Margins, OfUnknownStrengthAreReportedAndNeverTheWeakest) {
  Materials m;
  m.line.break_load_n = 0;
  const Margins margins = margins_of({1, 0, {5000}, 0}, none, m.cloth, &m.tape, m.line, m.riser);
  ASSERT_EQ(margins.members.size(), 2u);  // no tape that pulls, no riser
  EXPECT_FALSE(margins.members[1].used);
  EXPECT_NE(margins.members[1].strength_from.find("not known"), std::string::npos);
  EXPECT_EQ(margins.weakest, "cloth");
  m.cloth.break_load_n_m = 0;
  EXPECT_EQ(margins_of({1, 0, {5000}, 0}, none, m.cloth, &m.tape, m.line, m.riser).weakest, "");
}

TEST(Margins, TheWeakestFollowsAChangeOfTheMembers) {
  const Materials m;
  Margins margins = margins_of({2000, 20, {300, 600}, 900}, none, m.cloth, &m.tape, m.line, m.riser);
  std::erase_if(margins.members, [](const Margin& one) { return one.member == "tape"; });
  take_weakest(margins);
  EXPECT_EQ(margins.weakest, "line 2");
  margins.members.clear();
  take_weakest(margins);
  EXPECT_EQ(margins.weakest, "");
}

TEST(Margins, OfATapeAreOnItsBreakLoadWhereItHasOne) {
  Materials m;
  m.tape.break_load_n = 200;
  const Margins margins = margins_of({1, 20, {}, 0}, none, m.cloth, &m.tape, m.line, m.riser);
  EXPECT_DOUBLE_EQ(*margins.members.at(1).used, 0.1);
  EXPECT_EQ(margins.members[1].strength_from, "breaking load");
  EXPECT_EQ(margins_of({1, 20, {}, 0}, none, m.cloth, nullptr, m.line, m.riser).members.size(), 1u);
}

TEST(Margins, HardwareCarriesTheRisersLoadByItsOwnStrength) {
  const Materials m;
  HardwareParts parts;
  parts["link"].rated_load_n = 1000;
  parts["swivel"].breaking_load_n = 4000;
  parts["cord"].kind = Hardware::Kind::textile, parts["cord"].breaking_load_n = 2500,
  parts["cord"].strands = 2;
  const MarginFactors f{2, 0.5, 0.8, 0.9, 1, 1, 1};
  MemberLoads loads;
  loads.hardware = 900;
  const Margins margins = margins_of(loads, f, m.cloth, nullptr, m.line, m.riser, parts);
  ASSERT_EQ(margins.members.size(), 4u);  // after the cloth, by name
  EXPECT_EQ(margins.members[1].member, "cord");
  EXPECT_DOUBLE_EQ(*margins.members[1].used, 2 * 900 / (2 * 2500 * 0.8 * 0.9));
  EXPECT_DOUBLE_EQ(*margins.members[2].used, 0.9);  // a rated load has its own safety factor
  EXPECT_DOUBLE_EQ(*margins.members[3].used, 2 * 900 / 4000.0);
  EXPECT_EQ(margins.weakest, "link");
}

TEST(Margins, HardwareOfTheRequiredStrengthIsUsedExactly) {
  const Materials m;
  const MarginFactors f{2, 0.5, 0.8, 0.9, 0.95, 1, 1};
  const HardwareNeed need = hardware_need(900, f);
  HardwareParts parts;
  parts["a"].rated_load_n = need.rated;
  parts["b"].breaking_load_n = need.metal;
  parts["c"].kind = Hardware::Kind::textile, parts["c"].breaking_load_n = need.textile;
  MemberLoads loads;
  loads.hardware = 900;
  const Margins margins = margins_of(loads, f, m.cloth, nullptr, m.line, m.riser, parts);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_NEAR(*margins.members[i].used, 1, 1e-12);
}

// A chain of one strain: 0.9 of the law in the axial spring, 0.05 in each of two springs over two.
TEST(Margins, AChainCarriesTheSumOfItsAxialAndBendingSprings) {
  const double axial = 90;
  EXPECT_NEAR(chain_tension(axial, 0.1, 0, 1), 90, 1e-12);  // nothing reaches over a single one
  EXPECT_NEAR(chain_tension(axial, 0.1, 0, 2), 95, 1e-12);
  EXPECT_NEAR(chain_tension(axial, 0.1, 1, 2), 95, 1e-12);
  EXPECT_NEAR(chain_tension(axial, 0.1, 0, 5), 95, 1e-12);
  EXPECT_NEAR(chain_tension(axial, 0.1, 2, 5), 100, 1e-12);
  EXPECT_NEAR(chain_tension(axial, 0.1, 4, 5), 95, 1e-12);
  EXPECT_EQ(chain_tension(axial, 0, 2, 5), 90);
}

}  // namespace
}  // namespace ripstop

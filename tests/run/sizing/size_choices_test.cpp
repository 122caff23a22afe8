// Choices of `size`, and the text of its case file.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ripstop/case/payload.h"
#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/material/library.h"
#include "ripstop/run/opening/fastest.h"
#include "ripstop/run/sizing/size.h"

namespace ripstop {
namespace {

SizeRequest wanted(double payload = 2.4, double rate = 5) {
  SizeRequest r;
  r.payload_mass = payload, r.descent_rate = rate, r.height = 300;
  return r;
}

TEST(SizeChoices, EveryNumberIsThatOfTheParachuteOfItsCase) {
  const SizeResult r = run_size(wanted());
  const Design& design = r.given.parachute;
  EXPECT_EQ(r.family, "flat-circular");
  EXPECT_EQ(r.type, design.canopy.family().type);
  EXPECT_EQ(r.payload_mass, 2.4);
  EXPECT_EQ(r.descent_rate, 5);
  EXPECT_EQ(r.height, 300);
  EXPECT_EQ(r.density, standard_air(300).density);
  EXPECT_EQ(r.nominal_area, nominal_area(design));
  EXPECT_EQ(r.nominal_diameter, nominal_diameter(design));
  EXPECT_EQ(r.vent_area, facts(design).vent_area);
  EXPECT_GT(r.vent_area, 0);
  EXPECT_EQ(r.gores, design.gores);
  EXPECT_EQ(r.line_count, design.lines.count);
  EXPECT_EQ(r.line_length, design.lines.length_m);
  EXPECT_EQ(r.line_material, design.lines.material);
  EXPECT_EQ(r.canopy_material, design.canopy_material);
  EXPECT_EQ(r.deployment_speed, 20);
  EXPECT_EQ(run_size(wanted(2.4, 8)).deployment_speed, 24);
  EXPECT_TRUE(r.warnings.empty());
  EXPECT_TRUE(r.checks.empty());
  EXPECT_LE(r.opening_load_low, r.opening_load);
  const FamilyDrag drag = family_drags().front();
  EXPECT_GT(drag.speed, 0);
  EXPECT_GT(drag.density, 0);
  EXPECT_NE(drag.made.find(", "), std::string::npos) << drag.made;
}

TEST(SizeChoices, TheLineIsTheLightestOfSufficientStrength) {
  SizeRequest asked = wanted(60, 6);
  asked.deployment_speed = 30;
  const SizeResult light = run_size(wanted()), heavy = run_size(asked);
  const auto density = [](const std::string& name) {
    return std::get<Line>(library_material(name)).linear_density_kg_m;
  };
  EXPECT_LE(density(light.line_material), density(heavy.line_material));
  EXPECT_NE(light.line_material, heavy.line_material);
  const double allowed = heavy.line_used;
  EXPECT_LE(allowed, 1);
  for (const std::string& name : library_names()) {
    const Material material = library_material(name);
    const Line* line = std::get_if<Line>(&material);
    if (!line || line->linear_density_kg_m >= density(heavy.line_material)) continue;
    asked.line_material = name;
    const SizeResult with = run_size(asked);
    EXPECT_EQ(with.line_material, name);
    EXPECT_GT(with.line_used, 1) << name << " holds and is lighter";
  }
}

// 2 g/m of polyethylene bear 3.2 kN, not the 9.3 kN of their stiffness at 4 % strain.
TEST(SizeChoices, AStrongerLineIsPreferredWhereTheLineOf2GramsAMetreIsTooWeak) {
  SizeRequest asked = wanted(22, 6);
  asked.deployment_speed = 28;
  const SizeResult usual = run_size(asked);
  EXPECT_EQ(usual.line_material, "spectra-line");
  const double allowed = 3180 * 0.8 * 0.95 * 0.95 * 0.95;
  EXPECT_NEAR(usual.line_used,
              1.5 * usual.line_load_factor * usual.highest_design_load / usual.line_count / allowed, 1e-9);
  asked.deployment_speed = 36;
  const SizeResult fast = run_size(asked);
  EXPECT_EQ(fast.line_material, "spectra-line-1000-lbf");
  asked.line_material = "spectra-line";
  EXPECT_GT(run_size(asked).line_used, 1);
}

// `size` and `load --fastest` apply the same uncertainty of the load.
TEST(SizeChoices, TheFastestSafeDeploymentAllowsTheDeploymentSpeedOfEverySizedParachute) {
  constexpr double tolerance = 1e-3;  // of the search for that speed
  int hems = 0, tapes = 0;
  for (const FamilyDrag& drag : family_drags())
    for (const auto& [mass, speed] : {std::pair(0.3, 20.0), std::pair(2.4, 20.0), std::pair(22.0, 45.0)}) {
      SCOPED_TRACE(fmt::format("{}, {} kg, {} m/s", drag.family, mass, speed));
      SizeRequest asked = wanted(mass);
      asked.family = drag.family, asked.deployment_speed = speed;
      const SizeResult r = run_size(asked);
      for (const std::string& text : r.warnings)
        EXPECT_EQ(text.find("the payload is heavy for this canopy"), 0u) << text;
      LoadRequest load;
      load.payload_mass = mass;
      const FastestResult fastest = run_fastest(resolve(parse_case(r.case_text, "the sized case")), load);
      EXPECT_EQ(fastest.load_uncertainty, r.load_uncertainty);
      ASSERT_FALSE(fastest.design().unsafe_at);
      EXPECT_GE(fastest.design().lowest.value_or(fastest_deployment), (1 - tolerance) * speed);
      EXPECT_GE(r.smallest_margin.value_or(-1), 0);
      EXPECT_EQ(r.smallest_margin_member, fastest.design().member);
      ++(r.tape_material == "none" ? hems : tapes);
    }
  EXPECT_GT(hems, 0);
  EXPECT_GT(tapes, 0);
}

// A line whose margin is above 0 under the design load and below 0 with the uncertainty of the load.
TEST(SizeChoices, AMarginThatTheUncertaintyOfTheLoadUsesUpIsWarnedOf) {
  SizeRequest asked = wanted(22, 6);
  asked.line_material = "spectra-line-400-lbf", asked.deployment_speed = 26.5;
  const SizeResult r = run_size(asked);
  const double u = std::hypot(0.1, 0.15);
  EXPECT_NEAR(r.load_uncertainty, u, 1e-12);
  EXPECT_NEAR(r.highest_design_load / r.design_load, 1 + u, 1e-12);
  const Margin* weak = weakest(*r.margins);
  ASSERT_TRUE(weak);
  EXPECT_EQ(weak->member, "line");
  EXPECT_GT(*weak->margin, 0);
  EXPECT_NEAR(*r.smallest_margin, (1 + *weak->margin) / (1 + u) - 1, 1e-9);
  ASSERT_TRUE(r.highest_margins);
  EXPECT_EQ(*weakest(*r.highest_margins)->margin, *r.smallest_margin);
  EXPECT_EQ(r.highest_margins->weakest, r.smallest_margin_member);
  EXPECT_LT(*r.smallest_margin, 0);
  ASSERT_EQ(r.warnings.size(), 1u);
  EXPECT_TRUE(r.warnings[0].starts_with("line exceeds its allowable load")) << r.warnings[0];
  EXPECT_TRUE(r.warnings[0].ends_with("which contains the uncertainty of 18 %")) << r.warnings[0];
  LoadRequest load;
  load.payload_mass = 22;
  const SafeSpeed safe = run_fastest(resolve(parse_case(r.case_text, "the sized case")), load).design();
  EXPECT_GT(*safe.speed, 26.5);
  EXPECT_LT(*safe.lowest, 26.5);
}

TEST(SizeChoices, WithoutASufficientLineTheStrongestIsUsedWithAWarning) {
  SizeRequest asked = wanted(20000, 20);
  asked.deployment_speed = 250;
  const SizeResult r = run_size(asked);
  EXPECT_GT(r.line_used, 1);
  EXPECT_GT(r.tape_used, 1);
  ASSERT_GT(r.warnings.size(), 1u);
  for (const char* member : {"tape", "line"})
    EXPECT_TRUE(std::any_of(r.warnings.begin(), r.warnings.end(), [&](const std::string& text) {
      return text.starts_with(std::string(member) + " exceeds its allowable load");
    })) << member;
}

// 120 kg at 30 m/s: the strongest line and tape of the library do not hold a twelfth of 52 kN.
TEST(SizeChoices, WithoutASufficientLineOrTapeMoreLinesShareTheLoad) {
  for (const char* family : {"flat-circular", "cross", "ringslot"}) {
    SizeRequest asked = wanted(120, 6);
    asked.family = family, asked.deployment_speed = 30;
    const SizeResult r = run_size(asked);
    EXPECT_LE(r.line_used, 1) << family;
    EXPECT_LE(r.tape_used, 1) << family;
    ASSERT_TRUE(r.margins) << family;
    for (const Margin& m : r.margins->members) EXPECT_GE(m.margin.value_or(-1), 0) << family << m.member;
    EXPECT_NO_THROW(resolve(parse_case(r.case_text, "the sized case"))) << family;
  }
  SizeRequest asked = wanted(120, 6);
  asked.deployment_speed = 30;
  const SizeResult r = run_size(asked);
  EXPECT_GT(r.line_count, 12);
  EXPECT_EQ(r.gores, r.line_count);
  EXPECT_NE(r.gores_source, "");
  EXPECT_EQ(run_size(wanted()).gores_source, "");
}

// The parachute is designed for the air in which its rate of descent is required.
TEST(SizeChoices, TheOpeningIsAtTheHeightOfTheRateOfDescent) {
  SizeRequest asked = wanted();
  asked.height = 0;
  const SizeResult r = run_size(asked);
  EXPECT_EQ(r.opening.front().height, 0);
  EXPECT_EQ(run_size(wanted()).opening.front().height, 300);
  EXPECT_EQ(r.opening.front().speed, r.deployment_speed);
}

TEST(SizeChoices, ADensityReplacesAHeight) {
  SizeRequest asked = wanted();
  asked.density = 0.9;
  const SizeResult r = run_size(asked);
  EXPECT_EQ(r.density, 0.9);
  EXPECT_NE(r.case_text.find("\ndensity_kg_m3 = 0.9\n"), std::string::npos) << r.case_text;
  EXPECT_EQ(r.case_text.find("height_m"), std::string::npos);
  const double weight = (2.4 + r.parachute_mass) * standard_gravity;
  EXPECT_NEAR(0.5 * 0.9 * 25 * r.drag_coefficient * r.nominal_area / weight, 1, 2e-3);
  EXPECT_NE(run_size(wanted()).case_text.find("\nheight_m = 300  # above sea level"), std::string::npos);
}

TEST(SizeChoices, ItsCaseFileHasItsNumbersInComments) {
  const SizeResult r = run_size(wanted());
  const std::string& text = r.case_text;
  const auto has = [&](const std::string& what) {
    EXPECT_NE(text.find(what), std::string::npos) << what << "\n" << text;
  };
  ASSERT_TRUE(r.handbook_diameter && r.handbook_drag_coefficient);
  has(fmt::format("# A flat-circular parachute for 2.4 kg at 5 m/s in air of {:.4g} kg/m3", r.density));
  has(fmt::format("# Drag coefficient {:.3f} on S0 = {:.4g} m2: {}.", r.drag_coefficient, r.nominal_area,
                  r.drag_source));
  has(fmt::format("# The handbook has {:.2f} to {:.2f} ", r.handbook_drag_coefficient->at(0),
                  r.handbook_drag_coefficient->at(1)));
  has(fmt::format("  # {:.2f} to {:.2f} for the handbook range of C_D", r.handbook_diameter->at(1),
                  r.handbook_diameter->at(0)));
  has(fmt::format("  # {:.2f} % of the area", 100 * r.vent_area / r.nominal_area));
  has(fmt::format("  # utilisation {:.0f} % under the highest design load", 100 * r.line_used));
  has(fmt::format(
      "# Parachute {:.3g} kg: cloth {:.3g}, tape {:.3g}, lines {:.3g}; packed {:.3g} litres at {:g} kg/m3",
      r.parachute_mass, r.cloth_mass, r.tape_mass, r.line_mass, 1000 * r.packed_volume,
      wanted().packing_density));
  has(fmt::format("# Design load {:.0f} N for a payload of 2.4 kg at 20 m/s: infinite mass", r.design_load));
  has(
      fmt::format("# Highest design load {:.0f} N, with the uncertainty of 18 %: drag area 10 % (axial "
                  "coefficient), scatter",
                  r.highest_design_load));
  has(fmt::format("[inflation]\ndrag_coefficient = {}", r.drag_coefficient));
  has("speed_m_s = 5  # start value of the iteration");
}

// Lengths are rounded to a tenth of a millimetre.
TEST(SizeChoices, EveryLengthOfTheDesignGrowsAndTheMeshesDoNot) {
  Case given = read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml");
  const SizeResult small = run_size(wanted()), large = run_size(wanted(9.6));
  const double factor = large.nominal_diameter / small.nominal_diameter;
  EXPECT_GT(factor, 1.9);
  EXPECT_NEAR(large.line_length / small.line_length, factor, 1e-3);
  EXPECT_NEAR(std::sqrt(large.vent_area / small.vent_area), factor, 1e-2);
  EXPECT_EQ(large.given.parachute.mesh.line_segment_m, small.given.parachute.mesh.line_segment_m);
  EXPECT_NEAR(std::remainder(large.line_length, 1e-4), 0, 1e-9);
}

TEST(SizeChoices, VerifyGivesUpAfterFourRunsAndNamesTheLastRate) {
  const SizeRequest asked = wanted();
  SizeResult r = run_size(asked);
  int runs = 0;
  const auto fly = [&](const Settings&, int) {
    ++runs;
    SteadyResult flown;
    flown.converged = true, flown.drag_coefficient = 0.7, flown.speed = 6;
    return flown;
  };
  try {
    verify_size(asked, r, fly);
    ADD_FAILURE() << "verified";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::not_converged);
    EXPECT_STREQ(error.what(), "--verify: after 4 runs the descent rate is 6 m/s instead of 5");
  }
  EXPECT_EQ(runs, 4);
  ASSERT_EQ(r.checks.size(), 4u);
  EXPECT_EQ(r.checks[0].drag_coefficient, 0.7);
  EXPECT_EQ(r.drag_coefficient, 0.7);
  EXPECT_EQ(r.drag_source, "axial, computed by --verify at the descent rate");
}

TEST(SizeChoices, VerifyIsContentWithinItsTolerance) {
  const SizeRequest asked = wanted();
  SizeResult r = run_size(asked);
  const double diameter = r.nominal_diameter;
  const auto fly = [&](double rate) {
    return [=](const Settings&, int) {
      SteadyResult flown;
      flown.converged = true, flown.drag_coefficient = 0.7, flown.speed = rate;
      return flown;
    };
  };
  verify_size(asked, r, fly(5.1), 0.021);
  EXPECT_EQ(r.nominal_diameter, diameter);
  EXPECT_EQ(r.checks.size(), 1u);
  EXPECT_THROW(verify_size(asked, r, fly(5.1), 0.019), Error);
}

// A coefficient that is too large gives a rate of descent above the required one.
TEST(SizeChoices, TheCoefficientIsTheSmallerOneOfAxialAndFlownUnlessAsked) {
  int axial = 0, flown = 0;
  for (const FamilyDrag& drag : family_drags()) {
    SizeRequest asked;
    asked.payload_mass = 2.4, asked.descent_rate = 5, asked.family = drag.family;
    const SizeResult r = run_size(asked);
    EXPECT_EQ(r.axial_coefficient, drag.drag_coefficient);
    EXPECT_LE(r.drag_coefficient, drag.drag_coefficient) << drag.family;
    ++(r.drag_basis == "axial" ? axial : flown);
    if (r.drag_basis == "descent") {
      ASSERT_TRUE(drag.flown) << drag.family;
      EXPECT_DOUBLE_EQ(r.drag_coefficient, drag.flown->drag_coefficient - 2 * drag.flown->standard_error);
    }
    asked.basis = DragBasis::axial;
    EXPECT_EQ(run_size(asked).drag_coefficient, drag.drag_coefficient);
    asked.basis = DragBasis::descent;
    if (drag.flown) {
      EXPECT_EQ(run_size(asked).drag_coefficient, drag.flown->drag_coefficient);
      EXPECT_EQ(run_size(asked).drag_basis, "descent");
    } else {
      EXPECT_THROW(run_size(asked), Error) << drag.family;
    }
  }
  EXPECT_GT(axial, 0);
  EXPECT_GT(flown, 0) << "the cross";
}

// The standard error of the rate of a flight widens the tolerance.
TEST(SizeChoices, VerifyByFlightsStatesTheCoefficientInDescent) {
  SizeRequest asked;
  asked.payload_mass = 2.4, asked.descent_rate = 5;
  SizeResult r = run_size(asked);
  FlightResult flight;
  flight.descent = 5.2, flight.descent_error = 0.25, flight.coefficient = 0.7;
  verify_size(asked, r, [&](const Settings&, int) { return VerifiedDescent(flight); });
  ASSERT_EQ(r.checks.size(), 1u);
  EXPECT_EQ(r.checks[0].basis, "descent");
  EXPECT_EQ(r.checks[0].descent_rate_error, 0.25);
  flight.coefficient.reset();
  EXPECT_THROW(verify_size(asked, r, [&](const Settings&, int) { return VerifiedDescent(flight); }), Error);
}

}  // namespace
}  // namespace ripstop

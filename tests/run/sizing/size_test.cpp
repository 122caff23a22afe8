#include "ripstop/run/sizing/size.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <regex>

#include "ripstop/case/payload.h"
#include "ripstop/case/resolve.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/run/report/report_tables.h"
#include "ripstop/run/sizing/pattern.h"
#include "ripstop/run/sizing/size_report.h"
#include "tests/refusal.h"

namespace ripstop {
namespace {

SizeRequest sized(const std::string& family = "flat-circular") {
  SizeRequest r;
  r.payload_mass = 2.4, r.descent_rate = 5, r.family = family, r.height = 300;
  return r;
}

std::string refused(const SizeRequest& asked) {
  return refusal_of([&] { run_size(asked); }, ExitCode::usage);
}

// Row by row: no number of the data is anything but the table's.
TEST(Size, ItsDragIsThatOfTheTableOfFamilies) {
  std::istringstream table(read_file(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "docs/tables/families.md"));
  std::map<std::string, double> printed;
  const std::regex row(R"(\| ([a-z-]+) \| ([0-9.]+) \|.*)");
  for (std::string line; std::getline(table, line);)
    if (std::smatch found; std::regex_match(line, found, row)) printed[found[1]] = std::stod(found[2]);
  const std::vector<FamilyDrag> all = family_drags();
  EXPECT_EQ(all.size(), printed.size());
  EXPECT_GE(all.size(), 8u);
  for (const FamilyDrag& drag : all) EXPECT_EQ(drag.drag_coefficient, printed.at(drag.family)) << drag.family;
}

TEST(Size, HasTheSourceOfItsDragCoefficient) {
  EXPECT_EQ(run_size(sized()).drag_source.find("axial, computed at "), 0u) << run_size(sized()).drag_source;
  SizeRequest given = sized();
  given.drag_coefficient = 0.8;
  EXPECT_EQ(run_size(given).drag_source, "given");
}

// A maker's coefficient on the projected area has the same drag area as the smaller one on S0.
TEST(Size, ACoefficientOnTheProjectedAreaIsConverted) {
  const auto all = family_drags();
  const auto flat =
      std::find_if(all.begin(), all.end(), [](const FamilyDrag& d) { return d.family == "flat-circular"; });
  ASSERT_NE(flat, all.end());
  SizeRequest on_projected = sized(), on_nominal = sized();
  on_projected.drag_coefficient = 1.5;
  on_projected.drag_coefficient_on = DragReference::projected;
  on_nominal.drag_coefficient = 1.5 * flat->projected_ratio * flat->projected_ratio;
  const SizeResult r = run_size(on_projected);
  EXPECT_DOUBLE_EQ(r.nominal_diameter, run_size(on_nominal).nominal_diameter);
  EXPECT_NE(r.drag_source.find("given as 1.5 on the projected area"), std::string::npos) << r.drag_source;
  on_projected.drag_coefficient.reset();
  EXPECT_NE(refused(on_projected).find("needs --drag-coefficient"), std::string::npos);
}

// C_D D^2 is the same for the same load at the same speed: with more drag the canopy is smaller.
TEST(Size, TheHandbooksDiametersHaveTheSameDragAreaAsTheOneFound) {
  const SizeResult r = run_size(sized());
  ASSERT_TRUE(r.handbook_drag_coefficient && r.handbook_diameter);
  const double wanted = r.drag_coefficient * r.nominal_diameter * r.nominal_diameter;
  for (const int end : {0, 1}) {
    const double diameter = r.handbook_diameter->at(end);
    EXPECT_NEAR(r.handbook_drag_coefficient->at(end) * diameter * diameter / wanted, 1, 1e-12) << end;
  }
  EXPECT_NE(r.handbook_diameter->at(0), r.handbook_diameter->at(1));
}

TEST(Size, OfEveryFamilyCarriesPayloadAndParachuteAtTheRate) {
  for (const FamilyDrag& drag : family_drags()) {
    const SizeResult r = run_size(sized(drag.family));
    const double weight = (2.4 + r.parachute_mass) * standard_gravity;
    const double force = 0.5 * standard_air(300).density * 25 * r.drag_coefficient * r.nominal_area;
    EXPECT_NEAR(force / weight, 1, 2e-3) << drag.family;
    EXPECT_NEAR(r.cloth_mass + r.tape_mass + r.line_mass, r.parachute_mass, 1e-12) << drag.family;
    EXPECT_GT(r.packed_volume, 0);
    EXPECT_GT(r.opening_load, 24) << drag.family;
    EXPECT_GT(r.line_used, 0);
    EXPECT_LE(r.line_used, 1);
  }
}

TEST(Size, TapeCarriesTheOpeningLoadAndIsNoneWhereAHemDoes) {
  const SizeResult light = run_size(sized());
  EXPECT_EQ(light.tape_material == "none", light.tape_mass == 0);
  SizeRequest asked = sized();
  asked.payload_mass = 20;
  const SizeResult heavy = run_size(asked);
  const Case given = parse_case(heavy.case_text, "sized.toml");
  const Tape* tape = reinforcement_tape(given);
  ASSERT_TRUE(tape);
  EXPECT_EQ(tape->name, heavy.tape_material);
  const double left = tape->break_load_n * 0.8 * 0.95 * 0.95 * 0.95 / 1.5;
  EXPECT_GE(left, heavy.line_load_factor * heavy.highest_design_load / heavy.line_count);
  EXPECT_GT(heavy.tape_mass, 0);
  EXPECT_NE(
      heavy.case_text.find("material = \"" + heavy.tape_material + "\"  # the lightest tape that carries"),
      std::string::npos)
      << heavy.case_text;
}

TEST(Size, ItsCaseFileIsACaseOfThatParachute) {
  for (const FamilyDrag& drag : family_drags()) {
    const SizeResult r = run_size(sized(drag.family));
    const Case given = parse_case(r.case_text, "sized.toml");
    EXPECT_NEAR(nominal_area(given.parachute) / r.nominal_area, 1, 1e-9) << drag.family;
    EXPECT_EQ(given.title, drag.family + " for 2.4 kg at 5 m/s");
    EXPECT_EQ(r.given.title, given.title);
    EXPECT_EQ(given.flow.speed_m_s, 5);
    EXPECT_EQ(given.payload.mass_kg, 2.4);
    EXPECT_EQ(given.flow.height_m, 300);
    EXPECT_NEAR(parachute_mass(resolve(given)), r.parachute_mass, 1e-9) << drag.family;
    EXPECT_NE(r.case_text.find("# "), std::string::npos);
  }
}

// The case has the speed of its design load: ripstop load and check of it do not assume another one.
TEST(Size, ItsCaseHasTheDeploymentSpeedOfTheDesignLoad) {
  SizeRequest asked = sized();
  EXPECT_EQ(parse_case(run_size(asked).case_text, "sized.toml").payload.deployment_speed_m_s, 20);
  EXPECT_NE(run_size(asked).case_text.find(": the default of ripstop size"), std::string::npos);
  asked.deployment_speed = 27.5;
  const SizeResult r = run_size(asked);
  EXPECT_EQ(r.case_text.find(": the default of ripstop size"), std::string::npos);
  const Settings resolved = resolve(parse_case(r.case_text, "sized.toml"));
  EXPECT_EQ(r.given.payload.deployment_speed_m_s, 27.5);
  LoadRequest load;
  load.payload_mass = *resolved.payload().mass_kg;
  take_speed(resolved, {}, load);
  EXPECT_EQ(load.speed, 27.5);
  const LoadResult again = run_load(resolved, load);
  EXPECT_NEAR(again.design_load / r.design_load, 1, 1e-9);
  EXPECT_EQ(again.speed_source, "payload.deployment_speed_m_s of the case");
  take_speed(resolved, 20, load);
  EXPECT_EQ(load.speed, 20);
  EXPECT_EQ(load.speed_source, "given");
}

// A flow whose drag coefficient is 10 % off the table's: the next diameter makes up for it.
TEST(Size, VerifyAdjustsTheDiameterUntilTheRateIsMet) {
  const SizeRequest asked = sized();
  SizeResult r = run_size(asked);
  const double before = r.nominal_diameter, coefficient = 0.9 * r.drag_coefficient;
  int runs = 0;
  const auto fly = [&](const Settings& resolved, int run) {
    EXPECT_EQ(run, ++runs);
    SteadyResult flown;
    flown.converged = true;
    flown.drag_coefficient = coefficient;
    flown.speed =
        std::sqrt(2 * suspended_weight(resolved, *resolved.payload().mass_kg) /
                  (resolved.flow().density_kg_m3 * coefficient * nominal_area(resolved.parachute())));
    return flown;
  };
  verify_size(asked, r, fly);
  EXPECT_EQ(runs, 2);
  EXPECT_NEAR(r.nominal_diameter / before, std::sqrt(1 / 0.9), 0.01);
  EXPECT_NEAR(r.checks.back().descent_rate, 5, 0.05);
  // Opening load and margin are those of the final size.
  EXPECT_NEAR(r.opening.front().drag_area, r.drag_coefficient * r.nominal_area, 1e-6);
  EXPECT_EQ(r.opening.front().highest, r.opening_load);
  const auto stuck = [&](const Settings&, int) { return SteadyResult(); };
  EXPECT_THROW(verify_size(asked, r, stuck), Error);
}

// The tape for the first size is too weak for the larger one.
TEST(Size, VerifyChoosesTheMaterialsForTheFinalDiameter) {
  SizeRequest asked = sized();
  asked.payload_mass = 22, asked.descent_rate = 6, asked.deployment_speed = 28;
  SizeResult r = run_size(asked);
  const std::string tape = r.tape_material;
  const double coefficient = 0.9 * r.drag_coefficient;
  verify_size(asked, r, [&](const Settings& resolved, int) {
    SteadyResult flown;
    flown.converged = true, flown.drag_coefficient = coefficient;
    flown.speed =
        std::sqrt(2 * suspended_weight(resolved, 22) /
                  (resolved.flow().density_kg_m3 * coefficient * nominal_area(resolved.parachute())));
    return flown;
  });
  EXPECT_NE(r.tape_material, tape);
  EXPECT_GE(*r.smallest_margin, 0);
  EXPECT_TRUE(r.warnings.empty());
}

TEST(Size, ItsReportHasItsNumbersAndEveryMethodsLoad) {
  const SizeResult r = run_size(sized());
  const Report report = size_report(r, {});
  ASSERT_EQ(report.runs.size(), 1u);
  const ReportRun& page = report.runs.front();
  EXPECT_EQ(number_of(page, "nominal_diameter_m"), r.nominal_diameter);
  for (const std::string& key : page.headline) {
    if (key != "smallest_margin_member" && key != "drag_coefficient_basis") {
      EXPECT_FALSE(std::isnan(number_of(page, key))) << key;
    }
  }
  for (const char* key : {"nominal_diameter_m", "parachute_mass_kg", "design_load_n"})
    EXPECT_EQ(std::count(page.headline.begin(), page.headline.end(), key), 1) << key;
  // One margin of the weakest member: that under the highest design load.
  EXPECT_EQ(number_of(page, "smallest_margin_of_safety"), *r.smallest_margin);
  EXPECT_TRUE(std::isnan(number_of(page, "margin_of_safety")));
  for (const char* title : {"Margins under the design load", "Margins under the highest design load"})
    EXPECT_EQ(std::count_if(page.tables.begin(), page.tables.end(),
                            [&](const ReportTable& table) { return table.title == title; }),
              1)
        << title;
  const auto methods = std::find_if(page.tables.begin(), page.tables.end(), [](const ReportTable& table) {
    return table.id.find("methods") != std::string::npos;
  });
  ASSERT_NE(methods, page.tables.end());
  EXPECT_EQ(methods->rows.size(), r.opening.front().methods.size());
  const std::vector<double>& force = page.plots.front().series.front().y;
  EXPECT_GE(*std::max_element(force.begin(), force.end()), 2.4 * standard_gravity);
  EXPECT_LE(*std::max_element(force.begin(), force.end()), r.design_load);
  const ReportSeries& speed = page.plots.back().series.front();
  EXPECT_EQ(speed.y.front(), r.deployment_speed);
  EXPECT_LT(speed.y.back(), 0.5 * r.deployment_speed);
  EXPECT_NEAR(speed.x.back() / (3 * r.opening.front().filling_time), 1, 0.1);
  EXPECT_EQ(page.case_file, r.case_text);
}

SizeRequest wish(double mass, double rate, double height, const std::string& family = "flat-circular") {
  SizeRequest r;
  r.payload_mass = mass, r.descent_rate = rate, r.height = height, r.family = family;
  return r;
}

/// Drag over weight, of the parachute found and of its pattern.
double drag_over_weight(const SizeRequest& asked, const SizeResult& r) {
  const double q = 0.5 * standard_air(asked.height).density * asked.descent_rate * asked.descent_rate;
  const double mass = asked.payload_mass + run_pattern(resolve(r.given), {}, 400).bill.mass;
  return q * r.drag_coefficient * nominal_area(r.given.parachute) / (mass * standard_gravity);
}

// Inputs whose iteration had not converged or had no solution: 94 and 82 % of the weight held, a diameter of 2388 m,
// 13 GB, a run without end, an opening at -4111 m.
TEST(Size, IsFoundOrRefusedWithTheReason) {
  const auto why = [](const SizeRequest& asked) {
    return refusal_of([&] { run_size(asked); }, ExitCode::usage);
  };
  for (const double rate : {1.0, 0.9}) {
    const SizeRequest asked = wish(0.5, rate, 0);
    try {
      EXPECT_NEAR(drag_over_weight(asked, run_size(asked)), 1, 2e-3) << rate;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("m/s without a payload"), std::string::npos) << error.what();
    }
  }
  SizeRequest thin = wish(2.4, 5, 0);
  thin.density = 0.02;
  EXPECT_NE(why(thin).find("this cloth (f-111-physical, with lines and seams) descends at "),
            std::string::npos)
      << why(thin);
  EXPECT_NE(why(wish(2.4, 5, 79000)).find("m/s without a payload"), std::string::npos);
  EXPECT_NE(why(wish(1e6, 0.1, 0)).find("m/s without a payload"), std::string::npos);
  EXPECT_NE(why(wish(1e5, 5, 0)).find("is at most 100 m"), std::string::npos) << why(wish(1e5, 5, 0));
  EXPECT_NE(why(wish(1e-6, 50, 0)).find("is at least"), std::string::npos) << why(wish(1e-6, 50, 0));
  EXPECT_NE(why(wish(5, 2, 20000)).find("m/s without a payload"), std::string::npos)
      << why(wish(5, 2, 20000));
}

// One cloth, one seam allowance: the rate of the cloth alone is the limit of sizes without a payload.
TEST(Size, TheRateOfTheClothAloneIsTheSlowestThatIsFound) {
  const std::string told = refusal_of([] { run_size(wish(0.5, 0.1, 0)); }, ExitCode::usage);
  const double alone = std::stod(told.substr(told.find("descends at ") + 12));
  EXPECT_GT(alone, 0.3);
  EXPECT_LT(alone, 2);
  SizeRequest above = wish(1e-2, 1.2 * alone, 0);
  above.deployment_speed = 10;  // at which a hem suffices: that rate is without a tape
  EXPECT_NEAR(drag_over_weight(above, run_size(above)), 1, 2e-3);
  EXPECT_NE(
      refusal_of([&] { run_size(wish(1e-2, 0.95 * alone, 0)); }, ExitCode::usage).find("without a payload"),
      std::string::npos);
}

// A sample of the grid of validation/reliability/size_grid.py.
TEST(Size, OverMassRateHeightAndFamilyIsBalancedOrRefused) {
  int found = 0, refused = 0;
  for (const double mass : {0.001, 0.1, 10.0, 1e5})
    for (const double rate : {0.1, 2.0, 8.0, 100.0})
      for (const double height : {0.0, 12000.0, 80000.0})
        for (const char* family : {"flat-circular", "cross"}) {
          const SizeRequest asked = wish(mass, rate, height, family);
          try {
            const SizeResult r = run_size(asked);
            EXPECT_NEAR(drag_over_weight(asked, r), 1, 2e-3) << mass << " " << rate << " " << height;
            checked(r.given);  // within the ranges of the case file
            ++found;
          } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::usage) << error.what();
            ++refused;
          }
        }
  EXPECT_GT(found, 20);
  EXPECT_GT(refused, 20);
}

TEST(Size, ImpossibleInputIsRefused) {
  SizeRequest asked = sized("flat-circula");
  EXPECT_NE(refused(asked).find("there is no such family; did you mean flat-circular?"), std::string::npos);
  const std::string slotted = refused(sized("ringsail"));
  EXPECT_EQ(
      slotted.find("--family ringsail: no computed drag coefficient is shipped for this family; use one of "),
      0u)
      << slotted;
  EXPECT_NE(slotted.find(", or write a case of this family and use ripstop load"), std::string::npos)
      << slotted;
  asked = sized();
  asked.payload_mass = -2.4;
  EXPECT_NE(refused(asked).find("payload mass (kg) of -2.4"), std::string::npos);
  asked = sized();
  asked.descent_rate = 0;
  EXPECT_NE(refused(asked).find("descent rate"), std::string::npos);
  asked = sized();
  asked.deployment_speed = 4;
  EXPECT_NE(refused(asked).find("not below the deployment speed"), std::string::npos);
  asked = sized();
  asked.line_material = "string";
  EXPECT_NE(refused(asked).find("no such line"), std::string::npos);
  asked = sized();
  asked.height = 90000;
  EXPECT_NE(refused(asked).find("standard atmosphere"), std::string::npos);
}

// One question, one answer: the load of the sized parachute at its speed of deployment, by both commands.
TEST(Size, DesignsForTheLoadThatTheLoadCommandHasForItsFile) {
  SizeRequest sea, plateau, dense;
  plateau.height = 1500, dense.density = 1.3;
  for (SizeRequest asked : {sea, plateau, dense}) {
    asked.payload_mass = 2.4, asked.descent_rate = 5;
    const SizeResult found = run_size(asked);
    LoadRequest load;
    load.payload_mass = asked.payload_mass, load.speed = found.deployment_speed;
    const LoadResult loaded = run_load(resolve(parse_case(found.case_text, "the sized case")), load);
    EXPECT_EQ(loaded.density, found.density);
    EXPECT_EQ(loaded.height, found.height);
    EXPECT_EQ(loaded.air_source, found.air_source);
    EXPECT_NEAR(loaded.design_load, found.design_load, 1e-6 * found.design_load);
    EXPECT_NEAR(*weakest(*loaded.margins)->used, *weakest(*found.margins)->used, 1e-6);
  }
}

}  // namespace
}  // namespace ripstop

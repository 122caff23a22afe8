// The drag area of a computed opening over its way through the air, from a folder that a test wrote.
#include "ripstop/run/opening/opening_record.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/descent/recovery.h"
#include "ripstop/run/opening/fastest.h"
#include "ripstop/run/opening/load.h"
#include "ripstop/run/run_folder.h"
#include "tests/refusal.h"
#include "tests/run/opening/method_of.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

struct OpeningRecords : testing::Test {
  TemporaryFolder root{"opening-record"};
  Case given = checked(flat_circular_case(2, 600, 10));  // q = 60 Pa
  std::filesystem::path folder = root.path / "opened";

  void write(const CsvTable& history, const CsvTable* smooth = nullptr, const CsvTable* air = nullptr,
             const std::string& result = "{\"peak_load_n\": 500}") {
    std::filesystem::remove_all(folder);
    const auto claimed = open_run_folder({folder}, resolve(given), "inflation", 1);
    write_csv(claimed->own("history.csv"), history);
    if (smooth) write_csv(claimed->own("history_low_pass.csv"), *smooth);
    if (air) write_csv(claimed->own("air.csv"), *air);
    write_file(claimed->own("result.json"), result);
    claimed->seal();
  }
  /// The opening is one with a payload, whose air.csv is needed.
  void carry_payload() {
    given.payload.mass_kg = 2;
    given.inflation.mass = InflationSettings::Mass::payload;
    given.inflation.air = AirModel::coupled;
  }
  std::string refusal(ExitCode code, const Case& asked) const {
    return refusal_of([&] { opening_record(folder, resolve(asked)); }, code);
  }
};

const CsvTable flight{{"time_s", "speed_m_s", "path_m", "height_lost_m"},
                      {{0.1, 8, 0.9, 0.9}, {0.2, 5, 1.6, 1.6}, {0.4, 4, 2.4, 2.4}}};
const CsvTable opening_history{{"time_s", "load_mean_n", "load_largest_n"},
                               {{0.1, -6, 1}, {0.2, 30, 99}, {0.2, 500, 500}, {0.3, 120, 130}}};

TEST_F(OpeningRecords, IsLoadOverDynamicPressureOverDistanceWithoutRepeatedTimes) {
  write(opening_history);
  const OpeningRecord record = opening_record(folder, resolve(given));
  ASSERT_EQ(record.distance.size(), 3u);
  const double way[] = {1, 2, 3}, area[] = {0, 0.5, 2};
  for (int i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(record.distance[i], way[i]);
    EXPECT_DOUBLE_EQ(record.drag_area[i], area[i]);
  }
  EXPECT_DOUBLE_EQ(record.steady_drag_area, 2);  // the mean of the last fifth
}

TEST_F(OpeningRecords, TakesTheLowPassedLoadWhereThereIsOne) {
  const CsvTable smooth{{"time_s", "load_n"}, {{0.5, 60}}};
  write(opening_history, &smooth);
  const OpeningRecord record = opening_record(folder, resolve(given));
  EXPECT_EQ(record.distance, std::vector<double>{5});
  EXPECT_EQ(record.drag_area, std::vector<double>{1});
}

// The speed halves and the path is no longer speed times time: both are those of air.csv, in between in proportion.
TEST_F(OpeningRecords, OfAPayloadHasTheSpeedAndThePathOfItsFlight) {
  carry_payload();
  const CsvTable history{{"time_s", "load_mean_n", "load_largest_n"},
                         {{0.1, 76.8, 80}, {0.2, 30, 31}, {0.3, 12.15, 13}}};
  write(history, nullptr, &flight);
  const OpeningRecord record = opening_record(folder, resolve(given));
  const double way[] = {0.9, 1.6, 2}, area[] = {2, 2, 1};  // q = 38.4, 15 and 12.15 Pa
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(record.distance[i], way[i], 1e-12) << i;
    EXPECT_NEAR(record.drag_area[i], area[i], 1e-12) << i;
  }
  write(history);
  EXPECT_NE(refusal(ExitCode::bad_data, given).find("requires air.csv"), std::string::npos);
}

// Drag areas of 0.5 to 2 m2, less than C_x C_D S0 = 4.3 m2 of the handbook, and a hundred times these.
TEST_F(OpeningRecords, OnlyACoupledOpeningThatHasFilledLowersTheDesignLoad) {
  struct Expected {
    AirModel air;
    const char* filled;
    double factor;
    bool designs;
  };
  given.hardware["link"].rated_load_n = 300;
  for (const Expected& e : {Expected{AirModel::uniform, "", 1, false},
                            {AirModel::uniform, "", 100, true},
                            {AirModel::coupled, ", \"filled\": false", 1, false},
                            {AirModel::coupled, "", 1, false},
                            {AirModel::coupled, ", \"filled\": true", 1, true}}) {
    given.inflation.air = e.air;
    CsvTable history = opening_history;
    for (auto& row : history.rows) row[1] *= e.factor;
    write(history, nullptr, nullptr, fmt::format("{{\"peak_load_n\": 500{}}}", e.filled));
    LoadRequest asked;
    asked.payload_mass = 2.4, asked.speed = 20, asked.path_angle = 0, asked.opening = folder;
    const LoadResult loads = run_load(resolve(given), asked);
    const StageLoads& stage = loads.stages.front();
    const double infinite = method(stage, infinite_mass_method).load;
    EXPECT_EQ(loads.design_method, e.designs ? computed_method : infinite_mass_method);
    EXPECT_EQ(loads.design_load, e.designs ? *loads.record_peak_load : infinite);
    EXPECT_EQ(*loads.record_peak_load > infinite, e.factor > 1);
    const MethodLoad& computed = method(stage, computed_method);
    const bool limited = e.air == AirModel::uniform || !e.designs;
    EXPECT_EQ(computed.applies, !limited);
    EXPECT_EQ(computed.note.find("used for design only if it has the largest load") != std::string::npos,
              limited)
        << computed.note;
    const FastestResult fastest = run_fastest(resolve(given), asked);
    EXPECT_EQ(fastest.design_method, limited ? infinite_mass_method : computed_method);
    LoadRequest there = asked;
    there.speed = *fastest.design().speed;
    EXPECT_NEAR(run_load(resolve(given), there).design_load, 300, 1) << "the load command agrees";
  }
}

TEST_F(OpeningRecords, OfACoupledOpeningGivesTheLoadsOfARecovery) {
  given.inflation.air = AirModel::coupled;
  given.hardware["link"].rated_load_n = 300;
  write(opening_history, nullptr, nullptr, "{\"peak_load_n\": 500, \"filled\": true}");
  RecoveryRequest asked;
  asked.mass = 2.4, asked.apogee = 1000, asked.main_opening = folder;
  const RecoveryStage stage = run_recovery(resolve(given), {}, asked).stages.at(0);
  LoadRequest alone;
  alone.payload_mass = 2.4, alone.speed = stage.speed.value, alone.height = 1000;
  alone.path_angle = stage.path_angle, alone.opening = folder;
  const LoadResult load = run_load(resolve(given), alone);
  ASSERT_EQ(load.design_method, computed_method);
  EXPECT_NEAR(stage.design_load / load.design_load, 1, 1e-6);
  EXPECT_EQ(stage.design_load_from, load.design_load_from);
  EXPECT_EQ(stage.safe->method, computed_method);
}

// One of 12 lines or so carries 0.3 of the load, and the cloth 3 N/m of each newton.
TEST_F(OpeningRecords, TheMarginsHaveTheMemberLoadsOfTheOpeningAndNotAnEqualShare) {
  given.inflation.air = AirModel::coupled;
  const auto opened = [&](const char* margins) {
    write(opening_history, nullptr, nullptr,
          fmt::format("{{\"peak_load_n\": 500, \"filled\": true{}}}", margins));
    LoadRequest asked;
    asked.payload_mass = 2.4, asked.speed = 20, asked.path_angle = 0, asked.opening = folder;
    return asked;
  };
  const LoadRequest equal = opened("");
  const LoadResult shared = run_load(resolve(given), equal);
  const FastestResult fast = run_fastest(resolve(given), equal);
  const LoadRequest asked = opened(
      ", \"margins\": {\"members\": [{\"member\": \"cloth\", \"load\": 1500}, {\"member\": \"line 1\", "
      "\"load\": 100}, {\"member\": \"line 2\", \"load\": 150}]}");
  const LoadResult own = run_load(resolve(given), asked);
  ASSERT_EQ(own.design_method, computed_method);
  EXPECT_EQ(own.design_load, shared.design_load);
  const auto load_of = [](const Margins& margins, const std::string& member) {
    for (const Margin& m : margins.members)
      if (m.member == member) return m.load;
    return 0.0;
  };
  EXPECT_EQ(load_of(*shared.margins, "cloth"), 0);
  EXPECT_NEAR(load_of(*own.margins, "cloth"), 3 * own.design_load, 1e-9 * own.design_load);
  EXPECT_NEAR(load_of(*own.highest_margins, "line"), 0.3 * own.highest_design_load, 1e-9 * own.design_load);
  EXPECT_NEAR(own.line_load_factor, 0.3 * given.parachute.lines.count, 1e-12);
  for (const char* edge : {"hem", "tape"})
    EXPECT_NEAR(load_of(*own.margins, edge),
                load_of(*shared.margins, edge) * own.line_load_factor / shared.line_load_factor, 1e-6)
        << edge;
  const FastestResult slower = run_fastest(resolve(given), asked);
  ASSERT_TRUE(fast.design().lowest && slower.design().lowest);
  EXPECT_LT(*slower.design().lowest, 0.9 * *fast.design().lowest);
  RecoveryRequest rocket;
  rocket.mass = 2.4, rocket.apogee = 1000, rocket.main_opening = folder;
  const RecoveryStage stage = run_recovery(resolve(given), {}, rocket).stages.at(0);
  EXPECT_NEAR(load_of(*stage.margins, "line"), 0.3 * stage.highest_design_load, 1e-9 * stage.design_load);
}

TEST_F(OpeningRecords, FillingIsThatOfTheResultAndRefusedWhereThereIsNone) {
  write(opening_history);
  EXPECT_NE(refusal_of([&] { computed_filling(folder, resolve(given)); }, ExitCode::usage)
                .find("the canopy has not filled"),
            std::string::npos);
  write(opening_history, nullptr, nullptr,
        R"({"peak_load_n": 500, "filling_time_s": 0.5, "area_growth_exponent": 2.5})");
  const ComputedFilling filling = computed_filling(folder, resolve(given));
  const double n = 0.5 * given.flow.speed_m_s.value() / nominal_diameter(given.parachute);
  EXPECT_NEAR(filling.constant, n, 1e-12 * n);
  EXPECT_EQ(filling.exponent, 2.5);
  // At every speed: the handbook's value for low speeds is not that of this canopy.
  LoadRequest asked;
  asked.payload_mass = 2.4, asked.speed = 20, asked.filling_from = folder;
  const LoadResult loads = run_load(resolve(given), asked);
  EXPECT_NEAR(loads.stages.at(0).filling_time, n * loads.nominal_diameter / 20, 1e-12);
  EXPECT_EQ(loads.stages.at(0).caution, "");
}

// n is t_f times the speed at line stretch, as in the handbook, and not the shorter path of a payload that decelerates.
TEST_F(OpeningRecords, FillingOfAPayloadHasTheSpeedAtItsStart) {
  carry_payload();
  write(opening_history, nullptr, &flight,
        R"({"peak_load_n": 500, "filling_time_s": 0.4, "filling_distance_diameters": 1.2,
            "area_growth_exponent": 2})");
  EXPECT_NEAR(computed_filling(folder, resolve(given)).constant, 0.4 * 8 / nominal_diameter(given.parachute),
              1e-12);
}

// The largest safe speed is searched without reading the folders at each speed.
TEST_F(OpeningRecords, TheLoadsAtSeveralSpeedsNeedOneReadingOfTheFolders) {
  write(opening_history, nullptr, nullptr,
        R"({"peak_load_n": 500, "filling_time_s": 0.5, "area_growth_exponent": 2.5,
            "warnings": ["coarse"]})");
  LoadRequest asked;
  asked.payload_mass = 2.4, asked.path_angle = 0, asked.opening = asked.filling_from = folder;
  const Settings resolved = resolve(given);
  const LoadInputs inputs = load_inputs(resolved, asked);
  std::vector<std::string> results;
  for (const double speed : {20.0, 60.0}) {
    asked.speed = speed;
    results.push_back(to_json(run_load(resolved, asked)));
  }
  EXPECT_NE(results[0].find("coarse"), std::string::npos);
  std::filesystem::remove_all(folder);
  EXPECT_THROW(run_load(resolved, asked), Error);
  for (const double speed : {20.0, 60.0}) {
    asked.speed = speed;
    EXPECT_EQ(to_json(run_load(resolved, asked, inputs)), results[speed > 20]) << speed;
  }
}

TEST_F(OpeningRecords, OfAnotherParachuteOrWithoutALoadIsRefused) {
  write(opening_history);
  const Case larger = checked(flat_circular_case(2.1, 600, 10));
  EXPECT_EQ(refusal(ExitCode::usage, larger), folder.string() +
                                                  ": is an opening of a different parachute: S0 is 3.14159 "
                                                  "m2 in that run and 3.46361 m2 in this case");
  write({opening_history.columns, {{0.1, 0, 0}}});
  EXPECT_EQ(refusal(ExitCode::bad_data, given), folder.string() + ": the load history is zero");
  write({opening_history.columns, {}});
  EXPECT_EQ(refusal(ExitCode::bad_data, given), folder.string() + ": the load history is zero");
  folder = root.path / "nowhere";
  EXPECT_EQ(
      refusal(ExitCode::usage, given),
      folder.string() +
          ": contains no finished run of ripstop inflate; compute one with: ripstop inflate CASE --out " +
          folder.string());
}

}  // namespace
}  // namespace ripstop

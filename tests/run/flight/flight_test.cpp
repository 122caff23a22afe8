// A short flight of a small canopy, in memory and in a folder.
#include "ripstop/run/flight/flight.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/run/descent/descent.h"
#include "ripstop/run/flight/flight_folder.h"
#include "tests/refusal.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

/// On cells as coarse as can show a canopy, for some steps of the flow.
Case small_flight() {
  Case given = small_payload_case(5);
  given.flow.max_iterations = 60;
  given.coupling.max_iterations = 4;
  given.flight.cells_across = 10;
  given.flight.duration_s = 0.12;
  given.flight.shapes_per_s = 20;
  return given;
}

FlightSolution flown(const std::function<void(Case&)>& edit) {
  Case given = small_flight();
  edit(given);
  FlightObserver nobody;
  return run_flight(resolve(flight_case(checked(given))), 1, nobody);
}

// The stream in the box is the same to rounding, and with it everything but the path. Differences of rounding grow
// about thirtyfold in a step of cloth that flutters, so that the first steps are compared.
TEST(Flight, UniformWindChangesNothingButThePath) {
  const auto edit = [](Case& given) { given.flight.duration_s = 0.01; };
  const FlightSolution still = flown(edit), blown = flown([&](Case&given) {
                                              edit(given);
                                              given.flight.wind.speed_m_s = 7,
                                              given.flight.wind.direction_deg = 30;
                                            });
  ASSERT_EQ(still.history.rows.size(), blown.history.rows.size());
  ASSERT_GT(still.history.rows.size(), 2u);
  for (std::size_t i = 0; i < 3; ++i) {
    const FreeFlightRow &a = still.history.rows[i], &b = blown.history.rows[i];
    const Vec3 wind = b.wind;
    EXPECT_NEAR(norm(wind), 7, 1e-9);
    EXPECT_NEAR(a.angle, b.angle, 1e-7);
    EXPECT_NEAR(norm(a.air_force - b.air_force), 0, 1e-6 * norm(a.air_force));
    EXPECT_NEAR(norm(a.velocity + wind - b.velocity), 0, 1e-8);
    EXPECT_NEAR(norm(a.payload + a.time * wind - b.payload), 0, 1e-8);
  }
}

// The parachute turns towards the vertical about a payload that hardly moves in so short a time, and the external
// forces change its momentum.
TEST(Flight, ReleasedAtAnAngleConservesMomentumAndEnergy) {
  const FlightSolution flight = flown([](Case& given) { given.flight.angle_deg = 20; });
  const FlightResult& r = flight.result;
  EXPECT_EQ(r.ended_by, "duration");
  EXPECT_NEAR(flight.history.rows.front().angle, 20, 1);
  EXPECT_LT(r.momentum_residual, 0.01);
  EXPECT_LT(std::abs(r.energy_residual), 0.01);
  const auto json = nlohmann::json::parse(to_json(r));
  for (const char* key : {"rate_of_descent_m_s", "descent_drag_coefficient", "glide_ratio",
                          "mean_oscillation_deg", "largest_oscillation_deg", "oscillation_period_s"})
    EXPECT_TRUE(json.contains(key)) << key;
}

TEST(Flight, EndsAtTheGround) {
  const FlightSolution flight = flown([](Case& given) { given.flight.height_m = 0.2; });
  EXPECT_EQ(flight.result.ended_by, "ground");
  EXPECT_LE(flight.history.rows.back().payload.z, 0);
}

TEST(Flight, RefusesImpossibleFlights) {
  const auto refused = [](const std::function<void(Case&)>& edit, const char* names) {
    try {
      flown(edit);
      ADD_FAILURE() << names;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(names), std::string::npos) << error.what();
      EXPECT_EQ(error.code(), ExitCode::usage);
    }
  };
  refused([](Case& given) { given.payload.mass_kg.reset(); }, "payload.mass_kg");
  refused([](Case& given) { given.payload.mass_kg = 0.01; }, "does not keep the lines taut");
  refused([](Case& given) { given.flight.angle_deg = 61; }, "flight.angle_deg");
  refused([](Case& given) { given.flight.wind.speed_m_s = 80, given.flight.wind.gust_m_s = 30; }, "Mach 0.3");
  refused([](Case& given) { given.flight.wind.exponent = 0.2; }, "flight.height_m");
  refused([](Case& given) { given.flight.velocity_m_s = Vec3{80, 0, -80}; }, "flight.velocity_m_s");
}

// A flight that fails ends with its time, and without means.
TEST(Flight, ThatTurnsOverIsReportedWithItsTime) {
  const FlightSolution flight = flown([](Case& given) {
    given.flight.velocity_m_s = Vec3{40, 0, 0};
    given.flight.duration_s = 0.6;
  });
  const FlightResult& r = flight.result;
  EXPECT_EQ(r.ended_by.find("the parachute turned over at 0."), 0u) << r.ended_by;
  EXPECT_FALSE(r.usable);
  EXPECT_FALSE(r.descent || r.coefficient || r.oscillation);
  ASSERT_FALSE(r.warnings.empty());
  EXPECT_NE(r.warnings.back().find("turned over"), std::string::npos);
}

TEST(Flight, WhoseMouthClosesInItsSecondHalfHasAWarning) {
  std::vector<FreeFlightRow> rows(100);
  for (int i = 0; i < 100; ++i) rows[i].time = 0.01 * i, rows[i].step = 0.01, rows[i].mouth_area = 1;
  EXPECT_FALSE(mouth_warning(rows));
  for (int i = 30; i < 50; ++i) rows[i].mouth_area = 0.1;  // and it opens again
  EXPECT_FALSE(mouth_warning(rows));
  for (int i = 50; i < 100; ++i) rows[i].mouth_area = 0.63;
  ASSERT_TRUE(mouth_warning(rows));
  EXPECT_NE(mouth_warning(rows)->find("63 % of its area"), std::string::npos) << *mouth_warning(rows);
}

/// Ends in the middle, after a checkpoint.
struct KilledFlight : FlightObserver {
  void advanced(FreeFlight&, const FreeFlightState& state, const FlightHistory&, bool) override {
    if (state.coupled.air.steps == 12) throw std::runtime_error("killed");
  }
};
struct ResumedFlight : FlightObserver {
  long long first = -1;
  void begin(FreeFlight&, FreeFlightState& state, FlightHistory& history) override {
    first = state.coupled.air.steps;
    EXPECT_EQ(static_cast<long long>(history.rows.size()), first);
  }
};

TEST(Flight, KilledAndResumedHasTheSamePathByteForByte) {
  const fs::path root = fs::temp_directory_path() / ("ripstop-flight-" + std::to_string(getpid()));
  const Settings resolved = resolve(flight_case(checked(small_flight())));
  const auto fly = [&](const char* name, FlightObserver& observer) {
    return run_flight_in({{root / name}, 1, 0}, resolved, observer);
  };
  FlightObserver nobody;
  ASSERT_TRUE(fly("whole", nobody));
  KilledFlight killed;
  EXPECT_THROW(fly("parts", killed), std::runtime_error);
  ResumedFlight resumed;
  ASSERT_TRUE(fly("parts", resumed));
  EXPECT_GE(resumed.first, 10);
  for (const char* file : {"path.csv", "result.json", "vtk/canopy_0002.vtp"})
    EXPECT_EQ(read_file(root / "whole" / file), read_file(root / "parts" / file)) << file;
  EXPECT_FALSE(fly("parts", nobody)) << "it has ended";

  const FinishedFlight flight = finished_flight(root / "whole");
  const CarryingRun carries = carrying_run(root / "whole");
  EXPECT_EQ(carries.basis, "descent");
  const double density = 1.2, rate = *flight.result.descent;
  const DescentRow row = run_descent(carries, 0.8, {0}).rows.front();
  EXPECT_NEAR(row.speed, rate * std::sqrt(density / row.density), 1e-9 * rate);
  fs::remove_all(root);
}

}  // namespace
}  // namespace ripstop

// Records made from a known flight give its drag areas within 3 %, or the reason why they cannot.
#include "ripstop/flight/flight_log.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../refusal.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/trajectory.h"

namespace ripstop {
namespace {

constexpr double flown_mass = 22, field = 200, under_drogue = 0.3, under_main = 6.0;  // [kg], [m], [m2], [m2]

struct Sensors {
  double rate = 20;       // [1/s]
  double noise = 0.5;     // of a height [m]
  double lag = 0.3;       // of the barometer [s]
  double dropped = 0.05;  // share of the samples
  double range = 1e9;     // of the accelerometer [m/s2]
  double until = 1e9;     // [s]
  double spikes = 0;      // share of the heights that are 0
  unsigned seed = 7;      // of noise and missing samples
};

/// Down from 3,000 m under the drogue; at 300 m above ground the main fills within 1.2 s.
std::vector<FlightRow> known_flight() {
  FlightState state;
  state.height = field + 3000, state.speed = 1, state.path_angle = 90;
  const Leg down{[](double, double) { return under_drogue; }, 1000, 0.01, field + 300, false};
  std::vector<FlightRow> rows = fly(state, flown_mass, down);
  const Leg landing{filling(under_drogue, under_main, 1.2, 2, 1.0), 1000, 0.005, field, false};
  for (const FlightRow& row : fly(state, flown_mass, landing)) rows.push_back(row);
  return rows;
}

FlightRecords measured(const std::vector<FlightRow>& flight, const Sensors& s) {
  std::mt19937 random(s.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  FlightRecords records;
  records.acceleration.emplace();
  double sensed = flight.front().state.height, next = 0;
  for (std::size_t i = 1; i < flight.size(); ++i) {
    const double step = flight[i].state.time - flight[i - 1].state.time;
    sensed += (flight[i].state.height - sensed) * (1 - std::exp(-step / s.lag));
    const double time = flight[i].state.time;
    if (time < next || time > s.until) continue;
    next += 1 / s.rate;
    if (uniform(random) < s.dropped) continue;
    const double height = sensed - field + s.noise * normal(random);
    records.height.time.push_back(time);
    records.height.value.push_back(uniform(random) < s.spikes ? 0 : height);
    records.acceleration->time.push_back(time);
    records.acceleration->value.push_back(
        std::min(s.range, flight[i].force / flown_mass + 0.3 * std::abs(normal(random))));
  }
  return records;
}

FlightLog analysed(const Sensors& sensors) {
  static const std::vector<FlightRow> flight = known_flight();
  FlightLogSetup setup;
  setup.mass = flown_mass, setup.mass_uncertainty = 0.1, setup.ground = field, setup.nominal_diameter = 3;
  return analyse_flight(measured(flight, sensors), setup);
}

void expect_known(const FlightLog& log) {
  ASSERT_EQ(log.phases.size(), 2u);
  const double expected[] = {under_drogue, under_main};
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(log.phases[i].drag_area) << log.phases[i].problem;
    EXPECT_NEAR(*log.phases[i].drag_area / expected[i], 1, 0.03) << i;
    EXPECT_LT(std::abs(*log.phases[i].drag_area - expected[i]), 4 * *log.phases[i].drag_area_uncertainty)
        << i;
  }
  ASSERT_EQ(log.deployments.size(), 1u);
  EXPECT_NEAR(log.deployments[0].height, 300, 60);
}

TEST(FlightLog, GivesTheDragAreasOfAKnownFlight) {
  expect_known(analysed({}));
}

TEST(FlightLog, GivesThemWithNoiseDroppedSamplesLagAndSpikes) {
  Sensors worse;
  worse.noise = 1.5, worse.dropped = 0.3, worse.lag = 0.8, worse.spikes = 0.01;
  const FlightLog log = analysed(worse);
  expect_known(log);
  ASSERT_FALSE(log.notes.empty());
  EXPECT_NE(log.notes[0].find("from their neighbours"), std::string::npos);
  Sensors slow;
  slow.rate = 10, slow.noise = 0.2;
  expect_known(analysed(slow));
}

TEST(FlightLog, GivesThemForEveryRealisationOfTheNoise) {
  Sensors sensors;
  sensors.noise = 1, sensors.dropped = 0.2, sensors.lag = 0.5;
  for (sensors.seed = 100; sensors.seed < 120; ++sensors.seed) {
    SCOPED_TRACE(sensors.seed);
    expect_known(analysed(sensors));
  }
}

TEST(FlightLog, DragAreasOverHeightScatterAboutThatOfThePhase) {
  const FlightLog log = analysed({});
  int points = 0;
  for (const DragAreaAtHeight& point : log.drag_areas) {
    const double expected = point.height > 320 ? under_drogue : under_main;
    points += point.height > 320;
    EXPECT_LT(std::abs(point.drag_area - expected), 5 * point.uncertainty + 0.02 * expected) << point.height;
  }
  EXPECT_GE(points, 8);
  EXPECT_GE(log.drag_areas.size(), 14u);
}

TEST(FlightLog, PeakAndFillingTimeAreThoseOfTheOpening) {
  Sensors fast;
  fast.rate = 100;
  const std::vector<FlightRow> flight = known_flight();
  double peak = 0, steady = 0, rose = 0, full = 0, way = 0;
  for (const FlightRow& row : flight) {
    if (row.drag_area <= under_drogue) steady = row.force;
    peak = std::max(peak, row.force);
  }
  for (const FlightRow& row : flight) {
    if (row.drag_area > under_drogue && rose == 0 && row.force > steady + 0.1 * (peak - steady))
      rose = row.state.time, way = -row.state.distance;
    if (full == 0 && row.drag_area >= 0.999 * under_main) full = row.state.time, way += row.state.distance;
  }
  EXPECT_NEAR(full - rose, 1, 0.2);
  const FlightLog log = analysed(fast);
  ASSERT_EQ(log.deployments.size(), 1u);
  const LoggedDeployment& d = log.deployments[0];
  ASSERT_TRUE(d.peak_load) << d.problem;
  EXPECT_NEAR(*d.peak_load / peak, 1, 0.05);
  ASSERT_TRUE(d.filling_time) << d.problem;
  EXPECT_NEAR(*d.filling_time / (full - rose), 1, 0.1);
  ASSERT_TRUE(d.filling_distance);
  EXPECT_NEAR(3 * *d.filling_distance / way, 1, 0.1);
}

TEST(FlightLog, AClippedAccelerometerHasNoPeakButALowerLimit) {
  Sensors clipped;
  clipped.rate = 100, clipped.range = 25;
  const FlightLog log = analysed(clipped);
  ASSERT_EQ(log.deployments.size(), 1u);
  EXPECT_FALSE(log.deployments[0].peak_load);
  EXPECT_NE(log.deployments[0].problem.find("clipped: the peak is at least 550 N"), std::string::npos)
      << log.deployments[0].problem;
  expect_known(log);  // the drag areas need the heights only
}

TEST(FlightLog, APhaseThatIsTooShortOrTooNoisyHasNoDragArea) {
  Sensors cut;  // two seconds after the deployment
  double opening = 0;
  for (const FlightRow& row : known_flight())
    if (row.drag_area < under_drogue * 1.001) opening = row.state.time;
  cut.until = opening + 4;
  const FlightLog ended = analysed(cut);
  ASSERT_EQ(ended.phases.size(), 2u);
  EXPECT_TRUE(ended.phases[0].drag_area);
  EXPECT_FALSE(ended.phases[1].drag_area);
  EXPECT_NE(ended.phases[1].problem.find("at a steady speed"), std::string::npos) << ended.phases[1].problem;
  Sensors noisy;
  noisy.rate = 1, noisy.noise = 60;
  const FlightLog unknown = analysed(noisy);
  ASSERT_EQ(unknown.phases.size(), 1u);  // the main is lost in the noise
  EXPECT_FALSE(unknown.phases[0].drag_area);
  EXPECT_NE(unknown.phases[0].problem.find("standard error of the drag area"), std::string::npos)
      << unknown.phases[0].problem;
}

TEST(FlightLog, ARecordWithoutADescentIsRefused) {
  FlightRecords level;
  for (int i = 0; i < 1000; ++i)
    level.height.time.push_back(0.05 * i), level.height.value.push_back(100 + i % 2);
  FlightLogSetup setup;
  setup.mass = flown_mass;
  EXPECT_NE(refusal_of([&] { analyse_flight(level, setup); }, ExitCode::bad_data)
                .find("a descent of at least 10 s"),
            std::string::npos);
}

}  // namespace
}  // namespace ripstop

// Values read from a load history.
#include "ripstop/fsi/summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../printed_materials.h"
#include "ripstop/core/error.h"
#include "ripstop/fsi/opening_estimate.h"
#include "ripstop/parachute/disk_gap_band.h"

namespace ripstop {
namespace {

// A load that overshoots and decays: F = F_s (1 - exp(-t / T) cos(w t)).
std::vector<HistoryRow> decaying(double steady, double decay, double omega, double interval, int count) {
  std::vector<HistoryRow> rows;
  for (int i = 1; i <= count; ++i) {
    const double t = i * interval;
    const double load = steady * (1 - std::exp(-t / decay) * std::cos(omega * t));
    rows.push_back({t, load, load, load});
  }
  return rows;
}

TEST(Summary, TheInflationTimeIsWhenADecayingLoadStaysWithinATenthOfSteady) {
  const double decay = 0.05, omega = 300, interval = 1e-4;
  const InflationSummary s = summarise(decaying(400, decay, omega, interval, 10000), 0);
  EXPECT_NEAR(s.last_load, 400, 1e-3);
  ASSERT_TRUE(s.inflation_time.has_value());
  // The envelope falls to a tenth at T ln 10; the last excursion lies within half a period before.
  EXPECT_LE(*s.inflation_time, decay * std::log(10.0) + interval);
  EXPECT_GT(*s.inflation_time, decay * std::log(10.0) - std::numbers::pi / omega);
}

TEST(Summary, ALoadThatNeverSettlesHasNoInflationTime) {
  std::vector<HistoryRow> rows;
  for (int i = 1; i <= 1000; ++i) rows.push_back({i * 1e-3, 400 + 200 * std::sin(0.3 * i), 0, 0});
  rows.back().mean = 700;
  EXPECT_FALSE(summarise(rows, 0).inflation_time.has_value());
}

// Slow against the low-pass, which leaves it alone. Its mean square over a window shorter than a period lies
// between 0 and twice exp(-2 t / T) / 2.
TEST(Summary, TheSettlingTimeIsWhenTheMeanSquareOfADecayingLoadIsATenth) {
  const double decay = 0.5, omega = 2 * std::numbers::pi * 10, interval = 1e-3, cutoff = 100;
  const double window = 2 / cutoff;
  std::vector<HistoryRow> rows = decaying(400, decay, omega, interval, 10000);
  const InflationSummary s = summarise(rows, cutoff);
  ASSERT_TRUE(s.settling_time && s.filling_time);
  const double mean = decay * std::log(10 / std::sqrt(2.0));
  EXPECT_LT(*s.settling_time, mean + decay * std::log(std::sqrt(2.0)));
  EXPECT_GT(*s.settling_time, mean - std::numbers::pi / omega);
  EXPECT_LT(window, 2 * std::numbers::pi / omega);
  // cos(w t) = 0 for the first time.
  EXPECT_NEAR(*s.filling_time, 0.5 * std::numbers::pi / omega, 2 * interval);
}

TEST(Summary, ASingleSwingOutOfTheBandMovesTheInflationTimeNotTheSettlingTime) {
  std::vector<HistoryRow> rows = decaying(400, 0.05, 300, 1e-3, 2000);
  const InflationSummary before = summarise(rows, 100);
  for (int i = -3; i <= 3; ++i) rows[800 + i].mean = 445;  // 11 % above for 7 ms
  const InflationSummary after = summarise(rows, 100);
  EXPECT_GT(*after.inflation_time, 0.79);
  EXPECT_DOUBLE_EQ(*after.settling_time, *before.settling_time);
}

// Slow against the low-pass, so that its first crest stays; one row far above it does not.
TEST(Summary, TheSmoothPeakIsTheCrestAndNotASpikeOfOneRow) {
  const double omega = 2 * std::numbers::pi * 10;
  std::vector<HistoryRow> rows = decaying(400, 0.5, omega, 1e-3, 10000);
  double crest = 0, at = 0;
  for (const HistoryRow& row : rows)
    if (row.mean > crest) crest = row.mean, at = row.time;
  rows[5000].mean += 600;
  const InflationSummary s = summarise(rows, 100);
  EXPECT_NEAR(s.smooth_peak, crest, 1e-3 * crest);
  EXPECT_NEAR(s.smooth_peak_time, at, 2e-3);
}

TEST(Summary, TheUnsteadinessIsTheDeviationOfTheLastFifthOverItsMean) {
  std::vector<HistoryRow> rows;
  for (int i = 1; i <= 1000; ++i) rows.push_back({i * 1e-3, i <= 800 ? 9000.0 : i % 2 ? 440.0 : 360.0, 0, 0});
  const InflationSummary s = summarise(rows, 0);
  EXPECT_NEAR(s.last_load, 400, 1e-9);
  EXPECT_NEAR(s.unsteadiness, 0.1, 1e-12);
}

TEST(Summary, AnOpeningHasSettledWhenItsLastTenthIsQuiet) {
  InflationSummary s;
  EXPECT_FALSE(settled(s, 2));  // never within the band
  s.inflation_time = 1.8;
  EXPECT_TRUE(settled(s, 2));
  s.inflation_time = 1.81;
  EXPECT_FALSE(settled(s, 2));
}

TEST(LowPass, ItKeepsSlowTonesHalvesTheCutoffAndDropsFastOnesWithoutDelay) {
  const double interval = 1e-4, cutoff = 100;
  const auto gain = [&](double hz) {
    std::vector<double> tone;
    for (int i = 0; i < 20000; ++i)
      tone.push_back(std::cos(2 * std::numbers::pi * hz * interval * (i - 10000)));
    return low_pass(tone, interval, cutoff)[10000];  // the crest stays where it is
  };
  EXPECT_NEAR(gain(5), 1, 1e-4);
  EXPECT_NEAR(gain(100), 0.5, 1e-3);
  EXPECT_LT(std::abs(gain(1000)), 1.1e-4);
  EXPECT_THROW(low_pass({1, 2, 3}, interval, 5000), Error);
}

TEST(Summary, NoPeakCountsDuringTheStartUp) {
  std::vector<HistoryRow> rows;
  for (int i = 1; i <= 100; ++i) {
    const double load = i <= 2 ? 977 : i == 60 ? 300 : 100;
    rows.push_back({i * 1e-3, load, load, load});
  }
  EXPECT_EQ(highest_load(rows, 0).load, 977);
  EXPECT_EQ(highest_load(rows, 2.5e-3).load, 300);
  EXPECT_EQ(highest_load(rows, 2.5e-3).time, 60e-3);
  EXPECT_EQ(highest_load(rows, 1).load, 977);  // nothing comes after it
  EXPECT_GT(summarise(rows, 100, 0).smooth_peak, 500);
  const InflationSummary after = summarise(rows, 400, 6e-3);
  EXPECT_LT(after.smooth_peak, 300);
  EXPECT_NEAR(after.smooth_peak_time, 60e-3, 1e-9);
  const auto stages = summarise_stages(rows, {}, {1.0}, {0.05}, 0, 2.5e-3);
  ASSERT_EQ(stages.size(), 2u);
  EXPECT_EQ(stages[0].peak_load, 100);
  EXPECT_EQ(stages[1].peak_load, 300);
}

TEST(OpeningEstimate, IsTheTypesCoefficientTimesTheDragAndUnknownWithoutIt) {
  EXPECT_NEAR(opening_estimate(printed_stratos(25600), 400, 100).load.value(), 520, 1e-9);
  EXPECT_FALSE(opening_estimate(printed_stratos(25600), {}, 500).load);
}

TEST(OpeningEstimate, HasAtLeastTheLargestDragCoefficientOfTheHandbook) {
  const Design design = printed_stratos(25600);
  const double drag = experience(design).drag_coefficient.high * nominal_area(design) * 2000;
  ASSERT_GT(drag, 400);
  const OpeningEstimate estimate = opening_estimate(design, 400, 2000, "steady run");
  EXPECT_NEAR(estimate.load.value(), experience(design).opening_coefficient * drag, 1e-9);
  EXPECT_NE(estimate.drag_from.find("steady run: 400.0 N"), std::string::npos) << estimate.drag_from;
}

// Area = 2 (t / 0.2)^3 until 0.2 s, then constant.
TEST(Filling, IsWhereTheAreaFirstReachesThatOfTheEnd) {
  std::vector<InflationFrame> frames;
  for (int i = 1; i <= 100; ++i) {
    InflationFrame frame;
    frame.time = 0.005 * i;
    frame.size.projected_area = 2 * std::pow(std::min(1.0, frame.time / 0.2), 3);
    frames.push_back(frame);
  }
  const auto filling = filling_of(frames);
  ASSERT_TRUE(filling);
  EXPECT_NEAR(filling->time, 0.2, 1e-8);
  EXPECT_NEAR(filling->exponent, 3, 1e-6);
}

TEST(Filling, OfACanopyThatContractsAtTheEndIsWhereItReachesTheAreaAfterItsLargest) {
  // Grows by 0.1 a frame, is largest in the last fifth, and contracts to 1.5 and 1.4.
  std::vector<double> areas = {1.5, 1.4};
  for (double area = 1.8; area > 0.05; area -= 0.1) areas.insert(areas.begin(), area);
  std::vector<InflationFrame> frames;
  for (const double area : areas) {
    InflationFrame frame;
    frame.time = 0.01 * double(frames.size() + 1), frame.size.projected_area = area;
    frames.push_back(frame);
  }
  const auto filling = filling_of(frames);
  ASSERT_TRUE(filling);
  EXPECT_NEAR(filling->time, 0.145, 1e-8);                                    // at 1.45
  frames.back().size.projected_area = frames[18].size.projected_area = 1.75;  // as a canopy that still grows
  EXPECT_FALSE(filling_of(frames));
}

TEST(Filling, CanopyThatStillGrowsAtTheEndHasNotFilled) {
  std::vector<InflationFrame> frames;
  for (int i = 1; i <= 100; ++i) {
    InflationFrame frame;
    frame.time = 0.005 * i, frame.size.projected_area = frame.time;
    frames.push_back(frame);
  }
  EXPECT_FALSE(filling_of(frames));
  EXPECT_FALSE(filling_of(std::vector<InflationFrame>{}));
  // Folded cloth that flutters about the area of its start.
  for (InflationFrame& frame : frames) frame.size.projected_area = 0.04 + 0.01 * std::sin(400 * frame.time);
  EXPECT_FALSE(filling_of(frames));
}

}  // namespace
}  // namespace ripstop

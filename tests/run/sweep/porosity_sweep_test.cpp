// The runs of a porosity calibration stand in the box and on the cells of the case that is calibrated.
#include "ripstop/run/sweep/porosity_sweep.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "ripstop/case/resolve.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;
const fs::path examples = fs::path(RIPSTOP_SOURCE_DIR) / "examples";

std::vector<SweepPoint> points_of(const char* example, const PorositySweep& sweep) {
  const fs::path file = examples / example / "case.toml";
  const Case given = read_case(file);
  return sweep_points(file, {}, porosity_axes(resolve(given), sweep, {{5, 5, 1.2, 10}, {8, 7.5, 1.1, 20}}));
}

TEST(PorositySweep, LeavesTheBoxAndTheCellsOfTheCaseAsTheyAre) {
  for (const char* example : {"flat-circular", "cross", "stratos-iv", "adept"}) {
    const FlowGrid own = flow_grid(resolve(read_case(examples / example / "case.toml")).flow());
    const std::vector<SweepPoint> points =
        points_of(example, {PorosityKnob::permeability, {1, 5}, 1.2e-4, 3});
    ASSERT_EQ(points.size(), 12u);
    for (const SweepPoint& point : points) EXPECT_EQ(flow_grid(point.resolved.flow()), own) << example;
  }
}

TEST(PorositySweep, NamesItsKnobAsItsKey) {
  EXPECT_EQ(knob_name(PorosityKnob::gamma), "gamma");
  EXPECT_EQ(knob_name(PorosityKnob::permeability), "permeability_cfm");
}

TEST(PorositySweep, ShiftsTheCanopyEvenlyOverOneOfTheCellsThatItLiesIn) {
  for (const char* example : {"flat-circular", "stratos-iv"}) {
    const Case given = read_case(examples / example / "case.toml");
    const double cell = flow_grid(resolve(given).flow()).spacing().z,
                 place = resolve(given).flow().canopy_position_m;
    const std::vector<SweepPoint> points = points_of(example, {PorosityKnob::gamma, {0.2}, 1.2e-4, 3});
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_NEAR(points[i].resolved.flow().canopy_position_m - place, cell * (double(i % 3) - 1) / 3,
                  1e-9 * place)
          << example;
  }
}

TEST(PorositySweep, GivesItsResultsBackAsTrialsOfTheirPoint) {
  const Case given = read_case(examples / "flat-circular" / "case.toml");
  const PorositySweep sweep{PorosityKnob::gamma, {0.18, 0.22}, 1.2e-4, 3};
  std::vector<SweepRow> rows(12);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].result.drag_area = double(i);
  const std::vector<PorosityTrial> trials = porosity_trials(resolve(given), sweep, rows);
  const std::vector<SweepPoint> points = points_of("flat-circular", sweep);
  ASSERT_EQ(trials.size(), rows.size());
  for (std::size_t i = 0; i < trials.size(); ++i) {
    EXPECT_EQ(trials[i].drag_area, double(i));
    EXPECT_EQ(trials[i].condition, i / 6);
    const PressureDrop law = cloth_of(PorosityKnob::gamma, trials[i].knob, 1.2e-4);
    EXPECT_EQ(as_sheet(points[i].resolved.materials().canopy.resistance).linear, law.linear);
    EXPECT_NEAR(points[i].resolved.flow().canopy_position_m,
                resolve(given).flow().canopy_position_m + trials[i].shift, 1e-9);
  }
}

}  // namespace
}  // namespace ripstop

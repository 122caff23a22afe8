// Every number of a result is that of the state and the history it was made of.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "../output/read_png.h"
#include "../small_case.h"
#include "ripstop/case/assemble.h"
#include "ripstop/core/thread_team.h"
#include "ripstop/fsi/opening_estimate.h"
#include "ripstop/fsi/pressure_profile.h"
#include "ripstop/material/library.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/plot.h"
#include "ripstop/output/vtk.h"
#include "ripstop/output/vtk_read.h"
#include "ripstop/run/material/coupon.h"
#include "ripstop/run/material/fit.h"
#include "ripstop/run/opening/inflation.h"
#include "ripstop/run/sizing/fabric.h"
#include "ripstop/run/steady/steady.h"
#include "tests/run/steady/finished_run.h"

namespace ripstop {
namespace {

/// Begins with twice the step: it has to be lowered.
struct Hasty : InflationObserver {
  void begin(const Opening&, InflationState& state, InflationHistory&) override { state.step *= 2; }
};

TEST(Results, OfAnOpeningAreThoseOfItsStateHistoryAndCase) {
  const Case given = small_opening();
  Hasty hasty;
  const LoadSource source{"given", 400};
  const auto [result, state, history] = run_inflation(
      resolve(given), source, {parachute_mesh(resolve(given)), given.inflation, 500, false, 1, 6}, hasty);
  EXPECT_EQ(result.title, given.title);
  double peak = 0, impulse = 0;
  for (const HistoryRow& row : history.rows) {
    peak = std::max(peak, row.largest);
    impulse += row.mean * (history.rows[1].time - history.rows[0].time);
  }
  EXPECT_EQ(result.peak_load, peak);
  EXPECT_NEAR(result.impulse, impulse, 1e-9 * impulse);
  EXPECT_EQ(result.pressure, 500);
  ASSERT_TRUE(result.steady_load);
  EXPECT_EQ(result.steady_load, result.summary.last_load);
  EXPECT_EQ(result.steady_drag_returned, *result.steady_load / 400);
  const FlowSettings stream = resolve(given).flow();
  const double q = 0.5 * stream.density_kg_m3 * stream.speed_m_s * stream.speed_m_s;
  EXPECT_EQ(result.estimate.load, opening_estimate(given.parachute, 400, q).load);
  EXPECT_NE(result.estimate.drag_from.find("the given steady drag"), std::string::npos);
  EXPECT_EQ(result.steps, state.cloth.steps);
  EXPECT_EQ(result.step_changes, state.step_changes);
  EXPECT_GT(result.step_changes, 0);
  EXPECT_GT(result.steps, 0);
  EXPECT_EQ(result.folds, 6);
  EXPECT_NEAR(0.5 * (result.inner_fold_radius + result.outer_fold_radius), 0.2, 1e-6);
  EXPECT_LT(result.inner_fold_radius, result.outer_fold_radius);

  double stress = 0, at = 0;
  for (const InflationFrame& frame : history.frames) EXPECT_GT(frame.step, 0);
  EXPECT_EQ(history.frames.back().step, state.step);
  for (const InflationFrame& frame : history.frames)
    if (frame.stress.von_mises > stress) stress = frame.stress.von_mises, at = frame.time;
  EXPECT_EQ(result.stress.von_mises, stress);
  EXPECT_EQ(result.stress_time, at);
  EXPECT_EQ(result.max_line_tension, *std::max_element(result.line_peaks.begin(), result.line_peaks.end()));
  ASSERT_TRUE(result.margins);
  ASSERT_FALSE(result.margins->members.empty());
  // A yarn's strength is compared with the force along a yarn, not with a von Mises stress.
  const Margin& cloth = result.margins->members.front();
  EXPECT_EQ(cloth.member, "cloth");
  EXPECT_EQ(cloth.load, std::max(result.stress.warp, result.stress.weft));
  EXPECT_EQ(cloth.strength, canopy_fabric(given).break_load_n_m);
}

TEST(Results, OfASteadyRunAreThoseOfItsLastIterationAndState) {
  const Case given = square_law_case();
  SteadyObserver quiet;
  const auto [result, state, flow] = run_steady(given, quiet);
  ASSERT_FALSE(state.iterations.empty());
  const SteadyIteration& last = state.iterations.back();
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.iterations, static_cast<int>(state.iterations.size()));
  for (std::size_t i = 0; i < state.iterations.size(); ++i)
    EXPECT_EQ(state.iterations[i].iteration, static_cast<int>(i) + 1);
  EXPECT_EQ(result.drag, flow.porous_force.z);
  EXPECT_NEAR(result.drag_area, SquareLawEngine::area, 1e-3 * SquareLawEngine::area);
  EXPECT_EQ(result.drag_coefficient, result.drag_area / nominal_area(given.parachute));
  EXPECT_EQ(result.ledger.fluid_force, last.fluid_force);
  EXPECT_EQ(result.ledger.nodal_load, last.nodal_load);
  EXPECT_EQ(result.ledger.line_tension, last.line_tension);
  EXPECT_EQ(result.ledger.momentum_deficit, last.momentum_deficit);
  EXPECT_GT(last.section_gap, 0);
  EXPECT_EQ(result.section_gap, last.section_gap);
  EXPECT_EQ(result.axial_moment, last.axial_moment);
  EXPECT_EQ(result.transfer_factor, last.transfer_factor);
  EXPECT_EQ(result.load_remainder, last.residual_traction);
  EXPECT_EQ(result.approach_speed, last.approach_speed);
  EXPECT_EQ(result.speed, air(given).speed);
  EXPECT_EQ(result.density, air(given).density);
  double wall = 0;
  for (const SteadyIteration& i : state.iterations) wall += i.wall_time;
  EXPECT_GE(result.wall_time, wall) << "of the whole run";
  EXPECT_GT(wall, 0);
  EXPECT_EQ(result.size.projected_diameter,
            canopy_size(parachute_mesh(resolve(given)), state.shape).projected_diameter);
  ASSERT_TRUE(result.margins);
  EXPECT_GT(result.stress.von_mises, 0);
  // The sum of all lines is the drag; the most loaded one has no less than the mean.
  EXPECT_GE(result.max_line_tension, last.line_tension / given.parachute.lines.count);
}

TEST(Results, OfClothUnderAPressureAreThoseOfItsShapeAndItsFiles) {
  const FabricSolution cloth = run_fabric(resolve(square_law_case()), 240);
  const auto most =
      std::max_element(cloth.stress.begin(), cloth.stress.end(),
                       [](const CellStress& a, const CellStress& b) { return a.von_mises < b.von_mises; });
  const StressPeak peak = stress_peak(cloth.mesh, cloth.shape, cloth.stress);
  EXPECT_EQ(cloth.result.stress.von_mises, peak.von_mises);
  EXPECT_EQ(cloth.result.stress.place, peak.place);
  EXPECT_LE(peak.von_mises, most->von_mises);  // a mean over cells, which are nearly as wide as the strip
  EXPECT_GT(peak.von_mises, 0.95 * most->von_mises);
  EXPECT_EQ(cloth.result.size.projected_diameter, canopy_size(cloth.mesh, cloth.shape).projected_diameter);
  EXPECT_GT(cloth.result.size.projected_diameter, 0);

  const TemporaryFolder folder("fabric");
  write_fabric(folder.path, cloth);
  const VtkFile canopy = read_vtk(folder.path / "canopy.vtp");
  ASSERT_TRUE(canopy.find("Points", "Points"));
  EXPECT_EQ(canopy.find("Points", "Points")->values[2], cloth.shape[0].z);
  const VtkFile lines = read_vtk(folder.path / "lines.vtp");
  ASSERT_TRUE(lines.find("CellData", "tension_n"));
  EXPECT_EQ(lines.find("CellData", "tension_n")->values.size(), cloth.tensions.size());
  for (const char* file : {"canopy.png", "result.json"})
    EXPECT_TRUE(std::filesystem::exists(folder.path / file)) << file;
}

TEST(Results, ThePressureProfileGoesFromTheVentToTheSkirt) {
  const FabricSolution cloth = run_fabric(resolve(square_law_case()), 240);
  const std::vector<Cell> cells = cells_of(cloth.mesh);
  const std::vector<double> inside(cells.size(), 30), outside(cells.size(), -70), load(cells.size(), 240);
  const std::vector<PressureRing> rings = pressure_profile(cells, cloth.shape, {inside, outside}, load, 10);
  ASSERT_GT(rings.size(), 5u);
  ASSERT_LE(rings.size(), 10u);
  EXPECT_EQ(rings.front().arc, 0);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    EXPECT_NEAR(rings[i].inside, 30, 1e-9);
    EXPECT_NEAR(rings[i].outside, -70, 1e-9);
    EXPECT_NEAR(rings[i].load, 240, 1e-9);
    if (i > 0) {
      EXPECT_GT(rings[i].arc, rings[i - 1].arc);
    }
  }
  EXPECT_LT(rings.front().radius, rings.back().radius);
}

TEST(Results, ACouponIsPulledToTheTestedStrainUnlessAnotherIsAsked) {
  const Fabric fabric = std::get<Fabric>(library_material("f-111"));
  CouponShape shape;
  shape.cells = 4, shape.length = 0.05;
  ThreadTeam team(1);
  const CouponResult tested = run_coupon(fabric, shape, 0, 2, team);
  ASSERT_EQ(tested.pull.points.size(), 2u);
  EXPECT_NEAR(tested.pull.points.back().strain, fabric.tested_strain > 0 ? fabric.tested_strain : 0.1, 1e-12);
  EXPECT_NEAR(run_coupon(fabric, shape, 0.02, 2, team).pull.points.back().strain, 0.02, 1e-12);
}

TEST(Results, OfACouponAreInTheFilesOfANewFolder) {
  const Fabric fabric = std::get<Fabric>(library_material("f-111"));
  CouponShape shape;
  shape.cells = 4, shape.length = 0.05, shape.orientation = 90;
  ThreadTeam team(1);
  const CouponResult result = run_coupon(fabric, shape, 0.03, 3, team);
  EXPECT_EQ(result.orientation, 90);
  for (int i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(result.pull.points.at(i).strain, 0.01 * (i + 1));
  const TemporaryFolder root("coupon");
  const std::filesystem::path folder = root.path / "new/coupon";
  write_coupon_result(folder, result);
  const CsvTable table = read_csv(folder / "coupon.csv");
  EXPECT_EQ(table.columns, columns_of<CouponPoint>());
  ASSERT_EQ(table.rows.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(table.rows[i], row_of(result.pull.points[i])) << i;
  EXPECT_EQ(read_file(folder / "result.json"), to_json(result));
  const VtkFile cloth = read_vtk(folder / "coupon-90.vtp");
  ASSERT_TRUE(cloth.find("CellData", "von_mises_n_per_m"));
  EXPECT_EQ(cloth.find("CellData", "von_mises_n_per_m")->values,
            cloth_cells_only(result.coupon.mesh, result.pull.von_mises));
  EXPECT_EQ(cloth.find("Points", "Points")->values[4], result.pull.positions[1].y);
  EXPECT_GT(read_png(folder / "coupon-90.png").width, 0);
}

TEST(Results, OfAFitHaveItsCouponsAndThePlotsTheMeasuredPoints) {
  Bench bench = read_bench(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/fit-ripstop/bench.toml");
  bench.shear_fraction = 0.2, bench.bending_fraction = 0.01;  // only the clamps are to be taken back
  ThreadTeam team(1);
  const FitResult result = run_fit(bench, true, team);
  ASSERT_TRUE(result.coupons);
  EXPECT_NE(result.coupons->rescale, 1);
  EXPECT_EQ(std::get<Fabric>(result.fit.material).coefficients_n_m, result.coupons->fabric.coefficients_n_m);

  const TemporaryFolder folder("fit");
  write_curves(folder.path, result.fit, bench, {});
  const Png plot = read_png(folder.path / "curve-warp.png");
  const std::size_t samples = result.fit.direction("warp")->samples.size();
  for (std::size_t i = 0; i < samples; ++i) {
    int pixels = 0;  // of some 40 markers, minus hidden ones; a legend has one
    for (int y = 0; y < plot.height; ++y)
      for (int x = 0; x < plot.width; ++x) pixels += plot.shows(x, y, series_colour(i));
    EXPECT_GT(pixels, 250) << i;
  }
}

TEST(Results, OneIterationIsOneAndHasNotConverged) {
  SteadyObserver quiet;
  const SteadySolution once = run_steady(square_law_case({{"coupling.max_iterations", "1"}}), quiet);
  EXPECT_EQ(once.state.iterations.size(), 1u);
  EXPECT_EQ(once.result.iterations, 1);
  EXPECT_FALSE(once.result.converged);
}

}  // namespace
}  // namespace ripstop

// Files in addition to a result: patterns, an unsteady flow, series and lines of an opening.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "../small_case.h"
#include "ripstop/case/assemble.h"
#include "ripstop/core/file.h"
#include "ripstop/fsi/summary.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/vtk.h"
#include "ripstop/output/vtk_read.h"
#include "ripstop/run/opening/inflation_folder.h"
#include "ripstop/run/sizing/pattern.h"
#include "ripstop/run/steady/watch_files.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

Case sewn_case() {
  return read_case(fs::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml");
}

TEST(PatternFiles, AreOneDrawingOfEveryPieceTheBillAndTheResult) {
  const Case given = sewn_case();
  Allowances allowances;
  allowances.seam = 0.01;
  const PatternResult result = run_pattern(resolve(given), allowances, 250);
  EXPECT_EQ(result.title, given.title);
  EXPECT_EQ(result.nominal_area, nominal_area(given.parachute));
  EXPECT_EQ(result.cloth_area, computed_area(given.parachute));
  EXPECT_EQ(result.packing_density, 250);
  EXPECT_EQ(result.allowances.seam, 0.01);
  EXPECT_DOUBLE_EQ(result.bill.packed_volume, result.bill.mass / 250);
  const TemporaryFolder root("pattern-files");
  const fs::path folder = root.path / "new/pattern";
  write_pattern(folder, result);
  std::set<std::string> files, wanted = {".ripstop-command", "bill.csv", "result.json"};
  for (const auto& entry : fs::directory_iterator(folder)) files.insert(entry.path().filename());
  bool blank = false;
  for (const Piece& piece : result.pattern.pieces) {
    std::string name = piece.name;
    blank = blank || name.find(' ') != std::string::npos;
    for (char& c : name)
      if (c == ' ') c = '-';
    wanted.insert(name + ".dxf"), wanted.insert(name + ".svg");
  }
  EXPECT_EQ(files, wanted);
  EXPECT_GE(wanted.size(), 4u);
  EXPECT_EQ(read_file(folder / "result.json"), to_json(result));
  EXPECT_NE(read_file(folder / "bill.csv").find(result.bill.rows.front().part), std::string::npos);
}

TEST(PatternFiles, ReplaceThoseOfAnEarlierPatternAndNothingElse) {
  const Settings resolved = resolve(sewn_case());
  const TemporaryFolder root("pattern-again");
  PatternResult earlier = run_pattern(resolved, {}, 400);
  earlier.pattern.pieces[0].name = "old gore";
  earlier.drawings = {"old-gore.dxf", "old-gore.svg", "../outside.dxf", "notes.txt"};
  make_folder(root.path / "pattern");
  for (const char* mine : {"outside.dxf", "pattern/notes.txt", "pattern/mine.dxf"})
    write_file(root.path / mine, "mine");
  write_pattern(root.path / "pattern", earlier);
  ASSERT_TRUE(fs::exists(root.path / "pattern/old-gore.dxf"));
  const PatternResult result = run_pattern(resolved, {}, 400);
  write_pattern(root.path / "pattern", result);
  for (const char* old : {"pattern/old-gore.dxf", "pattern/old-gore.svg"})
    EXPECT_FALSE(fs::exists(root.path / old)) << old;
  for (const char* mine : {"outside.dxf", "pattern/notes.txt", "pattern/mine.dxf"})
    EXPECT_EQ(read_file(root.path / mine), "mine");
  for (const std::string& name : result.drawings)
    EXPECT_TRUE(fs::exists(root.path / "pattern" / name)) << name;
}

TEST(PatternFiles, RejectAllowancesAndDensitiesOutsideTheirRange) {
  const Settings resolved = resolve(sewn_case());
  EXPECT_THROW(run_pattern(resolved, {.seam = -1}, 400), Error);
  EXPECT_THROW(run_pattern(resolved, {.hem = NAN}, 400), Error);
  EXPECT_THROW(run_pattern(resolved, {.tape_overlap = 1.01}, 400), Error);
  EXPECT_THROW(run_pattern(resolved, {}, 0), Error);
}

TEST(PatternFiles, WithoutATapeThereIsNoneToCut) {
  Case given = sewn_case();
  given.parachute.tape.material = "nylon-tape";
  EXPECT_FALSE(run_pattern(resolve(checked(given)), {}, 400).pattern.tapes.empty());
  given.parachute.tape.material = "none";
  EXPECT_TRUE(run_pattern(resolve(checked(given)), {}, 400).pattern.tapes.empty());
}

/// `steps` steps of 0.01 s and `slices` planes of 0.1 s, on three by one by four cells.
FlowRecord watched_record(int steps, int slices) {
  FlowRecord record;
  for (int n = 1; n <= steps; ++n) {
    FlowStep step;
    step.step = n, step.time = 1 + 0.01 * n, step.length = 0.01, step.courant = 0.6;
    step.force = {0.1 * n, 0.2 * n, 100.0 + n}, step.momentum_gap = {0, 0, 0.3};
    record.steps.push_back(step);
  }
  record.drag.mean = 123.45, record.drag.standard_error = 0.67;
  for (int n = 0; n < slices; ++n) {
    FlowSlice slice;
    slice.time = 0.1 * (n + 1);
    slice.field.grid = {{0, 0, 0}, {3, 1, 4}, 3, 1, 4};
    slice.field.pressure.assign(12, 0.0);
    slice.field.velocity.assign(12, Vec3{0, 0, 1.0 + n});
    record.slices.push_back(slice);
  }
  return record;
}

TEST(WatchFiles, HistoryIsThatOfTheCanopyWithoutRigidBodies) {
  const TemporaryFolder root("watch-files");
  ClaimedFolder claimed(root.path / "run");
  FlowRecord record = watched_record(5, 0);
  for (FlowStep& step : record.steps) {
    step.bodies = {{step.force, {}}, {{1, 2, 30}, {}}};
    step.force += step.bodies[1].force;
  }
  write_watch(claimed, resolve(checked(flat_circular_case(1, 600, 20))), record);
  const CsvTable history = read_csv(root.path / "run/history.csv");
  for (std::size_t n = 0; n < 5; ++n)
    EXPECT_NEAR(history.column("drag_n")[n], record.steps[n].bodies[0].force.z, 1e-9);
  EXPECT_NEAR(history_plot("", record).series[0].y[0], record.steps[0].bodies[0].force.z, 1e-9);
}

TEST(WatchFiles, HistoryHasARowAStepAndTheWakeAFileASlice) {
  const TemporaryFolder root("watch-files");
  ClaimedFolder claimed(root.path / "run");
  const FlowRecord record = watched_record(5, 3);
  write_watch(claimed, resolve(checked(flat_circular_case(1, 600, 20))), record);
  const CsvTable history = read_csv(root.path / "run/history.csv");
  ASSERT_EQ(history.rows.size(), 5u);
  for (std::size_t n = 0; n < 5; ++n) {
    const FlowStep& s = record.steps[n];
    EXPECT_EQ(history.rows[n], (std::vector<double>{s.time, s.length, s.courant, s.force.x, s.force.y,
                                                    s.force.z, s.momentum_gap.z}));
  }
  EXPECT_EQ(history.columns, (std::vector<std::string>{"time_s", "step_s", "courant", "force_x_n",
                                                       "force_y_n", "drag_n", "momentum_gap_n"}));
  const std::string series = read_file(root.path / "run/wake.pvd");
  const std::vector<std::string> listed = claimed.names();
  for (int n = 0; n < 3; ++n) {
    const std::string name = fmt::format("wake/plane_{:03}.vti", n);
    EXPECT_NE(series.find(name), std::string::npos) << series;
    EXPECT_NE(std::find(listed.begin(), listed.end(), name), listed.end()) << name;
    const VtkFile plane = read_vtk(root.path / "run" / name);
    ASSERT_TRUE(plane.find("CellData", "velocity_m_per_s"));
    EXPECT_EQ(plane.find("CellData", "velocity_m_per_s")->values.at(2), 1.0 + n);
  }
  EXPECT_NE(series.find("timestep=\"0.1\""), std::string::npos) << series;
  EXPECT_TRUE(fs::exists(root.path / "run/wake.png") && fs::exists(root.path / "run/history.png"));
}

TEST(WatchFiles, WithoutASliceThereIsNoWake) {
  const TemporaryFolder root("watch-files");
  ClaimedFolder claimed(root.path / "run");
  write_watch(claimed, resolve(checked(flat_circular_case(1, 600, 20))), watched_record(2, 0));
  EXPECT_TRUE(fs::exists(root.path / "run/history.csv"));
  EXPECT_FALSE(fs::exists(root.path / "run/wake") || fs::exists(root.path / "run/wake.pvd"));
}

TEST(WatchFiles, APlotOfManyStepsHasSomeTwoThousandPointsALine) {
  const FlowRecord record = watched_record(6000, 0);
  const Plot plot = history_plot("canopy", record);
  EXPECT_EQ(plot.title, "canopy: drag 123.5 N, standard error 0.67 N");
  EXPECT_EQ(plot.series[0].x.size(), 2000u);
  EXPECT_NEAR(plot.series[0].x[0], 0.01, 1e-12);  // since the beginning of the watch
  EXPECT_NEAR(plot.series[0].x[1], 0.04, 1e-12);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(plot.series[k].dashed, k == 1) << k;
  EXPECT_NEAR(plot.series[2].y[1], 0.4, 1e-12);
  EXPECT_NEAR(plot.series[3].y[1], 0.8, 1e-12);
  // Without a start-up the mean is that of all steps so far, those between the points as well.
  EXPECT_NEAR(plot.series[1].y.back(), 100 + 0.5 * (1 + 5998), 1e-9);
  EXPECT_EQ(history_plot("", watched_record(3999, 0)).series[0].x.size(), 3999u);
}

/// State of an opening at each of its frames.
struct SeenFrames : InflationObserver {
  struct Seen {
    double time;
    std::vector<double> tensions, mises, strain, velocity;
  };
  std::vector<Seen> frames;
  fs::path folder;
  int checkpoints = 0;
  void advanced(const Opening& solver, const InflationState& state, const InflationHistory&,
                const InflationFrame* frame) override {
    checkpoints += fs::exists(folder / "checkpoint");
    if (!frame) return;
    Seen seen{state.cloth.time, spring_tensions(solver.cloth(), state.cloth), {}, {}, {}};
    for (const CellStress& s : cell_stress(solver.cloth(), state.cloth))
      seen.mises.push_back(s.von_mises), seen.strain.push_back(s.max_strain);
    for (const Vec3& v : velocities(state.cloth, solver.cloth()))
      seen.velocity.insert(seen.velocity.end(), {v.x, v.y, v.z});
    frames.push_back(std::move(seen));
  }
};

class OpeningFiles : public testing::Test {
 protected:
  TemporaryFolder root{"opening-files"};
  fs::path folder = root.path / "opened";
  SeenFrames seen;

  InflationResult open(const Case& given, double checkpoint_every_s) {
    seen.folder = folder;
    const auto problem = [&] {
      return InflationProblem{parachute_mesh(resolve(given)), given.inflation, 500, false, 1, 6};
    };
    return run_inflation_in({{folder}, 1, checkpoint_every_s}, resolve(given), {"given", {}}, problem, seen)
        .value();
  }
  std::vector<double> cell_data(const std::string& file, const char* name) const {
    const VtkFile read = read_vtk(folder / file);
    const VtkData* found = read.find("CellData", name);
    EXPECT_TRUE(found) << file << " " << name;
    return found ? found->values : std::vector<double>();
  }
};

std::vector<double> as_floats(std::vector<double> values) {
  for (double& value : values) value = static_cast<float>(value);
  return values;
}

TEST_F(OpeningFiles, HaveTheClothAndTheLinesOfEveryFrameAndTheLinesPeaks) {
  Case given = small_opening();
  given.inflation.frames = 4;
  given.inflation.low_pass_hz = 1000;
  const InflationResult result = open(given, 0);
  const CanopyMesh mesh = parachute_mesh(resolve(given));
  ASSERT_EQ(seen.frames.size(), 4u);
  for (const char* what : {"canopy", "lines"}) {
    const std::string series = read_file(folder / fmt::format("{}.pvd", what));
    for (int k = 0; k <= 4; ++k) {
      EXPECT_NE(series.find(fmt::format("vtk/{}_{:04}.vtp", what, k)), std::string::npos) << series;
      EXPECT_NE(series.find(fmt::format("timestep=\"{}\"", 0.008 * k / 4)), std::string::npos) << series;
    }
  }
  for (int k = 1; k <= 4; ++k) {
    const SeenFrames::Seen& frame = seen.frames[k - 1];
    const std::string canopy = fmt::format("vtk/canopy_{:04}.vtp", k);
    EXPECT_EQ(cell_data(canopy, "von_mises_n_per_m"), as_floats(cloth_cells_only(mesh, frame.mises))) << k;
    EXPECT_EQ(cell_data(canopy, "strain_max"), as_floats(cloth_cells_only(mesh, frame.strain))) << k;
    const VtkFile cloth = read_vtk(folder / canopy);
    ASSERT_TRUE(cloth.find("PointData", "velocity_m_per_s"));
    EXPECT_EQ(cloth.find("PointData", "velocity_m_per_s")->values, as_floats(frame.velocity)) << k;
    EXPECT_EQ(cell_data(fmt::format("vtk/lines_{:04}.vtp", k), "tension_n"), as_floats(frame.tensions)) << k;
  }
  const CsvTable lines = read_csv(folder / "lines.csv");
  ASSERT_EQ(lines.rows.size(), result.line_peaks.size());
  ASSERT_EQ(lines.rows.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(lines.rows[i], (std::vector<double>{double(i + 1), result.line_peaks[i]}));

  const CsvTable history = read_csv(folder / "history.csv"),
                 smooth = read_csv(folder / "history_low_pass.csv");
  EXPECT_EQ(smooth.column("time_s"), history.column("time_s"));
  const std::vector<double> time = history.column("time_s");
  EXPECT_EQ(smooth.column("load_n"), low_pass(history.column("load_mean_n"), time[1] - time[0], 1000));
  EXPECT_EQ(history.columns.size(), 4u);  // nothing of reefing lines
  EXPECT_EQ(read_csv(folder / "balance.csv").columns.back(), "pierced_edges");
  for (const char* picture : {"load.png", "shapes.png", "folded.png"})
    EXPECT_TRUE(fs::exists(folder / picture)) << picture;
  EXPECT_FALSE(fs::exists(folder / "drag_area.png"));
  EXPECT_GT(seen.checkpoints, 0);
}

TEST(LoadPlot, OfAReefedOpeningHasTheLineItsCutsAndEveryLevel) {
  std::vector<HistoryRow> rows(40);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].time = 1e-3 * double(i + 1);
    rows[i].mean = 100 + double(i), rows[i].largest = 200 + double(i), rows[i].reefing_mean = 50 + double(i);
  }
  InflationResult result;
  result.title = "reefed";
  result.peak_load = 300;
  result.settings.duration_s = 0.04;
  result.settings.low_pass_hz = 100;
  result.settings.measured_peak_n = 240;
  result.settings.printed_peak_n = 250;
  result.steady_load = 130;
  result.estimate.load = 260;
  const auto names = [](const Plot& plot) {
    std::vector<std::string> list;
    for (const PlotSeries& series : plot.series) list.push_back(series.name);
    return list;
  };
  std::vector<std::string> expected{
      "maximum in the interval",     "load",          "low-passed at 100 Hz", "steady",
      "infinite mass, C_x C_D S0 q", "measured peak", "peak, published model"};
  const std::vector<double> smooth(rows.size(), 120);
  EXPECT_EQ(names(load_plot(rows, smooth, result)), expected);
  result.stages = std::vector<StageSummary>(2);
  result.stages->at(1).begin = 0.02;
  expected.insert(expected.begin() + 3, {"tension of the reefing line", "cut at 0.02 s"});
  const Plot plot = load_plot(rows, smooth, result);
  ASSERT_EQ(names(plot), expected);
  EXPECT_EQ(plot.title, "reefed");
  EXPECT_EQ(plot.x.label, "time from deployment [s]");
  EXPECT_EQ(plot.y.label, "axial load [N]");
  EXPECT_EQ(plot.series[0].y[7], 207);
  EXPECT_EQ(plot.series[1].y[7], 107);
  EXPECT_EQ(plot.series[2].y, smooth);
  EXPECT_EQ(plot.series[3].y[7], 57);
  for (const std::size_t curve : {0, 1, 2, 3}) EXPECT_EQ(plot.series[curve].x[7], rows[7].time) << curve;
  EXPECT_EQ(plot.series[4].x, (std::vector<double>{0.02, 0.02}));
  EXPECT_EQ(plot.series[4].y, (std::vector<double>{0, 300}));
  const double levels[] = {130, 260, 240, 250};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(plot.series[5 + i].y, (std::vector<double>{levels[i], levels[i]})) << i;
    EXPECT_EQ(plot.series[5 + i].x, (std::vector<double>{0, 0.04})) << i;
  }
  expected.erase(expected.begin() + 2);
  EXPECT_EQ(names(load_plot(rows, {}, result)), expected);
}

TEST_F(OpeningFiles, ACheckpointIsWrittenNoMoreOftenThanAsked) {
  Case given = small_opening();
  given.inflation.duration_s = 2e-3;
  given.inflation.frames = 2;
  given.inflation.low_pass_hz = 0;
  open(given, 1e6);
  EXPECT_EQ(seen.frames.size(), 2u);
  EXPECT_EQ(seen.checkpoints, 0);
  EXPECT_TRUE(fs::exists(folder / "checkpoint"));  // that of the end
  EXPECT_FALSE(fs::exists(folder / "history_low_pass.csv"));
}

}  // namespace
}  // namespace ripstop

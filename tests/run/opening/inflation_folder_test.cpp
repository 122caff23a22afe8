// The run folder of an opening: a killed run resumes, and its tables are the undisturbed run's byte for byte.
#include "ripstop/run/opening/inflation_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>

#include "ripstop/case/assemble.h"
#include "ripstop/case/payload.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/fsi/coupled_opening.h"
#include "ripstop/fsi/opening_estimate.h"
#include "ripstop/fsi/summary.h"
#include "ripstop/fsi/uniform_pressure_opening.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/vtk.h"
#include "ripstop/output/vtk_read.h"
#include "ripstop/run/report/report.h"
#include "tests/refusal.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

class InflationFolderTest : public ::testing::Test {
 protected:
  fs::path root = fs::temp_directory_path() / ("ripstop-opening-" + std::to_string(getpid()));
  Case given = small_opening();

  void SetUp() override { given.inflation.sheet_s = {0, 0.004}; }
  void TearDown() override { fs::remove_all(root); }

  InflationProblem problem() const {
    return {parachute_mesh(resolve(given)), given.inflation, 500, false, 1, 6};
  }
  std::optional<InflationResult> open(const char* name, InflationObserver& observer,
                                      bool fresh = false) const {
    return run_inflation_in(
        {{root / name, fresh}, 1, 0}, resolve(given), {"given", {}}, [&] { return problem(); }, observer);
  }
};

/// The process that ends in the middle: tables of later frames are written, the checkpoint is that of half.
struct Killed : InflationObserver {
  fs::path folder;
  std::string checkpoint;
  void advanced(const Opening& solver, const InflationState& state, const InflationHistory&,
                const InflationFrame*) override {
    if (state.blocks == solver.blocks() / 2) checkpoint = read_file(folder / "checkpoint");
    if (state.blocks == solver.blocks() / 2 + 2) throw std::runtime_error("killed");
  }
};

struct Resumed : InflationObserver {
  long long first_block = -1;
  std::size_t rows = 0, frames = 0;
  void begin(const Opening& solver, InflationState& state, InflationHistory& history) override {
    first_block = state.blocks;
    EXPECT_EQ(history.rows.size(), static_cast<std::size_t>(state.blocks * solver.rows_per_block()));
  }
  void ended(const Opening&, const InflationState&, const InflationHistory& history,
             const InflationResult&) override {
    rows = history.rows.size();
    frames = history.frames.size();
  }
};

TEST_F(InflationFolderTest, AKilledRunResumesAndItsHistoryIsByteIdentical) {
  Resumed undisturbed;
  ASSERT_TRUE(open("whole", undisturbed));
  EXPECT_EQ(undisturbed.first_block, 0);

  Killed killed;
  killed.folder = root / "killed";
  EXPECT_THROW(open("killed", killed), std::runtime_error);
  write_file(killed.folder / "checkpoint", killed.checkpoint);
  append_to_file(killed.folder / "history.csv", "0.0123,4");

  Resumed resumed;
  ASSERT_TRUE(open("killed", resumed));
  EXPECT_EQ(resumed.first_block, UniformPressureOpening(problem()).blocks() / 2);
  EXPECT_EQ(resumed.rows, undisturbed.rows);
  EXPECT_EQ(resumed.frames, undisturbed.frames);
  for (const char* picture : {"folded.png", "vtk/canopy_0000.vtp", "vtk/lines_0000.vtp"})
    EXPECT_TRUE(fs::exists(root / "whole" / picture)) << picture;
  for (const char* table : {"history.csv", "balance.csv", "lines.csv", "result.json"}) {
    EXPECT_EQ(read_file(root / "killed" / table), read_file(root / "whole" / table)) << table;
  }
}

TEST_F(InflationFolderTest, AReefedRunKilledBeforeOrAfterTheCutResumesByteIdentical) {
  const auto open_reefed = [&](const std::string& name, InflationObserver& observer) {
    const Case opening = opening_case(given);
    const LoadSource source = load_source(resolve(opening));
    return run_inflation_in(
        {{root / name}, 1, 0}, resolve(opening), source,
        [&] { return opening_problem(resolve(opening), source, 1); }, observer);
  };
  for (const double cut : {0.0035, 0.006}) {
    given.inflation.reefing = {{0.5, cut, {}}};
    const std::string name = fmt::format("cut at {}", cut);
    Resumed undisturbed, resumed;
    const auto whole = open_reefed(name, undisturbed);
    ASSERT_TRUE(whole && whole->stages);
    ASSERT_EQ(whole->stages->size(), 2u);
    EXPECT_GT(whole->stages->at(0).line_peak.value(), 0) << name;

    Killed killed;
    killed.folder = root / (name + ", killed");
    EXPECT_THROW(open_reefed(name + ", killed", killed), std::runtime_error);
    write_file(killed.folder / "checkpoint", killed.checkpoint);
    ASSERT_TRUE(open_reefed(name + ", killed", resumed));
    EXPECT_GT(resumed.first_block, 0);
    for (const char* table : {"history.csv", "balance.csv", "lines.csv", "result.json"})
      EXPECT_EQ(read_file(killed.folder / table), read_file(root / name / table)) << name << ' ' << table;
  }
}

// However few are asked for: the air steps with the rows.
TEST_F(InflationFolderTest, CoupledRowsAreShorterThanThePassageOfACell) {
  given = small_opening_in_air();
  given.inflation.history_hz = 10;
  given.inflation.low_pass_hz = 0;
  const Case opening = opening_case(given);
  InflationProblem problem = opening_problem(resolve(opening), load_source(resolve(opening)), 1);
  problem.air->engine = make_cartesian({});
  const FlowGrid& grid = problem.air->flow.grid;
  double least = 1e9;
  for (int axis = 0; axis < 3; ++axis)
    for (int c = 0; c < grid.count(axis); ++c) least = std::min(least, grid.width(axis, c));
  const double passed = problem.air->flow.air.speed() * CoupledOpening(problem).row_duration() / least;
  EXPECT_LE(passed, 0.03 * (1 + 1e-9));
  EXPECT_GT(passed, 0.015);
}

TEST_F(InflationFolderTest, AKilledCoupledRunResumesByteIdentical) {
  given = small_opening_in_air();
  const auto open_in_air = [&](const char* name, InflationObserver& observer) {
    const Case opening = opening_case(given);
    const LoadSource source = load_source(resolve(opening));
    return run_inflation_in(
        {{root / name}, 1, 0}, resolve(opening), source,
        [&] { return opening_problem(resolve(opening), source, 1); }, observer);
  };
  struct KilledAfter : InflationObserver {
    long long blocks = 0;
    void advanced(const Opening&, const InflationState& state, const InflationHistory&,
                  const InflationFrame*) override {
      if (state.blocks == blocks) throw std::runtime_error("killed");
    }
  };
  Resumed undisturbed;
  const auto whole = open_in_air("whole", undisturbed);
  ASSERT_TRUE(whole && whole->added_mass);
  // Of the folded start in the first row, of the canopy at the end in the result.
  const double at_start = read_csv(root / "whole/air.csv").column("added_mass_kg").front();
  EXPECT_GT(at_start, 0);
  EXPECT_GT(*whole->added_mass, at_start);
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(root / "whole")) names.insert(entry.path().filename());
  EXPECT_EQ(names,
            (std::set<std::string>{".ripstop",      "added_mass.png", "air.csv",     "air.pvd",
                                   "balance.csv",   "canopy.pvd",     "case.toml",   "checkpoint",
                                   "drag_area.png", "folded.png",     "history.csv", "history_low_pass.csv",
                                   "lines.csv",     "lines.pvd",      "load.png",    "report.html",
                                   "result.json",   "run.json",       "shapes.png",  "vtk"}));
  for (const long long blocks : {2, 3}) {  // the air is in one of two folders in turn
    KilledAfter killed;
    killed.blocks = blocks;
    const std::string name = fmt::format("killed after {}", blocks);
    EXPECT_THROW(open_in_air(name.c_str(), killed), std::runtime_error);
    EXPECT_TRUE(fs::exists(root / name / "air"));
    struct ResumedInAir : Resumed {
      fs::path air;
      void advanced(const Opening&, const InflationState&, const InflationHistory&,
                    const InflationFrame*) override {
        for (const auto& entry : fs::directory_iterator(air))
          EXPECT_TRUE(entry.path().filename() == "even" || entry.path().filename() == "odd") << entry.path();
      }
    } resumed;
    resumed.air = root / name / "air";
    ASSERT_TRUE(open_in_air(name.c_str(), resumed));
    EXPECT_EQ(resumed.first_block, blocks);
    EXPECT_FALSE(fs::exists(root / name / "air"));  // no run resumes from it
    for (const char* table :
         {"history.csv", "balance.csv", "air.csv", "lines.csv", "result.json", "vtk/air_0004.vti"})
      EXPECT_EQ(read_file(root / name / table), read_file(root / "whole" / table)) << name << ' ' << table;
  }
}

// The payload falls faster while the container leaves it.
TEST_F(InflationFolderTest, AnOpeningAfterADeploymentIsComparedAtTheSpeedAfterIt) {
  given = small_opening_in_air();
  given.deployment.emplace();
  given.inflation.mass = InflationSettings::Mass::payload;
  given.payload.mass_kg = 5;
  const Case opening = opening_case(given);
  const Settings resolved = resolve(opening);
  const LoadSource source = load_source(resolved);
  const double speed = opening_problem(resolved, source, 1).air->flow.air.speed();
  ASSERT_GT(speed, 1.01 * resolved.flow().speed_m_s);
  InflationObserver silent;
  const auto r = run_inflation_in(
      {{root / "deployed"}, 1, 0}, resolved, source, [&] { return opening_problem(resolved, source, 1); },
      silent);
  ASSERT_TRUE(r && r->estimate.drag);
  const Design& design = resolved.parachute();
  const double area = nominal_area(design) * design_drag_coefficient(design, usual_drag_coefficient(design));
  EXPECT_NEAR(*r->estimate.drag / (0.5 * resolved.flow().density_kg_m3 * speed * speed * area), 1, 1e-12);
  EXPECT_NE(r->estimate.drag_from.find("the speed after the deployment"), std::string::npos);
  const auto at_infinite_mass = std::find_if(r->handbook.begin(), r->handbook.end(), [](const MethodLoad& m) {
    return m.method == infinite_mass_method;
  });
  ASSERT_NE(at_infinite_mass, r->handbook.end());
  EXPECT_NEAR(at_infinite_mass->load / *r->estimate.load, 1, 1e-6);
}

// Killed when the air of the next checkpoint was on the disk and that checkpoint was not.
TEST_F(InflationFolderTest, TheAirOfACheckpointStaysUntilTheNextOneIsWhole) {
  given = small_opening_in_air();
  const auto open_in_air = [&](const char* name, InflationObserver& observer) {
    const Case opening = opening_case(given);
    const LoadSource source = load_source(resolve(opening));
    return run_inflation_in(
        {{root / name}, 1, 0}, resolve(opening), source,
        [&] { return opening_problem(resolve(opening), source, 1); }, observer);
  };
  struct KilledBetween : InflationObserver {
    fs::path folder;
    std::string checkpoint;
    void advanced(const Opening&, const InflationState& state, const InflationHistory&,
                  const InflationFrame*) override {
      if (state.blocks == 2) checkpoint = read_file(folder / "checkpoint");
      if (state.blocks == 3) throw std::runtime_error("killed");
    }
  } killed;
  killed.folder = root / "killed";
  Resumed undisturbed, resumed;
  ASSERT_TRUE(open_in_air("whole", undisturbed));
  EXPECT_THROW(open_in_air("killed", killed), std::runtime_error);
  write_file(killed.folder / "checkpoint", killed.checkpoint);
  ASSERT_TRUE(open_in_air("killed", resumed));
  EXPECT_EQ(resumed.first_block, 2);
  for (const char* table : {"history.csv", "balance.csv", "air.csv", "result.json", "vtk/air_0004.vti"})
    EXPECT_EQ(read_file(root / "killed" / table), read_file(root / "whole" / table)) << table;
}

// Frames of several blocks: the drawing shows the cloth at the time of the frame, in its file and in the
// report.
TEST_F(InflationFolderTest, AFramesShapeIsThatOfItsTime) {
  given.inflation.frames = 2;
  struct Seen : InflationObserver {
    std::vector<std::vector<Vec3>> shapes;
    std::vector<double> times = {0};
    long long blocks = 0;
    void advanced(const Opening& solver, const InflationState& state, const InflationHistory&,
                  const InflationFrame* frame) override {
      blocks = solver.blocks();
      if (!frame) return;
      shapes.push_back(canopy_surface(solver.mesh(), positions(state.cloth, solver.cloth())).points);
      times.push_back(state.cloth.time);
    }
  } seen;
  ASSERT_TRUE(open("run", seen));
  ASSERT_GT(seen.blocks, 2);
  ASSERT_EQ(seen.shapes.size(), 2u);
  for (std::size_t k = 0; k < seen.shapes.size(); ++k) {
    const VtkFile file = read_vtk(root / "run" / fmt::format("vtk/canopy_{:04}.vtp", k + 1));
    const VtkData* points = nullptr;
    for (const VtkData& array : file.arrays)
      if (array.section == "Points") points = &array;
    ASSERT_TRUE(points);
    ASSERT_EQ(points->values.size(), 3 * seen.shapes[k].size());
    double apart = 0;
    for (std::size_t i = 0; i < seen.shapes[k].size(); ++i) {
      const double* p = &points->values[3 * i];
      apart = std::max(apart, norm(Vec3{p[0], p[1], p[2]} - seen.shapes[k][i]));
    }
    EXPECT_LT(apart, 1e-6) << k;
  }
  const std::vector<ShapeFrame> drawn = report_of(root / "run").shape.frames;
  ASSERT_EQ(drawn.size(), seen.times.size());
  for (std::size_t k = 0; k < drawn.size(); ++k) EXPECT_NEAR(drawn[k].time, seen.times[k], 1e-12) << k;
}

TEST_F(InflationFolderTest, InMemoryTheOpeningIsThatOfTheFolder) {
  InflationObserver quiet;
  const auto in_folder = open("run", quiet);
  ASSERT_TRUE(in_folder);
  EXPECT_FALSE(open("run", quiet));  // finished: only shown
  InflationSolution in_memory = run_inflation(resolve(given), {"given", {}}, problem(), quiet);
  EXPECT_FALSE(in_memory.result.inputs_hash);  // that of a folder's run.json
  in_memory.result.inputs_hash = in_folder->inputs_hash;
  EXPECT_TRUE(in_folder->inputs_hash);
  EXPECT_EQ(to_json(in_memory.result), to_json(*in_folder));
  EXPECT_EQ(read_file(root / "run" / "result.json"), to_json(*in_folder));
}

TEST_F(InflationFolderTest, ItsResultFollowsFromItsHistoryAndFrames) {
  given.inflation.low_pass_hz = 1000;
  InflationObserver quiet;
  const auto [result, state, history] = run_inflation(resolve(given), {"given", {}}, problem(), quiet);
  const InflationSummary summary = summarise(history.rows, 1000);
  ASSERT_TRUE(result.smooth_peak && result.smooth_peak_time);
  EXPECT_GT(*result.smooth_peak, 0);
  EXPECT_EQ(*result.smooth_peak, summary.smooth_peak);
  EXPECT_EQ(*result.smooth_peak_time, summary.smooth_peak_time);
  EXPECT_EQ(result.peak_load, state.peak_load);
  EXPECT_FALSE(result.overshoot || result.smooth_overshoot);  // not settled
  double worst = 0;
  for (const InflationFrame& frame : history.frames)
    if (frame.pressure_work >= 0.1 * history.frames.back().pressure_work)
      worst = std::max(worst, std::abs(frame.residual));
  EXPECT_GT(worst, 0);
  EXPECT_EQ(result.energy_residual, worst);
}

TEST_F(InflationFolderTest, ADamagedCheckpointIsNoticedAndOtherInputsAreRefused) {
  Killed killed;
  killed.folder = root / "run";
  EXPECT_THROW(open("run", killed), std::runtime_error);
  std::string bytes = killed.checkpoint;
  bytes[bytes.size() / 2] ^= 1;
  write_file(root / "run" / "checkpoint", bytes);
  InflationObserver quiet;
  EXPECT_THROW(open("run", quiet), Error);
  given.inflation.damping_n_s_m3 = 9;
  EXPECT_THROW(open("run", quiet), Error);
  EXPECT_TRUE(open("run", quiet, true));
}

TEST_F(InflationFolderTest, TheCheckpointOfAnotherMeshIsRefused) {
  Killed killed, other;
  killed.folder = root / "run", other.folder = root / "other";
  EXPECT_THROW(open("run", killed), std::runtime_error);
  given.parachute.mesh.cloth_nodes = 1000;
  EXPECT_THROW(open("other", other), std::runtime_error);
  given.parachute.mesh.cloth_nodes = 1500;
  write_file(root / "run" / "checkpoint", other.checkpoint);
  InflationObserver quiet;
  const std::string message = refusal_of([&] { open("run", quiet); }, ExitCode::bad_data);
  EXPECT_NE(message.find("checkpoint: belongs to a different mesh; start again with --fresh"),
            std::string::npos)
      << message;
}

TEST_F(InflationFolderTest, TablesThatDoNotBelongToTheCheckpointAreRefused) {
  for (const char* name : {"history.csv", "balance.csv"}) {
    for (const bool gone : {false, true}) {
      const std::string folder = std::string(name) + (gone ? "-gone" : "-cut");
      Killed killed;
      killed.folder = root / folder;
      EXPECT_THROW(open(folder.c_str(), killed), std::runtime_error);
      write_file(killed.folder / "checkpoint", killed.checkpoint);
      const fs::path file = root / folder / name;
      const std::string whole = read_file(file);
      gone ? void(fs::remove(file)) : write_file(file, whole.substr(0, whole.size() / 2));
      InflationObserver quiet;
      try {
        open(folder.c_str(), quiet);
        FAIL() << folder;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_data) << error.what();
      }
    }
  }
}

TEST_F(InflationFolderTest, DetectsChangesOfEarlierFrames) {
  Killed killed;
  killed.folder = root / "run";
  EXPECT_THROW(open("run", killed), std::runtime_error);
  const fs::path file = killed.folder / "vtk/canopy_0001.vtp";
  std::string bytes = read_file(file);
  bytes[bytes.size() / 2] ^= 1;
  write_file(file, bytes);
  InflationObserver quiet;
  try {
    open("run", quiet);
    FAIL() << "a changed shape was taken for the run's own";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_NE(std::string(error.what()).find("vtk/canopy_0001.vtp"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace ripstop

// Layout of a report: headline, warnings, bill, sources, provenance, comparison, frames.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "ripstop/case/assemble.h"
#include "ripstop/case/resolve.h"
#include "ripstop/core/error.h"
#include "ripstop/output/vtk.h"
#include "ripstop/run/opening/inflation_folder.h"
#include "ripstop/run/report/report.h"
#include "ripstop/run/report/report_tables.h"
#include "ripstop/run/sizing/pattern.h"
#include "ripstop/run/sweep/sweep.h"
#include "ripstop/run/sweep/sweep_files.h"
#include "tests/run/steady/finished_run.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class ReportParts : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>("report-parts");
    fly_square_law(steady());
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static fs::path steady() { return folder_->path / "steady"; }
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

TEST_F(ReportParts, OfASteadyRunBeginWithItsDragAndEndWithItsProvenance) {
  const ReportRun run = report_of(steady() / "");
  EXPECT_EQ(run.name, "steady");
  EXPECT_EQ(run.headline,
            (Words{"speed_m_s", "drag_n", "drag_coefficient", "drag_area_m2", "projected_diameter_m",
                   "max_line_tension_n", "weakest_member", "margin_of_safety"}));
  const auto made = nlohmann::ordered_json::parse(read_file(steady() / "run.json"));
  ASSERT_EQ(run.provenance.size(), made.size() - 2);  // not the case, not the sources
  std::size_t row = 0;
  for (const auto& [key, value] : made.items()) {
    if (key == "case" || key == "sources") continue;
    EXPECT_EQ(run.provenance[row++].second, value.is_string() ? value.get<std::string>() : value.dump())
        << key;
  }
  EXPECT_TRUE(run.converged);
  for (const std::string& warning : run.warnings) EXPECT_EQ(warning.find("converge."), std::string::npos);
}

TEST_F(ReportParts, TheBillHasARowForEveryRowOfTheBill) {
  const Settings resolved = settings_of_run(steady());
  const Bill bill = run_pattern(resolved, {}, packed_by_hand).bill;
  const ReportTable table = bill_table(resolved);
  EXPECT_EQ(table.title, "Bill of materials");
  EXPECT_EQ(table.note.find(fmt::format("Cut dimensions with the default allowances, without thread: {:.4g} "
                                        "g, {:.3g} litres packed by hand.",
                                        1e3 * bill.mass, 1e3 * bill.packed_volume)),
            0u)
      << table.note;
  ASSERT_EQ(table.rows.size(), bill.rows.size());
  ASSERT_EQ(table.columns.size(), 8u);
  EXPECT_EQ(table.columns.back().unit, "g");
  bool cloth = false, other = false;
  for (std::size_t i = 0; i < bill.rows.size(); ++i) {
    const BillRow& row = bill.rows[i];
    EXPECT_EQ(table.rows[i],
              (Words{row.part, row.material, std::to_string(row.count), fmt::format("{:.3f}", row.cut_each()),
                     fmt::format("{:.3f}", row.finished), fmt::format("{:.3f}", row.cut),
                     row.is_cloth ? "m²" : "m", fmt::format("{:.1f}", 1e3 * row.mass)}));
    (row.is_cloth ? cloth : other) = true;
  }
  EXPECT_TRUE(cloth && other);
}

TEST_F(ReportParts, TheSourcesHaveKeyValueAndOrigin) {
  const Settings resolved = settings_of_run(steady());
  const ReportTable table = sources_table(resolved, steady() / "run.json");
  const auto sources = nlohmann::json::parse(read_file(steady() / "run.json")).at("sources");
  ASSERT_EQ(table.rows.size(), sources.size());
  ASSERT_GT(table.rows.size(), 5u);
  bool density = false;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_EQ(table.rows[i].at(0), sources[i].at("key").get<std::string>());
    EXPECT_FALSE(table.rows[i].at(1).empty()) << table.rows[i][0];
    EXPECT_EQ(table.rows[i].at(2), sources[i].at("from").get<std::string>());
    if (table.rows[i][0] != "flow.density_kg_m3") continue;
    density = true;
    EXPECT_DOUBLE_EQ(std::stod(table.rows[i][1]), resolved.flow().density_kg_m3);
  }
  EXPECT_TRUE(density);
}

TEST_F(ReportParts, ThatItDidNotConvergeIsTheFirstWarning) {
  fly_square_law(folder_->path / "open", {{"coupling.max_iterations", "1"}});
  const ReportRun run = report_of(folder_->path / "open");
  EXPECT_FALSE(run.converged);
  ASSERT_FALSE(run.warnings.empty());
  EXPECT_EQ(run.warnings[0], "The coupling did not converge.");
  for (std::size_t i = 1; i < run.warnings.size(); ++i) EXPECT_NE(run.warnings[i], run.warnings[0]);
}

TEST_F(ReportParts, TheFlowIsThatAboutTheCanopyAndNotAboutItsLines) {
  const ReportRun run = report_of(steady());
  ASSERT_FALSE(run.flow.pressure.empty());
  Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  const std::vector<double>& p = run.shape.frames.back().points;
  for (const int quad : run.shape.quads) {
    const Vec3 x{p[3 * quad], p[3 * quad + 1], p[3 * quad + 2]};
    low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
    high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
  }
  const FlowView same = read_flow(steady() / "flow.vti", low, high);
  EXPECT_EQ(run.flow.cells, same.cells);
  EXPECT_EQ(run.flow.origin, same.origin);
  EXPECT_EQ(run.flow.pressure, same.pressure);
  EXPECT_EQ(run.flow.speed, same.speed);
}

TEST(ReportComparison, HasOnlyNumbersOfEveryRun) {
  ReportRun a, b;
  a.name = "first", b.name = "second";
  add_result(a, R"({"title": "t", "drag_n": 5, "only_here_n": 1, "settled": true})", "result.json");
  add_result(b, R"({"title": "u", "drag_n": 6.5, "settled": true})", "result.json");
  const ReportTable table = comparison_table({a, b});
  ASSERT_EQ(table.columns.size(), 4u);
  EXPECT_EQ(table.columns[2].text, "first");
  EXPECT_EQ(table.columns[3].text, "second");
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0], (Words{"drag", "N", "5", "6.5"}));
  EXPECT_TRUE(std::isnan(number_of(a, "title")));
  EXPECT_TRUE(std::isnan(number_of(b, "only_here_n")));
}

TEST(ReportComparison, OneRunIsNotCompared) {
  ReportRun a;
  a.name = "alone";
  const Report report = report_on({a}, "one");
  EXPECT_EQ(report.title, "one");
  EXPECT_TRUE(report.comparison.columns.empty() && report.plots.empty());
}

TEST(ReportTablesNested, AGroupInARowOfSeveralIsNumberedAndOneAloneIsNot) {
  ReportRun run;
  add_result(run, R"({"stages": [{"begin_s": 0, "methods": [{"load_n": 1}]},
                                 {"begin_s": 2, "methods": [{"load_n": 3}]}],
                      "opening": [{"peak_n": 1, "methods": [{"load_n": 4}]}]})",
             "result.json");
  Words ids;
  for (const ReportTable& table : run.tables) ids.push_back(table.id);
  EXPECT_EQ(ids, (Words{"stages", "stages 1 methods", "stages 2 methods", "opening", "opening methods"}));
  EXPECT_EQ(run.tables[2].rows, (std::vector<Words>{{"3"}}));
  EXPECT_EQ(run.tables[0].title, "Stages");
  EXPECT_TRUE(run.values.empty());
}

/// An opening of 8 ms, seen at eight times.
class ReportOfAnOpening : public testing::Test {
 protected:
  TemporaryFolder root_{"report-of-an-opening"};
  fs::path folder_ = root_.path / "opened";
  std::vector<double> times_ = {0};

  void SetUp() override {
    Case given = small_opening();
    given.inflation.low_pass_hz = 1000;
    InflationObserver quiet;
    ASSERT_TRUE(run_inflation_in(
        {{folder_}, 1, 0}, resolve(given), {"given", {}},
        [&] { return InflationProblem{parachute_mesh(resolve(given)), given.inflation, 500, false, 1, 6}; },
        quiet));
    for (int k = 1; k <= 8; ++k) times_.push_back(1e-3 * k);
  }
};

TEST_F(ReportOfAnOpening, BeginsWithItsLoadsAndHasEveryFrame) {
  const ReportRun run = report_of(folder_);
  EXPECT_EQ(run.kind, "opening");
  EXPECT_EQ(run.headline, (Words{"peak_load_n", "low_pass_peak_load_n", "knacke_load_n", "weakest_member",
                                 "margin_of_safety", "steady_load_n", "filling_time_s", "speed_at_end_m_s",
                                 "max_line_tension_n"}));
  for (const char* key : {"peak_load_n", "margin_of_safety", "max_line_tension_n"})
    EXPECT_FALSE(std::isnan(number_of(run, key))) << key;
  EXPECT_TRUE(std::isnan(number_of(run, "steady_load_n")));  // not settled
  ASSERT_EQ(run.shape.frames.size(), times_.size());
  for (std::size_t k = 0; k < times_.size(); ++k) EXPECT_NEAR(run.shape.frames[k].time, times_[k], 1e-9);
  EXPECT_EQ(run.shape.part_names, parachute_mesh(settings_of_run(folder_)).parts);
  EXPECT_TRUE(run.flow.pressure.empty());
}

// 24 frames of 110,000 points: a page contains twelve of them.
TEST_F(ReportOfAnOpening, TooLargeForAPageKeepsItsFirstAndItsLastFrameAndTheOthersEvenly) {
  VtkSurface many;
  many.points.assign(110'000, Vec3{});
  VtkSurface lines = many;
  many.polygons.add(std::array{0, 1, 2, 3});
  lines.lines.add(std::array{0, 1});
  lines.cell_arrays.push_back(vtk_array("part", std::vector<std::int32_t>{0}));
  write_vtp(root_.path / "canopy.vtp", many);
  write_vtp(root_.path / "lines.vtp", lines);
  fs::remove_all(folder_ / "vtk");
  fs::create_directories(folder_ / "vtk");
  std::string balance = "time_s\n";
  for (int k = 0; k < 24; ++k) {
    for (const char* what : {"canopy", "lines"})
      fs::copy(root_.path / (std::string(what) + ".vtp"), folder_ / fmt::format("vtk/{}_{:04}.vtp", what, k));
    if (k > 0) balance += fmt::format("{}\n", 10 * k);
  }
  write_file(folder_ / "balance.csv", balance);
  const std::vector<ShapeFrame> frames = report_of(folder_).shape.frames;
  ASSERT_EQ(frames.size(), 12u);
  for (int k = 0; k < 12; ++k) EXPECT_EQ(frames[k].time, 10 * (k * 23 / 11)) << k;
}

TEST(ReportOfASweep, HasItsRunsByTheirValuesAndNoneOfThoseWithoutAResult) {
  add_square_law();
  const TemporaryFolder root("report-of-a-sweep");
  const std::vector<SweepAxis> axes = {sweep_axis("flow.speed_m_s", {"15", "20", "25"}, "--speeds")};
  std::vector<SweepPoint> points;
  for (const char* speed : {"15", "20", "25"})
    points.push_back(
        {{speed}, resolve(square_law_case({{"flow.speed_m_s", speed}})), std::string("v") + speed, -1});
  SweepSettings settings;
  settings.folder = root.path / "sweep";
  settings.jobs = 1;
  prepare_sweep(points, settings);
  SteadyObserver nobody;  // one thread each: a team next to other tests waits for itself
  for (const SweepPoint& point : points)
    run_steady_in({{settings.folder / point.folder, false, false, false}, 1, {}, {}}, point.resolved, nobody);
  std::vector<SweepRow> rows = gather_sweep(points, settings);
  for (const SweepRow& row : rows) EXPECT_TRUE(row.done) << row.error;
  rows[1] = {};
  write_file(settings.folder / "result.json", sweep_json("a sweep", axes, points, rows));
  EXPECT_THROW(reports_of(settings.folder), Error);  // has not ended
  seal_sweep(settings.folder);
  const std::vector<ReportRun> runs = reports_of(settings.folder);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(number_of(runs[0], "speed_m_s"), 15);
  EXPECT_EQ(number_of(runs[1], "speed_m_s"), 25);
  EXPECT_NE(runs[0].name, "v15");
  EXPECT_NE(runs[0].name.find("15"), std::string::npos) << runs[0].name;
  EXPECT_NE(runs[1].name.find("25"), std::string::npos) << runs[1].name;

  rows.assign(3, {});
  write_file(settings.folder / "result.json", sweep_json("a sweep", axes, points, rows));
  seal_sweep(settings.folder);
  EXPECT_THROW(reports_of(settings.folder), Error);  // nothing in it
}

}  // namespace
}  // namespace ripstop

// Every file of a steady run has the numbers of its end, as its observer saw it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "ripstop/case/assemble.h"
#include "ripstop/fsi/pressure_profile.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/plot.h"
#include "ripstop/output/vtk_read.h"
#include "ripstop/run/steady/steady_parts.h"
#include "ripstop/run/stress_arrays.h"
#include "tests/output/read_png.h"
#include "tests/run/steady/finished_run.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

/// State at the end of a run, saved before its solver is destroyed.
struct Ending : SteadyObserver {
  SteadyState state;
  std::vector<double> tensions;
  std::vector<CellStress> stress;
  std::vector<PressureRing> rings;
  std::vector<VtkArray> arrays;
  fs::path picture;  // if given
  std::string first_picture;
  void iterated(const SteadyRun&, const SteadyState&, const FlowField&) override {
    if (!picture.empty() && first_picture.empty()) first_picture = read_file(picture);
  }
  void ended(const SteadyRun& run, const SteadyState& end, const SteadyResult&) override {
    state = end;
    const ClothState cloth = run.solver.cloth_state(end);
    tensions = spring_tensions(run.solver.cloth(), cloth);
    stress = cell_stress(run.solver.cloth(), cloth);
    rings = pressure_profile(run.solver.cells(), end.shape, end.sides, end.applied);
    arrays = stress_arrays(run.solver.mesh(), end.shape, stress);
  }
};

std::vector<double> numbers(const VtkFile& file, const char* section, const std::string& name) {
  const VtkData* found = file.find(section, name);
  if (!found) ADD_FAILURE() << "no " << section << " " << name;
  return found ? found->values : std::vector<double>();
}

std::vector<double> flat(const std::vector<Vec3>& vectors) {
  std::vector<double> all;
  for (const Vec3& v : vectors) all.insert(all.end(), {v.x, v.y, v.z});
  return all;
}

TEST(SteadyFiles, HaveTheNumbersOfTheStateThatTheRunEndedIn) {
  const TemporaryFolder folder("steady-files");
  const Case given = square_law_case({{"coupling.load", "uniform"}});
  Ending ending;
  ending.picture = folder.path / "canopy.png";
  const SteadyFolderSettings settings{{.folder = folder.path, .fields = true}, 1, {}, {}};
  const SteadyResult result = run_steady_in(settings, resolve(given), ending).result;
  const CanopyMesh mesh = parachute_mesh(resolve(given));
  const std::size_t count = ending.state.iterations.size();
  ASSERT_GE(count, 2u);

  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder.path)) names.insert(entry.path().filename());
  EXPECT_EQ(names, (std::set<std::string>{".ripstop", "canopy.png", "canopy.pvd", "canopy.stl", "case.toml",
                                          "checkpoint", "drag.png", "flow.vti", "iterations.csv", "lines.csv",
                                          "lines.pvd", "load.png", "pressure.csv", "pressure.png",
                                          "report.html", "result.json", "run.json", "vtk"}));
  const CsvTable iterations = read_csv(folder.path / "iterations.csv");
  EXPECT_EQ(iterations.columns, columns_of<SteadyIteration>());
  ASSERT_EQ(iterations.rows.size(), count);
  for (std::size_t i = 0; i < count; ++i)
    EXPECT_EQ(iterations.rows[i], row_of(ending.state.iterations[i])) << i;

  const CsvTable lines = read_csv(folder.path / "lines.csv");
  const std::vector<LineTension> tensions = line_tensions(mesh, ending.tensions);
  ASSERT_EQ(lines.rows.size(), tensions.size());
  for (std::size_t i = 0; i < tensions.size(); ++i)
    EXPECT_EQ(lines.rows[i], (std::vector<double>{static_cast<double>(tensions[i].number),
                                                  tensions[i].free_tension, tensions[i].largest_tension}));

  // Coefficients: over q, which a square law's drag has in it.
  const double q = result.drag / SquareLawEngine::area;
  const CsvTable pressure = read_csv(folder.path / "pressure.csv");
  ASSERT_EQ(pressure.rows.size(), ending.rings.size());
  ASSERT_GT(pressure.rows.size(), 10u);
  for (std::size_t i = 0; i < pressure.rows.size(); ++i) {
    const PressureRing& ring = ending.rings[i];
    EXPECT_EQ(pressure.rows[i][0], ring.arc);
    EXPECT_EQ(pressure.rows[i][1], ring.radius);
    EXPECT_EQ(pressure.rows[i][2], ring.z);
    EXPECT_NEAR(pressure.rows[i][3], ring.inside / q, 1e-3 + 1e-3 * std::abs(ring.inside / q));
    EXPECT_NEAR(pressure.rows[i][4], ring.outside / q, 1e-3 + 1e-3 * std::abs(ring.outside / q));
    EXPECT_NEAR(pressure.rows[i][5], ring.load / q, 1e-3);
    EXPECT_GT(pressure.rows[i][5], 0.1);
  }

  const std::string last = fmt::format("{:03}", count);
  const VtkFile canopy = read_vtk(folder.path / ("vtk/canopy_" + last + ".vtp"));
  EXPECT_EQ(numbers(canopy, "Points", "Points"), flat(ending.state.shape));
  std::vector<Vec3> displacement;
  for (std::size_t i = 0; i < mesh.start.size(); ++i)
    displacement.push_back(ending.state.shape[i] - mesh.start[i]);
  EXPECT_EQ(numbers(canopy, "PointData", "displacement_m"), flat(displacement));
  EXPECT_EQ(numbers(canopy, "CellData", "pressure_inside_pa"),
            cloth_cells_only(mesh, ending.state.sides.inside));
  EXPECT_EQ(numbers(canopy, "CellData", "pressure_outside_pa"),
            cloth_cells_only(mesh, ending.state.sides.outside));
  EXPECT_EQ(numbers(canopy, "CellData", "pressure_difference_applied_pa"),
            cloth_cells_only(mesh, ending.state.applied));
  for (const VtkArray& array : ending.arrays)
    EXPECT_EQ(numbers(canopy, "CellData", array.name), std::get<std::vector<double>>(array.values))
        << array.name;
  const VtkFile springs = read_vtk(folder.path / ("vtk/lines_" + last + ".vtp"));
  EXPECT_EQ(numbers(springs, "CellData", "tension_n"), ending.tensions);
  EXPECT_EQ(numbers(springs, "Points", "Points"), flat(ending.state.shape));
  for (const char* what : {"canopy", "lines"}) {
    const std::string series = read_file(folder.path / (std::string(what) + ".pvd"));
    for (std::size_t k = 1; k <= count; ++k) {
      EXPECT_NE(series.find(fmt::format("timestep=\"{}\"", k)), std::string::npos) << series;
      EXPECT_NE(series.find(fmt::format("vtk/{}_{:03}.vtp", what, k)), std::string::npos) << series;
    }
  }
  EXPECT_TRUE(fs::exists(folder.path / "flow.vti") || fs::exists(folder.path / "flow.vtr"));
  EXPECT_EQ(read_file(folder.path / "result.json"), to_json(result));
  EXPECT_EQ(result.inputs_hash, inputs_of_run(folder.path));

  for (const char* picture : {"drag.png", "pressure.png"}) {
    const Png plot = read_png(folder.path / picture);
    for (std::size_t series = 0; series < 3; ++series) {
      int pixels = 0;
      for (int y = 0; y < plot.height; ++y)
        for (int x = 0; x < plot.width; ++x) pixels += plot.shows(x, y, series_colour(series));
      EXPECT_GT(pixels, 20) << picture << " " << series;
    }
    int ink = 0;  // of the title
    for (int y = 0; y < plot.height / 16; ++y)
      for (int x = 0; x < plot.width; ++x)
        ink += plot.rgb[3 * (static_cast<std::size_t>(y) * plot.width + x)] < 100;
    EXPECT_GT(ink, 200) << picture;
  }
  for (const char* picture : {"canopy.png", "load.png"})
    EXPECT_GT(read_png(folder.path / picture).width, 0) << picture;
  EXPECT_NE(read_file(ending.picture), ending.first_picture);  // its title names the iteration
  EXPECT_EQ(fs::file_size(folder.path / "canopy.stl"),
            84 + 50 * surface_of(cells_of(mesh), ending.state.shape).size());  // binary STL
}

TEST(StressArrays, HaveOneValueOfEveryClothCell) {
  const CanopyMesh mesh = parachute_mesh(resolve(square_law_case()));
  std::vector<CellStress> stress(mesh.cell_count());
  for (std::size_t i = 0; i < stress.size(); ++i) {
    const double n = 10.0 * double(i);
    stress[i].principal_max = n + 1, stress[i].principal_min = n + 2, stress[i].warp = n + 3,
    stress[i].weft = n + 4;
    stress[i].von_mises = n + 5, stress[i].max_strain = n + 6, stress[i].direction = {n, n + 7, n + 8};
    stress[i].tautness = i % 2 == 0 ? Tautness::taut : Tautness::wrinkled;
  }
  const char* names[] = {"stress_max_n_per_m",
                         "stress_min_n_per_m",
                         "warp_n_per_m",
                         "weft_n_per_m",
                         "tautness",
                         "von_mises_n_per_m",
                         "strain_max",
                         "stress_max_direction",
                         "von_mises_strip_n_per_m"};
  const std::vector<VtkArray> arrays = stress_arrays(mesh, mesh.start, stress);
  ASSERT_EQ(arrays.size(), std::size(names));
  for (std::size_t k = 0; k < arrays.size(); ++k) EXPECT_EQ(arrays[k].name, names[k]);
  const std::vector<Cell> cells = cells_of(mesh);
  const auto cloth =
      std::size_t(std::count_if(cells.begin(), cells.end(), [](const Cell& c) { return c.corner[0] >= 0; }));
  const auto values = [&](int k) { return std::get<std::vector<double>>(arrays[k].values); };
  const double added[] = {1, 2, 3, 4, 0, 5, 6};
  for (int k = 0; k < 7; ++k) {
    ASSERT_EQ(values(k).size(), cloth);
    if (k != 4) {
      EXPECT_EQ(std::fmod(values(k).back(), 10), added[k]) << names[k];
      EXPECT_EQ(values(k).back() - added[k], values(0).back() - 1) << names[k];
    }
  }
  for (const double tautness : values(4)) EXPECT_TRUE(tautness == 1 || tautness == 2);
  ASSERT_EQ(values(7).size(), 3 * cloth);
  EXPECT_EQ(values(7)[3 * cloth - 1], values(0).back() + 7);
  EXPECT_EQ(arrays[7].components, 3);
  // The mean over a strip lies within the values of its cells, and is the peak's at its highest.
  const std::vector<double> means = values(8), single = values(5);
  ASSERT_EQ(means.size(), cloth);
  const auto highest = [](const std::vector<double>& v) { return *std::max_element(v.begin(), v.end()); };
  EXPECT_LT(highest(means), highest(single));
  EXPECT_EQ(highest(means), stress_peak(mesh, mesh.start, stress).von_mises);
}

/// Settings of an engine at its construction.
std::vector<EngineOptions>& told() {
  static std::vector<EngineOptions> all;
  return all;
}

TEST(SteadyParts, GiveTheEngineThreadsFolderAndHostsOfTheRunAndRanksAndLimitOfTheCase) {
  static const bool added = [] {
    add_engine({"listening",
                "notes what it is told",
                {.averages = true, .ranks = true},
                [](const EngineOptions&) { return std::string("listening 1"); },
                [](const EngineOptions& options) {
                  told().push_back(options);
                  return std::make_unique<SquareLawEngine>();
                },
                true});
    return true;
  }();
  ASSERT_TRUE(added);
  Case given = square_law_case();
  given.flow.engine = "listening";
  given.flow.ranks = 3;
  given.flow.time_limit_s = 77;
  given.coupling.threads = 1;
  told().clear();
  {
    const SteadyParts own = steady_parts(resolve(given), {2, "flow", "hosts"});
    EXPECT_FALSE(own.temporary);
    EXPECT_EQ(own.solver->mesh().start.size(), parachute_mesh(resolve(given)).start.size());
  }
  {
    const SteadyParts none = steady_parts(resolve(given), {});
    ASSERT_TRUE(none.temporary);
    EXPECT_EQ(told().back().folder, none.temporary->path);
    EXPECT_TRUE(fs::is_directory(none.temporary->path));
  }
  ASSERT_EQ(told().size(), 2u);
  EXPECT_EQ(told()[0].threads, 2);
  EXPECT_EQ(told()[0].folder, "flow");
  EXPECT_EQ(told()[0].hostfile, "hosts");
  EXPECT_EQ(told()[1].threads, 1);
  EXPECT_EQ(told()[1].hostfile, "");
  for (const EngineOptions& options : told()) {
    EXPECT_EQ(options.ranks, 3);
    EXPECT_EQ(options.time_limit_s, 77);
    EXPECT_EQ(options.second_order, resolve(given).flow().convection == Convection::second_order);
  }
}

}  // namespace
}  // namespace ripstop

// The built-in engine in time compared with OpenFOAM's pimpleFoam: an impermeable square plate, set into the stream
// at once, on the same cells, steps, convection (LUST) and closure (WALE).
//   bench_in_time FOLDER [ACROSS [TIME [RANKS]]]
//     FOLDER  of OpenFOAM's case and drag.svg
//     ACROSS  cells across the plate (16)
//     TIME    in times that the stream takes for the plate's width (2); of more than 20 the second half is averaged
//     RANKS   of pimpleFoam, threads of the built-in engine (2)
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "far_box.h"
#include "pimple_foam.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/openfoam/baffles.h"
#include "ripstop/flow/openfoam/case_writer.h"
#include "ripstop/flow/openfoam/installation.h"
#include "ripstop/flow/openfoam/programs.h"
#include "ripstop/flow/statistics.h"
#include "ripstop/output/plot.h"
#include "table.h"

using namespace ripstop;

namespace {

constexpr double box = 12, speed = 30;  // widths of 1 m; [m/s]

constexpr char schemes[] = R"foam(ddtSchemes { default backward; }
gradSchemes { default Gauss linear; }
divSchemes
{
    default none;
    div(phi,U) Gauss LUST grad(U);
    div((nuEff*dev2(T(grad(U))))) Gauss linear;
}
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
)foam";

constexpr char solution[] = R"foam(solvers
{
    p { solver GAMG; smoother GaussSeidel; tolerance 1e-8; relTol 0.05; }
    pFinal { $p; relTol 0.01; }
    "(U|UFinal)" { solver smoothSolver; smoother GaussSeidel; tolerance 1e-8; relTol 0.01; }
}
PIMPLE { nOuterCorrectors 1; nCorrectors 2; nNonOrthogonalCorrectors 0; }
)foam";

struct March {
  Record drag;         // [N], a value a step
  double seconds = 0;  // wall, of all steps but the first

  void add(double force, double length) {
    drag.until.push_back(drag.end() + length);
    drag.values.push_back(force);
  }
};

double since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

March builtin(const FlowProblem& problem, double length, int steps, int threads) {
  CartesianSettings settings;
  settings.second_order = true;
  settings.threads = threads;
  const auto engine = make_cartesian(settings);
  const auto flow = engine->start(problem);
  March march;
  auto begin = std::chrono::steady_clock::now();
  for (int n = 0; n < steps; ++n) {
    if (n == 1) begin = std::chrono::steady_clock::now();
    march.add(flow->step(length).force.z, length);
  }
  march.seconds = since(begin);
  return march;
}

March pimple_foam(const FlowProblem& problem, const std::vector<openfoam::BafflePatch>& cloth, double length,
                  int steps, int ranks, const std::filesystem::path& folder) {
  using namespace openfoam;
  Installation installation = find_installation({}, ranks > 1, true);
  installation.solver = "pimpleFoam";
  OpenFoamSettings settings;
  settings.folder = folder;
  settings.ranks = ranks;
  settings.incompressible = true;
  const Programs programs(settings, folder, installation);
  std::filesystem::create_directories(folder);
  clear_case(folder);
  write_case(folder, problem, settings);
  write_dictionary(folder / "system/fvSchemes", "dictionary", schemes);
  write_dictionary(folder / "system/fvSolution", "dictionary", solution);
  write_pimple_control(folder, length, steps, problem.air.density);
  write_dictionary(
      folder / "constant/turbulenceProperties", "dictionary",
      "simulationType LES;\nLES { LESModel WALE; delta cubeRootVol; turbulence on; printCoeffs off; "
      "cubeRootVolCoeffs { deltaCoeff 1; } }\n");
  write_mesh(folder / "constant/polyMesh", problem, cloth);
  write_fields(folder / "0", problem, true, {}, [&](const std::string& field) {
    std::string text;
    for (const BafflePatch& patch : cloth)
      for (const char* side : {"_low", "_high"})
        text += fmt::format("    {}{} {{ {} }}\n", patch.name, side,
                            field == "U"     ? "type slip;"
                            : field == "nut" ? "type calculated; value uniform 0;"
                                             : "type zeroGradient;");
    return text;
  });
  if (ranks > 1) programs.run_tool("decomposePar");
  March march;
  SolverLog log(SolverLog::Forces::pressure);
  bool stopped = false;
  auto begin = std::chrono::steady_clock::now();
  programs.run_solver(
      [&](const FlowProgress& progress) {
        if (march.drag.values.empty()) begin = std::chrono::steady_clock::now();
        march.add(progress.drag, length);
        march.seconds = since(begin);
        return true;
      },
      log, stopped);
  return march;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "bench_in_time FOLDER [ACROSS [TIME [RANKS]]]\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const int across = argc > 2 ? std::atoi(argv[2]) : 16, ranks = argc > 4 ? std::atoi(argv[4]) : 2;
  const double time = argc > 3 ? std::atof(argv[3]) : 2;
  std::filesystem::create_directories(folder);
  const FlowProblem problem = plate_of_faces(box, across, 1e6, speed);
  const std::vector<openfoam::BafflePatch> cloth = openfoam::baffles_of(problem);
  double faces = 0;
  for (const openfoam::BafflePatch& patch : cloth)
    for (const openfoam::Baffle& baffle : patch.baffles) faces += baffle.area.z;
  const double unit = 0.5 * problem.air.density * speed * speed * surface_area(problem.bodies[0].surface);
  // The stream is half as fast again near the rim: a Courant number of 0.45 there.
  const double length = 0.3 / across / speed;
  const int steps = static_cast<int>(std::lround(time / speed / length));
  const March ours = builtin(problem, length, steps, ranks),
              theirs = pimple_foam(problem, cloth, length, steps, ranks, folder / "case");
  print_table_head(
      fmt::format(
          "Impulsively started flow about a square plate, cells of d/{}: built-in engine and pimpleFoam",
          across),
      argc, argv, {"", "built-in", "pimpleFoam", "built-in compared with pimpleFoam"});
  const auto steps_of = [](const March& march) { return march.drag.values.size(); };
  const auto rate = [&](const March& march) {
    return 1e-6 * (static_cast<double>(steps_of(march)) - 1) * problem.grid.cells() / march.seconds;
  };
  print_row({"cells, steps, threads or ranks",
             fmt::format("{}, {}, {}", problem.grid.cells(), steps_of(ours), ranks),
             fmt::format("{}, {}, {}", problem.grid.cells(), steps_of(theirs), ranks), ""});
  print_row({"area of the faces [m2]", fmt::format("{:.4f}", surface_area(problem.bodies[0].surface)),
             fmt::format("{:.4f}", faces), ""});
  print_row({"million cell-steps per second", fmt::format("{:.2f}", rate(ours)),
             fmt::format("{:.3f}", rate(theirs)), fmt::format("{:.1f} times", rate(ours) / rate(theirs))});
  for (const double at : {0.1, 0.25, 0.5, 1.0, 1.5, 2.0}) {
    const std::size_t n = static_cast<std::size_t>(std::lround(at / speed / length)) - 1;
    if (n >= std::min(steps_of(ours), steps_of(theirs))) continue;
    print_row({fmt::format("drag coefficient after {} d/U", at),
               fmt::format("{:.3f}", ours.drag.values[n] / unit),
               fmt::format("{:.3f}", theirs.drag.values[n] / unit),
               fmt::format("{:+.1f} %", 100 * (ours.drag.values[n] / theirs.drag.values[n] - 1))});
  }
  if (time > 20) {
    const auto mean = [&](const March& march) {
      const MeanOverTime over = mean_over_time(march.drag, 0.5 * march.drag.end());
      return fmt::format("{:.3f} +- {:.3f}", over.mean / unit, over.standard_error / unit);
    };
    print_row({"mean of the second half, standard error", mean(ours), mean(theirs), ""});
  }
  Plot plot{
      "A square plate set into a stream at once", {"time [d/U]"}, {"drag coefficient", false, 0.0, 3.0}, {}};
  for (const auto& [name, march] : {std::pair{"built-in", &ours}, std::pair{"pimpleFoam", &theirs}}) {
    PlotSeries series{name, {}, {}, true, false};
    for (std::size_t n = 0; n < steps_of(*march); ++n) {
      series.x.push_back(march->drag.until[n] * speed);
      series.y.push_back(march->drag.values[n] / unit);
    }
    plot.series.push_back(series);
  }
  write_plot(folder / "drag.svg", plot);
  return 0;
}

// Which of OpenFOAM's solvers take a sheet as porousBafflePressure, and how dense it may be:
//   bench_openfoam_baffle FOLDER
// a porous plate in a stream, steady (simpleFoam, rhoSimpleFoam: the force on the cloth and the momentum that the box
// loses) and in time, suddenly exposed to the stream (pimpleFoam at a Courant number of 0.5 near the rim, and at a
// sixteenth of that; the force after a distance of one width). A result that oscillates from one iteration or step to
// the next is not valid.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "far_box.h"
#include "pimple_foam.h"
#include "ripstop/core/error.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/openfoam/baffles.h"
#include "ripstop/flow/openfoam/case_reader.h"
#include "ripstop/flow/openfoam/case_writer.h"
#include "ripstop/flow/openfoam/installation.h"
#include "ripstop/flow/openfoam/programs.h"
#include "ripstop/flow/steady.h"
#include "table.h"

using namespace ripstop;

namespace {

constexpr int across = 6, box = 6;  // cells and widths; the plate is 1 m wide
constexpr double speed = 10;        // [m/s]

constexpr char pimple_schemes[] = R"foam(ddtSchemes { default backward; }
gradSchemes { default Gauss linear; }
divSchemes
{
    default none;
    div(phi,U) Gauss linearUpwind grad(U);
    div(phi,k) Gauss upwind;
    div(phi,omega) Gauss upwind;
    div((nuEff*dev2(T(grad(U))))) Gauss linear;
}
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
wallDist { method meshWave; }
)foam";

constexpr char pimple_solution[] = R"foam(solvers
{
    "(p|pFinal)" { solver GAMG; smoother GaussSeidel; tolerance 1e-9; relTol 0.01; }
    "(U|k|omega)(Final)?" { solver smoothSolver; smoother GaussSeidel; tolerance 1e-9; relTol 0.01; }
}
PIMPLE { nOuterCorrectors 1; nCorrectors 2; nNonOrthogonalCorrectors 0; }
)foam";

double step_of(double courant) {
  return courant / 1.5 / across / speed;  // the stream is half as fast again near the rim
}

int steps_of(double courant) {  // a width's way
  return static_cast<int>(std::lround(1 / speed / step_of(courant)));
}

struct Way {
  std::string name, solver;
  double courant = 0;  // of a march in time; 0: iterations
};

/// All faces as one pair of cyclic patches.
openfoam::BafflePatch loose(const FlowProblem& problem) {
  openfoam::BafflePatch patch{"cloth", true, problem.bodies[0].drop().linear, 0, {}};
  for (openfoam::BafflePatch& part : openfoam::baffles_of(problem))
    for (openfoam::Baffle& baffle : part.baffles) patch.baffles.push_back(std::move(baffle));
  return patch;
}

void march_in_time(const std::filesystem::path& folder, const FlowProblem& problem, double length,
                   int steps) {
  using namespace openfoam;
  write_dictionary(folder / "system/fvSchemes", "dictionary", pimple_schemes);
  write_dictionary(folder / "system/fvSolution", "dictionary", pimple_solution);
  write_pimple_control(folder, length, steps, problem.air.density);
}

std::string told(double force, double swing) {
  return swing < 0.02 ? fmt::format("{:.2f}", force) : fmt::format("oscillates by {:.0f} %", 100 * swing);
}

double built_in(const FlowProblem& problem, double courant) {
  CartesianSettings settings;
  settings.second_order = true;
  const auto engine = make_cartesian(settings);
  if (courant == 0) return solve(*engine, problem).porous_force.z;
  const auto flow = engine->start(problem);
  double force = 0;
  for (int n = 0; n < steps_of(courant); ++n) force = flow->step(step_of(courant)).force.z;
  return force;
}

/// Force on the cloth at the end [N] and, for steady flow, the momentum deficit.
std::string with_baffle(const FlowProblem& problem, const Way& way, const std::filesystem::path& folder) {
  using namespace openfoam;
  Installation installation = find_installation({}, false, true);
  installation.solver = way.solver;
  OpenFoamSettings settings;
  settings.folder = folder;
  settings.incompressible = way.solver != "rhoSimpleFoam";
  settings.second_order = true;
  const Programs programs(settings, folder, installation);
  std::filesystem::create_directories(folder);
  clear_case(folder);
  write_case(folder, problem, settings);
  if (way.courant > 0) {
    march_in_time(folder, problem, step_of(way.courant), steps_of(way.courant));
  } else {
    write_solution(folder, 1e-5);
    write_control(folder, problem, settings.incompressible, {0, 400});
  }
  const BafflePatch patch = loose(problem);
  write_mesh(folder / "constant/polyMesh", problem, {patch});
  write_fields(folder / "0", problem, settings.incompressible, {}, [&](const std::string& field) {
    const std::string entry =
        field != "p" ? "type cyclic;"
                     : fmt::format(
                           "type porousBafflePressure; patchType cyclic; D {:.17g}; I 0; length 1; jump "
                           "uniform 0; value uniform {:.17g};",
                           patch.linear / problem.air.viscosity,
                           settings.incompressible ? 0 : outlet_pressure(problem.air));
    return fmt::format("    cloth_low {{ {0} }}\n    cloth_high {{ {0} }}\n", entry);
  });
  std::vector<double> drag;
  SolverLog log(SolverLog::Forces::pressure);
  bool stopped = false;
  programs.run_solver(
      [&](const FlowProgress& progress) {
        drag.push_back(progress.drag);
        return true;
      },
      log, stopped);
  const std::size_t last = drag.size() - 1;
  double swing = 0;
  if (way.courant > 0) {  // to and fro from step to step, whatever the flow does meanwhile
    for (std::size_t n = last - 8; n <= last; ++n)
      swing = std::max(swing, std::abs(drag[n] - 2 * drag[n - 1] + drag[n - 2]) / 4 / std::abs(drag[last]));
    return told(drag[last], swing);
  }
  const auto [low, high] = std::minmax_element(drag.end() - 50, drag.end());
  const FlowField field =
      read_case(read_mesh(folder, 1), latest_time(folder), problem, settings.incompressible);
  return fmt::format("{}, {:.2f}", told(drag[last], (*high - *low) / std::abs(drag[last])),
                     field.momentum_deficit.z);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "bench_openfoam_baffle FOLDER\n");
    return 2;
  }
  const Way steady[] = {{"simpleFoam", "simpleFoam"}, {"rhoSimpleFoam", "rhoSimpleFoam"}};
  const Way in_time[] = {{"pimpleFoam", "pimpleFoam", 0.5},
                         {"pimpleFoam, a sixteenth of the time step", "pimpleFoam", 0.5 / 16}};
  std::vector<std::string> columns = {"cloth, Pa s/m", "built-in, steady"};
  for (const Way& way : steady) columns.push_back(way.name + ", cloth, domain");
  columns.push_back("built-in, unsteady");
  for (const Way& way : in_time) columns.push_back(way.name);
  print_table_head("A porous plate of six cells with OpenFOAM's porousBafflePressure: drag, N", argc, argv,
                   columns);
  for (const double resistance : {1.0, 5.0, 20.0, 200.0}) {
    const FlowProblem problem = plate_of_faces(box, across, resistance, speed);
    const auto tried = [&](const Way& way) -> std::string {
      try {
        return with_baffle(problem, way, argv[1]);
      } catch (const Error& error) {
        if (error.code() != ExitCode::diverged) throw;
        return "diverges";
      }
    };
    std::vector<std::string> row = {fmt::format("{}", resistance),
                                    fmt::format("{:.2f}", built_in(problem, 0))};
    for (const Way& way : steady) row.push_back(tried(way));
    row.push_back(fmt::format("{:.2f}", built_in(problem, in_time[0].courant)));
    for (const Way& way : in_time) row.push_back(tried(way));
    print_row(row);
  }
  fmt::print("\n\"Cloth, domain\": force on the cloth, and momentum loss in the domain.\n");
  return 0;
}

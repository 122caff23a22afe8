#include "ripstop/flow/openfoam/case_writer.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>

#include "ripstop/core/error.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/flow/boundaries.h"
#include "ripstop/flow/openfoam/foam_file.h"
#include "ripstop/flow/openfoam/installation.h"
#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/flow/symmetry.h"

namespace ripstop::inline flow::openfoam {
namespace {

namespace fs = std::filesystem;

constexpr double kMolarGasConstant = 8314.47;  // [J/(kmol K)], as OpenFOAM has it

double kinematic_viscosity(const Freestream& air) {
  return air.viscosity / air.density;
}

}  // namespace

void close_written(std::ofstream& out, const fs::path& path) {
  out.close();
  if (!out) throw Error(ExitCode::io, fmt::format("cannot write {}: is the disk full?", path.string()));
}

void write_dictionary(const fs::path& path, const std::string& kind, const std::string& body,
                      const std::string& format) {
  fs::create_directories(path.parent_path());
  std::ofstream out(path, std::ios::binary);
  out << foam_header(kind, path.filename().string(), format) << body;
  close_written(out, path);
}

namespace {

/// The six faces of the box and the values of a field on them.
std::string boundary(const std::string& inlet, const std::string& outlet, const std::string& sides) {
  return fmt::format("    inlet {{ {} }}\n    outlet {{ {} }}\n    sides {{ {} }}\n", inlet, outlet, sides);
}

/// Transported fields: given at the inlet, and at the outlet where air comes back in.
std::string carried(const std::string& value, const std::string& back_flow, const std::string& sides) {
  return boundary(fmt::format("type fixedValue; value uniform {};", value),
                  fmt::format("type inletOutlet; inletValue uniform {}; value uniform {};", back_flow, value),
                  sides);
}

/// A far field on all six faces.
std::string everywhere(const std::string& condition) {
  return boundary(condition, condition, condition);
}

/// blockMesh's grading of one axis: parts of the length, of the cells, and last over first width.
std::string grading(const FlowGrid& grid, int axis) {
  const Grading& g = grid.grading[axis];
  const int n = grid.count(axis);
  if (g.before + g.after == 0) return "1";
  const double low = grid.edge(axis, 0), high = grid.edge(axis, n);
  std::string text = "(";
  const auto part = [&](double length, int cells, double expansion) {
    if (cells > 0) text += fmt::format(" ({:.17g} {} {:.17g})", length, cells, expansion);
  };
  part(g.core_low - low, g.before, std::pow(g.ratio_before, 1 - g.before));
  part(g.core_high - g.core_low, n - g.before - g.after, 1);
  part(high - g.core_high, g.after, std::pow(g.ratio_after, g.after - 1));
  return text + " )";
}

std::string mesh_dictionary(const FlowProblem& problem) {
  const FlowGrid& grid = problem.grid;
  const Vec3 a = grid.origin, b = grid.origin + grid.size;
  std::string vertices;
  for (const double z : {a.z, b.z}) {
    for (const auto& [x, y] :
         std::array<std::array<double, 2>, 4>{{{a.x, a.y}, {b.x, a.y}, {b.x, b.y}, {a.x, b.y}}}) {
      vertices += fmt::format("    ({:.17g} {:.17g} {:.17g})\n", x, y, z);
    }
  }
  const char *low_x = "(0 4 7 3)", *low_y = "(0 1 5 4)";
  const std::string planes = problem.quarter ? fmt::format(
                                                   "    {} {{ type symmetryPlane; faces ( {} ); }}\n    {} "
                                                   "{{ type symmetryPlane; faces ( {} ); }}\n",
                                                   symmetry_planes[0], low_x, symmetry_planes[1], low_y)
                                             : "";
  return fmt::format(
      "scale 1;\nvertices\n(\n{})\n;\n"
      "blocks ( hex (0 1 2 3 4 5 6 7) ({} {} {}) simpleGrading ({} {} {}) );\nedges ( );\n"
      "boundary\n(\n"
      "    inlet {{ type patch; faces ( (0 3 2 1) ); }}\n"
      "    outlet {{ type patch; faces ( (4 5 6 7) ); }}\n"
      "    sides {{ type patch; faces ( {} (1 2 6 5) (3 7 6 2) ); }}\n{}"
      ");\nmergePatchPairs ( );\n",
      vertices, grid.nx, grid.ny, grid.nz, grading(grid, 0), grading(grid, 1), grading(grid, 2),
      problem.quarter ? "" : fmt::format("{} {}", low_x, low_y), planes);
}

/// Factors of `ranks` along x, y, z with the least area between the parts.
std::array<int, 3> split(const FlowGrid& grid, int ranks) {
  std::array<int, 3> best = {1, 1, ranks};
  double least = INFINITY;
  for (int x = 1; x <= ranks; ++x) {
    for (int y = 1; x * y <= ranks; ++y) {
      if (ranks % (x * y) != 0) continue;
      const int z = ranks / (x * y);
      if (x > grid.nx || y > grid.ny || z > grid.nz) continue;
      const double area =
          (x - 1.0) * grid.ny * grid.nz + (y - 1.0) * grid.nx * grid.nz + (z - 1.0) * grid.nx * grid.ny;
      if (area < least) {
        least = area;
        best = {x, y, z};
      }
    }
  }
  return best;
}

constexpr char kThermophysics[] = R"foam(thermoType
{{
    type hePsiThermo;
    mixture pureMixture;
    transport const;
    thermo hConst;
    equationOfState perfectGas;
    specie specie;
    energy sensibleInternalEnergy;
}}
mixture
{{
    specie {{ molWeight {:.17g}; }}
    thermodynamics {{ Cp 1007; Hf 0; }}
    transport {{ mu {:.17g}; Pr 0.7; }}
}}
)foam";

// Terms of one solver only are listed too (e, rho, limits of p, the two names of the stress): the other
// ignores them.
constexpr char kSchemes[] = R"foam(ddtSchemes {{ default steadyState; }}
gradSchemes {{ default Gauss linear; limited cellLimited Gauss linear 1; }}
divSchemes
{{
    default none;
    div(phi,U) bounded Gauss {};
    div(phi,k) bounded Gauss upwind;
    div(phi,omega) bounded Gauss upwind;
    div(phi,e) bounded Gauss upwind;
    div(phi,Ekp) bounded Gauss upwind;
    div(((rho*nuEff)*dev2(T(grad(U))))) Gauss linear;
    div((nuEff*dev2(T(grad(U))))) Gauss linear;
}}
laplacianSchemes {{ default Gauss linear corrected; }}
interpolationSchemes {{ default linear; }}
snGradSchemes {{ default corrected; }}
wallDist {{ method meshWave; }}
)foam";

constexpr char kSolution[] = R"foam(solvers
{{
    p {{ solver GAMG; smoother GaussSeidel; tolerance 1e-12; relTol 0.05; }}
    "(U|k|omega|e)" {{ solver smoothSolver; smoother GaussSeidel; tolerance 1e-12; relTol 0.1; }}
}}
SIMPLE
{{
    nNonOrthogonalCorrectors {3};
    nUCorrectors 2;
    pMinFactor {1};
    pMaxFactor {2};
    residualControl {{ "(p|U|k|omega|e)" {0:.17g}; }}
}}
relaxationFactors
{{
    fields {{ p 0.3; rho 1; }}
    equations {{ U 0.7; "(k|omega)" 0.7; e 0.9; }}
}}
)foam";

constexpr char kControl[] = R"foam(application {4};
startFrom latestTime;
startTime 0;
stopAt endTime;
endTime {0:.17g};
deltaT 1;
writeControl runTime;
writeInterval {1};
purgeWrite 0;
writeFormat binary;
writePrecision 17;
writeCompression off;
timeFormat general;
timePrecision 12;
runTimeModifiable false;

functions
{{
    stopRequest
    {{
        type abort;
        libs ("libutilityFunctionObjects.so");
        file "<case>/{2}";
        action writeNow;
    }}
{3}}}
)foam";

constexpr char kForces[] = R"foam(    porousForces
    {{
        type forces;
        libs ("libforces.so");
        patches ({});
        porosity {};
        rho {};
        rhoInf {:.17g};
        CofR (0 0 0);
        log true;
        writeControl timeStep;
        writeInterval 1;
    }}
)foam";

// Between ranks the pressure of loose cloth would not jump: both sides of its faces are kept on one rank.
constexpr char kWholePatches[] = R"foam(constraints
{
    cloth { type preservePatches; patches ("cloth.*"); }
}
)foam";

// The solver's own porous zones: their resistance is added after the momentum equation is under-relaxed. (The
// porosity of fvOptions is relaxed with the rest; its converged drag differs by
// half a percent on 8 cm cells.)
constexpr char kResistance[] = R"foam(porous{0}
{{
    type DarcyForchheimer;
    active yes;
    cellZone porous{0};
    DarcyForchheimerCoeffs
    {{
        d ({1:.17g} {1:.17g} {1:.17g});
        f ({2:.17g} {2:.17g} {2:.17g});
        coordinateSystem
        {{
            type cartesian;
            origin (0 0 0);
            rotation {{ type axesRotation; e1 (1 0 0); e2 (0 1 0); }}
        }}
    }}
}}
)foam";

constexpr char kReadmeText[] =
    R"foam(An OpenFOAM case written by Ripstop: steady flow through {} in a box,
{} x {} x {} cells, air of {:.6g} kg/m3 at {:.6g} m/s, {} sides.
{}Ripstop owns this folder and overwrites it.

To run it by hand, with OpenFOAM's programs in PATH and WM_PROJECT_DIR set
(Debian: export WM_PROJECT_DIR=/usr/share/openfoam):

    rm -f {}
{}{}
{})foam";

constexpr char kOfQuarter[] =
    R"foam(The box is a quarter of the whole one, with planes of symmetry at x = 0 and y = 0 (patches symmetryX and
symmetryY). Forces in the logs and in postProcessing are those of the quarter: a quarter of the drag. In ParaView the
filter Reflect, once along X and once along Y, shows the whole flow.
)foam";

constexpr char kOfPorousCells[] =
    R"foam(The porous cells are in constant/cellZones, their resistances in
constant/porosityProperties. blockMesh and cp are needed only to make the mesh anew.
)foam";

constexpr char kOfSheets[] =
    R"foam(The mesh in constant/polyMesh is Ripstop's: the cloth lies in the patches cloth*. What passes those
that are walls is a part of the case, in the field U; Ripstop renews it as the pressure changes.
)foam";

constexpr char kOfFittedMesh[] =
    R"foam(constant/polyMesh is the mesh that snappyHexMesh made about the cloth of constant/triSurface, with the cloth in
the patches cloth*. What passes those that are walls is a part of the case, in the field U; Ripstop renews it as the
pressure changes. To make the mesh anew (Ripstop also opens cells that cloth shuts in, before createBaffles):

    rm -r constant/polyMesh
    blockMesh
    snappyHexMesh -overwrite
    createBaffles -overwrite
)foam";

void write_readme(const fs::path& folder, const FlowProblem& problem, const OpenFoamSettings& settings) {
  const FlowGrid& grid = problem.grid;
  const char* solver = solver_name(settings.incompressible, problem.has_sheets());
  const std::string run = settings.ranks > 1 ? fmt::format(
                                                   "    decomposePar\n    mpirun -np {} {} -parallel\n"
                                                   "    reconstructPar -latestTime\n",
                                                   settings.ranks, solver)
                                             : fmt::format("    {}\n", solver);
  std::ofstream readme(folder / kReadme);
  const bool sheets = problem.has_sheets();
  readme << fmt::format(kReadmeText, sheets ? "sheets" : "porous cells", grid.nx, grid.ny, grid.nz,
                        problem.air.density, problem.air.speed(),
                        sides_of(problem) == Sides::zero_gradient ? "open" : sides_of(problem).word,
                        problem.quarter ? kOfQuarter : "", kStopFile,
                        sheets ? "" : "    blockMesh\n    cp constant/cellZones constant/polyMesh/\n", run,
                        !sheets                ? kOfPorousCells
                        : settings.fitted_mesh ? kOfFittedMesh
                                               : kOfSheets);
  close_written(readme, folder / kReadme);
}

void range(const char* what, double value, double low, double high, const char* unit) {
  if (!(value >= low && value <= high)) {
    throw Error(ExitCode::usage,
                fmt::format("flow: {} is {:g} {}; it must be in [{:g}, {:g}]", what, value, unit, low, high));
  }
}

}  // namespace

double outlet_pressure(const Freestream& air) {
  return air.density * gas_constant_of_air * air.temperature;
}

void check_run(int iterations, double residual) {
  range("residual", residual, 1e-14, 1, "");
  range("number of iterations", iterations, 1, 1e7, "");
}

void check(const FlowProblem& problem) {
  const auto refuse = [](bool has, const std::string& what) {
    if (has)
      throw QuantityError(ExitCode::usage, fmt::format("{} needs the built-in engine", what),
                          {"open jet", "sides", "outlet", "the built-in engine"});
  };
  refuse(problem.jet.has_value(), "open jet");
  const Sides sides = sides_of(problem);
  refuse(sides != Sides::zero_gradient && sides != Sides::slip && sides != Sides::far_field,
         fmt::format("sides = \"{}\"", sides.word));
  refuse(sides != Sides::far_field && problem.outlet != Outlet::fixed_pressure,
         fmt::format("outlet = \"{}\"", problem.outlet.word));
  refuse(!problem.body_force.empty(), "a force on the air");
  check_quarter(problem);
  const FlowGrid& grid = problem.grid;
  for (const int n : {grid.nx, grid.ny, grid.nz}) range("number of cells along an axis", n, 1, 4000, "");
  range("number of cells", double(grid.nx) * grid.ny * grid.nz, 1, 2e8, "");
  for (const double s : {grid.size.x, grid.size.y, grid.size.z})
    range("size of the domain", s, 1e-6, 1e6, "m");
  for (const double o : {grid.origin.x, grid.origin.y, grid.origin.z})
    range("corner of the domain", o, -1e6, 1e6, "m");
  const Freestream& air = problem.air;
  range("air density", air.density, 1e-4, 100, "kg/m3");
  range("viscosity", air.viscosity, 1e-7, 1, "Pa s");
  range("air temperature", air.temperature, 100, 2000, "K");
  check_stream(air);
  range("turbulence intensity", air.turbulence_intensity, 1e-6, 1, "");
  range("viscosity ratio", air.viscosity_ratio, 1e-6, 1e6, "");
  check_bodies(problem);
  std::vector<char> taken(static_cast<std::size_t>(grid.cells()), 0);
  for (const FlowBody& body : problem.bodies) {
    if (body.is_sheet()) continue;
    refuse(problem.has_sheets(), "a porous body together with a sheet");
    const PorousCells& porous = body.porous();
    range("Darcy coefficient", porous.darcy, 0, 1e15, "1/m2");
    range("Forchheimer coefficient", porous.forchheimer, 0, 1e12, "1/m");
    for (const int cell : porous.cells) {
      range("index of a porous cell", cell, 0, grid.cells() - 1, "");
      if (taken[cell]) {
        throw Error(ExitCode::usage,
                    fmt::format("flow: cell {} is porous twice; a cell has one resistance", cell));
      }
      taken[cell] = 1;
    }
  }
}

void write_case(const fs::path& folder, const FlowProblem& problem, const OpenFoamSettings& settings) {
  write_readme(folder, problem, settings);  // first: where the rest fails the folder is known as ours
  if (!problem.has_sheets() || settings.fitted_mesh)
    write_dictionary(folder / "system/blockMeshDict", "dictionary", mesh_dictionary(problem));
  // At the edge of a sheet without thickness an unlimited gradient throws the flow off.
  const char* second_order = !problem.has_sheets() ? "linearUpwind grad(U)" : "linearUpwind limited";
  write_dictionary(folder / "system/fvSchemes", "dictionary",
                   fmt::format(kSchemes, settings.second_order ? second_order : "upwind"));
  const std::array<int, 3> parts = split(problem.grid, settings.ranks);
  write_dictionary(
      folder / "system/decomposeParDict", "dictionary",
      fmt::format("numberOfSubdomains {};\nmethod hierarchical;\n"
                  "coeffs {{ n ({} {} {}); order xyz; delta 1e-6; }}\n{}",
                  settings.ranks, parts[0], parts[1], parts[2], problem.has_sheets() ? kWholePatches : ""));
  if (settings.incompressible) {
    write_dictionary(
        folder / "constant/transportProperties", "dictionary",
        fmt::format("transportModel Newtonian;\nnu {:.17g};\n", kinematic_viscosity(problem.air)));
  } else {
    write_dictionary(
        folder / "constant/thermophysicalProperties", "dictionary",
        fmt::format(kThermophysics, kMolarGasConstant / gas_constant_of_air, problem.air.viscosity));
  }
  write_dictionary(folder / "constant/turbulenceProperties", "dictionary",
                   "simulationType RAS;\nRAS { RASModel kOmegaSST; turbulence on; printCoeffs off; }\n");
}

void write_fields(const fs::path& folder, const FlowProblem& problem, bool incompressible,
                  const FieldText& cells, const FieldText& cloth) {
  const Freestream& air = problem.air;
  const std::string open = problem.sides == Sides::slip ? "type slip;" : "type zeroGradient;";
  const auto number = [](double value) { return fmt::format("{:.17g}", value); };
  const std::string p = number(incompressible ? 0 : outlet_pressure(air));
  const std::string velocity =
      fmt::format("({:.17g} {:.17g} {:.17g})", air.velocity.x, air.velocity.y, air.velocity.z);
  const double fluctuation = air.turbulence_intensity * air.speed();
  const double k = 1.5 * fluctuation * fluctuation;
  const double omega = k / (kinematic_viscosity(air) * air.viscosity_ratio);
  const std::string calculated = "type calculated; value uniform 0;";
  std::string planes;
  for (const char* plane : symmetry_planes)
    if (problem.quarter) planes += fmt::format("    {} {{ type symmetryPlane; }}\n", plane);
  const auto write = [&](const std::string& name, const char* kind, const char* dimensions,
                         const std::string& uniform, const std::string& faces) {
    const std::string inner = cells ? cells(name) : "";
    const std::string body = fmt::format(
        "dimensions [{} 0 0 0];\n\ninternalField {};\n\nboundaryField\n{{\n{}{}{}}}\n", dimensions,
        inner.empty() ? "uniform " + uniform : inner, faces, planes, cloth ? cloth(name) : "");
    write_dictionary(folder / name, kind, body, cells ? "binary" : "ascii");
  };
  // OpenFOAM's far field: between given velocity and given pressure by the cosine of velocity and face.
  const bool far = sides_of(problem) == Sides::far_field;
  write("p", "volScalarField", incompressible ? "0 2 -2 0" : "1 -1 -2 0", p,
        far ? everywhere(fmt::format("type freestreamPressure; freestreamValue uniform {};", p))
            : boundary("type zeroGradient;", fmt::format("type fixedValue; value uniform {};", p), open));
  write("U", "volVectorField", "0 1 -1 0", velocity,
        far ? everywhere(fmt::format("type freestreamVelocity; freestreamValue uniform {};", velocity))
            : carried(velocity, "(0 0 0)", open));
  const auto write_carried = [&](const char* name, const char* dimensions, const std::string& value) {
    write(name, "volScalarField", dimensions, value,
          far ? everywhere(fmt::format("type inletOutlet; inletValue uniform {0}; value uniform {0};", value))
              : carried(value, value, open));
  };
  write_carried("k", "0 2 -2 0", number(k));
  write_carried("omega", "0 0 -1 0", number(omega));
  write("nut", "volScalarField", "0 2 -1 0", number(k / omega), boundary(calculated, calculated, calculated));
  if (incompressible) return;
  write_carried("T", "0 0 0 1", number(air.temperature));
  write("alphat", "volScalarField", "1 -1 -1 0", "0", boundary(calculated, calculated, calculated));
}

void write_control(const fs::path& folder, const FlowProblem& problem, bool incompressible,
                   const RunControl& control) {
  const bool sheets = problem.has_sheets();
  const std::string forces =
      problem.bodies.empty() ? ""
                             : fmt::format(kForces, sheets ? "\"cloth.*\"" : "", sheets ? "false" : "true",
                                           incompressible ? "rhoInf" : "rho", problem.air.density);
  write_dictionary(folder / "system/controlDict", "dictionary",
                   fmt::format(kControl, control.start + control.iterations, control.iterations, kStopFile,
                               forces, solver_name(incompressible, sheets)));
}

void write_solution(const fs::path& folder, double residual, int corrections) {
  write_dictionary(folder / "system/fvSolution", "dictionary",
                   fmt::format(kSolution, residual, kLowestPressure, kHighestPressure, corrections));
}

void write_resistance(const fs::path& folder, const std::vector<FlowBody>& bodies) {
  std::string body;
  for (std::size_t zone = 0; zone < bodies.size(); ++zone) {
    const PorousCells& porous = bodies[zone].porous();
    body += fmt::format(kResistance, zone, porous.darcy, porous.forchheimer);
  }
  write_dictionary(folder / "constant/porosityProperties", "dictionary", body);
}

void write_zones(const fs::path& folder, const std::vector<std::vector<int>>& zones) {
  std::string body = fmt::format("{}\n(\n", zones.size());
  for (std::size_t zone = 0; zone < zones.size(); ++zone) {
    body += fmt::format("porous{}\n{{\n    type cellZone;\n    cellLabels List<label> {}(", zone,
                        zones[zone].size());
    for (const int cell : zones[zone]) body += fmt::format("{}\n", cell);
    body += ");\n}\n";
  }
  write_dictionary(folder / "cellZones", "regIOobject", body + ")\n");
}

}  // namespace ripstop::inline flow::openfoam

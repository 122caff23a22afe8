// ripstop fabric: the cloth under a given pressure, without a flow.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>

#include "case_options.h"
#include "commands.h"
#include "progress.h"
#include "ripstop/canopy/shape.h"
#include "ripstop/canopy/stress.h"
#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/picture.h"
#include "ripstop/output/vtk.h"
#include "warnings.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path case_file;
  Overrides overrides;
  std::optional<double> pressure;
  fs::path out;
};

int run(const Options& options) {
  const Case value = read_case(options.case_file, options.overrides);
  const Air stream = air(value);
  const double pressure = options.pressure.value_or(0.5 * stream.density * stream.speed * stream.speed);
  const CanopyMesh mesh = parachute_mesh(value);
  ClothOptions cloth_options;
  cloth_options.linear = value.coupling.linear;
  const ClothPtr cloth = make_cloth(mesh, cloth_options);
  ClothState state = start_state(*cloth);
  const Loads loads{std::vector<double>(mesh.cell_count(), pressure), {}};
  RelaxOptions relax_options;
  relax_options.tolerance = value.coupling.cloth_tolerance;
  ThreadTeam team(value.coupling.threads);
  Progress progress;
  const auto begin = std::chrono::steady_clock::now();
  const RelaxResult relaxed = relax(state, *cloth, loads, relax_options, team, [&](const RelaxProgress& p) {
    progress.show(fmt::format("cloth: step {}, residual {:.1e} (wanted {:.0e})", p.steps, p.residual,
                              relax_options.tolerance));
  });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  const std::vector<Vec3> shape = positions(state, *cloth);
  const CanopySize size = canopy_size(mesh, shape);
  const std::vector<CellStress> stress = cell_stress(*cloth, state);
  const StressPeak peak = stress_peak(mesh, shape, stress);
  const std::vector<double> tensions = spring_tensions(*cloth, state);
  double line = 0;
  for (const LineTension& t : line_tensions(mesh, tensions)) line = std::max(line, t.largest_tension);
  progress.line(fmt::format("{}: {} nodes under {:.4g} Pa, {} steps in {:.2f} s, residual {:.1e}",
                            value.title, mesh.node_count(), pressure, relaxed.steps, seconds,
                            relaxed.residual));
  const auto row = [](const char* name, const std::string& text) { fmt::print("  {:<26} {}\n", name, text); };
  row("pressure load", fmt::format("{:.2f} N", pressure_force(*cloth, state, loads).z));
  row("line tension, axial sum", fmt::format("{:.2f} N", force_on_fixed(*cloth, state).z));
  row("projected diameter", fmt::format("{:.3f} m", size.projected_diameter));
  const KnownRange known = experience(value.parachute).projected_ratio;
  std::string ratio = fmt::format(
      "{:.3f}", size.projected_diameter / std::sqrt(4 / std::numbers::pi * nominal_area(value.parachute)));
  if (known.low > 0)
    ratio += known.low < known.high
                 ? fmt::format(" (Knacke, in flight: {:.2f} to {:.2f})", known.low, known.high)
                 : fmt::format(" (Knacke, in flight: {:.2f})", known.low);
  row("projected / nominal", ratio);
  row("skirt diameter", fmt::format("{:.3f} m", size.skirt_diameter));
  row("highest line tension", fmt::format("{:.1f} N", line));
  row("highest stress", fmt::format("{:.0f} N/m von Mises, on the {}", peak.von_mises, peak.patch));

  print_mesh_warning(value);
  print_material_warnings(value, peak.strain);

  if (!options.out.empty()) {
    make_folder(options.out);
    std::vector<double> mises;
    for (const CellStress& s : stress) mises.push_back(s.von_mises);
    VtkSurface canopy = canopy_surface(mesh, shape);
    canopy.cell_arrays.push_back(vtk_array("von_mises_n_per_m", cloth_cells_only(mesh, mises)));
    write_vtp(options.out / "canopy.vtp", canopy);
    VtkSurface lines = spring_lines(mesh, shape);
    lines.cell_arrays.push_back(vtk_array("tension_n", tensions));
    write_vtp(options.out / "lines.vtp", lines);
    write_canopy_picture(
        options.out / "canopy.png", mesh, shape,
        {fmt::format("{} under {:.4g} Pa", value.title, pressure), "von Mises stress [N/m]", mises, {}});
    row("files", options.out.string() + " (canopy.png, canopy.vtp, lines.vtp)");
  }
  if (!relaxed.converged) {
    throw Error(ExitCode::not_converged,
                fmt::format("no equilibrium within {} steps: residual {:.1e}, wanted {:.0e}", relaxed.steps,
                            relaxed.residual, relax_options.tolerance));
  }
  return 0;
}

}  // namespace

void add_fabric(CLI::App& app, int& status) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("fabric", "The cloth under a given pressure, without a flow: a quick look");
  command->footer("Example: ripstop fabric examples/stratos-iv/case.toml --pressure 500 --out look");
  command->add_option("case", options->case_file, "Case file (TOML)")->required();
  command->add_option("--pressure", options->pressure,
                      "Pressure over the whole canopy [Pa]; default: the dynamic pressure");
  add_case_options(*command, options->overrides);
  command->add_option("--out", options->out, "Folder for a picture and files for ParaView");
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop

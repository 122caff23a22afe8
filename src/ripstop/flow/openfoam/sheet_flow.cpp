#include "ripstop/flow/openfoam/sheet_flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/flow/openfoam/baffles.h"
#include "ripstop/flow/openfoam/case_reader.h"
#include "ripstop/flow/openfoam/case_writer.h"
#include "ripstop/flow/openfoam/fitted_mesh.h"
#include "ripstop/flow/openfoam/foam_file.h"
#include "ripstop/flow/openfoam/programs.h"
#include "ripstop/flow/openfoam/state.h"

namespace ripstop::inline flow::openfoam {
namespace {

namespace fs = std::filesystem;

const std::string kBegin = "0";  // the folder of the time that a run begins with
constexpr double small =
    1e-3;  // of the stream's speed: a change of the velocity through cloth below which no new run begins
constexpr const char* cell_fields[] = {"p", "U", "k", "omega"};

int components_of(const std::string& field) {
  return field == "U" ? 3 : 1;
}

Installation with_simple_foam(Installation installation, const OpenFoamSettings& settings) {
  installation.solver = solver_name(true, true);
  program(installation, installation.solver);
  if (settings.ranks > 1) program(installation, "reconstructPar");
  if (settings.fitted_mesh)
    for (const char* tool : {"snappyHexMesh", "createBaffles", "checkMesh"}) program(installation, tool);
  return installation;
}

/// If the cloth has moved, or the velocity through tight cloth has changed, the run begins anew with the cell values
/// of the last one, in the folder of time 0; else it continues.
class SheetFlow final : public Flow {
 public:
  SheetFlow(const FlowProblem& problem, const OpenFoamSettings& settings, const fs::path& folder,
            const Installation& installation)
      : given_grid_(problem.grid),
        problem_(solved_part(problem)),
        settings_(settings),
        folder_(folder),
        programs_(settings, folder, installation) {
    settings_.incompressible = true;
    check(problem);
    if (problem_.quarter && settings_.fitted_mesh)
      throw QuantityError(
          ExitCode::usage,
          "flow: cells cannot be fitted to cloth in a quarter of the domain; solve the full domain",
          {"kind of mesh", "symmetry of the flow"});
    fs::create_directories(folder_);
    start_afresh();
  }

  void place(std::size_t body, const std::vector<Triangle>& surface, const SheetMotion&) override {
    problem_.bodies.at(body).surface = surface;
    if (!settings_.fitted_mesh) return lay_cloth();
    const Cells before = cells_on_grid();
    lay_cloth();
    write_cells(on_mesh(before));
  }

  FlowAdvance advance(int iterations, double residual, const FlowReport& report) override {
    check_run(iterations, residual);
    FlowAdvance now;
    int done = 0;
    while (done < iterations && !now.converged && !now.stopped) {
      const int piece = std::min(Stopping::piece, iterations - done);
      SolverLog log(SolverLog::Forces::pressure, parts_of(problem_));
      run(piece, residual, log, now.stopped, [&](FlowProgress progress) {
        progress.iteration += done;
        return !report || report(progress);
      });
      now.last = log.progress();
      now.last.iteration += done;
      now.converged =
          log.converged() && !has_to_begin_anew();  // the velocity through cloth has converged as well
      done = now.last.iteration;
    }
    return now;
  }

  FlowField field() const override {
    FlowField field = whole_field(read_case(mesh_, time_, problem_, true), given_grid_);
    field.sheet_loads = loads_;
    field.bodies.resize(problem_.bodies.size());
    for (const SheetLoad& load : loads_) {
      const auto which = static_cast<std::size_t>(load.body);
      field.porous_force += load.force;
      field.bodies[which].force += load.force;
      field.bodies[which].moment += cross(load.point - problem_.bodies[which].moment_about, load.force);
    }
    return field;
  }
  std::vector<SheetLoad> sheet_loads() const override { return loads_; }

  bool untouched() const override { return untouched_; }
  void start_afresh() override {
    clear_case(folder_);
    double area = 0;
    for (const FlowBody& body : problem_.bodies) area += surface_area(body.surface);
    programs_.need_space(fitted_cells(problem_.grid, area, settings_.cloth_levels));
    write_case(folder_, problem_, settings_);
    write_solution(folder_, problem_.stopping.residual, corrections());
    write_control(folder_, problem_, true, {0, 1});  // required by the tools of OpenFOAM
    untouched_ = true;
    loads_.clear();
    lay_cloth();
    time_ = kBegin;
    write_fields(folder_ / kBegin, problem_, true);
  }

  void save(const fs::path& folder) const override { save_state(folder, basis(), folders(), time_); }
  void restore(const fs::path& folder) override {
    const SavedState state = read_state(folder);
    if (!(state.basis == basis()))
      throw Error(ExitCode::usage, fmt::format("the flow saved in {} was made with a different flow domain, "
                                               "different air or different settings of OpenFOAM",
                                               folder.string()));
    if (!settings_.fitted_mesh) lay_cloth();
    copy_state(folder, state, folders());
    time_ = state.time;
    untouched_ = false;
    if (settings_.fitted_mesh) read_cloth();
  }

 private:
  // With fewer than two the flow about the folds of a canopy ran away on its first iterations.
  int corrections() const { return settings_.fitted_mesh ? 3 : 0; }
  Basis basis() const {
    return {problem_.grid,         problem_.air,           problem_.sides,
            settings_.ranks,       settings_.second_order, true,
            settings_.fitted_mesh, settings_.cloth_levels, problem_.quarter};
  }
  CaseFolders folders() const { return {folder_, {folder_}, settings_.fitted_mesh}; }
  std::vector<fs::path> part_folders() const {
    if (settings_.ranks == 1) return {folder_};
    std::vector<fs::path> parts;
    for (int rank = 0; rank < settings_.ranks; ++rank)
      parts.push_back(folder_ / fmt::format("processor{}", rank));
    return parts;
  }

  void lay_cloth() {
    if (settings_.fitted_mesh) {
      purge("");
      make_fitted_mesh(folder_, problem_, settings_.cloth_levels, programs_);
      return read_cloth();
    }
    patches_ = baffles_of(problem_);
    write_mesh(folder_ / "constant/polyMesh", problem_, patches_);
    mesh_ = read_mesh(folder_, 1);
    through_.clear();
    goes_on_ = false;
  }
  void read_cloth() {
    FittedMesh fitted = read_fitted_mesh(folder_, problem_);
    patches_ = std::move(fitted.patches);
    mesh_ = {std::move(fitted.part)};
    through_.clear();
    goes_on_ = false;
  }

  /// Of every field the values of all cells.
  using Cells = std::map<std::string, std::vector<double>>;
  Cells all_values() const {
    Cells cells;
    for (const char* field : cell_fields) cells[field] = values(field);
    return cells;
  }
  /// Means over the cells of the mesh in each cell of the grid.
  Cells cells_on_grid() const {
    Cells on_grid;
    const MeshPart& part = mesh_.front();
    for (const auto& [field, values] : all_values()) {
      const std::size_t parts = static_cast<std::size_t>(components_of(field));
      std::vector<double>& means = on_grid[field];
      means.resize(parts * static_cast<std::size_t>(problem_.grid.cells()));
      for (std::size_t n = 0; n < values.size(); ++n)
        means[parts * static_cast<std::size_t>(part.global(n / parts)) + n % parts] +=
            part.weight(n / parts) * values[n];
      for (const auto& [cell, nearest] : part.stand_ins)
        for (std::size_t c = 0; c < parts; ++c)
          means[parts * static_cast<std::size_t>(cell) + c] =
              values[parts * static_cast<std::size_t>(nearest) + c];
    }
    return on_grid;
  }
  Cells on_mesh(const Cells& on_grid) const {
    Cells on_mesh;
    const MeshPart& part = mesh_.front();
    for (const auto& [field, means] : on_grid) {
      const std::size_t parts = static_cast<std::size_t>(components_of(field));
      std::vector<double>& values = on_mesh[field];
      values.resize(parts * part.count(problem_.grid));
      for (std::size_t n = 0; n < values.size(); ++n)
        values[n] = means[parts * static_cast<std::size_t>(part.global(n / parts)) + n % parts];
    }
    return on_mesh;
  }

  std::vector<double> values(const std::string& field) const {
    const std::size_t count = mesh_.front().count(problem_.grid),
                      parts = static_cast<std::size_t>(components_of(field));
    FieldData data = read_field(folder_ / time_ / field, components_of(field), count);
    if (data.inner.size() == count * parts) return std::move(data.inner);
    std::vector<double> all(count * parts);
    for (std::size_t n = 0; n < all.size(); ++n) all[n] = data.inner[n % parts];
    return all;
  }
  /// Across tight cloth, from low to high [Pa].
  double drop(const Baffle& baffle, const std::vector<double>& p) const {
    return problem_.air.density * (p[baffle.low] - p[baffle.high]);
  }
  /// Velocity through the faces of tight cloth [m/s], all of them, one step closer to the value required by
  /// the pressure.
  std::vector<double> through_tight(const std::vector<double>& p) const {
    std::vector<double> through;
    for (const BafflePatch& patch : patches_) {
      if (patch.loose) continue;
      for (const Baffle& baffle : patch.baffles) {
        const double asked = passing(baffle, problem_.bodies, drop(baffle, p));
        const double before = through_.empty() ? 0 : through_[through.size()];
        through.push_back(before + pace(baffle, problem_) * (asked - before));
      }
    }
    return through;
  }

  /// Values of a field on the patches of the cloth.
  std::string on_cloth(const std::string& field) const {
    std::string text;
    for (const BafflePatch& patch : patches_) {
      const std::string entry = patch.loose ? on_loose(field, patch) : on_tight(field, patch);
      for (const char* side : {"_low", "_high"})
        text += fmt::format("    {}{} {{ {} }}\n", patch.name, side, entry);
    }
    return text;
  }
  std::string on_loose(const std::string& field, const BafflePatch& patch) const {
    if (field != "p") return "type cyclic;";
    return fmt::format(
        "type porousBafflePressure; patchType cyclic; D {:.17g}; I {:.17g}; length 1; jump uniform 0; value "
        "uniform 0;",
        patch.linear / problem_.air.viscosity, 2 * patch.quadratic / problem_.air.density);
  }
  std::string on_tight(const std::string& field, const BafflePatch& patch) const {
    if (field == "nut") return "type fixedValue; value uniform 0;";  // else it pulls on the wall
    if (field != "U") return "type zeroGradient;";
    std::vector<double> through;
    std::size_t first = 0;  // of through_, of this patch
    for (const BafflePatch& other : patches_) {
      if (&other == &patch) break;
      if (!other.loose) first += other.baffles.size();
    }
    for (std::size_t n = 0; n < patch.baffles.size(); ++n) {
      const Vec3 area = patch.baffles[n].area, v = through_[first + n] / norm(area) * area;
      through.insert(through.end(), {v.x, v.y, v.z});
    }
    return fmt::format("type fixedNormalSlip; fixedValue nonuniform List<vector> {};",
                       binary_list(through, 3));
  }

  /// Cell values as time 0, with the present velocity through tight cloth.
  void begin_anew() {
    const Cells cells = all_values();
    through_ = through_tight(cells.at("p"));
    write_cells(cells, [&](const std::string& field) { return on_cloth(field); });
  }
  void write_cells(const Cells& cells, const FieldText& cloth = {}) {
    const fs::path start = folder_ / "start";
    write_fields(
        start, problem_, true,
        [&](const std::string& field) {
          const auto found = cells.find(field);
          if (found == cells.end()) return std::string();
          const int parts = components_of(field);
          return fmt::format("nonuniform List<{}> {}", parts == 3 ? "vector" : "scalar",
                             binary_list(found->second, parts));
        },
        cloth);
    purge("");
    fs::rename(start, folder_ / kBegin);
    time_ = kBegin;
  }

  bool has_to_begin_anew() const {
    if (!goes_on_) return true;
    const std::vector<double> now = through_tight(pressure_);
    double change = 0;
    for (std::size_t n = 0; n < now.size(); ++n) change = std::max(change, std::abs(now[n] - through_[n]));
    return change > small * problem_.air.speed();
  }

  /// Leaves only the fields of one time.
  void purge(const std::string& keep) const {
    std::vector<fs::path> folders = part_folders();
    if (settings_.ranks > 1) folders.push_back(folder_);
    for (const fs::path& folder : folders) {
      if (!fs::exists(folder)) continue;
      for (std::string time = latest_time(folder); !time.empty(); time = latest_time(folder)) {
        if (time == keep) break;
        remove_path(folder / time);
      }
    }
  }

  void run(int iterations, double residual, SolverLog& log, bool& stopped, const FlowReport& report) {
    const bool anew = has_to_begin_anew();
    if (anew) begin_anew();
    const std::string before = time_;
    write_solution(folder_, residual, corrections());
    write_control(folder_, problem_, true, {std::stod(before), iterations});
    if (anew && settings_.ranks > 1) {
      for (const fs::path& part : part_folders()) remove_path(part);
      programs_.run_tool("decomposePar");
    }
    fs::remove(folder_ / kStopFile);
    const ProcessResult result = programs_.run_solver(report, log, stopped);
    if (settings_.ranks > 1) programs_.run_tool("reconstructPar");
    time_ = latest_time(folder_);
    if (time_ == before)
      throw Error(ExitCode::external,
                  fmt::format("{} ended with {} but left no fields in {}; see {}", programs_.solver(),
                              describe(result), folder_.string(), programs_.solver_log().string()));
    for (const fs::path& part : part_folders()) remove_path(part / before);
    remove_path(folder_ / before);
    goes_on_ = true;
    untouched_ = false;
    find_loads();
  }

  /// Drop on every face of a patch, from low to high [Pa]: of the pressure across tight cloth, of the law for
  /// the velocity through loose cloth.
  std::vector<double> drops(const BafflePatch& patch, const std::vector<double>& p,
                            const FieldData& flux) const {
    std::vector<double> drops;
    for (std::size_t n = 0; n < patch.baffles.size(); ++n) {
      const Baffle& baffle = patch.baffles[n];
      if (!patch.loose) {
        drops.push_back(drop(baffle, p));
        continue;
      }
      const double v = flux.at(flux.patches.at(patch.name + "_low"), n) / norm(baffle.area);
      drops.push_back(patch.linear * v + patch.quadratic * v * std::abs(v));
    }
    return drops;
  }

  void find_loads() {
    pressure_ = values("p");
    const FieldData flux = read_field(folder_ / time_ / "phi", 1, mesh_.front().inner_faces());
    loads_.clear();
    for (const BafflePatch& patch : patches_) {
      const std::vector<double> whole = drops(patch, pressure_, flux);
      for (std::size_t n = 0; n < patch.baffles.size(); ++n) add_loads(patch.baffles[n], whole[n]);
    }
  }

  /// The drop acts on the whole face; layers share it as they resist.
  void add_loads(const Baffle& baffle, double drop) {
    const double v = std::abs(passing(baffle, problem_.bodies, drop));
    std::vector<double> part;
    double sum = 0;
    for (const Layer& layer : baffle.layers) {
      const PressureDrop& law = problem_.bodies[layer.body].drop();
      part.push_back(law.linear / layer.slant + law.quadratic * v / (layer.slant * layer.slant));
      sum += part.back();
    }
    for (std::size_t n = 0; n < part.size(); ++n) {
      const Layer& layer = baffle.layers[n];
      const double own = sum > 0 ? drop * part[n] / sum : drop / static_cast<double>(part.size());
      SheetLoad load;
      load.body = layer.body;
      load.triangle = layer.triangle;
      load.point = layer.point;
      load.outward = layer.outward;
      load.drop = layer.against ? -own : own;
      load.force = own * baffle.area;
      load.area = layer.area;
      if (problem_.quarter)
        cartesian::add_images(load, layer.mirrored, 0, loads_);
      else
        loads_.push_back(load);
    }
  }

  FlowGrid given_grid_;  // of the whole box
  FlowProblem problem_;  // of the part of it that is solved
  OpenFoamSettings settings_;
  fs::path folder_;
  Programs programs_;
  std::vector<BafflePatch> patches_;
  std::vector<MeshPart> mesh_;
  std::string time_ = kBegin;
  bool untouched_ = true;
  bool goes_on_ = false;          // the fields of time_ are of the mesh as it is
  std::vector<double> through_;   // tight cloth, as OpenFOAM has it [m/s]
  std::vector<double> pressure_;  // of time_, over the density, where the run continues [m2/s2]
  std::vector<SheetLoad> loads_;
};

}  // namespace

std::unique_ptr<Flow> start_sheet_flow(const FlowProblem& problem, const OpenFoamSettings& settings,
                                       const fs::path& folder, const Installation& installation) {
  return std::make_unique<SheetFlow>(problem, settings, folder, with_simple_foam(installation, settings));
}

}  // namespace ripstop::inline flow::openfoam

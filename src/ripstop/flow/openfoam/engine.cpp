#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/process.h"
#include "ripstop/flow/openfoam/case_reader.h"
#include "ripstop/flow/openfoam/case_writer.h"
#include "ripstop/flow/openfoam/hostfile.h"
#include "ripstop/flow/openfoam/installation.h"
#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/flow/openfoam/programs.h"
#include "ripstop/flow/openfoam/sheet_flow.h"
#include "ripstop/flow/openfoam/solver_log.h"
#include "ripstop/flow/openfoam/state.h"

namespace ripstop::inline flow {
namespace {

namespace fs = std::filesystem;
using namespace openfoam;

void check_folder(const fs::path& folder) {
  for (const unsigned char c : folder.string()) {
    if (c <= ' ' || std::string_view("\"'$#;{}()\\").find(static_cast<char>(c)) != std::string_view::npos) {
      throw Error(ExitCode::usage,
                  fmt::format("OpenFOAM cannot run in '{}': its path must have no space, quote, "
                              "bracket or other special character; choose another folder",
                              folder.string()));
    }
  }
  if (fs::exists(folder) && !fs::is_empty(folder) && !fs::exists(folder / kReadme)) {
    throw Error(ExitCode::usage, fmt::format("{} contains files that are not a case of Ripstop; choose "
                                             "another folder for OpenFOAM, or empty it",
                                             folder.string()));
  }
}

class OpenFoamFlow final : public Flow {
 public:
  OpenFoamFlow(const FlowProblem& problem, const OpenFoamSettings& settings, const fs::path& folder,
               const Installation& installation)
      : whole_(problem),
        problem_(solved_part(problem)),
        settings_(settings),
        folder_(folder),
        programs_(settings, folder, installation) {
    check(whole_);
    prepare();
  }

  void place(std::size_t body, const std::vector<Triangle>& surface, const SheetMotion&) override {
    whole_.bodies.at(body).porous().cells = cut_cells(whole_.grid, surface);
    check(whole_);
    problem_ = solved_part(whole_);
  }

  FlowAdvance advance(int iterations, double residual, const FlowReport& report) override {
    check_run(iterations, residual);
    write_problem(iterations, residual);
    const std::string start = latest_time(part_folder(0));
    fs::remove(folder_ / kStopFile);
    SolverLog log(problem_.bodies.empty() ? SolverLog::Forces::none : SolverLog::Forces::porous,
                  parts_of(problem_));
    FlowAdvance now;
    const ProcessResult result = programs_.run_solver(report, log, now.stopped);
    const std::string time = latest_time(part_folder(0));
    if (time == start) {
      throw Error(ExitCode::external,
                  fmt::format("{} ended with {} but left no fields in {}; see {}", programs_.solver(),
                              describe(result), folder_.string(), programs_.solver_log().string()));
    }
    purge(time);
    now.last = log.progress();
    now.converged = log.converged();
    return now;
  }

  FlowField field() const override {
    return whole_field(read_case(mesh_, latest_time(part_folder(0)), problem_, settings_.incompressible),
                       whole_.grid);
  }
  bool untouched() const override { return latest_time(part_folder(0)) == "0"; }
  void start_afresh() override { prepare(); }

  void save(const fs::path& folder) const override {
    save_state(folder, basis(), {folder_, part_folders()}, latest_time(part_folder(0)));
  }

  void restore(const fs::path& folder) override {
    const SavedState state = read_state(folder);
    const auto made_with = [](const auto& run) {
      return fmt::format("{}, {} ranks and {} convection", solver_name(run.incompressible), run.ranks,
                         run.second_order ? "second-order" : "first-order");
    };
    const std::string saved = made_with(state.basis), now = made_with(settings_);
    if (saved != now) {
      throw Error(ExitCode::usage,
                  fmt::format("the flow saved in {} was made with {}, but this run has {}: use the same",
                              folder.string(), saved, now));
    }
    if (!(state.basis == basis())) {
      throw Error(ExitCode::usage,
                  fmt::format("the flow saved in {} was made with a different flow domain or different air",
                              folder.string()));
    }
    copy_state(folder, state, {folder_, part_folders()});
    purge(state.time);
  }

 private:
  Basis basis() const {
    Basis basis{problem_.grid,   problem_.air,           problem_.sides,
                settings_.ranks, settings_.second_order, settings_.incompressible};
    basis.quarter = problem_.quarter;
    return basis;
  }

  fs::path part_folder(int rank) const {
    return settings_.ranks == 1 ? folder_ : folder_ / fmt::format("processor{}", rank);
  }
  std::vector<fs::path> part_folders() const {
    std::vector<fs::path> folders;
    for (int rank = 0; rank < settings_.ranks; ++rank) folders.push_back(part_folder(rank));
    return folders;
  }

  /// Mesh and uniform fields, replacing earlier ones.
  void prepare() {
    fs::create_directories(folder_);
    clear_case(folder_);
    programs_.need_space(problem_.grid.cells());
    write_case(folder_, problem_, settings_);
    write_fields(folder_ / "0", problem_, settings_.incompressible);
    write_control(folder_, problem_, settings_.incompressible, {0, 1});  // required by the tools of OpenFOAM
    write_solution(folder_, problem_.stopping.residual);
    programs_.run_tool("blockMesh");
    if (settings_.ranks > 1) programs_.run_tool("decomposePar");
    mesh_ = read_mesh(folder_, settings_.ranks);
  }

  /// Data that may change from call to call: porous cells, residual, number of iterations.
  void write_problem(int iterations, double residual) {
    write_solution(folder_, residual);
    write_resistance(folder_, problem_.bodies);
    write_control(folder_, problem_, settings_.incompressible,
                  {std::stod(latest_time(part_folder(0))), iterations});
    std::vector<int> zone_of(static_cast<std::size_t>(problem_.grid.cells()), -1);
    for (std::size_t zone = 0; zone < problem_.bodies.size(); ++zone) {
      for (const int cell : problem_.bodies[zone].porous().cells) zone_of[cell] = static_cast<int>(zone);
    }
    std::vector<std::vector<int>> whole;
    for (const FlowBody& body : problem_.bodies) whole.push_back(body.porous().cells);
    write_zones(folder_ / "constant", whole);  // for a run by hand: blockMesh removes those of the mesh
    write_zones(folder_ / "constant/polyMesh", whole);
    if (settings_.ranks == 1) return;
    for (const MeshPart& part : mesh_) {
      std::vector<std::vector<int>> zones(problem_.bodies.size());
      for (std::size_t cell = 0; cell < part.count(problem_.grid); ++cell) {
        const int zone = zone_of[part.global(cell)];
        if (zone >= 0) zones[zone].push_back(static_cast<int>(cell));
      }
      write_zones(part.folder / "constant/polyMesh", zones);
    }
  }

  /// Leaves only the newest fields and the uniform ones that the case began with.
  void purge(const std::string& keep) const {
    for (const fs::path& part : part_folders()) {
      for (const auto& entry : fs::directory_iterator(part)) {
        const std::string name = entry.path().filename();
        if (name != keep && name != "0" && std::isdigit(static_cast<unsigned char>(name[0]))) {
          remove_path(entry.path());
        }
      }
    }
  }

  FlowProblem whole_, problem_;  // of the whole box, and of the part of it that is solved
  OpenFoamSettings settings_;
  fs::path folder_;
  Programs programs_;
  std::vector<MeshPart> mesh_;
};

class OpenFoam final : public FlowEngine {
 public:
  explicit OpenFoam(const OpenFoamSettings& settings)
      : settings_(settings), folder_(fs::absolute(settings.folder).lexically_normal()) {
    if (settings.ranks < 1 || settings.ranks > 100000) {
      throw Error(ExitCode::usage,
                  fmt::format("OpenFOAM: ranks is {}; it must be 1 or more", settings.ranks));
    }
    if (!settings.hostfile.empty()) require_slots(settings.hostfile, settings.ranks);
    check_folder(folder_);
    installation_ = find_installation(settings.program_folder, settings.ranks > 1, settings.incompressible);
  }

  std::string name() const override { return "OpenFOAM " + installation_.version; }
  std::unique_ptr<Flow> start(const FlowProblem& problem) override {
    if (problem.has_sheets()) return start_sheet_flow(problem, settings_, folder_, installation_);
    return std::make_unique<OpenFoamFlow>(problem, settings_, folder_, installation_);
  }

 private:
  OpenFoamSettings settings_;
  fs::path folder_;
  Installation installation_;
};

}  // namespace

std::unique_ptr<FlowEngine> make_openfoam(const OpenFoamSettings& settings) {
  return std::make_unique<OpenFoam>(settings);
}

}  // namespace ripstop::inline flow

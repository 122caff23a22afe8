#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>

#include "ripstop/core/error.h"
#include "ripstop/core/process.h"
#include "ripstop/flow/openfoam/case_reader.h"
#include "ripstop/flow/openfoam/case_writer.h"
#include "ripstop/flow/openfoam/hostfile.h"
#include "ripstop/flow/openfoam/installation.h"
#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/flow/openfoam/solver_log.h"
#include "ripstop/flow/openfoam/state.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;
using namespace openfoam;

void check_folder(const fs::path& folder) {
  for (const unsigned char c : folder.string()) {
    if (c <= ' ' || std::string_view("\"'$#;{}()\\").find(static_cast<char>(c)) != std::string_view::npos) {
      throw Error(ExitCode::usage,
                  fmt::format("OpenFOAM cannot work in '{}': its path must have no space, quote, "
                              "bracket or other special character; choose another folder",
                              folder.string()));
    }
  }
  if (fs::exists(folder) && !fs::is_empty(folder) && !fs::exists(folder / kReadme)) {
    throw Error(ExitCode::usage,
                fmt::format("{} holds files that are not a case of Ripstop's; choose another "
                            "folder for OpenFOAM, or empty it",
                            folder.string()));
  }
}

/// Removes what OpenFOAM and we have written; only called on a folder that is ours.
void clear(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    const bool time = !name.empty() && std::isdigit(static_cast<unsigned char>(name[0]));
    if (time || name == "constant" || name == "system" || name == "postProcessing" || name == kStopFile ||
        name.starts_with("log.") || name.starts_with("processor")) {
      fs::remove_all(entry.path());
    }
  }
}

class OpenFoamFlow final : public Flow {
 public:
  OpenFoamFlow(const FlowProblem& problem, const OpenFoamSettings& settings, const fs::path& folder,
               const Installation& installation)
      : problem_(problem), settings_(settings), folder_(folder), installation_(installation) {
    check(problem_);
    prepare();
  }

  void place(const std::vector<Triangle>& surface, const SheetMotion&) override {
    const std::vector<int> cells = cut_cells(problem_.grid, surface);
    for (PorousCells& cloth : problem_.porous) cloth.cells = cells;
    check(problem_);
  }

  FlowAdvance advance(int iterations, double residual, const FlowReport& report) override {
    check_run(iterations, residual);
    write_problem(iterations, residual);
    const std::string start = latest_time(part_folder(0));
    fs::remove(folder_ / kStopFile);
    SolverLog log(!problem_.porous.empty());
    FlowAdvance now;
    const ProcessResult result = run_solver(report, log, now.stopped);
    explain_failure(result, log);
    const std::string time = latest_time(part_folder(0));
    if (time == start) {
      throw Error(ExitCode::external,
                  fmt::format("{} ended with {} but left no fields in {}; see {}", installation_.solver,
                              describe(result), folder_.string(), log_file(installation_.solver).string()));
    }
    purge(time);
    now.last = log.progress();
    now.converged = log.converged();
    return now;
  }

  FlowField field() const override {
    return read_case(mesh_, latest_time(part_folder(0)), problem_, settings_.incompressible);
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
      throw Error(ExitCode::usage, fmt::format("the flow saved in {} was made with {}; this run has {}: use "
                                               "the same",
                                               folder.string(), saved, now));
    }
    if (!(state.basis == basis())) {
      throw Error(ExitCode::usage, fmt::format("the flow saved in {} was made in another box of air or in "
                                               "other air",
                                               folder.string()));
    }
    copy_state(folder, state, {folder_, part_folders()});
    purge(state.time);
  }

 private:
  Basis basis() const {
    return {problem_.grid,   problem_.air,           problem_.sides,
            settings_.ranks, settings_.second_order, settings_.incompressible};
  }

  fs::path part_folder(int rank) const {
    return settings_.ranks == 1 ? folder_ : folder_ / fmt::format("processor{}", rank);
  }
  std::vector<fs::path> part_folders() const {
    std::vector<fs::path> folders;
    for (int rank = 0; rank < settings_.ranks; ++rank) folders.push_back(part_folder(rank));
    return folders;
  }
  fs::path log_file(const std::string& program) const { return folder_ / ("log." + program); }

  /// Mesh and uniform fields, in place of what was there.
  void prepare() {
    fs::create_directories(folder_);
    clear(folder_);
    need_space(problem_.grid);
    write_case(folder_, problem_, settings_);
    write_initial_fields(folder_, problem_, settings_.incompressible);
    write_control(folder_, problem_, settings_.incompressible, {0, 1});  // OpenFOAM's tools ask for one
    write_solution(folder_, problem_.stopping.residual);
    run_tool("blockMesh");
    if (settings_.ranks > 1) run_tool("decomposePar");
    mesh_ = read_mesh(folder_, settings_.ranks);
  }

  /// What may change from call to call: porous cells, residual, number of iterations.
  void write_problem(int iterations, double residual) {
    write_solution(folder_, residual);
    write_resistance(folder_, problem_.porous);
    write_control(folder_, problem_, settings_.incompressible,
                  {std::stod(latest_time(part_folder(0))), iterations});
    std::vector<int> zone_of(static_cast<std::size_t>(problem_.grid.cells()), -1);
    for (std::size_t zone = 0; zone < problem_.porous.size(); ++zone) {
      for (const int cell : problem_.porous[zone].cells) zone_of[cell] = static_cast<int>(zone);
    }
    std::vector<std::vector<int>> whole;
    for (const PorousCells& porous : problem_.porous) whole.push_back(porous.cells);
    write_zones(folder_ / "constant", whole);  // for a run by hand: blockMesh removes those of the mesh
    write_zones(folder_ / "constant/polyMesh", whole);
    if (settings_.ranks == 1) return;
    for (const MeshPart& part : mesh_) {
      std::vector<std::vector<int>> zones(problem_.porous.size());
      for (std::size_t cell = 0; cell < part.count(problem_.grid); ++cell) {
        const int zone = zone_of[part.global(cell)];
        if (zone >= 0) zones[zone].push_back(static_cast<int>(cell));
      }
      write_zones(part.folder / "constant/polyMesh", zones);
    }
  }

  /// A full disk makes OpenFOAM leave cut files behind without a word, so the room is looked at before.
  /// Measured at 1.5 million cells: mesh 0.11 kB a cell, a set of fields 0.10; a second set exists for a
  /// moment, and ranks have a copy of the mesh. Asked for with room to spare.
  void need_space(const FlowGrid& grid) const {
    const double need = (settings_.ranks > 1 ? 0.9e3 : 0.7e3) * grid.cells();
    const double have = static_cast<double>(fs::space(folder_).available);
    if (have < need) {
      throw Error(ExitCode::io, fmt::format("{} has {:.1f} GB free; this case needs about {:.1f} GB",
                                            folder_.string(), have / 1e9, need / 1e9));
    }
  }

  ProcessRequest request_for(std::vector<std::string> arguments) const {
    ProcessRequest request;
    request.arguments = std::move(arguments);
    request.working_folder = folder_;
    request.environment = environment(installation_);
    request.time_limit_s = settings_.time_limit_s;
    return request;
  }

  void run_tool(const std::string& tool) {
    ProcessRequest request = request_for({program(installation_, tool).string()});
    std::ofstream log_stream(log_file(tool));
    SolverLog log(false);
    request.on_line = [&](const std::string& line) {
      log_stream << line << '\n';
      log.feed(line);
      return true;
    };
    const ProcessResult result = run_process(request);
    close_written(log_stream, log_file(tool));
    if (!result.succeeded()) {
      throw Error(ExitCode::external, fmt::format("OpenFOAM's {} failed: {}. {} (whole log: {})", tool,
                                                  describe(result), log.fatal(), log_file(tool).string()));
    }
  }

  ProcessResult run_solver(const FlowReport& report, SolverLog& log, bool& stopped) {
    std::vector<std::string> arguments;
    if (settings_.ranks > 1) {
      arguments = {program(installation_, "mpirun").string(), "-np", std::to_string(settings_.ranks)};
      if (settings_.hostfile.empty()) {
        // Ranks on logical processors are allowed; runs side by side must not be pinned to the same ones, and
        // a rank that waits must leave its processor to the one it waits for.
        arguments.insert(arguments.end(),
                         {"--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1"});
      } else {
        arguments.insert(arguments.end(), {"--hostfile", fs::absolute(settings_.hostfile).string()});
      }
      arguments.insert(arguments.end(), {"-x", "WM_PROJECT_DIR"});  // Slurm's hosts are not in a file
    }
    arguments.push_back(program(installation_, installation_.solver).string());
    if (settings_.ranks > 1) arguments.push_back("-parallel");

    ProcessRequest request = request_for(std::move(arguments));
    std::ofstream log_stream(log_file(installation_.solver));
    request.on_line = [&](const std::string& line) {
      log_stream << line << '\n';
      if (log.feed(line) && report && !stopped && !report(log.progress())) {
        stopped = true;
        std::ofstream(folder_ / kStopFile) << "stop\n";
      }
      return !log.not_a_number();
    };
    const ProcessResult result = run_process(request);
    close_written(log_stream, log_file(installation_.solver));
    fs::remove(folder_ / kStopFile);
    return result;
  }

  void explain_failure(const ProcessResult& result, const SolverLog& log) const {
    const std::string where = fmt::format("iteration {}, field {}", log.iteration(), log.field());
    const std::string file = log_file(installation_.solver).string();
    const int signal = result.signal != 0       ? result.signal
                       : result.exit_code > 128 ? result.exit_code - 128
                                                : 0;
    const bool impossible = log.fatal().find("Negative initial temperature") != std::string::npos;
    if (log.not_a_number() || log.floating_point_trap() || impossible || signal == SIGFPE) {
      throw Error(ExitCode::diverged, fmt::format("the flow diverged at {} of this solve: {}. Try a coarser "
                                                  "grid, a lower resistance or a slower air speed (log: {})",
                                                  where,
                                                  impossible           ? "negative temperature"
                                                  : log.not_a_number() ? "not a number"
                                                                       : "floating-point trap",
                                                  file));
    }
    if (result.timed_out) {
      throw Error(ExitCode::external,
                  fmt::format("{} had not ended after {:.0f} s, at {}: raise the time limit or "
                              "use more ranks (log: {})",
                              installation_.solver, settings_.time_limit_s, where, file));
    }
    if (log.out_of_memory() || signal == SIGKILL) {
      throw Error(ExitCode::external,
                  fmt::format("{} was ended at {} by {}: most often the machine had no memory left; use a "
                              "coarser grid (log: {})",
                              installation_.solver, where,
                              log.out_of_memory() ? "a failed allocation" : describe(result), file));
    }
    if (!result.succeeded()) {
      const double free = static_cast<double>(fs::space(folder_).available);
      throw Error(ExitCode::external,
                  fmt::format("{} failed at {}: {}. {}{} (whole log: {})", installation_.solver, where,
                              describe(result), log.fatal(), free < 1e8 ? " The disk is full." : "", file));
    }
  }

  /// Leaves only the newest fields and the uniform ones that the case began with.
  void purge(const std::string& keep) const {
    for (const fs::path& part : part_folders()) {
      for (const auto& entry : fs::directory_iterator(part)) {
        const std::string name = entry.path().filename();
        if (name != keep && name != "0" && std::isdigit(static_cast<unsigned char>(name[0]))) {
          fs::remove_all(entry.path());
        }
      }
    }
  }

  FlowProblem problem_;
  OpenFoamSettings settings_;
  fs::path folder_;
  Installation installation_;
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

  std::string name() const override {
    return fmt::format("OpenFOAM {} ({})", installation_.version, installation_.solver);
  }
  std::unique_ptr<Flow> start(const FlowProblem& problem) override {
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

}  // namespace ripstop

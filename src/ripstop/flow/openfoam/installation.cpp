#include "ripstop/flow/openfoam/installation.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "ripstop/core/error.h"
#include "ripstop/core/process.h"

namespace ripstop::inline flow::openfoam {
namespace {

namespace fs = std::filesystem;

/// Debian's package keeps etc/ apart from the programs; builds from source have <project>/platforms/<x>/bin.
fs::path find_project(const fs::path& solver) {
  const char* named = std::getenv("WM_PROJECT_DIR");
  const fs::path real = fs::weakly_canonical(solver).parent_path();
  for (const fs::path& candidate : {fs::path(named ? named : ""), fs::path("/usr/share/openfoam"),
                                    real.parent_path().parent_path().parent_path()}) {
    if (!candidate.empty() && fs::exists(candidate / "etc/controlDict")) return candidate;
  }
  throw Error(ExitCode::external,
              "OpenFOAM's folder with etc/controlDict was not found: set WM_PROJECT_DIR to it (Debian: "
              "/usr/share/openfoam), or source OpenFOAM's etc/bashrc first");
}

/// An OpenFOAM that lies on the disk but is not in PATH, for the message.
std::string hint() {
  for (const char* base : {"/usr/lib/openfoam", "/opt"}) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(base, ignored)) {
      if (fs::exists(entry.path() / "etc/bashrc", ignored) &&
          entry.path().filename().string().find("openfoam") != std::string::npos) {
        return fmt::format("; there is an OpenFOAM in {0}: run 'source {0}/etc/bashrc' and try again",
                           entry.path().string());
      }
    }
  }
  return {};
}

/// From "Using: OpenFOAM- (1912) - visit www.openfoam.com" or "Using: OpenFOAM-v2306 (2306) - visit ...".
std::string version_of(const std::string& line) {
  if (line.find("openfoam.com") == std::string::npos && line.find("OpenFOAM.com") == std::string::npos)
    return {};
  for (std::size_t at = 0; at + 4 <= line.size(); ++at) {
    const std::string four = line.substr(at, 4);
    if (std::all_of(four.begin(), four.end(), [](unsigned char c) { return std::isdigit(c); })) return four;
  }
  return {};
}

}  // namespace

const char* solver_name(bool incompressible, bool sheets) {
  if (sheets) return "simpleFoam";
  return incompressible ? "porousSimpleFoam" : "rhoPorousSimpleFoam";
}

fs::path program(const Installation& installation, const std::string& name) {
  const bool mpi = name == "mpirun";
  fs::path found = find_program(name, mpi ? fs::path() : installation.folder);
  if (found.empty()) {
    throw Error(ExitCode::external,
                fmt::format("'{}' was not found in {}: install it with 'apt install {}'{}{}", name,
                            installation.folder.empty() || mpi ? "PATH" : installation.folder.string(),
                            mpi ? "openmpi-bin" : "openfoam",
                            mpi ? ", or use one rank" : ", or use the built-in engine", mpi ? "" : hint()));
  }
  return found;
}

std::vector<std::pair<std::string, std::string>> environment(const Installation& installation) {
  std::vector<std::pair<std::string, std::string>> added = {
      {"WM_PROJECT_DIR", installation.project.string()}};
  if (geteuid() == 0) {  // mpirun refuses to run as root, as in containers, without both variables
    added.emplace_back("OMPI_ALLOW_RUN_AS_ROOT", "1");
    added.emplace_back("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
  }
  return added;
}

Installation find_installation(const fs::path& program_folder, bool parallel, bool incompressible) {
  Installation installation{program_folder, {}, {}, solver_name(incompressible)};
  const fs::path solver = program(installation, installation.solver);
  program(installation, "blockMesh");
  if (parallel) {
    program(installation, "decomposePar");
    program(installation, "mpirun");
  }
  installation.project = find_project(solver);

  std::string using_line;
  ProcessRequest request;
  request.arguments = {solver.string(), "-help"};
  request.environment = environment(installation);
  request.time_limit_s = 60;
  request.on_line = [&](const std::string& line) {
    if (line.starts_with("Using: ")) using_line = line;
    return true;
  };
  const ProcessResult result = run_process(request);
  installation.version = version_of(using_line);
  if (!result.succeeded() || installation.version.empty()) {
    throw Error(ExitCode::external,
                fmt::format("{} is not a version of openfoam.com from 1912, which Ripstop requires: it "
                            "reports '{}' ({}). Install the Debian package 'openfoam'",
                            solver.string(), using_line, describe(result)));
  }
  return installation;
}

}  // namespace ripstop::inline flow::openfoam

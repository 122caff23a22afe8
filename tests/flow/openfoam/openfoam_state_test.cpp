// The saved data of a flow in OpenFOAM's case are on the disk before their seal.
#include <gtest/gtest.h>

#include "../../flushes.h"
#include "../../refusal.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/flow/openfoam/state.h"

namespace ripstop::openfoam {
namespace {

namespace fs = std::filesystem;

struct OpenFoamState : testing::Test {
  TemporaryFolder folder{"openfoam-state"};
  const fs::path whole = folder.path / "case", saved = folder.path / "saved";
  CaseFolders folders{whole, {whole / "processor0", whole / "processor1"}, true};
  Basis basis;

  OpenFoamState() {
    basis.ranks = 2;
    for (const fs::path& part : folders.parts) {
      put(part / "10/U");
      put(part / "10/uniform/time");
      put(part / "constant/polyMesh/cellZones");
    }
    for (const char* file : {"constant/porosityProperties", "constant/cellZones",
                             "constant/polyMesh/cellZones", "constant/polyMesh/points",
                             "constant/polyMesh/boundary", "system/controlDict", "system/fvSolution"})
      put(whole / file);
  }
  static void put(const fs::path& file) {
    make_folder(file.parent_path());
    write_file(file, file.string());
  }
  /// Where the seal's own file was flushed, before it had its name.
  static std::size_t place_of_seal(const Flushes& flushes) {
    const auto is_seal = [](const fs::path& path) { return written_as(path.filename()) == seal_name; };
    return static_cast<std::size_t>(std::find_if(flushes.paths.begin(), flushes.paths.end(), is_seal) -
                                    flushes.paths.begin());
  }
};

TEST_F(OpenFoamState, EveryFileAndFolderIsOnTheDiskBeforeTheSeal) {
  Flushes flushes;
  save_state(saved, basis, folders, "10");
  const std::size_t seal = place_of_seal(flushes);
  ASSERT_LT(seal, flushes.paths.size());
  int entries = 0;
  for (const auto& entry : fs::recursive_directory_iterator(saved)) {
    const std::string name = entry.path().filename();
    if (name == seal_name || name == "saved.json") continue;
    EXPECT_LT(flushes.place_of(entry.path()), seal) << entry.path();
    ++entries;
  }
  EXPECT_EQ(entries, 2 * 4 + 1 + 9);
}

TEST_F(OpenFoamState, IsUnsealedOnTheDiskBeforeAnythingOfItIsReplaced) {
  save_state(saved, basis, folders, "10");
  Flushes flushes;
  save_state(saved, basis, folders, "10");
  EXPECT_EQ(flushes.paths.front(), saved);
  flushes.failing = "saved";
  EXPECT_NE(refusal_of([&] { save_state(saved, basis, folders, "10"); }, ExitCode::io).find("flushed"),
            std::string::npos);
  flushes.failing.clear();
  refusal_of([&] { read_state(saved); }, ExitCode::bad_data);
}

TEST_F(OpenFoamState, WithAFileThatDoesNotReachTheDiskIsNotSealed) {
  for (const std::string name : {"U", "time", "uniform", "part1", "points", "cellZones.part1", "problem"}) {
    Flushes flushes;
    flushes.failing = name;
    const std::string message = refusal_of([&] { save_state(saved, basis, folders, "10"); }, ExitCode::io);
    EXPECT_NE(message.find(name + ": cannot be flushed to the disk: Input/output error"), std::string::npos)
        << message;
    EXPECT_FALSE(fs::exists(saved / seal_name)) << name;
  }
}

}  // namespace
}  // namespace ripstop::openfoam

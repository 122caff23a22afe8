// The saved state of a flow: its newest fields and their basis, in a sealed folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/flow/flow.h"

namespace ripstop::inline flow::openfoam {

/// Basis of the fields; another basis starts from uniform flow.
struct Basis {
  FlowGrid grid;
  Freestream air;
  Sides sides = Sides::zero_gradient;
  int ranks = 1;
  bool second_order = false;
  bool incompressible = false;
  bool fitted_mesh = false;
  int cloth_levels = 0;
  bool quarter = false;
};
bool operator==(const Basis& a, const Basis& b);

struct SavedState {
  Basis basis;
  std::string time;  // name of the time folder
};

/// Where a case's files are: the case, and its parts, one a rank; with one rank the part is the case.
struct CaseFolders {
  std::filesystem::path whole;
  std::vector<std::filesystem::path> parts;
  bool with_mesh = false;  // one that nothing but the same tools on the same cloth make again
};

/// Copies folder `time` of every part and the files of the problem of the last call (cells, resistances, control),
/// so that a restored case runs by hand as well; flushes it all to the disk and seals the folder. The mesh is not
/// copied: blockMesh and decomposePar make the same one again.
void save_state(const std::filesystem::path& folder, const Basis& basis, const CaseFolders& from,
                const std::string& time);
/// Throws Error(bad_data) where anything was lost or changed since it was saved.
SavedState read_state(const std::filesystem::path& folder);
void copy_state(const std::filesystem::path& folder, const SavedState& state, const CaseFolders& to);

}  // namespace ripstop::inline flow::openfoam

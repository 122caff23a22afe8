// The saved state of a flow: its newest fields and what they are of, in a sealed folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/flow/flow.h"

namespace ripstop::openfoam {

/// What fields were made for; another basis starts from uniform flow.
struct Basis {
  FlowGrid grid;
  Freestream air;
  Sides sides = Sides::zero_gradient;
  int ranks = 1;
  bool second_order = false;
  bool incompressible = false;
};
bool operator==(const Basis& a, const Basis& b);

struct SavedState {
  Basis basis;
  std::string time;  // name of the time folder
};

/// Copies folder `time` of every part (one a rank), flushes it to the disk and seals the folder. The mesh is
/// not copied: blockMesh and decomposePar make the same one again.
void save_state(const std::filesystem::path& folder, const Basis& basis,
                const std::vector<std::filesystem::path>& parts, const std::string& time);
/// Throws Error(bad_data) where anything was lost or changed since it was saved.
SavedState read_state(const std::filesystem::path& folder);
void copy_state(const std::filesystem::path& folder, const SavedState& state,
                const std::vector<std::filesystem::path>& parts);

}  // namespace ripstop::openfoam

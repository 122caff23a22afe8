// Reads a solved case back into a FlowField, from one folder or from the folders of MPI ranks.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "ripstop/flow/flow.h"
#include "ripstop/flow/openfoam/field_file.h"

namespace ripstop::inline flow::openfoam {

/// One part of the mesh: the whole of it, or that of one rank.
struct MeshPart {
  std::filesystem::path folder;  // contains constant/ and the time folders
  std::vector<int> cells;        // index in the grid of every cell; empty: the same
  std::vector<double> share;     // of the volume of all that lie in that cell of the grid; empty: 1
  std::vector<std::pair<int, int>> stand_ins;  // cells of the grid that none lies in, and the nearest one
  std::vector<int> owner;                      // cell of each face
  std::vector<Patch> patches;

  std::size_t count(const FlowGrid& grid) const { return cells.empty() ? grid.cells() : cells.size(); }
  std::size_t inner_faces() const {
    std::size_t faces = owner.size();
    for (const Patch& patch : patches) faces -= static_cast<std::size_t>(patch.faces);
    return faces;
  }
  int global(std::size_t cell) const { return cells.empty() ? static_cast<int>(cell) : cells[cell]; }
  double weight(std::size_t cell) const { return share.empty() ? 1 : share[cell]; }
};

/// One part for 1 rank, else one for each processor folder.
std::vector<MeshPart> read_mesh(const std::filesystem::path& folder, int ranks);

/// Name of the newest time folder; empty when there is none.
std::string latest_time(const std::filesystem::path& folder);

/// pressure, velocity, porous_force (summed over the cells) and momentum_deficit. An incompressible case has
/// p and phi per density. Of a quarter the forces are those of the whole box, the cells those of the quarter.
FlowField read_case(const std::vector<MeshPart>& parts, const std::string& time, const FlowProblem& problem,
                    bool incompressible);

/// The part of the box that is solved, how many of them make the whole, and the field of the whole from that of the part.
FlowProblem solved_part(const FlowProblem& whole);
int parts_of(const FlowProblem& problem);
FlowField whole_field(FlowField part, const FlowGrid& whole);

}  // namespace ripstop::inline flow::openfoam

// The reference flow engine: OpenFOAM's rhoPorousSimpleFoam or porousSimpleFoam as a child program, on a case
// that we write.
#pragma once

#include <filesystem>
#include <memory>

#include "ripstop/flow/flow.h"

namespace ripstop::inline flow {

struct OpenFoamSettings {
  std::filesystem::path folder;  // the case; made by us, or one that we made before (it is then overwritten)
  int ranks = 1;                 // MPI processes; 1 needs no MPI
  std::filesystem::path hostfile;        // for mpirun; empty: this machine only
  double time_limit_s = 24 * 3600;       // for one solve
  std::filesystem::path program_folder;  // where OpenFOAM's programs are; empty: PATH
  bool second_order = false;             // linearUpwind for U in place of the printed first-order upwind
  bool fitted_mesh = false;     // of sheets: cells moved onto the cloth by snappyHexMesh, not parted by it
  int cloth_levels = 0;         // fitted: times that the cells at the cloth are halved
  bool incompressible = false;  // porousSimpleFoam: constant density, no energy; temperature plays no part
};

/// Throws Error(external) when a program is missing or of another kind than the openfoam.com line, and Error(usage)
/// when OpenFOAM does not support the path of the folder, or the folder contains other files.
///
/// One flow at a time: they share the folder. Flow::advance() throws Error(diverged) naming the iteration and
/// the field, and Error(external) when the solver was killed, was late, or ended without its fields.
///
/// When the report returns false the solver is asked to write its fields and end; it may do one or a few more
/// iterations before it sees the request. For runs that must repeat exactly, limit the iterations instead.
std::unique_ptr<FlowEngine> make_openfoam(const OpenFoamSettings& settings);

/// Approximate number of cells of a fitted mesh on a grid, with the cells at `cloth_area` [m2] halved `levels` times.
double fitted_cells(const FlowGrid& grid, double cloth_area, int levels);

}  // namespace ripstop::inline flow

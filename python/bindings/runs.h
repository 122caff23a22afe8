// Finished runs in Python: a run's result with the arrays that belong to it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "arrays.h"
#include "module.h"
#include "ripstop/cloth/cloth.h"
#include "ripstop/parachute/canopy_mesh.h"
#include "ripstop/parachute/own_mesh.h"
#include "ripstop/run/opening/inflation.h"
#include "ripstop/run/steady/finished_steady.h"
#include "ripstop/run/steady/steady.h"

namespace ripstop {
template <Of<CellStress> T, class Visit>
void each_member(T& s, Visit&& visit) {
  visit("principal_max_n_m", s.principal_max);
  visit("principal_min_n_m", s.principal_min);
  visit("von_mises_n_m", s.von_mises);
  visit("direction", s.direction);
  visit("warp_n_m", s.warp);
  visit("weft_n_m", s.weft);
  visit("tautness", s.tautness);  // 0 slack, 1 wrinkled, 2 taut
  visit("max_strain", s.max_strain);
}
}  // namespace ripstop

namespace ripstop::python {

/// A canopy of the user's own (parachute/own_mesh.h).
struct PyMesh {
  OwnMesh own;
};
using OptionalMesh = std::optional<std::reference_wrapper<const PyMesh>>;
/// Throws Error(usage) for a mesh that cannot be computed, and for one whose run would be in a folder: its case file
/// lacks the mesh.
std::shared_ptr<const CanopyMesh> own_mesh(const OptionalMesh& given, bool in_folder);

struct PySteady {
  PyCase made;
  SteadyResult result;
  SteadyState state;
  FlowField flow;                  // empty where the run was finished already
  std::vector<CellStress> stress;  // likewise
  std::vector<Cell> cells;
  std::string engine;
  Path folder;                                 // empty: in memory only
  std::shared_ptr<const CanopyMesh> own_mesh;  // of the user; null: that of the case
};

struct PyInflation {
  PyCase made;
  InflationResult result;
  std::vector<Vec3> shape, velocity;  // at the end, as the mesh numbers its nodes
  std::vector<Snapshot> shots;
  InflationHistory history;
  CanopyMesh mesh;
  std::vector<Cell> cells;
  Path folder;  // empty: in memory only
};

/// A steady run: in memory, or the folder of one.
using SteadySource = std::variant<Path, std::reference_wrapper<const PySteady>>;
/// Throws Error(usage) for a run of a mesh of the user's own: mass and sizes of its case are not those of its canopy.
void refuse_own_mesh(const PySteady& run);
/// Throws as finished_steady() and refuse_own_mesh().
FinishedSteady finished(const SteadySource& source);

/// Corners of every cell as rows of node numbers; the first is -1 where there is no cloth.
inline py::array view_of_cells(const std::vector<Cell>& cells, py::handle owner) {
  static_assert(sizeof(Cell) == 4 * sizeof(int));
  const int* data = cells.empty() ? nullptr : cells.front().corner;
  return view_of(data, {static_cast<py::ssize_t>(cells.size()), 4}, owner);
}

}  // namespace ripstop::python
